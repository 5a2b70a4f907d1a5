#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""sentences_test.py [--list N] [PAGE...]: exit code 1 where a page has a sentence of more words than it may have, or
names a file of the tree, such as `planners/grid/price_field`, that is not there. Tables, headings and
blocks of code are left out, a span of code is one word, and a sentence ends with its paragraph or item of a list.
--list N prints all sentences of more than N words."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LIMITS = {'README.md': 30, 'docs/tutorial.md': 30, 'docs/service.md': 30, 'docs/behaviour_tree.md': 30, 'docs/python.md': 30, 'docs/file_formats.md': 30,
          'docs/other_names.md': 30, 'docs/gallery.md': 30, 'docs/reports.md': 35, 'docs/algorithms.md': 40, 'docs/performance.md': 60}

BOTH_WORDS = ('docs/other_names.md', 'docs/file_formats.md')  # they say that --svg is another name of --picture

NAMES = re.compile(r'`((?:core|parallel|spatial|scenes|worlds|verify|planners|solve|pictures|apps|tools)/[\w/.]*\w)`')


def blocks(text):
    """Paragraphs and items of lists, each as (line, text)."""
    line_of, block, is_code = 0, [], False
    for number, line in enumerate(text.split('\n'), 1):
        if line.startswith('```'):
            is_code = not is_code
        no_prose = is_code or line.startswith(('```', '|', '#', '![', '    ')) or not line.strip()
        if block and (no_prose or re.match(r' *([-*]|\d+\.) ', line)):
            yield line_of, ' '.join(block)
            block = []
        if not no_prose:
            line_of = line_of if block else number
            block.append(line.strip())
    if block:
        yield line_of, ' '.join(block)


def sentences(text):
    """(line of its paragraph, words, text) of each sentence."""
    for line, block in blocks(text):
        block = re.sub(r'\]\([^)]*\)', ']', re.sub(r'`[^`]*`', 'CODE', block))
        for sentence in re.split(r'(?<=[.!?])[*)\]"]* +(?=[*("\[]*[A-Z0-9])', block):
            yield line, sum(bool(re.search(r'\w', word)) for word in sentence.split()), sentence


def main():
    arguments = sys.argv[1:]
    most = int(arguments[1]) if arguments[:1] == ['--list'] else None
    failures = 0
    for page in arguments[2 if most is not None else 0:] or LIMITS:
        if not (ROOT / page).exists():
            continue
        if page not in BOTH_WORDS and '--svg' in (ROOT / page).read_text(encoding='utf-8'):
            failures += 1
            print(f'{page}: says --svg; one word for one thing: --picture')
        for name in NAMES.findall((ROOT / page).read_text(encoding='utf-8')):
            if not (ROOT / name).exists() and not list(ROOT.glob(name + '.*')):
                failures += 1
                print(f'{page}: {name} is not there')
        for line, words, sentence in sentences((ROOT / page).read_text(encoding='utf-8')):
            if words > (LIMITS[page] if most is None else most):
                failures += 1
                print(f'{page}:{line}: {words} words: {sentence}')
    sys.exit(1 if failures else 0)


main()
