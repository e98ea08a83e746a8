#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Do the tests notice a wrong bit? Builds what one change of list.txt touches, runs the golden vectors over it and, where
# they notice nothing, the unit tests of the rooms it touches or the tests of the program; counts the changes that fail.
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
. src/sources.sh
list=tests/mutants/list.txt
work=${DROGUE_MUTANTS_DIR:-build/mutants}
tools=$PWD/$work/tools
jobs=${DROGUE_MUTANTS_JOBS:-$(nproc)}
least_percent=97

usage() {
    cat <<'END'
usage: tests/mutants/mutants.sh [--check] [--every N] [NAME...]

Without NAME: every mutant of list.txt, with --every N every N-th; --check: only see that each entry still fits its file.
Exit status 0 when at least 97 % are caught, every survivor has its reason in the list, and no entry is stale.
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

cc=(gcc)

# compile INCLUDE SOURCE OBJECT [FLAG...]: with INCLUDE before the tree's own headers
compile() {
    "${cc[@]}" -O1 -std=c99 -fPIC -D_POSIX_C_SOURCE=200809L -I "$1" -I "${1%include}." -I include -I tests/conformance \
        -I tests/unit -I src/frontend -I src/search -I src/cli -I . -MMD -c "$2" -o "$3" "${@:4}"
}

# The program's flags and libraries, as src/cli/CMakeLists.txt has them.
cli_flags=(-DHAVE_YAML -DHAVE_EXPAT)
cli_libraries=(-lpng -lyaml -lexpat -lm)
read -ra unit_libraries <<<"$(pkg-config --libs check 2>/dev/null) -lm"

# shared DIR: DIR/libdrogue.so of the core's objects, those in DIR instead of the unchanged ones
shared() {
    local object objects=()
    for object in "$work"/core/*.o; do
        [ -e "$1/core/${object##*/}" ] && objects+=("$1/core/${object##*/}") || objects+=("$object")
    done
    gcc -shared "${objects[@]}" -o "$1/libdrogue.so"
}

# program DIR FOLDER NAME [LIBRARY...]: DIR/FOLDER-NAME of the objects in FOLDER, those in DIR instead of the unchanged ones
program() {
    local object objects=()
    for object in "$work/$2"/*.o; do
        [ -e "$1/$2/${object##*/}" ] && objects+=("$1/$2/${object##*/}") || objects+=("$object")
    done
    gcc "${objects[@]}" -o "$1/$3" -L "$1" -L "$work" -ldrogue "${@:4}"
}

# unit_program DIR NAME: DIR/NAME of the unit test's object in DIR
unit_program() { gcc "$1/unit/$2.o" -o "$1/unit/$2" -L "$1" -L "$work" -ldrogue "${unit_libraries[@]}"; }

# build_base: objects of the unchanged core and of all that tests it, with their dependencies; runs the vectors
build_base() {
    local source begin name cc=(gcc)
    command -v ccache >/dev/null && cc=(ccache gcc)
    rm -rf "$work"
    mkdir -p "$work"/{core,rest,unit,cli,tools,holds}
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
    for source in tests/unit/*/*.c; do
        [[ $source == tests/unit/driver/* ]] && continue # it is linked with hls/, not with the core
        slot
        name=${source#tests/unit/}
        compile include "$source" "$work/unit/${name//\//-}.o" -w &
    done
    for source in src/cli/*.c; do
        slot
        compile include "$source" "$work/cli/$(basename "$source" .c).o" "${cli_flags[@]}" &
    done
    gcc -w tests/cli/make_images.c -o "$work/tools/make_images" -lpng -lm &
    gcc -w -D_POSIX_C_SOURCE=200809L tests/cli/json_check.c -o "$work/tools/json_check" -lm &
    # shellcheck disable=SC2046
    g++ -O1 -w $(pkg-config --cflags opencv4) tests/cli/canny_check.cpp -o "$work/tools/canny_check" \
        -lopencv_core -lopencv_imgcodecs -lopencv_imgproc &
    wait
    shared "$work" && program "$work" rest vectors && program "$work" cli drogue "${cli_libraries[@]}" || return 1
    for source in "$work"/unit/*.o; do
        slot
        unit_program "$work" "$(basename "$source" .o)" &
    done
    wait
    index_users
    for source in $(find include src -name '*.h'); do
        mkdir -p "$work/headers/${source%/*}"
        cp "$source" "$work/headers/$source"
    done
    begin=$SECONDS
    LD_LIBRARY_PATH=$work "$work/vectors" >"$work/base.log" || return 1
    most_s=$((10 * (SECONDS - begin) + 60))
    digest=$(tail -n 1 "$work/base.log")
    digest=${digest##*digest=}
}

# index_users: a line 'file source object' for each file of the tree that an object depends on
index_users() {
    local dependencies
    for dependencies in "$work"/{core,rest,unit,cli}/*.d; do
        tr -s ' \\\n' '\n' <"$dependencies" | sed '1d;/^$/d' |
            awk -v object="${dependencies#"$work/"}" 'NR == 1 { source = $1; sub(/d$/, "o", object) } { print $1, source, object }'
    done >"$work/users"
}

# users FILE: 'source object' of those whose object depends on a file of the tree
users() { awk -v file="$1" '$1 == file { print $2, $3 }' "$work/users"; }

# quiet LOG COMMAND...: what the command prints, and what the shell says of one that is killed, goes to LOG
quiet() { { "${@:2}"; } >"$1" 2>&1; }

# holds NAME COMMAND...: does what caught a mutant hold for the unchanged core? Asked once.
holds() {
    [ -e "$work/holds/$1" ] || { quiet /dev/null env LD_LIBRARY_PATH="$work" "${@:2}" && touch "$work/holds/$1"; }
}

# built DIR PROGRAM: that of the mutant where it has one of its own
built() { [ -x "$1/$2" ] && echo "$1/$2" || echo "$work/$2"; }

# run_vectors DIR: sets 'verdict', and 'cases' and 'noticed' when caught
run_vectors() {
    local status=0 last
    quiet "$1/log" env LD_LIBRARY_PATH="$1" timeout "$most_s" "$(built "$1" vectors)" || status=$?
    last=$(tail -n 1 "$1/log" | grep -a '^conformance: ')
    if [ $status -eq 124 ]; then
        verdict="caught: does not end"
    elif [ -z "$last" ]; then
        verdict="caught: stops with $status"
    elif [ $status -ne 0 ] || [ "${last##*digest=}" != "$digest" ]; then
        verdict="caught"
    fi
    cases=$(sed -nE 's/.* failed=([0-9]+) .*/\1/p' <<<"$last")
    noticed=$(grep -a '^FAIL ' "$1/log" | sed -E 's/^FAIL ([a-z]+).*/\1/' | sort -u | xargs)
}

# run_units DIR ROOM...: the unit tests of the rooms until one fails
run_units() {
    local dir=$1 room test name
    for room in "${@:2}"; do
        for test in "$work/unit/$room"-*.c; do
            name=$(basename "$test" .o)
            if ! quiet "$dir/log" env CK_FORK=no LD_LIBRARY_PATH="$dir" timeout "$most_s" \
                "$(built "$dir" "unit/$name")"; then
                holds "$name" env CK_FORK=no "$work/unit/$name" && verdict=caught || verdict="unchanged core fails"
                noticed="unit ${name%.c}"
                return
            fi
        done
    done
}

# run_program DIR FILE: the tests of the program until one fails; those that are about the file first, the long ones last
run_program() {
    local script part test
    part=$(basename "$2" .c)
    for script in "$part" ${cli_first[$part]:-} usage measure track inputs outputs members settings documents camera images edges; do
        [ -e "tests/cli/$script.sh" ] || continue
        test=(sh "tests/cli/$script.sh" "$(realpath "$1/drogue")" "$tools/make_images" "$tools/json_check"
            "$tools/canny_check" "$PWD")
        if ! quiet "$1/log" env LD_LIBRARY_PATH="$(realpath "$work")" timeout "$most_s" "${test[@]}"; then
            test[2]=$(realpath "$work/drogue")
            holds "$script" env LD_LIBRARY_PATH="$(realpath "$work")" "${test[@]}" && verdict=caught ||
                verdict="unchanged core fails"
            noticed="cli $script"
            return
        fi
    done
}

# What the parts of the program are tested by, where a script does not have their name.
declare -A cli_first=([camera_file]=camera [keys]=camera [keys_xml]=camera [keys_yaml]=camera [pnm]=images [raw]=images
    [png_io]=images [csv]=outputs [json]=outputs [decimal]=camera [frame]=measure [numbers]=usage [options]=usage
    [sequence]=track [overlay]=images [canvas]=images [font]=images [thresholds]=settings [table]=outputs [explain]=outputs)

# What a room's code is tested by beside the room's own tests.
declare -A also=([track]=search [inner]=measure [pose]=measure [outline]="measure inner" [frontend]="measure track"
    [camera]="pose measure" [arithmetic]="pose outline track")

# rooms OBJECT...: those of the unit tests for these objects
rooms() {
    local object source room
    for object in "$@"; do
        [[ $object == core/* ]] || continue
        source=$(find src -name "$(basename "$object" .o).c" -not -path '*/cli/*')
        room=$(basename "$(dirname "$source")")
        [ "$room" = src ] && room=measure
        printf '%s\n' "$room" ${also[$room]:-}
    done | awk '!seen[$0]++'
}

# do_mutant NAME: leaves 'verdict|cases that fail|what notices' in its folder
do_mutant() {
    local dir=$work/mutants/$1 path=${file[$1]} text source object built=() bad="" verdict=survives cases="" noticed=""
    mkdir -p "$dir"/{core,rest,unit,cli} "$dir/${path%/*}"
    if [[ $path == *.h ]]; then # in quotes it is looked for beside the file that includes it
        cp -r "$work/headers/." "$dir"
    fi
    text=$(<"$path")
    printf '%s\n' "${text%%"${old[$1]}"*}${new[$1]}${text#*"${old[$1]}"}" >"$dir/$path"
    while read -r source object; do
        if [[ $source == src/* ]]; then
            mkdir -p "$dir/${source%/*}"
            [ "$source" = "$path" ] || cp "$source" "$dir/$source"
            source=$dir/$source
        fi
        compile "$dir/include" "$source" "$dir/$object" -w -iquote "${path%/*}" "${cli_flags[@]}" || bad=yes
        built+=("$object")
    done < <(users "$path") >"$dir/build.log" 2>&1
    {
        [[ " ${built[*]}" != *' core/'* ]] || shared "$dir" || bad=yes
        [[ " ${built[*]}" != *' rest/'* ]] || program "$dir" rest vectors || bad=yes
        [[ " ${built[*]}" != *' cli/'* ]] || program "$dir" cli drogue "${cli_libraries[@]}" || bad=yes
        for object in "${built[@]}"; do
            [[ $object != unit/* ]] || unit_program "$dir" "$(basename "$object" .o)" || bad=yes
        done
    } >>"$dir/build.log" 2>&1
    if [ -n "$bad" ]; then
        verdict="does not build"
    elif [[ $path == src/cli/* ]]; then
        run_program "$dir" "$path"
    else
        run_vectors "$dir"
        # shellcheck disable=SC2046
        [ "$verdict" != survives ] || run_units "$dir" $(rooms "${built[@]}")
    fi
    echo "$verdict|$cases|$noticed" >"$dir/result"
    rm -rf "$dir"/{core,rest,unit,cli,src,include,libdrogue.so,vectors,drogue}
}

report() {
    local name verdict cases stages caught=0 survivors=() bad=$errors
    printf '\n%-26s %-28s %-20s %5s  %s\n' mutant file verdict cases 'what notices'
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
every=1
while [ $# -gt 0 ]; do
    case $1 in
    --check) only_check=yes ;;
    --every) every=${2:-} && shift ;;
    -h | --help) usage && exit ;;
    -*) usage >&2 && exit 2 ;;
    *) chosen+=("$1") ;;
    esac
    shift
done
[[ $every =~ ^[1-9][0-9]*$ ]] || { usage >&2 && exit 2; }
read_list
for name in "${names[@]}"; do
    check_entry "$name"
done
[ $errors -eq 0 ] || exit 1
if [ -n "$only_check" ]; then
    echo "mutants: all ${#names[@]} entries fit"
    exit
fi
if [ ${#chosen[@]} -eq 0 ]; then
    for ((i = 0; i < ${#names[@]}; i += every)); do
        chosen+=("${names[i]}")
    done
fi
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
