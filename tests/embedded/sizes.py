#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tables of flash, RAM and worst-case stack from the objects and .su files of builds; called by sizes.sh.

Stack: frame sizes from gcc's -fstack-usage, calls from the disassembly with relocations (one section a function),
frames of the compiler's helpers and of memcpy and memset from their pushes in a linked image. The graph has no cycle and
no call through a pointer, or this fails."""
import pathlib
import re
import subprocess
import sys
from functools import lru_cache

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = {'sizes': ROOT / 'docs/sizes.md', 'stack': ROOT / 'docs/sizes.md', 'ram': ROOT / 'docs/sizes.md', 'data': ROOT / 'docs/architecture.md'}

HARNESS = 128  # bytes of stack that run() and peak_stack() of measure.c may use themselves

ARM, RISCV = 'arm-none-eabi-', 'riscv64-unknown-elf-'
# A core by its toolchain file in src/cmake: name, tools, what they need to link.
CORES = {'cortex-m0plus': ('Cortex-M0+', ARM, '-mcpu=cortex-m0plus -mthumb'),
         'cortex-m4': ('Cortex-M4', ARM, '-mcpu=cortex-m4 -mthumb'),
         'cortex-m7': ('Cortex-M7', ARM, '-mcpu=cortex-m7 -mthumb'),
         'rv32imac': ('RV32IMAC', RISCV, '-march=rv32imac -mabi=ilp32 --specs=picolibc.specs -Wl,--defsym=__flash_size=4M')}
OPTIONS = ('Os', 'O2')
CALLS = ('drogue_measure', 'drogue_track_frame', 'drogue_acquire')  # of the table of stacks


def tool(name, *arguments, prefix=ARM):
    return subprocess.run([prefix + name, *map(str, arguments)], check=True, text=True, stdout=subprocess.PIPE).stdout


class Library:
    """Functions and constants of libdrogue.a: flash, calls and frames, keyed by (stage, name)."""

    def __init__(self, folder, core='cortex-m7'):
        _, self.prefix, flags = CORES[core]
        self.flags = flags.split()
        self.archive = folder / 'library' / 'libdrogue.a'
        self.linked = folder / 'linked'
        self.flash, self.exported, self.calls, self.frames = {}, {}, {}, {}
        self.stage_flash, self.stage_ram = {}, {}
        self.read_sections()
        self.read_symbols()
        self.read_calls()
        self.read_frames(folder / 'library')

    def tool(self, name, *arguments):
        return tool(name, *arguments, prefix=self.prefix)

    def read_sections(self):
        for block in self.tool('size', '-A', self.archive).split('\n\n'):
            lines = block.strip().splitlines()
            if not lines or ':' not in lines[0]:
                continue
            stage = lines[0].split('.')[0]
            flash = ram = 0
            for line in lines[1:]:
                match = re.match(r'\.(text|rodata|ARM\.ex|data|bss)\S*\s+(\d+)', line)
                if match:
                    flash += int(match[2]) if match[1] != 'bss' else 0
                    ram += int(match[2]) if match[1] in ('data', 'bss') else 0
            self.stage_flash[stage], self.stage_ram[stage] = flash, ram

    def read_symbols(self):
        for line in self.tool('nm', '-A', '-S', self.archive).splitlines():
            match = re.match(r'\S*:(\w+)\.c\.\w+:\S+ (\w+) ([TtRr]) (\S+)', line)
            if match:
                key = (match[1], match[4])
                self.flash[key] = int(match[2], 16)
                if match[3] == 'T':
                    self.exported[match[4]] = key

    def resolve(self, stage, name):
        if (stage, name) in self.flash:
            return (stage, name)
        return self.exported.get(name, ('', name))

    def read_calls(self):
        stage = key = None
        called = False  # RISC-V: the place that a jump goes to stands two lines before it
        for line in self.tool('objdump', '-dr', self.archive).splitlines():
            if match := re.match(r'(\w+)\.c\.\w+: +file format', line):
                stage = match[1]
            elif match := re.match(r'[0-9a-f]+ <(\S+)>:', line):
                if not match[1].startswith('.L'):
                    key = (stage, match[1])
                    self.calls.setdefault(key, set())
            elif match := re.search(r'R_(?:ARM_(?:THM_CALL|THM_JUMP\d+|CALL|JUMP24)|RISCV_(?:CALL\w*|JAL))\s+(\S+)', line):
                if not match[1].startswith('.L'):
                    self.calls[key].add(self.resolve(stage, match[1]))
                called = True
            elif self.prefix == RISCV:
                if re.search(r'\tjalr\t', line) and not called:
                    sys.exit(f'sizes: call through a pointer in {key}')
                called = called and 'R_RISCV_RELAX' in line
            elif re.search(r'\tblx?\tr\d', line) or re.search(r'\tblx?\t(ip|lr)', line) and '\tbx\tlr' not in line:
                sys.exit(f'sizes: call through a pointer in {key}')

    def read_frames(self, folder):
        for path in folder.rglob('*.su'):
            for line in path.read_text().splitlines():
                place, size, kind = line.split('\t')
                if kind not in ('static', 'dynamic,bounded'):
                    sys.exit(f'sizes: stack without a bound: {line}')
                self.frames[(path.name.split('.')[0], place.split(':')[-1])] = int(size)
        for key in [k for k in self.calls if k not in self.frames]:
            plain = (key[0], re.sub(r'\.\d+$', '', key[1]))  # a clone of the compiler's: x.isra.0
            base = (key[0], key[1].split('.')[0])
            found = self.frames.get(plain, self.frames.get(base))
            if found is None:
                sys.exit(f'sizes: no stack usage of {key}')
            self.frames[key] = found
        self.read_helpers({c for called in self.calls.values() for c in called if c[0] == ''})

    def read_helpers(self, wanted):
        """Frames and calls of functions outside the library, from all of it linked: pushes, subtractions, pre-decrements."""
        bodies, at, name = {}, {}, None
        self.tool('gcc', *self.flags, '-nostartfiles', '-Wl,--no-gc-sections,-e,0,--whole-archive', self.archive,
                  '-Wl,--no-whole-archive', '-o', self.linked)
        for line in self.tool('objdump', '-d', '--no-show-raw-insn', self.linked).splitlines():
            if match := re.match(r'([0-9a-f]+) <(\S+)>:', line):
                name = match[2]
                bodies[name] = at[int(match[1], 16)] = []
            elif name:
                bodies[name].append(line)
        for fields in map(str.split, self.tool('nm', self.linked).splitlines()):  # of several names of a place one is shown
            if fields[1] in 'TtWw' and len(fields) == 3 and int(fields[0], 16) in at:
                bodies.setdefault(fields[2], at[int(fields[0], 16)])
        while wanted:
            key = wanted.pop()
            if key in self.frames:
                continue
            if key[1] not in bodies:
                sys.exit(f'sizes: {key[1]} is nowhere')
            size, calls = 0, set()
            for line in bodies[key[1]]:
                if match := re.search(r'\t(?:push|stmdb\tsp!,|stmfd\tsp!,)\s*\{(.*)\}', line):
                    size += 4 * sum(register_count(part) for part in match[1].split(','))
                elif match := re.search(r'\tsub(?:w|\.w)?\tsp, (?:sp, )?#(\d+)', line):
                    size += int(match[1])
                elif match := re.search(r'\[sp, #-(\d+)\]!|\taddi?\tsp,sp,-(\d+)', line):
                    size += int(match[1] or match[2])
                elif match := re.search(r'\t(?:b(?:l|lx|\.w|\.n)?\t|j\t|jal\t(?:ra,)?)[0-9a-f]+ <([^+>]+)>', line):
                    calls.add(('', match[1]))
            self.frames[key], self.calls[key] = size, calls - {key}
            wanted |= self.calls[key] - self.frames.keys()

    @lru_cache(maxsize=None)
    def reached(self, key, above=()):
        if key in above:
            sys.exit(f'sizes: recursion: {above}')
        found = {key}
        for called in self.calls.get(key, ()):
            found |= self.reached(called, above + (key,))
        return frozenset(found)

    def links(self, name):
        """Flash of what one call links, without the compiler's helpers."""
        return sum(self.flash[k] for k in self.reached(self.exported[name]) if k in self.flash)

    @lru_cache(maxsize=None)
    def stack(self, key):
        return self.frames[key] + max((self.stack(called) for called in self.calls[key]), default=0)

    def path(self, key):
        deepest = max(self.calls[key], key=self.stack, default=None)
        return [key] + (self.path(deepest) if deepest else [])


def register_count(text):
    low, _, high = (part.strip() for part in text.partition('-'))
    return int(high[1:]) - int(low[1:]) + 1 if high else 1


def caller_ram(folder):
    """Sizes of what the caller keeps, by name."""
    target = folder / 'ram.o'
    tool('gcc', '-mcpu=cortex-m7', '-mthumb', '-std=c99', '-I', folder / 'installed' / 'include', '-c',
         ROOT / 'tests/embedded/ram.c', '-o', target)
    return {f[3].strip('_'): int(f[1], 16) for f in (line.split() for line in tool('nm', '-S', target).splitlines())}


def compiler(prefix=ARM):
    return tool('gcc', '--version', prefix=prefix).splitlines()[0]


def stacks(folder):
    """Worst-case stack in bytes by (core, option), of each of CALLS."""
    found = {}
    for core in CORES:
        for option in OPTIONS:
            library = Library(folder / f'{core}-{option}', core)
            found[(core, option)] = [library.stack(library.exported[name]) for name in CALLS]
    return found


def stack_table(found):
    lines = [f'{compiler()}; {compiler(RISCV)}.', '',
             '| core | option | ' + ' | '.join(f'`{name}`' for name in CALLS) + ' |', '| --- | --- |' + ' --- |' * len(CALLS)]
    return '\n'.join(lines + [f'| {CORES[core][0]} | `-{option}` | ' + ' | '.join(map(str, bytes_)) + ' |'
                              for (core, option), bytes_ in found.items()])


def tables(library, ram):
    measure = library.exported['drogue_measure']
    lines = [f'Cortex-M7, `-Os`, {compiler()}.',
             'Flash is code and constants; worst-case stack includes what is called, the compiler\'s helpers too.', '',
             '| stage | flash, bytes | static RAM | worst-case stack, bytes |', '| --- | --- | --- | --- |']
    for stage in sorted(library.stage_flash):
        deepest = max((library.stack(k) for k in library.exported.values() if k[0] == stage), default=0)
        lines.append(f'| {stage} | {library.stage_flash[stage]} | {library.stage_ram[stage]} | {deepest} |')
    lines.append(f'| **all** | **{sum(library.stage_flash.values())}** | **{sum(library.stage_ram.values())}** | '
                 f'**{max(library.stack(k) for k in library.exported.values())}** |')
    lines += ['', '| RAM of the caller | bytes |', '| --- | --- |']
    lines += [f'| {what} | {ram[name]} |' for what, name in (
        ('workspace for 256 x 256', 'workspace_256x256'), ('workspace for 160 x 120', 'workspace_160x120'),
        ('`drogue_workspace`', 'drogue_workspace'), ('`drogue_config`', 'drogue_config'),
        ('`drogue_result`', 'drogue_result'), ('`drogue_track`', 'drogue_track'),
        ('`drogue_search`', 'drogue_search'), ('its memory for frames 640 px wide', 'search_640'),
        ('its memory for frames 1280 px wide', 'search_1280'))]
    lines += ['', '<details><summary>Every public function</summary>', '',
              '"With what it calls" is what one call links; helpers of the compiler come on top.', '',
              '| function | flash, bytes | with what it calls | worst-case stack, bytes |', '| --- | --- | --- | --- |']
    headers = ''.join(h.read_text() for h in sorted((ROOT / 'include/drogue').glob('*.h')))
    for name in sorted(set(re.findall(r'\b(\w+)\(', headers)) & set(library.exported)):
        key = library.exported[name]
        closure = library.links(name)
        lines.append(f'| `{name}` | {library.flash[key]} | {closure} | {library.stack(key)} |')
    lines += ['', '</details>']
    print('deepest: ' + ' > '.join(f'{k[1]} {library.frames[k]}' for k in library.path(measure)))
    return '\n'.join(lines)


def data_table(ram):
    """What passes from stage to stage: bytes by struct."""
    rows = (('drogue_edge', 'front end', 'an edge point: Q5 pixels, Sobel gradient, arc'),
            ('drogue_arc', 'front end', 'a run of edge points of one direction class'),
            ('drogue_outline', 'outline', 'ellipse in Q16 pixels, quality, support by bins'),
            ('drogue_ellipse', 'outline', 'the ideal ellipse, without distortion, Q16 pixels'),
            ('drogue_inner_evidence', 'inner part', 'centre in Q16 pixels, its standard deviation, the nearer pose'),
            ('drogue_evidence', 'pose', 'both poses of the cone, outline, inner part'),
            ('drogue_decision', 'pose', 'pose in Q16 metres and radians, covariance Q48'),
            ('drogue_result', 'measure', 'all of a frame'),
            ('drogue_sighting', 'search', 'a region to measure'),
            ('drogue_track', 'track', 'filters and state, kept from frame to frame'),
            ('drogue_track_estimate', 'track', 'filtered pose and rates, Q16'))
    lines = ['| struct | from | what | bytes |', '| --- | --- | --- | --- |']
    return '\n'.join(lines + [f'| `{name}` | {stage} | {what} | {ram[name]} |' for name, stage, what in rows])


def check_budgets(library, ram, folder, deepest):
    lines = (ROOT / 'tests/embedded/budgets').read_text().splitlines()
    limits = dict(line.split() for line in lines if not line.startswith('#'))
    state = ram['drogue_workspace'] + ram['drogue_config'] + ram['drogue_result']
    stack = max(library.stack(k) for k in library.exported.values())
    text, data, *_ = tool('size', folder / 'images' / 'only_ellipse').splitlines()[1].split()
    measured = {'library_bytes': sum(library.stage_flash.values()),
                'tracker_bytes': library.links('drogue_track_frame'), 'frame_bytes': library.links('drogue_measure'),
                'stack_bytes': stack,
                'ram_256x256_bytes': ram['workspace_256x256'] + state + stack,
                'ram_160x120_bytes': ram['workspace_160x120'] + state + stack,
                'only_ellipse_bytes': int(text) + int(data)}
    for core in CORES:
        measured[f'stack_{core.replace("-", "_")}_bytes'] = max(max(deepest[(core, option)]) for option in OPTIONS)
    good = True
    for name, value in measured.items():
        within = value <= int(limits[name])
        good &= within
        print(f'{name:25} {value:8d}, budget {int(limits[name]):8d}  {"ok" if within else "EXCEEDED"}')
    painted = max(map(int, re.findall(r' stack=(\d+)', (folder / 'images' / 'measure.out').read_text())))
    bound = library.stack(library.exported['drogue_measure'])
    print(f'stack of drogue_measure: bound {bound}, with {HARNESS} more of the test itself {bound + HARNESS}; '
          f'painted in QEMU {painted}')
    if painted > bound + HARNESS:
        good = False
        print('sizes: the bound is wrong')
    for stage, static in library.stage_ram.items():
        if static:
            good = False
            print(f'sizes: {stage} has {static} bytes of static RAM')
    return good


def check_only_ellipse(library, folder):
    names = re.findall(r' [Tt] (drogue_\w+)', tool('nm', folder / 'images' / 'only_ellipse'))
    foreign = [n for n in names if library.exported.get(n, ('real',))[0] not in ('ellipse', 'moments', 'conic', 'eigen', 'real', 'fixed')]
    print(f'only_ellipse: {len(names)} functions of the library are linked')
    if foreign:
        print('sizes: an image that only fits ellipses holds ' + ' '.join(foreign))
    return bool(names) and not foreign


def workspace_table():
    """RAM by side of the region, the same on every target: what ./run ram prints."""
    program = ROOT / 'build/workspace_table'
    subprocess.run(['cc', '-std=c99', '-I', ROOT / 'include', ROOT / 'tests/bench/workspace_table.c', '-o', program], check=True)
    return subprocess.run([program], check=True, text=True, stdout=subprocess.PIPE).stdout.strip()


def place(texts):
    """Put the texts between their marks in their pages; answers what stood there, by name."""
    old = {}
    for name, page in PAGES.items():
        begin, end = f'<!-- {name}: ./run sizes --update -->', f'<!-- end of {name} -->'
        before, found, rest = page.read_text().partition(begin)
        old[name], found_end, after = rest.partition(end)
        if not found or not found_end:
            sys.exit(f'sizes: {page.name} has no place for the tables: {begin} ... {end}')
        if name in texts:
            page.write_text(f'{before}{begin}\n{texts[name]}\n{end}{after}')
    return old


def main():
    folder = pathlib.Path(sys.argv[1])
    update = '--update' in sys.argv[3:]
    library = Library(folder)
    ram = caller_ram(folder)
    deepest = stacks(pathlib.Path(sys.argv[2]))
    measured = {'sizes': tables(library, ram), 'stack': stack_table(deepest), 'ram': workspace_table(), 'data': data_table(ram)}
    old = place(measured if update else {})
    if update:
        print('sizes: written into docs/sizes.md and docs/architecture.md')
    good = check_budgets(library, ram, folder, deepest)
    good &= check_only_ellipse(library, folder)
    for name, compilers in (('sizes', [compiler()]), ('stack', [compiler(), compiler(RISCV)])):
        others = [c for c in compilers if c not in old[name]]
        if others and old[name].strip():
            print(f'sizes: "{name}" is not compared with docs/sizes.md, which is of another compiler than {others[0]}')
            del old[name]
    for name in old:
        if not update and old[name].strip() != measured[name].strip():
            good = False
            print(f'sizes: the table "{name}" in {PAGES[name].name} is out of date: ./run sizes --update')
    return 0 if good else 1


if __name__ == '__main__':
    sys.exit(main())
