# SPDX-License-Identifier: Apache-2.0
"""Textual LLVM IR as far as the check needs it: functions, blocks, instructions, calls, debug locations."""
import re

NAME = r'(?:[-\w.$]+|"[^"]*")'
METADATA = re.compile(r"^(!\d+) = (?:distinct )?(.*)$", re.M)
DEFINE = re.compile(rf"^define .*?@({NAME})\(.*$")
LABEL = re.compile(rf"^({NAME}):")
CALLEE = re.compile(rf"([@%]{NAME})\(")
CAST = re.compile(rf"\b(?:bitcast|addrspacecast) \([^@]*(@{NAME}) to ")


def arguments(code):
    """What stands between the parentheses of a definition or a call, one by one."""
    parts, depth = [""], 0
    for c in code[re.search(rf"[@%]{NAME}\(", code).end() :]:
        depth += (c in "([{") - (c in ")]}")
        if depth < 0:
            break
        if c == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += c
    return parts


def members(text):
    """What stands between the outer braces of a struct's type, one by one."""
    return arguments(f"@type({text[1:-1]})") if text[1:-1].strip() else []


def unquote(name):
    return name.strip('"')


class Instruction:
    def __init__(self, function, block, text):
        self.function, self.block = function, block
        self.dbg = (re.findall(r"!dbg (!\d+)", text) or [None])[-1]
        self.loop = (re.findall(r"!llvm\.loop (!\d+)", text) or [None])[-1]
        code = re.sub(r'c?"(?:[^"\\]|\\.)*"(?!\()', '""', text)  # strings, but no quoted callee
        self.code = re.sub(r",? !.*$", "", code).strip()

    def callee(self):
        """'@name' of the function called, '%name' of a pointer, 'asm', None where nothing is called."""
        call = re.match(rf"(?:%{NAME} = )?(?:(?:must|no)?tail )?(?:call|invoke|callbr) (.*)", self.code)
        if not call:
            return None
        if re.search(r"\basm\b", call[1]):
            return "asm"
        found = CALLEE.search(call[1])
        cast = CAST.search(call[1])
        if cast and (not found or cast.start() < found.start()):
            return "@" + unquote(cast[1][1:])
        return found[1][0] + unquote(found[1][1:]) if found else "%?"


class Module:
    def __init__(self, path):
        text = open(path).read()
        self.metadata = dict(METADATA.findall(text))
        types = re.findall(rf"^(%{NAME}) = type <?(\{{.*\}})>?$", text, re.M)
        self.types = {name: [part.strip() for part in members(body)] for name, body in types}
        self.functions = {}  # name -> subprogram's metadata
        self.heads = {}  # name -> its line 'define'
        self.attributes = dict(re.findall(r"^attributes (#\d+) = \{(.*)\}$", text, re.M))
        self.blocks = {}  # (function, block) -> instructions
        self.globals = [line for line in text.splitlines() if re.match(rf"@{NAME} = ", line)]
        function = block = None
        for line in text.splitlines():
            define = DEFINE.match(line)
            label = LABEL.match(line)
            if define:
                function, block = unquote(define[1]), None
                self.functions[function] = (re.findall(r"!dbg (!\d+)", line) or [None])[-1]
                self.heads[function] = line
            elif line == "}":
                function = None
            elif function and label:
                block = unquote(label[1])
            elif function and line.startswith("  "):
                instruction = Instruction(function, block, line)
                self.blocks.setdefault((function, block), []).append(instruction)

    def instructions(self):
        return [i for block in self.blocks.values() for i in block]

    def inlined(self, name):
        """Is a function marked 'inline'?"""
        return any("inlinehint" in self.attributes.get(a, "") for a in re.findall(r"#\d+", self.heads[name]))

    def field(self, node, name):
        found = re.search(rf'\b{name}: (!\d+|\d+|"[^"]*")', self.metadata.get(node, ""))
        return found[1].strip('"') if found else None

    def location(self, node):
        """(file, line) of a DILocation, DISubprogram or DIGlobalVariable."""
        line = int(self.field(node, "line") or 0)
        scope = node
        while scope and not self.field(scope, "file"):
            scope = self.field(scope, "scope")
        return (self.field(self.field(scope, "file"), "filename") if scope else "?", line)

    def place(self, instruction):
        """(file, line) of an instruction: its own, or its function's."""
        return self.location(instruction.dbg or self.functions[instruction.function])

    def type_place(self, name):
        """(file, line) of a struct."""
        tag = re.sub(r"^%struct\.|\.\d+$", "", name)
        for node, value in self.metadata.items():
            if value.startswith("!DICompositeType(") and self.field(node, "name") == tag:
                return self.location(node)
        return ("?", 0)

    def loop_place(self, function, header):
        """(file, line) where the loop of a header block starts: of the statement, where the compiler kept it."""
        for i in self.instructions():
            if i.function == function and i.loop and re.search(rf'label %"?{re.escape(header)}"?(?![-\w.$])', i.code):
                for node in re.findall(r"!\d+", self.metadata[i.loop])[1:2]:
                    if self.metadata.get(node, "").startswith("!DILocation"):
                        return self.location(node)
        return self.first_place(function, header)

    def first_place(self, function, block):
        """(file, line) of the first statement from a block on."""
        todo, seen = [block], set()
        while todo:
            block = todo.pop(0)
            seen.add(block)
            for i in self.blocks.get((function, block), []):
                if i.dbg and not re.search(r" phi |^br label", i.code) and self.field(i.dbg, "line") != "0":
                    return self.place(i)
                todo += [unquote(b) for b in re.findall(rf"label %({NAME})", i.code) if unquote(b) not in seen]
        return self.location(self.functions[function])
