# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Sequence
from typing import Any, Literal

from numpy.typing import NDArray

from ._solving import _Areas, _Masks
from ._worlds import _Listed, _Planner, _Progress, _State, _World

class Comparison(dict[str, NDArray[Any]]):
    table: dict[str, NDArray[Any]]
    def __init__(self, core: Any) -> None: ...
    def json(self) -> str: ...
    def curves_csv(self) -> str: ...
    def svg(self) -> str: ...
    def _repr_svg_(self) -> str: ...
    def _repr_html_(self) -> str: ...

def compare(
    world: _World | None = ...,
    *,
    planners: _Listed = ...,
    searches: _Listed = ...,
    queues: _Listed = ...,
    trials: int | Literal["auto"] | None = ...,
    peer: Literal["boost"] | None = ...,
    graph: _Planner | None = ...,
    sizes: _Listed = ...,
    degree: float | None = ...,
    seeds: int | None = ...,
    samplers: _Listed = ...,
    samples: _Listed = ...,
    seed: int | None = ...,
    parallel: bool | None = ...,
    sampler: _Listed = ...,
    neighbours: _Listed = ...,
    radius: _Listed = ...,
    neighbour_index: _Listed = ...,
    search: _Listed = ...,
    heuristic: _Listed = ...,
    queue: _Listed = ...,
    lazy: _Listed = ...,
    pipeline: _Listed = ...,
    optimise: bool | None = ...,
    cell: _Listed = ...,
    angles: _Listed = ...,
    headings: _Listed = ...,
    face_motion: bool | None = ...,
    step_cost: _Listed = ...,
    turn_cost: _Listed = ...,
    diagonal: _Listed = ...,
    layers: _Listed = ...,
    full: bool | None = ...,
    sampled_edges: _Listed = ...,
    doors: _Listed = ...,
    objective: _Listed = ...,
    step: _Listed = ...,
    goal_bias: _Listed = ...,
    nodes: _Listed = ...,
    trees: _Listed = ...,
    iterations: int | None = ...,
    gap: float | str | None = ...,
    parts: str | Sequence[str] | None = ...,
    bound: bool | None = ...,
    via: Sequence[_State] | None = ...,
    steering: _Listed = ...,
    turning_radius: _Listed = ...,
    cusp_cost: _Listed = ...,
    reverse_cost: _Listed = ...,
    attach: _Listed = ...,
    robot: str | None = ...,
    start: _State | None = ...,
    goal: _State | None = ...,
    goal_pose: _State | None = ...,
    clearance: _Listed = ...,
    contact: _Listed = ...,
    clearance_price: float | tuple[float, float] | str | None = ...,
    area: _Areas | None = ...,
    areas: _Masks | _Areas | None = ...,
    speed_zones: _Masks | None = ...,
    keep_out: _Masks | None = ...,
    unknown: float | Literal["blocked"] | None = ...,
    budget: float | str | None = ...,
    threads: int | None = ...,
    memory: int | str | None = ...,
    progress: _Progress | None = ...,
) -> Comparison: ...
