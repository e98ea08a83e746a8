/* SPDX-License-Identifier: Apache-2.0 */
/* Quality (10)-(15) and the membership of edge points against double precision. */
#include "suite.h"

#include "../../band_points.h"

#include "drogue/quality.h"
#include "geometry.h"

static drogue_ellipse random_ellipse(uint64_t *rng)
{
    ellipse_real e;
    e.xc = rng_real(rng, -200, 2200);
    e.yc = rng_real(rng, -200, 2200);
    e.a = exp(rng_real(rng, log(8.0), log(900.0)));
    e.b = e.a * rng_real(rng, 0.3, 1);
    e.angle = rng_real(rng, -TEST_PI / 2, TEST_PI / 2);
    return ellipse_to_q16(&e);
}

/* Coordinates in units of the semi-axes. */
static void model_frame(double *u, double *v, const ellipse_real *e, double x, double y)
{
    double dx = x - e->xc, dy = y - e->yc;
    *u = (dx * cos(e->angle) + dy * sin(e->angle)) / e->a;
    *v = (dy * cos(e->angle) - dx * sin(e->angle)) / e->b;
}

START_TEST(deviation_within_4_lsb)
{
    uint64_t rng = 1;
    double worst = 0;
    int i, k;
    for (i = 0; i < 5000; i++) {
        drogue_ellipse q = random_ellipse(&rng);
        ellipse_real e = ellipse_from_q16(&q);
        drogue_ellipse_frame frame;
        ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
        for (k = 0; k < 40; k++) {
            double x, y, u, v, scale = rng_real(&rng, 0, 2);
            ellipse_point(&x, &y, &e, rng_real(&rng, 0, 7));
            x = e.xc + scale * (x - e.xc);
            y = e.yc + scale * (y - e.yc);
            model_frame(&u, &v, &e, real_of_q16(q16_of(x)), real_of_q16(q16_of(y)));
            worst = fmax(
                worst, fabs(drogue_ellipse_deviation(&frame, q16_of(x), q16_of(y)) - 65536 * fabs(u * u + v * v - 1)));
        }
    }
    MUST(worst <= 4.0, "off by %.3f LSB", worst);
}
END_TEST

START_TEST(frame_saturates_far_away)
{
    const drogue_ellipse q = {0, 0, 65536, 65536, 0};
    drogue_ellipse_frame frame;
    int32_t u, v;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
    drogue_ellipse_frame_point(&u, &v, &frame, INT32_MAX, INT32_MIN);
    ck_assert_int_eq(u, 16 << 24);
    ck_assert_int_eq(v, -(16 << 24));
    ck_assert_int_eq(drogue_ellipse_deviation(&frame, INT32_MAX, INT32_MIN), 511 * 65536);
    drogue_ellipse_frame_point(&u, &v, &frame, 65536, 0);
    ck_assert_int_eq(u, 1 << 24);
    ck_assert_int_eq(v, 0);
}
END_TEST

START_TEST(frame_refuses_what_is_no_ellipse)
{
    drogue_ellipse_frame frame;
    drogue_ellipse q = {0, 0, 65536, 65536, 0};
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
    q.b_px_q16 = 65535;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
    q.b_px_q16 = 65537;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
    q.b_px_q16 = 0;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
    q.a_px_q16 = q.b_px_q16 = -65536;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
    q.a_px_q16 = q.b_px_q16 = 65536;
    q.angle_rad_q16 = DROGUE_Q16_HALF_PI;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
    q.angle_rad_q16 = 4 * 65536;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
    q.angle_rad_q16 = 0;
    q.xc_px_q16 = 1 << 30;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
    q.xc_px_q16 = 0;
    q.yc_px_q16 = -(1 << 30);
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_E_DOMAIN);
}
END_TEST

/* Points clearly inside or outside the band, gradients clearly within or beyond the angle. */
START_TEST(band_away_from_its_borders)
{
    uint64_t rng = 2;
    int i, k, held[2] = {0, 0}, refused = 0;
    for (i = 0; i < 4000; i++) {
        drogue_ellipse q = random_ellipse(&rng);
        ellipse_real e = ellipse_from_q16(&q);
        drogue_ellipse_frame frame;
        const drogue_q16 cos_q16 = q16_of(rng_real(&rng, 0.3, 0.98));
        drogue_band band = drogue_band_of(q16_of(rng_real(&rng, 0.3, fmin(3, 0.1 * e.b))), cos_q16);
        ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
        for (k = 0; k < 50; k++) {
            double x, y, u, v, gx, gy, nx, ny, n, f, distance, cosine, t = real_of_q16(band.half_width_px_q16);
            double offset = rng_real(&rng, -3, 3) * t, turn = rng_real(&rng, -1.5, 1.5),
                   strength = rng_real(&rng, 50, 1000);
            ellipse_point(&x, &y, &e, rng_real(&rng, 0, 7));
            n = hypot(x - e.xc, y - e.yc);
            x = real_of_q16(q16_of(x + offset * (x - e.xc) / n));
            y = real_of_q16(q16_of(y + offset * (y - e.yc) / n));
            model_frame(&u, &v, &e, x, y);
            nx = u * cos(e.angle) / e.a - v * sin(e.angle) / e.b;
            ny = u * sin(e.angle) / e.a + v * cos(e.angle) / e.b;
            n = hypot(nx, ny);
            gx = round(strength * cos(atan2(ny, nx) + turn) * (rng_range(&rng, 0, 3) ? 1 : -1));
            gy = round(strength * sin(atan2(ny, nx) + turn));
            f = u * u + v * v - 1;
            distance = fabs(f) / (2 * n);
            cosine = (gx * nx + gy * ny) / n / hypot(gx, gy);
            if (fabs(distance / t - 1) > 0.01 && fabs(fabs(cosine) - real_of_q16(cos_q16)) > 0.004) {
                int expected = distance < t && fabs(cosine) > real_of_q16(cos_q16);
                band_point p;
                MUST(!!place_holds(&p, &frame, &band, q16_of(x), q16_of(y), (int16_t)gx, (int16_t)gy) == expected,
                     "ellipse %d, point %d: distance %.4f of %.4f, cosine %.4f of %.4f", i, k, distance, t, cosine,
                     real_of_q16(cos_q16));
                if (expected) {
                    MUST(fabs(p.u_q14 / 16384.0 - u * e.b / e.a) < 2e-4 &&
                             fabs(p.v_q14 / 16384.0 - v * e.b / e.a) < 2e-4 &&
                             fabs(p.offset_q16 - 32768 * f) < 0.7 + 8 / e.b * e.a / e.b,
                         "ellipse %d, point %d: u %.6f, v %.6f, F %.6f, b %.1f", i, k, u, v, f, e.b);
                    MUST(p.polarity == (cosine > 0 ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT),
                         "ellipse %d, point %d: polarity %d at cosine %.4f", i, k, (int)p.polarity, cosine);
                    held[p.polarity]++;
                }
                refused += !expected;
            }
        }
    }
    ck_assert_int_gt(held[DROGUE_POLARITY_DARK], 10000);
    ck_assert_int_gt(held[DROGUE_POLARITY_BRIGHT], 3000);
    ck_assert_int_gt(refused, 10000);
}
END_TEST

/* A gradient along the outline, or none, is no edge of it; nor is a point inside half of the outline or outside 1.4 of
 * it, however wide the band. */
START_TEST(band_holds_no_gradient_across_and_no_point_far_off)
{
    const drogue_ellipse q = {100 * 65536, 100 * 65536, 20 * 65536, 10 * 65536, 0};
    const drogue_band any = drogue_band_of(8 * 65536, 0);
    drogue_ellipse_frame frame;
    band_point p;
    int32_t x;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
    ck_assert(place_holds(&p, &frame, &any, 120 * 65536, 100 * 65536, 1, 0));
    ck_assert_int_eq(p.polarity, DROGUE_POLARITY_DARK);
    ck_assert(place_holds(&p, &frame, &any, 120 * 65536, 100 * 65536, -1020, 1020));
    ck_assert_int_eq(p.polarity, DROGUE_POLARITY_BRIGHT);
    ck_assert(!place_holds(&p, &frame, &any, 120 * 65536, 100 * 65536, 0, 1020));
    ck_assert(!place_holds(&p, &frame, &any, 120 * 65536, 100 * 65536, 0, 0));
    for (x = 80; x <= 150; x++) {
        double u = (x - 100) / 20.0, distance = 20 * fabs(u * u - 1) / fmax(2 * fabs(u), 1e-9);
        ck_assert_int_eq(!!place_holds(&p, &frame, &any, x * 65536, 100 * 65536, x < 100 ? -500 : 500, 0),
                         u * u >= 0.25 && u * u <= 2 && distance <= 8);
    }
}
END_TEST

/* The share of the circumference that is covered stands in for l_r. */
START_TEST(quality_of_cover)
{
    const drogue_quality_config c = {65536, 6 * 65536, 19661};
    uint64_t rng = 5;
    int i;
    for (i = 0; i < 20000; i++) {
        drogue_ellipse e = random_ellipse(&rng);
        uint32_t total = (uint32_t)rng_range(&rng, 1, 8000), near_count = (uint32_t)rng_range(&rng, 0, (int32_t)total);
        drogue_quality by_points, by_cover, none;
        drogue_quality_score(&by_points, &e, near_count, total, &c);
        drogue_quality_of_cover(&by_cover, &e, drogue_quality_fit_ratio(near_count, total), by_points.length_ratio_q16,
                                &c);
        MUST(memcmp(&by_points, &by_cover, sizeof by_cover) == 0, "case %d", i);
        drogue_quality_of_cover(&none, &e, by_points.fit_ratio_q16, 0, &c);
        MUST(none.length_ratio_q16 == 0 &&
                 abs(by_cover.score_q16 - none.score_q16 - by_cover.length_ratio_q16 / 2) <= 1,
             "case %d: cover 0", i);
    }
}
END_TEST

START_TEST(circumference_within_4_lsb)
{
    uint64_t rng = 3;
    double worst = 0;
    drogue_ellipse e = {0, 0, 4096 * 65536, 4096 * 65536, 0};
    int i;
    for (i = 0; i < 200000; i++) {
        double a, b;
        e.a_px_q16 = (int32_t)exp(rng_real(&rng, 0, log(1600.0 * 65536)));
        e.b_px_q16 = rng_range(&rng, 0, e.a_px_q16);
        a = real_of_q16(e.a_px_q16);
        b = real_of_q16(e.b_px_q16);
        worst = fmax(worst, fabs(drogue_ellipse_circumference(&e) -
                                 65536 * TEST_PI * (3 * (a + b) - sqrt((3 * a + b) * (a + 3 * b)))));
    }
    MUST(worst <= 4.0, "off by %.3f LSB", worst);
    e.a_px_q16 = e.b_px_q16 = 6000 * 65536; /* saturates: 37699 px */
    ck_assert_int_eq(drogue_ellipse_circumference(&e), INT32_MAX);
    e.a_px_q16 = e.b_px_q16 = 0;
    ck_assert_int_eq(drogue_ellipse_circumference(&e), 0);
}
END_TEST

static double clamp01(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

/* Worst error of the five values; k1 in [0, most_k1], k2 in [0, most_k2]. */
static void check_scores(int32_t most_k1, int32_t most_k2)
{
    uint64_t rng = 4;
    double worst[5] = {0, 0, 0, 0, 0};
    int i, k;
    for (i = 0; i < 200000; i++) {
        drogue_ellipse e = random_ellipse(&rng);
        uint32_t total = (uint32_t)rng_range(&rng, 1, 8000), near_count = (uint32_t)rng_range(&rng, 0, (int32_t)total);
        drogue_quality_config c;
        drogue_quality got;
        double a, b, k1, k2, model[5], t;
        c.fit_error_px_q16 = 65536;
        c.k1_q16 = rng_range(&rng, 0, most_k1);
        c.k2_q16 = rng_range(&rng, 0, most_k2);
        a = real_of_q16(e.a_px_q16);
        b = real_of_q16(e.b_px_q16);
        k1 = real_of_q16(c.k1_q16);
        k2 = real_of_q16(c.k2_q16);
        model[0] = (double)near_count / total;
        model[1] = clamp01(total / (TEST_PI * (3 * (a + b) - sqrt((3 * a + b) * (a + 3 * b)))));
        model[2] = b / a;
        t = (model[2] - k2) / (1 - k2);
        model[3] = 0.5 * model[1] + (t <= 0 ? 0 : 0.5 * ((t - 1) * exp(-k1 * t) + 1));
        model[4] = 0.5 * model[3] + 0.5 * model[0];
        drogue_quality_score(&got, &e, near_count, total, &c);
        worst[0] = fmax(worst[0], fabs(got.fit_ratio_q16 - 65536 * model[0]));
        worst[1] = fmax(worst[1], fabs(got.length_ratio_q16 - 65536 * model[1]));
        worst[2] = fmax(worst[2], fabs(got.axis_ratio_q16 - 65536 * model[2]));
        worst[3] = fmax(worst[3], fabs(got.score_q16 - 65536 * model[3]));
        worst[4] = fmax(worst[4], fabs(got.reliability_q16 - 65536 * model[4]));
        for (k = 0; k < 5; k++) {
            const drogue_q16 v[5] = {got.fit_ratio_q16, got.length_ratio_q16, got.axis_ratio_q16, got.score_q16,
                                     got.reliability_q16};
            MUST(v[k] >= 0 && v[k] <= 65536, "case %d: value %d is %d", i, k, (int)v[k]);
        }
    }
    for (k = 0; k < 5; k++) {
        MUST(worst[k] <= 2.0, "value %d off by %.3f LSB", k, worst[k]);
    }
}

START_TEST(score_within_2_lsb_near_the_defaults) { check_scores(12 * 65536, 40000); }
END_TEST

START_TEST(score_within_2_lsb_over_the_documented_range) { check_scores(64 * 65536, 65535); }
END_TEST

START_TEST(score_at_the_ends)
{
    const drogue_quality_config c = {65536, 6 * 65536, 19661};
    const drogue_ellipse circle = {0, 0, 100 * 65536, 100 * 65536, 0}, flat = {0, 0, 100 * 65536, 30 * 65536, 0};
    drogue_quality q;
    drogue_quality_score(&q, &circle, 0, 1, &c);
    ck_assert_int_eq(q.fit_ratio_q16, 0);
    ck_assert_int_eq(q.axis_ratio_q16, 65536);
    drogue_quality_score(&q, &circle, 100000, 100000, &c);
    ck_assert_int_eq(q.length_ratio_q16, 65536); /* clamped */
    ck_assert_int_eq(q.score_q16, 65536);
    ck_assert_int_eq(q.reliability_q16, 65536);
    drogue_quality_score(&q, &flat, 0, 1, &c);
    ck_assert_int_le(q.score_q16 - q.length_ratio_q16 / 2, 1);        /* at k2 the axis ratio earns nothing */
    ck_assert_int_eq(drogue_quality_threshold(&circle, 65536), 1311); /* 2 / 100 */
    {                                                                 /* what is no ellipse is longer than anything */
        const drogue_ellipse inward[2] = {{0, 0, -1, 65536, 0}, {0, 0, 65536, -1, 0}};
        ck_assert_int_eq(drogue_ellipse_circumference(&inward[0]), DROGUE_Q16_MAX);
        ck_assert_int_eq(drogue_ellipse_circumference(&inward[1]), DROGUE_Q16_MAX);
    }
}
END_TEST

SUITE_MAIN("quality", deviation_within_4_lsb, frame_saturates_far_away, frame_refuses_what_is_no_ellipse,
           band_away_from_its_borders, band_holds_no_gradient_across_and_no_point_far_off, quality_of_cover,
           circumference_within_4_lsb, score_within_2_lsb_near_the_defaults,
           score_within_2_lsb_over_the_documented_range, score_at_the_ends)
