#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How often does `warren build` without --samples stop too early? auto_samples.py PROGRAM [--seeds N] [--only WORD]

For each world and seed a roadmap is built as `--samples auto` has it, and one of four times as many samples with
another seed. Random questions go to both: one that the denser roadmap answers and the other does not is missed. Prints
a row a world: the samples drawn (median), questions that have a path, the share of them that is missed, and the builds
in which more than one in a hundred is."""

import argparse
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile

QUESTIONS = 300
DENSER = 4
EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples", "worlds")
# What is asked, and the words of build. {seed} makes another world of each seed, where there are others.
CASES = [
    ("maze 41×41", ["maze:41x41,seed={seed}", "--sampler", "uniform"]),
    ("maze 100×100, loops 0.1", ["maze:100x100,loops=0.1,seed={seed}", "--sampler", "uniform"]),
    ("200 polygons", ["{polygons:200}"]),
    ("2,000 polygons", ["{polygons:2000}"]),
    ("2,000 polygons, disc of 0.3", ["{polygons:2000}", "--robot", "disc 0.3"]),
    ("2,000 polygons, bar of 4", ["{polygons:2000}", "--robot", "polygon -2 -0.1 2 -0.1 2 0.1 -2 0.1"]),
    ("town.geojson", ["{examples}/town.geojson"]),
    ("flat.yaml", ["{examples}/flat.yaml"]),
    ("walls.scene, square of 50", ["{examples}/walls.scene"]),
    ("car-20.scene", ["{examples}/car-20.scene"]),
    ("parking-lot.scene", ["{examples}/parking-lot.scene"]),
    ("puma.scene", ["{examples}/puma.scene"]),
]


class Campaign:
    def __init__(self, program, folder):
        self.program, self.folder = os.path.abspath(program), folder

    def run(self, *words, text=None):
        done = subprocess.run([self.program, *words], input=text, cwd=self.folder, capture_output=True, text=True)
        if done.returncode not in (0, 65):  # 65: a question that can't be asked, such as a joint beyond its limits
            sys.exit(f"warren {' '.join(words)}: {done.stderr}")
        return done.stdout

    def world(self, word, seed):
        if word.startswith("{polygons:"):
            count = word[len("{polygons:"):-1]
            self.run("generate", "polygons", count, "--seed", str(seed), "-o", "world.scene")
            return "world.scene"
        return word.format(seed=seed, examples=EXAMPLES)

    def build(self, words, name, *more):
        self.run("build", *words, "-o", name, *more)
        return json.loads(self.run("info", name, "--json", "-"))

    def answered(self, name, questions):
        lines = self.run("query", name, "--batch", "-", "--lengths-only", text=questions).splitlines()
        return [json.loads(line).get("status") for line in lines]

    def questions(self, world, kept, dice):
        about = json.loads(self.run("info", world, "--json", "-"))
        box = about.get("bounds") or about.get("box")
        if kept["dimension"] == 6:
            names, ranges = [str(k + 1) for k in range(6)], [(-math.pi, math.pi)] * 6
        else:
            names, ranges = ["x", "y"], [(box[0], box[2]), (box[1], box[3])]
            if kept["dimension"] == 3:
                names, ranges = names + ["theta"], ranges + [(-math.pi, math.pi)]
        header = ",".join(f"{end}_{name}" for end in ("start", "goal") for name in names)
        rows = [",".join(repr(dice.uniform(*span)) for span in ranges * 2) for _ in range(QUESTIONS)]
        return "\n".join([header, *rows, ""])

    def ask(self, words, seed):
        """Samples drawn, questions that have a path, and how many of them the roadmap misses."""
        words = [self.world(word, seed) for word in words]
        kept = self.build(words, "auto.roadmap", "--seed", str(seed))
        self.build(words, "dense.roadmap", "--seed", str(seed + 1000), "--samples", str(DENSER * kept["drawn"]))
        questions = self.questions(words[0], kept, random.Random(seed))
        pairs = list(zip(self.answered("auto.roadmap", questions), self.answered("dense.roadmap", questions)))
        some = sum("solved" in pair for pair in pairs)
        return kept["drawn"], some, sum(a != "solved" and b == "solved" for a, b in pairs)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    print("| world | samples, median | questions with a path | missed | builds that miss over 1 % |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory(prefix="warren-auto-") as folder:
        campaign = Campaign(options.program, folder)
        for name, words in CASES:
            if options.only not in name:
                continue
            asked = [campaign.ask(words, seed) for seed in range(1, options.seeds + 1)]
            paths, missed = sum(a[1] for a in asked), sum(a[2] for a in asked)
            bad = sum(a[2] > 0.01 * a[1] for a in asked)
            print(f"| {name} | {statistics.median(a[0] for a in asked):,.0f} | {paths:,} | {missed / max(paths, 1):.2%} | "
                  f"{bad} of {len(asked)} |", flush=True)


if __name__ == "__main__":
    main()
