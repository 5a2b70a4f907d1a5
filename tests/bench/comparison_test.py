#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""tools/bench --compare: two runs of one program show no difference, a slowdown is found, ranks are counted rightly.

The files are canned: times are drawn from a fixed seed. comparison_test.py PROGRAM runs a real program as well.
"""

import contextlib
import io
import itertools
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True  # the checkout stays as it is
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "bench"))

import comparison
import rounds

PROGRAM = ""  # a warren_bench, if there is one
MACHINE = {f"bm_machine_{i}": 1e6 for i in range(3)}


def noisy(mean, rng, spread=0.03):
    """A time: most near the mean, some far above it, none far below."""
    late = rng.expovariate(1.0 / (5.0 * spread)) if rng.random() < 0.15 else 0.0
    return mean * (1.0 + abs(rng.gauss(0.0, spread)) + late)


def draw(means, rng, repetitions=5, spread=0.03):
    return {name: [noisy(mean, rng, spread) for _ in range(repetitions)] for name, mean in means.items()}


def many(count=200):
    return dict({f"bm_{i}/size:{i}": 10.0 ** (1 + i % 7) for i in range(count)}, **MACHINE)


def verdicts(compared):
    return {row[0]: row[-1] for row in compared.rows}


class Verdicts(unittest.TestCase):
    def test_two_runs_of_the_same_distribution_show_no_difference(self):
        for seed in range(20):
            for spread in (0.003, 0.03, 0.2):
                with self.subTest(seed=seed, spread=spread):
                    rng = random.Random(seed)
                    compared = comparison.Comparison(
                        draw(many(), rng, spread=spread), draw(many(), rng, spread=spread)
                    )
                    self.assertEqual(set(verdicts(compared).values()), {"no difference"})

    def test_a_slowdown_by_half_is_found_and_nothing_else(self):
        for seed in range(20):
            with self.subTest(seed=seed):
                rng = random.Random(seed)
                old, slower = many(), many()
                slower["bm_7/size:7"] *= 1.5
                slower["bm_8/size:8"] /= 1.5
                found = verdicts(comparison.Comparison(draw(old, rng, 7, 0.01), draw(slower, rng, 7, 0.01)))
                self.assertEqual(found.pop("bm_7/size:7"), "slower")
                self.assertEqual(found.pop("bm_8/size:8"), "faster")
                self.assertEqual(set(found.values()), {"no difference"})

    def test_what_the_whole_machine_slows_down_by_is_no_difference(self):
        rng = random.Random(3)
        old = many()
        slow_day = {name: 1.25 * mean for name, mean in old.items()}
        slow_day["bm_5/size:5"] *= 1.8
        compared = comparison.Comparison(draw(old, rng, spread=0.01), draw(slow_day, rng, spread=0.01))
        self.assertGreater(compared.tolerance, 0.15)
        found = verdicts(compared)
        self.assertEqual(found.pop("bm_5/size:5"), "slower")
        self.assertEqual(set(found.values()), {"no difference"})

    def test_a_few_per_cent_are_not_worth_a_word(self):
        old = dict({"bm": [100.0, 100.1, 100.2, 100.3, 100.4]})
        new = dict({"bm": [103.0, 103.1, 103.2, 103.3, 103.4]})
        self.assertEqual(verdicts(comparison.Comparison(old, new)), {"bm": "no difference"})

    def test_three_repetitions_tell_nothing(self):
        old = {"bm": [1.0, 1.0, 1.0]}
        new = {"bm": [9.0, 9.0, 9.0]}
        self.assertEqual(verdicts(comparison.Comparison(old, new)), {"bm": "too few repetitions"})
        four = {name: times + times[:1] for name, times in (("bm", new["bm"]),)}
        self.assertEqual(verdicts(comparison.Comparison({"bm": [1.0] * 4}, four)), {"bm": "slower"})


class Ranks(unittest.TestCase):
    def test_counts_are_those_of_all_orders(self):
        for m, n in itertools.product(range(1, 6), repeat=2):
            with self.subTest(m=m, n=n):
                counted = [0] * (m * n + 1)
                for places in itertools.combinations(range(m + n), m):
                    counted[sum(place - i for i, place in enumerate(places))] += 1
                self.assertEqual(comparison.rank_counts(m, n), counted)

    def test_the_interval_misses_as_seldom_as_it_says(self):
        rng = random.Random(1)
        for m, n, error in ((5, 5, 0.01), (7, 7, 0.05), (10, 6, 0.2)):
            _, promised = comparison.interval_ranks(m, n, error)
            self.assertLessEqual(promised, error)
            runs = 4000
            missed = 0
            for _ in range(runs):
                old = [math.exp(rng.gauss(0.0, 0.3)) for _ in range(m)]
                new = [2.0 * math.exp(rng.gauss(0.0, 0.3)) for _ in range(n)]
                ratio = comparison.Ratio(old, new, error)
                missed += not ratio.low <= 2.0 <= ratio.high
            self.assertLess(abs(missed / runs - promised), 5.0 * math.sqrt(promised / runs), f"{m} and {n}")

    def test_the_ratio_is_that_of_the_times(self):
        ratio = comparison.Ratio([2.0] * 5, [3.0] * 5, 0.01)
        self.assertEqual((ratio.low, ratio.ratio, ratio.high), (1.5, 1.5, 1.5))


def google_json(times, unit="ms"):
    """As Google Benchmark writes it, aggregates and an error among the runs."""
    entries = []
    for name, values in times.items():
        for value in values:
            entries.append(
                {"name": name, "run_type": "iteration", "cpu_time": value, "real_time": 2 * value, "time_unit": unit}
            )
        entries.append({"name": name + "_mean", "run_type": "aggregate", "cpu_time": 1e9, "time_unit": unit})
    entries.append({"name": "bm_failed", "run_type": "iteration", "error_occurred": True})
    return json.dumps({"context": {}, "benchmarks": entries})


class Files(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.addCleanup(self.directory.cleanup)

    def file(self, name, text):
        path = os.path.join(self.directory.name, name)
        with open(path, "w", encoding="utf-8") as out:
            out.write(text)
        return path

    def compare(self, old, new):
        words = [os.path.join(ROOT, "tools", "bench"), "--compare", old, new]
        return subprocess.run(words, capture_output=True, text=True, check=False)

    def test_compare_reads_files_and_says_it_by_text_and_exit_code(self):
        times = {"bm_a/1": [1.0, 1.01, 1.02, 1.0, 1.01], "bm_b": [5.0] * 5}
        old = self.file("old.json", google_json(times))
        same = self.compare(old, self.file("same.json", google_json({k: v[::-1] for k, v in times.items()})))
        self.assertEqual(same.returncode, 0, same.stderr)
        self.assertIn("no difference: 2 benchmarks", same.stdout)
        slow = self.compare(old, self.file("slow.json", google_json(dict(times, bm_b=[7.5] * 5))))
        self.assertEqual(slow.returncode, 1)
        self.assertRegex(slow.stdout, r"bm_b +5 ms +7.5 ms +1.50 +1.50 to 1.50 +slower")
        self.assertRegex(slow.stdout, r"bm_a/1 .*no difference")

    def test_units_are_minded(self):
        old = self.file("old.json", google_json({"bm": [1000.0] * 5}, "us"))
        new = self.file("new.json", google_json({"bm": [1.0] * 5}, "ms"))
        self.assertIn("no difference: 1 ", self.compare(old, new).stdout)

    def test_bad_files_are_one_line(self):
        good = self.file("good.json", google_json({"bm": [1.0] * 5}))
        for text in ("", "[]", "{}", '{"benchmarks": []}', '{"benchmarks": [{"name": "bm", "time_unit": "ms"}]}'):
            with self.subTest(text=text):
                done = self.compare(good, self.file("bad.json", text))
                self.assertEqual(done.returncode, 2)
                self.assertIn("bad.json", done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_a_file_that_is_not_there_is_66(self):
        done = self.compare(os.path.join(self.directory.name, "none.json"), "x")
        self.assertEqual(done.returncode, 66)

    def test_a_filter_that_matches_nothing_is_said(self):
        if not PROGRAM:
            self.skipTest("no program was named")
        file = os.path.join(self.directory.name, "none.json")
        words = [sys.executable, "-B", os.path.join(ROOT, "bench", "rounds.py"), "--filter=bm_nothing", "--repetitions=1"]
        done = subprocess.run(words + [f"{PROGRAM}={file}"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("bm_nothing", done.stderr)
        self.assertFalse(os.path.exists(file))

    def test_a_limit_counts_as_passed_only_where_every_round_passed_it(self):
        def entry(name, milliseconds):
            return {"name": name, "real_time": milliseconds * 1e3, "time_unit": "us", "limit_ms": 1.0}

        rounds_of = [entry("slow", 1.4), entry("slow", 1.2), entry("noisy", 1.4), entry("noisy", 0.9)]
        unlimited = {"name": "free", "real_time": 9e9, "time_unit": "us"}
        lines = rounds.over_limit(rounds_of + [unlimited])
        self.assertEqual(len(lines), 1)
        self.assertIn("slow: 1.2 ms", lines[0])
        self.assertIn("limit of 1 ms", lines[0])

    def test_a_program_beside_itself_shows_no_difference(self):
        if not PROGRAM:
            self.skipTest("no program was named")
        files = [os.path.join(self.directory.name, name) for name in ("a.json", "b.json")]
        words = [sys.executable, "-B", os.path.join(ROOT, "bench", "rounds.py")]
        words += ["--filter=bm_hold<IndexedHeap<4>>/entries:64|bm_generate<.*kruskal|bm_flood", "--repetitions=6"]
        words += ["--min-time=0.005"] + [f"{PROGRAM}={file}" for file in files]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(files[0], encoding="utf-8") as file:
            whole = json.load(file)
        self.assertEqual(whole["context"]["rounds"], 6)
        self.assertEqual([e["repetition_index"] for e in whole["benchmarks"][:6]], list(range(6)))
        for entry in whole["benchmarks"]:
            self.assertIn("items_per_second", entry)
            self.assertIn("bytes/item", entry)
        with contextlib.redirect_stdout(io.StringIO()) as said:
            code = comparison.compare_files(*files)
        self.assertIn("no difference: 3 benchmarks", said.getvalue())
        self.assertEqual(code, 0)


if __name__ == "__main__":
    if len(sys.argv) > 1 and not sys.argv[1].startswith("-"):
        PROGRAM = sys.argv.pop(1)
    unittest.main()
