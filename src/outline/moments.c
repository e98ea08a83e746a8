/* SPDX-License-Identifier: Apache-2.0 */
/* Exact, additive moments of points, and the scatter matrix of a conic's monomials about their centre. */
#include <string.h>

#include "drogue/cholesky.h"
#include "drogue/ellipse.h"

void drogue_moments_clear(drogue_moments *m) { memset(m, 0, sizeof *m); }

/* v * c modulo 2^128 */
static drogue_s128 s128_scale(drogue_s128 v, int64_t c)
{
    drogue_s128 r = drogue_s128_mul((int64_t)v.lo, c);
    uint64_t carry = (uint64_t)v.hi * (uint64_t)c + ((int64_t)v.lo < 0 ? (uint64_t)c : 0u);
    r.hi = (int64_t)((uint64_t)r.hi + carry);
    return r;
}

/* Moments in one row: the sum of x^p y^q at index (p + q)(p + q + 1) / 2 + q. */
enum { MOMENTS = 15 };

static int moment(int p, int q) { return (p + q) * (p + q + 1) / 2 + q; }

/* Moments about the origin -> about c along one axis, exact. Intermediate sums may wrap modulo 2^128, the results fit. */
static void centre_along(drogue_s128 *s, int64_t c, int along_y)
{
    int fixed;
    int pass;
    int i;
    for (fixed = 0; fixed <= 4; fixed++) { /* binomial shift: repeated s_i -= c s_(i-1) */
        for (pass = 1; pass <= 4 - fixed; pass++) {
            for (i = 4 - fixed; i >= pass; i--) {
                drogue_s128 *to = &s[along_y ? moment(fixed, i) : moment(i, fixed)];
                drogue_s128 from = s[along_y ? moment(fixed, i - 1) : moment(i - 1, fixed)];
                *to = drogue_s128_sub(*to, s128_scale(from, c));
            }
        }
    }
}

static void spread_moments(drogue_s128 *s, const drogue_moments *m)
{
    s[0] = drogue_s128_from_s64(m->n);
    s[1] = drogue_s128_from_s64(m->m10);
    s[2] = drogue_s128_from_s64(m->m01);
    s[3] = drogue_s128_from_s64(m->m20);
    s[4] = drogue_s128_from_s64(m->m11);
    s[5] = drogue_s128_from_s64(m->m02);
    s[6] = drogue_s128_from_s64(m->m30);
    s[7] = drogue_s128_from_s64(m->m21);
    s[8] = drogue_s128_from_s64(m->m12);
    s[9] = drogue_s128_from_s64(m->m03);
    s[10] = m->m40;
    s[11] = m->m31;
    s[12] = m->m22;
    s[13] = m->m13;
    s[14] = m->m04;
}

/* Monomials in the order of elimination: 1, x, y, then x^2, xy, y^2. */
static const uint8_t power_x[6] = {0, 1, 0, 2, 1, 0};
static const uint8_t power_y[6] = {0, 0, 1, 0, 1, 2};

int drogue_moments_scatter(drogue_wide scatter[21], int64_t centre[2], const drogue_moments *m)
{
    drogue_s128 s[MOMENTS];
    int swap;
    int i;
    int j;
    centre[0] = drogue_div_round_s64(m->m10, m->n);
    centre[1] = drogue_div_round_s64(m->m01, m->n);
    spread_moments(s, m);
    centre_along(s, centre[0], 0);
    centre_along(s, centre[1], 1);
    swap = drogue_s128_cmp(s[moment(2, 0)], s[moment(0, 2)]) < 0;
    for (i = 0; i < 6; i++) {
        for (j = 0; j <= i; j++) {
            int p = power_x[i] + power_x[j];
            int q = power_y[i] + power_y[j];
            const drogue_s128 *sum = &s[swap ? moment(q, p) : moment(p, q)];
            drogue_wide_set_s128(&scatter[DROGUE_PACKED(i, j)], sum->hi, sum->lo, 0);
        }
    }
    return swap;
}
