# SPDX-License-Identifier: BSD-3-Clause
"""Worlds read from files, made of arrays and of geometries."""
import json
import os
import tempfile
from collections.abc import Iterable, Mapping
from operator import index

import numpy as np

from . import _core
from ._errors import InputError
from ._options import documented
from ._worlds import World


@documented(_core.reading_keywords())
def read_world(source, **options):
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
    return _read(source, options, False)


def _read(source, options, is_asked):
    name = os.fsdecode(source)
    return World(_core.read_world(os.fsencode(name), options, is_asked), name if name.startswith("maze:") else None)


def example(name):
    """One of the worlds that `warren example` writes.

    Parameters
    ----------
    name : str
        "flat", "parking-lot", "walls" or another; an unknown one is refused with a list of all.

    Returns
    -------
    World

    Raises
    ------
    UsageError

    Examples
    --------
    >>> import warren
    >>> warren.solve(warren.example("parking-lot"), planner="rrt-connect").status
    'solved'
    """
    with tempfile.TemporaryDirectory() as folder:
        return World(_core.example(name, folder))


def maze(rows, cols, *, seed=None, algorithm=None,
         loops=None):
    """A maze from a seed, the same on every machine.

    Parameters
    ----------
    rows, cols : int
        At least 1, fewer than 2^32 cells.
    seed : int, optional
        Default: 1.
    algorithm : {'backtracker', 'kruskal', 'prim', 'wilson', 'course', 'mst'}, optional
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
    name = f"maze:{index(rows)}x{index(cols)}"
    if seed is not None:
        name += f",seed={index(seed)}"
    if algorithm is not None:
        name += f",algorithm={algorithm}"
    if loops is not None:
        name += f",loops={float(loops)!r}"
    return read_world(name)


def grid(cells, cell=1.0, origin=(0.0, 0.0), *, yaw=0.0,
         start=None, goal=None, robot=None,
         clearance=None):
    """A map of cells.

    Parameters
    ----------
    cells : ndarray or lists, (rows, columns) of bool or whole numbers
        What is not 0 is blocked; row 0 is the top, as in images. Floats are taken where all are whole. Of bool and uint8 read where it lies, in any layout.
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
    if isinstance(cells, (list, tuple)) and not any(np.ma.is_masked(row) for row in cells):
        try:
            cells = np.array(cells)
        except ValueError:
            raise TypeError("cells: expected rows of one length") from None
    if not isinstance(cells, np.ndarray):
        raise TypeError(f"cells: expected an array or lists of bool or whole numbers (found: {type(cells).__name__})")
    if cells.dtype.kind == "f":
        broken = np.argwhere(~np.isfinite(cells) | (cells != np.rint(cells)))
        if len(broken):
            at = tuple(int(i) for i in broken[0])
            raise TypeError(f"cells: expected bool or whole numbers (found: {cells[at]} at {at}); say what is blocked, as in "
                            "cells > 0.5")
    if cells.dtype.kind in "fi" or cells.dtype.kind == "u" and cells.itemsize > 1:
        cells = cells != 0
    said = {"start": start, "goal": goal, "robot": robot, "clearance": clearance}
    return World(_core.cells(cells, float(cell), (float(origin[0]), float(origin[1])), float(yaw), said))


def scene(*, walls=None, polygons=None, bounds=None, spheres=None, boxes=None, solids=None,
          maze=None, start=None, goal=None, robot=None,
          clearance=None, source="scene"):
    """A world of walls, polygons, balls, boxes and other solids.

    Parameters
    ----------
    walls : array_like, (n, 4), optional
        x1, y1, x2, y2. An array must be float32 or float64 in C order, or of whole numbers.
    polygons : sequence of array_like, (n, 2), optional
        Simple rings in either direction; their insides are blocked.
    bounds : (float, float, float, float), optional
        xmin, ymin, xmax, ymax: what confines everything.
    spheres : array_like, (n, 4), optional
        x, y, z, radius: for arms.
    boxes : array_like, (n, 6), optional
        xmin, ymin, zmin, xmax, ymax, zmax: for arms.
    solids : sequence of str, optional
        Other solids for arms, as lines of a scene: ``"cylinder 0 0 0 0 0 1 0.2"``, ``"obox ..."``.
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
    parts = {"walls": walls, "polygons": polygons, "bounds": bounds, "spheres": spheres, "boxes": boxes, "solids": solids, "maze": maze,
             "source": source}
    return World(_core.scene(parts, {"start": start, "goal": goal, "robot": robot, "clearance": clearance}))


def _features(geometry):
    if hasattr(geometry, "__geo_interface__"):
        geometry = geometry.__geo_interface__
    if isinstance(geometry, Mapping):
        geometry = dict(geometry)
    elif isinstance(geometry, (str, bytes)) or not isinstance(geometry, Iterable):
        raise TypeError(f"geometry: expected what has a __geo_interface__ (found: {type(geometry).__name__})")
    else:
        return [feature for part in geometry for feature in _features(part)]
    kind = geometry.get("type")
    if kind in ("FeatureCollection", "GeometryCollection"):
        parts = geometry.get("features" if kind == "FeatureCollection" else "geometries")
        if not isinstance(parts, (list, tuple)):
            raise InputError("geometry", f"a {kind} needs a list of its parts")
        return [feature for part in parts for feature in _features(part)]
    return [geometry] if kind == "Feature" else [{"type": "Feature", "properties": {}, "geometry": geometry}]


def from_geo(geometry, *, bounds=None, start=None, goal=None, robot=None,
             clearance=None):
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
    plain = []
    for feature in features:
        role = (feature.get("properties") or {}).get("role")
        plain.append({"type": "Feature", "properties": {} if role is None else {"role": role}, "geometry": feature.get("geometry")})
    text = json.dumps({"type": "FeatureCollection", "features": plain})
    said = {"start": start, "goal": goal, "robot": robot, "clearance": clearance}
    return World(_core.read_text("geometry", text, said))


def as_world(world, robot=None):
    """A world as functions take it: one, the name of one, an array of cells, or geometry; robot: that is asked about."""
    if isinstance(world, World):
        return world
    if isinstance(world, (str, os.PathLike)):
        return _read(world, {"robot": robot}, True)
    if isinstance(world, np.ndarray):
        return grid(world)
    if hasattr(world, "__geo_interface__") or isinstance(world, (dict, list, tuple)):
        return from_geo(world)
    raise TypeError(f"world: expected a World, a name, an array of cells or geometry (found: {type(world).__name__})")
