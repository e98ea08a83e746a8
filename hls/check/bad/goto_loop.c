/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: a loop without a keyword and with two entries, so that it is no loop to most analyses. */
#include <stdint.h>

uint32_t top(uint32_t value);

uint32_t top(uint32_t value)
{
    if (value % 3 == 0) {
        goto middle;
    }
again: /* expect: unbounded-loop */
    value = value * 5 + 1;
middle:
    value = value ^ value >> 3;
    if (value % 7 != 0) {
        goto again;
    }
    return value;
}
