# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, Literal

from ._roadmaps import Roadmap
from ._solving import _Areas
from ._worlds import (
    _Doors,
    _Objective,
    _Path,
    _Progress,
    _Sampler,
    _Steering,
    _World,
)

def build(
    world: _World,
    *,
    index: Literal["auto", "none"] | None = ...,
    planner: Literal["prm", "lazy-prm", "visibility", "cells", "voronoi"] | None = ...,
    sampler: _Sampler | None = ...,
    samples: int | Literal["auto"] | None = ...,
    neighbours: int | Literal["auto", "star"] | None = ...,
    radius: float | Literal["auto", "star"] | None = ...,
    seed: int | None = ...,
    full: bool | None = ...,
    doors: _Doors | None = ...,
    objective: _Objective | None = ...,
    steering: _Steering | None = ...,
    turning_radius: float | None = ...,
    attach: float | tuple[float, float] | None = ...,
    robot: str | None = ...,
    clearance: float | None = ...,
    clearance_price: float | tuple[float, float] | str | None = ...,
    area: _Areas | None = ...,
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
