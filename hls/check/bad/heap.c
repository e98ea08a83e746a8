/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: memory from the heap. */
#include <stdlib.h>

int top(int value);

int top(int value)
{
    int *memory = malloc(sizeof *memory); /* expect: dynamic-memory */
    if (memory == NULL) {
        return 0;
    }
    *memory = value;
    return *memory;
}
