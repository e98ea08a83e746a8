#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many there are of what README and pages count is what lies in the tree. What only a run can tell, its script holds:
hls/rtl/simulate.sh the figures of the front end.
usage: counts.py
"""
import collections
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def text(path):
    return (ROOT / path).read_text(encoding='utf-8')


def counts():
    """(page, pattern with a number, the true one)."""
    cases = json.loads(text('vectors/manifest.json'))['cases']
    of = collections.Counter(c['stage'] for c in cases)
    mutants = text('tests/mutants/list.txt')
    rows = re.search(r'^rows="\n(.*?)^"', text('tests/matrix/matrix.sh'), re.M | re.S)[1]
    yield 'README.md', r'(\d+) cases, as PNG', len(cases)
    yield 'README.md', r'in (\d+) builds for ten instruction sets', len(rows.splitlines())
    yield 'README.md', r'changes (\d+) single things', len(re.findall(r'^name: ', mutants, re.M))
    yield 'README.md', r'catch all but (\d+) \(', len(re.findall(r'^survives: ', mutants, re.M))
    fuzzed = re.findall(r'^    \{"(\w+)", \{\{', text('tests/fuzz/stages.c'), re.M)
    rest = re.search(r'Not fuzzed alone: the stages (.*?);', text('docs/security.md'), re.S)
    yield 'docs/security.md', r"(\d+) of the vectors' \d+ stages", len(fuzzed)
    yield 'docs/security.md', r"\d+ of the vectors' (\d+) stages", len(of)
    yield 'docs/security.md', r'each of the (\d+) thresholds', len(re.findall(r'^    (?:WHOLE|REAL)\(',
                                                                            text('src/cli/thresholds.c'), re.M))
    if rest is None or set(re.findall(r'`(\w+)`', rest[1])) != set(of) - set(fuzzed):
        yield 'docs/security.md', r'not fuzzed alone are .*', ' '.join(sorted(set(of) - set(fuzzed)))
    yield 'hls/filter/README.md', r'all (\d+) vectors', of['kalman']


def main():
    problems, held = [], 0
    for page, pattern, true in counts():
        found = re.findall(pattern, text(page), re.M)
        held += len(found)
        problems += [f'{page}: no count by {pattern}'] if not found else []
        problems += [f'{page}: {count}, but there are {true}: {pattern}' for count in found if int(count) != true]
    print('\n'.join(problems) if problems else f'counts: {held} of pages are right')
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())
