#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: vectors.sh CHECKED PLAIN VECTORS: prints the checked run's table; it must succeed with the plain run's digest.
set -euo pipefail
checked=$("$1" --vectors "$3") || { printf '%s\n' "$checked"; exit 1; }
printf '%s\n' "$checked" | sed -n '/^|/p; /^checked:/p'
digest() { grep -o 'digest=[0-9a-f]*' <<<"$1"; }
plain=$("$2" --vectors "$3")
[ "$(digest "$checked")" = "$(digest "$plain")" ] || { echo "digests differ"; exit 1; }
digest "$checked"
