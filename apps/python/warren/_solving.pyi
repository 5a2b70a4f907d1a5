# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, NamedTuple

from numpy.typing import ArrayLike

from ._answers import Answer, Improvement
from ._explanations import NarrowPlace
from ._worlds import (
    World,
    _Contact,
    _Diagonal,
    _Doors,
    _Heuristic,
    _Layers,
    _Objective,
    _Path,
    _Pipeline,
    _Planner,
    _Progress,
    _Queue,
    _Sampler,
    _Search,
    _State,
    _Steering,
    _World,
)

_Polygon = ArrayLike | Sequence[Sequence[float]]
_Areas = tuple[float, _Polygon] | Sequence[tuple[float, _Polygon]] | str | Sequence[str]
_Masks = _Path | tuple[_Path, float] | tuple[_Path, float, float] | Sequence[_Path | tuple[_Path, float] | tuple[_Path, float, float]]

class Replanner:
    def __init__(self, world: _World, start: _State | None = ..., goal: _State | None = ..., **options: Any) -> None: ...
    def update(self, cells: Iterable[tuple[int, int]] | None = ..., *, box: Sequence[float] | None = ..., blocked: bool = ...) -> None: ...
    def solve(self, start: _State | None = ..., **limits: Any) -> Answer: ...
    @property
    def world(self) -> World: ...

class Verdict(NamedTuple):
    verified: bool
    length: float
    min_clearance: float
    violation: tuple[int, float, str] | None
    narrowest: NarrowPlace | None = ...
    def __bool__(self) -> bool: ...

def solve(
    world: _World,
    start: _State | None = ...,
    goal: _State | None = ...,
    *,
    goal_pose: _State | None = ...,
    keep: bool = ...,
    explain: bool = ...,
    on_improvement: Callable[[Improvement], bool | None] | None = ...,
    planner: _Planner | None = ...,
    sampler: _Sampler | None = ...,
    samples: int | Literal["auto"] | None = ...,
    neighbours: int | Literal["auto", "star"] | None = ...,
    radius: float | Literal["auto", "star"] | None = ...,
    neighbour_index: Literal["auto", "kd-tree", "grid", "brute"] | None = ...,
    search: _Search | None = ...,
    heuristic: _Heuristic | None = ...,
    queue: _Queue | None = ...,
    lazy: bool | Literal["expansion"] | None = ...,
    pipeline: _Pipeline | None = ...,
    optimise: bool | None = ...,
    seed: int | None = ...,
    cell: float | None = ...,
    angles: int | None = ...,
    headings: int | None = ...,
    face_motion: bool | None = ...,
    step_cost: float | None = ...,
    turn_cost: float | None = ...,
    diagonal: _Diagonal | None = ...,
    layers: _Layers | None = ...,
    full: bool | None = ...,
    sampled_edges: float | None = ...,
    doors: _Doors | None = ...,
    objective: _Objective | None = ...,
    step: float | None = ...,
    goal_bias: float | None = ...,
    nodes: int | None = ...,
    trees: int | None = ...,
    iterations: int | None = ...,
    gap: float | str | None = ...,
    parts: str | Sequence[str] | None = ...,
    bound: bool | None = ...,
    via: Sequence[_State] | None = ...,
    steering: _Steering | None = ...,
    turning_radius: float | None = ...,
    cusp_cost: float | None = ...,
    reverse_cost: float | None = ...,
    attach: float | tuple[float, float] | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
    contact: _Contact | None = ...,
    clearance_price: float | tuple[float, float] | str | None = ...,
    area: _Areas | None = ...,
    areas: _Masks | _Areas | None = ...,
    speed_zones: _Masks | None = ...,
    keep_out: _Masks | None = ...,
    unknown: float | Literal["blocked"] | None = ...,
    goals: Sequence[_State] | None = ...,
    goal_tolerance: float | tuple[float, float] | str | None = ...,
    tolerance: float | tuple[float, float] | str | None = ...,
    goal_region: float | tuple[float, float] | str | None = ...,
    region: float | tuple[float, float] | str | None = ...,
    visit: Sequence[_State] | str | None = ...,
    return_: bool | None = ...,
    alternatives: int | tuple[int, float] | str | None = ...,
    hole: float | None = ...,
    stretch: float | None = ...,
    keep_to: Answer | _Path | None = ...,
    unless_gain: float | str | None = ...,
    certificate: _Path | None = ...,
    threads: int | None = ...,
    budget: float | str | None = ...,
    memory: int | str | None = ...,
    progress: _Progress | None = ...,
) -> Answer: ...
def verify(
    world: _World,
    path: Answer | ArrayLike | _Path,
    *,
    start: _State | None = ...,
    goal: _State | None = ...,
    goal_pose: _State | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
    contact: _Contact | None = ...,
    clearance_price: float | tuple[float, float] | str | None = ...,
    area: _Areas | None = ...,
    areas: _Masks | _Areas | None = ...,
    speed_zones: _Masks | None = ...,
    keep_out: _Masks | None = ...,
    unknown: float | Literal["blocked"] | None = ...,
    goals: Sequence[_State] | None = ...,
    goal_tolerance: float | tuple[float, float] | str | None = ...,
    tolerance: float | tuple[float, float] | str | None = ...,
    goal_region: float | tuple[float, float] | str | None = ...,
    region: float | tuple[float, float] | str | None = ...,
    visit: Sequence[_State] | str | None = ...,
    return_: bool | None = ...,
    certificate: _Path | None = ...,
    explain: bool | None = ...,
    threads: int | None = ...,
    budget: float | str | None = ...,
    memory: int | str | None = ...,
    progress: _Progress | None = ...,
) -> Verdict: ...
def finished(core: Any, world: World) -> Answer: ...
