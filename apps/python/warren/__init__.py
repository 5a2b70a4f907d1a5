# SPDX-License-Identifier: BSD-3-Clause
"""Motion planning by roadmaps: verified shortest paths through mazes, maps, polygons and for arms.

>>> import warren
>>> answer = warren.solve(warren.maze(41, 41, seed=3))
>>> answer.status, answer.verified
('solved', True)
"""
from ._core import __version__
from ._errors import Error, InputError, ReadError, Stopped, UsageError, WriteError
from ._bodies import arm, car, disc, polygon, puma560, urdf
from ._worlds import World
from ._making_worlds import example, from_geo, grid, maze, read_world, scene
from ._explanations import (BlockedEnd, ComponentFacts, Explanation, Hint, MotionCounts, NarrowPlace,
                            SampleCounts)
from ._answers import Alternative, Answer, GoalReached, Improvement, KeptRoute
from ._solving import Replanner, Verdict, solve, verify
from ._roadmaps import EdgeCounts, Roadmap
from ._building import build, open_roadmap
from ._studies import Comparison, compare
from ._plots import animate, plot

__all__ = ["Alternative", "Answer", "BlockedEnd", "Comparison", "ComponentFacts", "EdgeCounts", "Error",
           "Explanation", "GoalReached", "Hint", "Improvement", "InputError", "KeptRoute", "MotionCounts",
           "NarrowPlace", "ReadError", "Replanner", "Roadmap", "SampleCounts", "Stopped", "UsageError", "Verdict", "World",
           "WriteError", "__version__", "animate", "arm", "build", "car", "compare", "disc", "example", "from_geo",
           "grid", "maze", "open_roadmap", "plot", "polygon", "puma560", "read_world", "scene", "solve", "urdf",
           "verify"]
