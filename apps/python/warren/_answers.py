# SPDX-License-Identifier: BSD-3-Clause
"""Questions and their answers."""
import json
import os

from typing import Any, Dict, NamedTuple, Optional, Tuple

from . import _core
from ._explanations import BlockedEnd, explanation
from ._options import documented, told
from ._pictures import Pictured


class Improvement(NamedTuple):
    """A path that was better than those before it, of a planner that gets better with time.

    `iterations` are the turns that were done when it came, `seconds` those since the search began, `length` and `cost`
    (in the body's metric, which is what gets better) are the path's, `by` the part that found it; `lower_bound` is what
    was proved of all costs by then, 0 where nothing was.
    """

    iterations: int
    seconds: float
    length: float
    cost: float
    by: str
    lower_bound: float


class Alternative(NamedTuple):
    """The cheapest path of another homotopy class: `passed` are the holes whose cuts it crosses, below 0 from the other
    side; all else is as of :class:`Answer`."""

    cost: float
    length: float
    price: Dict[str, float]
    min_clearance: float
    passed: Tuple[int, ...]
    path: Any


class GoalReached(NamedTuple):
    """Where a path ends that had a choice: the goal that was meant, how far the end is from it, and, where that is
    proved, how near no place is that can be reached."""

    asked: Tuple[float, ...]
    distance: float
    distance_bound: Optional[float]


class KeptRoute(NamedTuple):
    """What became of an older path: was it kept, what its rest costs (None: it is not free), and what a new path does
    (None: there is none)."""

    kept: bool
    kept_cost: Optional[float]
    new_cost: Optional[float]


for _kind in (Improvement, Alternative, GoalReached, KeptRoute):
    _kind.__module__ = "warren"


class Answer(Pictured):
    """What :func:`solve` and :meth:`Roadmap.query` found: a verified path, or why there is none.

    True where it has a verified path. An array of the path's states where an array is expected. Pickled without what
    :attr:`kept <solve>` added.

    Examples
    --------
    >>> import warren
    >>> answer = warren.solve("maze:5x5")
    >>> answer
    <Answer solved: length 19, verified>
    >>> answer.status, answer.length, answer.verified, bool(answer)
    ('solved', 19.0, True, True)
    >>> answer.path[:2]
    array([[0.5, 1. ],
           [1. , 1. ]])
    """

    __slots__ = ("_core", "world", "__weakref__")
    __module__ = "warren"

    def __init__(self, core, world):
        if not isinstance(core, _core.Answer):
            raise TypeError("Answer: is made by solve and Roadmap.query")
        self._core = core
        self.world = world

    def __repr__(self):
        if not self.verified:
            return f"<Answer {self.status}>"
        return f"<Answer {self.status}: length {self.length:g}, verified>"

    def __str__(self):
        return self._core.summary.rstrip("\n")

    def __bool__(self):
        return self._core.verified

    def __array__(self, dtype=None):
        return self.path if dtype is None else self.path.astype(dtype)

    def __reduce__(self):
        return Answer, (self._core, self.world)

    status = told("status", '''"solved", "start_blocked", "goal_blocked", "not_connected", "infeasible" (proved) or
        "stopped".''')
    verified = told("verified", """Has it a path that an independent judge found free, all along and with all its
        clearance?""")
    optimal = told("optimal", "Is it proved that no shorter path exists?")
    lower_bound = told("lower_bound", """Proved: no path has less cost or, where that is not told, length; nan where
        nothing is proved.""")
    gap = told("gap", "How much more than lower_bound the path costs, as a share of that; nan where nothing is known.")
    path = told("path", """States from start to goal, float64: (n, 2) x, y; (n, 3) x, y, theta; (n, 6) joint angles.
        A read-only view that keeps the answer alive; no rows where there is no path.""")
    length = told("length", "Of the path, of a car its curve, of an arm in radians; nan without a verified path.")
    min_clearance = told("min_clearance", "The least room around the body along the path; nan without a verified path.")
    raw_length = told("raw_length", "The length before the path was pulled taut; nan where it wasn't.")
    cost = told("cost", """Length and all prices, where prices were asked; else in the planner's own units; nan where
        that is the length.""")
    price = told("price", """What is paid beyond the length, where prices were asked: a dict of "clearance", "areas",
        "turning", "cusps" and "reverse"; else None.""")
    cost_error = told("cost_error", "The cost may be off by so much at most; nan without prices.")
    bound_of = told("bound_of", """Of what a priced lower bound is: "all" paths, or those over the "lattice"; None of
        others.""")
    goal_index = told("goal_index", "Of several goals the one that is reached, from 0; None where there was one.")
    goal_reached = told("goal_reached", """Where the path ends, as a :class:`GoalReached`, where the question left a
        choice; else None.""", GoalReached._make)
    order = told("order", "Of places to visit, from 0, as they are visited: a list of int.")
    passed = told("passed", """The class of the path where alternatives were asked: holes whose cuts it crosses, below 0
        from the other side.""")
    alternatives = told("alternatives", """The cheapest paths of other classes, the cheapest first: a list of
        :class:`Alternative`.""", lambda paths: [Alternative(*figures) for figures in paths])
    holes = told("holes", "The holes that classes name: a dict of their boxes (x, y, x, y).", dict)
    keeping = told("keeping", "What became of the path that was to be kept, as a :class:`KeptRoute`; else None.",
                   KeptRoute._make)
    iterations = told("iterations", """The turns of a planner that gets better, which `iterations=` repeats on any machine;
        None of the others.""")
    ended_by = told("ended_by", '''What ended a planner that gets better: "optimum", "gap", "iterations", "nodes", "caller"
        (`on_improvement` said False), "budget", "memory" or a signal; "goal", "goal_gap", "lattice" or "lattice_gap": the
        best, or near it, to one of several goals, of each leg, or over the lattice. None of the others.''')
    improvements = told("improvements", """Of planners that get better: each path that was the best so far, a list of
        :class:`Improvement`.""", lambda paths: [Improvement(*figures) for figures in paths])
    turn_rad = told("turn_rad", "All turning along the path; nan for bodies that don't turn.")
    planner = told("planner", "Who found it.")
    seed = told("seed", "Of all that was random.")
    robot = told("robot", "The body that was asked about.")
    clearance = told("clearance", "The room that was asked for.")
    start = told("start", "Where the path was to begin.", tuple)
    goal = told("goal", "Where the path was to end.", tuple)
    seconds = told("seconds", "What each stage took.")
    solve_s = told("solve_s", "What all of it took, in seconds.")
    blocked = told("blocked", "Where start or goal is blocked, why, as a :class:`BlockedEnd`; else None.",
                   lambda said: BlockedEnd(**said))
    explained = told("explained", """What it means, as an :class:`Explanation`, where `explain=True` asked for it; else
        None.""", explanation)

    def json(self):
        """The answer as warren.answer/1, byte for byte what `warren solve --json -` prints (but for measured times,
        threads and memory)."""
        return self._core.json

    def to_dict(self):
        """The same, parsed.

        Examples
        --------
        >>> import warren
        >>> warren.solve("maze:5x5").to_dict()["counters"]["samples"]
        25
        """
        return json.loads(self._core.json)

    def sample(self, every=None, **limits):
        """Places along the path as the curve that it is: straight ways, even turns, a car's arcs.

        Parameters
        ----------
        every : float or str, optional
            Places at most so far apart, the path's own among them; or moments, such as "100ms", which need a speed
            (default: the path's own states).
        speed, acceleration, lateral_acceleration : float, optional
            How fast the body may go, in units of length and seconds.
        joint_speed, joint_acceleration : float or sequence of float, optional
            The same for arms, in radians.

        Returns
        -------
        states : ndarray, (k, 2), (k, 3) or (k, 6)
        at : ndarray, (k,)
            How far along the path each is, or with moments when, in seconds.

        Examples
        --------
        >>> import warren
        >>> states, at = warren.solve("maze:5x5").sample(0.5)
        >>> len(states), at[-1]
        (39, 19.0)
        """
        return self._core.sample({"every": every, **limits})

    def save_path(self, file, **how):
        """Writes the path as .csv, .yaml (ROS nav_msgs/Path) or .geojson, by the ending.

        Parameters
        ----------
        file : str or path
        {options}

        Returns
        -------
        dict
            How many places were written, and duration_s (None without a speed).

        Raises
        ------
        ValueError
            Where there is no path.
        UsageError, WriteError
        """
        return self._core.save_path(os.fspath(file), how)

    def save(self, file):
        """Writes :meth:`json`; in place of a file that was there, all of it or nothing.

        Raises
        ------
        WriteError
            Where the file can't be written.
        """
        self._core.save(os.fspath(file))

    def edges(self, *, tree=False):
        """What the planner made, of answers that were asked with `keep=True`.

        Parameters
        ----------
        tree : bool
            What the search reached, instead of the roadmap's edges or the trees' motions.

        Returns
        -------
        ndarray, (n, 2, 2)
            x, y of both ends of each edge; none where nothing was kept.
        """
        return _core.segments_of(self._core, tree)

    def lines(self):
        """Further lines that the planner made, of answers that were asked with `keep=True`: "cells", "visibility",
        "medial_axis" and others, as chains of points (k, 2)."""
        return _core.lines_of(self._core)

    def _drawn(self, kind, look):
        moving = look.pop("moving", False) if kind in ("svg", "html") else False
        return _core.picture_of_answer(self._core, self.world._core, kind, moving, look)

    def _repr_html_(self):
        import html
        return f"<pre>{html.escape(str(self))}</pre>{super()._repr_html_()}"


Answer.save_path = documented(_core.path_keywords(), limits=False)(Answer.save_path)
