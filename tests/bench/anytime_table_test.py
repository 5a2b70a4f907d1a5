#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""bench/anytime_table.py on canned runs: when a run came near the best, medians, the best of each column, what is left
out. A program that answers like warren and one that answers like the rival stand in for both."""

import contextlib
import csv
import io
import math
import os
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True  # the checkout stays as it is
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "bench"))

import anytime_table as table

WARREN = '''#!/usr/bin/env python3
import json, sys
seed = sys.argv[sys.argv.index("--seed") + 1] if "--seed" in sys.argv else "1"
if "visibility" in sys.argv:
    sys.exit(2)
found = [{"seconds": 0.5, "length": 9, "cost": 12.0}, {"seconds": 1.0, "length": 9, "cost": 10.0}]
solved = seed != "3"
print(json.dumps({"status": "solved" if solved else "refuted", "verified": solved, "improvements": found,
                  "stages_s": {"search": 2.0, "search_cpu": 1.0}}))
'''
RIVAL = '''#!/usr/bin/env python3
import json, os, sys
planner = sys.argv[sys.argv.index("--planners") + 1]
if planner == "AIT*":
    os.abort()
found = {"RRT*": [[0.001, 20.0], [1.5, 10.05]]}.get(planner, [])
print(json.dumps([{"planner": planner, "seed": 1, "refuted": 2 if found else 0, "none": 3 if planner == "APS" else 0,
                   "improvements": [{"seconds": s, "cost": c} for s, c in found]}]))
'''


def row(*runs, best=10.0):
    return table.Row("p", [table.Run("p", list(run)) for run in runs], best)


class Rows(unittest.TestCase):
    def test_a_run_comes_near_the_best_when_it_first_costs_so_little(self):
        once = row([(0.001, 20.0), (0.002, 10.9), (0.004, 10.4), (0.008, 10.2), (0.016, 10.1)])
        self.assertEqual(once.ms, [1.0, 2.0, 4.0, 8.0, 16.0])
        self.assertAlmostEqual(once.over, 0.01)

    def test_half_of_the_runs_must_come_there(self):
        self.assertEqual(row([(0.001, 10.0)], [(0.003, 10.0)], []).ms[0], 3.0)
        self.assertEqual(row([(0.001, 10.0)], []).ms[0], math.inf)
        self.assertEqual(row([]).texts(), ["–"] * 6)

    def test_each_column_names_its_best(self):
        quick, good = row([(0.001, 20.0)]), row([(0.1, 10.0)])
        quick.planner, good.planner = "quick", "good"
        best = table.best_of([quick, good])
        self.assertEqual(best[0], "1.00 quick")
        self.assertEqual(best[1:], ["100 good"] * 4 + ["0.000 % good"])
        self.assertEqual(table.best_of([row([])]), ["–"] * 6)


class Worlds(unittest.TestCase):
    def test_generated_worlds_are_the_same_each_time(self):
        for scene in (table.slits_scene(), next(table.sphere_scenes(2))):
            self.assertTrue(any(line.startswith("goal ") for line in scene))
        self.assertEqual(next(table.sphere_scenes(2)), next(table.sphere_scenes(2)))
        self.assertNotEqual(next(table.sphere_scenes(1)), next(table.sphere_scenes(2)))


class WholeRun(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.warren, self.rival = self.script("warren", WARREN), self.script("rival", RIVAL)

    def script(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        os.chmod(path, 0o755)
        return path

    def test_table_and_csv_say_the_same(self):
        figures = os.path.join(self.folder.name, "t.csv")
        words = ["anytime_table.py", self.warren, "w.scene", "--against-ompl", self.rival, "--seeds", "3", "--csv", figures]
        said = io.StringIO()
        with mock.patch.object(sys, "argv", words), contextlib.redirect_stdout(said), contextlib.redirect_stderr(io.StringIO()):
            table.main()
        lines = said.getvalue().splitlines()
        self.assertEqual(lines[0], "| problem (best known) | | first | 10 % | 5 % | 2 % | 1 % | after 2 s |")
        self.assertIn("| w.scene (10) | OMPL | 1.00 RRT* | 1,500 RRT* | 1,500 RRT* | 1,500 RRT* | 1,500 RRT* | 0.500 % RRT* |", lines)
        # Half a core: half a second of the clock is a quarter of CPU time. The run that was refuted never comes.
        self.assertIn("|  | anytime | 250 | 500 | 500 | 500 | 500 | 0.000 % |", lines)
        self.assertEqual(lines[-1], "Left out: 7 paths that the judge refuted, 9 of no cost; 3 runs that an assertion ended.")
        with open(figures, encoding="utf-8", newline="") as file:
            rows = {one["planner"]: one for one in csv.DictReader(file)}
        self.assertEqual(list(rows), ["anytime", *table.OMPL])
        ours, shortening = rows["anytime"], rows["APS"]
        self.assertEqual((ours["runs"], ours["solved"], ours["ms first"]), ("3", "2", "250.0"))
        self.assertEqual((shortening["solved"], shortening["ms first"], shortening["of no cost"]), ("0", "inf", "9"))
        self.assertEqual(rows["AIT*"]["died"], "3")


if __name__ == "__main__":
    unittest.main()
