# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import Answer
from ._pictures import Pictured
from ._worlds import World, _Floats, _Heuristic, _Path, _Progress, _Queue, _Search, _State, _World

class EdgeCounts(NamedTuple):
    free: int
    blocked: int
    unchecked: int

class Roadmap(Pictured):
    report: dict[str, Any] | None
    def __init__(self, core: Any, report: dict[str, Any] | None = ...) -> None: ...
    def __len__(self) -> int: ...
    def __reduce__(self) -> Any: ...
    @property
    def world(self) -> World: ...
    @property
    def robot(self) -> str: ...
    @property
    def clearance(self) -> float: ...
    @property
    def planner(self) -> str | None: ...
    @property
    def seed(self) -> int: ...
    @property
    def directed(self) -> bool: ...
    @property
    def states(self) -> _Floats: ...
    @property
    def components(self) -> NDArray[np.uint32]: ...
    @property
    def edge_states(self) -> NDArray[np.uint8]: ...
    @property
    def edges(self) -> EdgeCounts: ...
    def query(
        self,
        start: _State | None = ...,
        goal: _State | None = ...,
        *,
        keep: bool = ...,
        explain: bool = ...,
        search: _Search | None = ...,
        heuristic: _Heuristic | None = ...,
        queue: _Queue | None = ...,
        optimise: bool | None = ...,
        cusp_cost: float | None = ...,
        reverse_cost: float | None = ...,
        bound: bool | None = ...,
        attach: float | tuple[float, float] | None = ...,
        threads: int | None = ...,
        budget: float | str | None = ...,
        memory: int | str | None = ...,
        progress: _Progress | None = ...,
    ) -> Answer: ...
    def lengths(
        self,
        starts: ArrayLike,
        goals: ArrayLike,
        *,
        search: _Search | None = ...,
        heuristic: _Heuristic | None = ...,
        queue: _Queue | None = ...,
        optimise: bool | None = ...,
        cusp_cost: float | None = ...,
        reverse_cost: float | None = ...,
        attach: float | tuple[float, float] | None = ...,
        threads: int | None = ...,
        budget: float | str | None = ...,
        memory: int | str | None = ...,
        progress: _Progress | None = ...,
    ) -> _Floats: ...
    def matrix(
        self,
        starts: ArrayLike,
        goals: ArrayLike,
        *,
        search: _Search | None = ...,
        heuristic: _Heuristic | None = ...,
        queue: _Queue | None = ...,
        optimise: bool | None = ...,
        cusp_cost: float | None = ...,
        reverse_cost: float | None = ...,
        attach: float | tuple[float, float] | None = ...,
        threads: int | None = ...,
        budget: float | str | None = ...,
        memory: int | str | None = ...,
        progress: _Progress | None = ...,
    ) -> _Floats: ...
    def learn(self) -> None: ...
    def update(
        self,
        world: _World,
        *,
        threads: int | None = ...,
        budget: float | str | None = ...,
        memory: int | str | None = ...,
        progress: _Progress | None = ...,
    ) -> Roadmap: ...
    def save(self, file: _Path, *, world: bool = ...) -> None: ...
    def export(self, file: _Path, *, unchecked: bool = ..., frame: str = ...) -> dict[str, int]: ...
    def csr(self, *, unchecked: bool = ...) -> tuple[NDArray[np.int32], NDArray[np.int32], _Floats]: ...
    def to_scipy(self, *, unchecked: bool = ...) -> Any: ...
