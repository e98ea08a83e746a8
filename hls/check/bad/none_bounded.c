/* SPDX-License-Identifier: Apache-2.0 */
/* Nothing bad and no comment needed: a constant, an argument, an early way out, a shift that runs empty, an infinite
 * loop of a function that is not called. */
#include <stdint.h>
#include <string.h>

uint32_t top(const uint32_t values[64], uint32_t count, uint32_t limit);
uint32_t never_called(const volatile uint32_t *ready);

uint32_t never_called(const volatile uint32_t *ready)
{
    while (*ready == 0) {}
    return *ready;
}

static uint32_t bits(uint32_t value)
{
    uint32_t n = 0;
    while (value != 0) {
        value >>= 1;
        n++;
    }
    return n;
}

uint32_t top(const uint32_t values[64], uint32_t count, uint32_t limit)
{
    uint32_t copy[64];
    uint32_t sum = 0;
    uint32_t i;
    uint32_t k;
    memcpy(copy, values, sizeof copy);
    for (i = 0; i < 64; i++) {
        sum += bits(copy[i]);
    }
    for (i = 0; i < count; i++) {
        for (k = i; k < 64; k++) {
            sum ^= copy[k];
            if (sum == limit) {
                return i;
            }
        }
    }
    return sum;
}
