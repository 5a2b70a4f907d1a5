# SPDX-License-Identifier: BSD-3-Clause
"""Worlds: what they hold as arrays, read from files, made of arrays and geometries."""
from __future__ import annotations

import json
import os
from typing import Any, Dict, List, Optional, Tuple

import numpy as np

from . import _core
from ._options import documented


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

    def __init__(self, core: Any) -> None:
        if not isinstance(core, _core.Scene):
            raise TypeError("World: is made by read_world, maze, grid, scene and from_geo")
        self._core = core

    def __repr__(self) -> str:
        return f"<World {self.source}: {self._core.description}>"

    def __reduce__(self) -> Any:
        if self.source.startswith("maze:") and " " not in self.source:
            return read_world, (self.source,)
        return World, (self._core,)

    @property
    def source(self) -> str:
        """The file or name that it comes from."""
        return self._core.source

    @property
    def walls(self) -> np.ndarray[Any, Any]:
        """Walls, (n, 4) float32 or float64: x1, y1, x2, y2."""
        return self._core.walls

    @property
    def polygons(self) -> List[np.ndarray[Any, Any]]:
        """Polygons, a ring of corners (n, 2) each; those with holes are cut into pieces that touch."""
        return self._core.polygons

    @property
    def cells(self) -> Optional[np.ndarray[Any, Any]]:
        """Cells of a map, (rows, columns) bool, True where blocked, row 0 at the top; None for other worlds. A copy."""
        return self._core.cells

    @property
    def raster(self) -> Optional[Tuple[float, float, float, float]]:
        """Of a map: the side of a cell, x and y of the lower left corner, the turn about it in radians."""
        return self._core.raster

    @property
    def spheres(self) -> np.ndarray[Any, Any]:
        """Balls, (n, 4): x, y, z, radius."""
        return self._core.spheres

    @property
    def boxes(self) -> np.ndarray[Any, Any]:
        """Boxes, (n, 6): the lowest corner, the highest corner."""
        return self._core.boxes

    @property
    def bounds(self) -> Optional[Tuple[float, float, float, float]]:
        """The box that confines everything, xmin, ymin, xmax, ymax; None where there is none."""
        return self._core.bounds

    @property
    def box(self) -> Optional[Tuple[float, float, float, float]]:
        """The box of all walls, polygons and cells, xmin, ymin, xmax, ymax."""
        return self._core.box

    @property
    def maze(self) -> Optional[Tuple[int, int]]:
        """Rows and columns, where all walls lie on the unit grid of a maze."""
        return self._core.maze

    @property
    def robot(self) -> Optional[str]:
        """The body that the world is asked about where the question names none."""
        return self._core.robot

    @property
    def clearance(self) -> Optional[float]:
        """The room around the body where the question names none."""
        return self._core.clearance

    @property
    def start(self) -> Optional[Tuple[float, ...]]:
        """Where paths begin that aren't asked to begin elsewhere."""
        return tuple(self._core.start) or None

    @property
    def goal(self) -> Optional[Tuple[float, ...]]:
        """Where paths end that aren't asked to end elsewhere."""
        return tuple(self._core.goal) or None

    @property
    def hash(self) -> str:
        """Sixteen digits: the same for the same free space, whatever file it came from."""
        return self._core.hash()

    def facts(self) -> Dict[str, Any]:
        """What `warren info --json` tells of it.

        Examples
        --------
        >>> import warren
        >>> warren.maze(5, 5).facts()["walls"]
        20
        """
        facts: Dict[str, Any] = json.loads(self._core.facts())
        return facts

    def without_walls(self, rows: Any) -> World:
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

    def with_walls(self, walls: Any) -> World:
        """The world with these walls, too.

        Parameters
        ----------
        walls : array_like, (n, 4)
            x1, y1, x2, y2; of a maze on its unit grid.
        """
        return World(self._core.with_other_walls([], walls))

    def save(self, file: str | os.PathLike[str]) -> None:
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

    def svg(self) -> str:
        """The world as an SVG document."""
        return _core.picture_of_world(self._core, "svg").decode()  # type: ignore[no-any-return]

    def html(self) -> str:
        """The world as a page of its own: drag moves, the wheel zooms."""
        return _core.picture_of_world(self._core, "html").decode()  # type: ignore[no-any-return]

    def png(self) -> bytes:
        """The world as a PNG image."""
        return _core.picture_of_world(self._core, "png")  # type: ignore[no-any-return]

    def _repr_svg_(self) -> str:
        return self.svg()


@documented(_core.reading_keywords())
def read_world(source: str | os.PathLike[str], **options: Any) -> World:
    """Reads a world from a file of any format, or makes the maze of a name.

    Parameters
    ----------
    source : str or path
        A file (docs/file_formats.md; its content says what it is), or "maze:ROWSxCOLS[,seed=N][,algorithm=NAME]
        [,loops=F]".
    {options}

    Returns
    -------
    World

    Raises
    ------
    ReadError, InputError, UsageError, Stopped

    Examples
    --------
    >>> import warren
    >>> warren.read_world("maze:41x41,seed=7,loops=0.05").maze
    (41, 41)
    """
    return World(_core.read_world(os.fspath(source), options))


def maze(rows: int, cols: int, *, seed: Optional[int] = None, algorithm: Optional[str] = None,
         loops: Optional[float] = None) -> World:
    """A maze from a seed, the same on every machine.

    Parameters
    ----------
    rows, cols : int
        At least 1, fewer than 2^32 cells.
    seed : int, optional
        Default: 1.
    algorithm : {'backtracker', 'kruskal', 'prim', 'wilson', 'course'}, optional
        Default: backtracker.
    loops : float, optional
        The share, 0 to 1, of the interior walls left that are taken out (default: 0, exactly one way between any two
        cells).

    Returns
    -------
    World
        Its :attr:`~World.source` is the name that the program knows it by.

    Examples
    --------
    >>> import warren
    >>> warren.maze(41, 41, seed=7, loops=0.05).source
    'maze:41x41,seed=7,loops=0.05'
    """
    name = f"maze:{int(rows)}x{int(cols)}"
    if seed is not None:
        name += f",seed={int(seed)}"
    if algorithm is not None:
        name += f",algorithm={algorithm}"
    if loops is not None:
        name += f",loops={float(loops)!r}"
    return read_world(name)


def grid(cells: Any, cell: float = 1.0, origin: Tuple[float, float] = (0.0, 0.0), *, yaw: float = 0.0,
         start: Any = None, goal: Any = None, robot: Optional[str] = None,
         clearance: Optional[float] = None) -> World:
    """A map of cells.

    Parameters
    ----------
    cells : ndarray, (rows, columns) of bool or uint8
        What is not 0 is blocked; row 0 is the top, as in images. Read where it lies, in any layout.
    cell : float
        Side of a cell, in world units.
    origin : (float, float)
        Lower left corner of the map.
    yaw : float
        The map is turned about that corner, anticlockwise, in radians.
    start, goal : sequence of float, optional
        Where paths begin and end that aren't asked otherwise.
    robot : str, optional
        The body, as :func:`disc` and its like give it.
    clearance : float, optional
        Room around the body.

    Returns
    -------
    World

    Raises
    ------
    TypeError
        For cells of another type or shape.

    Examples
    --------
    >>> import numpy as np, warren
    >>> cells = np.zeros((60, 80), bool)
    >>> cells[20:, 40] = True
    >>> answer = warren.solve(warren.grid(cells, 0.05), (0.5, 0.5), (3.5, 0.5))
    >>> answer.status, round(answer.length, 2)
    ('solved', 4.37)
    """
    if not isinstance(cells, np.ndarray):
        raise TypeError(f"cells: expected an array of bool or uint8 (found: {type(cells).__name__})")
    said = {"start": start, "goal": goal, "robot": robot, "clearance": clearance}
    return World(_core.cells(cells, float(cell), (float(origin[0]), float(origin[1])), float(yaw), said))


def scene(*, walls: Any = None, polygons: Any = None, bounds: Any = None, spheres: Any = None, boxes: Any = None,
          maze: Optional[Tuple[int, int]] = None, start: Any = None, goal: Any = None, robot: Optional[str] = None,
          clearance: Optional[float] = None, source: str = "scene") -> World:
    """A world of walls, polygons, balls and boxes.

    Parameters
    ----------
    walls : array_like, (n, 4), optional
        x1, y1, x2, y2. An array must be float32 or float64 in C order.
    polygons : sequence of array_like, (n, 2), optional
        Simple rings in either direction; their insides are blocked.
    bounds : (float, float, float, float), optional
        xmin, ymin, xmax, ymax: what confines everything.
    spheres : array_like, (n, 4), optional
        x, y, z, radius: for arms.
    boxes : array_like, (n, 6), optional
        xmin, ymin, zmin, xmax, ymax, zmax: for arms.
    maze : (int, int), optional
        Rows and columns, where all walls lie on the unit grid of a maze.
    start, goal : sequence of float, optional
        Where paths begin and end that aren't asked otherwise.
    robot : str, optional
        The body, as :func:`disc` and its like give it.
    clearance : float, optional
        Room around the body.
    source : str
        The name that answers give the world.

    Returns
    -------
    World

    Raises
    ------
    TypeError
        For arrays of another type or shape.
    InputError
        For numbers that aren't finite, polygons that aren't simple.

    Examples
    --------
    >>> import warren
    >>> world = warren.scene(polygons=[[(0, 0), (2, 0), (1, 2)]], walls=[(3, 0, 3, 5)], bounds=(-1, -1, 9, 9))
    >>> answer = warren.solve(world, (0, 5), (8, 5))
    >>> answer.optimal, round(answer.length, 3)
    (True, 8.0)
    """
    parts = {"walls": walls, "polygons": polygons, "bounds": bounds, "spheres": spheres, "boxes": boxes, "maze": maze,
             "source": source}
    return World(_core.scene(parts, {"start": start, "goal": goal, "robot": robot, "clearance": clearance}))


def _features(geometry: Any) -> List[Dict[str, Any]]:
    if hasattr(geometry, "__geo_interface__"):
        geometry = geometry.__geo_interface__
    if not isinstance(geometry, dict):
        return [feature for part in geometry for feature in _features(part)]
    kind = geometry.get("type")
    if kind == "FeatureCollection":
        return list(geometry["features"])
    if kind == "GeometryCollection":
        return [feature for part in geometry["geometries"] for feature in _features(part)]
    return [geometry] if kind == "Feature" else [{"type": "Feature", "properties": {}, "geometry": geometry}]


def from_geo(geometry: Any, *, bounds: Any = None, start: Any = None, goal: Any = None, robot: Optional[str] = None,
             clearance: Optional[float] = None) -> World:
    """A world of what has a `__geo_interface__`: geometries of shapely, frames of geopandas, GeoJSON's dictionaries.

    Polygons, with holes or without, are obstacles, lines are walls; a feature whose properties have a "role" is a start,
    a goal or the bounds.

    Parameters
    ----------
    geometry : object, mapping, or sequence of these
        What has a `__geo_interface__`, or is one.
    bounds : (float, float, float, float), optional
        xmin, ymin, xmax, ymax: what confines everything.
    start, goal : sequence of float, optional
        Where paths begin and end that aren't asked otherwise.
    robot : str, optional
        The body, as :func:`disc` and its like give it.
    clearance : float, optional
        Room around the body.

    Returns
    -------
    World

    Examples
    --------
    >>> import warren
    >>> block = {"type": "Polygon", "coordinates": [[(2, 0), (4, 0), (4, 3), (2, 3), (2, 0)]]}
    >>> world = warren.from_geo(block, bounds=(-1, -1, 7, 4))
    >>> round(warren.solve(world, (0, 1), (6, 1)).length, 3)
    6.472
    """
    features = _features(geometry)
    if bounds is not None:
        x0, y0, x1, y1 = (float(x) for x in bounds)
        ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]
        features.append({"type": "Feature", "properties": {"role": "bounds"},
                         "geometry": {"type": "Polygon", "coordinates": [ring]}})
    plain = [{"type": "Feature", "properties": {"role": (feature.get("properties") or {}).get("role")},
              "geometry": feature.get("geometry")} for feature in features]
    for feature in plain:
        if feature["properties"]["role"] is None:
            feature["properties"] = {}
    text = json.dumps({"type": "FeatureCollection", "features": plain})
    said = {"start": start, "goal": goal, "robot": robot, "clearance": clearance}
    return World(_core.read_text("geometry", text, said))


def as_world(world: Any) -> World:
    """A world as functions take it: one, the name of one, an array of cells, or geometry."""
    if isinstance(world, World):
        return world
    if isinstance(world, (str, os.PathLike)):
        return read_world(world)
    if isinstance(world, np.ndarray):
        return grid(world)
    if hasattr(world, "__geo_interface__") or isinstance(world, dict):
        return from_geo(world)
    raise TypeError(f"world: expected a World, a name, an array of cells or geometry (found: {type(world).__name__})")
