# SPDX-License-Identifier: BSD-3-Clause
from ._errors import (
    Error as Error,
    InputError as InputError,
    ReadError as ReadError,
    Stopped as Stopped,
    UsageError as UsageError,
    WriteError as WriteError,
)
from ._bodies import arm as arm, car as car, disc as disc, polygon as polygon, puma560 as puma560, urdf as urdf
from ._worlds import World as World
from ._making_worlds import example as example, from_geo as from_geo, grid as grid, maze as maze, read_world as read_world, scene as scene
from ._explanations import (
    BlockedEnd as BlockedEnd,
    ComponentFacts as ComponentFacts,
    Explanation as Explanation,
    Hint as Hint,
    MotionCounts as MotionCounts,
    NarrowPlace as NarrowPlace,
    SampleCounts as SampleCounts,
)
from ._answers import (Alternative as Alternative, Answer as Answer, GoalReached as GoalReached, Improvement as Improvement,
                       KeptRoute as KeptRoute)
from ._solving import Replanner as Replanner, Verdict as Verdict, solve as solve, verify as verify
from ._roadmaps import EdgeCounts as EdgeCounts, Roadmap as Roadmap
from ._building import build as build, open_roadmap as open_roadmap
from ._studies import Comparison as Comparison, compare as compare
from ._plots import animate as animate, plot as plot

__all__ = ["Alternative", "Answer", "BlockedEnd", "Comparison", "ComponentFacts", "EdgeCounts", "Error",
           "Explanation", "GoalReached", "Hint", "Improvement", "InputError", "KeptRoute", "MotionCounts",
           "NarrowPlace", "ReadError", "Replanner", "Roadmap", "SampleCounts", "Stopped", "UsageError", "Verdict", "World",
           "WriteError", "__version__", "animate", "arm", "build", "car", "compare", "disc", "example", "from_geo",
           "grid", "maze", "open_roadmap", "plot", "polygon", "puma560", "read_world", "scene", "solve", "urdf",
           "verify"]
__version__: str
