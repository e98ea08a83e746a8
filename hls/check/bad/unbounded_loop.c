/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: loops that end when their data say so: a sequence, a chain of labels, a table without an end, a wait. */
#include <stdint.h>

uint32_t top(uint32_t value, const uint32_t parent[64], const uint8_t text[64], const volatile uint32_t *ready);

static uint32_t steps_to_one(uint32_t value)
{
    uint32_t steps = 0;
    while (value > 1) { /* expect: unbounded-loop */
        value = value % 2 == 0 ? value / 2 : 3 * value + 1;
        steps++;
    }
    return steps;
}

static inline uint32_t root(uint32_t label, const uint32_t parent[64])
{
    while (parent[label & 63u] != label) { /* expect: unbounded-loop */
        label = parent[label & 63u];
    }
    return label;
}

static inline uint32_t length(const uint8_t text[64])
{
    uint32_t i;
    for (i = 0; text[i] != 0; i++) {} /* expect: unbounded-loop */
    return i;
}

uint32_t top(uint32_t value, const uint32_t parent[64], const uint8_t text[64], const volatile uint32_t *ready)
{
    do { /* expect: unbounded-loop */
        value++;
    } while (*ready == 0);
    return steps_to_one(value) + root(value, parent) + length(text);
}
