/* SPDX-License-Identifier: Apache-2.0 */
/* The rim's outer edge about an outline: drawn bands whose edges are known. */
#include "suite.h"

#include "drogue/outline.h"

enum { LARGE = 700, MIDDLE = LARGE / 2 };

static uint8_t pixels[LARGE * LARGE];
static drogue_ray rays[DROGUE_RAYS];
static int32_t grown_q24[5];

/* An ellipse about the middle, and a band about it whose outer edge is so many px farther out, and a part of the
 * semi-axes, and shifted along the axes; on a part of the outline alone, or waving to and fro. */
typedef struct band {
    double a, b, angle, larger, share, u, v;
    int grey[3];               /* inside, of the band, outside */
    double from, span;         /* span 0: all about */
    double wave, lobes, noise; /* lobes 0: 9 */
    double blur;               /* px; 0: 0.7 */
    int taken;
} band;

static double width; /* of an edge */

static double step(double x) { return 0.5 * erfc(-x / width); }

static drogue_image draw(const band *s)
{
    const drogue_image view = {pixels, LARGE, LARGE, LARGE};
    uint64_t rng = 1;
    int x, y, i;
    width = s->blur > 0 ? sqrt(2) * s->blur : 1;
    for (y = 0; y < LARGE; y++) {
        for (x = 0; x < LARGE; x++) {
            const double c = cos(s->angle), z = sin(s->angle), dx = x - MIDDLE, dy = y - MIDDLE;
            const double u = c * dx + z * dy, v = c * dy - z * dx, turn = atan2(v / s->b, u / s->a);
            const double since = fmod(turn - s->from + 4 * TEST_PI, 2 * TEST_PI);
            const double nx = u / (s->a * s->a), ny = v / (s->b * s->b);
            const double level = hypot(u / s->a, v / s->b);
            const double d = (level - 1) * level / (hypot(nx, ny) + 1e-9); /* px outside, near it */
            const double grown = s->larger + s->share / hypot(cos(turn) / s->a, sin(turn) / s->b);
            const double out =
                grown + s->u * cos(turn) + s->v * sin(turn) + s->wave * sin((s->lobes > 0 ? s->lobes : 9) * turn);
            const double rim = s->span == 0 || since < s->span ? step(d - out) : step(d);
            double grey = s->grey[0] + (s->grey[1] - s->grey[0]) * step(d) + (s->grey[2] - s->grey[1]) * rim;
            for (i = 0; i < 4; i++) {
                grey += rng_real(&rng, -s->noise, s->noise);
            }
            pixels[y * LARGE + x] = (uint8_t)lround(fmin(fmax(grey, 0), 255));
        }
    }
    return view;
}

START_TEST(bands)
{
    static const band cases[] = {
        /* all about, of the outline's polarity, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 2.5, .grey = {60, 120, 200}, .taken = 1},
        /* of the other one, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 2.5, .grey = {60, 200, 120}, .taken = 1},
        /* about a bright inside, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 2.5, .grey = {200, 60, 140}, .taken = 1},
        /* far, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 4.8, .grey = {60, 200, 120}, .taken = 1},
        /* and too far */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 6.6, .grey = {60, 200, 120}},
        /* for all but a large outline, */
        {.a = 220, .b = 200, .angle = 0.3, .larger = 5.5, .grey = {60, 200, 120}, .taken = 1},
        /* and a flat one, of whose plane it is a circle */
        {.a = 200, .b = 150, .angle = 0.3, .share = 0.045, .grey = {60, 200, 120}, .taken = 1},
        /* of a flat one as wide everywhere */
        {.a = 200, .b = 150, .angle = 0.3, .larger = 4.6, .grey = {60, 200, 120}, .taken = 1},
        /* of a small one */
        {.a = 20, .b = 18, .angle = 0.3, .larger = 1.9, .grey = {60, 200, 120}, .taken = 1},
        /* of which an eighth is too far, */
        {.a = 20, .b = 18, .angle = 0.3, .larger = 2.6, .grey = {60, 200, 120}},
        /* and one that is too small */
        {.a = 16.4, .b = 15.8, .angle = 0.3, .larger = 1.9, .grey = {60, 200, 120}},
        /* on one side: what it has on the other one is both, */
        {.a = 60, .b = 56, .angle = 0.7, .larger = 1.3, .u = 1.3, .grey = {60, 200, 120}, .taken = 1},
        /* and across */
        {.a = 60, .b = 56, .angle = -0.9, .larger = 1.3, .v = -1.3, .grey = {60, 200, 120}, .taken = 1},
        /* in noise */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 2.5, .grey = {60, 200, 120}, .noise = 8, .taken = 1},
        /* none, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 0, .grey = {60, 200, 200}},
        /* nor in noise, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 0, .grey = {60, 200, 200}, .noise = 8},
        /* nor in that of a wide edge, */
        {.a = 60, .b = 54, .angle = 0.3, .grey = {60, 110, 110}, .noise = 1, .blur = 2.6},
        {.a = 42, .b = 40, .angle = 0.3, .grey = {60, 110, 110}, .noise = 1, .blur = 3},
        {.a = 50, .b = 40, .angle = 0.3, .grey = {60, 110, 110}, .noise = 1, .blur = 2.2},
        /* a faint one, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 2.5, .grey = {60, 200, 178}},
        /* that of a part, which is no ellipse, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 4, .grey = {60, 200, 120}, .from = 0.2, .span = 2},
        /* one that is beside the outline, not about it, */
        {.a = 60, .b = 56, .angle = 0.7, .u = 2.2, .grey = {60, 60, 200}},
        /* of none at all, */
        {.a = 60, .b = 54, .angle = 0.3, .larger = 2.7, .grey = {60, 200, 120}, .wave = 1.6},
        /* and the crests of a rim with lobes, which no ray has beside a trough */
        {.a = 220, .b = 200, .angle = 0.3, .grey = {60, 60, 200}, .wave = 2.5, .lobes = 33}};
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const band *s = &cases[i];
        const drogue_image view = draw(s);
        const drogue_ellipse was = {q16_of(MIDDLE), q16_of(MIDDLE), q16_of(s->a), q16_of(s->b), q16_of(s->angle)};
        const double x = MIDDLE + s->u * cos(s->angle) - s->v * sin(s->angle);
        const double y = MIDDLE + s->u * sin(s->angle) + s->v * cos(s->angle);
        const double a = s->a * (1 + s->share) + s->larger, b = s->b * (1 + s->share) + s->larger;
        const double within =
            s->u != 0 || s->v != 0 ? 0.4 : 0.35; /* where both edges are one they pull at each other */
        drogue_ellipse e = was;
        MUST(drogue_outline_outer(&e, grown_q24, rays, &view) == s->taken, "case %d: a = %g px", (int)i,
             real_of_q16(e.a_px_q16));
        if (!s->taken) {
            ck_assert_int_eq(memcmp(&e, &was, sizeof e), 0);
        } else {
            MUST(fabs(real_of_q16(e.a_px_q16) - a) < within && fabs(real_of_q16(e.b_px_q16) - b) < within &&
                     hypot(real_of_q16(e.xc_px_q16) - x, real_of_q16(e.yc_px_q16) - y) < within &&
                     fabs(real_of_q16(e.angle_rad_q16) - s->angle) < 0.1,
                 "case %d: a = %g px, b = %g, at (%g, %g) for (%g, %g)", (int)i, real_of_q16(e.a_px_q16),
                 real_of_q16(e.b_px_q16), real_of_q16(e.xc_px_q16), real_of_q16(e.yc_px_q16), x, y);
            MUST(fabs(ldexp((double)grown_q24[0], -24) * (s->a + s->b) +
                      ldexp((double)grown_q24[3], -24) * (s->a - s->b) + real_of_q16(e.a_px_q16 + e.b_px_q16) - s->a -
                      s->b) < 0.001 &&
                     fabs(hypot(ldexp((double)grown_q24[1], -24) * s->a, ldexp((double)grown_q24[2], -24) * s->b) -
                          hypot(real_of_q16(e.xc_px_q16) - MIDDLE, real_of_q16(e.yc_px_q16) - MIDDLE)) < 0.001,
                 "case %d: grown by %g of its size", (int)i, -ldexp((double)grown_q24[0], -24));
        }
    }
}
END_TEST

/* An outline of another shape than the rim has, as of a fit to both edges: the outer one is no circle about it. */
START_TEST(another_shape)
{
    static const band s = {.a = 58, .b = 56, .larger = 2, .grey = {60, 200, 120}};
    const drogue_image view = draw(&s);
    double longer;
    for (longer = -1; longer <= 1; longer += 0.5) {
        drogue_ellipse e = {q16_of(MIDDLE), q16_of(MIDDLE), q16_of(58 + longer), q16_of(56 - longer), 0};
        MUST(drogue_outline_outer(&e, grown_q24, rays, &view) == 1, "longer by %g px", longer);
        MUST(fabs(real_of_q16(e.a_px_q16) - 60) < 0.5 && fabs(real_of_q16(e.b_px_q16) - 58) < 0.5,
             "longer by %g px: %g by %g", longer, real_of_q16(e.a_px_q16), real_of_q16(e.b_px_q16));
    }
}
END_TEST

/* Whatever there is, of outlines as large and flat as may be: none is changed by more than an eighth of b a wave. */
START_TEST(any_image)
{
    static const drogue_image view = {pixels, 60, 60, LARGE};
    uint64_t rng = 7;
    int i, k;
    for (i = 0; i < 2000; i++) {
        const double a = rng_real(&rng, i % 4 ? 16 : 1, i % 4 ? 40 : 16000), b = rng_real(&rng, i % 4 ? 16 : 1, a);
        const drogue_ellipse was = {q16_of(rng_real(&rng, -20, 80)), q16_of(rng_real(&rng, -20, 80)), q16_of(a),
                                    q16_of(b), q16_of(rng_real(&rng, -1.5, 1.5))};
        drogue_ellipse e = was;
        for (k = 0; k < 60 * 60; k++) {
            const int x = k % 60, y = k / 60;
            const double ring = 90 * sin(hypot(x - 30, y - 30) * (0.4 + i % 7 * 0.2));
            pixels[y * LARGE + x] = (uint8_t)(i % 3 ? 128 + ring : rng_real(&rng, 0, 255));
        }
        if (!drogue_outline_outer(&e, grown_q24, rays, &view)) {
            ck_assert_int_eq(memcmp(&e, &was, sizeof e), 0);
        } else {
            MUST(e.a_px_q16 + e.b_px_q16 > was.a_px_q16 + was.b_px_q16 && e.b_px_q16 > was.b_px_q16 / 2 &&
                     e.a_px_q16 >= e.b_px_q16 && e.a_px_q16 < 2 * was.a_px_q16,
                 "%d: %g by %g to %g by %g", i, a, b, real_of_q16(e.a_px_q16), real_of_q16(e.b_px_q16));
        }
    }
}
END_TEST

SUITE_MAIN("outer", bands, another_shape, any_image)
