# SPDX-License-Identifier: Apache-2.0
"""A pure C function as Verilog of several clocks: what verilog.py made of it, cut into stages.

usage: verilog.py IR FUNCTION asked=in out=out | stages.py MODULE NANOSECONDS

The module's input is the struct 'asked', whose words must stay as they are until it is done, so that a value used in a later
stage than its own needs one register, not one a stage. A stage takes as many operations one after another as fit the
nanoseconds by an estimate. 'step' counts clocks from 0 with the input there; in the clock of 'done' the struct 'out' is
right. A division is that of a divider which its step starts.
"""
import re
import sys

DIVISION = 17  # clocks of drogue_divider


def delay(expression, bits):
    """Nanoseconds, ECP5 of speed grade 6, routing included."""
    if re.fullmatch(r"[\w\[\]:{}', ]+", expression):
        return 0.0  # only wires
    if re.fullmatch(r"\S+ (<<|>>|>>>) \d+'d\d+", expression):
        return 0.0
    if " * " in expression:
        return 11.0
    if re.search(r" (<<|>>|>>>) [a-z]", expression):
        return 1.2 * max(1, (bits - 1).bit_length())
    power = re.fullmatch(r"\S+ < \d+'d(\d+)", expression)
    if power and int(power[1]) & (int(power[1]) - 1) == 0 or re.search(r" [!=]= ", expression):
        return 1.2 + 0.02 * bits  # a tree
    if re.search(r" [-+] |-\w|<<", expression) or re.search(r" [<>]=? ", expression):
        return 2.2 + 0.06 * max(bits, 32)
    return 1.0 + 0.4 * expression.count(" : ") + 0.2 * expression.count("|")


def main():
    module, period = sys.argv[1], float(sys.argv[2])
    text = sys.stdin.read()
    lines = re.findall(r"^    wire (?:\[(\d+):0\] )?(\w+) = (.*);$", text, re.M)
    bits_of = {u: int(n) for u, n in re.findall(r"^    // (\w+): (\d+) bits$", text, re.M)}
    width, made, stage, time, extended = {}, [], {}, {}, {}
    inputs, kept, last = [], {}, 0
    for top, name, expression in lines:
        bits = int(top or 0) + 1
        width[name] = bits
        extension = re.fullmatch(r"\{\{(\d+)\{(?:(\w+)\[\d+\]|1'd0)\}\}, (\w+)\}", expression)
        if extension:
            extended[name] = (bool(extension[2]), extension[3])
        product = re.fullmatch(r"(\w+) \* (\w+)", expression)
        if product and all(p in extended for p in product.groups()):  # of as few bits as there are
            of = (extended[p] for p in product.groups())
            expression = " * ".join(f"$signed({v})" if signed else f"$signed({{1'd0, {v}}})" for signed, v in of)
        shift = re.fullmatch(r"(.* (?:<<|>>|>>>)) ([a-z]\w*)", expression)
        if shift and width[shift[2]] > 6:  # by more than there are bits, LLVM's result is anything
            expression = f"{shift[1]} {shift[2]}[5:0]"
        used = [u for u in dict.fromkeys(re.findall(r"(?<!['\w])[a-z]\w*", expression)) if not u.startswith("signed")]
        for u in used:
            if u not in stage:
                inputs.append(u)
                stage[u], time[u] = 0, 0.0
        at = max((stage[u] for u in used), default=0)
        division = re.fullmatch(r"(\S+) / (\S+)", expression)
        if division:
            at += 1  # it begins with registers
        before = max((time[u] for u in used if stage[u] == at), default=0.0)
        own = delay(expression, max([bits] + [width.get(u, 0) for u in used]))
        if product:
            of = [extended.get(p, (0, p))[1] for p in product.groups()]
            if min(width.get(v, bits_of.get(v, 32)) for v in of) <= 16:
                own = 7.0  # a block or two
        if before > 0 and before + own > period:
            at, before = at + 1, 0.0
        for u in used:
            if stage[u] < at and u in width:
                kept[u] = None
                expression = re.sub(rf"\b{u}\b", f"{u}_q", expression)
        if division:
            a, b = re.fullmatch(r"(\S+) / (\S+)", expression).groups()
            made.append(f"    wire [{bits - 1}:0] {name};\n    drogue_divider of_{name} (.clock(clock), .start(step == 8'd{at}), "
                        f".dividend({a}), .divisor({b}), .quotient({name}));")
            at, before, own = at + DIVISION, 0.0, 0.0
        else:
            what = f"assign out[{name[4:]} +: {bits}]" if name.startswith("out_") else f"wire [{bits - 1}:0] {name}"
            made.append(f"    {what} = {expression};")
        stage[name], time[name], last = at, before + own, max(last, at)
    size = {port: max(int(u[len(port) + 1 :]) + n for u, n in {**bits_of, **width}.items() if u.startswith(port + "_"))
            for port in ("asked", "out")}
    print(f"// Made from C by hls/rtl/verilog.py and stages.py: {last + 1} clocks.")
    print(f"module {module} (input wire clock, input wire [7:0] step, output wire done,")
    print(f"    input wire [{size['asked'] - 1}:0] asked, output wire [{size['out'] - 1}:0] out);")
    print(f"    assign done = step == 8'd{last};")
    print("\n".join(f"    wire [{bits_of[u] - 1}:0] {u} = asked[{u[6:]} +: {bits_of[u]}];" for u in inputs))
    print("\n".join(f"    reg [{width[n] - 1}:0] {n}_q;" for n in kept))
    print("\n".join(made))
    print("    always @(posedge clock) begin")
    print("\n".join(f"        {n}_q <= {n};" for n in kept))
    print("    end\nendmodule")


main()
