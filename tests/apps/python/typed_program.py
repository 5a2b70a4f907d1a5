# SPDX-License-Identifier: BSD-3-Clause
"""A program as users write it: read by mypy --strict, and run."""
import pathlib
import tempfile
from typing import Dict, List, Optional, Tuple

import numpy as np
import warren
from numpy.typing import NDArray


def lengths(world: warren.World, places: NDArray[np.float64]) -> NDArray[np.float64]:
    roadmap: warren.Roadmap = warren.build(world, planner="prm", seed=3, index="auto")
    return roadmap.matrix(places, places, search="astar")


def solved(name: str, planner: Optional[str] = None) -> Tuple[str, float]:
    answer: warren.Answer = warren.solve(name, (1, 1), goal=[5.0, 5.0], clearance=0.2, budget="20s", threads=2)
    path: NDArray[np.float64] = answer.path
    return answer.status, float(path[0, 0])


def told() -> List[str]:
    stages: List[str] = []

    def tell(stage: str, done: int, total: int) -> None:
        stages.append(stage)

    warren.solve(warren.maze(41, 41, algorithm="kruskal"), progress=tell)
    return stages


def main() -> None:
    world = warren.scene(polygons=[np.array([[0.0, 0.0], [2.0, 0.0], [1.0, 2.0]])], walls=[(3, 0, 3, 5)],
                         bounds=(-1, -1, 9, 9), robot=warren.disc(0.1))
    verdict: warren.Verdict = warren.verify(world, warren.solve(world, (0, 5), (8, 5)))
    assert verdict.verified and solved("maze:5x5")[0] == "solved"
    assert lengths(warren.maze(9, 9), np.array([[1.0, 1.0], [9.0, 9.0]])).shape == (2, 2)
    told()
    found: Dict[str, NDArray[np.float64]] = warren.compare("maze:9x9", planners=["prm"], seeds=2)
    assert found["length"].shape == (1,)
    with tempfile.TemporaryDirectory() as folder:
        warren.build("maze:9x9").save(pathlib.Path(folder) / "a.roadmap")
    try:
        warren.solve("maze:5x5", seed=-1)
    except warren.InputError as error:
        assert error.where == "seed"


if __name__ == "__main__":
    main()
