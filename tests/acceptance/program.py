# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program as its users do and reads its answers as docs/file_formats.md promises them."""

import json
import math
import os
import re
import signal
import subprocess
import tempfile
import time

KEYS = ["schema", "warren_version", "status", "verified", "length", "min_clearance", "raw_length", "start", "goal",
        "clearance", "contact", "sampler", "world", "planner", "search", "seed", "threads", "options", "roadmap",
        "counters", "stages_s", "solve_s", "peak_memory_bytes", "path"]
INNER_KEYS = {"world": ["source", "kind", "walls", "hash"], "roadmap": ["milestones", "edges", "components"],
              "counters": ["samples", "neighbour_queries", "edges_checked", "expanded"], "stages_s": ["search", "verify"]}
STATUSES = {"solved", "not_connected", "infeasible", "start_blocked", "goal_blocked", "stopped"}
CHANGEABLE = re.compile(r'"(stages_s)"\s*:\s*\{[^}]*\}|"(solve_s|threads|peak_memory_bytes)"\s*:\s*[-+0-9.eE]+')


class Failure(Exception):
    """The program broke a promise; the text says which, and how to see it again."""


class Program:
    def __init__(self, path, folder=None):
        self.path = os.path.abspath(path)
        self.folder = folder or tempfile.mkdtemp(prefix="warren-acceptance-")
        self.files = 0
        self.runs = 0

    def write(self, text, ending="walls"):
        self.files += 1
        name = os.path.join(self.folder, f"world-{self.files}.{ending}")
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)
        return name

    def command(self, *arguments):
        return [self.path] + [str(a) for a in arguments]

    def run(self, *arguments, code=0, timeout_s=600.0, feed=None):
        """Standard output of a run that has to end with this exit code; anything else is a Failure."""
        command = self.command(*arguments)
        self.runs += 1
        try:
            done = subprocess.run(command, input=feed, capture_output=True, timeout=timeout_s)
        except subprocess.TimeoutExpired:
            raise Failure(f"no end within {timeout_s} s: {' '.join(command)}") from None
        if done.returncode != code:
            said = (done.stderr.decode("utf-8", "replace").strip().splitlines() or ["(nothing on standard error)"])[-1]
            raise Failure(f"exit code {done.returncode}, not {code}: {' '.join(command)}\n      {said[:300]}")
        return done.stdout.decode("utf-8")

    def writes_pdf(self):
        """Was libharu there when it was built?"""
        page = os.path.join(self.folder, "page.pdf")
        done = subprocess.run(self.command("convert", "maze:2x2", "-o", page), capture_output=True, timeout=60)
        if done.returncode != 0 and b"without libharu" not in done.stderr:
            raise Failure(f"exit code {done.returncode}: convert to .pdf\n      {done.stderr[-300:]!r}")
        return done.returncode == 0

    def solve(self, file, *arguments, code=0, timeout_s=600.0, feed=None):
        """The answer of `solve … --json -` as text."""
        return self.run("solve", file, *arguments, "--json", "-", code=code, timeout_s=timeout_s, feed=feed)

    def interrupt(self, arguments, after_s, number=signal.SIGINT, stdin=subprocess.DEVNULL):
        """Runs, sends a signal this long after the program began to wait for signals: (exit code, seconds from signal to
        end, standard output). The seconds are None if the program ended by itself before."""
        child = subprocess.Popen(self.command(*arguments), stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.runs += 1
        while child.poll() is None and not catches(child.pid, number):
            time.sleep(0.0005)
        try:
            output, _ = child.communicate(timeout=after_s)
            return child.returncode, None, output.decode("utf-8")
        except subprocess.TimeoutExpired:
            pass
        begin = time.monotonic()
        child.send_signal(number)
        try:
            output, _ = child.communicate(timeout=30.0)
        except subprocess.TimeoutExpired:
            child.kill()
            child.communicate()
            return None, 30.0, ""
        return child.returncode, time.monotonic() - begin, output.decode("utf-8")


def catches(pid, number):
    """Has the process a handler for the signal?"""
    with open(f"/proc/{pid}/status") as status:
        masks = [line.split()[1] for line in status if line.startswith("SigCgt:")]
    return int(masks[0], 16) >> (number - 1) & 1 == 1


def refuse_constant(name):
    raise Failure(f"the answer holds {name}")


def read_answer(text):
    """The answer as a dictionary, with its shape checked against the published format."""
    try:
        answer = json.loads(text, parse_constant=refuse_constant)
    except ValueError as error:
        raise Failure(f"standard output isn't one JSON object: {error}: {text[:80]!r}") from None
    order = [key for key in answer if key in KEYS]
    if order != KEYS:
        missing = [key for key in KEYS if key not in answer]
        raise Failure(f"keys missing: {missing}" if missing else f"keys out of order: {order}")
    for key, inner in INNER_KEYS.items():
        lacking = [k for k in inner if k not in answer[key]]
        if lacking:
            raise Failure(f"{key} lacks {lacking}")
    if answer["schema"] != "warren.answer/1" or answer["status"] not in STATUSES:
        raise Failure(f"schema {answer['schema']!r}, status {answer['status']!r}")
    times = list(answer["stages_s"].values()) + [answer["solve_s"]]
    if not all(isinstance(t, (int, float)) and 0 <= t < math.inf for t in times):
        raise Failure(f"times {times}")
    if not isinstance(answer["peak_memory_bytes"], int) or answer["peak_memory_bytes"] <= 0:
        raise Failure(f"peak_memory_bytes {answer['peak_memory_bytes']!r}")
    return answer


def without_times(text):
    """The bytes that may not depend on the number of threads."""
    return CHANGEABLE.sub(lambda m: f'"{m.group(1) or m.group(2)}": ?', text)
