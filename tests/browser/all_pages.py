#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""all_pages.py WARREN EXAMPLES [WORD ...]: the tests of all pages in one Chromium, each class in a context of its own; with
words those whose names hold one, by day (WARREN_SEEDS=day) half of them, which WARREN_PICK chooses. Prints the seconds of each
class. A class ends with its first failure, all with the third: what
waits for a page that throws waits a minute each time."""
import importlib.util
import os
import pathlib
import sys
import tempfile
import time
import unittest
import zlib

import browser

HERE = pathlib.Path(__file__).parent


def main():
    warren, worlds, *words = sys.argv[1:]
    suite = []
    for path in sorted(HERE.glob('*_test.py')):
        sys.argv = [path.name, warren, worlds]  # what each file takes when it is run alone
        spec = importlib.util.spec_from_file_location('pages.' + path.stem, path)  # the service has tests of this name elsewhere
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        suite += [(group, path.stem) for group in unittest.defaultTestLoader.loadTestsFromModule(module)]
    with tempfile.TemporaryDirectory() as folder:
        browser.shared = browser.start(folder)
        try:
            return run(suite, words)
        finally:
            browser.shared.quit()


def is_asked(test, words):
    if words:
        return any(word in test.id() for word in words)
    pick = os.environ.get('WARREN_PICK', '')
    return os.environ.get('WARREN_SEEDS') != 'day' or not pick or zlib.crc32(f'{pick} {test.id()}'.encode()) % 2 == 0


def run(suite, words):
    failed, asked = 0, 0
    for group, name in suite:
        chosen = unittest.TestSuite(test for test in group if is_asked(test, words))
        if chosen.countTestCases() == 0:
            continue
        began = time.monotonic()
        result = unittest.TextTestRunner(verbosity=0, stream=sys.stdout, failfast=True).run(chosen)
        print(f'{name}: {result.testsRun} tests, {time.monotonic() - began:.1f} s', flush=True)
        failed += not result.wasSuccessful()
        asked += result.testsRun
        if failed == 3:
            print('the rest was not asked')
            break
    print(f'{asked} tests')
    return 1 if failed or asked == 0 else 0


if __name__ == '__main__':
    sys.exit(main())
