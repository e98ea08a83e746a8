#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The library as two files to drop into a project: drogue/drogue.h with all public headers, drogue.c with all sources.

usage: amalgamate.py FOLDER

Each header and source comes once, after those it includes. A source's own names that occur in other sources too get the
source's name appended; its macros end with it."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]+(?:"([^"]+)"|<([^>]+)>).*\n', re.M)
WORD = r'(?<![\w.>"/]){}\b'  # not a member, nor in the name of a header


def version():
    text = (ROOT / 'include/drogue/version.h').read_text()
    return '.'.join(re.search(rf'DROGUE_VERSION_{part} (\d+)', text)[1] for part in ('MAJOR', 'MINOR', 'PATCH'))


class Writer:
    """Files one after the other, each once, their own includes first or dropped."""

    def __init__(self, known=()):
        self.written, self.systems, self.text = set(known), set(), ''

    def add(self, path, body=None):
        if path in self.written:
            return
        self.written.add(path)
        body = path.read_text() if body is None else body
        for quoted, system in INCLUDE.findall(body):
            if quoted:
                self.add(find(quoted))
            elif system not in self.systems:
                self.systems.add(system)
                self.text += f'#include <{system}>\n'
        self.text += f'\n/* ==== {path.relative_to(ROOT)} ==== */\n' + INCLUDE.sub('', body)


def core(pattern):
    """Files of the library below src/, the host program's left out."""
    return sorted(path for path in (ROOT / 'src').rglob(pattern) if 'cli' not in path.parts)


def find(name):
    for path in (ROOT / 'include' / name, *(path for path in core('*.h') if path.name == name)):
        if path.exists():
            return path
    sys.exit(f'amalgamate: no file {name}')


def without_bodies(text):
    """The text at file scope: no comments, no strings, nothing in braces but that of enums and the tags before them."""
    text = re.sub(r'/\*.*?\*/|//[^\n]*|"(\\.|[^"\\\n])*"', ' ', text, flags=re.S)
    text = re.sub(r"'(\\.|[^'\\\n])*'", ' ', text)
    enums = ' '.join(re.findall(r'\benum\b[^{;]*\{([^}]*)\}', text))
    previous = None
    while previous != text:
        previous, text = text, re.sub(r'\{[^{}]*\}', ';', text)
    return text, enums


def own_names(source):
    """Names that a source declares for itself at file scope."""
    text, enums = without_bodies(source)
    names = set(re.findall(r'^[ \t]*#[ \t]*define[ \t]+(\w+)', text, re.M))
    names |= set(re.findall(r'(\w+)[ \t]*(?:=[^,]*)?(?:,|$)', enums, re.M))
    text = re.sub(r'^[ \t]*#(?:[^\n\\]|\\.|\\\n)*', '', text, flags=re.M)
    names |= set(re.findall(r'\bstatic\b[^;=(]*?(\w+)\s*(?:\[[^\]]*\]\s*)*[;=(]', text))
    names |= set(re.findall(r'\b(?:struct|union|enum)\s+(\w+)\s*;', text))
    names |= set(re.findall(r'\btypedef\b[^;]*;\s*(\w+)\s*;', text))
    names |= set(re.findall(r'\btypedef\b[^;]*?(\w+)\s*;', text))
    return {name for name in names if not name.lower().startswith('drogue_')}


def sources():
    """Text per source, with names made unique."""
    texts = {path: path.read_text() for path in core('*.c')}
    words = {path: set(re.findall(r'\w+', text)) for path, text in texts.items()}
    for path in texts:
        elsewhere = set().union(*(words[other] for other in texts if other != path))
        for name in own_names(texts[path]) & elsewhere:
            texts[path] = re.sub(WORD.format(name), f'{name}_{path.stem}', texts[path])
    for path, text in texts.items():
        macros = re.findall(r'^[ \t]*#[ \t]*define[ \t]+(\w+)', text, re.M)
        texts[path] = text + ''.join(f'#undef {name}\n' for name in macros)
    return texts


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    head = (f'/* SPDX-License-Identifier: Apache-2.0 */\n/* Drogue {version()} in two files, drogue/drogue.h and drogue.c, made '
            'by amalgamate.py from the sources: change those. */\n')
    headers = Writer()
    for path in sorted((ROOT / 'include/drogue').glob('*.h')):
        headers.add(path)
    core = Writer(headers.written)
    for path, text in sources().items():
        core.add(path, text)
    include = folder / 'drogue'  # so that the library's include lines are the same in this form
    include.mkdir(parents=True, exist_ok=True)
    (include / 'drogue.h').write_text(f'{head}#ifndef DROGUE_IN_TWO_FILES_H\n#define DROGUE_IN_TWO_FILES_H\n\n'
                                      f'{headers.text}\n#endif\n')
    (folder / 'drogue.c').write_text(f'{head}#include "drogue/drogue.h"\n\n{core.text}')
    print(f'amalgamate: {folder}/drogue.c and drogue/drogue.h, drogue {version()}')


if __name__ == '__main__':
    main()
