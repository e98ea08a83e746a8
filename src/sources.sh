# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Sourced: the files that the library is made of, the host program's left out.

# core_files ROOT PATTERN: those whose names match, a line each
core_files() { find "$1/src" -name "$2" -not -path '*/src/cli/*' | sed 's|^\./||' | LC_ALL=C sort; }
