/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: floating point, in a value that no interface shows. */
#include <stdint.h>

int32_t top(int32_t value);

int32_t top(int32_t value) { return (int32_t)((float)value / 3); /* expect: floating-point */ }
