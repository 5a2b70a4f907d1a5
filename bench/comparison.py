#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares two files of Google Benchmark results: ratios with an interval, and whether they tell a difference.

For each benchmark, all ratios of a repetition of the new file to one of the old: their median is the ratio shown, and
the interval between two of their order statistics is the one that goes with Mann and Whitney's rank test (Hodges and
Lehmann 1963). It assumes nothing about how the noise is distributed. All benchmarks together are wrong about a
difference with a probability of at most ERROR; where there are too few repetitions for that, the interval is the widest
that they give. A difference is told only beyond a tolerance: TOLERANCE or, if more, what the machine itself differs by,
as measured by the benchmarks named MACHINE... which no change of the program can touch, or what the repetitions of
most benchmarks differ by among themselves.
"""

import argparse
import json
import math
import signal
import sys

ERROR = 0.01  # that all intervals together may be wrong by, where the repetitions allow it
LEAST_CONFIDENCE = 0.95  # of one interval: with less, nothing is told (three repetitions against three give 0.9)
TOLERANCE = 0.05  # same program, same machine, another place in memory: so much is not worth a word
MACHINE = "bm_machine_"
UNITS = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}


class BadFile(Exception):
    """A file that is none of Google Benchmark's."""


def read_times(path, clock):
    """Nanoseconds of the repetitions of each benchmark, in the file's order."""
    try:
        with open(path, encoding="utf-8") as file:
            entries = json.load(file)["benchmarks"]
    except OSError as error:
        raise BadFile(f"{path}: can't be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise BadFile(f"{path}: expected JSON as Google Benchmark writes it") from error
    times = {}
    for entry in entries:
        if entry.get("run_type", "iteration") != "iteration" or entry.get("error_occurred"):
            continue
        try:
            nanoseconds = float(entry[clock + "_time"]) * UNITS[entry["time_unit"]]
        except (KeyError, TypeError, ValueError) as error:
            raise BadFile(f"{path}: {entry.get('name')}: expected {clock}_time and a time_unit") from error
        times.setdefault(entry["name"], []).append(nanoseconds)
    if not times:
        raise BadFile(f"{path}: holds no benchmark")
    return times


def rank_counts(m, n):
    """In how many of the orders of m and n values u pairs are inverted, for u = 0 ... m * n."""
    # Exponents of the Gaussian binomial: product over i = 1 .. m of (1 - q^(n + i)) / (1 - q^i).
    counts = [1] + [0] * (m * n)
    for i in range(1, m + 1):
        for u in range(m * n, n + i - 1, -1):
            counts[u] -= counts[u - n - i]
        for u in range(i, m * n + 1):
            counts[u] += counts[u - i]
    return counts


def interval_ranks(m, n, error):
    """How many ratios to leave off at either end, and the probability that the interval misses; at least none."""
    counts = rank_counts(m, n)
    total = math.comb(m + n, m)
    off, below = 0, counts[0]
    while off + 1 < m * n // 2 and 2 * (below + counts[off + 1]) <= error * total:
        off += 1
        below += counts[off]
    return off, 2 * below / total


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2] if ordered else 0.0


class Ratio:
    """New over old."""

    def __init__(self, old, new, error):
        ratios = sorted(b / a for a in old for b in new)
        off, miss = interval_ranks(len(old), len(new), error)
        middle = len(ratios) // 2
        self.ratio = math.sqrt(ratios[middle] * ratios[-1 - middle])
        self.low = ratios[off]
        self.high = ratios[-1 - off]
        self.confidence = 1.0 - miss

    def verdict(self, tolerance):
        if self.confidence < LEAST_CONFIDENCE:
            return "too few repetitions"
        if self.low > 1.0 + tolerance:
            return "slower"
        if self.high < 1.0 / (1.0 + tolerance):
            return "faster"
        return "no difference"


class Comparison:
    def __init__(self, old, new):
        names = [name for name in old if name in new]
        self.only_old = [name for name in old if name not in new]
        self.only_new = [name for name in new if name not in old]
        error = ERROR / max(1, len(names))
        ratios = {name: Ratio(old[name], new[name], error) for name in names}
        self.machine = {name: r for name, r in ratios.items() if name.startswith(MACHINE)}
        self.drift = max((abs(math.log(r.ratio)) for r in self.machine.values()), default=0.0)
        self.noise = median([max(file[name]) / min(file[name]) - 1.0 for file in (old, new) for name in names])
        self.tolerance = max(TOLERANCE, math.exp(self.drift) - 1.0, self.noise)
        self.rows = [
            (name, min(old[name]), min(new[name]), r, r.verdict(self.tolerance))
            for name, r in ratios.items()
            if name not in self.machine
        ]

    def count(self, verdict):
        return sum(1 for row in self.rows if row[-1] == verdict)


def seconds_text(nanoseconds):
    for unit, scale in (("s", 1e9), ("ms", 1e6), ("us", 1e3)):
        if nanoseconds >= scale:
            return f"{nanoseconds / scale:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def print_comparison(comparison):
    width = max((len(name) for name, *_ in comparison.rows), default=9)
    print(f"{'benchmark':{width}} {'old':>8} {'new':>8} {'ratio':>6}  {'interval':13}  verdict")
    for name, old, new, r, verdict in comparison.rows:
        interval = f"{r.low:.2f} to {r.high:.2f}"
        print(f"{name:{width}} {seconds_text(old):>8} {seconds_text(new):>8} {r.ratio:6.2f}  {interval:13}  {verdict}")
    for name, r in comparison.machine.items():
        print(f"the machine: {name} {r.ratio:.2f} ({r.low:.2f} to {r.high:.2f})")
    for names, file in ((comparison.only_old, "old"), (comparison.only_new, "new")):
        if names:
            print(f"only in the {file} file: {len(names)}, such as {names[0]}")
    print(summary(comparison))


def summary(comparison):
    told = [f"{comparison.count(v)} {v}" for v in ("slower", "faster") if comparison.count(v)]
    few = comparison.count("too few repetitions")
    if few:
        told.append(f"{few} with too few repetitions to tell")
    text = ", ".join(told) if told else "no difference"
    drift = 100.0 * (math.exp(comparison.drift) - 1.0)
    ratio = median(r.ratio for _, _, _, r, _ in comparison.rows) or 1.0
    return (
        f"{text}: {len(comparison.rows)} benchmarks, median ratio {ratio:.3f}, tolerance {100.0 * comparison.tolerance:.0f} % "
        f"(repetitions differ by {100.0 * comparison.noise:.0f} %, the machine by {drift:.0f} %)"
    )


def compare_files(old, new, clock="cpu"):
    """Prints the comparison; 0, or 1 where something has become slower."""
    comparison = Comparison(read_times(old, clock), read_times(new, clock))
    print_comparison(comparison)
    return 1 if comparison.count("slower") else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("old")
    parser.add_argument("new")
    parser.add_argument("--clock", choices=("cpu", "real"), default="cpu", help="which time is compared (default: cpu)")
    arguments = parser.parse_args()
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # a reader that has seen enough
    try:
        return compare_files(arguments.old, arguments.new, arguments.clock)
    except BadFile as error:
        print(f"comparison: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
