# SPDX-License-Identifier: BSD-3-Clause
"""What can be drawn: worlds, answers, roadmaps."""
import os

from . import _core
from ._errors import UsageError
from ._options import documented


class Pictured:
    """What worlds, answers and roadmaps have in common: they draw themselves, and notebooks show them."""

    __slots__ = ()

    def _drawn(self, kind, look):
        raise NotImplementedError

    def svg(self, **look):
        """An SVG document of it.

        Parameters
        ----------
        moving : bool
            Of answers alone: shall the body move along the path?
        {options}
        """
        return self._drawn("svg", look).decode()

    def html(self, **look):
        """A page of its own: drag moves, the wheel zooms. Keywords as of :meth:`svg`, but it has the window's size."""
        return self._drawn("html", look).decode()

    def png(self, **look):
        """A PNG image of it. Keywords as of :meth:`svg`; nothing moves."""
        return self._drawn("png", look)

    def save_picture(self, file, **look):
        """Draws it into a file: .svg, .png, .pdf or .html, by the ending.

        Parameters
        ----------
        file : str or path
            In place of a file that was there; all of it or nothing.
        **look
            As :meth:`svg` takes them.

        Raises
        ------
        UsageError
            For other endings, and for a look that such a file can't have.
        WriteError
            Where the file can't be written.
        """
        path = os.fspath(file)
        ending = os.path.splitext(path)[1].lower()
        if ending not in (".svg", ".png", ".pdf", ".html"):
            raise UsageError("file", "expected an ending among .svg .png .pdf .html", path)
        _core.write_file(path, self._drawn(ending[1:], look))

    def _repr_svg_(self):
        return self.svg()

    def _repr_html_(self):  # converters of notebooks strip pictures that are SVG alone
        svg = self.svg()
        return svg[svg.index("<svg"):]


Pictured.svg = documented(_core.picture_keywords(), limits=False)(Pictured.svg)
