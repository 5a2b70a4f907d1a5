# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Callable
from typing import Any, TypeVar

_F = TypeVar("_F", bound=Callable[..., Any])

LIMITS: str

def told(name: str, doc: str, of: Callable[[Any], Any] | None = ...) -> property: ...
def documented(
    table: list[tuple[str, str, str, list[str], bool]], limits: bool = ...
) -> Callable[[_F], _F]: ...
