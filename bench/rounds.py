#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs benchmark programs in rounds and writes what they measured, one file a program.

A round runs every benchmark of every program once, in a process of its own: so the repetitions of a benchmark lie far
apart in time and find different places in memory, and two programs meet the same moods of the machine. Results are
checked in the first round. Each file has
Google Benchmark's own shape, with the repetitions numbered, and in its context how and where it was made.
"""

import argparse
import hashlib
import json
import os
import platform
import subprocess
import sys
import tempfile
import time

from comparison import seconds_text

MACHINE = "bm_machine_"  # always run: bench/comparison.py needs them


def first_line(path, start):
    try:
        with open(path, encoding="utf-8") as file:
            return next((line.split(":", 1)[1].strip() for line in file if line.startswith(start)), None)
    except OSError:
        return None


def commit():
    """The checkout's commit, with -dirty where it isn't what was committed; none outside of one."""
    here = os.path.dirname(os.path.abspath(__file__))
    words = ["git", "-C", here, "describe", "--always", "--dirty", "--abbrev=12"]
    try:
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return None


def context_of(program, arguments):
    with open(program, "rb") as file:
        digest = hashlib.sha256(file.read()).hexdigest()
    return {
        "warren_commit": commit(),
        "program_sha256": digest,
        "filter": arguments.filter,
        "rounds": arguments.repetitions,
        "min_time_s": arguments.min_time,
        "cpu": first_line("/proc/cpuinfo", "model name"),
        "usable_cores": len(os.sched_getaffinity(0)),
        "memory": first_line("/proc/meminfo", "MemTotal"),
        "kernel": platform.release(),
    }


def filter_text(filter_regex):
    if not filter_regex or filter_regex.startswith("-"):
        return filter_regex
    return f"{filter_regex}|{MACHINE}"


def run_once(program, arguments, checks):
    """One round of one program, as Google Benchmark reports it; checks: results are compared with the plain ones."""
    with tempfile.TemporaryDirectory(prefix="warren-bench-") as directory:
        out = os.path.join(directory, "out.json")
        words = [program, f"--benchmark_out={out}", "--benchmark_out_format=json"]
        words.append(f"--benchmark_min_time={arguments.min_time}")
        if arguments.filter:
            words.append(f"--benchmark_filter={filter_text(arguments.filter)}")
        environment = dict(os.environ)
        if not checks:
            environment["WARREN_BENCH_CHECKED"] = "1"
        done = subprocess.run(
            words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False, env=environment
        )
        if done.returncode != 0:
            sys.exit(f"bench: {program} ended with {done.returncode}\n{done.stderr.strip()}")
        with open(out, encoding="utf-8") as file:
            return json.load(file)


def merged(rounds, context):
    """The rounds of one program as one file: benchmark by benchmark, repetitions in their order."""
    entries = {}
    loads = [one["context"].get("load_avg") for one in rounds]
    for number, one in enumerate(rounds):
        for entry in one["benchmarks"]:
            entry.update(repetitions=len(rounds), repetition_index=number)
            entries.setdefault(entry["name"], []).append(entry)
    whole = dict(rounds[0]["context"], **context, load_avg_by_round=loads)
    return {"context": whole, "benchmarks": [entry for group in entries.values() for entry in group]}


def over_limit(entries):
    """A line for each benchmark that tells a limit (the counter limit_ms) and exceeded it in every round."""
    units = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}
    least = {}
    for entry in entries:
        if "limit_ms" in entry and not entry.get("error_occurred"):
            milliseconds = entry["real_time"] * units[entry["time_unit"]]
            known = least.get(entry["name"], (milliseconds, entry["limit_ms"]))
            least[entry["name"]] = (min(known[0], milliseconds), entry["limit_ms"])
    return [
        f"bench: {name}: {milliseconds:.3g} ms in the best round, over its limit of {limit:g} ms"
        for name, (milliseconds, limit) in least.items()
        if milliseconds > limit
    ]


def write_json(path, value):
    beside = f"{path}.{os.getpid()}.part"
    try:
        with open(beside, "w", encoding="utf-8") as file:
            json.dump(value, file, indent=1)
            file.write("\n")
        os.replace(beside, path)
    except OSError as error:
        sys.exit(f"bench: {path}: can't be written: {error.strerror}")


def run_rounds(programs, arguments):
    results = [[] for _ in programs]
    for number in range(arguments.repetitions):
        begin = time.monotonic()
        order = list(range(len(programs)))
        for i in order if number % 2 == 0 else reversed(order):  # so that neither always comes first
            results[i].append(run_once(programs[i], arguments, number == 0))
        names = [entry["name"] for entry in results[0][-1].get("benchmarks", [])]
        if all(name.startswith(MACHINE) for name in names) and MACHINE not in arguments.filter:
            sys.exit(f"bench: no benchmark of that name: {arguments.filter}")
        seconds = time.monotonic() - begin
        print(f"round {number + 1} of {arguments.repetitions}: {seconds:.0f} s", file=sys.stderr, flush=True)
    return results


def table(entries):
    """A line a benchmark: the median of its CPU times and, where it counts items, how many a second."""
    units = {"ns": 1.0, "us": 1e3, "ms": 1e6, "s": 1e9}
    found = {}
    for entry in entries:
        if not entry.get("error_occurred") and not entry["name"].startswith(MACHINE):
            found.setdefault(entry["name"], []).append(entry)
    width = max(map(len, found), default=9)
    lines = [f"{'benchmark':{width}} {'CPU time':>9} {'items/s':>9}"]
    for name, group in found.items():
        middle = sorted(group, key=lambda entry: entry["cpu_time"])[len(group) // 2]
        items = middle.get("items_per_second")
        rate = f"{items:9.3g}" if items else f"{'':9}"
        lines.append(f"{name:{width}} {seconds_text(middle['cpu_time'] * units[middle['time_unit']]):>9} {rate}".rstrip())
    return lines


def usual_options(path):
    """Filter, rounds and least time: those of the run that wrote the file, where there is one that says them."""
    usual = {"filter": "", "repetitions": 5, "min_time": 0.05}
    if path:
        try:
            with open(path, encoding="utf-8") as file:
                context = json.load(file)["context"]
            usual = {"filter": context["filter"], "repetitions": context["rounds"], "min_time": context["min_time_s"]}
        except (OSError, ValueError, KeyError, TypeError):
            pass  # another program's file: bench/comparison.py will say whether it can read it
    return usual


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("runs", nargs="+", metavar="PROGRAM=FILE", help="program and the file for its results")
    parser.add_argument("--filter", help="benchmarks to run, as --benchmark_filter takes them")
    parser.add_argument("--repetitions", type=int, help="rounds (default: 5)")
    parser.add_argument("--min-time", type=float, help="seconds of a benchmark in a round, at least (default: 0.05)")
    parser.add_argument("--like", metavar="FILE", help="what is not given is as in the run that wrote FILE")
    arguments = parser.parse_args()
    usual = usual_options(arguments.like)
    for option, value in usual.items():
        if getattr(arguments, option) is None:
            setattr(arguments, option, value)
    if arguments.repetitions < 1 or not arguments.min_time > 0:
        parser.error("--repetitions and --min-time are more than zero")
    runs = [run.rpartition("=") for run in arguments.runs]
    if not all(program and file for program, _, file in runs):
        parser.error("expected PROGRAM=FILE")
    results = run_rounds([program for program, _, _ in runs], arguments)
    for (program, _, file), rounds in zip(runs, results):
        whole = merged(rounds, context_of(program, arguments))
        write_json(file, whole)
        for line in over_limit(whole["benchmarks"]):
            print(line, file=sys.stderr)
        if len(runs) == 1:
            print("\n".join(table(whole["benchmarks"])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
