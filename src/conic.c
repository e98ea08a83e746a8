/* SPDX-License-Identifier: Apache-2.0 */
/* Centre, semi-axes and angle of an ellipse from its conic (paper (8), (9)). */
#include "drogue/ellipse.h"

/* Value of a length or coordinate in Q16; 0 return when it leaves the format. */
static int fits_q16(drogue_q16 *out, drogue_wide v)
{
    int64_t q = drogue_wide_to_s64(v, 16);
    *out = (drogue_q16)drogue_sat_s32(q);
    return *out == q;
}

drogue_status drogue_conic_ellipse(drogue_ellipse *out, const drogue_wide q[6], const int64_t centre[2], int frac_bits)
{
    drogue_wide trace = drogue_wide_add(q[3], q[5]);
    drogue_wide difference = drogue_wide_sub(q[5], q[3]);
    drogue_wide det = drogue_wide_sub(drogue_wide_scale(drogue_wide_mul(q[3], q[5]), 2), drogue_wide_mul(q[4], q[4]));
    drogue_wide x;
    drogue_wide y;
    drogue_wide f;
    drogue_wide larger; /* twice the larger eigenvalue of the quadratic part */
    int32_t angle_q29;
    int ok = 1;
    if (det.mantissa <= 0 || trace.mantissa <= 0) {
        return DROGUE_E_DEGENERATE;
    }
    x = drogue_wide_div(drogue_wide_sub(drogue_wide_mul(q[4], q[2]), drogue_wide_scale(drogue_wide_mul(q[5], q[1]), 1)),
                        det);
    y = drogue_wide_div(drogue_wide_sub(drogue_wide_mul(q[4], q[1]), drogue_wide_scale(drogue_wide_mul(q[3], q[2]), 1)),
                        det);
    /* minus the conic's value at its centre, doubled */
    f = drogue_wide_neg(drogue_wide_add(drogue_wide_scale(q[0], 1),
                                        drogue_wide_add(drogue_wide_mul(q[1], x), drogue_wide_mul(q[2], y))));
    if (f.mantissa <= 0) {
        return DROGUE_E_DEGENERATE;
    }
    larger = drogue_wide_add(
        trace, drogue_wide_sqrt(drogue_wide_add(drogue_wide_mul(difference, difference), drogue_wide_mul(q[4], q[4]))));
    ok &= fits_q16(&out->xc_px_q16,
                   drogue_wide_scale(drogue_wide_add(x, drogue_wide_from_s64(centre[0], 0)), -frac_bits));
    ok &= fits_q16(&out->yc_px_q16,
                   drogue_wide_scale(drogue_wide_add(y, drogue_wide_from_s64(centre[1], 0)), -frac_bits));
    ok &= fits_q16(&out->b_px_q16, drogue_wide_scale(drogue_wide_sqrt(drogue_wide_div(f, larger)), -frac_bits));
    /* the smaller eigenvalue is det / (4 * the larger): no cancellation */
    ok &= fits_q16(&out->a_px_q16,
                   drogue_wide_scale(drogue_wide_sqrt(drogue_wide_div(drogue_wide_mul(f, larger), det)), -frac_bits));
    angle_q29 = drogue_wide_atan2_q29(drogue_wide_neg(q[4]), difference);
    out->angle_rad_q16 = (drogue_q16)drogue_shr_round_s64(angle_q29, 14);
    if (out->angle_rad_q16 <= -DROGUE_Q16_HALF_PI) {
        out->angle_rad_q16 = DROGUE_Q16_HALF_PI;
    }
    if (out->a_px_q16 <= out->b_px_q16) {
        out->b_px_q16 = out->a_px_q16;
        out->angle_rad_q16 = 0; /* a circle has no angle */
    }
    return ok && out->b_px_q16 > 0 ? DROGUE_OK : DROGUE_E_DEGENERATE;
}
