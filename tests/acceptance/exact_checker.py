# SPDX-License-Identifier: BSD-3-Clause
"""Does a path keep its distance from the walls? Decided from the numbers in the file, by nothing of warren.

Crossing is decided by rationals wherever doubles are in doubt; distances are doubles of coordinate differences. Walls
are kept in buckets, so that a path among 100 x 100 cells takes a second; check() against every wall is the same code
with one bucket.
"""

import math
from fractions import Fraction


def orientation(ax, ay, bx, by, cx, cy):
    """Sign of the doubled area of a, b, c: exact."""
    left, right = (bx - ax) * (cy - ay), (by - ay) * (cx - ax)
    value = left - right
    if abs(value) > 1e-14 * (abs(left) + abs(right)):
        return 1 if value > 0 else -1
    ax, ay, bx, by, cx, cy = map(Fraction, (ax, ay, bx, by, cx, cy))
    exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    return (exact > 0) - (exact < 0)


def between(p, q, v):
    return min(p, q) <= v <= max(p, q)


def touch(s, t):
    """Do two closed segments share a point? Exact."""
    sides = [orientation(*s, t[0], t[1]), orientation(*s, t[2], t[3]),
             orientation(*t, s[0], s[1]), orientation(*t, s[2], s[3])]
    if s[:2] != s[2:] and t[:2] != t[2:] and sides[0] * sides[1] < 0 and sides[2] * sides[3] < 0:
        return True
    ends = ((s, t[:2]), (s, t[2:]), (t, s[:2]), (t, s[2:]))
    return any(side == 0 and between(seg[0], seg[2], p[0]) and between(seg[1], seg[3], p[1])
               for side, (seg, p) in zip(sides, ends))


def point_distance(px, py, s):
    """From a point to a closed segment."""
    ux, uy = s[2] - s[0], s[3] - s[1]
    vx, vy = px - s[0], py - s[1]
    square = ux * ux + uy * uy
    t = (ux * vx + uy * vy) / square if square > 0.0 else 0.0
    if t <= 0.0:
        return math.hypot(vx, vy)
    if t >= 1.0:
        return math.hypot(px - s[2], py - s[3])
    return abs(ux * vy - uy * vx) / math.sqrt(square)


def segment_distance(s, t):
    if touch(s, t):
        return 0.0
    return min(point_distance(s[0], s[1], t), point_distance(s[2], s[3], t),
               point_distance(t[0], t[1], s), point_distance(t[2], t[3], s))


class Walls:
    """Walls in square buckets. side: of a bucket; the mean wall length if it isn't given."""

    def __init__(self, walls, side=None):
        self.walls = walls
        self.box = (min(min(w[0], w[2]) for w in walls), min(min(w[1], w[3]) for w in walls),
                    max(max(w[0], w[2]) for w in walls), max(max(w[1], w[3]) for w in walls))
        mean = sum(math.hypot(w[2] - w[0], w[3] - w[1]) for w in walls) / len(walls)
        self.side = side or max(mean, max(self.box[2] - self.box[0], self.box[3] - self.box[1]) / 1000.0)
        self.buckets = {}
        for wall in walls:
            for key in self.keys_along(wall, 0.0):
                self.buckets.setdefault(key, []).append(wall)

    def keys_along(self, s, margin):
        """Buckets that come within margin of a segment, and perhaps some more."""
        pieces = max(1, math.ceil(math.hypot(s[2] - s[0], s[3] - s[1]) / self.side))
        keys = set()
        for k in range(pieces):
            xs = [s[0] + (s[2] - s[0]) * f / pieces for f in (k, k + 1)]
            ys = [s[1] + (s[3] - s[1]) * f / pieces for f in (k, k + 1)]
            grown = margin + 1e-6 * self.side
            columns = range(self.bucket(min(xs) - grown, 0), self.bucket(max(xs) + grown, 0) + 1)
            rows = range(self.bucket(min(ys) - grown, 1), self.bucket(max(ys) + grown, 1) + 1)
            keys.update((i, j) for i in columns for j in rows)
        return keys

    def bucket(self, value, axis):
        return math.floor((value - self.box[axis]) / self.side)

    def near(self, s, margin):
        found = set()
        for key in self.keys_along(s, margin):
            found.update(self.buckets.get(key, ()))
        return found

    def distance(self, s, at_most):
        """From a segment to the nearest wall, or at_most if none is nearer."""
        return min([at_most] + [segment_distance(s, w) for w in self.near(s, at_most)])


def check_path(walls, path, start, goal, clearance, look=None):
    """None if the path is right, else what is wrong; and its least distance to a wall (up to `look`)."""
    if [tuple(p) for p in (path[0], path[-1])] != [tuple(start), tuple(goal)]:
        return f"path joins {path[0]} and {path[-1]}, not {start} and {goal}", 0.0
    least = look or 2.0 * clearance
    for i, (p, q) in enumerate(zip(path, path[1:])):
        leg = (p[0], p[1], q[0], q[1])
        box = walls.box
        if not (box[0] <= q[0] <= box[2] and box[1] <= q[1] <= box[3]):
            return f"leg {i} leaves the box of the walls at {q}", least
        distance = walls.distance(leg, least)
        if distance < clearance * (1.0 - 1e-9) or distance == 0.0:
            return f"leg {i} {leg} comes within {distance!r} of a wall, clearance {clearance!r}", distance
        least = min(least, distance)
    return None, least


def length_of(path):
    return sum(math.hypot(q[0] - p[0], q[1] - p[1]) for p, q in zip(path, path[1:]))
