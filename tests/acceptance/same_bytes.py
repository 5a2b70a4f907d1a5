#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the program give the same bytes whatever the processor has? Problems of every kind, but for times and memory.

    same_bytes.py PROGRAM                                  with FMA and AVX hidden from the C library, where it is glibc
    same_bytes.py PROGRAM --against "WORDS ..."            another program, such as one for arm64 behind its emulator
                  [--only WORD] [--timeout SECONDS] [--show]
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time

from program import CHANGEABLE

WORLDS = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))), "examples", "worlds")
HIDDEN = "glibc.cpu.hwcaps=" + ",".join(
    f"-{name}" for name in ("FMA", "FMA4", "AVX", "AVX2", "AVX_Usable", "AVX2_Usable", "FMA_Usable", "AVX512F", "AVX512VL"))

MAP = """image: corridor.pgm
resolution: 0.05
origin: [-1.3, 0.7, 0.31]
occupied_thresh: 0.65
free_thresh: 0.196
negate: 0
"""


def picture():
    """Two rooms, a door between them, some posts."""
    wide, high = 60, 40
    rows = []
    for y in range(high):
        for x in range(wide):
            wall = x in (0, wide - 1) or y in (0, high - 1) or (28 <= x <= 30 and not 17 <= y <= 26)
            rows.append(0 if wall or (x % 13 == 5 and y % 11 == 6) else 254)
    return b"P5\n%d %d\n255\n" % (wide, high) + bytes(rows)


def scene(name):
    return os.path.join(WORLDS, name)


def cases(folder):
    """Name and words of each run; all end with an answer on standard output."""
    with open(os.path.join(folder, "corridor.yaml"), "w", encoding="utf-8") as file:
        file.write(MAP)
    with open(os.path.join(folder, "corridor.pgm"), "wb") as file:
        file.write(picture())
    car, arm, polygon, walls = (scene(f"{name}.scene") for name in ("car-20", "puma", "poly-easy", "walls"))
    room = os.path.join(folder, "corridor.yaml")
    ends = ["--start", "-1.0,1.6", "--goal", "0.9,2.6"]
    for seed in (1, 2, 3):
        yield f"car {seed}", [car, "--seed", seed, "--optimise"]
        yield f"turning polygon {seed}", [polygon, "--seed", seed, "--optimise"]
        yield f"arm {seed}", [arm, "--seed", seed, "--optimise"]
    yield "car backwards", [car, "--steering", "reeds-shepp", "--optimise"]
    yield "car by roadmap", [car, "--planner", "prm", "--samples", 300]
    yield "arm by roadmap", [arm, "--planner", "prm", "--samples", 800, "--sampler", "mixture"]
    yield "arm by a tree", [arm, "--planner", "rrt", "--nodes", 3000]
    yield "turning among walls", [walls, "--optimise"]
    yield "grid of headings", [walls, "--planner", "grid", "--cell", 10, "--angles", 24]
    yield "disc on a turned map", [room, *ends, "--robot", "disc 0.08", "--optimise"]
    yield "polygon on a turned map", [room, "--start", "-1.0,1.6,0.2", "--goal", "0.9,2.6,1", "--robot",
                                      "polygon -0.1 -0.05 0.1 -0.05 0.1 0.05 -0.1 0.05"]
    yield "grid on a turned map", [room, *ends, "--planner", "grid", "--robot", "disc 0.08"]
    points = [polygon, "--robot", "point", "--start", "-3.14,0.23", "--goal", "3.86,0.23"]
    for planner in ("visibility", "cells", "voronoi", "lazy-prm"):
        yield f"point by {planner}", [*points, "--planner", planner]
    yield "widest way", [*points, "--planner", "voronoi", "--objective", "clearance"]
    yield "disc among polygons", [polygon, "--robot", "disc 0.1", "--start", "-3.14,0.23", "--goal", "3.86,0.23", "--planner",
                                  "voronoi"]
    for sampler in ("gaussian", "bridge", "halton"):
        yield f"point by {sampler} samples", [*points, "--planner", "prm", "--sampler", sampler, "--samples", 400, "--optimise"]
    yield "star", [*points, "--planner", "prm", "--samples", 500, "--radius", "star"]
    yield "maze", ["maze:120x120,seed=3", "--optimise"]
    yield "maze with loops", ["maze:60x60,seed=4,loops=0.1", "--pipeline", "plain", "--optimise"]
    yield "maze by samples", ["maze:15x15,seed=5", "--sampler", "uniform", "--clearance", 0.2, "--optimise"]


def answer(command, environment, timeout_s):
    done = subprocess.run([str(word) for word in command], capture_output=True, timeout=timeout_s, check=False,
                          env={**os.environ, **environment})
    return done.returncode, CHANGEABLE.sub("", done.stdout.decode("utf-8")), done.stderr.decode("utf-8", "replace")


def first_difference(one, other):
    numbers = [re.split(r"[\n,\[\]]+", text) for text in (one, other)]
    for a, b in zip(*numbers):
        if a != b:
            return f"{a.strip()} and {b.strip()}"
    return "one is longer"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--against", type=str.split, help="the other program, behind its emulator if it needs one")
    parser.add_argument("--only", default="", help="runs whose name holds this")
    parser.add_argument("--timeout", type=float, default=120.0, help="seconds, for each run")
    parser.add_argument("--show", action="store_true", help="name each run, and how long both took")
    options = parser.parse_args()
    other = options.against or [options.program]
    hidden = {} if options.against else {"GLIBC_TUNABLES": HIDDEN}
    wrong = runs = 0
    with tempfile.TemporaryDirectory(prefix="same-bytes-") as folder:
        for name, words in cases(folder):
            if options.only not in name:
                continue
            solve = ["solve", *words, "--threads", 2, "--quiet", "--json", "-"]
            begin = time.monotonic()
            code, text, said = answer([options.program, *solve], {}, options.timeout)
            middle = time.monotonic()
            other_code, other_text, _ = answer([*other, *solve], hidden, options.timeout)
            runs += 1
            if options.show:
                print(f"{name}: {middle - begin:.2f} s and {time.monotonic() - middle:.2f} s", flush=True)
            if code != 0:
                print(f"{name}: exit code {code}: {' '.join(map(str, solve))}\n  {said.strip()}")
            elif (other_code, other_text) != (code, text):
                print(f"{name}: exit codes {code} and {other_code}, {first_difference(text, other_text)}: "
                      f"{' '.join(map(str, solve))}")
            else:
                continue
            wrong += 1
    print(f"{runs} runs, {wrong} differ or failed")
    return 1 if wrong or not runs else 0


if __name__ == "__main__":
    sys.exit(main())
