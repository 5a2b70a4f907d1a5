# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Sequence
from typing import Any, Literal, NamedTuple

from numpy.typing import NDArray

from ._explanations import BlockedEnd, Explanation
from ._pictures import Pictured
from ._worlds import World, _Floats, _Path

class Improvement(NamedTuple):
    iterations: int
    seconds: float
    length: float
    cost: float
    by: str
    lower_bound: float

class Alternative(NamedTuple):
    cost: float
    length: float
    price: dict[str, float]
    min_clearance: float
    passed: tuple[int, ...]
    path: _Floats

class GoalReached(NamedTuple):
    asked: tuple[float, ...]
    distance: float
    distance_bound: float | None

class KeptRoute(NamedTuple):
    kept: bool
    kept_cost: float | None
    new_cost: float | None

class Answer(Pictured):
    world: World
    def __init__(self, core: Any, world: World) -> None: ...
    def __bool__(self) -> bool: ...
    def __array__(self, dtype: Any = ...) -> NDArray[Any]: ...
    def __reduce__(self) -> Any: ...
    @property
    def status(
        self,
    ) -> Literal["solved", "start_blocked", "goal_blocked", "not_connected", "infeasible", "stopped"]: ...
    @property
    def verified(self) -> bool: ...
    @property
    def optimal(self) -> bool: ...
    @property
    def lower_bound(self) -> float: ...
    @property
    def gap(self) -> float: ...
    @property
    def path(self) -> _Floats: ...
    @property
    def length(self) -> float: ...
    @property
    def min_clearance(self) -> float: ...
    @property
    def raw_length(self) -> float: ...
    @property
    def cost(self) -> float: ...
    @property
    def price(self) -> dict[str, float] | None: ...
    @property
    def cost_error(self) -> float: ...
    @property
    def bound_of(self) -> Literal["all", "lattice"] | None: ...
    @property
    def goal_index(self) -> int | None: ...
    @property
    def goal_reached(self) -> GoalReached | None: ...
    @property
    def order(self) -> list[int]: ...
    @property
    def passed(self) -> tuple[int, ...]: ...
    @property
    def alternatives(self) -> list[Alternative]: ...
    @property
    def holes(self) -> dict[int, tuple[float, float, float, float]]: ...
    @property
    def keeping(self) -> KeptRoute | None: ...
    @property
    def iterations(self) -> int | None: ...
    @property
    def ended_by(self) -> str | None: ...
    @property
    def improvements(self) -> list[Improvement]: ...
    @property
    def turn_rad(self) -> float: ...
    @property
    def planner(self) -> str: ...
    @property
    def seed(self) -> int: ...
    @property
    def robot(self) -> str: ...
    @property
    def clearance(self) -> float: ...
    @property
    def start(self) -> tuple[float, ...]: ...
    @property
    def goal(self) -> tuple[float, ...]: ...
    @property
    def seconds(self) -> dict[str, float]: ...
    @property
    def solve_s(self) -> float: ...
    @property
    def blocked(self) -> BlockedEnd | None: ...
    @property
    def explained(self) -> Explanation | None: ...
    def json(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def sample(
        self,
        every: float | str | None = ...,
        *,
        speed: float | None = ...,
        acceleration: float | None = ...,
        lateral_acceleration: float | None = ...,
        joint_speed: float | Sequence[float] | None = ...,
        joint_acceleration: float | Sequence[float] | None = ...,
    ) -> tuple[_Floats, _Floats]: ...
    def save_path(
        self,
        file: _Path,
        *,
        every: float | str | None = ...,
        speed: float | None = ...,
        acceleration: float | None = ...,
        lateral_acceleration: float | None = ...,
        joint_speed: float | Sequence[float] | None = ...,
        joint_acceleration: float | Sequence[float] | None = ...,
        frame: str | None = ...,
    ) -> dict[str, Any]: ...
    def save(self, file: _Path) -> None: ...
    def edges(self, *, tree: bool = ...) -> _Floats: ...
    def lines(self) -> dict[str, list[_Floats]]: ...
    def svg(
        self,
        *,
        moving: bool = ...,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        size: str | None = ...,
        dpi: float | None = ...,
        title: str | None = ...,
    ) -> str: ...
    def html(
        self,
        *,
        moving: bool = ...,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        title: str | None = ...,
    ) -> str: ...
    def save_picture(
        self,
        file: _Path,
        *,
        moving: bool = ...,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        size: str | None = ...,
        dpi: float | None = ...,
        title: str | None = ...,
    ) -> None: ...
    def _repr_html_(self) -> str: ...
