#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Stops every verb and every planner at random moments, by --budget, SIGINT, SIGTERM and SIGHUP, and looks at what is
left: the exit code, files, hidden rests, the terminal, and how late it was.

    stops.py PROGRAM [--full] [--seed N] [--stops N] [--only WORDS] [--keep FOLDER]

The short form asks each case once and allows 20 s, so that slow or busy machines give no false alarm. --full takes
large worlds and ten moments of each (--stops), and allows 0.3 s and 0.12 s for each GiB that was held. Who is later is
asked again twice, and is late if it also computed for longer than that since the stop: on a machine that is busy
elsewhere the clock says nothing. Cases that end by themselves before the stop count too:
they must have written all they were asked for.
"""

import argparse
import json
import os
import pty
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import stop_cases
from program import Failure, Program, catches

CODES = {"budget": 124, signal.SIGHUP: 129, signal.SIGINT: 130, signal.SIGTERM: 143}
GIB = 1 << 30
TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")
LONGEST_S = 4.0  # of the run's length, from which the moments are drawn


def computed_s(pid):
    """Processor time of a process that runs, or has ended and is not waited for."""
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS_A_SECOND


class Stop:
    """One run that was stopped: what it said, left and cost."""

    def __init__(self, program, command, outputs, kind, after_s):
        self.folder = tempfile.mkdtemp(prefix="stop-")
        self.outputs, self.kind, self.after_s = outputs, kind, after_s
        self.old = {name: random.Random(name).random() < 0.5 for name in outputs.values()}
        for name, exists in self.old.items():
            if exists:
                with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
                    file.write("old\n")
        words = [str(word) for word in command]
        for option, name in outputs.items():
            words += [option, name]
        if kind == "budget":
            words += ["--budget", f"{max(1, round(after_s * 1000))}ms"]
        self.words = [*words, "--progress", "bar"]
        self.run(program)

    def run(self, program):
        master, slave = pty.openpty()
        os.set_blocking(master, False)
        begin = time.monotonic()
        child = subprocess.Popen([program.path, *self.words], cwd=self.folder, stdin=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL, stderr=slave, start_new_session=True)
        os.close(slave)
        program.runs += 1
        said, sent, listens, held, self.code, before_s, self.busy_s = b"", False, False, 0, None, 0.0, 60.0
        asked = begin + self.after_s
        while time.monotonic() < asked + 60.0:
            pid, status, used = os.wait4(child.pid, os.WNOHANG)
            try:
                said += os.read(master, 65536)
            except OSError:
                pass  # nothing said, or the other end is closed
            if pid != 0:
                self.code, held = os.waitstatus_to_exitcode(status), used.ru_maxrss * 1024
                self.busy_s = used.ru_utime + used.ru_stime - before_s
                break
            if not sent and time.monotonic() >= asked:
                before_s, sent = computed_s(child.pid), True
                if self.kind != "budget":
                    listens = catches(child.pid, self.kind)
                    os.kill(child.pid, self.kind)  # send_signal() would take the end of one that has just ended
                    asked = time.monotonic()
            time.sleep(0.001)
        else:
            child.kill()
            os.wait4(child.pid, 0)
        child.returncode = self.code
        if self.kind != "budget" and self.code == -self.kind and not listens:
            self.code = CODES[self.kind]  # so early a signal ends the process by itself; shells see the same code
        self.late_s = time.monotonic() - asked
        self.limit_s = 0.3 + 0.12 * held / GIB
        os.close(master)
        self.said = said.decode("utf-8", "replace")

    @property
    def is_late(self):
        return self.late_s > self.limit_s and self.busy_s > self.limit_s

    @property
    def came_too_late(self):
        """The run had ended by itself, or was about to."""
        return self.code in (0, 1)

    def shown(self):
        name = self.kind if self.kind == "budget" else signal.Signals(self.kind).name
        return f"{name} after {self.after_s:.3f} s: {' '.join(self.words)}"

    def check(self):
        """Raises Failure for all but lateness."""
        if self.code is None:
            raise Failure(f"no end within 60 s of {self.shown()}")
        if not self.came_too_late and self.code != CODES[self.kind]:
            raise Failure(f"exit code {self.code}, not {CODES[self.kind]}: {self.shown()}\n{self.said[-300:]}")
        left = sorted(os.listdir(self.folder))
        twins = [name[:-3] + ".co" for name in left if name.endswith(".gr")]  # what belongs together comes together
        strangers = [name for name in left if name not in [*self.outputs.values(), *twins]]
        if strangers:
            raise Failure(f"left {strangers}: {self.shown()}")
        for option, name in self.outputs.items():
            self.check_output(option, name)
        self.check_terminal()

    def check_output(self, option, name):
        path = os.path.join(self.folder, name)
        if not os.path.exists(path):
            if self.old[name] or self.came_too_late:
                raise Failure(f"{name} is not there: {self.shown()}")
            return
        with open(path, "rb") as file:
            content = file.read()
        if content == b"old\n" and self.old[name]:
            if self.came_too_late:
                raise Failure(f"exit code {self.code}, and {name} is as it was: {self.shown()}")
            return
        if name.endswith(".json"):
            answer = json.loads(content)
            if self.words[0] == "solve" and (answer["status"] == "stopped") == self.came_too_late:
                raise Failure(f"exit code {self.code}, and {name} says {answer['status']}: {self.shown()}")
        ends = {".svg": b"</svg>\n", ".html": b"</html>\n", ".png": b"IEND\xaeB`\x82", ".pdf": b"%%EOF\n",
                ".geojson": b"}\n"}
        end = ends.get(os.path.splitext(name)[1])
        if end and not content.endswith(end):
            raise Failure(f"{name} is cut off: {self.shown()}")
        if self.words[0] == "solve" and option == "--svg" and not self.came_too_late:
            raise Failure(f"exit code {self.code}, and {name} is drawn: {self.shown()}")

    def check_terminal(self):
        """The bar's line is erased, the cursor shown and no colour left on."""
        bar_end = self.said.rfind("\r\x1b[K")
        if bar_end >= 0 and "%" in self.said[bar_end + 4:]:
            raise Failure(f"the progress bar stays: {self.shown()}\n{self.said[-200:]!r}")
        if self.said.count("\x1b[?25l") != self.said.count("\x1b[?25h"):
            raise Failure(f"the cursor stays hidden: {self.shown()}")
        colours = re.findall(r"\x1b\[([0-9;]*)m", self.said)
        if colours and colours[-1] != "0":
            raise Failure(f"a colour stays on: {self.shown()}")

    def clear(self):
        shutil.rmtree(self.folder, ignore_errors=True)


def length_of(program, case):
    """Seconds that the run takes when it is left alone, at most LONGEST_S."""
    command, outputs = case
    begin = time.monotonic()
    Stop(program, command, outputs, signal.SIGTERM, LONGEST_S).clear()
    return min(LONGEST_S, time.monotonic() - begin)


def attempt(program, case, kind, after_s, full):
    """(lateness, message): the message says what was wrong, if anything."""
    late = []
    for _ in range(3 if full else 1):
        stop = Stop(program, *case, kind, after_s)
        try:
            stop.check()
        except Failure as failure:
            return stop.late_s, str(failure)
        finally:
            stop.clear()
        if stop.came_too_late:
            return 0.0, None
        late.append(f"{stop.late_s:.2f} s ({stop.busy_s:.2f} s computed)")
        if not (stop.is_late if full else stop.late_s > 20.0):
            return stop.late_s, None
    return stop.late_s, f"late by {', '.join(late)}, limit {stop.limit_s:.2f} s: {stop.shown()}"


def ask(program, case, dice, options, table):
    """Failures of one case, which is stopped at `options.stops` moments."""
    failures, study = [], case[0][0] in ("largest", "scale", "compare")
    kinds = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP] + ([] if study else ["budget"])
    length_s = length_of(program, case) if options.full else 1.0
    worst = 0.0
    for k in range(options.stops):
        kind = kinds[(k + dice.randrange(len(kinds))) % len(kinds)]
        after_s = length_s * (k + dice.random()) / options.stops if options.full else 0.02 + 0.3 * dice.random()
        late_s, message = attempt(program, case, kind, after_s, options.full)
        worst = max(worst, late_s)
        if message:
            failures.append(message)
    table.append((worst, " ".join(map(str, case[0]))))
    return failures


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--full", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--stops", type=int)
    parser.add_argument("--only", default="", help="cases whose words hold this")
    parser.add_argument("--keep", help="where the worlds are made and stay")
    options = parser.parse_args()
    options.stops = options.stops or (10 if options.full else 1)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    folder = options.keep or tempfile.mkdtemp(prefix="warren-stops-")
    os.makedirs(folder, exist_ok=True)
    program, table, failures = Program(options.program, folder), [], []
    worlds, dice = stop_cases.Worlds(program, folder, options.full), random.Random(options.seed)
    cases = [case for list_cases in (stop_cases.solve_cases, stop_cases.picture_cases, stop_cases.file_cases,
                                     stop_cases.roadmap_cases, stop_cases.study_cases)
             for case in list_cases(worlds, options.full)]
    for case in cases:
        if options.only not in " ".join(map(str, case[0])):
            continue
        found = ask(program, case, dice, options, table)
        failures += found
        if options.full:
            print(f"{table[-1][0]:6.3f} s  {table[-1][1]}" + "".join(f"\n    {text}" for text in found), flush=True)
    if not options.keep:
        shutil.rmtree(folder, ignore_errors=True)
    for text in failures:
        print(text)
    print(f"{len(failures)} failures in {program.runs} runs of {len(table)} cases; "
          f"latest {max(table, default=(0.0, ''))[0]:.3f} s")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
