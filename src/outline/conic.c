/* SPDX-License-Identifier: Apache-2.0 */
/* Centre, semi-axes and angle of an ellipse from its conic (paper (8), (9)). */
#include "drogue/ellipse.h"

/* Value of a length or coordinate v 2^-frac_bits in Q16; 0 return when it leaves the format. */
static int fits_q16(drogue_q16 *out, const drogue_wide *v, int frac_bits)
{
    int64_t q = drogue_wide_to_s64(*v, 16 - frac_bits);
    *out = (drogue_q16)drogue_sat_s32(q);
    return *out == q;
}

/* a b - 2 c d */
static void minus_twice(drogue_wide *out, const drogue_wide *a, const drogue_wide *b, const drogue_wide *c,
                        const drogue_wide *d)
{
    drogue_wide t;
    drogue_wide_product(&t, c, d);
    drogue_wide_shift(&t, 1);
    drogue_wide_product(out, a, b);
    drogue_wide_difference(out, out, &t);
}

/* Numbers of a conic on the way to its ellipse. */
typedef struct conic {
    drogue_wide det; /* 4 A C - B^2 */
    drogue_wide centre[2];
    drogue_wide f; /* minus its value at its centre, doubled */
    drogue_wide difference;
    drogue_wide larger; /* twice the larger eigenvalue of the quadratic part */
} conic;

static drogue_status describe(conic *out, const drogue_wide q[6])
{
    drogue_wide trace;
    drogue_wide b2;
    drogue_wide_sum(&trace, &q[3], &q[5]);
    drogue_wide_difference(&out->difference, &q[5], &q[3]);
    drogue_wide_product(&b2, &q[4], &q[4]);
    drogue_wide_product(&out->det, &q[3], &q[5]);
    drogue_wide_shift(&out->det, 2);
    drogue_wide_difference(&out->det, &out->det, &b2);
    if (out->det.mantissa <= 0 || trace.mantissa <= 0) {
        return DROGUE_E_DEGENERATE;
    }
    minus_twice(&out->centre[0], &q[4], &q[2], &q[5], &q[1]);
    minus_twice(&out->centre[1], &q[4], &q[1], &q[3], &q[2]);
    drogue_wide_quotient(&out->centre[0], &out->centre[0], &out->det);
    drogue_wide_quotient(&out->centre[1], &out->centre[1], &out->det);
    drogue_wide_products(&out->larger, &q[1], &out->centre[0], &q[2], &out->centre[1]);
    drogue_wide_copy(&out->f, &q[0]);
    drogue_wide_shift(&out->f, 1);
    drogue_wide_sum(&out->f, &out->f, &out->larger);
    drogue_wide_negate(&out->f);
    drogue_wide_product(&out->larger, &out->difference, &out->difference);
    drogue_wide_sum(&out->larger, &out->larger, &b2);
    drogue_wide_root(&out->larger, &out->larger);
    drogue_wide_sum(&out->larger, &trace, &out->larger);
    return out->f.mantissa <= 0 ? DROGUE_E_DEGENERATE : DROGUE_OK;
}

drogue_status drogue_conic_ellipse(drogue_ellipse *out, const drogue_wide q[6], const int64_t centre[2], int frac_bits)
{
    conic c;
    drogue_wide t;
    int ok;
    if (describe(&c, q) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    drogue_wide_set(&t, centre[0], 0);
    drogue_wide_sum(&t, &c.centre[0], &t);
    ok = fits_q16(&out->xc_px_q16, &t, frac_bits);
    drogue_wide_set(&t, centre[1], 0);
    drogue_wide_sum(&t, &c.centre[1], &t);
    ok &= fits_q16(&out->yc_px_q16, &t, frac_bits);
    drogue_wide_quotient(&t, &c.f, &c.larger);
    drogue_wide_root(&t, &t);
    ok &= fits_q16(&out->b_px_q16, &t, frac_bits);
    /* the smaller eigenvalue is det / (4 * the larger): no cancellation */
    drogue_wide_product(&t, &c.f, &c.larger);
    drogue_wide_quotient(&t, &t, &c.det);
    drogue_wide_root(&t, &t);
    ok &= fits_q16(&out->a_px_q16, &t, frac_bits);
    out->angle_rad_q16 =
        (drogue_q16)drogue_shr_round_s64(drogue_wide_atan2_q29(drogue_wide_neg(q[4]), c.difference), 14);
    if (out->angle_rad_q16 <= -DROGUE_Q16_HALF_PI) {
        out->angle_rad_q16 = DROGUE_Q16_HALF_PI;
    }
    if (out->a_px_q16 <= out->b_px_q16) {
        out->b_px_q16 = out->a_px_q16;
        out->angle_rad_q16 = 0; /* a circle has no angle */
    }
    return ok && out->b_px_q16 > 0 ? DROGUE_OK : DROGUE_E_DEGENERATE;
}
