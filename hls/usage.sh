# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Sourced by scripts that have gone to the project's folder.

# usage, of a wrong call: the usage line of the script's own head, without what it says behind it; exit status 2
usage() {
    (cd "$OLDPWD" && sed -nE 's/^# (usage: .*)/\1/;T;s/ {3,}.*//;p' "$0") >&2
    exit 2
}
