/* SPDX-License-Identifier: Apache-2.0 */
/* Edges of opposite sense beside an outline: what they do to it is known for blurred bands, and put back. */
#include "suite.h"

#include "../../../src/outline/collection.h"

static drogue_pull_side sides[DROGUE_SUPPORT_BINS][DROGUE_PULL_SIDES];

enum { ROUND = 800 }; /* points round the outline, more than are looked at; each with its opposite one beside it */

static drogue_edge edges[2 * ROUND];

static const double blur = 1.333; /* px: of 0.6 px of optics, the smoothing, Sobel and the pixel */

/* How far beyond the edge of a band of two equal edges the grey changes fastest. */
static double beyond(double width)
{
    double low = 0, high = 3;
    int i;
    for (i = 0; i < 60; i++) { /* slope of exp(-x^2 / 2 s^2) - exp(-(x + w)^2 / 2 s^2), 0 at its peak */
        const double x = (low + high) / 2;
        const double slope =
            (x + width) * exp(-(x + width) * (x + width) / (2 * blur * blur)) - x * exp(-x * x / (2 * blur * blur));
        *(slope < 0 ? &high : &low) = x;
    }
    return low;
}

static drogue_edge edge_at(double xc, double yc, double radius, double turn, double gradient)
{
    drogue_edge e;
    memset(&e, 0, sizeof e);
    e.x_q5 = (uint16_t)lround(32 * (xc + radius * cos(turn)));
    e.y_q5 = (uint16_t)lround(32 * (yc + radius * sin(turn)));
    e.gx = (int16_t)lround(gradient * cos(turn));
    e.gy = (int16_t)lround(gradient * sin(turn));
    return e;
}

static drogue_ellipse circle(double xc, double yc, double radius)
{
    drogue_ellipse e;
    e.xc_px_q16 = q16_of(xc);
    e.yc_px_q16 = q16_of(yc);
    e.a_px_q16 = e.b_px_q16 = q16_of(radius);
    e.angle_rad_q16 = 0;
    return e;
}

/* A bright ring about (40, 41), its outer edge fitted; the inner one along part of it, from bin to bin. */
static void pull_of(drogue_support *s, double outer, double inner, uint32_t bins, const drogue_config *config)
{
    const drogue_ellipse fitted = circle(40, 41, outer);
    uint32_t count = 0;
    int i;
    memset(s, 0, sizeof *s);
    s->bright_bins = UINT32_MAX;
    for (i = 0; i < ROUND; i++) {
        const double turn = 2 * TEST_PI * (i + 0.5) / ROUND;
        const uint32_t k = (uint32_t)(i * DROGUE_SUPPORT_BINS / ROUND);
        edges[count] = edge_at(40, 41, outer, turn, -300);
        s->gradient += (uint64_t)(abs(edges[count].gx) + abs(edges[count].gy));
        s->points++;
        s->bin[k].count[1]++;
        count++;
        if ((bins >> k) & 1u) {
            edges[count++] = edge_at(40, 41, inner, turn, 300);
        }
    }
    drogue_outline_pull(s, sides, &fitted, edges, count, config);
}

/* Never less: no more is put back than was taken. */
START_TEST(a_band_is_as_wide_as_it_is)
{
    double width;
    drogue_config config;
    drogue_config_default(&config);
    for (width = 1.5; width < 6; width += 0.0625) {
        const double off = beyond(width);
        drogue_support s;
        drogue_ellipse e = circle(40, 41, 20 + off);
        pull_of(&s, 20 + off, 20 - width - off, UINT32_MAX, &config);
        drogue_outline_put_back(&e, s.pull_q24);
        MUST(real_of_q16(e.b_px_q16) - 20 > -0.01 && real_of_q16(e.a_px_q16) - 20 < 0.073,
             "%g px wide: %g, not 20 px; seen at %g", width, real_of_q16(e.a_px_q16), 20 + off);
        MUST(hypot(real_of_q16(e.xc_px_q16) - 40, real_of_q16(e.yc_px_q16) - 41) < 0.01, "%g px wide: moved", width);
    }
}
END_TEST

START_TEST(half_a_band_moves_the_centre)
{
    const double off = beyond(2.5);
    drogue_config config;
    drogue_support s;
    drogue_ellipse e = circle(40, 41, 20 + off);
    drogue_config_default(&config);
    pull_of(&s, 20 + off, 17.5 - off, 0x0000FFFFu, &config); /* along +v: below in the image */
    drogue_outline_put_back(&e, s.pull_q24);
    ck_assert(fabs(real_of_q16(e.yc_px_q16) - (41 - off * 2 / TEST_PI)) < 0.1 * off); /* of a half wave: 2 / pi */
    ck_assert(fabs(real_of_q16(e.xc_px_q16) - 40) < 0.01);
    ck_assert(fabs((real_of_q16(e.a_px_q16) + real_of_q16(e.b_px_q16)) / 2 - (20 + off / 2)) < 0.1 * off);
}
END_TEST

/* A unit that holds the reach, down to whole pixels; a band is as wide as what lies in it is scattered, and where nothing
 * does as narrow as it may be. */
START_TEST(units_and_bands)
{
    static const struct {
        int64_t reach;
        int bits;
    } cases[] = {{32768, 10},
                 {INT64_C(32) << 16, 9},
                 {INT64_C(2047) << 16, 4},
                 {INT64_C(32767) << 16, 0},
                 {INT64_C(40000) << 16, 0}};
    const drogue_ellipse e = circle(40, 41, 20);
    drogue_config config;
    drogue_collection c;
    drogue_support s;
    drogue_band band;
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_collection_begin(&c, &e, cases[i].reach);
        MUST((int)c.frac_bits == cases[i].bits, "case %d: %d bits", (int)i, (int)c.frac_bits);
    }
    drogue_config_default(&config);
    memset(&s, 0, sizeof s);
    band = drogue_band_of(DROGUE_Q16(4, 1), config.refit_cos_q16);
    s.points = 100; /* 0.04 semi-axes of scatter each, 0.8 px: three of them */
    s.squares_q32 = (int64_t)(100 * 0.04 * 0.04 * 4294967296.0);
    drogue_band_narrow(&band, &s, &e, &config);
    ck_assert_int_lt(abs(band.half_width_px_q16 - DROGUE_Q16(24, 10)), 100);
    s.points = 0;
    s.squares_q32 = 0;
    drogue_band_narrow(&band, &s, &e, &config);
    ck_assert_int_eq(band.half_width_px_q16, config.refit_band_px_q16 / 3 + 1);
}
END_TEST

START_TEST(nothing_beside_it)
{
    const drogue_ellipse was = circle(40, 41, 20);
    drogue_config config;
    drogue_support s;
    drogue_ellipse e = was;
    int i;
    drogue_config_default(&config);
    pull_of(&s, 20, 13, UINT32_MAX, &config); /* 7 px off: too far to matter */
    drogue_outline_put_back(&e, s.pull_q24);
    for (i = 0; i < 5; i++) {
        ck_assert_int_eq(s.pull_q24[i], 0);
    }
    ck_assert_int_eq(memcmp(&e, &was, sizeof e), 0);
    pull_of(&s, 20, 19, UINT32_MAX, &config); /* nearer than blur leaves two edges apart: noise */
    for (i = 0; i < 5; i++) {
        ck_assert_int_eq(s.pull_q24[i], 0);
    }
}
END_TEST

START_TEST(harmonics_of_any_ellipse)
{
    uint64_t rng = 4;
    int i;
    for (i = 0; i < 2000; i++) {
        const double a = rng_real(&rng, 10, 200), b = i % 7 == 0 ? a : a * rng_real(&rng, 0.4, 1),
                     turn = rng_real(&rng, -1.57, 1.57);
        drogue_ellipse e = circle(rng_real(&rng, 0, 500), rng_real(&rng, 0, 500), a);
        int32_t pull_q24[5];
        double m[5];
        int k;
        const double xc = real_of_q16(e.xc_px_q16), yc = real_of_q16(e.yc_px_q16);
        drogue_ellipse_frame frame;
        e.b_px_q16 = q16_of(b);
        e.angle_rad_q16 = q16_of(turn);
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

SUITE_MAIN("pull", a_band_is_as_wide_as_it_is, half_a_band_moves_the_centre, units_and_bands, nothing_beside_it,
           harmonics_of_any_ellipse)
