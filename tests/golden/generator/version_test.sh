#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Does version.sh notice what it should, in a repository made for it? Exit status 77 without git.
# usage: version_test.sh VERSION_SH
set -euo pipefail
script=$(realpath "$1")
command -v git >/dev/null || { echo 'version_test: skipped, there is no git here'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
status=0
checks=0
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null GIT_CEILING_DIRECTORIES=$work

# expect STATUS TEXT WHAT
expect() {
    local got=0
    "$script" "$work/tree" >"$work/out" 2>&1 || got=$?
    checks=$((checks + 1))
    if [ "$got" != "$1" ] || ! grep -qF -- "$2" "$work/out"; then
        echo "version_test: $3: exit status $got, expected $1 and '$2':"
        cat "$work/out"
        status=1
    fi
}

commit() {
    git add -A
    git -c user.name=test -c user.email=test@example.invalid commit -qm "$1"
}

bump() {
    echo "$1" >vectors/VERSION
    echo "- Vectors $1: a reason." >>CHANGELOG.md
}

mkdir -p tree/vectors/quality tree/vectors/frame
cd tree
echo '# Changelog' >CHANGELOG.md
expect 0 'no git history' 'no repository'
git init -q -b main
echo nothing >other
commit 'before the vectors'
echo 1.0.0 >vectors/VERSION
echo 00000001 >vectors/quality/one.ellipse.hex
echo 00000002 >vectors/quality/one.quality.out.hex
echo 00000002 >vectors/quality/two.quality.ref.hex
echo picture >vectors/frame/demo.png
echo image >vectors/frame/one.image.png
commit vectors
expect 0 'no vectors in' 'vectors are new'
echo text >vectors/README.md
echo other >vectors/frame/demo.png
commit 'text and picture'
expect 0 'no case changed' 'text and a picture for people'

echo 00000003 >vectors/quality/one.quality.out.hex
expect 1 'the major version did not grow: 1.0.0, now 1.0.0' 'a bit, not committed'
commit bits
expect 1 'vectors/quality/one.quality.out.hex first' 'a bit'
bump 1.1.0
git commit -q --amend -a --no-edit --author 'test <test@example.invalid>' 2>/dev/null ||
    git -c user.name=test -c user.email=test@example.invalid commit -q --amend -a --no-edit
expect 1 'the major version did not grow: 1.0.0, now 1.1.0' 'a bit with a minor version'
echo 2.0.0 >vectors/VERSION
git -c user.name=test -c user.email=test@example.invalid commit -q --amend -a --no-edit
expect 1 'no line of CHANGELOG.md names the vectors and 2.0.0' 'no line in the changelog'
bump 2.0.0
git -c user.name=test -c user.email=test@example.invalid commit -q --amend -a --no-edit
expect 0 'cases changed since' 'a bit with a major version'

echo 00000004 >vectors/quality/one.ellipse.hex
commit input
expect 1 'the major version did not grow' 'an input'
bump 3.0.0
rm vectors/quality/two.quality.ref.hex
commit removed
expect 0 'now 3.0.0' 'a case less'
echo 00000005 >vectors/quality/three.quality.out.hex
expect 1 'cases came since' 'a case more, not committed'
commit more
expect 1 'but the version did not grow: 3.0.0, now 3.0.0' 'a case more'
bump 3.1.0
commit minor
expect 0 'no case changed' 'the version alone'
git -c user.name=test -c user.email=test@example.invalid reset -q --soft HEAD~2
commit 'both at once'
expect 0 'now 3.1.0' 'a case more with a minor version'

git checkout -q -b work
echo 00000006 >vectors/quality/one.quality.out.hex
commit 'bits on a branch'
echo more >other
commit 'something else on the branch'
expect 1 'the major version did not grow: 3.1.0, now 3.1.0' 'a bit earlier on the branch'
bump 4.0.0
commit version
expect 0 'now 4.0.0' 'a branch with a major version'
bump 10.0.0
echo 00000007 >vectors/quality/one.quality.out.hex
commit 'many versions on'
expect 0 'now 10.0.0' 'versions are numbers, not text'
echo one >vectors/VERSION
expect 1 'is no version' 'no version at all'
if [ $status -eq 0 ]; then
    echo "version_test: $checks checks passed"
fi
exit $status
