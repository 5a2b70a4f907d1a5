#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Does the lattice solve what is public? car_lattice_sets.py PROGRAM FOLDER [--worlds N] [--steering WORD]

FOLDER holds tpcap/Case*.csv, bench-mr/parking*.svg and barn/cylinders.csv, which are not part of this project. Each TPCAP
case is moved to its start and solved by `--planner grid`, the car parks of Bench-MR with its car and a turning radius of
4 m, each BARN world with the body of a Jackal and a turning radius of 0.4 m. Answers are verified again. Prints a row
each: outcome, length, ended by, gap of the lattice, states expanded, seconds of stamps and search. Exit code 1 where an
answer is not verified."""

import argparse
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile

CAR = "car polygon -0.929 -0.971 3.76 -0.971 3.76 0.971 -0.929 0.971 turning 3.0"
# Of the scenarios of Bench-MR in their pictures, by where their goals lie between parked cars: the file doesn't say it.
ORIGIN = (1.28, -4.88)
JACKAL = "car polygon -0.254 -0.215 0.254 -0.215 0.254 0.215 -0.254 0.215 turning 0.4"


def tpcap(folder):
    for number in range(1, 21):
        path = os.path.join(folder, "tpcap", f"Case{number}.csv")
        if not os.path.exists(path):
            continue
        numbers = [float(x) for x in open(path, encoding="ascii").read().replace("\n", ",").split(",") if x.strip()]
        x0, y0, t0, xf, yf, tf = numbers[:6]
        count = int(numbers[6])
        corners = [int(n) for n in numbers[7:7 + count]]
        rest = numbers[7 + count:]
        lines, at = [], 0
        for n in corners:
            points = [(rest[at + 2 * i] - x0, rest[at + 2 * i + 1] - y0) for i in range(n)]
            at += 2 * n
            lines.append("polygon " + " ".join(f"{x!r} {y!r}" for x, y in points))
        ends = [(0.0, 0.0), (xf - x0, yf - y0)]
        low = [min(p[i] for p in ends) - 15.0 for i in (0, 1)]
        high = [max(p[i] for p in ends) + 15.0 for i in (0, 1)]
        lines.append(f"bounds {low[0]} {low[1]} {high[0]} {high[1]}")
        lines.append(f"start 0 0 {math.remainder(t0, 2 * math.pi)!r}")
        lines.append(f"goal {xf - x0!r} {yf - y0!r} {math.remainder(tf, 2 * math.pi)!r}")
        yield f"tpcap {number}", CAR, lines


def outlines(path):
    """Of an SVG file's paths, in its units, y upwards; relative commands alone: m, l, h, v, z."""
    text = open(path, encoding="utf-8").read()
    moved = [float(x) for x in re.search(r'translate\(([^,]+),([^)]+)\)', text).groups()]
    for path_words in re.findall(r'\sd="([^"]*)"', text):
        at, points, command = [moved[0], moved[1]], [], "m"
        words = re.findall(r'[-+.0-9][-+.0-9e]*|[A-Za-z]', path_words)
        while words:
            if words[0].isalpha():
                command = words.pop(0)
            if command not in "mlhv":
                if command != "z" or words:
                    raise ValueError(f"{path}: a path has the command {command}")
                continue
            if command in "mlh":
                at[0] += float(words.pop(0))
            if command in "mlv":
                at[1] += float(words.pop(0))
            points.append((at[0], -at[1]))
        while math.dist(points[0], points[-1]) < 1e-3:  # closed by hand
            points.pop()
        yield points


def bench_mr(folder):
    folder = os.path.join(folder, "bench-mr")
    if not os.path.isdir(folder):
        return
    body = next(outlines(os.path.join(folder, "car.svg")))
    middle = [(min(p[i] for p in body) + max(p[i] for p in body)) / 2 for i in (0, 1)]
    robot = "car polygon " + " ".join(f"{x - middle[0]!r} {y - middle[1]!r}" for x, y in body) + " turning 4.0"
    with open(os.path.join(folder, "scenarios.json"), encoding="utf-8") as file:
        scenarios = json.load(file)["scenarios"]
    for park, ends in scenarios.items():
        polygons = list(outlines(os.path.join(folder, park + ".svg")))
        low, high = ([pick(p[i] for points in polygons for p in points) for i in (0, 1)] for pick in (min, max))
        lines = ["polygon " + " ".join(f"{x!r} {y!r}" for x, y in points) for points in polygons]
        lines.append(f"bounds {low[0] - 15} {low[1] - 15} {high[0] + 15} {high[1] + 15}")
        for number, end in enumerate(ends, 1):
            said = [f"{word} {end[word][0] + ORIGIN[0]!r} {end[word][1] + ORIGIN[1]!r} {end[word][2]!r}"
                    for word in ("start", "goal")]
            yield f"{park} {number}", robot, lines + said


def barn(folder):
    path = os.path.join(folder, "barn", "cylinders.csv")
    for row in csv.reader(open(path, encoding="ascii")):
        if row[0].startswith("#"):
            continue
        numbers = [float(x) / 1000.0 for x in row[1:] if x]
        lines = []
        for x, y in zip(numbers[::2], numbers[1::2]):
            ring = [(x + 0.075 / math.cos(math.pi / 8) * math.cos(math.pi * (2 * i + 1) / 8),
                     y + 0.075 / math.cos(math.pi / 8) * math.sin(math.pi * (2 * i + 1) / 8)) for i in range(8)]
            lines.append("polygon " + " ".join(f"{a!r} {b!r}" for a, b in ring))
        lines += [f"start -2 3 {math.pi / 2!r}", f"goal -2 13 {math.pi / 2!r}", "bounds -4.6 0 0.6 14"]
        yield f"barn {row[0]}", JACKAL, lines


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--worlds", type=int, default=20, help="of BARN")
    parser.add_argument("--steering", default="reeds-shepp")
    parser.add_argument("--planner", default="grid")
    parser.add_argument("--only", default="", help="a part of the names")
    parser.add_argument("--words", default="", help="further words of solve")
    asked = parser.parse_args()
    wrong = 0
    worlds = list(tpcap(asked.folder)) + list(bench_mr(asked.folder)) + list(barn(asked.folder))[:asked.worlds]
    worlds = [world for world in worlds if asked.only in world[0]]
    with tempfile.TemporaryDirectory() as folder:
        for name, robot, lines in worlds:
            world, answer = os.path.join(folder, "world.scene"), os.path.join(folder, "answer.json")
            with open(world, "w", encoding="ascii") as file:
                file.write("\n".join(lines + [f"robot {robot} steering {asked.steering}"]) + "\n")
            words = [asked.program, "solve", world, "--planner", asked.planner, "--json", answer, *asked.words.split()]
            done = subprocess.run(words, capture_output=True, text=True, check=False)
            if not os.path.exists(answer):
                print(f"{name:12} {done.stderr.strip()}")
                wrong += 1
                continue
            told = json.load(open(answer, encoding="ascii"))
            again = subprocess.run([asked.program, "verify", world, answer], capture_output=True, text=True, check=False)
            os.remove(answer)
            is_right = told["status"] != "solved" or again.returncode == 0
            wrong += not is_right
            stages = told["stages_s"]
            print(f"{name:12} {told['status']:14} {told['length'] or 0.0:8.2f} m {told.get('stopped_by') or '':10} "
                  f"gap {told.get('lattice_gap') or 0.0:6.3f}  cusps {told.get('cusps')}  "
                  f"expanded {told['counters']['expanded']:8}  stamps {stages.get('stamps_cpu', 0.0):.3f} s, "
                  f"search {stages.get('search_cpu', 0.0):.3f} s {'' if is_right else 'NOT VERIFIED: ' + again.stdout}",
                  flush=True)
    return 1 if wrong else 0


sys.exit(main())
