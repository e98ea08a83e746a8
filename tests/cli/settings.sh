# SPDX-License-Identifier: Apache-2.0
# --set and --help-config: each threshold of the library's configuration by its name, default and range.
. "$(dirname "$0")/common.sh"

# The table names every member of the structs in the headers, in whatever order.
run 0 --help-config
sed 1d out | awk '{ print $1 }' | sort >named
{
    cat "$root"/include/drogue/*.h >headers
    sed -n '/^typedef struct drogue_config {/,/^}/p' headers
    sed -n '/^typedef struct drogue_quality_config {/,/^}/p' headers | sed 's/ \([a-z_0-9]*;\)/ quality.\1/'
    sed -n '/^typedef struct drogue_cluster_config {/,/^}/p' headers | sed 's/ \([a-z_0-9]*;\)/ cluster.\1/'
} | tr '\n' ' ' | sed 's,/\*[^*]*\*/,,g;s/;/;\n/g' | sed -nE 's/.* ([a-z][a-z_0-9.]*);$/\1/p' | sed 's/_q16$//' |
    grep -vxE 'quality|cluster|.*drogue_.*' | sort >members
cmp named members || fail "named and existing thresholds differ: $(diff named members)"
checks=$((checks + 1))

# A default set again changes nothing; outside its range it is refused.
run 0 measure scene.png $camera $roi --json
cp out first
run 0 --help-config
sed 1d out | awk '{ print $1 "=" $2 }' >defaults
while read -r assignment; do
    run 0 measure scene.png $camera $roi --json --set "$assignment"
    cmp -s out first || fail "--set $assignment changes the answer"
    run 2 measure scene.png $camera $roi --set "${assignment%%=*}=-1"
    says "drogue: ${assignment%%=*}: "
done <defaults

run 1 measure scene.png $camera $roi --json --set min_axis_ratio=0.9 --set min_size=0.7
same "$(json status)" '"no_ellipse"'
run 0 measure scene.png $camera $roi --json --set transfer=1
if cmp -s out first; then fail "--set transfer=1 changes nothing"; fi
run 0 track frame00.png $camera $roi --set canny_low=10 --set canny_high=20
run 1 track frame00.png $camera $roi --set canny_low=9000 --set canny_high=9000 --set canny_least=9000
for bad in min_cover min_cover= =1 nonsense=1 min_cover=1.1 refit_rounds=17 refit_rounds=1.5 polarity=3 transfer=2 min_cover=0,5 canny_low=x; do
    run 2 measure scene.png $camera --set "$bad"
done
run 2 measure scene.png $camera --set canny_low=100
says 'contradict'
run 2 edges scene.png out.png --low 1 --high 2 --set canny_low=1

# Both completions know every option of the help.
run 0 --help
grep -oE '^ +(-[hV], )?--[a-z-]+|, --high' out | grep -oE -e '--[a-z-]+' | sort -u >options
for option in camera distortion roi drogue json csv overlay min-reliability set raw fps max-missed low high smooth \
    help-config help version; do
    grep -qx -e "--$option" options || fail "--help has no --$option"
done
if command -v bash >/dev/null; then
    PATH=$(dirname "$drogue"):$PATH bash -c '. "$1"; COMP_WORDS=(drogue measure --); COMP_CWORD=2; _drogue; printf "%s\n" "${COMPREPLY[@]}"' \
        - "$root/src/cli/completion/drogue" | sort -u | cmp - options || fail 'bash completion: other options than --help'
    PATH=$(dirname "$drogue"):$PATH bash -c 'compopt() { :; }; . "$1"; COMP_WORDS=(drogue measure --set min_cov); COMP_CWORD=3; _drogue; printf "%s\n" "${COMPREPLY[@]}"' \
        - "$root/src/cli/completion/drogue" >completed
    same "$(cat completed)" 'min_cover='
    checks=$((checks + 1))
fi

finish
