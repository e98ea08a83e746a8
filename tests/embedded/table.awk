# SPDX-License-Identifier: Apache-2.0
# One row per target and frame. In: 'TARGET FRAME measure|stages NAME=VALUE...', the host's first.
function value(name, i) {
    for (i = 4; i <= NF; i++) if (index($i, name "=") == 1) return substr($i, length(name) + 2)
    return "-"
}

# of a frame at 480 MHz and an instruction a clock
function milliseconds(count) { return $1 == "host" ? "-" : sprintf("%.1f", count / 480000) }

function thousands(count) { return $1 == "host" ? "-" : sprintf("%.0f", count / 1000) }

BEGIN {
    heading = "%-14s %-13s %8s %16s %8s %6s %6s %6s %6s %6s %6s %6s %6s %8s %7s %7s\n"
    print "Instructions in thousands, without the stages called; of the front end per pixel, too. RAM: workspace, state, stack."
    print "ms: of all at 480 MHz and one instruction a clock; at another clock or rate in proportion."
    printf heading, "target", "frame", "z, m", "digest", "all, k", "ms", "front", "inner", "constr", "fit", "outlin", "pose",
        "joint", "back, k", "stack", "RAM"
    printf heading, "", "", "", "", "", "", "/px", "/px", "k", "k", "k", "k", "k", "", "bytes", "bytes"
}

$3 == "measure" {
    key = $1 " " $2
    z[key] = value("z_m")
    digest[key] = value("digest")
    all[key] = value("instructions")
    stack[key] = value("stack")
    ram[key] = value("ram")
}

$3 == "stages" {
    key = $1 " " $2
    counts = $1 != "host"
    pixels = value("pixels")
    back = value("constraints") + value("fit") + value("outline") + value("pose") + value("joint") + value("rest")
    same = digest[key] == digest["host " $2] && digest[key] == value("digest")
    printf heading, $1, $2, z[key], same ? digest[key] : "DIFFERS", thousands(all[key]), milliseconds(all[key]),
        counts ? sprintf("%.1f", value("front_end") / pixels) : "-", counts ? sprintf("%.1f", value("inner") / pixels) : "-",
        thousands(value("constraints")), thousands(value("fit")), thousands(value("outline")), thousands(value("pose")),
        thousands(value("joint")), thousands(back), stack[key], ram[key]
}
