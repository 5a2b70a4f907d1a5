# SPDX-License-Identifier: BSD-3-Clause
"""Questions, and the judge of paths."""
import json
import os
import warnings
from typing import NamedTuple, Optional, Tuple

from . import _core
from ._answers import Answer, Improvement
from ._errors import Stopped
from ._explanations import NarrowPlace, narrow_place
from ._options import documented
from ._making_worlds import as_world
from ._worlds import World


def finished(core, world):
    """The answer, or the exception of a limit that ended it."""
    answer = Answer(core, world)
    if core.stop_reason is not None and not core.verified:
        reason, text = core.stop_reason
        raise Stopped(reason, text, answer)
    return answer


def _take_ends(options, start, goal):
    """Puts them among the options; and keep_to may be an Answer."""
    if isinstance(options.get("keep_to"), Answer):
        options["keep_to"] = options["keep_to"]._core
    options["start"] = start
    if goal is not None or "goals" not in options:
        options["goal"] = goal


@documented(_core.solve_keywords())
def solve(world, start=None, goal=None, *, keep=False, explain=False, on_improvement=None, **options):
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
    goals, tolerance, region, return_
        Short for `goal` with several places, `goal_tolerance`, `goal_region` and `return`.
    hole : float
        With `alternatives`: how large a hole is that makes classes (default: the body's length; 0: all).
    certificate : str or path
        Where the proof of a bound of all paths is written, `.npy`; :func:`verify` checks it.
    keep : bool
        Shall the answer keep what the planner made on its way, for pictures and plots? It takes memory.
    explain : bool
        Shall :attr:`Answer.explained` say what became of samples and motions, where it is narrow, and what would likely
        help? It takes about three times what the judge of the path takes.
    on_improvement : callable, optional
        Called with an :class:`Improvement` for each better path of a planner that gets better, on this thread; where it
        returns False, the search ends with the path that it has.
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
        At a limit; its `answer` is the partial one. Planners that get better return the path that they have instead.
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
    there = as_world(world, options.get("robot"))
    _take_ends(options, start, goal)
    if on_improvement is not None and not callable(on_improvement):
        raise TypeError(f"on_improvement: expected a function (found: {type(on_improvement).__name__})")
    tell = None if on_improvement is None else lambda *figures: on_improvement(Improvement(*figures))
    return finished(_core.solve(there._core, options, keep, explain, tell), there)


class Replanner:
    """One question asked again and again while cells of a map change and the robot moves on.

    Each answer is that of :func:`solve` in the world as it is then, but for the account of the work: what a change does not
    touch is not done anew. That pays for points and discs by `grid` with prices; other questions are solved afresh. One
    thread at a time.

    Parameters
    ----------
    world : World, str, path, ndarray, or geometry
        A map, as :func:`solve` takes it; it stays as it is, a copy is changed.
    start, goal, options
        As :func:`solve` has them, but for limits.

    Examples
    --------
    >>> import numpy, warren
    >>> room = warren.grid(numpy.zeros((20, 20), bool))
    >>> robot = warren.Replanner(room, (1.5, 10.5), (18.5, 10.5), clearance_price=(3, 2))
    >>> before = robot.solve()
    >>> robot.update(box=(8, 5, 12, 16))
    >>> after = robot.solve(start=(2.5, 10.5))
    >>> before.status, after.status, after.length > before.length - 1
    ('solved', 'solved', True)
    >>> warren.solve(robot.world, (2.5, 10.5), (18.5, 10.5), clearance_price=(3, 2)).path.tolist() == after.path.tolist()
    True
    """

    __slots__ = ("_core",)
    __module__ = "warren"

    def __init__(self, world, start=None, goal=None, **options):
        _take_ends(options, start, goal)
        self._core = _core.Replanner(as_world(world)._core, options)

    def update(self, cells=None, *, box=None, blocked=True):
        """Makes cells (x from the left, y from below, from 0) blocked or free, or all whose middle is in a box (left, low,
        right, high) of the world. What was unknown is known then."""
        if (cells is None) == (box is None):
            raise TypeError("update: expected cells, or box=")
        if box is not None:
            self._core.change_box(*(float(side) for side in box), bool(blocked))
        else:
            self._core.change_cells([(int(x), int(y)) for x, y in cells], bool(blocked))

    def solve(self, start=None, **limits):
        """The answer from there, or from the start before. threads, budget, memory and progress are as of :func:`solve`."""
        return finished(self._core.solve([] if start is None else [float(x) for x in start], limits), self.world)

    @property
    def world(self):
        """The world as it is now."""
        return World(self._core.scene())


class Verdict(NamedTuple):
    """What the judge says of a path.

    True where it is free. `violation` is None, or the leg (from 0), the distance and the obstacle of the first one.
    `narrowest` is where a free path has least room, where it was asked for; None of one that touches.
    """

    verified: bool
    length: float
    min_clearance: float
    violation: Optional[Tuple[int, float, str]]
    narrowest: Optional[NarrowPlace] = None

    def __bool__(self):
        return self.verified


Verdict.__module__ = "warren"


@documented(_core.verify_keywords())
def verify(world, path, **options):
    """Is a path free, all along and with all its clearance? Decided by code that shares nothing with planners.

    Parameters
    ----------
    world : World, str, path, ndarray, or geometry
        As :func:`solve` takes it.
    path : Answer, array_like (n, 2), (n, 3), (n, 6) or (n, joints), or str or path
        Whose states are judged; a name is of a file with an answer as JSON.
    start, goal : sequence of float, optional
        Where the path must begin and end (default: the answer's, else the world's, else its own ends).
    goals, tolerance, region, return_
        As :func:`solve` has them.
    certificate : str or path
        The proof of the answer's bound, as :func:`solve` writes it.
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
    >>> warren.verify(world, answer, explain=True).narrowest.clearance
    0.5
    """
    there = as_world(world, options.get("robot"))
    if isinstance(path, Answer):
        told = _core.verify_json(there._core, path.json(), options)
    elif isinstance(path, (str, os.PathLike)):
        told = _core.verify_file(there._core, os.fspath(path), options)
    else:
        told = _core.verify_states(there._core, path, options)
    if told["ended"] is not None:
        warnings.warn(f"verify: explain ended early, {told['ended']}; the verdict stands", stacklevel=2)
    return Verdict(told["verified"], told["length"], told["min_clearance"], told["violation"],
                   narrow_place(json.loads(told["narrowest"])))
