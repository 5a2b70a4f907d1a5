# SPDX-License-Identifier: BSD-3-Clause
from typing import Literal

from numpy.typing import ArrayLike

from ._worlds import _Path, _Steering

def disc(radius: float) -> str: ...
def polygon(outline: ArrayLike) -> str: ...
def car(
    turning_radius: float, *, outline: ArrayLike | None = ..., radius: float | None = ..., steering: _Steering | None = ...
) -> str: ...
def puma560(
    radius: float,
    *,
    tool: float = ...,
    limits: Literal["classic", "symmetric"] | None = ...,
    self_collision: bool = ...,
) -> str: ...
def arm(table: _Path, radius: float, *, tool: float = ..., self_collision: bool = ...) -> str: ...
def urdf(
    file: _Path,
    *,
    srdf: _Path | None = ...,
    group: str | None = ...,
    base: str | None = ...,
    tip: str | None = ...,
    package_path: _Path | list[_Path] | tuple[_Path, ...] = ...,
    base_pose: ArrayLike | None = ...,
) -> str: ...
