#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A changed expected bit is a new major version. Compares the vectors with those of the commit before (on a branch: of
# the commit it left the main branch at): where a case's file changed or went, the major version in vectors/VERSION must
# have grown, where one came, the version; and a line of CHANGELOG.md must name the vectors and the version.
# usage: version.sh TREE [BASE]
set -uo pipefail
cd "$1" || exit 2
base=${2:-}
failed=0

note() { echo "version: $*"; }
complain() {
    note "$*"
    failed=1
}

# at TREE: VERSION there; TREE is a commit, or empty for the files as they are
at() {
    if [ -n "$1" ]; then
        git show "$1:./vectors/VERSION" 2>/dev/null
    elif [ -f vectors/VERSION ]; then
        cat vectors/VERSION
    fi
}

# changed FILTER FROM [TO]: case files in which two trees differ: stage/case.array.hex and the like
changed() {
    if [ -n "${3:-}" ]; then
        git diff --name-only --no-renames --diff-filter="$1" "$2" "$3" -- ./vectors
    else
        git diff --name-only --no-renames --diff-filter="$1" "$2" -- ./vectors
        case $1 in *A*) git ls-files --others --exclude-standard -- ./vectors ;; esac
    fi | grep -E '/[a-z]+/[A-Za-z0-9_-]+\.[a-z0-9]+(\.ref|\.out)?\.(hex|png)$'
}

# later A B: is version A later than B?
later() { [ "$1" != "$2" ] && [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | tail -n 1)" = "$1" ]; }

# compare FROM [TO]
compare() {
    local from=$1 to=${2:-} old new bits more
    old=$(at "$from")
    new=$(at "$to")
    if [ -z "$old" ]; then
        note "no vectors in $from: nothing to compare with"
        return
    fi
    if ! [[ $new =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]; then
        complain "vectors/VERSION is '$new', which is no version"
        return
    fi
    bits=$(changed MDT "$from" "$to")
    more=$(changed A "$from" "$to")
    if [ -z "$bits$more" ]; then
        note "no case changed since $from"
    elif [ -n "$bits" ] && ! later "${new%%.*}" "${old%%.*}"; then
        complain "expected bits changed since $from, $(wc -l <<<"$bits") files, $(head -n 1 <<<"$bits") first, but the major version did not grow: $old, now $new"
    elif ! later "$new" "$old"; then
        complain "cases came since $from, $(head -n 1 <<<"$more") first, but the version did not grow: $old, now $new"
    elif ! { [ -n "$to" ] && git show "$to:./CHANGELOG.md" || cat CHANGELOG.md; } 2>/dev/null |
        grep -i vectors | grep -wF -- "$new" >/dev/null; then # to its end: an early one breaks the pipe
        complain "no line of CHANGELOG.md names the vectors and $new"
    else
        note "cases changed since $from: $old, now $new"
    fi
}

if ! git rev-parse --git-dir >/dev/null 2>&1 || ! git rev-parse -q --verify HEAD >/dev/null 2>&1; then
    note 'no git history here: nothing to compare with'
    exit 0
fi
if [ -z "$base" ]; then
    head=$(git rev-parse HEAD)
    for branch in origin/HEAD origin/main origin/master main master; do
        fork=$(git merge-base HEAD "$branch" 2>/dev/null) || continue
        [ "$fork" = "$head" ] || base=$fork
        break
    done
    if [ -z "$base" ]; then
        base=$(git rev-parse -q --verify HEAD^)
    fi
elif ! git rev-parse -q --verify "$base^{commit}" >/dev/null; then
    note "there is no commit $base"
    exit 2
fi
if [ -n "$base" ]; then
    compare "$base" HEAD
else
    note 'the first commit, or a shallow clone: nothing to compare with'
fi
compare HEAD
exit $failed
