#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Puts the tables and the plot of a study of the related systems into their page.
# usage: page.sh REPORT_FOLDER PAGE
set -euo pipefail
[ $# -eq 2 ] || { echo 'usage: page.sh REPORT_FOLDER PAGE' >&2; exit 2; }
report=$1/report.md page=$2
for file in "$report" "$1/systems_z.png" "$page"; do
    [ -e "$file" ] || { echo "page.sh: $file is not there" >&2; exit 1; }
done
grep -q '^## All systems$' "$report" || { echo "page.sh: $report has no section 'All systems'" >&2; exit 1; }
for mark in begin end; do
    grep -q "^<!-- tables: $mark" "$page" || { echo "page.sh: $page has no line '<!-- tables: $mark'" >&2; exit 1; }
done
new=$(mktemp)
trap 'rm -f "$new"' EXIT
awk -v report="$report" '
    /^<!-- tables: end/ {
        keep = 0
        while ((getline line < report) > 0) {
            if (line == "## All systems") keep = 1
            if (keep) print line
        }
        print ""
        inside = 0
    }
    !inside { print }
    /^<!-- tables: begin/ { inside = 1; print "" }' "$page" >"$new"
cat "$new" >"$page"
cp "$1/systems_z.png" "$(dirname "$page")/systems_z.png"
echo "page.sh: $page holds the tables of $report"
