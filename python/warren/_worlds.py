# SPDX-License-Identifier: BSD-3-Clause
"""Worlds: what they hold as arrays, read from files, made of arrays and geometries."""
import json
import os

from . import _core


class World:
    """Where a body may be: a maze, a map of cells, polygons and walls, or an arm's solids.

    Made by :func:`read_world`, :func:`maze`, :func:`grid`, :func:`scene` and :func:`from_geo`. Never changes; any number
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

    __slots__ = ("_core", "__weakref__")
    __module__ = "warren"

    def __init__(self, core):
        if not isinstance(core, _core.Scene):
            raise TypeError("World: is made by read_world, maze, grid, scene and from_geo")
        self._core = core

    def __repr__(self):
        return f"<World {self.source}: {self._core.description}>"

    def __reduce__(self):
        if self.source.startswith("maze:") and " " not in self.source:
            from ._making_worlds import read_world
            return read_world, (self.source,)
        return World, (self._core,)

    @property
    def source(self):
        """The file or name that it comes from."""
        return self._core.source

    @property
    def walls(self):
        """Walls, (n, 4) float32 or float64: x1, y1, x2, y2."""
        return self._core.walls

    @property
    def polygons(self):
        """Polygons, a ring of corners (n, 2) each; those with holes are cut into pieces that touch."""
        return self._core.polygons

    @property
    def cells(self):
        """Cells of a map, (rows, columns) bool, True where blocked, row 0 at the top; None for other worlds. A copy."""
        return self._core.cells

    @property
    def raster(self):
        """Of a map: the side of a cell, x and y of the lower left corner, the turn about it in radians."""
        return self._core.raster

    @property
    def spheres(self):
        """Balls, (n, 4): x, y, z, radius."""
        return self._core.spheres

    @property
    def boxes(self):
        """Boxes, (n, 6): the lowest corner, the highest corner."""
        return self._core.boxes

    @property
    def bounds(self):
        """The box that confines everything, xmin, ymin, xmax, ymax; None where there is none."""
        return self._core.bounds

    @property
    def box(self):
        """The box of all walls, polygons and cells, xmin, ymin, xmax, ymax."""
        return self._core.box

    @property
    def maze(self):
        """Rows and columns, where all walls lie on the unit grid of a maze."""
        return self._core.maze

    @property
    def robot(self):
        """The body that the world is asked about where the question names none."""
        return self._core.robot

    @property
    def clearance(self):
        """The room around the body where the question names none."""
        return self._core.clearance

    @property
    def start(self):
        """Where paths begin that aren't asked to begin elsewhere."""
        return tuple(self._core.start) or None

    @property
    def goal(self):
        """Where paths end that aren't asked to end elsewhere."""
        return tuple(self._core.goal) or None

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
        facts = json.loads(self._core.facts())
        return facts

    def without_walls(self, rows):
        """The world without these walls.

        Parameters
        ----------
        rows : sequence of int
            Rows of :attr:`walls`.

        Examples
        --------
        >>> import warren
        >>> warren.maze(5, 5).without_walls([17]).walls.shape
        (19, 4)
        """
        return World(self._core.with_other_walls([int(row) for row in rows], None))

    def with_walls(self, walls):
        """The world with these walls, too.

        Parameters
        ----------
        walls : array_like, (n, 4)
            x1, y1, x2, y2; of a maze on its unit grid.
        """
        return World(self._core.with_other_walls([], walls))

    def save(self, file):
        """Writes the world by the ending of the file: .scene, .walls, .npy, .geojson, .wkt; maps .map, .yaml, .pgm, .png.

        Raises
        ------
        UsageError
            For other endings.
        InputError
            For what the format can't hold.
        WriteError
            Where the file can't be written.
        """
        self._core.write(os.fspath(file))

    def svg(self):
        """The world as an SVG document."""
        return _core.picture_of_world(self._core, "svg").decode()

    def html(self):
        """The world as a page of its own: drag moves, the wheel zooms."""
        return _core.picture_of_world(self._core, "html").decode()

    def png(self):
        """The world as a PNG image."""
        return _core.picture_of_world(self._core, "png")

    def _repr_svg_(self):
        return self.svg()
