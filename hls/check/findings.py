#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What in the LLVM IR of a top cannot be synthesised: a line 'FILE:LINE: RULE: what' each; check.sh makes the IR.

usage: findings.py LINKED.ll LOOPS.ll TRIPS NAME [SOURCE...]
       findings.py --needed LINKED.ll       prints the files of src/ that it is made of, without .c
  LINKED.ll  the top and all it calls, not optimised
  LOOPS.ll   the same with variables in registers and loops in normal form
  TRIPS      what scalar evolution prints about LOOPS.ll
  SOURCE     src/*.c listed for this top: must be those needed, where any is given
Ends with 'NAME: functions=N loops=N annotated=N findings=N'; exit status 1 where there is a finding.
"""
import re
import sys

from ir import NAME, Module, arguments

FLOATING = re.compile(r"(?<![%@.\w])(half|bfloat|float|double|x86_fp80|fp128|ppc_fp128)\b")
HEAP = re.compile(r"@(malloc|calloc|realloc|free|aligned_alloc|posix_memalign|alloca)$")
HARMLESS = re.compile(
    r"@(mem(cpy|set|move)|llvm\.(mem(cpy|set|move)|lifetime|dbg|abs|[us](max|min)|ct(lz|tz|pop)|bswap|bitreverse|"
    r"fsh[lr]|expect|assume|objectsize|stacksave|stackrestore|[us](add|sub|mul)\.(with\.overflow|sat))(\.|$))"
)
MOST_TRIPS = 1 << 20  # more is no bound but the width of the counter
BOUND = re.compile(r"\bbound:\s*\w")


class Findings:
    def __init__(self):
        self.lines = {}

    def add(self, place, rule, what):
        self.lines.setdefault((place[0], place[1], rule), what)  # once per line and rule

    def show(self):
        for (name, line, rule), what in sorted(self.lines.items()):
            print(f"{name}:{line}: {rule}: {what}")


def calls(module, findings):
    """Calls by name, function -> {callee: instruction}; what else is called is a finding."""
    graph = {name: {} for name in module.functions}
    for i in module.instructions():
        callee = i.callee()
        if callee is None:
            continue
        place = module.place(i)
        if callee == "asm":
            findings.add(place, "external", "inline assembly")
        elif callee[0] == "%":
            findings.add(place, "indirect-call", f"{i.function} calls through a pointer")
        elif callee[1:] in graph:
            graph[i.function].setdefault(callee[1:], i)
        elif HEAP.match(callee):
            findings.add(place, "dynamic-memory", f"{i.function} calls {callee[1:]}")
        elif not HARMLESS.match(callee):
            findings.add(place, "external", f"{i.function} calls {callee[1:]}, which has no source here")
    return graph


def recursion(module, graph, findings):
    """A finding at one call of each cycle."""
    for first in sorted(graph):
        path, seen = [(first, iter(sorted(graph[first])))], {first}
        while path:
            name = next(path[-1][1], None)
            if name is None:
                path.pop()
            elif name == first:
                cycle = [step for step, _ in path]
                if first == min(cycle):
                    what = " -> ".join(cycle + [first])
                    findings.add(module.place(graph[cycle[-1]][first]), "recursion", what)
                    break
            elif name not in seen and name > first:
                seen.add(name)
                path.append((name, iter(sorted(graph[name]))))


def data(module, findings):
    """Floating point, memory of variable size, data without a definition."""
    undefined = []
    for line in module.globals:
        name = re.match(r"(@\S+) = ", line)[1]
        if re.search(r" = (external|extern_weak)\b", line):
            undefined.append(name)
        node = (re.findall(r"!dbg (!\d+)", line) or [None])[-1]
        if node and FLOATING.search(re.sub(r'"(?:[^"\\]|\\.)*"', '""', line)):
            findings.add(module.location(module.field(node, "var")), "floating-point", f"{name[1:]} is floating point")
    for name, head in module.heads.items():
        if FLOATING.search(head):
            findings.add(module.location(module.functions[name]), "floating-point", f"argument or result of {name}")
    for i in module.instructions():
        if FLOATING.search(i.code) and " = alloca " not in i.code:
            findings.add(module.place(i), "floating-point", i.function)
        if re.search(r" = alloca .*, i\d+ %", i.code):
            findings.add(module.place(i), "dynamic-memory", f"array of variable length in {i.function}")
        for name in undefined:
            if re.search(rf"{re.escape(name)}(?![-\w.$])", i.code):
                findings.add(module.place(i), "external", f"{i.function} uses {name[1:]}, which has no source here")


def loops_of(path):
    """(function, header) -> is its trip count bounded? From what scalar evolution prints."""
    loops, function = {}, None
    for line in open(path):
        if begin := re.match(r'Determining loop execution counts for: @"?([^"\n]*)"?$', line):
            function = begin[1]
        elif loop := re.match(r'Loop %"?([^":]+)"?: (.*)', line):
            key, says = (function, loop[1]), loop[2]
            loops.setdefault(key, False)
            most = re.match(r"max backedge-taken count is (false|true|\d+)$", says)
            exact = re.match(r"(?:<multiple exits> )?backedge-taken count is ", says)
            loops[key] |= bool(exact or (most and int(most[1].isdigit() and most[1]) < MOST_TRIPS))
        elif re.match(r"\s+exit count for ", line) and "COULDNOTCOMPUTE" not in line:
            loops[key] = True
    return loops


def annotated(place):
    """Is there a comment 'bound: ...' on the line or on the line before?"""
    try:
        lines = open(place[0]).read().splitlines()
    except OSError:
        return False
    return any(BOUND.search(line) for line in lines[max(place[1] - 2, 0) : place[1]])


def loops(module, path, findings):
    """Counts of loops and of those whose bound a comment gives."""
    found, comments = loops_of(path), 0
    for (function, header), bounded in found.items():
        if not bounded:
            place = module.loop_place(function, header)
            comments += annotated(place)
            if not annotated(place):
                findings.add(place, "unbounded-loop", f"{function}: no bound to be seen and no comment 'bound: ...'")
    return len(found), comments


def ports(module, findings):
    """Arrays of a top are ports: Bambu follows them into inline functions alone, and not through memory."""

    def last_name(text):
        return (re.findall(rf"%{NAME}", text) or [None])[-1]

    followed = set()

    def follow(function, names):
        if (function, frozenset(names)) in followed:
            return  # recursion, which is a finding of its own
        followed.add((function, frozenset(names)))
        for i in (i for i in module.instructions() if i.function == function):
            made = re.match(rf"(%{NAME}) = (?:getelementptr|bitcast|phi|select|freeze)\b(.*)", i.code)
            stored = re.match(rf"store \S+ (%{NAME}),", i.code)
            callee = i.callee()
            if made and names & set(re.findall(rf"%{NAME}", made[2])):
                names.add(made[1])
            elif stored and stored[1] in names:
                findings.add(module.place(i), "port", f"{function} keeps a port's address in memory")
            elif callee and callee[1:] in module.functions:
                own = [last_name(a) for a in arguments(module.heads[callee[1:]])]
                given = {own[k] for k, a in enumerate(arguments(i.code)) if last_name(a) in names}
                if given and module.inlined(callee[1:]):
                    follow(callee[1:], given)
                elif given:
                    findings.add(module.place(i), "port", f"{callee[1:]} is given a port and not inline")

    for name, head in module.heads.items():
        if not re.match(r"define (\w+ )*internal ", head):
            follow(name, {last_name(a) for a in arguments(head) if "*" in a or re.match(r" *ptr ", a)})


def layouts(module, findings):
    """Bambu takes a struct whose scalars are all of one size for an array of what its first member is an array of, and
    gives it so many whole elements of memory: what is left over is lost."""

    def scalars(text):
        """Bits of each scalar in a type; an address has 32."""
        if text in module.types:
            return [bits for member in module.types[text] for bits in scalars(member)]
        if array := re.match(r"\[(\d+) x (.*)\]$", text):
            return int(array[1]) * scalars(array[2])
        return [max(8, int(text[1:]))] if re.match(r"i\d+$", text) else [32]

    def element(text):
        if text in module.types:
            return element(module.types[text][0])
        array = re.match(r"\[\d+ x (.*)\]$", text)
        return (element if array[1].startswith("[") else scalars)(array[1]) if array else scalars(text)

    for name, members in module.types.items():
        all_bits = scalars(name) if members else []
        if len(set(all_bits)) == 1 and len(all_bits) % len(element(name)) != 0:
            held = len(all_bits) - len(all_bits) % len(element(name))
            what = f"Bambu keeps {held} of the {len(all_bits)} words of {name[1:].removeprefix('struct.')}"
            findings.add(module.type_place(name), "layout", what)


def needed(module):
    """Files of src/ whose functions and tables the top is made of."""
    files = {module.location(node)[0] for node in module.functions.values() if node}
    for line in module.globals:
        for node in re.findall(r"!dbg (!\d+)", line):
            files.add(module.location(module.field(node, "var"))[0])
    return {file for file in files if re.match(r"src/(\w+/)?\w+\.c$", file)}


def sources(module, listed, name, findings):
    for file in sorted(set(listed) - needed(module)):
        findings.add(("hls/tops.txt", 0), "sources", f"{name}: {file} is listed but not needed")


def main():
    if sys.argv[1] == "--needed":
        print(*sorted(file[4:-2] for file in needed(Module(sys.argv[2]))))
        return 0
    linked, normal, trips, name, *listed = sys.argv[1:]
    module, findings = Module(linked), Findings()
    recursion(module, calls(module, findings), findings)
    data(module, findings)
    module_normal = Module(normal)
    count, comments = loops(module_normal, trips, findings)
    ports(module_normal, findings)
    layouts(module, findings)
    sources(module, listed, name, findings)
    findings.show()
    number = len(findings.lines)
    print(f"{name}: functions={len(module.functions)} loops={count} annotated={comments} findings={number}")
    return number > 0 or not module.functions


sys.exit(main())
