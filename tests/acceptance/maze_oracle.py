#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""maze_oracle.py PROGRAM [--kruskal N] [--search N]: large mazes against algorithms of SciPy's.

The maze of the algorithm mst is held, edge for edge, against SciPy's minimum spanning tree of the weights that
docs/file_formats.md says; the program's path lengths, by all pipelines, against SciPy's breadth-first search in the cells
that the lines of the same file read from .maze files; and what streamed answers for 1, 2, 3 and 8 threads against each
other, byte for byte but for times. Needs NumPy and SciPy.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

DOCS = pathlib.Path(__file__).parents[2] / "docs" / "file_formats.md"
GOLDEN = np.uint64(0x9e3779b97f4a7c15)


def read_maze(name):
    """As the lines of the docs read it."""
    names = {}
    exec(re.search(r"```python\n(import struct.*?)```", DOCS.read_text(), re.DOTALL).group(1), names)
    return names["read_maze"](name)


def mixed(x):
    x = (x ^ (x >> np.uint64(30))) * np.uint64(0xbf58476d1ce4e5b9)
    x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94d049bb133111eb)
    return x ^ (x >> np.uint64(31))


def edges_of_grid(rows, cols):
    """Cells and numbers of all edges to the right, then of all upwards."""
    cells = np.arange(rows * cols).reshape(rows, cols)
    row, col = np.indices((rows, cols), dtype=np.uint64)
    number = (row << np.uint64(32)) + np.uint64(2) * col
    low = np.concatenate([cells[:, :-1].ravel(), cells[:-1].ravel()])
    high = np.concatenate([cells[:, 1:].ravel(), cells[1:].ravel()])
    return low, high, np.concatenate([number[:, :-1].ravel(), number[:-1].ravel() + np.uint64(1)])


def open_edges(right, above):
    return ~np.concatenate([right[:, :-1].ravel(), above[:-1].ravel()])


def kruskal(rows, cols, seed, loops):
    """Which edges of the grid are open."""
    low, high, number = edges_of_grid(rows, cols)
    weight = mixed(mixed(np.uint64(seed) + GOLDEN) + GOLDEN * (number + np.uint64(1)))
    rank = np.empty(weight.size)
    rank[np.argsort(weight)] = np.arange(1, weight.size + 1)  # all different, and exact as doubles
    cells = rows * cols
    tree = minimum_spanning_tree(coo_matrix((rank, (low, high)), (cells, cells)).tocsr())
    is_open = np.zeros(weight.size + 1, bool)
    is_open[tree.data.astype(np.int64)] = True
    is_open = is_open[rank.astype(np.int64)]
    return is_open | ((mixed(~weight) >> np.uint64(11)).astype(float) < loops * 2.0**53)


def steps_between_corners(right, above):
    rows, cols = right.shape
    low, high, _ = edges_of_grid(rows, cols)
    is_open = open_edges(right, above)
    low, high = low[is_open], high[is_open]
    graph = coo_matrix((np.ones(2 * low.size, np.int8), (np.r_[low, high], np.r_[high, low]))).tocsr()
    _, before = breadth_first_order(graph, 0)
    steps, cell = 0, rows * cols - 1
    while cell != 0:
        cell, steps = before[cell], steps + 1
    return steps


class Program:
    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)

    def generate(self, side, *words):
        name = self.folder / "maze.maze"
        subprocess.run([self.program, "generate", "maze", f"{side}x{side}", *words, "-o", name, "--quiet"], check=True)
        return name

    def solve(self, world, *words):
        run = subprocess.run([self.program, "solve", world, "--json", "-", *words], check=True, capture_output=True)
        return json.loads(run.stdout)


def check(holds, claim):
    print(f"{'ok' if holds else 'FAILED'}: {claim}", flush=True)
    return holds


def check_kruskal(program, side):
    good = True
    for seed, loops in ((1, 0.0), (7, 0.05)):
        name = program.generate(side, "--algorithm", "mst", "--seed", str(seed), "--loops", str(loops))
        same = np.array_equal(open_edges(*read_maze(name)), kruskal(side, side, seed, loops))
        good &= check(same, f"{side} x {side}, seed {seed}, loops {loops}: the edges of SciPy's tree")
    return good


def timeless(answer):
    return {key: answer[key] for key in answer if key not in ("stages_s", "solve_s", "peak_memory_bytes", "threads")}


def check_lengths(program, side):
    good = True
    for algorithm, loops in (("mst", "0"), ("mst", "0.1"), ("backtracker", "0.02"), ("wilson", "0")):
        name = program.generate(side, "--algorithm", algorithm, "--loops", loops)
        length = steps_between_corners(*read_maze(name)) + 1.0  # and half a step to either door
        for pipeline in ("plain", "tiled", "streamed"):
            found = program.solve(name, "--pipeline", pipeline, "--no-path")
            good &= check(found["verified"] and found["length"] == length,
                          f"{side} x {side} {algorithm} loops {loops} {pipeline}: {length} long")
        answers = [timeless(program.solve(name, "--pipeline", "streamed", "--threads", n)) for n in "1238"]
        good &= check(all(answer == answers[0] for answer in answers), "the same for 1, 2, 3 and 8 threads")
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--kruskal", type=int, default=2000, metavar="N")
    parser.add_argument("--search", type=int, default=3000, metavar="N")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, np.errstate(over="ignore"):
        program = Program(asked.program, folder)
        good = check_kruskal(program, asked.kruskal)
        good &= check_lengths(program, asked.search)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
