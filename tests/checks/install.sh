#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the library into an empty place and uses it from there, by find_package and by pkg-config.
# usage: install.sh ROOT CC
set -euo pipefail
root=$1 cc=$2
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

export PKG_CONFIG_PATH=$work/prefix/lib/pkgconfig
# shellcheck disable=SC2046 # flags are words
"$cc" -std=c99 "$consumer/main.c" $(pkg-config --cflags --libs drogue) -o "$work/by_pkg_config"
"$work/by_pkg_config" "$(pkg-config --modversion drogue)"
