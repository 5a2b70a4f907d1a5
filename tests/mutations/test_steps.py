# SPDX-License-Identifier: BSD-3-Clause
"""The tests of a build as steps, for each fault the nearest first, and what became of a step."""

import concurrent.futures
import dataclasses
import json
import os
import re
import resource
import signal
import subprocess
import time

from planted_tree import VARIABLE

PROGRAMS = ("core", "spatial", "scenes", "worlds", "verify", "planners", "solve", "pictures", "studies", "serve",
            "distributed", "tools", "program", "matrix")  # those that there are, the last ones last
QUICK_S = 0.2  # tests up to this long are asked before the others
MOST_MEMORY = 6 << 30
# Labels: what looks at the sources, and what knows no geometry. Names: what is asked otherwise, or asks for more memory.
LABELS_NOT_ASKED = "^(house|parallel|faults|fuzz)$"
NOT_ASKED = "^(package_consumer|browser|(" + "|".join(PROGRAMS) + ")_tests[.][0-9]+)$"
FAILED = re.compile(r"^\[  FAILED  \] ([\w/.]+)", re.MULTILINE)
BEGUN = re.compile(r"^\[ RUN      \] ([\w/.]+)$", re.MULTILINE)
CTEST_FAILED = re.compile(r"^\t *\d+ - (\S+) \(", re.MULTILINE)


@dataclasses.dataclass
class Step:
    """Tests of one program, or what else ctest knows where the program is empty."""

    program: str
    tests: list
    seconds: float


@dataclasses.dataclass
class Outcome:
    noticed: bool
    by: str = ""


def program_file(folder, program):
    return os.path.join(folder, "tests", program + "_tests")


def programs_of(folder):
    return [program for program in PROGRAMS if os.path.exists(program_file(folder, program))]


def run(command, folder, fault, scratch, limit):
    """The exit code, None for a run that was ended after `limit` seconds, and what it printed."""
    os.makedirs(scratch, exist_ok=True)
    environment = dict(os.environ, TEST_TMPDIR=scratch + "/", TMPDIR=scratch, WARREN_SEEDS="all")
    if fault:
        environment[VARIABLE] = str(fault.number)

    def confine():
        os.nice(5)
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    with open(os.path.join(scratch, "output"), "w+b") as output:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=output, stderr=output,
                                   env=environment, preexec_fn=confine, start_new_session=True)
        try:
            code = process.wait(limit)
        except subprocess.TimeoutExpired:
            code = None
        try:
            os.killpg(process.pid, signal.SIGKILL)  # what it has started, too
        except ProcessLookupError:
            pass
        process.wait()
        output.seek(0)
        return code, output.read().decode(errors="replace")


def ask_program(folder, step, fault, scratch):
    flags = os.path.join(scratch, "flags")
    os.makedirs(scratch, exist_ok=True)
    with open(flags, "w", encoding="utf-8") as file:
        file.write("--gtest_filter=" + ":".join(step.tests) + "\n--gtest_fail_fast\n--gtest_color=no\n")
    program = program_file(folder, step.program)
    code, text = run([program, "--gtest_flagfile=" + flags], folder, fault, scratch, 60 + 10 * step.seconds)
    if code == 0:
        return Outcome(False)
    begun, failed = BEGUN.findall(text), FAILED.findall(text)
    if code is None:
        return Outcome(True, (begun[-1] if begun else step.program) + ", by its time limit")
    if failed:
        return Outcome(True, failed[0])
    return Outcome(True, (begun[-1] if begun else step.program) + ", which crashed")


def ask_ctest(folder, step, fault, scratch):
    command = ["ctest", "--test-dir", folder, "--stop-on-failure", "-LE", LABELS_NOT_ASKED, "-E", NOT_ASKED]
    code, text = run(command, folder, fault, scratch, 120 + 10 * step.seconds)
    failed = CTEST_FAILED.findall(text)
    if code is None:
        return Outcome(True, "ctest, by its time limit")
    return Outcome(code != 0, failed[0] if failed else "ctest")


def ask(folder, step, fault, scratch):
    """Runs the step with the fault chosen, or with none."""
    return (ask_program if step.program else ask_ctest)(folder, step, fault, scratch)


def times_of(folder, program, scratch):
    """[test, its file, its seconds] of all tests of a program, which have to pass; None where one fails."""
    report = os.path.join(scratch, program + ".json")
    command = [program_file(folder, program), "--gtest_output=json:" + report]
    code, text = run(command, folder, None, scratch, 3600)
    if code != 0:
        return None, text
    with open(report, encoding="utf-8") as file:
        suites = json.load(file)["testsuites"]
    return [[f"{suite['name']}.{test['name']}", os.path.relpath(test["file"], os.path.dirname(folder)),
             float(test["time"].rstrip("s"))] for suite in suites for test in suite["testsuite"]], text


def measure(folder, scratch):
    """Times of all tests with no fault: {program: [[test, file, seconds], ...]}; TestsFail where one fails. Two at a
    time, as faults are judged, the dearest first."""
    def time_of_others():
        begin = time.monotonic()
        return ask_ctest(folder, Step("", [], 600), None, os.path.join(scratch, "others")), time.monotonic() - begin

    times = {}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        others = pool.submit(time_of_others)
        programs = {program: pool.submit(times_of, folder, program, os.path.join(scratch, program))
                    for program in reversed(programs_of(folder))}
        for program, answer in programs.items():
            times[program], text = answer.result()
            if times[program] is None:
                raise TestsFail(f"{program}_tests fails with no fault: " + ", ".join(sorted(set(FAILED.findall(text)))))
    outcome, seconds = others.result()
    if outcome.noticed:
        raise TestsFail(f"{outcome.by} fails with no fault")
    times[""] = [["", "", seconds]]
    return times


class TestsFail(Exception):
    """Tests fail that have to pass: one line."""


def steps_for(fault, times):
    """The nearest tests first, then the rest of the folder, then the others; of each the quick ones first."""
    folder = re.match("(?:apps/)?[^/]*", fault.file)[0]
    near = [f"tests/{os.path.splitext(fault.file)[0]}_test.cpp"] + ["tests/" + name for name in fault.near]
    steps, asked = [], set()

    def add(program, chosen):
        tests = [test for test in times[program] if test[0] not in asked and chosen(test)]
        if tests:
            asked.update(test[0] for test in tests)
            steps.append(Step(program, [test[0] for test in tests], sum(test[2] for test in tests)))

    programs = sorted((name for name in times if name), key=lambda name: name != folder.removeprefix("apps/"))
    for program in programs:
        add(program, lambda test: any(test[1].endswith(name) for name in near))
    for program in programs:
        add(program, lambda test: test[2] <= QUICK_S)
        add(program, lambda test: True)
    steps.append(Step("", [], times[""][0][2]))
    return steps
