# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the Python package share: the program beside it."""
import json
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
WORLDS = ROOT / "examples" / "worlds"
MEASURED = ("stages_s", "solve_s", "threads", "peak_memory_bytes")


class Program:
    def run(self, *words, cwd=None):
        done = subprocess.run([os.environ["WARREN_PROGRAM"], *map(str, words)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True, cwd=cwd, timeout=120)
        return done

    def json(self, *words, cwd=None):
        return self.run(*words, "--json", "-", cwd=cwd).stdout

    def help_options(self, verb):
        """name -> (value, choices)"""
        options, name = {}, None
        for line in self.run(verb, "--help", "all").stdout.splitlines():
            if line.startswith("  --"):
                words = line[2:].split("  ")[0].split()
                name = words[0][2:].replace("-", "_")
                options[name] = (" ".join(words[1:]), [])
            elif line.strip().startswith("one of: ") and name:
                options[name] = (options[name][0], line.strip()[8:].split())
        return options


@pytest.fixture
def program():
    return Program()


def unmeasured(text):
    """An answer's lines without what is measured."""
    lines = text.splitlines()
    assert json.loads(text)["schema"] == "warren.answer/1"
    return [line for line in lines if not line.startswith(tuple(f' "{key}"' for key in MEASURED))]
