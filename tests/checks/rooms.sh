#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# No stage knows one that comes after it: each file of the library includes what rooms.txt lets it.
# usage: rooms.sh [ROOT [LIST]]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=${1:-$here/../..}
list=$(realpath "${2:-$here/rooms.txt}")
. "$here/../../src/sources.sh"
{
    cd "$root"
    # A header without a folder is one beside the file.
    grep -oE '^ *# *include +"[^"]+"' $(core_files . '*.[ch]') include/drogue/*.h /dev/null |
        sed -nE 's/^((.*\/)?[^/:]+):.*"([^"]+)"$/\1 \2 \3/p' |
        awk '{ at = $1; sub(/^(src|include)\//, "", at); to = $3
               if (to !~ /\//) { to = $2 to; sub(/^(src|include)\//, "", to) }
               print "include", at, to }'
    { core_files . '*.[ch]' && ls include/drogue/*.h; } | sed -E 's/^(src|include)\//file /'
} | awk -v list="$list" '
    # room_of FILE: rank of its room, 0 when it has none
    function room_of(file, folder) {
        folder = file
        sub(/\/[^\/]*$/, "/*", folder)
        return file in rank ? rank[file] : folder in rank ? rank[folder] : 0
    }
    BEGIN {
        while ((getline line < list) > 0) {
            count = split(line, word, " ")
            if (count == 0 || word[1] ~ /^#/) { continue }
            rooms++
            name[rooms] = word[1]
            for (i = 2; i <= count; i++) { rank[word[i]] = rooms }
        }
        if (rooms == 0) { print "rooms: no rooms in " list; bad = 1 }
    }
    { files++ }
    $1 == "file" && !room_of($2) { print "rooms: " $2 " has no room in rooms.txt"; bad = 1 }
    $1 == "include" && !room_of($3) { print "rooms: " $2 " includes " $3 ", which has no room"; bad = 1 }
    $1 == "include" && room_of($3) > room_of($2) {
        print "rooms: " $2 " (" name[room_of($2)] ") includes " $3 " (" name[room_of($3)] "), which comes after it"
        bad = 1
    }
    END {
        if (files == 0) { print "rooms: no files"; bad = 1 }
        exit bad
    }'
