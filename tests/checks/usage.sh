#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A wrong call of a script of hls/ that has a usage line, from wherever it is made, gives that line on standard error, exit
# status 2, and nothing else; whatever tools are here.
# usage: usage.sh ROOT
set -euo pipefail
root=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
count=0

# refuses SCRIPT ARGUMENT...: from another folder, by a path that leads out of it
refuses() {
    local code=0 line
    line=$(grep -m 1 '^# usage: ' "$1" | sed -E 's/^# //;s/ {3,}.*//')
    (cd "$work" && "$(realpath --relative-to=. "$1")" "${@:2}" >out 2>err) || code=$?
    if [ $code -ne 2 ] || [ -s "$work/out" ] || [ "$(cat "$work/err")" != "$line" ]; then
        echo "usage: ${1#"$root/"} ${*:2}: exit status $code, $(cat "$work/out" "$work/err"), not '$line'"
        status=1
    fi
    count=$((count + 1))
}

while read -r script; do
    refuses "$script" --nonsense
done < <(grep -rl '^# usage: ' --include='*.sh' "$root/hls" | LC_ALL=C sort)
[ $count -ge 15 ] || { echo "usage: only $count scripts" && status=1; }
for script in bambu/area bambu/bambu vitis/vitis system/route system/simulate vectors table; do # these need an argument
    refuses "$root/hls/$script.sh"
done
for width in 0 -1 1x '2 3'; do
    refuses "$root/hls/rtl/rtl.sh" "$width"
    refuses "$root/hls/rtl/simulate.sh" "$width"
done
refuses "$root/hls/vitis/vitis.sh" eigen --csim --cosym
refuses "$root/hls/system/simulate.sh" render 128
refuses "$root/hls/check/check.sh" --needed
echo "usage: $count wrong calls"
exit $status
