#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The commands of docs/embedded.md as they stand there, apt-get alone left out, with a home folder of their own; what they
# print must be what the page says, but for the time.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# block N: the Nth block of code of the page
block() { awk -v n="$1" '/^```/ { inside = !inside; if (inside) k++; next } inside && k == n' docs/embedded.md; }

{
    echo 'set -euo pipefail'
    block 1 | grep -v '^sudo apt-get'
} >"$work/commands"
block 2 | sed '$d' >"$work/expected"
grep -q qemu-system-arm "$work/commands" && [ -s "$work/expected" ] || {
    echo 'as_documented: docs/embedded.md has no commands or no output where they are looked for'
    exit 1
}
if ! HOME=$work bash "$work/commands" >"$work/out" 2>&1 </dev/null; then
    tail -n 20 "$work/out"
    exit 1
fi
tail -n 3 "$work/out"
tail -n 3 "$work/out" | sed '$d' | cmp - "$work/expected"
tail -n 1 "$work/out" | grep -Eq '^[0-9]+ thousand clocks, [0-9]+ microseconds at 480 MHz$'
