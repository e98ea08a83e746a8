# SPDX-License-Identifier: Apache-2.0
"""A pure C function as Verilog of several clocks: what verilog.py made of it, cut into stages.

usage: verilog.py IR FUNCTION asked=in out=out | stages.py MODULE NANOSECONDS

The module's input is the struct 'asked', whose words must stay as they are until it is done, so that a value used in a later
stage than its own needs one register, not one a stage. A stage takes as many operations one after another as fit the
nanoseconds by an estimate. 'step' counts clocks from 0 with the input there; in the clock of 'done' the struct 'out' is
right. A product takes two stages, to one of a few multipliers, which others have in other stages, and through it, and stays in
a register. One with a wide factor is the sum of products of the factors' halves, which have registers: the sum is made in the
third stage, in whose clock alone it is right, and so is what is made of it there.
"""
import re
import sys

MULTIPLIERS = 4  # of a kind in a module: neither, one or both factors wider than NARROW bits
NARROW, WIDE = 18, 33
CHOICE = 4.0  # nanoseconds of a multiplier's choice of a factor
HALF = 17  # bits of a wide factor's lower half, without a sign
SUM = 7.0  # nanoseconds of the halves' products


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
    if re.search(r" [!=]= ", expression):
        return 1.2 + 0.02 * bits  # a tree
    if re.search(r" [-+] |-\w|<<", expression) or re.search(r" [<>]=? ", expression):
        return 2.2 + 0.06 * max(bits, 32)
    return 1.0 + 0.4 * expression.count(" : ") + 0.2 * expression.count("|")


def factors(expression, extended, width, low):
    """(what, bits, its wire) of both factors of a product, before they were extended, the narrower one first; or None."""
    product = re.fullmatch(r"(\w+) \* (\w+)", expression)
    found = []
    for p in product.groups() if product else ():
        signed, v = extended.get(p, (True, p))
        if low.get(p, width[p]) < min(width[p], WIDE):
            found.append((f"$signed({{1'd0, {p}[{low[p] - 1}:0]}})", low[p] + 1, p))
            continue
        found.append((f"$signed({v})" if signed else f"$signed({{1'd0, {v}}})", width[v] + (not signed), v))
    return sorted(found, key=lambda f: f[1]) if found and all(bits <= WIDE for _, bits, _ in found) else None


def sizes_of(kind):
    return (WIDE if kind == 2 else NARROW, WIDE if kind else NARROW)


def sum_of(terms, kind):
    """The product of products of halves; the lowest of them has no sign, and the highest begins where it ends."""
    part = [name for name, *_ in terms]
    if kind == 1:
        return f"({part[1]} <<< {HALF}) + {part[0]}"
    return f"$signed({{{part[3]}[{2 * (WIDE - HALF) - 1}:0], {part[0]}[{2 * HALF - 1}:0]}}) + (({part[1]} + {part[2]}) <<< {HALF})"


def main():
    module, period = sys.argv[1], float(sys.argv[2])
    text = sys.stdin.read()
    lines = re.findall(r"^    wire (?:\[(\d+):0\] )?(\w+) = (.*);$", text, re.M)
    given = {u: int(n) for u, n in re.findall(r"^    // (\w+): (\d+) bits$", text, re.M)}
    width, made, stage, time, extended = dict(given), [], {u: 0 for u in given}, {u: 0.0 for u in given}, {}
    kept, held, low, last, pools = {}, set(), {}, 0, {}
    summed = {}  # a wide product, and what is made of it in its stage -> the step in which it is right
    for top, name, expression in lines:
        bits = width[name] = int(top or 0) + 1
        extension = re.fullmatch(r"\{\{(\d+)\{(?:(\w+)\[\d+\]|1'd0)\}\}, (\w+)\}", expression)
        if extension:
            extended[name] = (bool(extension[2]), extension[3])
        constant = re.fullmatch(r"(\w+) (&|\^|>>) \d+'d(\d+)", expression)
        if constant:  # bits that are not 0
            n, c = low.get(constant[1], width[constant[1]]), int(constant[3])
            low[name] = {"&": min(n, c.bit_length()), "^": max(n, c.bit_length()), ">>": max(1, n - c)}[constant[2]]
        power = re.fullmatch(r"(\w+) < \d+'d(\d+)", expression)
        if power and 1 < int(power[2]) < 1 << width[power[1]] and int(power[2]) & (int(power[2]) - 1) == 0:
            n = int(power[2]).bit_length() - 1  # a tree, where yosys makes a chain of carries of it
            expression = f"{power[1]}[{width[power[1]] - 1}:{n}] == {width[power[1]] - n}'d0"
        shift = re.fullmatch(r"(.* (?:<<|>>|>>>)) ([a-z]\w*)", expression)
        if shift and width[shift[2]] > 6:  # by more than there are bits, LLVM's result is anything
            expression = f"{shift[1]} {shift[2]}[5:0]"
        product = factors(expression, extended, width, low)
        if product:
            expression = f"{product[0][0]} * {product[1][0]}"
        used = [u for u in dict.fromkeys(re.findall(r"(?<!['\w])[a-z]\w*", expression)) if u != "signed"]
        at = max((stage[u] for u in used), default=0)
        if " / " in expression:
            sys.exit(f"stages.py: no divider for {expression}")
        before = max((time[u] for u in used if stage[u] == at), default=0.0)
        own = CHOICE if product else delay(expression, max([bits] + [width[u] for u in used]))
        if before > 0 and (before + own > period or product and any(u in summed and stage[u] == at for u in used)):
            at, before = at + 1, 0.0
        if product:
            kind = sum(n > NARROW for _, n, _ in product)
            while len(pools.setdefault(kind, {}).setdefault(at, [])) == MULTIPLIERS:
                at += 1
        if name.startswith("out_") and any(u in summed for u in used):
            at = max(at, last)
        for u in used:
            if stage[u] < at and u not in given and u not in held:
                kept[u] = None
                expression = re.sub(rf"\b{u}\b", f"{u}_q", expression)
        if product and kind:
            made.append(f"    wire [{bits - 1}:0] {name} = product_{kind}_{len(pools[kind][at])};")
            pools[kind][at].append(expression.split(" * "))
            summed[name] = at + 2
            at, before, own = at + 2, 0.0, SUM
        elif product:
            made.append(f"    reg [{bits - 1}:0] {name};\n    always @(posedge clock) if (step == 8'd{at + 1}) "
                        f"{name} <= product_{kind}_{len(pools[kind][at])};")
            pools[kind][at].append(expression.split(" * "))
            held.add(name)
            at, before, own = at + 2, 0.0, 0.0
        else:
            if any(u in summed and stage[u] == at for u in used):
                summed[name] = at
            what = f"assign out[{name[4:]} +: {bits}]" if name.startswith("out_") else f"wire [{bits - 1}:0] {name}"
            made.append(f"    {what} = {expression};")
        stage[name], time[name], last = at, before + own, max(last, at)
    size = {port: max(int(u[len(port) + 1 :]) + n for u, n in width.items() if u.startswith(port + "_"))
            for port in ("asked", "out")}
    print(f"// Made from C by hls/rtl/verilog.py and stages.py: {last + 1} clocks.")
    print(f"module {module} (input wire clock, input wire [7:0] step, output wire done,")
    print(f"    input wire [{size['asked'] - 1}:0] asked, output wire [{size['out'] - 1}:0] out);")
    print(f"    assign done = step == 8'd{last};")
    print("\n".join(f"    wire [{n - 1}:0] {u} = asked[{u[6:]} +: {n}];" for u, n in given.items()))
    print("\n".join(f"    reg [{width[n] - 1}:0] {n}_q;" for n in kept))
    for kind, stages in pools.items():
        for k in range(max(len(products) for products in stages.values())):
            print(f"    wire signed [{sum(sizes_of(kind)) - 1}:0] product_{kind}_{k};")
    print("\n".join(made))
    for kind, stages in pools.items():
        for k in range(max(len(products) for products in stages.values())):
            for side, n in enumerate(sizes_of(kind)):
                *first, final = [(at, products[k][side]) for at, products in sorted(stages.items()) if len(products) > k]
                choice = "".join(f"step == 8'd{at} ? {factor} : " for at, factor in first) + final[1]
                print(f"    reg signed [{n - 1}:0] factor_{kind}_{k}_{side};")
                print(f"    always @(posedge clock) factor_{kind}_{k}_{side} <= {choice};")
            halves = [[f"factor_{kind}_{k}_{side}"] if n == NARROW else
                      [f"$signed({{1'd0, factor_{kind}_{k}_{side}[{HALF - 1}:0]}})", f"$signed(factor_{kind}_{k}_{side}[{n - 1}:{HALF}])"]
                      for side, n in enumerate(sizes_of(kind))]
            terms = [(f"part_{kind}_{k}_{i}{j}", a, b) for i, a in enumerate(halves[0]) for j, b in enumerate(halves[1])]
            if kind == 0:
                print(f"    assign product_0_{k} = factor_0_{k}_0 * factor_0_{k}_1;")
                continue
            for part, a, b in terms:
                print(f"    reg signed [{2 * NARROW - 1}:0] {part};\n    always @(posedge clock) {part} <= {a} * {b};")
            print(f"    assign product_{kind}_{k} = {sum_of(terms, kind)};")
    print("    always @(posedge clock) begin")
    print("\n".join(f"        {f'if (step == 8{chr(39)}d{summed[n]}) ' if n in summed else ''}{n}_q <= {n};" for n in kept))
    print("    end\nendmodule")


main()
