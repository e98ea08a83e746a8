/* SPDX-License-Identifier: Apache-2.0 */
/* Harmonics of an ellipse's radius, put back: points of the moved ellipse lie on the one it was. */
#include "suite.h"

#include "../../../src/outline/harmonics.h"

START_TEST(harmonics_of_any_ellipse)
{
    uint64_t rng = 4;
    int i;
    for (i = 0; i < 2000; i++) {
        const double a = rng_real(&rng, 10, 200), b = i % 7 == 0 ? a : a * rng_real(&rng, 0.4, 1),
                     turn = rng_real(&rng, -1.57, 1.57);
        drogue_ellipse e = {q16_of(rng_real(&rng, 0, 500)), q16_of(rng_real(&rng, 0, 500)), q16_of(a), q16_of(b),
                            q16_of(turn)};
        int32_t pull_q24[5];
        double m[5];
        int k;
        const double xc = real_of_q16(e.xc_px_q16), yc = real_of_q16(e.yc_px_q16);
        drogue_ellipse_frame frame;
        for (k = 0; k < 5; k++) {
            m[k] = i % 12 < 5 && i % 12 != k ? 0 : rng_real(&rng, -0.004, 0.004); /* one alone, or all */
            pull_q24[k] = (int32_t)lround(ldexp(m[k], 24));
        }
        drogue_outline_put_back(&e, pull_q24);
        ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &e), DROGUE_OK);
        for (k = 0; k < 12; k++) { /* points that lie that far within the old ellipse lie on the new one */
            const double t = k * TEST_PI / 6,
                         r = 1 - (m[0] + m[1] * cos(t) + m[2] * sin(t) + m[3] * cos(2 * t) + m[4] * sin(2 * t));
            const double u = a * cos(t) * r, v = b * sin(t) * r;
            int32_t u_q24;
            int32_t v_q24;
            drogue_ellipse_frame_point(&u_q24, &v_q24, &frame, q16_of(xc + u * cos(turn) - v * sin(turn)),
                                       q16_of(yc + u * sin(turn) + v * cos(turn)));
            MUST(fabs(hypot(ldexp(u_q24, -24), ldexp(v_q24, -24)) - 1) < 3e-4, "case %d, point %d: %g", i, k,
                 hypot(ldexp(u_q24, -24), ldexp(v_q24, -24)) - 1);
        }
    }
}
END_TEST

SUITE_MAIN("harmonics", harmonics_of_any_ellipse)
