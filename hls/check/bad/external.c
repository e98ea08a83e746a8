/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: what has no source here: a function of the C library, a variable of elsewhere, an instruction by its name. */
#include <stdint.h>
#include <stdio.h>

extern const int32_t elsewhere;

int32_t top(int32_t value);

int32_t top(int32_t value)
{
    puts("step");             /* expect: external */
    __asm__ volatile("nop");  /* expect: external */
    return value + elsewhere; /* expect: external */
}
