# SPDX-License-Identifier: BSD-3-Clause
"""The true shortest path with clearance r through a perfect maze, to rounding error.

A perfect maze is simply connected, so start and goal are joined by one corridor, and a path through it that is taut and
keeps its distance is the shortest of all. The path is a chain of contacts: discs of radius r around wall posts, each
passed on a known side, joined by common tangents. It begins with the inner post of every turn and is pulled taut:
a contact that the string would lift off is dropped, the post that a tangent runs over worst is put in. What counts is
not the pulling but the proof at the end: `proof` says what is not taut or not free.
"""

import math
from dataclasses import dataclass

EPSILON = 1e-11


@dataclass(frozen=True)
class Contact:
    x: float
    y: float
    radius: float
    side: int    # +1: left of the path, which turns left around it; -1: right
    first: int   # doors of the corridor that end at this post: first .. last
    last: int


@dataclass(frozen=True)
class Door:
    left: tuple
    right: tuple


def corridor(cells):
    """The doors that a sequence of cells passes through, entrance and exit included."""
    centres = [(c + 1.0, r + 1.0) for r, c in cells]
    centres = [(centres[0][0] - 1.0, centres[0][1])] + centres + [(centres[-1][0] + 1.0, centres[-1][1])]
    doors = []
    for (x1, y1), (x2, y2) in zip(centres, centres[1:]):
        mx, my, dx, dy = (x1 + x2) / 2, (y1 + y2) / 2, x2 - x1, y2 - y1
        doors.append(Door((mx - dy / 2, my + dx / 2), (mx + dy / 2, my - dx / 2)))
    return doors


def post_contact(doors, i, side, r):
    """The contact with the post at one end of door i."""
    post = lambda k: doors[k].left if side > 0 else doors[k].right
    first = last = i
    while first > 0 and post(first - 1) == post(i):
        first -= 1
    while last + 1 < len(doors) and post(last + 1) == post(i):
        last += 1
    return Contact(*post(i), r, side, first, last)


def tangent(a, b):
    """The straight piece from contact a to contact b: x1, y1, x2, y2, and its direction."""
    dx, dy = b.x - a.x, b.y - a.y
    apart = math.hypot(dx, dy)
    turn = math.asin((b.side * b.radius - a.side * a.radius) / apart)
    angle = math.atan2(dy, dx) - turn
    ux, uy = math.cos(angle), math.sin(angle)
    return (a.x + a.side * a.radius * uy, a.y - a.side * a.radius * ux,
            b.x + b.side * b.radius * uy, b.y - b.side * b.radius * ux, ux, uy)


def worst_post(doors, a, b, r):
    """The post between two contacts that their tangent comes too near to (or passes on the wrong side), or None."""
    x1, y1, x2, y2, ux, uy = tangent(a, b)
    length = (x2 - x1) * ux + (y2 - y1) * uy
    worst, found = r - EPSILON, None
    for i in range(a.first, b.last + 1):
        ahead = ux * (doors[i].left[1] - doors[i].right[1]) - uy * (doors[i].left[0] - doors[i].right[0])
        if ahead <= 0.0:  # the arc at a or b turns through this door, not the tangent
            continue
        for side, (px, py) in ((1, doors[i].left), (-1, doors[i].right)):
            along = (px - x1) * ux + (py - y1) * uy
            if not 0.0 < along < length or (px, py) in ((a.x, a.y), (b.x, b.y)):
                continue
            room = side * (ux * (py - y1) - uy * (px - x1))
            if room < worst:
                worst, found = room, (i, side)
    return post_contact(doors, *found, r) if found else None


def turn_at(a, c, b):
    """How far the path turns around contact c, to its side: negative where the string lifts off.

    Each door is crossed within 90 degrees of square, so n doors that end at one post leave no doubt about full turns."""
    ux, uy = tangent(a, c)[4:]
    vx, vy = tangent(c, b)[4:]
    turn = math.atan2(c.side * (ux * vy - uy * vx), ux * vx + uy * vy)
    return turn + 2.0 * math.pi if turn <= (c.last - c.first - 2) * math.pi / 2 else turn


def taut(doors, start, goal, r):
    """Contacts from start to goal, pulled taut."""
    n = len(doors)
    chain = [Contact(*start, 0.0, 1, 0, 0)]
    for i in range(n - 1):
        if doors[i].left == doors[i + 1].left or doors[i].right == doors[i + 1].right:
            contact = post_contact(doors, i, 1 if doors[i].left == doors[i + 1].left else -1, r)
            if contact != chain[-1]:
                chain.append(contact)
    chain.append(Contact(*goal, 0.0, 1, n - 1, n - 1))
    i = 1
    for _ in range(200 * n + 1000):
        if i >= len(chain):
            return chain
        post = worst_post(doors, chain[i - 1], chain[i], r)
        if post is not None:
            chain.insert(i, post)
            i = max(1, i - 1)
        elif i >= 2 and turn_at(*chain[i - 2:i + 1]) < -EPSILON:
            del chain[i - 1]
            i = max(1, i - 2)
        else:
            i += 1
    raise AssertionError("the string never settles")


def length_of(chain):
    legs = [tangent(a, b) for a, b in zip(chain, chain[1:])]
    arcs = [c.radius * max(0.0, turn_at(a, c, b)) for a, c, b in zip(chain, chain[1:], chain[2:])]
    return sum(math.hypot(t[2] - t[0], t[3] - t[1]) for t in legs) + sum(arcs)


def proof(chain, walls, r):
    """None if the chain is taut and free, hence the shortest path; else what is wrong. walls: exact_checker.Walls."""
    least = r * (1.0 - 1e-9) - 1e-13
    for a, c, b in zip(chain, chain[1:], chain[2:]):
        turn = turn_at(a, c, b)
        if turn < -1e-9:
            return f"turns by {turn} around the post ({c.x}, {c.y})"
        x, y, ux, uy = tangent(a, c)[2:]
        for k in range(5):  # points of the arc
            angle = math.atan2(y - c.y, x - c.x) + c.side * turn * k / 4
            p = (c.x + r * math.cos(angle), c.y + r * math.sin(angle))
            if walls.distance(p + p, 2 * r) < least:
                return f"the arc around ({c.x}, {c.y}) meets a wall"
    for a, b in zip(chain, chain[1:]):
        if walls.distance(tangent(a, b)[:4], 2 * r) < least:
            return f"the tangent from {a} to {b} meets a wall"
    return None


def optimum(cells, walls, start, goal, r):
    """Length of the shortest path with clearance r through the corridor of these cells, proved. 0 < r < 0.5."""
    chain = taut(corridor(cells), start, goal, r)
    wrong = proof(chain, walls, r)
    assert wrong is None, wrong
    return length_of(chain)
