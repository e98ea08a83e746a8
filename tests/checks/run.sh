#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The script at the top, in a folder of its own, over stand-ins for what it calls: these write down how they were called.
# usage: run.sh ROOT
set -euo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{tools,tree/tests,tree/build/gcc/tests/conformance,elsewhere/results}
cp "$root/run" "$work/tree"
status=0

# stand_in NAME [LINE...]: a program that writes its name and arguments to 'calls', then does the lines
stand_in() {
    local file=$work/tools/$1
    printf '#!/bin/sh\necho "%s $*" >>"%s/calls"\n' "${1##*/}" "$work" >"$file"
    shift
    [ $# -eq 0 ] || printf '%s\n' "$@" >>"$file"
    chmod +x "$file"
}

# run ARGUMENT...: output in 'out', what was called in 'calls', exit status in code
run() {
    rm -f "$work/calls"
    : >"$work/calls"
    code=0
    PATH=$work/tools:$PATH ../tree/run "$@" >"$work/out" 2>&1 </dev/null || code=$?
}

wrong() {
    echo "run.sh: $*"
    cat "$work/out" "$work/calls"
    status=1
}
says() { grep -qF -- "$1" "$work/out" || wrong "'$1' is not in the output"; }
calls() { grep -qF -- "$1" "$work/calls" || wrong "'$1' is not called"; }
never_calls() { ! grep -qF -- "$1" "$work/calls" || wrong "'$1' is called"; }

for tool in cmake ctest cc; do
    stand_in $tool
done
stand_in ../tree/build/gcc/tests/conformance/conformance 'pwd' 'ls'
stand_in dpkg-query 'echo install ok installed'
stand_in apt-get
cd "$work/elsewhere"

# A folder is meant from where the user stands.
run conformance judge smooth results
calls "conformance --vectors $work/tree/vectors judge smooth results"
says "$work/elsewhere"

exit $status
