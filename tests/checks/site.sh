#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The site of pages and headers, build/site, by Doxygen without a warning; every page of docs/ is in it; what would leave a reader
# alone, something public without a word, a comment about a parameter that is gone, a dead link, is refused.
# usage: site.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
rm -rf build/site
mkdir -p build
doxygen docs/site/Doxyfile
for page in docs/*.md; do
    grep -q "\b$page\b" docs/site/Doxyfile || { echo "site: $page is not in docs/site/Doxyfile" && exit 1; }
    page=${page##*/}
    [ -e "build/site/${page%.md}.html" ] || { echo "site: $page has no page in build/site" && exit 1; }
done

# A copy with offences, of which each must be named.
tree=$(mktemp -d build/site-XXXXXX)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree/build"
for item in README.md docs hls include src tests vectors; do # links of pages lead into all of these
    cp -RP --link $item "$tree"
done
offences=0
reasons=()
# offend REASON FILE SED
offend() {
    sed "$3" "$2" >"$tree/changed"
    ! cmp -s "$2" "$tree/changed" || { echo "site: nothing changed in $2 by $3" && exit 1; }
    rm "$tree/$2" # a link to the true one
    mv "$tree/changed" "$tree/$2"
    reasons+=("$1")
    offences=$((offences + 1))
}
offend 'drogue_quite_new(int a) (function) of file pose.h is not documented' include/drogue/pose.h \
    's/^\/\* Choice between two poses/int drogue_quite_new(int a);\n\n&/'
offend 'drogue_plain is not documented' include/drogue/mask.h \
    's/^\/\* Circle family/typedef struct drogue_plain { int a; } drogue_plain;\n\n&/'
offend "argument 'ellipsis' of command @param is not found" include/drogue/outline.h 's/^ \*  workspace  /&\n *  ellipsis  gone/'
offend "unable to resolve reference to 'errors_of_drogue_undistort_point'" include/drogue/undistort.h '/^ \*  return  DROGUE_OK; DROGUE_E_DOMAIN as above/,/stretches/d'
offend "unable to resolve reference to 'docs/gone.md'" docs/method.md 's/(architecture.md)/(gone.md)/'
offend "unable to resolve reference to 'performance-gone'" docs/porting.md 's/#row-kernels/#gone/'
if output=$(cd "$tree" && doxygen docs/site/Doxyfile 2>&1); then
    echo 'site: offences are let through' && exit 1
fi
for reason in "${reasons[@]}"; do
    grep -qF -- "$reason" <<<"$output" || { printf "site: no word of '%s':\n%s\n" "$reason" "$output" && exit 1; }
done
echo "site: build/site, $(find build/site -name '*.html' | wc -l) pages; $offences offences, each refused"
