# SPDX-License-Identifier: BSD-3-Clause
"""Questions and their answers."""
from __future__ import annotations

import json
import os
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._errors import Stopped
from ._options import documented
from ._worlds import World, as_world


class Answer:
    """What :func:`solve` and :meth:`Roadmap.query` found: a verified path, or why there is none.

    True where it has a verified path. An array of the path's states where an array is expected. Pickled without what
    :attr:`kept <solve>` added.

    Examples
    --------
    >>> import warren
    >>> answer = warren.solve("maze:5x5")
    >>> answer
    <Answer solved: length 19, verified>
    >>> answer.status, answer.length, answer.verified, bool(answer)
    ('solved', 19.0, True, True)
    >>> answer.path[:2]
    array([[0.5, 1. ],
           [1. , 1. ]])
    """

    __slots__ = ("_core", "world", "__weakref__")
    __module__ = "warren"

    world: World

    def __init__(self, core: Any, world: World) -> None:
        if not isinstance(core, _core.Answer):
            raise TypeError("Answer: is made by solve and Roadmap.query")
        self._core = core
        self.world = world

    def __repr__(self) -> str:
        if not self.verified:
            return f"<Answer {self.status}>"
        return f"<Answer {self.status}: length {self.length:g}, verified>"

    def __str__(self) -> str:
        return self._core.summary.rstrip("\n")  # type: ignore[no-any-return]

    def __bool__(self) -> bool:
        return self._core.verified  # type: ignore[no-any-return]

    def __array__(self, dtype: Any = None) -> np.ndarray[Any, Any]:
        return self.path if dtype is None else self.path.astype(dtype)

    def __reduce__(self) -> Any:
        return Answer, (self._core, self.world)

    @property
    def status(self) -> str:
        """"solved", "start_blocked", "goal_blocked", "not_connected", "infeasible" (proved) or "stopped"."""
        return self._core.status

    @property
    def verified(self) -> bool:
        """Has it a path that an independent judge found free, all along and with all its clearance?"""
        return self._core.verified

    @property
    def optimal(self) -> bool:
        """Is it proved that no shorter path exists?"""
        return self._core.optimal

    @property
    def path(self) -> np.ndarray[Any, Any]:
        """States from start to goal, float64: (n, 2) x, y; (n, 3) x, y, theta; (n, 6) joint angles. A read-only view
        that keeps the answer alive; no rows where there is no path."""
        return self._core.path

    @property
    def length(self) -> float:
        """Of the path, of a car its curve, of an arm in radians; nan without a verified path."""
        return self._core.length

    @property
    def min_clearance(self) -> float:
        """The least room around the body along the path; nan without a verified path."""
        return self._core.min_clearance

    @property
    def raw_length(self) -> float:
        """The length before the path was pulled taut; nan where it wasn't."""
        return self._core.raw_length

    @property
    def cost(self) -> float:
        """In the planner's own units; nan where that is the length."""
        return self._core.cost

    @property
    def turn_rad(self) -> float:
        """All turning along the path; nan for bodies that don't turn."""
        return self._core.turn_rad

    @property
    def planner(self) -> str:
        """Who found it."""
        return self._core.planner

    @property
    def seed(self) -> int:
        """Of all that was random."""
        return self._core.seed

    @property
    def robot(self) -> str:
        """The body that was asked about."""
        return self._core.robot

    @property
    def clearance(self) -> float:
        """The room that was asked for."""
        return self._core.clearance

    @property
    def start(self) -> Tuple[float, ...]:
        """Where the path was to begin."""
        return tuple(self._core.start)

    @property
    def goal(self) -> Tuple[float, ...]:
        """Where the path was to end."""
        return tuple(self._core.goal)

    @property
    def seconds(self) -> Dict[str, float]:
        """What each stage took."""
        return self._core.seconds

    @property
    def solve_s(self) -> float:
        """What all of it took, in seconds."""
        return self._core.solve_s

    @property
    def blocked(self) -> Optional[Dict[str, Any]]:
        """Where start or goal is blocked: its end, what it is blocked by, a free_place near it and the distance to that,
        and a hint; else None."""
        return self._core.blocked

    def json(self) -> str:
        """The answer as warren.answer/1, byte for byte what `warren solve --json -` prints (but for measured times,
        threads and memory)."""
        return self._core.json

    def to_dict(self) -> Dict[str, Any]:
        """The same, parsed.

        Examples
        --------
        >>> import warren
        >>> warren.solve("maze:5x5").to_dict()["counters"]["samples"]
        25
        """
        parsed: Dict[str, Any] = json.loads(self._core.json)
        return parsed

    def sample(self, every: Optional[float | str] = None, **limits: Any) -> Tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
        """Places along the path as the curve that it is: straight ways, even turns, a car's arcs.

        Parameters
        ----------
        every : float or str, optional
            Places at most so far apart, the path's own among them; or moments, such as "100ms", which need a speed
            (default: the path's own states).
        speed, acceleration, lateral_acceleration : float, optional
            How fast the body may go, in units of length and seconds.
        joint_speed, joint_acceleration : float or sequence of float, optional
            The same for arms, in radians.

        Returns
        -------
        states : ndarray, (k, 2), (k, 3) or (k, 6)
        at : ndarray, (k,)
            How far along the path each is, or with moments when, in seconds.

        Examples
        --------
        >>> import warren
        >>> states, at = warren.solve("maze:5x5").sample(0.5)
        >>> len(states), at[-1]
        (39, 19.0)
        """
        return self._core.sample({"every": every, **limits})  # type: ignore[no-any-return]

    def save_path(self, file: str | os.PathLike[str], **how: Any) -> Dict[str, Any]:
        """Writes the path as .csv, .yaml (ROS nav_msgs/Path) or .geojson, by the ending.

        Parameters
        ----------
        file : str or path
        {options}

        Returns
        -------
        dict
            How many places were written, and duration_s (None without a speed).

        Raises
        ------
        ValueError
            Where there is no path.
        UsageError, WriteError
        """
        return self._core.save_path(os.fspath(file), how)  # type: ignore[no-any-return]

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes :meth:`json`."""
        with open(file, "w", encoding="utf-8") as out:
            out.write(self.json())

    def edges(self, *, tree: bool = False) -> np.ndarray[Any, Any]:
        """What the planner made, of answers that were asked with `keep=True`.

        Parameters
        ----------
        tree : bool
            What the search reached, instead of the roadmap's edges or the trees' motions.

        Returns
        -------
        ndarray, (n, 2, 2)
            x, y of both ends of each edge; none where nothing was kept.
        """
        return _core.segments_of(self._core, tree)  # type: ignore[no-any-return]

    def lines(self) -> Dict[str, List[np.ndarray[Any, Any]]]:
        """Further lines that the planner made, of answers that were asked with `keep=True`: "cells", "visibility",
        "medial_axis" and others, as chains of points (k, 2)."""
        return _core.lines_of(self._core)  # type: ignore[no-any-return]

    def svg(self, *, moving: bool = False) -> str:
        """World, roadmap where it was kept, and path as an SVG document.

        Parameters
        ----------
        moving : bool
            Shall the body move along the path?
        """
        return _core.picture_of_answer(self._core, self.world._core, "svg", moving).decode()  # type: ignore[no-any-return]

    def html(self, *, moving: bool = False) -> str:
        """The same as a page of its own: drag moves, the wheel zooms."""
        return _core.picture_of_answer(self._core, self.world._core, "html", moving).decode()  # type: ignore[no-any-return]

    def png(self) -> bytes:
        """The same as a PNG image."""
        return _core.picture_of_answer(self._core, self.world._core, "png", False)  # type: ignore[no-any-return]

    def _repr_svg_(self) -> str:
        return self.svg()

    def _repr_html_(self) -> str:
        import html
        svg = self.svg()
        return f"<pre>{html.escape(str(self))}</pre>{svg[svg.index('<svg'):]}"


Answer.save_path = documented(_core.path_keywords(), limits=False)(Answer.save_path)  # type: ignore[method-assign]


def finished(core: Any, world: World) -> Answer:
    """The answer, or the exception of a limit that ended it."""
    answer = Answer(core, world)
    if core.stop_reason is not None:
        reason, text = core.stop_reason
        raise Stopped(reason, text, answer)
    return answer


@documented(_core.solve_keywords())
def solve(world: Any, start: Any = None, goal: Any = None, *, keep: bool = False, **options: Any) -> Answer:
    """Finds a path, verified by code that shares nothing with the planner.

    What isn't said is as the world's file says, and else what is fastest and most honest for the problem. The answer is
    the same for any number of threads and on every machine. Takes no lock: any number of threads may call.

    Parameters
    ----------
    world : World, str, path, ndarray, or geometry
        A world; the file or name of one; cells; what has a `__geo_interface__`.
    start, goal : sequence of float, optional
        x, y of a point or disc; x, y, theta (radians) of a body that turns, whose goal may lack theta; six joint angles
        of an arm, whose goal may be the three coordinates of a place of its tool (default: the world's).
    keep : bool
        Shall the answer keep what the planner made on its way, for pictures and plots? It takes memory.
    {options}

    Returns
    -------
    Answer
        No path, and a blocked start or goal, is an answer.

    Raises
    ------
    UsageError
        For what can't be asked of this world.
    InputError
        For a world that contradicts itself.
    Stopped
        At a limit; its `answer` is the partial one.
    KeyboardInterrupt
        Within 0.2 s of Ctrl-C.

    Examples
    --------
    >>> import warren
    >>> answer = warren.solve(warren.maze(41, 41, seed=3), planner="lazy-prm", clearance=0.2)
    >>> answer.status, answer.length == warren.solve("maze:41x41,seed=3").length
    ('solved', True)
    >>> warren.solve("maze:5x5", (1, 1), (9, 9)).status
    'goal_blocked'
    """
    there = as_world(world)
    options["start"] = start
    options["goal"] = goal
    return finished(_core.solve(there._core, options, keep), there)


class Verdict(NamedTuple):
    """What the judge says of a path.

    True where it is free. `violation` is None, or the leg (from 0), the distance and the obstacle of the first one.
    """

    verified: bool
    length: float
    min_clearance: float
    violation: Optional[Tuple[int, float, str]]

    def __bool__(self) -> bool:
        return self.verified


Verdict.__module__ = "warren"


@documented(_core.verify_keywords())
def verify(world: Any, path: Any, **options: Any) -> Verdict:
    """Is a path free, all along and with all its clearance? Decided by code that shares nothing with planners.

    Parameters
    ----------
    world : World, str, path, ndarray, or geometry
        As :func:`solve` takes it.
    path : Answer, array_like (n, 2), (n, 3) or (n, 6), or str or path
        Whose states are judged; a name is of a file with an answer as JSON.
    start, goal : sequence of float, optional
        Where the path must begin and end (default: the answer's, else the world's, else its own ends).
    {options}

    Returns
    -------
    Verdict

    Examples
    --------
    >>> import warren
    >>> world = warren.maze(5, 5)
    >>> answer = warren.solve(world)
    >>> warren.verify(world, answer).verified
    True
    >>> straight = warren.verify(world, [(0.5, 1), (5.5, 5)])
    >>> bool(straight), straight.violation[0]
    (False, 0)
    """
    there = as_world(world)
    if isinstance(path, Answer):
        told = _core.verify_json(there._core, path.json(), options)
    elif isinstance(path, (str, os.PathLike)):
        told = _core.verify_file(there._core, os.fspath(path), options)
    else:
        told = _core.verify_states(there._core, path, options)
    return Verdict(told["verified"], told["length"], told["min_clearance"], told["violation"])
