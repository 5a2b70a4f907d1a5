# SPDX-License-Identifier: BSD-3-Clause
"""Roadmaps that outlive their question."""
import os
from typing import NamedTuple

import numpy as np

from . import _core
from ._making_worlds import as_world
from ._options import documented, told
from ._pictures import Pictured
from ._solving import finished
from ._worlds import World


class EdgeCounts(NamedTuple):
    """How many edges are in which state; one that leads both ways counts once."""

    free: int
    blocked: int
    unchecked: int


EdgeCounts.__module__ = "warren"


class Roadmap(Pictured):
    """A roadmap of a world for a body: built once, asked as often as one likes.

    Made by :func:`build` and :func:`open_roadmap`. Any number of threads may ask at once. What its arrays show they
    don't own: they are read-only and keep the roadmap alive.

    Attributes
    ----------
    report : dict or None
        What :meth:`update` did to make it: mode ("changed" or "built"), edges, edges_checked, states_added and
        states_dropped; None where it was built or opened.

    Examples
    --------
    >>> import warren
    >>> roadmap = warren.build(warren.maze(41, 41, seed=3))
    >>> roadmap
    <Roadmap of maze:41x41,seed=3: 1681 states, 1680 edges free>
    >>> roadmap.query((1, 1), (41, 41)).status
    'solved'
    """

    __slots__ = ("_core", "_world", "_free", "report", "__weakref__")
    __module__ = "warren"

    def __init__(self, core, report=None):
        if not isinstance(core, _core.Roadmap):
            raise TypeError("Roadmap: is made by build and open_roadmap")
        self._core = core
        self._world = None
        self._free = None
        self.report = report

    def __repr__(self):
        states, free, _, _ = self._core.counts()
        return f"<Roadmap of {self.world.source}: {states} states, {free} edges free>"

    def __len__(self):
        return self._core.counts()[0]

    def __reduce__(self):
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "pickled.roadmap")
            self.save(file)
            with open(file, "rb") as kept:
                from ._building import from_bytes
                return from_bytes, (kept.read(), self.report)

    @property
    def world(self):
        """The world that it is for."""
        if self._world is None:
            self._world = World(self._core.world)
        return self._world

    robot = told("robot", "The body that it is for.")
    clearance = told("clearance", "The room that it keeps around the body.")
    planner = told("planner", "Who made it.")
    seed = told("seed", "Of the states that were drawn.")
    directed = told("directed", "Do edges lead one way only, as those of a car that can't go backwards?")
    states = told("states", "States, float64: (n, 2) x, y; (n, 3) x, y, theta; (n, 6) joint angles.")

    @property
    def components(self):
        """For each state, (n,), the smallest one that free edges join it with. A copy."""
        return self._core.components()

    @property
    def edge_states(self):
        """For each entry of :meth:`csr` with `unchecked=True`: 0 unchecked, 1 free, 2 blocked. A copy."""
        return self._core.edge_states()

    @property
    def edges(self):
        """How many edges are free, blocked and unchecked.

        Examples
        --------
        >>> import warren
        >>> warren.build("maze:5x5").edges
        EdgeCounts(free=24, blocked=16, unchecked=0)
        """
        return EdgeCounts(*self._core.counts()[1:])

    def query(self, start=None, goal=None, *, keep=False, explain=False, **options):
        """Asks for one path: what :func:`solve` would find with the roadmap's options.

        Parameters
        ----------
        start, goal : sequence of float, optional
            As :func:`solve` takes them (default: the world's).
        keep : bool
            Shall the answer keep what a picture shows of the search?
        explain : bool
            As :func:`solve` takes it; hints are options of :func:`build`.
        {options}

        Returns
        -------
        Answer

        Raises
        ------
        UsageError, InputError, Stopped
        """
        return finished(self._core.ask({**options, "start": start, "goal": goal}, keep, explain), self.world)

    def lengths(self, starts, goals, **options):
        """Lengths of the shortest ways from each start to the goal beside it, on all threads.

        Parameters
        ----------
        starts, goals : array_like, (n, 2), (n, 3) or (n, 6)
            A row a question; one row alone is for all. Arrays must be float64 in C order.
        {options}

        Returns
        -------
        ndarray, (n,)
            Infinite where there is no way, or an end is blocked.

        Examples
        --------
        >>> import warren
        >>> warren.build("maze:5x5").lengths([(1, 1), (0.5, 1)], [(5, 5)])
        array([18. , 18.5])
        """
        return self._core.lengths(starts, goals, False, options)

    def matrix(self, starts, goals, **options):
        """Lengths of the shortest ways from each start to each goal, on all threads.

        Parameters
        ----------
        starts, goals : array_like, (n, 2), (n, 3) or (n, 6)
            A row a place. Arrays must be float64 in C order.
        {options}

        Returns
        -------
        ndarray, (starts, goals)
            Infinite where there is no way, or an end is blocked.

        Examples
        --------
        >>> import warren
        >>> warren.build("maze:5x5").matrix([(1, 1), (3, 3)], [(5, 5), (1, 1)])
        array([[18.,  0.],
               [ 6., 12.]])
        """
        return self._core.lengths(starts, goals, True, options)

    def learn(self):
        """Takes over what the questions so far have learnt of the edges of a lazy roadmap, for :meth:`save` and arrays.

        Raises
        ------
        ValueError
            While another thread asks; and one that asks meanwhile gets it, too.
        """
        self._core.learn()
        self._free = None

    def update(self, world, **limits):
        """The roadmap of a world that has changed: what :func:`build` would make of it, bit for bit, but that motions
        which keep clear of what has changed aren't asked about again. This one stays as it is.

        Parameters
        ----------
        world : World, str, path, ndarray, or geometry
            The world as it is now.
        threads, budget, memory, progress
            As :func:`build` takes them.

        Returns
        -------
        Roadmap
            Its :attr:`report` says what was done.

        Examples
        --------
        >>> import warren
        >>> world = warren.maze(41, 41)
        >>> old = warren.build(world, index="none")
        >>> new = old.update(world.without_walls([100]))
        >>> new.edges.free - old.edges.free, new.report["edges_checked"] < 100
        (1, True)
        """
        there = as_world(world)
        core, report = self._core.update(there._core, limits)
        return Roadmap(core, report)

    def save(self, file, *, world=True):
        """Writes a .roadmap file, the same bytes as `warren build`.

        Parameters
        ----------
        file : str or path
        world : bool
            Shall the world be in it? Else who opens it names the world.
        """
        self._core.save(os.fspath(file), world)

    def export(self, file, *, unchecked=False, frame="map"):
        """Writes the roadmap for other programs: .geojson, .graphml, .gr, .csv, .npz, .dot, by the ending.

        Parameters
        ----------
        file : str or path
        unchecked : bool
            Edges that nobody has asked about, too?
        frame : str
            The frame that .geojson names.

        Returns
        -------
        dict
            vertices, edges, unchecked_left_out, blocked_left_out.
        """
        return self._core.export(os.fspath(file), unchecked, frame)

    def csr(self, *, unchecked=False):
        """Free edges in compressed sparse rows, each that leads both ways in both its rows. Made once, and views of that
        from then on.

        Parameters
        ----------
        unchecked : bool
            All edges, whatever is known of them?

        Returns
        -------
        indptr, indices : ndarray of int32
        lengths : ndarray of float64

        Examples
        --------
        >>> import warren
        >>> indptr, indices, lengths = warren.build("maze:5x5").csr()
        >>> indptr[-1], indices.dtype, lengths.sum()
        (48, dtype('int32'), 48.0)
        """
        if unchecked or self.edges[1:] == (0, 0):
            return self._core.all_rows()
        if self._free is None:
            self._free = self._core.free_rows()
        return self._free

    def to_scipy(self, *, unchecked=False):
        """The same as a matrix of SciPy over the same arrays: nothing is copied.

        Returns
        -------
        scipy.sparse.csr_matrix

        Examples
        --------
        >>> import warren
        >>> from scipy.sparse.csgraph import shortest_path
        >>> roadmap = warren.build("maze:5x5")
        >>> shortest_path(roadmap.to_scipy(), indices=0)[-1]
        18.0
        """
        from scipy.sparse import csr_matrix
        indptr, indices, lengths = self.csr(unchecked=unchecked)
        n = len(indptr) - 1
        matrix = csr_matrix((n, n), dtype=np.float64)
        matrix.indptr, matrix.indices, matrix.data = indptr, indices, lengths
        return matrix

    def _drawn(self, kind, look):
        return _core.picture_of_roadmap(self._core, kind, look)


Roadmap.query = documented(_core.query_keywords())(Roadmap.query)
Roadmap.lengths = documented(_core.lengths_keywords())(Roadmap.lengths)
Roadmap.matrix = documented(_core.lengths_keywords())(Roadmap.matrix)
