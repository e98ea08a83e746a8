/* SPDX-License-Identifier: Apache-2.0 */
/* An image that only fits ellipses: the other stages must not be linked. Exits with 0 when the ellipse is right. */
#include "drogue/ellipse.h"

/* Points of (x - 3)^2 / 25^2 + (y + 2)^2 / 15^2 = 1, exact. */
static const int8_t points[][2] = {{28, -2},  {-22, -2},  {3, 13}, {3, -17},  {18, 10}, {18, -14},
                                   {-12, 10}, {-12, -14}, {23, 7}, {23, -11}, {-17, 7}, {-17, -11}};

static int equals(drogue_q16 value, int32_t whole) { return value == whole * DROGUE_Q16_ONE; }

int main(void)
{
    drogue_moments moments;
    drogue_ellipse ellipse;
    unsigned i;
    drogue_moments_clear(&moments);
    for (i = 0; i < sizeof points / sizeof points[0]; i++) {
        drogue_moments_add_point(&moments, points[i][0], points[i][1]);
    }
    return drogue_ellipse_fit(&ellipse, &moments, 0) == DROGUE_OK && equals(ellipse.xc_px_q16, 3) &&
                   equals(ellipse.yc_px_q16, -2) && equals(ellipse.a_px_q16, 25) && equals(ellipse.b_px_q16, 15) &&
                   ellipse.angle_rad_q16 == 0
               ? 0
               : 1;
}
