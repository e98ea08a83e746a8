/* SPDX-License-Identifier: Apache-2.0 */
/* Centre, semi-axes and angle of an ellipse from its conic (paper (8), (9)). */
#include "drogue/ellipse.h"

#include <string.h>

/* Value of a length or coordinate (v + whole) 2^-frac_bits in Q16; 0 return when it leaves the format. */
static int fits_q16(drogue_q16 *out, const drogue_real *v, int32_t whole, int frac_bits)
{
    const int64_t limit = INT64_C(1) << 48;
    int64_t q = drogue_real_to_s64(*v, 16 - frac_bits);
    q = (q > limit ? limit : q < -limit ? -limit : q) + drogue_shl_s64(whole, 16 - frac_bits);
    *out = drogue_sat_s32(q);
    return *out == q;
}

/* a b - 2 c d */
static void minus_twice(drogue_real *out, const drogue_real *a, const drogue_real *b, const drogue_real *c,
                        const drogue_real *d)
{
    drogue_real twice;
    drogue_real_copy(&twice, c);
    drogue_real_shift(&twice, 1);
    drogue_real_determinant(out, a, b, &twice, d);
}

/* Numbers of a conic on the way to its ellipse. */
typedef struct conic {
    drogue_real det; /* 4 A C - B^2 */
    drogue_real centre[2];
    drogue_real f; /* minus its value at its centre, doubled */
    drogue_real difference;
    drogue_real larger; /* twice the larger eigenvalue of the quadratic part */
} conic;

static drogue_status describe(conic *out, const drogue_real q[6])
{
    drogue_real trace;
    drogue_real_sum(&trace, &q[3], &q[5]);
    drogue_real_difference(&out->difference, &q[5], &q[3]);
    drogue_real_copy(&out->larger, &q[3]);
    drogue_real_shift(&out->larger, 2);
    drogue_real_determinant(&out->det, &out->larger, &q[5], &q[4], &q[4]);
    if (out->det.mantissa <= 0 || trace.mantissa <= 0) {
        return DROGUE_E_DEGENERATE;
    }
    minus_twice(&out->centre[0], &q[4], &q[2], &q[5], &q[1]);
    minus_twice(&out->centre[1], &q[4], &q[1], &q[3], &q[2]);
    drogue_real_quotient(&out->centre[0], &out->centre[0], &out->det);
    drogue_real_quotient(&out->centre[1], &out->centre[1], &out->det);
    drogue_real_products(&out->larger, &q[1], &out->centre[0], &q[2], &out->centre[1]);
    drogue_real_copy(&out->f, &q[0]);
    drogue_real_shift(&out->f, 1);
    drogue_real_sum(&out->f, &out->f, &out->larger);
    drogue_real_negate(&out->f);
    drogue_real_products(&out->larger, &out->difference, &out->difference, &q[4], &q[4]);
    drogue_real_root(&out->larger, &out->larger);
    drogue_real_sum(&out->larger, &trace, &out->larger);
    return out->f.mantissa <= 0 ? DROGUE_E_DEGENERATE : DROGUE_OK;
}

drogue_status drogue_conic_ellipse(drogue_ellipse *out, const drogue_real q[6], const int32_t centre[2], int frac_bits)
{
    conic c;
    drogue_real t;
    int ok;
    if (describe(&c, q) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    ok = fits_q16(&out->xc_px_q16, &c.centre[0], centre[0], frac_bits);
    ok &= fits_q16(&out->yc_px_q16, &c.centre[1], centre[1], frac_bits);
    drogue_real_quotient(&t, &c.f, &c.larger);
    drogue_real_root(&t, &t);
    ok &= fits_q16(&out->b_px_q16, &t, 0, frac_bits);
    /* the smaller eigenvalue is det / (4 * the larger): no cancellation */
    drogue_real_product(&t, &c.f, &c.larger);
    drogue_real_quotient(&t, &t, &c.det);
    drogue_real_root(&t, &t);
    ok &= fits_q16(&out->a_px_q16, &t, 0, frac_bits);
    drogue_real_copy(&t, &q[4]);
    drogue_real_negate(&t);
    out->angle_rad_q16 = (drogue_q16)drogue_shr_round_s64(drogue_real_atan2_q29(t, c.difference), 14);
    if (out->angle_rad_q16 <= -DROGUE_Q16_HALF_PI) {
        out->angle_rad_q16 = DROGUE_Q16_HALF_PI;
    }
    if (out->a_px_q16 <= out->b_px_q16) {
        out->b_px_q16 = out->a_px_q16;
        out->angle_rad_q16 = 0; /* a circle has no angle */
    }
    return ok && out->b_px_q16 > 0 ? DROGUE_OK : DROGUE_E_DEGENERATE;
}

drogue_status drogue_shape_ellipse(drogue_ellipse *out, const drogue_real shape[3])
{
    static const int32_t origin[2] = {0, 0};
    drogue_real q[6]; /* (x, y) S^-1 (x, y)' = 1, times the determinant */
    drogue_status status;
    memset(out, 0, sizeof *out);
    drogue_real_set(&q[1], 0, 0);
    drogue_real_set(&q[2], 0, 0);
    drogue_real_copy(&q[3], &shape[2]);
    drogue_real_copy(&q[4], &shape[1]);
    drogue_real_shift(&q[4], 1);
    drogue_real_negate(&q[4]);
    drogue_real_copy(&q[5], &shape[0]);
    drogue_real_determinant(&q[0], &shape[1], &shape[1], &shape[0], &shape[2]);
    status = drogue_conic_ellipse(out, q, origin, 0);
    if (status != DROGUE_OK) {
        memset(out, 0, sizeof *out);
    }
    return status;
}
