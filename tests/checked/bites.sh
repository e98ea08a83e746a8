#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# usage: bites.sh PROGRAM: every violation is reported with file and line and fails; the clean run does not.
set -u
"$1" 0 >/dev/null || { echo "the clean run failed"; exit 1; }
for rule in 1 2 3 4 5; do
    said=$("$1" $rule 2>&1 >/dev/null) && { echo "violation $rule passed"; exit 1; }
    grep -q 'bites\.c:[0-9]*: ' <<<"$said" || { echo "violation $rule: no file and line in '$said'"; exit 1; }
done
echo "5 violations reported"
