# SPDX-License-Identifier: BSD-3-Clause
"""Worlds: what they hold as arrays, read from files, made of arrays and geometries."""
import json
import operator
import os
import warnings

from . import _core
from ._options import told
from ._pictures import Pictured


def _row(number):
    kind = type(number).__name__
    if kind in ("bool", "bool_") or not hasattr(number, "__index__"):
        raise TypeError(f"rows: expected whole numbers (found: {kind})")
    return operator.index(number)


class World(Pictured):
    """Where a body may be: a maze, a map of cells, polygons and walls, or an arm's solids.

    Made by :func:`read_world`, :func:`example`, :func:`maze`, :func:`grid`, :func:`scene` and :func:`from_geo`. Never changes; any number
    of threads may use it at once. What its arrays show they don't own: they are read-only and keep the world alive.

    Examples
    --------
    >>> import warren
    >>> world = warren.maze(5, 5)
    >>> world
    <World maze:5x5: 5 x 5 maze, 20 walls>
    >>> world.walls.shape, world.start, world.goal
    ((20, 4), (0.5, 1.0), (5.5, 5.0))
    """

    __slots__ = ("_core", "_name", "__weakref__")
    __module__ = "warren"

    def __init__(self, core, name=None):
        if not isinstance(core, _core.Scene):
            raise TypeError("World: is made by read_world, maze, grid, scene and from_geo")
        self._core = core
        self._name = name  # of a maze that read_world makes of it: all that a pickle needs

    def __repr__(self):
        return f"<World {self.source}: {self._core.description}>"

    def __reduce__(self):
        if self._name is not None:
            from ._making_worlds import read_world
            return read_world, (self._name,)
        return World, (self._core,)

    source = told("source", "The file or name that it comes from.")
    walls = told("walls", "Walls, (n, 4) float32 or float64: x1, y1, x2, y2.")
    polygons = told("polygons", """Polygons, a ring of corners (n, 2) each; those with holes are cut into pieces that
        touch.""")
    cells = told("cells", """Cells of a map, (rows, columns) bool, True where blocked, row 0 at the top; None for other
        worlds. A copy.""")
    raster = told("raster", """Of a map: the side of a cell, x and y of the lower left corner, the turn about it in
        radians.""")
    spheres = told("spheres", "Balls, (n, 4): x, y, z, radius.")
    boxes = told("boxes", "Boxes, (n, 6): the lowest corner, the highest corner.")
    solids = told("solids", "Other solids, a line of a scene each: `obox`, `cylinder`, `capsule`, `hull`.")
    bounds = told("bounds", "The box that confines everything, xmin, ymin, xmax, ymax; None where there is none.")
    box = told("box", "The box of all walls, polygons and cells, xmin, ymin, xmax, ymax.")
    maze = told("maze", "Rows and columns, where all walls lie on the unit grid of a maze.")
    robot = told("robot", "The body that the world is asked about where the question names none.")
    clearance = told("clearance", "The room around the body where the question names none.")
    start = told("start", "Where paths begin that aren't asked to begin elsewhere.",
                 lambda numbers: tuple(numbers) or None)
    goal = told("goal", "Where paths end that aren't asked to end elsewhere.", lambda numbers: tuple(numbers) or None)

    @property
    def hash(self):
        """Sixteen digits: the same for the same free space, whatever file it came from."""
        return self._core.hash()

    def facts(self):
        """What `warren info --json` tells of it.

        Examples
        --------
        >>> import warren
        >>> warren.maze(5, 5).facts()["walls"]
        20
        """
        return json.loads(self._core.facts())

    def without_walls(self, rows):
        """The world without these walls. Its source says that it was changed.

        Parameters
        ----------
        rows : iterable of int
            Rows of :attr:`walls`.

        Raises
        ------
        InputError
            For rows that there aren't, and for maps, whose obstacles are cells.

        Examples
        --------
        >>> import warren
        >>> warren.maze(5, 5).without_walls([17]).walls.shape
        (19, 4)
        """
        return World(self._core.with_other_walls([_row(row) for row in rows], None))

    def with_walls(self, walls):
        """The world with these walls, too. Its source says that it was changed.

        Parameters
        ----------
        walls : array_like, (n, 4)
            x1, y1, x2, y2; of a maze on its unit grid.

        Raises
        ------
        InputError
            For walls off the grid of a maze, and for maps, whose obstacles are cells.
        """
        return World(self._core.with_other_walls([], walls))

    def save(self, file, *, cell=None):
        """Writes the world by the ending of the file: .scene, .walls, .npy, .maze, .geojson, .wkt; maps .map, .yaml, .pgm,
        .png.

        Of a map, formats of walls get the borders of its cells. What the format has no words for (ends, body and
        clearance; a map's place and unknown cells) is left out with a warning.

        Parameters
        ----------
        file : str or path
        cell : float, optional
            Side of a cell where walls become a map.

        Raises
        ------
        UsageError
            For other endings, and where a map needs its cell.
        InputError
            For obstacles that the format can't hold.
        WriteError
            Where the file can't be written.
        """
        path = os.fspath(file)
        if lost := self._core.write(os.fsencode(path), None if cell is None else float(cell)):
            warnings.warn(f"{path}: its format has no {', '.join(lost)}: left out", stacklevel=2)

    def _drawn(self, kind, look):
        return _core.picture_of_world(self._core, kind, look)
