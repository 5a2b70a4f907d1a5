# SPDX-License-Identifier: BSD-3-Clause
"""The commands and pictures of a page of Markdown, for tools/gallery and commands_test.py."""
import os
import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[2]
DRAWN = ['README.md', 'docs/tutorial.md', 'docs/algorithms.md']  # pages whose own commands draw their pictures


def commands_of(text):
    """A list for each block of commands: lines that call warren, and files written by `cat` or `printf`. Of a session those behind a `$`."""
    blocks = []
    for block in re.findall(r'^```(?:sh)?\n(.*?)^```', text, re.S | re.M):
        sessions = re.findall(r'^\$ (.*)', block, re.M)
        found = sessions or re.findall(r'^(cat > .*?^END$|warren .*?)$', block, re.S | re.M)
        commands = [command for command in found if re.match(r'warren |cat > |printf ', command)]
        if commands:
            blocks.append(commands)
    return blocks


def prepared(folder, program):
    """The environment in which `warren` is the program; the folder has the worlds of `warren example` and those of the tests."""
    shutil.copytree(ROOT / 'examples/worlds', folder, dirs_exist_ok=True)
    shutil.copytree(ROOT / 'tests/data', os.path.join(folder, 'tests/data'))
    os.mkdir(os.path.join(folder, 'bin'))
    os.symlink(program, os.path.join(folder, 'bin/warren'))
    return {**os.environ, 'PATH': os.path.join(folder, 'bin') + ':' + os.environ['PATH']}


def pictures_of(page, folder):
    """(drawn, kept) of each picture of the page that its commands have drawn into the folder."""
    text = (ROOT / page).read_text(encoding='utf-8')
    for target in re.findall(r'^!\[[^\]]*\]\(([^)]+)\)', text, re.M):
        drawn = pathlib.Path(folder, os.path.basename(target))
        if drawn.exists():
            yield drawn, (ROOT / page).parent / target


def differing_pictures(page, folder):
    for drawn, kept in pictures_of(page, folder):
        if not kept.exists() or drawn.read_bytes() != kept.read_bytes():
            yield kept.name
