#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The scripts for Vitis, without Vitis: do all files that they name exist, does run_hls.tcl go through all its steps? And
# would it be noticed if not?
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
. hls/tops.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
scripts=0

# twins: of the files named on standard input those that share a name, of which Vitis would make one object
twins() { sed 's|.*/||' | sort | uniq -d; }

# run_stub FOLDER FUNCTION SCRIPT
run_stub() { (cd "$1" && tclsh "$OLDPWD/hls/vitis/stub.tcl" "$2" "$3"); }

hls/vitis/generate.sh
for name in $(all_tops); do
    top "$name"
    folder=build/hls/vitis/$name
    scripts=$((scripts + 2))
    run_stub "$folder" "$function" run_hls.tcl || status=1
    while IFS= read -r file; do
        if [ ! -e "$folder/$file" ] && [[ $file != */build/hls/* ]]; then
            echo "vitis: $folder/hls_config.cfg: no file $file"
            status=1
        fi
    done < <(sed -nE 's/^(syn|tb)\.file=//p' "$folder/hls_config.cfg")
    for file in $(sed -nE 's/^(syn|tb)\.file=//p' "$folder/hls_config.cfg" | twins); do
        echo "vitis: $folder/hls_config.cfg: two files $file"
        status=1
    done
done
if [ "$(printf '%s\n' a/x.c b/y.c b/x.c | twins)" != x.c ]; then
    echo "vitis: the check does not notice two files of one name"
    status=1
fi

# bites SED FAULT: a script spoiled like this, in its own part or in the common one, is refused with this fault
bites() {
    sed -E "$1" hls/vitis/run.tcl >"$work/run.tcl"
    sed -E "$1; s|^source .*|source $work/run.tcl|" "$folder/run_hls.tcl" >"$work/spoiled.tcl"
    if run_stub "$folder" "$function" "$work/spoiled.tcl" >"$work/out" 2>&1 || ! grep -q "$2" "$work/out"; then
        echo "vitis: the check does not notice: $2"
        status=1
    fi
}
bites 's|src/arithmetic/real\.c|src/arithmetic/reel.c|' 'no file .*reel\.c'
bites 's/^set top .*/set top another/' 'top another'
bites '/^set replaced/s/.*/set replaced src\/drogue.c/' 'not those of hls_config.cfg'
bites '/^ *cosim_design/d' 'steps .* csynth export'
bites 's/ -DDROGUE_HLS_FEW//' 'with all its random images'
bites 's/^set_part/set_prat/' 'invalid command name "set_prat"'
[ $status -eq 0 ] && echo "vitis: $scripts scripts as they should be"
exit $status
