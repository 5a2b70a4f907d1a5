#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""behaviour_tree_test.py PROGRAM: the part of docs/behaviour_tree.md that speaks HTTP, run as it stands there against a service."""
import ast
import os
import re
import signal
import subprocess
import sys
import tempfile

from pages import ROOT, prepared

START, GOAL, DEAR = [0.5, 0.5], [4.3, 0.5], 'area 4 2 0 3 0 3 1 2 1'


def asked(service):
    first = service.plan(START, GOAL)
    assert first['status'] == 'solved' and first['verified'] and first['price']['clearance'] > 0, first['status']
    assert 'kept' not in first
    path = first['path']
    again = service.plan(path[0], GOAL)
    assert again['kept'] and again['path'] == path, 'the same question flips'
    assert again['kept_cost'] <= again['new_cost'] / 0.95
    dear = service.plan(START, GOAL, prices=[DEAR], robot='disc 0.15')
    assert dear['status'] == 'solved', dear['status']
    other = service.plan(START, [0.9, 0.5])
    assert 'kept' not in other, 'another goal starts anew'
    try:
        service.plan(START, ['here'])
    except ValueError as error:
        assert 'number' in str(error), error
    else:
        raise AssertionError('nobody understands this')


def main():
    blocks = re.findall(r'^```python\n(.*?)^```', (ROOT / 'docs/behaviour_tree.md').read_text(encoding='utf-8'), re.S | re.M)
    speaks, node = blocks
    ast.parse(node)  # py_trees and ROS are not there
    names = {}
    exec(compile(speaks, 'docs/behaviour_tree.md', 'exec'), names)  # pylint: disable=exec-used
    with tempfile.TemporaryDirectory() as folder:
        environment = prepared(folder, os.path.abspath(sys.argv[1]))
        command = ['warren', 'serve', 'flat.yaml', '--robot', 'disc 0.2', '--clearance-price', '3,0.5', '--port', '0']
        with subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True) as server:
            try:
                asked(names['PathService'](re.search(r'http://\S+', server.stdout.readline())[0]))
            finally:
                server.send_signal(signal.SIGTERM)
                server.wait(60)


main()
