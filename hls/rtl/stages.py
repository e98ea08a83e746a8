# SPDX-License-Identifier: Apache-2.0
"""A pure C function as Verilog of several clocks: what verilog.py made of it, cut into stages.

usage: verilog.py IR FUNCTION asked=in out=out | stages.py MODULE NANOSECONDS [EVERY FIXED LATE]

The module's input is the struct 'asked', whose words must stay as they are until it is done, so that a value used in a later
stage than its own needs one register, not one a stage. A stage takes as many operations one after another as fit the
nanoseconds by an estimate. 'step' counts clocks from 0 with the input there; in the clock of 'done' the struct 'out' is
right. A product takes two stages, to one of a few multipliers, which others have in other stages, and through it, and stays in
a register. One with a wide factor is the sum of products of the factors' halves, which have registers: the sum is made in the
third stage, in whose clock alone it is right, and so is what is made of it there.

With EVERY the next input may come as few clocks after the one before, at 'start', not at a step told: a value that is used later
than that is handed on through registers, and stages farther apart share no multiplier. 'more' is high where something is under
way in the next clock. The lowest
FIXED bits of the input are taken as they are, from stage LATE on: they stay, or are the output of the one before.
"""
import re
import sys

MULTIPLIERS = 4  # of a kind in a module: neither, one or both factors wider than NARROW bits
NARROW, WIDE = 18, 33
CHOICE = 4.0  # nanoseconds of a multiplier's choice of a factor
HALF = 17  # bits of a wide factor's lower half, without a sign
SUM = 7.0  # nanoseconds of the halves' products
NEVER = 1 << 16  # clocks


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
    every, fixed_bits, late = [int(n) for n in sys.argv[3:]] or (NEVER, 0, 0)
    pipelined = every < NEVER
    text = sys.stdin.read()
    lines = re.findall(r"^    wire (?:\[(\d+):0\] )?(\w+) = (.*);$", text, re.M)
    given = {u: int(n) for u, n in re.findall(r"^    // (\w+): (\d+) bits$", text, re.M)}
    fixed = {u for u in given if int(u[len("asked_") :]) < fixed_bits}
    width, made, extended, outs = dict(given), [], {}, []
    stage, time = {u: late if u in fixed else 0 for u in given}, {u: 0.0 for u in given}
    kept, held, low, last, pools = {}, set(given), {}, 0, {}  # kept: a register -> what it takes, the value, and when
    summed = {}  # a wide product, and what is made of it in its stage -> the step in which it is right

    def now(at):
        return f"step[{at}]" if pipelined else f"step == 8'd{at}"

    def there(u, at):
        """What has the value in that stage: its wire, until its input changes, or a register."""
        name, end = u, stage[u] + (every if u in held else 1)
        while at >= end and not (u in held and u in fixed):
            taken = f"if ({now(end - 1)}) " if pipelined or u in summed else ""
            kept[f"{name}_q"] = (name, u, taken)
            if u in fixed:
                return f"{name}_q"
            name, end = f"{name}_q", end + every
        return name

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
        if name.startswith("out_"):
            outs.append((name, bits, expression, used))
            continue
        if late == 0 and used and all(u in fixed for u in used):
            fixed.add(name)
        at = max((stage[u] for u in used), default=0)
        if " / " in expression:
            sys.exit(f"stages.py: no divider for {expression}")
        before = max((time[u] for u in used if stage[u] == at), default=0.0)
        own = CHOICE if product else delay(expression, max([bits] + [width[u] for u in used]))
        if before > 0 and (before + own > period or product and any(u in summed and stage[u] == at for u in used)):
            at, before = at + 1, 0.0
        if product:
            kind = sum(n > NARROW for _, n, _ in product)
            pool = pools.setdefault(kind, [])
            while not (free := [k for k, uses in enumerate(pool) if all(0 < abs(at - other) < every for other in uses)]):
                if sum(at - min(uses) < every for uses in pool) < MULTIPLIERS:
                    pool.append({})
                else:
                    at += 1
            which = free[0]
        for u in used:
            expression = re.sub(rf"\b{u}\b", there(u, at), expression)
        if product and kind:
            made.append(f"    wire [{bits - 1}:0] {name} = product_{kind}_{which};")
            pool[which][at] = expression.split(" * ")
            summed[name] = at + 2
            at, before, own = at + 2, 0.0, SUM
        elif product:
            made.append(f"    reg [{bits - 1}:0] {name};\n    always @(posedge clock) if ({now(at + 1)}) "
                        f"{name} <= product_{kind}_{which};")
            pool[which][at] = expression.split(" * ")
            held.add(name)
            at, before, own = at + 2, 0.0, 0.0
        else:
            if any(u in summed and stage[u] == at for u in used):
                summed[name] = at
            made.append(f"    wire [{bits - 1}:0] {name} = {expression};")
        stage[name], time[name], last = at, before + own, max(last, at)
    for name, bits, expression, used in outs:
        for u in used:
            if pipelined or u in summed:
                expression = re.sub(rf"\b{u}\b", there(u, last), expression)
        made.append(f"    assign out[{name[4:]} +: {bits}] = {expression};")
    if late and late + every <= last:
        sys.exit(f"stages.py: {module}: what is late is not there {every} clocks after the one before: {last + 1} clocks")
    size = {port: max(int(u.split("_")[1]) + n for u, n in ports)
            for port, ports in (("asked", given.items()), ("out", [out[:2] for out in outs]))}
    print(f"// Made from C by hls/rtl/verilog.py and stages.py: {last + 1} clocks.")
    steps = "input wire reset, input wire start, output wire more" if pipelined else "input wire [7:0] step"
    print(f"module {module} (input wire clock, {steps}, output wire done,")
    print(f"    input wire [{size['asked'] - 1}:0] asked, output wire [{size['out'] - 1}:0] out);")
    if pipelined:
        print(f"    reg [{last}:1] begun;\n    wire [{last}:0] step = {{begun, start}};\n    assign more = |step[{last - 1}:0];")
        print(f"    always @(posedge clock) begun <= reset ? {last}'d0 : step[{last - 1}:0];")
    print(f"    assign done = {now(last)};")
    print("\n".join(f"    wire [{n - 1}:0] {u} = asked[{u[6:]} +: {n}];" for u, n in given.items()))
    print("\n".join(f"    reg [{width[u] - 1}:0] {n};" for n, (_, u, _) in kept.items()))
    for kind, pool in pools.items():
        for k in range(len(pool)):
            print(f"    wire signed [{sum(sizes_of(kind)) - 1}:0] product_{kind}_{k};")
    print("\n".join(made))
    for kind, pool in pools.items():
        for k, uses in enumerate(pool):
            for side, n in enumerate(sizes_of(kind)):
                *first, final = [(at, factors[side]) for at, factors in sorted(uses.items())]
                choice = "".join(f"{now(at)} ? {factor} : " for at, factor in first) + final[1]
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
    print("\n".join(f"        {taken}{n} <= {name};" for n, (name, _, taken) in kept.items()))
    print("    end\nendmodule")


main()
