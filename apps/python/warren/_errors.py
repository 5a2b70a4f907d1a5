# SPDX-License-Identifier: BSD-3-Clause
"""What goes wrong, as exceptions that Python's own ones catch too."""


class Error(Exception):
    """What warren raises: one line, and its parts.

    Attributes
    ----------
    where : str
        The keyword, file, line or row that is wrong; empty where none is named.
    what : str
        What is wrong there, or what would be right.
    value : str
        What was found; empty where there is nothing to show.
    """

    def __init__(self, where="", what="", value=""):
        line = f"{where}: {what}" if where else what
        super().__init__(f"{line} (found: {value})" if value else line)
        self.where = where
        self.what = what
        self.value = value

    def __reduce__(self):
        return type(self), (self.where, self.what, self.value)


class InputError(Error, ValueError):
    """A world, an array or a file that contradicts itself or its format."""


class UsageError(InputError):
    """A question or an option that can't be asked, of this world or at all.

    Examples
    --------
    >>> import warren
    >>> try:
    ...     warren.solve("maze:5x5", planner="prn")
    ... except warren.UsageError as error:
    ...     print(error.where, "|", error.what)
    planner | 'prn' is none of prm, lazy-prm, visibility, cells, voronoi, rrt, rrt-connect, grid, rrt-star, informed-rrt-star, anytime; did you mean prm?
    """


class ReadError(Error, OSError):
    """A file that can't be opened or read."""


class WriteError(Error, OSError):
    """A file that can't be written; nothing half-written stays."""


class Stopped(Error, TimeoutError):
    """A call that a limit or a signal ended before its end.

    Attributes
    ----------
    reason : str
        "budget", "memory", "SIGINT", "SIGTERM" or "SIGHUP".
    answer : Answer or None
        What is known so far, of calls that give an answer: its status is "stopped", its counters say how far it came.
    """

    def __init__(self, reason="", what="", answer=None):
        super().__init__("", what, "")
        self.reason = reason
        self.answer = answer

    def __reduce__(self):
        return type(self), (self.reason, self.what, self.answer)


for _class in (Error, InputError, UsageError, ReadError, WriteError, Stopped):
    _class.__module__ = "warren"
