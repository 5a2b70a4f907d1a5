# SPDX-License-Identifier: BSD-3-Clause
from typing import Any

from ._answers import Answer
from ._roadmaps import Roadmap
from ._worlds import _World

WALL: str
POLYGON: str
OUTLINE: str
BODY: str
EDGE: str
TREE: str
LINE: str
PATH: str
START: str
GOAL: str

def plot(
    what: Answer | Roadmap | _World,
    *,
    answer: Answer | None = ...,
    ax: Any = ...,
    roadmap: bool = ...,
    tree: bool = ...,
    lines: bool = ...,
    bodies: int = ...,
) -> Any: ...
def animate(
    answer: Answer,
    *,
    ax: Any = ...,
    frames: int = ...,
    interval: float = ...,
    speed: float | None = ...,
    acceleration: float | None = ...,
) -> Any: ...
