# SPDX-License-Identifier: Apache-2.0
"""A pure C function as Verilog: one clock of a block, its combinational part and its registers.

usage: verilog.py IR FUNCTION NAME=in|out|NAME...

The function's LLVM IR has everything inlined and no loops left; its arguments are pointers to structs, named in their order,
of which 'in' are only read and the others written once at its end. A member becomes the wire NAME_BIT, where BIT is the place
of its lowest bit in the struct; those of an 'in' are for the surroundings to declare. An argument named after another one
is what its members, registers, become at the clock: surroundings give 'clock', 'reset' and 'enable'. A block of the control
flow has a condition under which it is reached; where ways join, these choose the value. What cannot be expressed so is an
error: nothing is guessed.

A register has as many bits as the values that can reach it from 0 on: those above them would be flip-flops that yosys keeps,
since it does not see that they are only ever handed on. That is found by assuming none, and more where a value has more.
"""
import re
import sys

NAME = r'[%@](?:[-\w.$]+|"[^"]*")'
INTRINSICS = {
    "umin": "(({a}) < ({b}) ? ({a}) : ({b}))",
    "umax": "(({a}) > ({b}) ? ({a}) : ({b}))",
    "smin": "($signed({a}) < $signed({b}) ? ({a}) : ({b}))",
    "smax": "($signed({a}) > $signed({b}) ? ({a}) : ({b}))",
}
OPERATORS = {"add": "+", "sub": "-", "mul": "*", "udiv": "/", "and": "&", "or": "|", "xor": "^", "shl": "<<", "lshr": ">>"}
COMPARISONS = {"eq": "==", "ne": "!=", "gt": ">", "ge": ">=", "lt": "<", "le": "<="}


def fail(line):
    sys.exit(f"verilog.py: not understood: {line}")


def split(text):
    """Parts between the commas outside of brackets."""
    parts, depth, part = [], 0, ""
    for c in text:
        depth += c in "([{<"
        depth -= c in ")]}>"
        if c == "," and depth == 0:
            parts.append(part.strip())
            part = ""
        else:
            part += c
    return parts + [part.strip()]


class Types:
    """Sizes and places of members, as the ABI of the IR's target lays them out."""

    def __init__(self, text):
        self.structs = dict(re.findall(r"^(%[\w.]+) = type \{ (.*) \}$", text, re.M))

    def size(self, t):
        """(bytes, alignment)"""
        if re.fullmatch(r"i\d+", t):
            n = int(t[1:]) // 8
            return n, n
        array = re.fullmatch(r"\[(\d+) x (.*)\]", t)
        if array:
            n, align = self.size(array[2])
            return int(array[1]) * n, align
        at = align = 0
        for member in split(self.structs[t]):
            n, one = self.size(member)
            at = -(-at // one) * one + n
            align = max(align, one)
        return -(-at // align) * align, align

    def members(self, t, at=0):
        """(first bit, bits) of every number in a T."""
        array = re.fullmatch(r"\[(\d+) x (.*)\]", t)
        if re.fullmatch(r"i\d+", t):
            yield at, int(t[1:])
        elif array:
            for i in range(int(array[1])):
                yield from self.members(array[2], at + 8 * i * self.size(array[2])[0])
        else:
            for i, member in enumerate(split(self.structs[t])):
                yield from self.members(member, at + 8 * self.place(t, [0, i]))

    def place(self, t, indices):
        """Bytes from the beginning of a T to what the indices name, the first of them among several T."""
        at = indices[0] * self.size(t)[0]
        for i in indices[1:]:
            array = re.fullmatch(r"\[\d+ x (.*)\]", t)
            if array:
                t = array[1]
                at += i * self.size(t)[0]
                continue
            begin = 0
            for k, member in enumerate(split(self.structs[t])):
                n, align = self.size(member)
                begin = -(-begin // align) * align
                if k == i:
                    break
                begin += n
            at, t = at + begin, member
        return at


class Function:
    def __init__(self, text, name, ports, kept):
        self.kept = kept  # lowest bit of a register -> bits that it can need
        self.most = {}  # value -> bits that it can need
        self.types = Types(text)
        head = re.search(rf"^define [^@]*@{name}\((.*)\)[^)]*\{{$", text, re.M)
        body = text[head.end() : text.index("\n}", head.end())]
        if len(re.findall(r"^define ", text, re.M)) != 1:
            sys.exit("verilog.py: not everything was inlined")
        self.ports = ports
        self.pointers = {}  # value -> (port, bytes); of an alloca: (None, 0)
        self.members = []
        for k, argument in enumerate(split(head[1])):
            self.pointers[argument.split()[-1]] = (k, 0)
            self.members.append(dict(self.types.members(re.match(r"[%\w.]+", argument)[0])))
        self.width = {}
        self.names = {}
        self.lines = []
        self.stores = {}  # port -> [(bit, bits, value)]
        self.blocks, self.order = self.parse(body, len(self.members))
        self.edges = {}  # (from, to) -> condition
        self.reached = {}

    @staticmethod
    def parse(body, arguments):
        name, blocks, order = f"%{arguments}", {}, []
        joined = re.sub(r"\[\n(.*?)\n  \]", lambda m: "[" + m[1].replace("\n", " ") + "]", body, flags=re.S)
        for line in joined.splitlines():
            label = re.match(r'([-\w.$]+|"[^"]*"):', line)
            if label:
                name = "%" + label[1]
            elif line.startswith("  "):
                if name not in blocks:
                    blocks[name] = []
                    order.append(name)
                blocks[name].append(re.sub(r", ![\w.]+ !\d+|, !\w.*$", "", line.strip()))
        return blocks, order

    def value(self, t, v):
        bits = int(t[1:])
        if v in ("undef", "poison", "false"):
            return f"{bits}'d0"
        if v == "true":
            return "1'd1"
        if re.fullmatch(r"-?\d+", v):
            return f"{bits}'d{int(v) % (1 << bits)}"
        if v not in self.names:
            fail(f"{v} is used before it is known")
        return self.names[v]

    def need(self, t, v):
        """Bits that a value can need."""
        if v in ("undef", "poison", "false"):
            return 0
        if v == "true":
            return 1
        if re.fullmatch(r"-?\d+", v):
            return (int(v) % (1 << int(t[1:]))).bit_length()
        return self.most[v]

    def wire(self, v, bits, expression, most=None):
        self.most[v] = bits if most is None else min(bits, most)
        self.names[v] = f"v{len(self.names)}"
        self.width[v] = bits
        self.lines.append(f"    wire [{bits - 1}:0] {self.names[v]} = {expression};")

    def sorted_blocks(self):
        """So that a block comes after all that lead to it."""
        after = {b: re.findall(r"label (%(?:[-\w.$]+|\"[^\"]*\"))", self.blocks[b][-1]) for b in self.order}
        seen, order = {}, []
        stack = [(self.order[0], iter(after[self.order[0]]))]
        seen[self.order[0]] = "open"
        while stack:
            block, rest = stack[-1]
            for to in rest:
                if seen.get(to) == "open":
                    sys.exit("verilog.py: there is a loop left")
                if to not in seen:
                    seen[to] = "open"
                    stack.append((to, iter(after[to])))
                    break
            else:
                seen[block] = "done"
                order.append(block)
                stack.pop()
        return order[::-1]

    def edge(self, block, to, condition):
        reach = self.reached[block]
        new = condition if reach == "1'd1" else reach if condition == "1'd1" else f"({reach} & {condition})"
        self.edges[block, to] = f"({self.edges[block, to]} | {new})" if (block, to) in self.edges else new

    def leave(self, block, code):
        """Conditions of the ways out of a block."""
        if code.startswith("ret"):
            self.last = block
        elif code.startswith("switch"):
            found = re.match(rf"switch (i\d+) ([^,]+), label ({NAME}) \[(.*)\]", code)
            on, none = self.value(found[1], found[2]), []
            for v, to in re.findall(rf"i\d+ (-?\d+), label ({NAME})", found[4]):
                same = f"({on} == {self.value(found[1], v)})"
                none.append(same)
                self.edge(block, to, same)
            self.edge(block, found[3], f"(~({' | '.join(none)}))")
        elif code.startswith("br label"):
            self.edge(block, re.match(rf"br label ({NAME})", code)[1], "1'd1")
        else:
            found = re.match(rf"br i1 ([^,]+), label ({NAME}), label ({NAME})", code) or fail(code)
            on = self.value("i1", found[1])
            self.edge(block, found[2], on)
            self.edge(block, found[3], f"(~{on})")

    def phi(self, block, v, code):
        t, rest = re.match(r"phi (\S+) (.*)", code).groups()
        ways = re.findall(rf"\[ ([^,]+), ({NAME}) \]", rest)
        values = {}  # value -> conditions of the ways that bring it
        for of, via in ways:
            values.setdefault(self.value(t, of), []).append(self.edges[via, block])
        else_value = max(values, key=lambda value: len(values[value]))  # what most ways bring asks for no condition
        expression = else_value
        for value, conditions in values.items():
            if value != else_value:
                expression = f"({' | '.join(conditions)}) ? {value} : {expression}"
        self.wire(v, int(t[1:]), expression, max(self.need(t, of) for of, _ in ways))

    def pointer(self, text):
        """(port, bytes) of an address."""
        return self.pointers.get(text.split()[-1]) or fail(text)

    def address(self, v, code):
        inside = split(re.sub(r"^getelementptr (inbounds )?", "", code))
        indices = [i.split()[-1] for i in inside[2:]]
        port, at = self.pointer(inside[1])
        if port is not None:
            if not all(re.fullmatch(r"\d+", i) for i in indices):
                fail(code)
            at += self.types.place(inside[0], [int(i) for i in indices])
        self.pointers[v] = (port, at)

    def load(self, port, at, bits):
        """One member, a part of one, or several whole ones with what lies between them, which is 0."""
        name, found, end = self.ports[port][0], [], at + bits
        for first, size in sorted(self.members[port].items(), reverse=True):
            if first <= at and at + bits <= first + size:
                return f"{name}_{first}" + ("" if bits == size else f"[{at - first} +: {bits}]")
            if at <= first and first + size <= end:
                found += [f"{end - first - size}'d0"] * (end > first + size) + [f"{name}_{first}"]
                end = first
            elif first < end and at < first + size:
                return None
        return "{" + ", ".join(found + [f"{end - at}'d0"] * (end > at)) + "}"

    def store(self, block, code):
        t, v, where = re.match(r"store (\S+) ([^,]+), (.*?)(?:, align \d+)?$", code).groups()
        port, at = self.pointer(where)
        if port is None or self.ports[port][1] == "in":
            fail(code)
        self.stores.setdefault(port, []).append((block, 8 * at, int(t[1:]), self.value(t, v)))
        if self.ports[port][1] != "out":
            for bit, bits in self.members[port].items():
                if 8 * at <= bit < 8 * at + int(t[1:]):
                    below = max(0, min(bits, self.need(t, v) - (bit - 8 * at)))
                    self.kept[bit] = max(self.kept.get(bit, 0), below)

    def call(self, v, code):
        found = re.search(r"@llvm\.(\w+)[\w.]*\((.*)\)", code) or fail(code)
        operands = split(found[2])
        if found[1] in ("lifetime", "assume"):
            return
        if found[1] == "memcpy":  # of registers that nobody reads: they stay in a variable
            names = [re.search(rf"({NAME})(?:, | to |$)|({NAME})", o) for o in operands[:2]]
            if not any(self.pointers.get(o.split()[-1], (0,))[0] is None for o in operands[:2]):
                fail(code)
            return
        bits = int(re.search(r"(i\d+) @", code)[1][1:])
        first = self.value(f"i{bits}", operands[0].split()[-1])
        if found[1] == "abs":
            self.wire(v, bits, f"{first}[{bits - 1}] ? -{first} : {first}")
        elif found[1] == "fshl":  # the upper half of two words shifted together
            second, places = self.value(f"i{bits}", operands[1].split()[-1]), operands[2].split()[-1]
            if places.isdigit():
                self.wire(v, bits, f"({first} << {places}) | ({second} >> {bits - int(places)})")
            else:
                self.wire(v + ".both", 2 * bits, f"{{{first}, {second}}} << {self.value(f'i{bits}', places)}")
                self.wire(v, bits, f"{self.names[v + '.both']}[{2 * bits - 1}:{bits}]")
        elif found[1] in INTRINSICS:
            second = self.value(f"i{bits}", operands[1].split()[-1])
            self.wire(v, bits, INTRINSICS[found[1]].format(a=first, b=second))
        else:
            fail(code)

    @staticmethod
    def reach(operation, bits, by, a, b):
        """Bits that a result can need, from those of its operands; 'by' is the text of the second one."""
        places = int(by) if re.fullmatch(r"\d+", by) else None
        if operation == "and":
            return min(a, b)
        if operation in ("or", "xor"):
            return max(a, b)
        if operation == "add":
            return max(a, b) + 1
        if operation == "mul":
            return a + b
        if operation == "shl" and places is not None:
            return a + places
        if operation == "lshr" or operation == "ashr" and a < bits:
            return max(0, a - (places or 0))
        return bits

    def instruction(self, block, line):
        assigned = re.match(rf"({NAME}) = (.*)", line)
        v, code = assigned.groups() if assigned else (None, line)
        code = re.sub(r"\b(nuw|nsw|exact) ", "", code)
        operation = code.split()[0]
        if operation == "phi":
            self.phi(block, v, code)
        elif operation == "alloca":
            self.pointers[v] = (None, 0)
        elif operation == "getelementptr":
            self.address(v, code)
        elif operation == "bitcast":
            self.pointers[v] = self.pointer(re.match(r"bitcast .* (\S+) to ", code)[1])
        elif operation == "load":
            t, where = re.match(r"load (\S+), (.*?)(?:, align \d+)?$", code).groups()
            port, at = self.pointer(where)
            if port is None or self.ports[port][1] != "in":
                fail(line)
            registers = self.ports[port][0] == "now" and self.members[port].get(8 * at) == int(t[1:])
            most = min(self.kept.get(8 * at, 0), int(t[1:])) if registers else None
            self.wire(v, int(t[1:]), self.load(port, 8 * at, int(t[1:])) or fail(line), most)
        elif operation == "store":
            self.store(block, code)
        elif operation in ("call", "tail"):
            self.call(v, code)
        elif operation == "select":
            parts = [p.split() for p in split(code[7:])]
            most = max(self.need(*p[:2]) for p in parts[1:])
            self.wire(v, int(parts[1][0][1:]), "{} ? {} : {}".format(*(self.value(*p[:2]) for p in parts)), most)
        elif operation == "icmp":
            how, t, a, b = re.match(r"icmp (\w+) (\S+) ([^,]+), (.+)", code).groups()
            sign = "$signed({})" if how[0] == "s" else "{}"
            operator = COMPARISONS[how if how in ("eq", "ne") else how[1:]]
            self.wire(v, 1, f"{sign.format(self.value(t, a))} {operator} {sign.format(self.value(t, b))}")
        elif operation in ("zext", "sext", "trunc"):
            t, a, to = re.match(r"\w+ (\S+) (\S+) to (\S+)", code).groups()
            of, bits, more = self.value(t, a), int(to[1:]), int(to[1:]) - int(t[1:])
            most = self.need(t, a)
            signed = operation == "sext" and most == int(t[1:])
            top = f"{of}[{int(t[1:]) - 1}]" if signed else "1'd0"
            expression = f"{of}[{bits - 1}:0]" if operation == "trunc" else f"{{{{{more}{{{top}}}}}, {of}}}"
            self.wire(v, bits, expression, None if signed else most)
        elif operation in OPERATORS or operation == "ashr":
            t, a, b = re.match(r"\w+ (\S+) ([^,]+), (.+)", code).groups()
            most = self.reach(operation, int(t[1:]), b, self.need(t, a), self.need(t, b))
            one = operation == "mul" and self.need(t, a) <= 1
            places = [i for i in range(64) if operation == "mul" and re.fullmatch(r"\d+", b) and int(b) >> i & 1]
            a, b = self.value(t, a), self.value(t, b)
            if one:  # no multiplier for a bit, nor for few places
                return self.wire(v, int(t[1:]), f"{a}[0] ? {b} : {t[1:]}'d0", most)
            if 1 <= len(places) <= 3:
                return self.wire(v, int(t[1:]), " + ".join(f"({a} << {i})" for i in places), most)
            expression = f"$signed({a}) >>> {b}" if operation == "ashr" else f"{a} {OPERATORS[operation]} {b}"
            self.wire(v, int(t[1:]), expression, most)
        else:
            fail(line)

    def body(self):
        for block in self.sorted_blocks():
            ways = [e for (_, to), e in self.edges.items() if to == block]
            if block == self.order[0]:
                self.reached[block] = "1'd1"
            else:
                reach = f"r{len(self.reached)}"
                self.lines.append(f"    wire {reach} = {' | '.join(ways)};")
                self.reached[block] = reach
            for line in self.blocks[block][:-1]:
                self.instruction(block, line)
            self.leave(block, self.blocks[block][-1])
        for k, (port, way) in enumerate(self.ports):
            if way == "in":
                yield from (f"    // {port}_{bit}: {bits} bits" for bit, bits in self.members[k].items())
            elif way != "out":  # registers
                for bit, bits in self.members[k].items():
                    yield from self.register(way, bit, bits)
        yield from self.lines
        for k, (port, way) in enumerate(self.ports):
            if way != "in":
                yield from self.assigned(port, way, self.members[k], self.stores[k])

    def register(self, way, bit, bits):
        most = min(self.kept.get(bit, 0), bits)
        if most == 0:
            yield f"    wire [{bits - 1}:0] {way}_{bit} = {bits}'d0;"
        elif most == bits:
            yield f"    reg [{bits - 1}:0] {way}_{bit} = {bits}'d0;"
        else:
            yield f"    reg [{most - 1}:0] kept_{bit} = {most}'d0;"
            yield f"    wire [{bits - 1}:0] {way}_{bit} = {{{bits - most}'d0, kept_{bit}}};"

    def assigned(self, port, way, members, stores):
        """Each member once; one that no store names is 0."""
        values = {}
        for block, at, bits, v in stores:
            if block != self.last:
                sys.exit(f"verilog.py: {port} is not written just at the end")
            for bit in sorted(b for b in members if b < at + bits and at < b + members[b]):
                if bit in values or bit < at or bit + members[bit] > at + bits:
                    sys.exit(f"verilog.py: bit {bit} of {port} is not written once")
                values[bit] = v if bits == members[bit] or "'" in v else f"{v}[{bit - at} +: {members[bit]}]"
                if "'" in v and bits != members[bit]:  # a constant
                    values[bit] = f"{members[bit]}'d{(int(v.split('d')[1]) >> (bit - at)) % (1 << members[bit])}"
        for bit, bits in members.items():
            yield f"    wire [{bits - 1}:0] {port}_{bit} = {values.get(bit, f'{bits}' + chr(39) + 'd0')};"
        if way != "out":
            kept = {bit: (min(self.kept.get(bit, 0), bits), bits) for bit, bits in members.items() if self.kept.get(bit, 0)}
            name = {bit: f"{way if most == bits else 'kept'}_{bit}" for bit, (most, bits) in kept.items()}
            yield "    always @(posedge clock) if (reset) begin"
            yield from (f"        {name[bit]} <= {most}'d0;" for bit, (most, _) in kept.items())
            yield "    end else if (enable) begin"
            yield from (f"        {name[bit]} <= {port}_{bit}[{most - 1}:0];" for bit, (most, _) in kept.items())
            yield "    end"


def main():
    path, name, *ports = sys.argv[1:]
    kept, before, passes = {}, None, 0
    while kept != before:
        grown = {bit for bit in kept if before is not None and kept[bit] != before.get(bit, 0)}
        if passes > 16:  # it counts without end: all of it
            kept.update({bit: 64 for bit in grown})
        before = dict(kept)
        passes += 1
        lines = list(Function(open(path).read(), name, [p.split("=") for p in ports], kept).body())
    print("    // Made from C by hls/rtl/verilog.py.")
    for line in lines:
        print(line)


main()
