/* SPDX-License-Identifier: Apache-2.0 */
/* Nothing bad: the loop's end depends on data, and a comment says why it comes. */
#include <stdint.h>

uint32_t top(uint32_t label, const uint32_t parent[64], uint32_t a, uint32_t b);

uint32_t top(uint32_t label, const uint32_t parent[64], uint32_t a, uint32_t b)
{
    /* bound: 64, a label's parent is smaller than the label */
    while (parent[label & 63u] < label) {
        label = parent[label & 63u];
    }
    while (b != 0) { /* bound: 47, Euclid's algorithm on 32 bits */
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return label + a;
}
