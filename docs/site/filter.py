#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a header's plain comments, or a page, in Doxygen's words; lines keep their numbers.

A header's comment describes what begins on the line after it, or what stands before it on its line. In the list of a function's
comment a name is a parameter's, with or without its unit and format ('x' for x_px_q16), 'return', or one of TOPICS; any
other makes Doxygen warn, which is an error, and so does a status whose errors the comment does not name. A page's links to files
that are no pages become their names.
usage: filter.py FILE, from the top folder
"""
import os
import re
import sys

TOPICS = ('scaling', 'error', 'source')
ITEM = re.compile(r' \*  (\S(?:[^ ]| (?! ))*)  +(.*)$')


def escaped(text):
    return re.sub(r'([@\\<>#%])', r'\\\1', text)


def parameters(code):
    """Names of the parameters of the function that 'code' begins with."""
    declared = re.match(r'[^;{}=]*?\w\s*\(((?:[^()]|\([^()]*\))*)\)', code)
    if not declared:
        return []
    names = [re.sub(r'\[[^]]*\]', '', p).split() for p in re.split(r',(?![^[]*\])', declared.group(1))]
    return [re.sub(r'\W', '', n[-1]) for n in names if n]


def commands(names, known, text):
    """Doxygen's commands for a line of a list."""
    given = []
    for name in names:
        if name not in ('return', *TOPICS):
            given += [p for p in known if p == name] or [p for p in known if p.startswith(name + '_')] or [name]
    out = f'@param {",".join(given)} {text}' if given else ''
    for name in names:
        if name == 'return':
            out += f' @return {text}'
        elif name in TOPICS:
            out += f' @{name}_is {text}'
    return out


def comment(lines, code):
    """A comment of its own as Doxygen's: 'lines' from '/*' to '*/', 'code' what follows."""
    known = parameters(code)
    out, listing, example = [], False, False
    for line in lines:
        last = line.endswith('*/')
        body = (line[:-2] if last else line).rstrip()
        item = ITEM.match(body)
        if not out:
            text = '/**' + escaped(body[2:])
        elif item:
            listing = True
            text = ' * ' + commands(re.split(r', *', item.group(1)), known, escaped(item.group(2)))
        elif not listing and body.startswith(' *     '):
            text = ' * ' + ('' if example else '@code{.c}') + body[7:]
            example = True
        else:
            closes = example and body.strip(' *') != ''
            text = ' *' + (' @endcode' if closes else '') + escaped(body[2:])
            example = example and not closes
        out.append(text.rstrip() + (' @endcode' if last and example else '') + (' */' if last else ''))
    status = re.match(r'(?:static inline )?drogue_status\s+(\w+)', code)
    if status and not re.search(r'\breturn\b|DROGUE_E_', ' '.join(lines)):
        out[-1] = out[-1][:-2] + f'@ref errors_of_{status.group(1)} */'  # nowhere: Doxygen says so
    return out


def header(text):
    lines = text.split('\n')
    out, at, inside, shared, described = [], 0, False, '', False
    while at < len(lines):
        line = lines[at]
        begin = line.find('/*')
        inside = line == '{' or inside and line != '}'
        if begin < 0 or inside or at == 0:
            if not line:
                shared = ''
            elif shared and not inside and re.match('[a-z]|#define', line):
                line = (shared + ' ' if described else '') + line  # a comment holds for all up to the next empty line
                described = True
            out.append('/** @file' if at == 0 else line)
            at += 1
            continue
        end = at
        while '*/' not in lines[end]:
            end += 1
        if line[:begin].strip():  # behind what it describes
            several = re.match(r'( +[\w ]+) (\w+(?:, \w+)+);', line)
            if several:
                text = '/**<' + escaped(line[begin + 2:])
                line = ''.join(f'{several.group(1)} {n}; {text}' for n in several.group(2).split(', '))
                out.append(line)
                at = end + 1
                continue
            out += [line[:begin] + '/**<' + escaped(line[begin + 2:])] + [escaped(b) for b in lines[at + 1:end + 1]]
        else:
            indent = line[:begin]
            block = [b[len(indent):] if b.startswith(indent) else b for b in lines[at:end + 1]]
            code = '\n'.join(lines[end + 1:end + 12])
            block = comment(block, code)
            if at == 1:  # after the licence: the file's own
                block[0] = block[0].replace('/**', ' *', 1)
            elif end + 1 < len(lines) and not lines[end + 1].strip():
                block[0] = block[0].replace('/**', '/*', 1)  # about the file's next part, nothing of its own
            out += [indent + b for b in block]
            shared, described = ' '.join(b.removeprefix(' *') if k else b for k, b in enumerate(block)), False
        at = end + 1
    return '\n'.join(out)


def pages():
    """The pages of the site, as the Doxyfile names them, with their labels."""
    with open('docs/site/Doxyfile', encoding='utf-8') as file:
        names = re.findall(r'[\w/]+\.md', re.search(r'^INPUT = (.*?[^\\])$', file.read(), re.S | re.M).group(1))
    return {n: n[:-3].replace('/README', '').removeprefix('docs/').replace('/', '_').lower() for n in names}


def slug(title):
    return re.sub(r'[^\w -]', '', title.lower()).replace(' ', '-')


def page(text, name):
    known = pages()

    def link(match):
        text, target = match.groups()
        if '://' in target:
            return match.group(0)
        to, _, anchor = target.partition('#')
        to = os.path.normpath(os.path.join(os.path.dirname(name), to)) if to else name
        if to in known:
            return f'@ref {known[to]}{"-" + anchor if anchor else ""} "{text}"'
        if not os.path.exists(to):
            return f'@ref {to}'  # nowhere: Doxygen says so
        return text if to == text.strip('`') else f'{text} (`{to}`)'

    def emphasis(_):
        nonlocal bold
        bold = not bold
        return '<b>' if bold else '</b>'

    out, code, bold = [], False, False
    for line in text.split('\n'):
        code ^= line.startswith('```')
        heading = re.match(r'(#+) (.*)$', line)
        if code or line.startswith('```'):
            out.append(line)
        elif heading:
            label = known[name] + ('' if len(heading.group(1)) == 1 else '-' + slug(heading.group(2)))
            out.append(f'{line} {{#{label}}}')
        else:
            line = re.sub(r'(?<!!)\[([^]]+)\]\(([^)]+)\)', link, line)
            out.append(re.sub(r'\*\*', emphasis, line))  # Doxygen's own ends with the line
    return '\n'.join(out)


if __name__ == '__main__':
    name = sys.argv[1]
    with open(name, encoding='utf-8') as file:
        content = file.read()
    sys.stdout.write(header(content) if name.endswith('.h') else page(content, os.path.relpath(name)))
