# SPDX-License-Identifier: Apache-2.0
# The calls of the program in README.md, docs/program.md and its own help, as they stand there.
. "$(dirname "$0")/common.sh"
cd "$root" || exit 1

# calls FILE: the lines that call the program on a file of the repository, with what a shell would run
calls() { sed -nE 's/^(\$|) *(drogue (measure|track|edges) .*)$/\2/p' "$1" | grep 'vectors/'; }

calls README.md >"$work/calls"
[ -s "$work/calls" ] || fail 'README.md calls the program nowhere'
while read -r _ arguments; do
    checks=$((checks + 1))
    # shellcheck disable=SC2086 # words of a command line
    "$drogue" $arguments >"$work/out" 2>"$work/err" || fail "README.md: drogue $arguments: $(cat "$work/err")"
done <"$work/calls"
grep -q '^position_m ' "$work/out" || fail 'the call of README.md prints no pose'

# The example of the help, on the image that it means.
"$drogue" --help | grep -E '^  drogue measure demo.png' | sed 's,demo.png,vectors/frame/demo.png,' >"$work/calls"
[ -s "$work/calls" ] || fail 'the help has no example'
while read -r _ arguments; do
    # shellcheck disable=SC2086
    "$drogue" $arguments >"$work/out" 2>"$work/err" || fail "the example of --help: $(cat "$work/err")"
done <"$work/calls"

# Every option that docs/program.md names is one of the help's.
"$drogue" --help >"$work/help"
grep -oE -e '--[a-z][a-z-]+' docs/program.md | sort -u | grep -vE -e '^--(install|prefix)$' >"$work/options"
while read -r option; do
    checks=$((checks + 1))
    grep -qF -e "$option" "$work/help" || fail "docs/program.md names $option, which --help does not"
done <"$work/options"

# The sentences of docs/program.md are those that the program prints.
tr -d '\n' <src/cli/explain.c | sed 's/" *"//g' >"$work/sentences"
sed -nE 's/^\| `[a-z_]+` \| (.*) \|$/\1/p' docs/program.md | sed '1,/^measured$/{/^measured$/!d}' >"$work/documented"
[ "$(wc -l <"$work/documented")" -ge 17 ] || fail 'docs/program.md has too few sentences for statuses'
while read -r sentence; do
    checks=$((checks + 1))
    grep -qF -e "\"$sentence\"" "$work/sentences" "$root/src/cli/explain.h" || fail "no sentence of the program: $sentence"
done <"$work/documented"

finish
