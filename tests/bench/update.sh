#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Puts the benchmark's tables into a page, between the lines that say so.
# usage: update.sh PAGE TABLE
set -euo pipefail
page=$1
table=$2
grep -q '^<!-- data: ./run bench --update -->$' "$page" || { echo "update.sh: $page has no place for tables" >&2 && exit 1; }
awk -v table="$table" '
    /^<!-- end of data -->$/ { skip = 0 }
    !skip
    /^<!-- data: .\/run bench --update -->$/ { while ((getline line < table) > 0) { print line } skip = 1 }
' "$page" >"$page.new"
mv "$page.new" "$page"
