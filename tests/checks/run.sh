#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The script at the top, in a folder of its own, over stand-ins for what it calls: these write down how they were called.
# usage: run.sh ROOT
set -euo pipefail
root=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{tools,tree/tests/checks,tree/tests/matrix,tree/build/gcc/tests/conformance,elsewhere/results}
cp "$root/run" "$work/tree"
cp "$root/tests/packages.sh" "$work/tree/tests"
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
for script in tests/checks/format.sh tests/matrix/matrix.sh; do
    stand_in "../tree/$script"
done
stand_in dpkg-query 'echo install ok installed'
stand_in apt-get
stand_in sleep
stand_in sudo '"$@"'
cd "$work/elsewhere"

# A folder is meant from where the user stands.
run conformance judge smooth results
calls "conformance --vectors $work/tree/vectors judge smooth results"
says "$work/elsewhere"

# A word that is no command is named, in one line.
run nonsense
[ $code -eq 2 ] || wrong "exit status $code"
says "there is no command 'nonsense'"
[ "$(wc -l <"$work/out")" -eq 1 ] || wrong 'more than one line'

# Steps that CMake 3.21 has: no workflows.
run check
[ $code -eq 0 ] || wrong "exit status $code"
for call in 'format.sh' 'cmake --preset gcc' 'cmake --build --preset gcc' 'ctest --preset gcc -R'; do
    calls "$call"
done
never_calls '--workflow'
says 'run check: passed'
python3 - "$root/CMakePresets.json" <<'END' || wrong 'the presets need more than CMake 3.21'
import json, sys
presets = json.load(open(sys.argv[1]))
sys.exit(presets['version'] > 3 or presets['cmakeMinimumRequired'] != {'major': 3, 'minor': 21, 'patch': 0})
END
stand_in ctest 'exit 8'
run check
[ $code -eq 1 ] || wrong "exit status $code after a failed test"
says 'run check: FAILED, 1 of 4 steps'

# Steps beside each other: one that returns, leaves or dies without a word has failed, whatever lies there from before.
mkdir -p "$work/tree/build/steps"
for k in 0 1 2 3; do
    echo 0 0 >"$work/tree/build/steps/$k.status"
done
(
    cd "$work/tree"
    eval "$(sed -n '/^summary=()/,/^run_tests()/p' run | sed '$d')"
    returns() { return 3; }
    leaves() { exit 0; }
    dies() { kill -9 $BASHPID; }
    nproc() { echo 2; }
    beside 'goes well' echo seen
    beside 'returns 3' returns
    beside 'leaves' leaves
    beside 'dies' dies
    beside 'is skipped' exit_with 77
    exit_with() { return "$1"; }
    together
    printf '%s\n' "${summary[@]}" "failures $failures"
) >"$work/out" 2>&1 || wrong 'steps beside each other end the run'
says seen
for verdict in 'ok            0 s  goes well' 'FAILED        0 s  returns 3' 'FAILED        0 s  leaves' 'FAILED        0 s  dies' \
    'skipped       0 s  is skipped' 'failures 3'; do
    says "$verdict"
done

# The demo ends with the path of the program.
mkdir -p "$work/tree/build/release/src/cli"
stand_in ../tree/build/release/src/cli/drogue
run demo
[ "$(tail -n 1 "$work/out")" = "The program: $work/tree/build/release/src/cli/drogue" ] || wrong 'the demo does not end with the path'

# Installing: what it costs comes first, and another apt-get is waited for.
stand_in dpkg-query 'echo unknown'
stand_in apt-get "case \"\$*\" in *--assume-no*) echo 'Need to get 495 MB of archives.' ;; *' -yq '*) echo GOING ;; esac"
run install
[ $code -eq 0 ] || wrong "exit status $code"
calls 'DPkg::Lock::Timeout='
[ "$(sed -n '/Need to get 495 MB/,$p' "$work/out" | grep -c GOING)" -eq 1 ] || wrong 'the cost is not told before'
stand_in apt-get "case \$1 in update) [ -e $work/waited ] || { touch $work/waited; echo 'E: Could not get lock x' >&2; exit 100; } ;; esac"
run install
[ $code -eq 0 ] || wrong "exit status $code after a lock"
says 'waiting for another apt-get'
[ "$(grep -c 'apt-get update' "$work/calls")" -eq 2 ] || wrong 'the lists are not fetched again'
stand_in apt-get 'exit 100'
run install
[ $code -eq 1 ] || wrong "exit status $code when packages cannot be installed"
says 'run: could not install'

# The quicker matrix installs what it runs, not every cross compiler.
stand_in apt-get
run matrix --ci
calls 'gcc-s390x-linux-gnu'
never_calls 'gcc-riscv64-linux-gnu'
run matrix
calls 'gcc-riscv64-linux-gnu'

exit $status
