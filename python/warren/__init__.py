# SPDX-License-Identifier: BSD-3-Clause
"""Motion planning by roadmaps: verified shortest paths through mazes, maps, polygons and for arms.

>>> import warren
>>> answer = warren.solve(warren.maze(41, 41, seed=3))
>>> answer.status, answer.verified
('solved', True)
"""
from ._core import __version__
from ._errors import Error, InputError, ReadError, Stopped, UsageError, WriteError
from ._bodies import arm, car, disc, polygon, puma560
from ._worlds import World, from_geo, grid, maze, read_world, scene
from ._answers import Answer, Verdict, solve, verify

__all__ = ["Answer", "Error", "InputError", "ReadError", "Stopped", "UsageError", "Verdict", "World", "WriteError",
           "__version__", "arm", "car", "disc", "from_geo", "grid", "maze", "polygon", "puma560", "read_world", "scene",
           "solve", "verify"]
