#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Every form in which the library is handed over, tried by a consumer and by the form's own tools. Tools that are not in
# Debian are installed by pip into build/packaging; what cannot be tried here is listed as NOT TRIED with the reason.
# find_package, add_subdirectory and pkg-config are tried by tests/checks/install.sh.
# usage: packaging.sh      DROGUE_PACK_XSD=FILE names PACK.xsd of Open-CMSIS-Pack-Spec where it cannot be downloaded
set -uo pipefail
cd "$(dirname "$0")/../.." || exit
root=$PWD
work=$root/build/packaging
schema_url=https://raw.githubusercontent.com/Open-CMSIS-Pack/Open-CMSIS-Pack-Spec/v1.7.36/schema/PACK.xsd
warnings=(-std=c99 -pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wvla -Wdouble-promotion -Wshadow -Werror)
version=$(sed -nE 's/^project\(drogue VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
failed=0
not_tried=0

# try WHAT COMMAND...: the command's output is shown when it fails
try() {
    local what=$1 status
    shift
    (
        set -eo pipefail
        "$@"
    ) >"$work/log" 2>&1
    status=$? # not in an 'if': there -e has no effect
    if [ $status -eq 0 ]; then
        echo "ok         $what"
    else
        echo "FAILED     $what:"
        tail -n 20 "$work/log"
        failed=$((failed + 1))
    fi
}

not_tried() {
    echo "NOT TRIED  $1: $2"
    not_tried=$((not_tried + 1))
}

# same WHAT VERSION
same() {
    if [ "$2" = "$version" ]; then
        echo "ok         version in $1"
    else
        echo "FAILED     version in $1 is $2, the project's is $version"
        failed=$((failed + 1))
    fi
}

install_tools() {
    timeout 240 python3 -m venv "$work/tools" && timeout 240 "$work/tools/bin/pip" install -q --retries 1 --timeout 20 \
        platformio==6.2.0 idf-component-manager==3.1.2
}

tool() { [ -x "$work/tools/bin/$1" ]; }

# Debian's python3 has the modules of Debian's packages, whichever python3 comes first in PATH.
debian_python=/usr/bin/python3
has_module() { "$debian_python" -c "import $1" 2>/dev/null; }

# use_two_files FOLDER: a consumer of drogue/drogue.h and drogue.c in FOLDER, by the include lines of the README
use_two_files() {
    gcc -std=c99 -O2 -I "$1" -c "$1/drogue.c" -o "$work/two_files.o"
    gcc -std=c99 -I "$1" tests/checks/consumer/main.c "$work/two_files.o" -o "$work/consumer"
    "$work/consumer" "$version"
}

two_files_compile() {
    local compiler
    for compiler in 'gcc -O2' 'clang -O2' 'arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -Os'; do
        $compiler "${warnings[@]}" -I "$work/two" -c "$work/two/drogue.c" -o "$work/two.o"
    done
    g++ -std=c++11 -pedantic -Wall -Wextra -Wconversion -Wshadow -Werror -fsyntax-only -x c++ "$work/two/drogue/drogue.h"
}

two_files_symbols() {
    mkdir -p "$work/tree/src" "$work/tree/include"
    cp "$work/two/drogue.c" "$work/tree/src"
    cp -R "$work/two/drogue" "$work/tree/include"
    tests/checks/symbols.sh "$work/tree" gcc -O2
    tests/checks/symbols.sh "$work/tree" arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -Os
}

# The shipped frames by the two files and by the installed library, on the host and on a Cortex-M7
two_files_digest() {
    local images=tests/embedded built=$work/embedded sources
    sources=("$images"/{measure,digest,counter}.c "$built/frames.c" "$work/two/drogue.c")
    . tests/matrix/machine.sh
    DROGUE_EMBEDDED_DIR=build/packaging/embedded DROGUE_EMBEDDED_OPTIMISATION=-O1 $images/embedded.sh cortex-m7
    gcc -std=c99 -O2 -I "$work/two" -I $images "${sources[@]}" -o "$work/measure"
    "$work/measure" | grep -o 'frame [^:]*\|digest=.*' >"$work/digests"
    arm-none-eabi-gcc -mcpu=cortex-m7 -mthumb -std=c99 -Os -I "$work/two" -I $images "${sources[@]}" \
        tests/matrix/start_mps2.c --specs=rdimon.specs -nostartfiles -T tests/matrix/mps2.ld -o "$work/measure.elf"
    machine mps2-an500
    "${run[@]}" "$work/measure.elf" </dev/null | grep -o 'frame [^:]*\|digest=.*' >"$work/digests.m7"
    grep -o 'frame [^:]*\|digest=.*' "$built/host/images/measure.out" >"$work/digests.library"
    cat "$work"/digests*
    cmp "$work/digests" "$work/digests.library"
    cmp "$work/digests.m7" "$work/digests.library"
    grep -q '^frame demo' "$work/digests"
}

two_files() {
    try 'two files: generated' python3 src/packaging/amalgamate.py "$work/two"
    try 'two files: gcc, clang, Cortex-M0+ with every warning; drogue.h as C++11' two_files_compile
    try 'two files: exported symbols, no static data, nothing foreign' two_files_symbols
    try 'two files: used by a program' use_two_files "$work/two"
    try 'two files: digests of the shipped frames, host and Cortex-M7' two_files_digest
}

# download URL FILE
download() {
    python3 - "$1" "$2" <<'END'
import pathlib, sys, urllib.request
pathlib.Path(sys.argv[2]).write_bytes(urllib.request.urlopen(sys.argv[1], timeout=20).read())
END
}

valid_pack() {
    "$debian_python" - "$1" src/packaging/Drogue.drogue.pdsc <<'END'
import sys
from lxml import etree
schema = etree.XMLSchema(etree.parse(sys.argv[1]))
schema.assertValid(etree.parse(sys.argv[2]))
END
}

use_pack() {
    python3 src/packaging/cmsis_pack.py "$work/pack"
    python3 -m zipfile -e "$work/pack/Drogue.drogue.$version.pack" "$work/pack/open"
    python3 - "$work/pack/open" <<'END'
import pathlib, sys, xml.etree.ElementTree as tree
folder = pathlib.Path(sys.argv[1])
names = [f.get('name') for f in tree.parse(folder / 'Drogue.drogue.pdsc').iter('file')]
missing = [n for n in names if not (folder / n).exists()]
sys.exit(f'missing: {missing}' if missing or not names else 0)
END
    use_two_files "$work/pack/open/source"
}

cmsis_pack() {
    local xsd=${DROGUE_PACK_XSD:-$work/PACK.xsd}
    same Drogue.drogue.pdsc "$(sed -nE 's/.*<release version="([^"]*)".*/\1/p' src/packaging/Drogue.drogue.pdsc)"
    same 'Drogue.drogue.pdsc, component' "$(sed -nE 's/.*Cversion="([^"]*)".*/\1/p' src/packaging/Drogue.drogue.pdsc)"
    try 'CMSIS-Pack: put together, opened, its files used by a program' use_pack
    [ -e "$xsd" ] || download "$schema_url" "$xsd" 2>/dev/null
    if [ ! -e "$xsd" ]; then
        not_tried 'CMSIS-Pack: PACK.xsd' 'the schema cannot be downloaded; DROGUE_PACK_XSD can name it'
    elif ! has_module lxml; then
        not_tried 'CMSIS-Pack: PACK.xsd' 'python3-lxml is missing'
    else
        try 'CMSIS-Pack: valid by PACK.xsd' valid_pack "$xsd"
    fi
    not_tried 'CMSIS-Pack: packchk, CMSIS-Toolbox' 'in neither Debian nor PyPI'
}

# use_platformio FOLDER: compile what PlatformIO takes by FOLDER/library.json
use_platformio() {
    "$work/tools/bin/python" - "$1" >"$work/arguments" <<'END'
import json, pathlib, sys
from platformio import fs
folder = pathlib.Path(sys.argv[1])
build = json.loads((folder / 'library.json').read_text())['build']
print('-I', folder / build['includeDir'])
sources = folder / build['srcDir']
for name in fs.match_src_files(str(sources), build['srcFilter'], ['c', 'cc', 'cpp']):
    print(sources / name)
END
    gcc -std=c99 @"$work/arguments" tests/checks/consumer/main.c -o "$work/consumer"
    "$work/consumer" "$version"
}

# pack_platformio: into $work/platformio/package
pack_platformio() {
    local pio=$work/platformio
    mkdir -p "$pio/source" "$pio/package"
    cp -R include src library.json README.md CHANGELOG.md LICENSE "$pio/source"
    export PLATFORMIO_CORE_DIR=$pio/core
    if ! "$work/tools/bin/pio" pkg pack -o "$pio/drogue.tar.gz" "$pio/source" >"$pio/log" 2>&1; then
        cat "$pio/log"
        # The licence's name is looked up in a list on the net. Nothing else may be wrong.
        grep -qF "fields: {'license': ['Could not load SPDX licenses for validation']}." "$pio/log" || return 1
        touch "$pio/no_licence"
        sed -i '/"license"/d' "$pio/source/library.json"
        "$work/tools/bin/pio" pkg pack -o "$pio/drogue.tar.gz" "$pio/source"
    fi
    tar -xzf "$pio/drogue.tar.gz" -C "$pio/package"
    use_platformio "$pio/package"
}

platformio() {
    same library.json "$(python3 -c 'import json; print(json.load(open("library.json"))["version"])')"
    if tool pio; then
        try 'PlatformIO: sources compiled as library.json says, used by a program' use_platformio .
        try 'PlatformIO: library.json valid, packed, the package used by a program' pack_platformio
        [ ! -e "$work/platformio/no_licence" ] ||
            not_tried 'PlatformIO: licence in library.json' 'its tool has no access to the list of licences'
    else
        not_tried 'PlatformIO: its own tool' 'pip cannot install platformio'
    fi
    not_tried 'PlatformIO: pio run' 'its platforms come from its own registry'
}

# use_stand_in FRAMEWORK FOLDER
use_stand_in() {
    cmake -S tests/packaging/stand_in -B "$work/$1" -G Ninja -DFRAMEWORK="$1" -DDROGUE_ROOT="$2"
    cmake --build "$work/$1"
    "$work/$1/consumer" "$version"
}

esp_idf() {
    same idf_component.yml "$(sed -nE 's/^version: "(.*)"/\1/p' idf_component.yml)"
    if tool compote; then
        try 'ESP-IDF: idf_component.yml valid' "$work/tools/bin/compote" manifest lint idf_component.yml
        try 'ESP-IDF: packed, the package used by a program with a stand-in' pack_esp_idf
    else
        not_tried 'ESP-IDF: idf_component.yml by its own tool' 'pip cannot install idf-component-manager'
    fi
    try 'ESP-IDF: the component with a stand-in for idf_component_register, used by a program' \
        use_stand_in esp-idf "$root"
    not_tried 'ESP-IDF: idf.py build' 'ESP-IDF is in neither Debian nor PyPI'
}

# pack_esp_idf: into $work/component, used from there
pack_esp_idf() {
    mkdir "$work/component"
    cp -R CMakeLists.txt idf_component.yml include src README.md CHANGELOG.md LICENSE "$work/component"
    "$work/tools/bin/compote" component pack --name drogue --project-dir "$work/component"
    use_stand_in esp-idf "$work/component/dist/drogue_$version"
}

# Kconfig read, and DROGUE can be switched on
use_kconfig() {
    "$debian_python" - <<'END'
import kconfiglib
tree = kconfiglib.Kconfig('zephyr/Kconfig', warn_to_stderr=True)
symbol = tree.syms['DROGUE']
assert not tree.warnings and symbol.set_value('y') and symbol.str_value == 'y'
END
}

zephyr() {
    if has_module kconfiglib; then
        try 'Zephyr: Kconfig' use_kconfig
    else
        not_tried 'Zephyr: Kconfig' 'python3-kconfiglib is missing'
    fi
    try 'Zephyr: files named by module.yml are there' test -e "$(sed -n 's/^  kconfig: //p' zephyr/module.yml)" -a \
        -e "$(sed -n 's/^  cmake: //p' zephyr/module.yml)/CMakeLists.txt"
    try 'Zephyr: the module with stand-ins for zephyr_library_..., used by a program' use_stand_in zephyr \
        "$root"
    not_tried 'Zephyr: west build' 'Zephyr is in neither Debian nor PyPI'
}

rm -rf "$work"
mkdir -p "$work"
install_tools >"$work/tools.log" 2>&1 &
two_files
cmsis_pack
wait $! || tail -n 1 "$work/tools.log"
platformio
esp_idf
zephyr
echo "packaging: failed=$failed not_tried=$not_tried"
[ $failed -eq 0 ]
