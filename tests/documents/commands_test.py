#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""commands_test.py PROGRAM: exit code 1 where a command of the documents fails. Asked are the first block of commands of each page, all of
README but what takes long, and all blocks `sh` of the pages with pictures, whose pictures must be those of docs/, byte for byte.
A command may find no path (exit code 1); `warren serve` must listen, and end by SIGTERM."""
import os
import re
import signal
import subprocess
import sys
import tempfile

from pages import DRAWN, ROOT, commands_of, differing_pictures, prepared

PAGES = ['README.md', 'docs/tutorial.md', 'docs/gallery.md', 'docs/reports.md', 'docs/service.md', 'docs/behaviour_tree.md', 'docs/algorithms.md',
         'docs/other_names.md', 'examples/worlds/README.md']
TAKES_LONG = re.compile(r'largest|scale|5000x5000|big\.npy --budget|100000x100000|--sizes|--curves')


def fails(command, folder, environment):
    """What is wrong with a command, or nothing."""
    if re.search(r'\bwarren serve\b', command):
        server = subprocess.Popen(['bash', '-c', f'exec {command} --port 0'], cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)
        said = server.stdout.readline()
        server.send_signal(signal.SIGTERM)
        code = server.wait(60)
        return '' if said.startswith('listening') and code == 0 else f'said {said!r}, exit code {code}'
    run = subprocess.run(['bash', '-c', command], cwd=folder, env=environment, capture_output=True, text=True, timeout=300, check=False)
    return '' if run.returncode in (0, 1) else f'exit code {run.returncode}: {run.stderr.strip()[-200:]}'


def main():
    program, failures, asked = os.path.abspath(sys.argv[1]), 0, 0
    for page in PAGES:
        if not (ROOT / page).exists():
            continue
        with tempfile.TemporaryDirectory() as folder:
            environment = prepared(folder, program)
            blocks = commands_of((ROOT / page).read_text(encoding='utf-8'))
            chosen = blocks if page == 'README.md' or page in DRAWN else blocks[:1]
            for command in (command for block in chosen for command in block if not TAKES_LONG.search(command)):
                asked += 1
                why = fails(command, folder, environment)
                if why:
                    failures += 1
                    print(f'{page}: {command}: {why}')
            for picture in differing_pictures(page, folder) if page in DRAWN else []:
                failures += 1
                print(f'{page}: {picture} is not what its command draws: tools/gallery draws all anew')
    print(f'{asked} commands')
    sys.exit(1 if failures else 0)


main()
