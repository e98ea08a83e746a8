/* SPDX-License-Identifier: Apache-2.0 */
/* Exact, additive moments of points, and the scatter matrix of a conic's monomials about their centre. */
#include <string.h>

#include "drogue/cholesky.h"
#include "drogue/ellipse.h"

#define STEEPEST (1 << 20) /* multiple of x or y taken from a monomial: sums of squares stay within 95 bits */

void drogue_moments_clear(drogue_moments *m) { memset(m, 0, sizeof *m); }

/* A 96-bit integer, two's complement, lowest word first. */
typedef struct s96 {
    uint32_t word[3];
} s96;

static void s96_set(s96 *out, int64_t high, uint64_t low)
{
    const uint64_t upper = (uint64_t)high + (low >> 32);
    out->word[0] = (uint32_t)low;
    out->word[1] = (uint32_t)upper;
    out->word[2] = (uint32_t)(upper >> 32);
}

static void s96_set_s64(s96 *out, int64_t v) { s96_set(out, v >> 32, (uint32_t)v); }

/* to -= c from, modulo 2^96; |c| <= 2^30 */
static void s96_subtract_multiple(s96 *to, const s96 *from, int32_t c)
{
    const int64_t low = (int64_t)c * from->word[0];
    const int64_t carry = (int32_t)(low >> 32) + (int32_t)(to->word[0] < (uint32_t)low);
    uint64_t upper = (uint64_t)to->word[2] << 32 | to->word[1];
    upper -= (uint64_t)((int64_t)c * from->word[1]) + (uint64_t)carry;
    to->word[0] -= (uint32_t)low;
    to->word[1] = (uint32_t)upper;
    to->word[2] = (uint32_t)(upper >> 32) - (uint32_t)c * from->word[2];
}

static void s96_copy(s96 *to, const s96 *from)
{
    to->word[0] = from->word[0];
    to->word[1] = from->word[1];
    to->word[2] = from->word[2];
}

static void s96_to_real(drogue_real *out, const s96 *v)
{
    const int64_t upper = (int64_t)((uint64_t)v->word[2] << 32 | v->word[1]);
    const int64_t lower = (int64_t)((uint64_t)v->word[1] << 32 | v->word[0]);
    if ((int32_t)v->word[2] == (int32_t)v->word[1] >> 31) {
        drogue_real_set(out, lower, 0);
    } else { /* the lowest word is below what is rounded */
        drogue_real_set(out, upper, 32);
    }
}

/* Moments in one row: the sum of x^p y^q at index (p + q)(p + q + 1) / 2 + q. */
enum { MOMENTS = 15 };

static int moment(int p, int q) { return (p + q) * (p + q + 1) / 2 + q; }

/* Moments about the origin -> about c along one axis, exact. Intermediate sums may wrap modulo 2^96, the results
 * fit. */
static void centre_along(s96 *s, int32_t c, int along_y)
{
    int fixed;
    int pass;
    int i;
    for (fixed = 0; fixed <= 4; fixed++) { /* binomial shift: repeated s_i -= c s_(i-1) */
        for (pass = 1; pass <= 4 - fixed; pass++) {
            s96 *to = &s[along_y ? moment(fixed, 4 - fixed) : moment(4 - fixed, fixed)];
            for (i = 4 - fixed; i >= pass; i--) {
                s96 *const from = to - (fixed + i + along_y); /* the moment of one less */
                s96_subtract_multiple(to, from, c);
                to = from;
            }
        }
    }
}

static void spread_moments(s96 *s, const drogue_moments *m)
{
    s96_set_s64(&s[0], m->n);
    s96_set_s64(&s[1], m->m10);
    s96_set_s64(&s[2], m->m01);
    s96_set_s64(&s[3], m->m20);
    s96_set_s64(&s[4], m->m11);
    s96_set_s64(&s[5], m->m02);
    s96_set_s64(&s[6], m->m30);
    s96_set_s64(&s[7], m->m21);
    s96_set_s64(&s[8], m->m12);
    s96_set_s64(&s[9], m->m03);
    s96_set(&s[10], m->m40.high, m->m40.low);
    s96_set(&s[11], m->m31.high, m->m31.low);
    s96_set(&s[12], m->m22.high, m->m22.low);
    s96_set(&s[13], m->m13.high, m->m13.low);
    s96_set(&s[14], m->m04.high, m->m04.low);
}

/* The moment of each product of two monomials, packed, in the order of elimination: 1, x, y, then x^2, xy, y^2; then
 * the same with x and y exchanged. */
static const uint8_t moment_of[2][21] = {
    {0, 1, 3, 2, 4, 5, 3, 6, 7, 10, 4, 7, 8, 11, 12, 5, 8, 9, 12, 13, 14},
    {0, 2, 5, 1, 4, 3, 5, 9, 8, 14, 4, 8, 7, 13, 12, 3, 7, 6, 12, 11, 10},
};

/* Take 'multiple' times monomial k < 3 from monomial i >= 3, in the exact sums: a congruence. */
static void take(s96 s[21], int i, int k, int32_t multiple)
{
    s96 *to = &s[DROGUE_PACKED(i, 0)];
    const s96 *from = &s[DROGUE_PACKED(k, 0)];
    int j;
    s96_subtract_multiple(&s[DROGUE_PACKED(i, i)], &s[DROGUE_PACKED(i, k)], multiple);
    s96_subtract_multiple(to, from, multiple);
    for (j = 1; j < 6; j++) {
        to += j <= i ? 1 : j; /* to (i, j), packed */
        from += j <= k ? 1 : j;
        s96_subtract_multiple(to, from, multiple);
    }
}

/* round(num / den), within what sums allow */
static int32_t multiple_of(const drogue_real *num, const drogue_real *den, int32_t most)
{
    drogue_real q;
    drogue_real_quotient(&q, num, den);
    return drogue_clamp_s32(drogue_real_to_s32(q, 0), -most, most);
}

/* Take from x^2, xy and y^2 what whole multiples of 1, x and y explain of them: what cancels here, most of it on a
 * short arc, is gone before anything is rounded. */
static void explain(s96 s[21], int32_t taken[3][3])
{
    drogue_real n;
    drogue_real xx;
    drogue_real xy;
    drogue_real yy;
    drogue_real det;
    int i;
    s96_to_real(&n, &s[DROGUE_PACKED(0, 0)]);
    s96_to_real(&xx, &s[DROGUE_PACKED(1, 1)]);
    s96_to_real(&xy, &s[DROGUE_PACKED(2, 1)]);
    s96_to_real(&yy, &s[DROGUE_PACKED(2, 2)]);
    drogue_real_determinant(&det, &xx, &yy, &xy, &xy);
    for (i = 0; i < 3; i++) {
        drogue_real by_x;
        drogue_real by_y;
        drogue_real t;
        s96_to_real(&by_x, &s[DROGUE_PACKED(3 + i, 1)]);
        s96_to_real(&by_y, &s[DROGUE_PACKED(3 + i, 2)]);
        drogue_real_determinant(&t, &yy, &by_x, &xy, &by_y);
        taken[i][1] = multiple_of(&t, &det, STEEPEST);
        drogue_real_determinant(&t, &xx, &by_y, &xy, &by_x);
        taken[i][2] = multiple_of(&t, &det, STEEPEST);
        take(s, 3 + i, 1, taken[i][1]);
        take(s, 3 + i, 2, taken[i][2]);
        s96_to_real(&t, &s[DROGUE_PACKED(3 + i, 0)]);
        taken[i][0] = multiple_of(&t, &n, 1 << 30);
        take(s, 3 + i, 0, taken[i][0]);
    }
}

int drogue_moments_scatter(drogue_scatter *out, const drogue_moments *m)
{
    s96 about[MOMENTS];
    s96 s[21];
    drogue_real xx;
    drogue_real yy;
    int swap;
    int i;
    out->centre[0] = (int32_t)drogue_div_round_s64(m->m10, m->n);
    out->centre[1] = (int32_t)drogue_div_round_s64(m->m01, m->n);
    spread_moments(about, m);
    centre_along(about, out->centre[0], 0);
    centre_along(about, out->centre[1], 1);
    s96_to_real(&xx, &about[moment(2, 0)]);
    s96_to_real(&yy, &about[moment(0, 2)]);
    swap = drogue_real_order(&xx, &yy) < 0;
    for (i = 0; i < 21; i++) {
        s96_copy(&s[i], &about[moment_of[swap][i]]);
    }
    explain(s, out->taken);
    for (i = 0; i < 21; i++) {
        s96_to_real(&out->entry[i], &s[i]);
    }
    return swap;
}
