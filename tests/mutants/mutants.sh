#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Do the golden vectors notice a wrong bit? Builds the core once per entry of list.txt with that one change in it, runs
# the vectors, and counts the changes that make a case fail.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
. src/sources.sh
list=tests/mutants/list.txt
work=${DROGUE_MUTANTS_DIR:-build/mutants}
jobs=${DROGUE_MUTANTS_JOBS:-$(nproc)}
least_percent=95

usage() {
    cat <<'END'
usage: tests/mutants/mutants.sh [--check] [NAME...]

Without NAME: every mutant of list.txt; --check: only see that each entry still fits its file.
Exit status 0 when at least 95 % are caught, every survivor has its reason in the list, and no entry is stale.
Works in build/mutants (DROGUE_MUTANTS_DIR) with as many jobs as processors (DROGUE_MUTANTS_JOBS).
END
}

names=()
declare -A file old new what survives

# read_list: the entries of list.txt, whose format is described at its head
read_list() {
    local line key value name="" number=0
    while IFS= read -r line; do
        number=$((number + 1))
        [[ -z $line || $line == '#'* ]] && continue
        key=${line%%: *}
        value=${line#*: }
        case $key in
        name)
            name=$value
            if [ -n "${file[$name]+set}" ]; then
                stale "$name: twice in the list"
            fi
            names+=("$name")
            file[$name]="" old[$name]="" new[$name]="" what[$name]="" survives[$name]=""
            ;;
        file) file[$name]=$value ;;
        old) old[$name]=$value ;;
        new) new[$name]=$value ;;
        what) what[$name]=$value ;;
        survives) survives[$name]=$value ;;
        *) stale "line $number: '$line'" ;;
        esac
    done <"$list"
}

errors=0
stale() {
    echo "mutants: list.txt: $*" >&2
    errors=$((errors + 1))
}

# check_entry NAME: complete, and its old text in its file exactly once
check_entry() {
    local text rest path=${file[$1]}
    if [ -z "${old[$1]}" ] || [ -z "${new[$1]}" ] || [ -z "${what[$1]}" ] || [ ! -f "$path" ]; then
        stale "$1: needs an existing file, old, new and what"
        return
    fi
    text=$(<"$path")
    rest=${text#*"${old[$1]}"}
    if [ "$rest" = "$text" ]; then
        stale "$1: ${file[$1]} does not have '${old[$1]}'"
    elif [[ $rest == *"${old[$1]}"* ]]; then
        stale "$1: ${file[$1]} has '${old[$1]}' more than once"
    fi
}

# slot: wait until another job may start
slot() {
    while [ "$(jobs -rp | wc -l)" -ge "$jobs" ]; do
        wait -n
    done
}

# compile INCLUDE SOURCE OBJECT [FLAG...]: with INCLUDE before the tree's own headers
compile() {
    gcc -O1 -std=c99 -I "$1" -I include -I tests/conformance -MMD -c "$2" -o "$3" "${@:4}"
}

# build_base: objects of the unchanged core with their dependencies, the conformance run, the vectors; its digest
build_base() {
    local source begin
    rm -rf "$work"
    mkdir -p "$work/core" "$work/rest"
    tests/matrix/embed.sh "$work/cases" || return 1
    for source in "$work"/cases/*.c; do
        slot
        compile include "$source" "$work/rest/$(basename "$source" .c).o" -O0 &
    done
    for source in $(core_files . '*.c'); do
        slot
        compile include "$source" "$work/core/$(basename "$source" .c).o" &
    done
    for source in tests/conformance/{stages*,sha256,conformance,embedded_main}.c; do
        slot
        compile include "$source" "$work/rest/$(basename "$source" .c).o" &
    done
    wait
    gcc "$work"/core/*.o "$work"/rest/*.o -o "$work/base" || return 1
    begin=$SECONDS
    "$work/base" >"$work/base.log" || return 1
    most_s=$((10 * (SECONDS - begin) + 20))
    digest=$(tail -n 1 "$work/base.log")
    digest=${digest##*digest=}
}

# users FILE: 'source object' of those whose object depends on a file of the core
users() {
    local dependencies source
    for dependencies in "$work"/{core,rest}/*.d; do
        if tr -s ' \\\n' '\n' <"$dependencies" | grep -qxF "$1"; then
            source=$(tr -s ' \\\n' '\n' <"$dependencies" | sed -n 2p)
            dependencies=${dependencies#"$work/"}
            echo "$source ${dependencies%.d}.o"
        fi
    done
}

# do_mutant NAME: leaves 'verdict|cases that fail|stages that notice' in its folder
do_mutant() {
    local dir=$work/mutants/$1 path=${file[$1]} text source object objects=() status=0 last verdict
    mkdir -p "$dir/core" "$dir/rest" "$dir/$(dirname "$path")"
    for source in $(core_files . '*.h'); do # a header in quotes is looked for beside the file that includes it
        mkdir -p "$dir/$(dirname "$source")"
        cp "$source" "$dir/$source"
    done
    text=$(<"$path")
    printf '%s\n' "${text%%"${old[$1]}"*}${new[$1]}${text#*"${old[$1]}"}" >"$dir/$path"
    while read -r source object; do
        if [[ $source == src/* ]]; then
            mkdir -p "$dir/$(dirname "$source")"
            [ "$source" = "$path" ] || cp "$source" "$dir/$source"
            source=$dir/$source
        fi
        compile "$dir/include" "$source" "$dir/$object" || status=1
    done < <(users "$path") >"$dir/build.log" 2>&1
    for object in "$work"/{core,rest}/*.o; do
        object=${object#"$work/"}
        [ -e "$dir/$object" ] && objects+=("$dir/$object") || objects+=("$work/$object")
    done
    if [ $status -ne 0 ] || ! gcc "${objects[@]}" -o "$dir/image" 2>>"$dir/build.log"; then
        echo "does not build|-|-" >"$dir/result"
        return
    fi
    timeout "$most_s" "$dir/image" >"$dir/log" 2>&1 || status=$?
    last=$(tail -n 1 "$dir/log" | grep -a '^conformance: ')
    if [ $status -eq 124 ]; then
        verdict="caught: does not end"
    elif [ -z "$last" ]; then
        verdict="caught: stops with $status"
    elif [ $status -eq 0 ] && [ "${last##*digest=}" = "$digest" ]; then
        verdict="survives"
    else
        verdict="caught"
    fi
    echo "$verdict|$(sed -nE 's/.* failed=([0-9]+) .*/\1/p' <<<"$last")|$(grep -a '^FAIL ' "$dir/log" |
        sed -E 's/^FAIL ([a-z]+).*/\1/' | sort -u | xargs)" >"$dir/result"
    rm -rf "$dir/core" "$dir/rest" "$dir/image"
}

report() {
    local name verdict cases stages caught=0 survivors=() bad=$errors
    printf '\n%-26s %-28s %-20s %5s  %s\n' mutant file verdict cases 'stages that notice'
    for name in "${chosen[@]}"; do
        IFS='|' read -r verdict cases stages <"$work/mutants/$name/result"
        case $verdict in
        caught*)
            caught=$((caught + 1))
            if [ -n "${survives[$name]}" ]; then
                verdict="$verdict, STALE REASON"
                bad=$((bad + 1))
            fi
            ;;
        survives)
            survivors+=("$name")
            stages="${what[$name]}; ${survives[$name]:-NO REASON}"
            [ -n "${survives[$name]}" ] || bad=$((bad + 1))
            ;;
        *) bad=$((bad + 1)) ;;
        esac
        printf '%-26s %-28s %-20s %5s  %s\n' "$name" "${file[$name]}" "$verdict" "$cases" "$stages"
    done
    echo "mutants: total=${#chosen[@]} caught=$caught survivors=$(IFS=,; echo "${survivors[*]:-none}") seconds=$SECONDS"
    [ $bad -eq 0 ] && [ $((100 * caught)) -ge $((least_percent * ${#chosen[@]})) ]
}

only_check=""
chosen=()
for argument in "$@"; do
    case $argument in
    --check) only_check=yes ;;
    -h | --help) usage && exit ;;
    -*) usage >&2 && exit 2 ;;
    *) chosen+=("$argument") ;;
    esac
done
read_list
for name in "${names[@]}"; do
    check_entry "$name"
done
[ $errors -eq 0 ] || exit 1
if [ -n "$only_check" ]; then
    echo "mutants: all ${#names[@]} entries fit"
    exit
fi
[ ${#chosen[@]} -gt 0 ] || chosen=("${names[@]}")
for name in "${chosen[@]}"; do
    [ -n "${file[$name]+set}" ] || { echo "mutants: no entry '$name'" >&2 && exit 2; }
done
if ! build_base; then
    echo "mutants: the unchanged core does not build or does not pass" >&2
    exit 1
fi
for name in "${chosen[@]}"; do
    slot
    do_mutant "$name" &
done
wait
report
