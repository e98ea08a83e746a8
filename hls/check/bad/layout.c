/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: a struct that Bambu takes for an array of its first member's structs, and gives less memory than it has; with a word
 * before them it is an array of words. */
#include <stdint.h>

typedef struct pair {
    int32_t low;
    int32_t high;
} pair;

typedef struct pairs_first { /* expect: layout */
    pair pairs[2];
    int32_t count;
} pairs_first;

typedef struct count_first {
    int32_t count;
    pair pairs[2];
} count_first;

int32_t top(const int32_t a[4], int32_t at);

int32_t top(const int32_t a[4], int32_t at)
{
    pairs_first p;
    count_first c;
    p.pairs[at & 1].low = a[0];
    p.count = a[1];
    c.pairs[at & 1].high = a[2];
    c.count = a[3];
    return p.pairs[0].low + p.count + c.pairs[1].high + c.count;
}
