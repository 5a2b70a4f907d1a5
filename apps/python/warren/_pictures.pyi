# SPDX-License-Identifier: BSD-3-Clause
import os
from collections.abc import Sequence
from typing import Union

class Pictured:
    def svg(
        self,
        *,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        size: str | None = ...,
        dpi: float | None = ...,
        title: str | None = ...,
    ) -> str: ...
    def html(
        self,
        *,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        title: str | None = ...,
    ) -> str: ...
    def png(
        self,
        *,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        size: str | None = ...,
        dpi: float | None = ...,
        title: str | None = ...,
    ) -> bytes: ...
    def save_picture(
        self,
        file: Union[str, os.PathLike[str]],
        *,
        show: str | Sequence[str] | None = ...,
        heading: float | str | None = ...,
        size: str | None = ...,
        dpi: float | None = ...,
        title: str | None = ...,
    ) -> None: ...
    def _repr_svg_(self) -> str: ...
    def _repr_html_(self) -> str: ...
