# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Sequence
from typing import Any, Literal

from ._roadmaps import Roadmap
from ._worlds import (
    _Diagonal,
    _Doors,
    _Layers,
    _Objective,
    _Path,
    _Planner,
    _Progress,
    _Sampler,
    _State,
    _Steering,
    _World,
)

def build(
    world: _World,
    *,
    index: Literal["auto", "none"] | None = ...,
    planner: _Planner | None = ...,
    sampler: _Sampler | None = ...,
    samples: int | Literal["auto"] | None = ...,
    neighbours: int | Literal["auto", "star"] | None = ...,
    radius: float | Literal["auto", "star"] | None = ...,
    seed: int | None = ...,
    cell: float | None = ...,
    angles: int | None = ...,
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
    via: Sequence[_State] | None = ...,
    steering: _Steering | None = ...,
    turning_radius: float | None = ...,
    attach: float | tuple[float, float] | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
    threads: int | None = ...,
    budget: float | str | None = ...,
    memory: int | str | None = ...,
    progress: _Progress | None = ...,
) -> Roadmap: ...
def open_roadmap(
    file: _Path,
    *,
    world: _World | None = ...,
    threads: int | None = ...,
    budget: float | str | None = ...,
    memory: int | str | None = ...,
    progress: _Progress | None = ...,
) -> Roadmap: ...
def from_bytes(data: bytes, report: dict[str, Any] | None) -> Roadmap: ...
