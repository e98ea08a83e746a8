/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: an array whose length is an argument. */
int top(int count, int at);

int top(int count, int at)
{
    int memory[count]; /* expect: dynamic-memory */
    int i;
    for (i = 0; i < count; i++) {
        memory[i] = 3 * i;
    }
    return memory[at];
}
