# SPDX-License-Identifier: Apache-2.0
# Pragmas that make Bambu refuse a file, in what the preprocessor leaves for it: 'FILE:LINE: pragma: what' each. What only
# Vitis knows belongs between '#ifndef __BAMBU__' and '#endif'.
function complain(at, what) { print at ": pragma: " what }
/^# [0-9]+ "/ { number = $2 - 1; file = $3; gsub(/"/, "", file); next }
{ number++ }
/^[ \t]*$/ { next }
/^#pragma HLS / {
    at = file ":" number
    pragma = $0
    gsub(/ *= */, "=", pragma)
    if (pragma ~ /^#pragma HLS unroll/) unroll = at
    if (pragma ~ /^#pragma HLS pipeline/ && before ~ /(^|[^a-z_])(for|while|do)([^a-z_]|$)/) complain(at, "pipeline in a loop")
    if (pragma ~ /^#pragma HLS interface/ && (pragma !~ / mode=/ || pragma ~ /mode=s_axilite|port=return/))
        complain(at, "interface of Vitis's")
    next
}
{
    if (unroll != "" && $0 !~ /^[ \t]*(for|while|do)([^a-z_]|$)/) complain(unroll, "unroll not before a loop")
    unroll = ""
    before = $0
}
