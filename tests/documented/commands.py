#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every command that README and pages show stands in commands.txt, with who runs it: this, in a fresh clone, another test, or
nobody and why. A command that is in no line, a line whose command no page shows, a test that is not run: each is an error.
usage: commands.py          only that
       commands.py --run    and run, as they stand, those that are said to be run here
"""
import glob
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ['README.md', *sorted(glob.glob('docs/*.md', root_dir=ROOT)), 'vectors/README.md', 'hls/README.md',
         *sorted(glob.glob('hls/*/README.md', root_dir=ROOT))]
PROGRAMS = r'\./run|drogue|cmake|ctest|sudo|pip|python3?|git|cd|cp|ffmpeg|qemu-\S+|vitis-run|v\+\+|man|(?:hls|tests|build)/\S+'
COMMAND = re.compile(rf'(?:\$ )?((?:{PROGRAMS}) \S.*)$')
SCRIPT = re.compile(r'((?:hls|tests|build)/\S+\.sh)$')
FOREIGN = ('c', 'python', 'verilog')  # languages of other blocks: other tests run those


def shown():
    """(command, page) of all commands: lines of blocks, and code within the text."""
    for page in PAGES:
        block, continued = None, ''
        for line in (ROOT / page).read_text(encoding='utf-8').splitlines():
            if line.startswith('```'):
                block = line[3:].strip() or 'sh' if block is None else None
                continue
            if block is None:
                found = re.findall(r'`([^`]+)`', line)
            elif block in FOREIGN:
                continue
            elif line.endswith('\\'):
                continued += line[:-1].strip() + ' '
                continue
            else:
                found, continued = [continued + line.strip()], ''
            for text in found:
                text = re.sub(r'\s+#\s.*', '', text)
                command = COMMAND.match(text) or SCRIPT.match(text)
                if command:
                    yield command.group(1), page


def listed():
    """(how, command) of commands.txt, in its order."""
    for line in (ROOT / 'tests/documented/commands.txt').read_text(encoding='utf-8').splitlines():
        if line and not line.startswith('#'):
            how, command = line.split(' | ', 1)
            yield how.strip(), command.strip()


def where_tests_are_run():
    run = (ROOT / 'run').read_text(encoding='utf-8')
    text = run[run.index('run_tests() {'):run.index('# What every change')]
    for path in ROOT.rglob('CMakeLists.txt'):
        if 'build' not in path.relative_to(ROOT).parts:
            text += path.read_text(encoding='utf-8')
    return text


def check():
    problems = []
    pages = dict(shown())
    commands = [c for _, c in listed()]
    tests = where_tests_are_run()
    problems += [f'{page} shows a command that is not in commands.txt: {c}' for c, page in pages.items() if c not in commands]
    problems += [f'commands.txt: no page shows: {c}' for c in commands if c not in pages]
    problems += [f'commands.txt: twice: {c}' for c in set(commands) if commands.count(c) > 1]
    for how, command in listed():
        kind, _, rest = how.partition(' ')
        if kind == 'by':
            if rest not in tests:
                problems.append(f"commands.txt: '{rest}' is no step of ./run test and no test of CTest: {command}")
        elif kind not in ('run', 'never') or (kind == 'never' and not rest):
            problems.append(f"commands.txt: neither run, by nor never with a reason: '{how}'")
    return problems


def session(work):
    """A shell script that runs, as they stand, the commands of kind 'run'."""
    here = ROOT / 'tests/documented'
    yield 'set -euo pipefail'
    for how, command in listed():
        kind, _, settings = how.partition(' ')
        if kind == 'run':
            command = command.replace('git clone URL', f'git clone -q file://{ROOT}')
            yield f'echo {shlex.quote("== " + command)}'
            yield f'(export {settings.format(work=work)}; {command})' if settings else command
            if command == 'cd drogue':  # what the pages take for granted
                yield f'mkdir frames && cp vectors/frame/demo.png frames && cp {here}/camera.yaml .'
    yield 'echo "documented: done"'


def stand_in(path, text):
    path.write_text('#!/bin/sh\n' + text)
    path.chmod(0o755)


def run():
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        for name in ('home', 'tools', 'root', 'here'):
            (work / name).mkdir()
        # nothing outside the folder is written; a film of the demo's picture in place of flight.mp4
        stand_in(work / 'tools/sudo', 'exec "$@"\n')
        stand_in(work / 'tools/ffmpeg', f'exec /usr/bin/python3 {ROOT}/tests/documented/film.py "$@"\n')
        (work / 'home/.gitconfig').write_text('[safe]\n\tdirectory = *\n')  # whoever owns the tree here
        subprocess.run(['/usr/bin/python3', '-m', 'venv', work / 'venv'], check=True)
        build = work / 'here/drogue/build/release/src/cli'
        path = f'{work}/tools:{work}/venv/bin:{build}:{os.environ["PATH"]}'
        shell = work / 'session.sh'
        shell.write_text('\n'.join(session(work)) + '\n')
        result = subprocess.run(['bash', shell], cwd=work / 'here', stdin=subprocess.DEVNULL, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                env={**os.environ, 'HOME': str(work / 'home'), 'PATH': path, 'MANPAGER': 'cat',
                                     'MANPATH': f'{work}/home/.local/share/man', 'PIP_DISABLE_PIP_VERSION_CHECK': '1'})
        log = ROOT / 'build/documented.log'
        log.parent.mkdir(exist_ok=True)
        log.write_text(result.stdout)
        if result.returncode != 0 or not result.stdout.endswith('documented: done\n'):
            print(result.stdout[-3000:])
            return [f'a documented command failed: {log}']
    return []


if __name__ == '__main__':
    wrong = check() or (run() if '--run' in sys.argv[1:] else [])
    print('\n'.join(wrong) if wrong else f'documented: {len(list(listed()))} commands of {len(PAGES)} pages')
    sys.exit(1 if wrong else 0)
