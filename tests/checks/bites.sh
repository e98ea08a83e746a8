#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The checks bite: a clean little library passes, and each deliberate offence is refused for its own reason.
# usage: bites.sh CC CXX
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cc=$1 cxx=$2
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree/src" "$tree/include/drogue"
failed=0
offences=0

run_check() {
    case $1 in
    symbols) "$here/symbols.sh" "$tree" "$cc" -O1 ;;
    symbols_arm) "$here/symbols.sh" "$tree" arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb -Os ;;
    core_rules) "$here/core_rules.sh" "$tree" ;;
    headers) "$here/headers.sh" "$tree" "$cc" "$cxx" ;;
    rooms) "$here/rooms.sh" "$tree" "$tree/rooms.txt" ;;
    esac
}

# refuses CHECK REASON FILE <code: the check must fail on the tree with that file, and say REASON
refuses() {
    local output
    cat >"$tree/$3"
    offences=$((offences + 1))
    if output=$(run_check "$1" 2>&1); then
        echo "bites: $1 let through what should give '$2'"
        failed=1
    elif ! grep -qF -- "$2" <<<"$output"; then
        printf "bites: %s refused, but without '%s':\n%s\n" "$1" "$2" "$output"
        failed=1
    fi
    rm "$tree/$3"
}

cat >"$tree/include/drogue/drogue.h" <<'E'
#ifndef DROGUE_H
#define DROGUE_H
#include "drogue/good.h"
#endif
E
cat >"$tree/include/drogue/good.h" <<'E'
#ifndef GOOD_H
#define GOOD_H
#include <stdint.h>
#ifdef __cplusplus
extern "C" {
#endif
/* A double, a float and malloc() in a comment offend nobody. */
int32_t drogue_good(const int32_t *const rows[3], int32_t divisor);
#ifdef __cplusplus
}
#endif
#endif
E
cat >"$tree/src/good.c" <<'E'
#include <string.h>
#include "drogue/good.h"
static const char *const names[] = {"1.0 float", "malloc"};
static int32_t twice(int32_t a) { return 2 * a; }
int32_t drogue_good(const int32_t *const rows[3], int32_t divisor)
{
    int32_t copy[64];
    memcpy(copy, rows[0], sizeof copy);
    return twice((*rows[1]) * (copy[0] / divisor)) + names[divisor & 1][0] + 0x1e5;
}
E
for check in symbols symbols_arm core_rules headers; do
    run_check $check || { echo "bites: $check refused the clean library"; failed=1; }
done

refuses symbols 'needs something foreign: malloc' src/bad.c <<'E'
#include <stdlib.h>
void *drogue_bad(void) { return malloc(4); }
E
refuses symbols 'needs something foreign: cbrt' src/bad.c <<'E'
double cbrt(double);
double drogue_bad(double a) { return cbrt(a); }
E
refuses symbols 'data that can change: counter' src/bad.c <<'E'
static int counter;
int drogue_bad(void) { return ++counter; }
E
refuses symbols 'data that can change: drogue_level' src/bad.c <<'E'
int drogue_level = 7;
E
refuses symbols 'section that can change or runs at start: .init_array' src/bad.c <<'E'
__attribute__((constructor)) static void bad(void) { __asm__ volatile(""); }
E
refuses symbols 'exported without prefix drogue_: helper' src/bad.c <<'E'
int helper(int a) { return a; }
E
refuses symbols_arm 'needs something foreign: __aeabi_fadd' src/bad.c <<'E'
float drogue_bad(float a, float b) { return a + b; }
E
refuses symbols_arm 'needs something foreign: __aeabi_dmul' src/bad.c <<'E'
double drogue_bad(double a, double b) { return a * b; }
E
refuses symbols_arm 'needs something foreign: __aeabi_i2d' src/bad.c <<'E'
int drogue_bad(int a) { return (int)((double)a * 1.5); }
E

refuses core_rules 'floating point: src/bad.c: double' src/bad.c <<'E'
int drogue_bad(int a) { return (int)((double)a); }
E
refuses core_rules 'floating point: include/drogue/bad.h: float' include/drogue/bad.h <<'E'
float drogue_bad(int a);
E
refuses core_rules 'floating literal' src/bad.c <<'E'
int drogue_bad(int a) { return (int)(a * 1.5); }
E
refuses core_rules 'floating literal' src/bad.c <<'E'
int drogue_bad(int a) { return (int)(a * 1e3); }
E
refuses core_rules '128-bit built-in' src/bad.c <<'E'
long drogue_bad(long a) { return (long)(((__int128)a * a) >> 64); }
E
refuses core_rules 'heap: src/bad.c: free' src/bad.c <<'E'
void free(void *);
void drogue_bad(void *a) { free(a); }
E
refuses core_rules 'system header: src/bad.c: #include <math.h>' src/bad.c <<'E'
#include <math.h>
E
refuses core_rules 'function pointer' src/bad.c <<'E'
int drogue_bad(int (
    *f)(int));
E
refuses core_rules 'call through a pointer: drogue_bad' src/bad.c <<'E'
typedef int function(int);
int drogue_bad(function *f) { return f(1); }
E
refuses core_rules 'recursion: drogue_bad drogue_bad' src/bad.c <<'E'
int drogue_bad(int a) { return a ? drogue_bad(a - 1) : 0; }
E
refuses core_rules 'recursion: tsort: src/bad.c:odd' src/bad.c <<'E'
static int odd(int a);
static int even(int a) { return a ? odd(a - 1) : 1; }
static int odd(int a) { return a ? even(a - 1) : 0; }
int drogue_bad(int a) { return even(a); }
E
refuses core_rules 'variable length array' src/bad.c <<'E'
int drogue_bad(int n) { int a[n]; a[0] = n; return a[0]; }
E

refuses headers 'drogue/bad.h does not compile as C99' include/drogue/bad.h <<'E'
#ifndef BAD_H
#define BAD_H
void drogue_bad(uint32_t a); /* <stdint.h> is missing */
#endif
E
refuses headers 'drogue/bad.h does not compile as C++11' include/drogue/bad.h <<'E'
#ifndef BAD_H
#define BAD_H
static inline char *drogue_bad(void *class) { return class; }
#endif
E
refuses headers 'drogue/bad.h does not compile as C99' include/drogue/bad.h <<'E'
typedef struct drogue_bad { int a; } drogue_bad; /* no guard */
E
refuses headers 'drogue/bad.h does not compile as C99' include/drogue/bad.h <<'E'
#ifndef BAD_H
#define BAD_H
static inline short drogue_bad(int a) { return a; }
#endif
E

refuses headers 'drogue/drogue.h does not bring drogue/bad.h' include/drogue/bad.h <<'E'
#ifndef BAD_H
#define BAD_H
void drogue_bad(void);
#endif
E

mkdir "$tree/src/lower" "$tree/src/upper"
printf '%s\n' 'good drogue/good.h good.c' 'lower lower/*' 'upper upper/*' 'all drogue/drogue.h' >"$tree/rooms.txt"
echo '#include "drogue/good.h"' >"$tree/src/upper/own.h"
echo '#include "own.h"' >"$tree/src/upper/fine.c"
run_check rooms || failed=1
refuses rooms 'lower/bad.c (lower) includes upper/own.h (upper), which comes after it' src/lower/bad.c <<'E'
#include "upper/own.h"
E
refuses rooms 'drogue/bad.h has no room' include/drogue/bad.h <<'E'
int drogue_bad;
E

if [ $failed -eq 0 ]; then
    echo "bites: $offences offences, each refused"
fi
exit $failed
