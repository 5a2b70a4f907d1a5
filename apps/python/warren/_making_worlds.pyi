# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

from numpy.typing import ArrayLike

from ._worlds import World, _Box, _Geo, _Path, _Progress, _State, _World

def read_world(
    source: _Path,
    *,
    map_rules: Literal["nav2", "ros1"] | None = ...,
    request: _Path | None = ...,
    robot: str | None = ...,
    threads: int | None = ...,
    budget: float | str | None = ...,
    memory: int | str | None = ...,
    progress: _Progress | None = ...,
) -> World: ...
def example(name: str) -> World: ...
def maze(
    rows: int,
    cols: int,
    *,
    seed: int | None = ...,
    algorithm: Literal["backtracker", "kruskal", "prim", "wilson", "course", "mst"] | None = ...,
    loops: float | None = ...,
) -> World: ...
def grid(
    cells: ArrayLike,
    cell: float = ...,
    origin: tuple[float, float] = ...,
    *,
    yaw: float = ...,
    start: _State | None = ...,
    goal: _State | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
) -> World: ...
def scene(
    *,
    walls: ArrayLike | None = ...,
    polygons: Iterable[ArrayLike] | None = ...,
    bounds: _Box | None = ...,
    spheres: ArrayLike | None = ...,
    boxes: ArrayLike | None = ...,
    solids: Sequence[str] | None = ...,
    maze: tuple[int, int] | None = ...,
    start: _State | None = ...,
    goal: _State | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
    source: str = ...,
) -> World: ...
def from_geo(
    geometry: _Geo | Mapping[str, Any] | Iterable[_Geo | Mapping[str, Any]],
    *,
    bounds: _Box | None = ...,
    start: _State | None = ...,
    goal: _State | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
) -> World: ...
def as_world(world: _World, robot: str | None = ...) -> World: ...
