#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How soon is a path near the best? anytime_table.py PROGRAM [WORLD...] [--against-ompl [RIVAL]] [--csv FILE]

Each world is solved with `--planner anytime --budget 2s --threads 1` by seeds 1 to 20. Without WORLD these are points
among 40 and 300 polygons and in a maze, a square that turns among walls, a polygon among polygons, an L among slits, a
car that parks and one among 20 obstacles by either steering, and three questions to a Puma among 20 spheres: worlds of
examples/, of `warren generate`, and of the functions below. RIVAL is rival_ompl_anytime, which the build has where
libompl-dev is installed: its planners solve the same worlds, seed by seed in turns with warren, with warren's check of
motions and warren's metric.

Prints a table in Markdown: the median of the milliseconds in which a run came to its first path, and within 10, 5, 2
and 1 % of the best cost that is known; - where half of the runs did not. Behind them how much more than the best the
median run cost in the end. The best known is the shortest of the planner visibility where that takes the world
(exact), else the best of all runs here, which have been verified: run longer to know better (--reference 30s adds such
a run of warren that counts for nothing else).

Times are CPU time. Warren tells wall-clock seconds since its search began; they count with the share of a core that the
search had, but its budget ends by the clock: on a busy machine it has less of it. OMPL's begin when its planner is
made. The line "OMPL" has in each column the best of its planners; --all prints each of them. --csv writes all of them:
milliseconds, runs, and what is left out: paths that warren's judge refutes, paths of no cost, and runs that a failed
assertion of OMPL's ended."""

import argparse
import csv
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EXAMPLES = os.path.join(ROOT, "examples", "worlds")
RIVAL = os.path.join(ROOT, "build", "bench", "bench", "rival_ompl_anytime")
OMPL = ("RRTConnect", "RRT*", "InformedRRT*", "RRT#", "RRTX", "BIT*", "ABIT*", "AIT*", "PRM*", "LazyPRM*", "FMT*", "BFMT*",
        "CForest", "APS")  # each in a process of its own, for some end with a failed assertion
WITHIN = [("first", math.inf), ("10 %", 0.10), ("5 %", 0.05), ("2 %", 0.02), ("1 %", 0.01)]
NEVER = math.inf


class Run:
    """One planner, one seed: costs that were reached, ascending by the second at which they were."""

    def __init__(self, planner, improvements, refuted=0, none=0, died=False):
        self.planner, self.improvements = planner, improvements
        self.refuted, self.none, self.died = refuted, none, died

    def seconds_to(self, cost):
        return next((at for at, reached in self.improvements if reached <= cost), NEVER)

    def last(self):
        return self.improvements[-1][1] if self.improvements else math.inf


class Row:
    """What a planner did in all its runs of one world, against the best known cost."""

    def __init__(self, planner, runs, best):
        self.planner, self.runs = planner, runs
        self.solved = sum(1 for run in runs if run.improvements)
        self.left_out = [sum(run.refuted for run in runs), sum(run.none for run in runs), sum(run.died for run in runs)]
        limits = [best * (1.0 + share) if share < math.inf else math.inf for _, share in WITHIN]
        # Half of the runs must have come there: of two middle ones the later counts.
        self.ms = [1e3 * statistics.median_high(run.seconds_to(limit) for run in runs) for limit in limits]
        self.over = statistics.median_high(run.last() for run in runs) / best - 1.0

    def texts(self):
        return [*map(ms_text, self.ms), share_text(self.over)]


def ms_text(ms):
    return "–" if ms == NEVER else f"{ms:.2f}" if ms < 10 else f"{ms:.1f}" if ms < 100 else f"{ms:,.0f}"


def share_text(share):
    return "–" if share == math.inf else f"{100 * max(share, 0.0):.3f} %"


def best_of(rows):
    """In each column the best of the planners, with its name."""
    columns = []
    for i, _ in enumerate(WITHIN):
        best = min(rows, key=lambda row: row.ms[i])
        columns.append("–" if best.ms[i] == NEVER else f"{ms_text(best.ms[i])} {best.planner}")
    best = min(rows, key=lambda row: row.over)
    columns.append("–" if best.over == math.inf else f"{share_text(best.over)} {best.planner}")
    return columns


# Worlds that no file of examples/ has.


def slits_scene(width=1.2):
    """An L, arms 1.8 long and 0.3 wide, must turn through three slits: the world of rival_ompl_se2."""
    lines = ["bounds 0 0 12 8"]
    for i, gap in enumerate((5.6, 1.2, 5.6)):
        x = 3.0 * (i + 1)
        for low, high in ((0.01, gap), (gap + width, 7.99)):
            lines.append(f"polygon {x} {low} {x + 0.3:.1f} {low} {x + 0.3:.1f} {high} {x} {high}")
    lines.append("robot polygon -0.15 -0.15 1.65 -0.15 1.65 0.15 0.15 0.15 0.15 1.65 -0.15 1.65")
    return lines + ["start 0.5 0.5 0", "goal 10.3 6 0"]


def sphere_scenes(seed, count=20):
    """A Puma with a tool among spheres, none at its base, and one question after the other."""
    rng = random.Random(seed)
    spheres = []
    while len(spheres) < count:
        x, y, z = (rng.uniform(-1.0, 1.0) for _ in range(3))
        radius = rng.uniform(0.1, 0.2)
        if math.hypot(x, y, z) > radius + 0.3:
            spheres.append(f"sphere {x} {y} {z} {radius}")
    degrees = [(-160, 160), (-225, 45), (-45, 225), (-110, 170), (-100, 100)]
    while True:
        ends = [[math.radians(rng.uniform(*limits)) for limits in degrees] + [0.0] for _ in range(2)]
        states = [" ".join(map(str, end)) for end in ends]
        yield ["robot puma560 radius 0.05 tool 0.2", *spheres, "start " + states[0], "goal " + states[1]]


class Bench:
    def __init__(self, arguments, folder):
        self.program, self.folder = os.path.abspath(arguments.program), folder
        self.rival = arguments.against_ompl and os.path.abspath(arguments.against_ompl)
        self.asked = arguments

    def write(self, name, lines):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="ascii") as file:
            file.write("\n".join(lines) + "\n")
        return path

    def generated(self, *words):
        path = os.path.join(self.folder, "-".join(words) + ".scene")
        subprocess.run([self.program, "generate", *words, "-o", path], check=True, stdout=subprocess.DEVNULL)
        return path

    def puma(self, seed):
        """The first question of that seed for which a path is found soon, but not the straight one."""
        for scene in sphere_scenes(seed):
            path = self.write(f"spheres-{seed}.scene", scene)
            answer = self.answer([path, "--planner", "anytime", "--iterations", "50"])
            if answer["verified"] and answer["stopped_by"] != "optimum":
                return path
        raise AssertionError

    def worlds(self):
        """(name, words of a command: the world first)."""
        if self.asked.worlds:
            return [(os.path.basename(world), [world]) for world in self.asked.worlds]
        example = {name: os.path.join(EXAMPLES, name + ".scene") for name in ("walls", "poly-easy", "parking-lot", "car-20")}
        pumas = [(f"Puma, 20 spheres, seed {seed}", [self.puma(seed)]) for seed in (1, 2, 3)]
        return [
            ("point, 40 polygons", [self.generated("polygons", "40")]),
            ("point, 300 polygons", [self.generated("polygons", "300")]),
            ("point, maze 15 × 15", ["maze:15x15,loops=0.1"]),
            ("square of 50 that turns among walls", [example["walls"]]),
            ("polygon among 10 polygons", [example["poly-easy"]]),
            ("L, three slits", [self.write("slits.scene", slits_scene())]),
            ("car, gap of 6 m, Reeds–Shepp", [example["parking-lot"], "--steering", "reeds-shepp"]),
            ("car, 20 obstacles, Reeds–Shepp", [example["car-20"], "--steering", "reeds-shepp"]),
            ("car, 20 obstacles, Dubins", [example["car-20"], "--steering", "dubins"]),
            *pumas,
        ]

    def answer(self, words):
        done = subprocess.run([self.program, "solve", *words, "--threads", "1", "--json", "-", "--no-path", "--quiet"],
                              capture_output=True, text=True, check=False)
        if not done.stdout.startswith("{"):
            sys.exit(f"warren solve {' '.join(words)}: {done.stderr.strip()}")
        return json.loads(done.stdout)

    def exact(self, words):
        """The shortest length of all, or none where no planner proves one."""
        done = subprocess.run([self.program, "solve", *words, "--planner", "visibility", "--json", "-", "--no-path", "--quiet"],
                              capture_output=True, text=True, check=False)
        answer = json.loads(done.stdout) if done.returncode == 0 else {}
        return answer.get("length") if answer.get("optimal") else None

    def run(self, planner, words, seed, budget):
        """The judge has seen the last path of the improvements: it is the answer's."""
        answer = self.answer([*words, "--planner", planner, "--budget", budget, "--seed", str(seed)])
        if not answer["verified"]:
            return Run(planner, [], refuted=answer["status"] == "refuted")
        stages = answer["stages_s"]
        share = stages["search_cpu"] / stages["search"]
        return Run(planner, [(share * each["seconds"], each.get("cost", each["length"])) for each in answer["improvements"]])

    def rival_run(self, planner, words, seed, budget_s):
        """A run without a path where the planner ended by an assertion, or not at all."""
        command = [self.rival, *words, "--planners", planner, "--seed", str(seed), "--budget", str(budget_s)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=60 + 30 * budget_s)
            said, code = done.stderr.strip(), done.returncode
        except subprocess.TimeoutExpired:
            said, code = "still running", -1
        if code > 0:
            sys.exit(f"{' '.join(command)}: {said}")
        told = json.loads(done.stdout)[0] if code == 0 else {"refuted": 0, "none": 0, "improvements": [], "threw": said}
        if "threw" in told:
            print(f"{words[0]}, seed {seed}: {planner}: {told['threw']}", file=sys.stderr)
        found = [(each["seconds"], each["cost"]) for each in told["improvements"]]
        return Run(planner, found, told["refuted"], told["none"], died=code < 0)

    def rows(self, words):
        """Warren's and OMPL's planners in one world; what the best costs, and is that exact?"""
        runs = []
        for seed in range(1, self.asked.seeds + 1):
            runs += [self.run(planner, words, seed, f"{self.asked.budget}s") for planner in self.asked.planners]
            runs += [self.rival_run(planner, words, seed, self.asked.budget) for planner in (OMPL if self.rival else ())]
        known = [run.last() for run in runs]
        if self.asked.reference:
            known.append(self.run("anytime", words, 1, self.asked.reference).last())
        exact = self.exact(words)
        best = exact if exact else min(known)
        names = list(dict.fromkeys(run.planner for run in runs))
        return [Row(name, [run for run in runs if run.planner == name], best) for name in names], best, exact is not None


def printed(name, best, exact, rows, asked):
    if best == math.inf:
        return [f"| {name} | no path |" + " |" * len(WITHIN) + " |"]
    ours = [row for row in rows if row.planner in asked.planners]
    theirs = [row for row in rows if row.planner not in asked.planners]
    lines = [("OMPL", best_of(theirs))] if theirs else []
    lines += [(row.planner, row.texts()) for row in (rows if asked.all else ours)]
    heads = [f"{name} ({best:.6g}{', exact' if exact else ''})"] + [""] * (len(lines) - 1)
    return [f"| {head} | {' | '.join([who, *texts])} |" for head, (who, texts) in zip(heads, lines)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("worlds", nargs="*", metavar="WORLD")
    parser.add_argument("--against-ompl", metavar="RIVAL", nargs="?", const=RIVAL,
                        help="the program rival_ompl_anytime (default: that of build/bench)")
    parser.add_argument("--planners", default="anytime", help="of warren, apart by commas (default: anytime)")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--budget", type=float, default=2.0, help="seconds of each run")
    parser.add_argument("--reference", metavar="TIME", help="one more run, so long, for the best known cost")
    parser.add_argument("--all", action="store_true", help="print each of OMPL's planners, too")
    parser.add_argument("--csv", metavar="FILE")
    asked = parser.parse_args()
    asked.planners = asked.planners.split(",")
    table = [["world", "best", "exact", "planner", "runs", "solved", *(f"ms {name}" for name, _ in WITHIN),
              "over best in the end", "refuted", "of no cost", "died"]]
    left_out = [0, 0, 0]
    print("| problem (best known) | | " + " | ".join(name for name, _ in WITHIN) + f" | after {asked.budget:g} s |")
    print("|---" * (len(WITHIN) + 3) + "|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(asked, folder)
        for name, words in bench.worlds():
            rows, best, exact = bench.rows(words)
            print("\n".join(printed(name, best, exact, rows, asked)), flush=True)
            left_out = [sum(counts) for counts in zip(left_out, *(row.left_out for row in rows))]
            table += [[name, best, exact, row.planner, len(row.runs), row.solved, *row.ms, row.over, *row.left_out]
                      for row in rows]
    refuted, none, died = left_out
    print(f"\nLeft out: {refuted} paths that the judge refuted, {none} of no cost; {died} runs that an assertion ended.")
    if asked.csv:
        with open(asked.csv, "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows(table)


if __name__ == "__main__":
    main()
