/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: which function is called is known when it runs. */
int top(int which, int value);

static int twice(int value) { return 2 * value; }
static int half(int value) { return value / 2; }

int top(int which, int value)
{
    int (*const operators[2])(int) = {twice, half};
    return operators[which & 1](value); /* expect: indirect-call */
}
