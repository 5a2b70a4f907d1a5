# SPDX-License-Identifier: BSD-3-Clause
"""Roadmaps built, and read from files."""
import os

from . import _core
from ._making_worlds import as_world
from ._options import documented
from ._roadmaps import Roadmap


@documented(_core.build_keywords())
def build(world, **options):
    """Builds a roadmap without a question, for as many as one likes.

    Parameters
    ----------
    world : World, str, path, ndarray, or geometry
        As :func:`solve` takes it; its start and goal mean nothing here.
    {options}

    Returns
    -------
    Roadmap

    Raises
    ------
    UsageError
        For what can't be built, and options that mean nothing to it.
    InputError, Stopped

    Examples
    --------
    >>> import warren
    >>> warren.build(warren.maze(21, 21), planner="lazy-prm", sampler="uniform", samples=500, seed=4).edges.free
    0
    """
    return Roadmap(_core.build(as_world(world, options.get("robot"))._core, options))


def open_roadmap(file, *, world=None, **limits):
    """Reads a .roadmap file; a large one is mapped into memory, and must not become shorter while it is used.

    Parameters
    ----------
    file : str or path
    world : World, str, path, ndarray, or geometry, optional
        For a file without its world, or to make sure that it is for this one.
    threads, budget, memory, progress
        As :func:`build` takes them.

    Returns
    -------
    Roadmap

    Raises
    ------
    ReadError
        Where it can't be read.
    InputError
        For a file that is cut off, damaged, of another version or for another world.
    """
    given = None if world is None else as_world(world)._core
    return Roadmap(_core.open_roadmap(os.fspath(file), given, limits))


def from_bytes(data, report):
    import tempfile
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "pickled.roadmap")
        with open(file, "wb") as kept:
            kept.write(data)
        roadmap = open_roadmap(file)
    roadmap.report = report
    return roadmap
