# SPDX-License-Identifier: BSD-3-Clause
"""The lines of docs/file_formats.md that read a .maze file, held against the program's own walls."""
import pathlib
import re

import numpy as np
import pytest
import warren

DOCS = pathlib.Path(__file__).parents[3] / "docs" / "file_formats.md"


@pytest.fixture(name="read_maze")
def lines_of_the_docs():
    names = {}
    lines = re.search(r"```python\n(import struct.*?)```", DOCS.read_text(), re.DOTALL).group(1)
    exec(lines, names)  # pylint: disable=exec-used
    return names["read_maze"]


def walls_of(right, above):
    """Rows x1 y1 x2 y2 of the unit walls, without the outline's, in any order."""
    rows, cols = right.shape
    row, col = np.nonzero(right[:, :cols - 1])
    upright = np.stack([col + 1.5, row + 0.5, col + 1.5, row + 1.5], axis=1)
    row, col = np.nonzero(above[:rows - 1])
    level = np.stack([col + 0.5, row + 1.5, col + 1.5, row + 1.5], axis=1)
    return {tuple(wall) for wall in np.concatenate([upright, level])}


@pytest.mark.parametrize("rows, cols, loops", [(1, 1, 0.0), (7, 5, 0.0), (40, 63, 0.2), (600, 9, 0.0)])
def test_the_lines_of_the_docs_read_what_is_written(tmp_path, read_maze, rows, cols, loops):
    maze = warren.maze(rows, cols, loops=loops)
    maze.save(tmp_path / "a.maze")
    right, above = read_maze(tmp_path / "a.maze")
    assert right.shape == above.shape == (rows, cols)
    assert right[:-1, -1].all() and not right[-1, -1] and above[-1].all()
    assert walls_of(right, above) == {tuple(wall) for wall in maze.walls[4:].tolist()}


def test_a_maze_file_is_the_same_world(tmp_path):
    maze = warren.maze(20, 30, seed=4)
    maze.save(tmp_path / "a.maze")
    again = warren.read_world(tmp_path / "a.maze")
    assert again.hash == maze.hash and again.start == maze.start and np.array_equal(again.walls, maze.walls)


def test_damage_is_noticed_by_both(tmp_path, read_maze):
    warren.maze(20, 30).save(tmp_path / "a.maze")
    data = bytearray((tmp_path / "a.maze").read_bytes())
    for place in (3, 20, 100, len(data) - 1):
        data[place] ^= 8
        (tmp_path / "a.maze").write_bytes(data)
        with pytest.raises(ValueError):
            read_maze(tmp_path / "a.maze")
        with pytest.raises(ValueError):
            warren.read_world(tmp_path / "a.maze")
        data[place] ^= 8
