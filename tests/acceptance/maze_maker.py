# SPDX-License-Identifier: BSD-3-Clause
"""Mazes made by somebody else: generators and ways of writing that share nothing with warren.

A Maze is a grid of cells (row, col), zero-based, joined by open doors; on paper the cell's centre is (col + 1, row + 1),
its walls lie half a unit away, and the outline opens left of the first cell and right of the last. A WallList is what a
file holds: segments in any order, cut anyhow, moved anywhere, with the start, goal and clearance that belong to them.
"""

import math
import random
from dataclasses import dataclass, field, replace

STEPS = ((0, 1), (1, 0), (0, -1), (-1, 0))


@dataclass
class Maze:
    rows: int
    cols: int
    doors: set = field(default_factory=set)  # pairs (cell, cell), the smaller cell first

    def open(self, a, b):
        self.doors.add((min(a, b), max(a, b)))

    def close(self, a, b):
        self.doors.discard((min(a, b), max(a, b)))

    def joined(self, a, b):
        return (min(a, b), max(a, b)) in self.doors

    def around(self, cell):
        """Cells beside this one, whether or not a wall stands between."""
        for dr, dc in STEPS:
            row, col = cell[0] + dr, cell[1] + dc
            if 0 <= row < self.rows and 0 <= col < self.cols:
                yield (row, col)

    def all_pairs(self):
        for row in range(self.rows):
            for col in range(self.cols):
                if col + 1 < self.cols:
                    yield ((row, col), (row, col + 1))
                if row + 1 < self.rows:
                    yield ((row, col), (row + 1, col))


def growing_tree(rows, cols, rng, newest):
    """Grows a tree of cells from a random one: from the newest cell with this probability, else from any."""
    maze = Maze(rows, cols)
    first = (rng.randrange(rows), rng.randrange(cols))
    active, reached = [first], {first}
    while active:
        i = len(active) - 1 if rng.random() < newest else rng.randrange(len(active))
        fresh = [c for c in maze.around(active[i]) if c not in reached]
        if not fresh:
            active[i] = active[-1]
            active.pop()
            continue
        cell = rng.choice(fresh)
        maze.open(active[i], cell)
        reached.add(cell)
        active.append(cell)
    return maze


def random_edges(rows, cols, rng):
    """Opens walls in random order wherever two regions meet."""
    maze = Maze(rows, cols)
    region = {}

    def root(cell):
        while region.get(cell, cell) != cell:
            region[cell] = region.get(region[cell], region[cell])
            cell = region[cell]
        return cell

    pairs = list(maze.all_pairs())
    rng.shuffle(pairs)
    for a, b in pairs:
        if root(a) != root(b):
            region[root(a)] = root(b)
            maze.open(a, b)
    return maze


def division(rows, cols, rng):
    """Cuts chambers in two by a wall with one door, until none is wider than a cell: long straight walls."""
    maze = Maze(rows, cols)
    for a, b in maze.all_pairs():
        maze.open(a, b)
    chambers = [(0, 0, rows, cols)]
    while chambers:
        row, col, height, width = chambers.pop()
        if height < 2 and width < 2:
            continue
        if height > width or (height == width and rng.random() < 0.5):
            cut, door = rng.randrange(1, height), rng.randrange(width)
            for c in range(width):
                if c != door:
                    maze.close((row + cut - 1, col + c), (row + cut, col + c))
            chambers += [(row, col, cut, width), (row + cut, col, height - cut, width)]
        else:
            cut, door = rng.randrange(1, width), rng.randrange(height)
            for r in range(height):
                if r != door:
                    maze.close((row + r, col + cut - 1), (row + r, col + cut))
            chambers += [(row, col, height, cut), (row, col + cut, height, width - cut)]
    return maze


GENERATORS = {
    "winding": lambda rows, cols, rng: growing_tree(rows, cols, rng, 1.0),
    "mixed": lambda rows, cols, rng: growing_tree(rows, cols, rng, 0.6),
    "bushy": lambda rows, cols, rng: growing_tree(rows, cols, rng, 0.0),
    "edges": random_edges,
    "division": division,
}


def make_maze(rows, cols, seed, kind=None, loops=0.0):
    """A perfect maze of a named kind (by seed if none is named); loops opens this fraction of the walls left."""
    rng = random.Random(f"{rows} {cols} {seed} {kind} {loops}")
    names = sorted(GENERATORS)
    maze = GENERATORS[kind or names[seed % len(names)]](rows, cols, rng)
    standing = [pair for pair in maze.all_pairs() if pair not in maze.doors]
    for a, b in rng.sample(standing, int(loops * len(standing))):
        maze.open(a, b)
    return maze


def cell_path(maze):
    """The shortest sequence of cells from the first to the last cell, or None. Breadth first."""
    first, last = (0, 0), (maze.rows - 1, maze.cols - 1)
    parent, ring = {first: first}, [first]
    while ring and last not in parent:
        ahead = []
        for cell in ring:
            for to in maze.around(cell):
                if to not in parent and maze.joined(cell, to):
                    parent[to] = cell
                    ahead.append(to)
        ring = ahead
    if last not in parent:
        return None
    cells = [last]
    while cells[-1] != first:
        cells.append(parent[cells[-1]])
    return cells[::-1]


@dataclass(frozen=True)
class WallList:
    walls: tuple  # (x1, y1, x2, y2)
    start: tuple
    goal: tuple
    clearance: float = 0.1
    hint: tuple = ()  # (rows, cols): says `maze ROWS COLS`


def wall_list(maze, hint=False, unit_outline=True):
    """The maze as unit walls, row by row; unit_outline: the outline too, else four long segments."""
    walls, right, top = [], maze.cols + 0.5, maze.rows + 0.5
    for (r1, c1), (r2, c2) in maze.all_pairs():
        if maze.joined((r1, c1), (r2, c2)):
            continue
        if c1 != c2:
            walls.append((c1 + 1.5, r1 + 0.5, c1 + 1.5, r1 + 1.5))
        else:
            walls.append((c1 + 0.5, r1 + 1.5, c1 + 1.5, r1 + 1.5))
    outline = [(0.5, 0.5, right, 0.5), (0.5, top, right, top), (0.5, 1.5, 0.5, top), (right, 0.5, right, top - 1.0)]
    for wall in outline:
        walls += cut_in_units(wall) if unit_outline else [wall]
    return WallList(tuple(w for w in walls if w[:2] != w[2:]), (0.5, 1.0), (right, float(maze.rows)),
                    hint=(maze.rows, maze.cols) if hint else ())


def cut_in_units(wall):
    x1, y1, x2, y2 = wall
    n = round(max(x2 - x1, y2 - y1))
    at = lambda k: (x1 + (x2 - x1) * k / n, y1 + (y2 - y1) * k / n)
    return [at(k) + at(k + 1) for k in range(n)]


def shuffled(world, rng):
    return replace(world, walls=tuple(rng.sample(world.walls, len(world.walls))))


def turned_round(world, rng):
    """Half of the walls given from their other end."""
    return replace(world, walls=tuple(w[2:] + w[:2] if rng.random() < 0.5 else w for w in world.walls))


def merged(world, _rng=None):
    """Unit walls that join in a line become one wall."""
    lines = {}
    for x1, y1, x2, y2 in world.walls:
        vertical = x1 == x2
        low, high = (min(y1, y2), max(y1, y2)) if vertical else (min(x1, x2), max(x1, x2))
        lines.setdefault((vertical, x1 if vertical else y1), []).append((low, high))
    walls = []
    for (vertical, at), spans in lines.items():
        spans.sort()
        joined = [list(spans[0])]
        for low, high in spans[1:]:
            if low <= joined[-1][1]:
                joined[-1][1] = max(joined[-1][1], high)
            else:
                joined.append([low, high])
        walls += [(at, a, at, b) if vertical else (a, at, b, at) for a, b in joined]
    return replace(world, walls=tuple(walls))


def split(world, rng):
    """Each wall in one to three pieces; sometimes pieces overlap, and some walls of length zero lie about."""
    walls = []
    for x1, y1, x2, y2 in world.walls:
        at = lambda t: (x1 + (x2 - x1) * t, y1 + (y2 - y1) * t)
        cuts = [0.0] + sorted(rng.random() for _ in range(rng.randrange(3))) + [1.0]
        for a, b in zip(cuts, cuts[1:]):
            end = (x2, y2) if b == 1.0 else at(min(1.0, b + rng.choice((0.0, 0.0, 0.05))))
            walls.append(at(a) + end)
        if rng.random() < 0.02:
            walls.append((x1, y1, x1, y1))
    return replace(world, walls=tuple(walls))


def moved(world, scale=1.0, angle_rad=0.0, shift=(0.0, 0.0)):
    """Scaled, then turned, then shifted; the clearance is scaled alike. The maze hint is lost unless nothing moves."""
    c, s = math.cos(angle_rad), math.sin(angle_rad)
    to = lambda x, y: (scale * (c * x - s * y) + shift[0], scale * (s * x + c * y) + shift[1])
    walls = tuple(to(x1, y1) + to(x2, y2) for x1, y1, x2, y2 in world.walls)
    return replace(world, walls=walls, start=to(*world.start), goal=to(*world.goal), clearance=scale * world.clearance,
                   hint=())


def text(world, with_ends=False, comments=False):
    """The world as a scene file: plain four-number lines, and more only where asked for."""
    lines = [f"maze {world.hint[0]} {world.hint[1]}"] if world.hint else []
    if with_ends:
        lines += ["start %r %r" % world.start, "goal %r %r" % world.goal, "clearance %r" % world.clearance]
    lines += ["%r %r %r %r" % wall for wall in world.walls]
    if comments:
        lines = ["# made elsewhere"] + [line + "   # a wall" if i % 7 == 0 else line for i, line in enumerate(lines)]
        lines = [", ".join(line.split()) if i % 5 == 3 and "#" not in line and line[0] in "-0123456789" else line
                 for i, line in enumerate(lines)]
    return "\n".join(lines) + "\n"
