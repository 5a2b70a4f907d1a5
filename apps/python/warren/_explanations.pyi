# SPDX-License-Identifier: BSD-3-Clause
from typing import Any, Literal, NamedTuple, SupportsIndex, overload

class BlockedEnd(NamedTuple):
    end: Literal["start", "goal"]
    by: str
    free_place: tuple[float, ...] | None
    distance: float | None
    hint: str | None
    room: float
    needed: float
    depth: float | None
    @overload
    def __getitem__(self, key: SupportsIndex | str) -> Any: ...
    @overload
    def __getitem__(self, key: slice) -> tuple[Any, ...]: ...

class SampleCounts(NamedTuple):
    drawn: int
    kept: int
    dropped: int

class MotionCounts(NamedTuple):
    checked: int
    free: int
    blocked: int
    undecided: int

class ComponentFacts(NamedTuple):
    number: int
    milestones: int
    largest: int
    alone: int
    of_start: int
    of_goal: int
    joined: bool

class NarrowPlace(NamedTuple):
    leg: int
    place: tuple[float, float] | None
    clearance: float
    one_sample_in: float | None

class Hint(NamedTuple):
    options: tuple[str, ...]
    why: str
    command: str | None
    @property
    def keywords(self) -> dict[str, str]: ...

class Explanation(NamedTuple):
    samples: SampleCounts
    motions: MotionCounts
    components: ComponentFacts | None
    narrowest: NarrowPlace | None
    hints: tuple[Hint, ...]
    stopped_by: str | None

def narrow_place(parsed: dict[str, Any] | None) -> NarrowPlace | None: ...
def explanation(text: str) -> Explanation: ...
