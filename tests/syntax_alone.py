# SPDX-License-Identifier: BSD-3-Clause
"""syntax_alone.py COMPILE_COMMANDS.json FOLDER [EXCEPT]: compiles what lies below the folder no further than its syntax, on
all cores; but for targets whose names begin with EXCEPT."""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys


def split(entry):
    """What the compiler is told but for -o, and what stands behind that."""
    words = shlex.split(entry["command"])
    at = words.index("-o")
    return [*words[:at], *words[at + 2:], "-fsyntax-only", "-w"], words[at + 1]


def main():
    entries = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    left_out = f"{sys.argv[2]}CMakeFiles/{sys.argv[3]}" if len(sys.argv) > 3 else "/"
    wanted = [(split(e)[0], e["directory"]) for e in entries
              if split(e)[1].startswith(sys.argv[2]) and not split(e)[1].startswith(left_out)]
    if not wanted:
        sys.exit(f"{sys.argv[1]}: nothing of {sys.argv[2]}")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as crew:
        failed = sum(run.returncode != 0 for run in crew.map(lambda w: subprocess.run(w[0], cwd=w[1]), wanted))
    print(f"{len(wanted)} batches, {failed} failed")
    sys.exit(failed != 0)


main()
