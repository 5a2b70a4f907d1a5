# SPDX-License-Identifier: BSD-3-Clause
"""syntax_alone.py COMPILE_COMMANDS.json FOLDER: compiles what lies below the folder no further than its syntax, on all cores."""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys


def command(entry):
    words = shlex.split(entry["command"])
    at = words.index("-o")
    return [*words[:at], *words[at + 2:], "-fsyntax-only"]


def main():
    entries = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))
    wanted = [e for e in entries if f"/{sys.argv[2]}CMakeFiles/" in e["command"]]
    if not wanted:
        sys.exit(f"{sys.argv[1]}: nothing of {sys.argv[2]}")
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as crew:
        failed = sum(run.returncode != 0 for run in crew.map(lambda e: subprocess.run(command(e), cwd=e["directory"]), wanted))
    print(f"{len(wanted)} batches, {failed} failed")
    sys.exit(failed != 0)


main()
