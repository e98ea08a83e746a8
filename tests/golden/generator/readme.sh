#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Do the examples of the vectors' README work, and do they notice a wrong bit? What has no tool here is reported as skipped.
# usage: readme.sh VECTORS
set -euo pipefail
vectors=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
skipped=0

# snippet LANGUAGE: the fenced block of that language
snippet() {
    awk -v fence="\`\`\`$1" '$0 == fence { on = 1; next } $0 == "```" { on = 0 } on' "$vectors/README.md"
}

# try LANGUAGE TOOL COMMAND: 'ok' on the vectors as they are, not with a bit flipped
try() {
    local language=$1 tool=$2 command=$3 file=quality/tilted.quality.out.hex
    if ! command -v "$tool" >/dev/null; then
        echo "readme: $language: skipped, there is no $tool here"
        skipped=$((skipped + 1))
        return
    fi
    rm -rf "$work/vectors"
    mkdir -p "$work/vectors"
    cp -R "$vectors/manifest.json" "$vectors/quality" "$vectors/smooth" "$work/vectors"
    snippet "$language" >"$work/vectors/check.${language:0:1}"
    if ! (cd "$work/vectors" && eval "$command") >"$work/out" 2>&1 || ! grep -q '^ok' "$work/out"; then
        echo "readme: $language: the example does not work:"
        cat "$work/out"
        status=1
        return
    fi
    sed -i '1s/.$/x/; 1y/x/f/' "$work/vectors/$file"
    if cmp -s "$vectors/$file" "$work/vectors/$file"; then
        sed -i '1s/.$/0/' "$work/vectors/$file"
    fi
    if (cd "$work/vectors" && eval "$command") 2>&1 | grep -q '^ok'; then
        echo "readme: $language: the example does not notice a wrong word"
        status=1
        return
    fi
    echo "readme: $language: works"
}

try c gcc 'gcc -std=c99 -Wall -Wextra -Werror check.c && ./a.out'
try verilog iverilog 'iverilog -g2012 -Wall check.v && ./a.out'
try python python3 'python3 check.p && [ "$(wc -l <ramp.hex)" = 1040 ]'
if [ $status -eq 0 ] && [ $skipped -gt 0 ]; then
    status=77
fi
exit $status
