#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do cars drive as a driver would? car_parks.py PROGRAM [--seeds N]

Each car park of examples/worlds is solved with --optimise by each seed, verified again, and timed with the limits below.
Prints a row a car park: changes of gear of each seed, length, metres backwards, how long the drive takes, CPU time; and
by how much the drive comes near its limits at 10,000 even moments, measured here from the places of the file alone.
Exit code 1 where a drive changes gear more than three times, is not verified, or goes beyond a limit."""

import argparse
import csv
import json
import math
import os
import resource
import statistics
import subprocess
import sys
import tempfile

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "examples", "worlds")
PARKS = ["parking", "parking-lot", "square-place", "garage"]
SPEED, ACCELERATION, LATERAL = 1.5, 0.8, 0.6
MOMENTS = 10_000
MOST_CHANGES = 3


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, check=False)


def cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def rows_of(path):
    with open(path, encoding="ascii") as file:
        return [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]


def change(rows, i, name):
    return rows[i + 1][name] - rows[i][name]


def used_of_limits(rows):
    """The largest speed, acceleration and lateral acceleration as shares of their limits. Between two moments the place
    goes no farther, the speed changes no more, and the heading turns no faster than they allow: v * v / r = v * turn / t."""
    used = [0.0, 0.0, 0.0]
    for i in range(len(rows) - 1):
        t = change(rows, i, "t")
        if t < 1e-6:
            continue
        way = math.hypot(change(rows, i, "x"), change(rows, i, "y"))
        turn = abs(math.remainder(change(rows, i, "theta"), 2 * math.pi))
        speeding = abs(change(rows, i, "speed")) / t
        for k, share in enumerate((way / t / SPEED, speeding / ACCELERATION, way / t * turn / t / LATERAL)):
            used[k] = max(used[k], share)
    return used


def drive(program, park, seed, folder):
    scene = os.path.join(EXAMPLES, park + ".scene")
    answer, path = os.path.join(folder, "answer.json"), os.path.join(folder, "path.csv")
    timed = ["--path", path, "--speed", str(SPEED), "--acceleration", str(ACCELERATION), "--lateral-acceleration", str(LATERAL)]
    before = cpu_s()
    solved = run(program, "solve", scene, "--optimise", "--seed", str(seed), "--json", answer, "--quiet")
    cpu = cpu_s() - before
    if solved.returncode != 0 or run(program, "verify", scene, answer, "--quiet").returncode != 0:
        sys.exit(f"{park}, seed {seed}: not solved or not verified: {solved.stderr}")
    again = [program, "solve", scene, "--optimise", "--seed", str(seed), "--quiet", *timed]
    run(*again)
    duration = rows_of(path)[-1]["t"]
    run(*again, "--every", f"{duration / MOMENTS * 1e6:.3f}us")
    with open(answer, encoding="utf-8") as file:
        told = json.load(file)
    return told, duration, cpu, used_of_limits(rows_of(path))


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("--seeds", type=int, default=5)
    asked = arguments.parse_args()
    program = os.path.abspath(asked.program)
    is_bad = False
    print("| car park | changes of gear, by seed | length | backwards | takes | CPU s a solve | speed, acceleration, lateral: most of the limit |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for park in PARKS:
            drives = [drive(program, park, seed, folder) for seed in range(1, asked.seeds + 1)]
            cusps = [told["cusps"] for told, *_ in drives]
            used = [max(limits[k] for *_, limits in drives) for k in range(3)]
            is_bad |= max(cusps) > MOST_CHANGES or max(used) > 1.001
            middle = [statistics.median(values) for values in zip(*((told["length"], told["reversed_length"], duration, cpu)
                                                                    for told, duration, cpu, _ in drives))]
            print(f"| {park} | {', '.join(map(str, cusps))} | {middle[0]:.1f} | {middle[1]:.1f} | {middle[2]:.1f} s | "
                  f"{middle[3]:.2f} | {', '.join(f'{100 * share:.1f} %' for share in used)} |", flush=True)
    return 1 if is_bad else 0


if __name__ == "__main__":
    sys.exit(main())
