# SPDX-License-Identifier: BSD-3-Clause
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, Protocol, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import TypeAlias

from ._pictures import Pictured

class _Geo(Protocol):
    @property
    def __geo_interface__(self) -> Mapping[str, Any]: ...

_Planner: TypeAlias = Literal[
    "prm", "lazy-prm", "visibility", "cells", "voronoi", "rrt", "rrt-connect", "grid", "rrt-star", "informed-rrt-star", "anytime"
]
_Sampler: TypeAlias = Literal[
    "uniform", "lattice", "halton", "random", "gaussian", "bridge", "mixture", "corridor", "cell-centres"
]
_Search: TypeAlias = Literal["astar", "dijkstra", "bfs", "dfs"]
_Heuristic: TypeAlias = Literal["euclidean", "manhattan", "octile", "chebyshev", "zero"]
_Queue: TypeAlias = Literal["heap", "lazy-heap", "sorted-array", "resorted-array"]
_Pipeline: TypeAlias = Literal["plain", "tiled", "streamed"]
_Diagonal: TypeAlias = Literal["sqrt2", "unit", "none"]
_Layers: TypeAlias = Literal["exact", "report004"]
_Doors: TypeAlias = Literal["midpoint", "funnel"]
_Objective: TypeAlias = Literal["length", "clearance"]
_Steering: TypeAlias = Literal["dubins", "reeds-shepp", "differential"]
_Contact: TypeAlias = Literal["blocked", "allowed"]
_Path: TypeAlias = Union[str, os.PathLike[str]]
_State: TypeAlias = Union[Sequence[float], NDArray[Any]]
_World: TypeAlias = Union[
    "World", _Path, NDArray[Any], _Geo, Mapping[str, Any], Sequence[Union[_Geo, Mapping[str, Any]]]
]
_Box: TypeAlias = Union[tuple[float, float, float, float], Sequence[float], NDArray[Any]]
_Progress: TypeAlias = Callable[[str, int, int], object]
_Listed: TypeAlias = Union[str, float, Sequence[Union[str, float]], None]
_Floats: TypeAlias = NDArray[np.float64]

class World(Pictured):
    def __init__(self, core: Any, name: str | None = ...) -> None: ...
    def __reduce__(self) -> Any: ...
    @property
    def source(self) -> str: ...
    @property
    def walls(self) -> NDArray[np.floating[Any]]: ...
    @property
    def polygons(self) -> list[_Floats]: ...
    @property
    def cells(self) -> NDArray[np.bool_] | None: ...
    @property
    def raster(self) -> tuple[float, float, float, float] | None: ...
    @property
    def spheres(self) -> _Floats: ...
    @property
    def boxes(self) -> _Floats: ...
    @property
    def solids(self) -> list[str]: ...
    @property
    def bounds(self) -> tuple[float, float, float, float] | None: ...
    @property
    def box(self) -> tuple[float, float, float, float] | None: ...
    @property
    def maze(self) -> tuple[int, int] | None: ...
    @property
    def robot(self) -> str | None: ...
    @property
    def clearance(self) -> float | None: ...
    @property
    def start(self) -> tuple[float, ...] | None: ...
    @property
    def goal(self) -> tuple[float, ...] | None: ...
    @property
    def hash(self) -> str: ...
    def facts(self) -> dict[str, Any]: ...
    def without_walls(self, rows: Iterable[int]) -> World: ...
    def with_walls(self, walls: ArrayLike) -> World: ...
    def save(self, file: _Path, *, cell: float | None = ...) -> None: ...
