#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a run holds at its peak, beside what --memory lets it hold: every field of tests/matrix/planners.table, three
limits each, in worlds and with numbers of milestones that want more.

  memory_test.py PROGRAM [--share K/N] [--pick WORD] [--show]

--share asks the K-th of N shares of the runs, dealt by their names and by WORD (without it by WARREN_PICK, which is the
commit in tools/check); with WARREN_SEEDS=all it asks all of them.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

LIMITS_MIB = (24, 48, 96)
BESIDE_MIB = 16  # what a process may hold beyond its limit: docs/file_formats.md
ANSWERS = {0, 1, 124}  # solved, no path, stopped
TABLE = Path(__file__).parent.parent / "matrix" / "planners.table"
# The goal's room is closed, so that no tree arrives and no roadmap is done early.
ROOM = "wall 90 90 96 90\nwall 96 90 96 96\nwall 96 96 90 96\nwall 90 96 90 90\n"
HEADINGLESS = ("point", "disc")
BODIES = {
    "point": "robot point\n",
    "disc": "robot disc 0.1\n",
    "polygon": "robot polygon -0.2 -0.1 0.2 -0.1 0.2 0.1 -0.2 0.1\n",
    "car": "robot car radius 0.1 turning 0.5 steering dubins\n",
}
MORE = {  # what a planner is asked for, beyond the world
    "prm": ["--samples", "400000"],
    "lazy-prm": ["--samples", "400000"],
    "rrt": ["--nodes", "2000000"],
    "rrt-connect": ["--nodes", "2000000"],
}


def plane(body: str) -> str:
    walls = "".join(f"wall {x} {y} {x + 0.7} {y + 0.4}\n" for x in range(1, 88, 2) for y in range(1, 88, 2))
    yaw = "" if body in HEADINGLESS else " 0"
    return f"bounds 0 0 100 100\n{ROOM}{walls}{BODIES[body]}start 0.5 0.5{yaw}\ngoal 93 93{yaw}\n"


def write_map(folder: Path) -> None:
    side = 1500
    rows = [bytearray(b"\xff" * side) for _ in range(side)]
    for y in range(20, side, 40):
        for x in range(20, side, 40):
            for row in rows[y : y + 9]:
                row[x : x + 9] = bytes(9)
    for y in range(100, 161):  # the goal's room, rows from the top
        rows[y][1400:1461] = bytes(61) if y in (100, 160) else b"\0" + b"\xff" * 59 + b"\0"
    (folder / "map.pgm").write_bytes(b"P5 %d %d 255\n" % (side, side) + b"".join(rows))
    (folder / "map.yaml").write_text("image: map.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\n"
                                     "occupied_thresh: 0.65\nfree_thresh: 0.196\n")


def question(column: str, folder: Path) -> list[str]:
    """The world's file and what makes the column's question of it."""
    if column == "arm":
        around = "".join(f"box {x} {y} -0.2 {x + 0.05} {y + 0.05} 0.2\n" for x in (-2, 2) for y in range(-2, 3))
        (folder / "arm.scene").write_text(f"robot puma560 radius 0.05\n{around}sphere 0.8 0.4 0.75 0.3\n"
                                          "start 0 0 0 0 0 0\ngoal 0.3048 -0.1646 -2.8118 0 0 0\n")
        return ["arm.scene"]
    body = column.removesuffix("_on_map")
    if not column.endswith("_on_map"):
        (folder / f"{body}.scene").write_text(plane(body))
        return [f"{body}.scene"]
    yaw = "" if body in HEADINGLESS else ",0"
    robot = BODIES[body].removeprefix("robot ").strip()
    return ["map.yaml", "--robot", robot, "--start", f"0.5,0.5{yaw}", "--goal", f"143,137{yaw}"]


def fields() -> list[tuple[str, ...]]:
    planner, found = "", []
    for line in TABLE.read_text().splitlines():
        words = line.split()
        if words[:1] == ["planner"]:
            planner = words[1]
        elif words[:1] == ["field"]:
            found.append((planner, words[1]))
    return found


def run(words: list[str], folder: Path) -> tuple[int, float, str]:
    process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_maxrss / 1024, said.strip()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--share", type=lambda text: tuple(map(int, text.split("/"))), default=(1, 1))
    parser.add_argument("--pick", default=os.environ.get("WARREN_PICK", ""))
    parser.add_argument("--show", action="store_true")
    options = parser.parse_args()
    share, shares = (1, 1) if os.environ.get("WARREN_SEEDS") == "all" else options.share
    wrong, asked, stopped = 0, 0, 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_map(folder)
        # and where each milestone has all others within its radius, and where trees grow side by side
        for planner, column, *more in fields() + [("prm", "point", "--radius", "300", "--samples", "60000"),
                                                  ("rrt-connect", "polygon", "--trees", "8", "--nodes", "2000000")]:
            words = question(column, folder)
            for limit in LIMITS_MIB:
                if zlib.crc32(f"{options.pick} {planner} {column} {limit} {more}".encode()) % shares != share - 1:
                    continue
                code, peak, said = run([options.program, "solve", *words, "--planner", planner, *(more or MORE.get(planner, [])), "--budget",
                                        "10s", "--memory", f"{limit}MiB", "--threads", "2", "--quiet"], folder)
                asked += 1
                stopped += code == 124
                good = code in ANSWERS and peak <= limit + BESIDE_MIB
                wrong += not good
                if options.show or not good:
                    print(f"{'' if good else 'WRONG '}{planner} {column} --memory {limit}MiB: peak {peak:.0f} MiB, exit {code} {said}",
                          flush=True)
    print(f"{asked} runs, {stopped} stopped at their limit, {wrong} wrong")
    return 1 if wrong or not asked else 0


if __name__ == "__main__":
    sys.exit(main())
