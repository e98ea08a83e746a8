/* SPDX-License-Identifier: Apache-2.0 */
/* Bad: a function that comes back to itself by way of another; optimised, a loop would be left of it. */
int top(int n);

static int odd(int n);

static int even(int n) { return n == 0 ? 1 : odd(n - 1); }

static int odd(int n) { return n == 0 ? 0 : even(n - 1); } /* expect: recursion */

int top(int n) { return even(n); }
