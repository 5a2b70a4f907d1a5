# SPDX-License-Identifier: BSD-3-Clause
"""What classes and functions share: figures as the core tells them, and keywords, whose documentation is made of the
program's own table."""
import operator

_KINDS = {"N": "int", "K": "int", "NAME": "str", "WORD": "str", "TIME": "float or str", "BYTES": "int or str",
          "STATES": "sequence of sequences of float", "X,Y[,THETA]": "sequence of float", '"BODY"': "str",
          "LIST": "list of str or str", "N|auto": "int or 'auto'", "K|auto|star": "int, 'auto' or 'star'",
          "R|auto|star": "float, 'auto' or 'star'", "R[,STEP]": "float or (float, float)", "D|TIME": "float or str",
          "W[,...]": "float or sequence of float", "A[,...]": "float or sequence of float",
          "SHARE": "float or str", "P[,D]": "float or (float, float)", "R[,ANGLE]": "float or (float, float)",
          '"F X Y X Y X Y ..."': "(float, polygon) or list of them", "FILE,F": "(str, float), or list of them or of (float, polygon)",
          "FILE[,F]": "str, (str, float) or list of them", "FILE[,BASE,MULTIPLIER]": "str, (str, float, float) or list of them",
          "blocked|F": "float or 'blocked'", '"X,Y; X,Y; ..."': "sequence of sequences of float",
          "K[,SIZE]": "int or (int, float)", "OLD.json": "Answer, str or path"}

LIMITS = """
threads : int, optional
    Threads to compute on; changes the time, never the result (default: all).
budget : float or str, optional
    Seconds, or a word such as "500ms", after which :class:`Stopped` is raised (default: none).
memory : int or str, optional
    Bytes, or a word such as "2GiB", that the process may hold (default: what the machine has).
progress : callable, optional
    Called with stage, done and total (0: not known) ten times a second, on another thread.
"""


def told(name, doc, of=None):
    """A property that the core has under the same name; or what `of` makes of it, unless it is None."""
    said = operator.attrgetter("_core." + name)

    def made(thing):
        value = said(thing)
        return None if value is None else of(value)

    return property(said if of is None else made, doc=doc)


def _kind(value, choices, optional):
    if choices and optional:
        return "bool or {" + ", ".join(choices) + "}"
    if choices:
        return "{" + ", ".join(choices) + "}"
    return _KINDS.get(value, "float") if value else "bool"


def _filled(text):
    """Lines of at most 110 characters, indented: textwrap would take ten milliseconds of the import."""
    lines = [""]
    for word in text.split():
        if len(lines[-1]) + len(word) > 105:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return "".join(f"\n    {line}" for line in lines)


def documented(table, limits=True):
    """Puts the keywords of a table where a docstring says {options}."""
    rows = [f"{name} : {_kind(value, choices, optional)}, optional{_filled(said + '.')}"
            for name, value, said, choices, optional in table if name not in ("start", "goal", "path")]
    text = "\n".join([*rows, LIMITS.strip()] if limits else rows)

    def put(function):
        before, after = function.__doc__.split("{options}")
        margin = before[before.rindex("\n"):]
        function.__doc__ = before + text.replace("\n", margin) + after
        return function

    return put
