#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Plants single faults and says which test notices each. `tools/mutate --help` says how it is called."""

import argparse
import concurrent.futures
import hashlib
import json
import os
import sys
import threading
import time

sys.dont_write_bytecode = True  # the checkout stays as it is

import planted_tree
import test_steps
from fault_table import TableError, place_of, planted, read_table

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TABLE = os.path.join(ROOT, "tests", "mutations", "faults.txt")
PLACE = os.path.join(ROOT, "build", "mutate")
RESULTS = os.path.join(PLACE, "results")


def key_of(fault):
    """Changes with the fault, so that an answer for another one is not taken for its own."""
    return hashlib.sha256(f"{fault.file}\n{fault.text}".encode()).hexdigest()[:12]


def read_results():
    """The last answer for each fault as it stands now: {(name, key): answer}."""
    try:
        with open(RESULTS, encoding="utf-8") as file:
            answers = [json.loads(line) for line in file if line.endswith("\n")]
    except FileNotFoundError:
        return {}
    return {(answer["name"], answer["key"]): answer for answer in answers}


def times_of_build(folder):
    """Times of the tests with no fault, measured once a build."""
    programs = [test_steps.program_file(folder, name) for name in test_steps.programs_of(folder)]
    stamp = [os.stat(name).st_mtime for name in [*programs, os.path.join(folder, "warren")]]
    kept = os.path.join(PLACE, "times.json")
    try:
        with open(kept, encoding="utf-8") as file:
            known = json.load(file)
        if known["stamp"] == stamp:
            return known["times"]
    except (OSError, ValueError, KeyError):
        pass
    print("no fault: ", end="", flush=True)
    times = test_steps.measure(folder, os.path.join(PLACE, "scratch"))
    print(f"all {sum(len(tests) for tests in times.values()) - 1} tests of {len(times) - 1} programs pass")
    with open(kept, "w", encoding="utf-8") as file:
        json.dump({"stamp": stamp, "times": times}, file)
    return times


def judge(fault, folder, times):
    """Asks the tests, the nearest first, until one notices."""
    begin = time.monotonic()
    scratch = os.path.join(PLACE, "scratch", fault.name)
    outcome = test_steps.Outcome(False)
    for step in test_steps.steps_for(fault, times):
        outcome = test_steps.ask(folder, step, fault, scratch)
        if outcome.noticed:
            break
    return {"name": fault.name, "key": key_of(fault), "noticed": outcome.noticed, "by": outcome.by,
            "seconds": round(time.monotonic() - begin, 1)}


def judge_all(faults, folder, times):
    """Two at a time, each answer kept as soon as it is there. The names of those that no test noticed."""
    lock, unnoticed = threading.Lock(), []
    with concurrent.futures.ThreadPoolExecutor(2) as pool, open(RESULTS, "a", encoding="utf-8") as results:
        def one(fault):
            answer = judge(fault, folder, times)
            with lock:
                results.write(json.dumps(answer) + "\n")
                results.flush()
                print(f"{fault.name}: {'noticed by ' + answer['by'] if answer['noticed'] else 'NOT NOTICED'}"
                      f" ({answer['seconds']:.0f} s)", flush=True)
                if not answer["noticed"]:
                    unnoticed.append(fault.name)
        list(pool.map(one, faults))
    return unnoticed


def report(faults):
    """The table of docs/testing.md."""
    answers = read_results()
    rows = [(fault, answers.get((fault.name, key_of(fault)))) for fault in faults]
    noticed = sum(1 for _, answer in rows if answer and answer["noticed"])
    asked = sum(1 for _, answer in rows if answer)
    print(f"{len(faults)} faults planted, {asked} tried, {noticed} noticed.\n")
    print("| fault | in | what it does | noticed by |\n|---|---|---|---|")
    area = None
    for fault, answer in rows:
        if fault.area != area:
            area = fault.area
            print(f"| **{area}** | | | |")
        by = "not tried" if not answer else answer["by"] if answer["noticed"] else "**nothing**"
        print(f"| {fault.name} | {fault.file} | {fault.why} | {by} |")


def chosen_faults(faults, names):
    unknown = sorted(set(names) - {fault.name for fault in faults})
    if unknown:
        raise TableError(f"{unknown[0]}: no fault of this name; tools/mutate --list names them")
    return [fault for fault in faults if not names or fault.name in names]


def run(arguments, faults):
    chosen = chosen_faults(faults, arguments.names)
    os.makedirs(PLACE, exist_ok=True)
    if arguments.fresh and os.path.exists(RESULTS):
        os.remove(RESULTS)
    tree, log = os.path.join(PLACE, "tree"), os.path.join(PLACE, "build.log")
    planted_tree.make_tree(ROOT, tree, faults)
    folder = planted_tree.build(tree, log)
    if folder is None:
        raise TableError(f"the copy with the faults does not build: see {log}")
    times = times_of_build(folder)
    if not arguments.names:
        known = read_results()
        chosen = [fault for fault in chosen if not known.get((fault.name, key_of(fault)), {}).get("noticed")]
    unnoticed = judge_all(chosen, folder, times)
    print(f"{len(chosen)} faults tried, {len(chosen) - len(unnoticed)} noticed", end="")
    print(f"; not noticed: {', '.join(unnoticed)}" if unnoticed else "")
    return 1 if unnoticed else 0


def check_places(faults):
    """TableError with a line for each fault that can't be planted."""
    trouble = []
    for name in sorted({fault.file for fault in faults}):
        with open(os.path.join(ROOT, name), encoding="utf-8") as file:
            source = file.read()
        here = [fault for fault in faults if fault.file == name]
        before = len(trouble)
        for fault in here:
            trouble += [f"{fault.name}: near: tests/{near} is not there" for near in fault.near
                        if not os.path.exists(os.path.join(ROOT, "tests", near))]
            try:
                place_of(fault, source)
            except TableError as error:
                trouble.append(str(error))
        if len(trouble) == before:
            planted(source, here)
    if trouble:
        raise TableError("\n".join(trouble))


def main():
    parser = argparse.ArgumentParser(
        prog="tools/mutate", description="Plants single faults, all in one build below build/mutate, and says which "
        "test notices each. Answers are kept in build/mutate/results: a run that was broken off goes on, and asks "
        "again only what no test had noticed. Exit code 1: a fault that no test notices.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="faults to try, again if need be (default: all)")
    parser.add_argument("--list", action="store_true", help="name the faults, after a look whether each can be planted")
    parser.add_argument("--report", action="store_true", help="print the table of docs/testing.md from the answers kept")
    parser.add_argument("--fresh", action="store_true", help="forget the answers kept")
    arguments = parser.parse_args()
    try:
        faults = read_table(TABLE)
        check_places(faults)
        if arguments.list:
            print("\n".join(f"{fault.name}  {fault.file}  {fault.why}" for fault in chosen_faults(faults, arguments.names)))
            return 0
        if arguments.report:
            report(faults)
            return 0
        return run(arguments, faults)
    except (TableError, test_steps.TestsFail, FileNotFoundError) as trouble:
        print(f"tools/mutate: {trouble}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
