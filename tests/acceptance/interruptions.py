# SPDX-License-Identifier: BSD-3-Clause
"""Budgets and signals: the program stops when it is told to, whatever it is doing at that moment.

A stage is hit by chance: the run is interrupted at many moments spread over its length, and the stages that it was in
are read from the partial figures. `strict` asks for 0.2 s; else only for the exit code and an end within 20 s, so that
slow or busy machines and sanitizers give no false alarm.
"""

import json
import os
import signal
import subprocess
import time

from program import Failure

LIMIT_S = 0.2
LAX_LIMIT_S = 20.0
STOPPED_CODES = {signal.SIGINT: 130, signal.SIGTERM: 143}


def stage_of(output):
    """Name of the last stage that took any time, from the partial answer."""
    try:
        stages = json.loads(output)["stages_s"]
    except (ValueError, KeyError):
        return "(no partial figures)"
    used = [name for name, seconds in stages.items() if seconds > 0.0 and not name.endswith("_cpu")]
    return used[-1] if used else "(before the first stage)"


def check_budget(program, arguments, budget_s, strict):
    """The run has to end with 124, soon after its budget."""
    command = program.command("solve", *arguments, "--budget", f"{round(budget_s * 1000)}ms", "--json", "-")
    program.runs += 1
    begin = time.monotonic()
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=60.0)
    except subprocess.TimeoutExpired:
        raise Failure(f"no end within 60 s: {' '.join(command)}") from None
    late_s = time.monotonic() - begin - budget_s
    if done.returncode != 124:
        raise Failure(f"exit code {done.returncode}, not 124: {' '.join(command)}")
    if json.loads(done.stdout)["status"] != "stopped":
        raise Failure(f"status isn't stopped: {' '.join(command)}")
    if late_s > (LIMIT_S if strict else LAX_LIMIT_S):
        raise Failure(f"ended {late_s:.2f} s after its budget, in {stage_of(done.stdout)}: {' '.join(command)}")
    return late_s


def check_signals(program, arguments, length_s, moments, strict, number=signal.SIGINT):
    """Interrupts runs at moments spread over length_s: {stage: worst seconds}."""
    worst, late = {}, []
    for k in range(moments):
        after_s = length_s * (k + 0.5) / moments
        code, seconds, output = program.interrupt(["solve", *arguments, "--json", "-"], after_s, number)
        if seconds is None:
            continue  # it was faster than we thought
        stage = stage_of(output)
        shown = f"signal {number} after {after_s:.2f} s, in {stage}: solve {' '.join(map(str, arguments))}"
        if code != STOPPED_CODES[number]:
            if code == 0:
                continue  # the signal came as the last line was written
            raise Failure(f"exit code {code}, not {STOPPED_CODES[number]}: {shown}")
        worst[stage] = max(worst.get(stage, 0.0), seconds)
        if seconds > (LIMIT_S if strict else LAX_LIMIT_S):
            late.append(f"{seconds:.2f} s from {shown}")
    if late:
        raise Failure(f"late {len(late)} times of {moments}:\n      " + "\n      ".join(late[:6]))
    return worst


def check_silent_input(program, strict):
    """Standard input that never says anything: a budget and a signal end the waiting all the same."""
    for kind in ("budget", "signal"):
        read_end, write_end = os.pipe()
        try:
            if kind == "signal":
                code, seconds, _ = program.interrupt(["solve", "-"], 0.5, stdin=read_end)
                expected = 130
            else:
                begin = time.monotonic()
                child = subprocess.Popen(program.command("solve", "-", "--budget", "300ms"), stdin=read_end,
                                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
                try:
                    code, expected = child.wait(LAX_LIMIT_S), 124
                except subprocess.TimeoutExpired:
                    child.kill()
                    child.wait()
                    code, expected = None, 124
                seconds = time.monotonic() - begin - 0.3
        finally:
            os.close(read_end)
            os.close(write_end)
        if code != expected:
            raise Failure(f"waiting for standard input: {kind} gives exit code {code}, not {expected}")
        if strict and seconds > LIMIT_S:
            raise Failure(f"waiting for standard input: {kind} ends it after {seconds:.2f} s")
