#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the library into an empty place and uses it from there, by find_package, by pkg-config and from C++; and from
# its sources by add_subdirectory. The version file refuses what is not compatible.
# usage: install.sh ROOT CC CXX
set -euo pipefail
root=$1 cc=$2 cxx=$3
consumer=$root/tests/checks/consumer
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export CC=$cc

cmake -S "$root" -B "$work/library" -G Ninja -DCMAKE_INSTALL_PREFIX="$work/prefix" -DCMAKE_INSTALL_LIBDIR=lib \
    -DDROGUE_BUILD_CLI=OFF -DDROGUE_BUILD_TESTS=OFF >/dev/null
cmake --build "$work/library" --target install >/dev/null
(cd "$work/prefix" && find . -type f | sort)

cmake -S "$consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/consumer" >/dev/null
ctest --test-dir "$work/consumer" --no-tests=error --output-on-failure

for wanted in 9.0 0.0.1; do
    if cmake -S "$consumer" -B "$work/refused" -G Ninja -DCMAKE_PREFIX_PATH="$work/prefix" -DWANTED=$wanted \
        >"$work/log" 2>&1 || ! grep -q "with requested version \"$wanted\"" "$work/log"; then
        cat "$work/log"
        echo "install: find_package(drogue $wanted) should be refused for its version"
        exit 1
    fi
done

cmake -S "$consumer" -B "$work/subdirectory" -G Ninja -DDROGUE_ROOT="$root" >/dev/null
cmake --build "$work/subdirectory" >/dev/null
ctest --test-dir "$work/subdirectory" --no-tests=error --output-on-failure

export PKG_CONFIG_PATH=$work/prefix/lib/pkgconfig
# shellcheck disable=SC2046 # flags are words
"$cc" -std=c99 "$consumer/main.c" $(pkg-config --cflags --libs drogue) -o "$work/by_pkg_config"
"$work/by_pkg_config" "$(pkg-config --modversion drogue)"
printf '#include <drogue/track.h>\nint main() { return drogue_status_name(DROGUE_OK)[0] != %so%s; }\n' "'" "'" >"$work/main.cpp"
# shellcheck disable=SC2046
"$cxx" -std=c++11 "$work/main.cpp" $(pkg-config --cflags --libs drogue) -o "$work/from_cxx"
"$work/from_cxx"
