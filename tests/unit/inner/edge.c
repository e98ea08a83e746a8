/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc by its own edge: place and size of drawn discs, what touches them, and images without one. */
#include "suite.h"

#include "drogue/inner.h"

#define SIDE 200

static uint8_t pixels[SIDE * SIDE];
static const drogue_image image = {pixels, SIDE, SIDE, SIDE};

/* A disc of grey 20 on 120, its edge 2 px wide. */
static void draw_disc(double xc, double yc, double radius)
{
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double t = fmin(1, fmax(0, (hypot(x - xc, y - yc) - radius) / 2 + 0.5));
            pixels[y * SIDE + x] = (uint8_t)lround(20 + 100 * t * t * (3 - 2 * t));
        }
    }
}

static void add_noise(uint64_t *rng, double sigma)
{
    int i, k;
    for (i = 0; i < SIDE * SIDE; i++) {
        double n = -6;
        for (k = 0; k < 12; k++) {
            n += rng_real(rng, 0, 1);
        }
        pixels[i] = (uint8_t)lround(fmin(255, fmax(0, pixels[i] + sigma * n)));
    }
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

static drogue_transfer transfer = DROGUE_TRANSFER_LINEAR;

static drogue_status find(drogue_inner_edge *out, const drogue_ellipse *discs, uint32_t count)
{
    const drogue_ellipse outline = circle(100, 100, 90);
    drogue_inner_expected expected;
    drogue_ray rays[DROGUE_RAYS];
    drogue_config config;
    drogue_config_default(&config);
    config.transfer = transfer;
    memset(&expected, 0, sizeof expected);
    memcpy(expected.disc, discs, count * sizeof *discs);
    expected.count = count;
    return drogue_inner_edge_find(out, rays, &image, &expected, &outline, &config);
}

START_TEST(place_and_size)
{
    uint64_t rng = 1;
    int i;
    for (i = 0; i < 200; i++) {
        const double xc = rng_real(&rng, 80, 120), yc = rng_real(&rng, 80, 120), radius = rng_real(&rng, 6, 40);
        const double away = rng_real(&rng, 0, 4), turn = rng_real(&rng, -3.14, 3.14), grown = rng_real(&rng, -0.5, 1.5);
        drogue_inner_edge e;
        drogue_ellipse discs[2];
        draw_disc(xc, yc, radius);
        discs[1] = circle(xc + away * cos(turn), yc + away * sin(turn), radius - grown);
        discs[0] = circle(xc + 3 * radius, yc, radius); /* the other pose's: nothing is there */
        MUST(find(&e, discs, 2) == DROGUE_OK, "case %d: not found", i);
        MUST(e.which == 1, "case %d: the other one", i);
        MUST(e.rays == DROGUE_RAYS, "case %d: %u rays", i, e.rays);
        MUST(hypot(real_of_q16(e.x_px_q16) - xc, real_of_q16(e.y_px_q16) - yc) < 0.04, "case %d: off by %g px", i,
             hypot(real_of_q16(e.x_px_q16) - xc, real_of_q16(e.y_px_q16) - yc));
        MUST(fabs(real_of_q16(e.grown_px_q16) - grown) < 0.15, "case %d: %g larger, not %g", i,
             real_of_q16(e.grown_px_q16), grown);
    }
}
END_TEST

/* An encoded blurred edge lies farther towards its dark side: of a picture that is known to be encoded the light's edge
 * is measured. */
START_TEST(an_encoded_disc_has_its_size)
{
    double off[2] = {0, 0};
    int i, encoded;
    for (i = 0; i < 40; i++) {
        const double radius = 8 + 0.8 * i;
        const drogue_ellipse disc = circle(100, 100, radius);
        drogue_inner_edge e;
        int k;
        draw_disc(100.3, 99.8, radius);
        for (k = 0; k < SIDE * SIDE; k++) {
            const double light = pixels[k] / 255.0;
            pixels[k] =
                (uint8_t)lround(255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055));
        }
        for (encoded = 0; encoded < 2; encoded++) {
            transfer = encoded ? DROGUE_TRANSFER_SRGB : DROGUE_TRANSFER_LINEAR;
            MUST(find(&e, &disc, 1) == DROGUE_OK, "radius %g: not found", radius);
            off[encoded] += real_of_q16(e.grown_px_q16) / 40;
            MUST(!encoded || fabs(real_of_q16(e.grown_px_q16)) < 0.15, "radius %g: %g larger", radius,
                 real_of_q16(e.grown_px_q16));
        }
        transfer = DROGUE_TRANSFER_LINEAR;
    }
    MUST(off[0] < off[1] - 0.1, "%g and %g px larger", off[0], off[1]);
}
END_TEST

START_TEST(noise_shows_in_the_standard_deviation)
{
    uint64_t rng = 2;
    double sum = 0;
    int i;
    for (i = 0; i < 100; i++) {
        const double xc = rng_real(&rng, 95, 105), yc = rng_real(&rng, 95, 105);
        const drogue_ellipse disc = circle(100, 100, 25);
        drogue_inner_edge e;
        draw_disc(xc, yc, 25);
        add_noise(&rng, 10);
        MUST(find(&e, &disc, 1) == DROGUE_OK, "case %d: not found", i);
        sum += (pow(real_of_q16(e.x_px_q16) - xc, 2) + pow(real_of_q16(e.y_px_q16) - yc, 2)) /
               pow(real_of_q16(e.std_px_q16), 2);
    }
    ck_assert_double_gt(sum / 200, 0.5);
    ck_assert_double_lt(sum / 200, 2);
}
END_TEST

START_TEST(what_touches_it_costs_rays_alone)
{
    int k;
    for (k = 0; k < 4; k++) {
        const drogue_ellipse disc = circle(101, 99, 24);
        drogue_inner_edge e;
        int x, y;
        draw_disc(100, 100, 24);
        for (y = 0; y < SIDE; y++) { /* a bar as dark as the disc, from its middle outwards */
            for (x = 0; x < SIDE; x++) {
                const int u = k == 0 ? x : k == 1 ? y : k == 2 ? SIDE - x : SIDE - y;
                const int v = k & 1 ? x : y;
                if (u > 100 && abs(v - 100) < 6) {
                    pixels[y * SIDE + x] = 20;
                }
            }
        }
        ck_assert_int_eq(find(&e, &disc, 1), DROGUE_OK);
        ck_assert_uint_lt(e.rays, 62);
        ck_assert_uint_gt(e.rays, 50);
        MUST(hypot(real_of_q16(e.x_px_q16) - 100, real_of_q16(e.y_px_q16) - 100) < 0.1, "bar %d: off by %g px", k,
             hypot(real_of_q16(e.x_px_q16) - 100, real_of_q16(e.y_px_q16) - 100));
    }
}
END_TEST

/* A black disc within a grey ring that light does not reach and a canopy that is lit from one side, blurred. */
static void draw_ringed(double xc, double yc, double ring_px, double light, double glare)
{
    int x, y, i, j;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            double sum = 0, weights = 0;
            for (i = -12; i <= 12; i++) {
                for (j = -12; j <= 12; j++) { /* a quarter of a pixel apart */
                    const double u = x + i / 4.0 - xc, v = y + j / 4.0 - yc, r = hypot(u, v);
                    const double weight = exp(-(i * i + j * j) / 16.0 / (2 * 0.8 * 0.8));
                    const double grey = r < 12 ? 14 : r < 12 + ring_px ? 110 : 170 + light * u / r;
                    sum += weight * grey;
                    weights += weight;
                }
            }
            pixels[y * SIDE + x] = (uint8_t)lround(fmin(255, sum / weights + glare * (x - xc + 12)));
        }
    }
}

START_TEST(neither_light_nor_a_ring_moves_it)
{
    const double rings[3] = {1.2, 2, 3};
    const drogue_ellipse disc = circle(100, 100, 12);
    drogue_inner_edge e;
    int k;
    for (k = 0; k < 3; k++) {
        draw_ringed(100.3, 99.8, rings[k], 40, 0);
        ck_assert_int_eq(find(&e, &disc, 1), DROGUE_OK);
        MUST(hypot(real_of_q16(e.x_px_q16) - 100.3, real_of_q16(e.y_px_q16) - 99.8) < 0.05, "ring of %g px: off by %g",
             rings[k], hypot(real_of_q16(e.x_px_q16) - 100.3, real_of_q16(e.y_px_q16) - 99.8));
    }
    draw_ringed(100.3, 99.8, 2, 0, 1.5); /* light over the disc, too */
    ck_assert_int_eq(find(&e, &disc, 1), DROGUE_OK);
    ck_assert(hypot(real_of_q16(e.x_px_q16) - 100.3, real_of_q16(e.y_px_q16) - 99.8) < 0.1);
}
END_TEST

/* A disc of radius 12, a ring about it as far as 'outer' about a centre (x, 0.7 x) aside, and what is about that, blurred. */
static void draw_collar(double outer, double x_aside, int disc, int ring, int beyond)
{
    int x, y, i, j;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            double sum = 0;
            for (i = -4; i <= 4; i++) {
                for (j = -4; j <= 4; j++) { /* a fifth of a pixel apart */
                    const double u = x + i / 5.0 - 100.3, v = y + j / 5.0 - 99.8;
                    sum += hypot(u, v) < 12 ? disc : hypot(u - x_aside, v - 0.7 * x_aside) < outer ? ring : beyond;
                }
            }
            pixels[y * SIDE + x] = (uint8_t)lround(sum / 81);
        }
    }
}

START_TEST(the_size_decides_between_two_edges)
{
    const double aside[4] = {0, 0.8, -1, 1.2};
    drogue_inner_edge e;
    int k;
    for (k = 0; k < 4; k++) {
        const drogue_ellipse disc = circle(99 + 0.3 * k, 101 - 0.4 * k, 12.1), collar = circle(99, 101, 17.6);
        draw_collar(15.5, aside[k], 20, 55, 150);
        ck_assert_int_eq(find(&e, &disc, 1), DROGUE_OK);
        MUST(fabs(real_of_q16(e.grown_px_q16)) < 0.7 &&
                 hypot(real_of_q16(e.x_px_q16) - 100.3, real_of_q16(e.y_px_q16) - 99.8) < 0.6,
             "disc %d: off by %g px, %g larger", k,
             hypot(real_of_q16(e.x_px_q16) - 100.3, real_of_q16(e.y_px_q16) - 99.8), real_of_q16(e.grown_px_q16));
        draw_collar(17.5, aside[k], 20, 115, 150); /* the steeper edge is the smaller one */
        ck_assert_int_eq(find(&e, &collar, 1), DROGUE_OK);
        MUST(fabs(real_of_q16(e.grown_px_q16)) < 0.5 && hypot(real_of_q16(e.x_px_q16) - 100.3 - aside[k],
                                                              real_of_q16(e.y_px_q16) - 99.8 - 0.7 * aside[k]) < 0.4,
             "outer %d: %g larger", k, real_of_q16(e.grown_px_q16));
    }
}
END_TEST

START_TEST(one_edge_of_another_size_stays)
{
    drogue_inner_edge e;
    const drogue_ellipse small = circle(101, 99, 10.8), large = circle(101, 99, 13.2);
    draw_disc(100, 100, 12);
    ck_assert_int_eq(find(&e, &small, 1), DROGUE_OK);
    ck_assert(fabs(real_of_q16(e.grown_px_q16) - 1.2) < 0.2);
    ck_assert_int_eq(find(&e, &large, 1), DROGUE_OK);
    ck_assert(fabs(real_of_q16(e.grown_px_q16) + 1.2) < 0.2);
}
END_TEST

/* Where one pose expects the disc there is a steeper edge, a part of a wall's or all of a disc of another size: the other
 * pose's disc is measured, too, and stands if it is whole and no larger than it should be. */
START_TEST(what_is_steeper_may_be_another_edge)
{
    const drogue_ellipse discs[2] = {circle(55, 100, 12), circle(130, 100, 12)};
    int k;
    for (k = 0; k < 6; k++) {
        const drogue_ellipse swapped[2] = {discs[1], discs[0]};
        const double radius = k == 3   ? 0
                              : k == 4 ? 13.2
                                       : 12; /* in one there is a wall alone, in one it is too large, */
        drogue_inner_edge e;
        int x, y;
        memset(pixels, 90, sizeof pixels);
        for (y = 0; y < SIDE; y++) {
            for (x = 0; x < SIDE; x++) {
                const double wall = hypot(x - 70, y - 100), disc = hypot(x - 130.5, y - 99.5);
                if (k == 1 ? hypot(x - 55, y - 100) < 9 : wall > 27 && x < 70) {
                    pixels[y * SIDE + x] = k == 1 ? 0 : 250;
                } else if (disc < radius && (k != 5 || y < 98)) { /* in one it is no half */
                    pixels[y * SIDE + x] = 60;
                }
            }
        }
        ck_assert_int_eq(find(&e, k == 2 ? swapped : discs, 2), DROGUE_OK);
        if (k >= 3) {
            MUST(real_of_q16(e.x_px_q16) < 110 && e.rays < 40, "case %d: %u rays at %g", k, e.rays,
                 real_of_q16(e.x_px_q16));
            continue;
        }
        MUST(e.which == (k != 2), "case %d: the other one", k);
        MUST(e.rays > 60, "case %d: %u rays", k, e.rays);
        MUST(hypot(real_of_q16(e.x_px_q16) - 130.5, real_of_q16(e.y_px_q16) - 99.5) < 0.1, "case %d: off", k);
    }
}
END_TEST

/* An outline seen nearly head-on whose shape is off puts both discs beside the one there is, which is whole between
 * them; of one too far from both nothing is said. */
START_TEST(what_lies_between)
{
    const drogue_ellipse discs[2] = {circle(91, 100, 24), circle(109, 100, 24)};
    const drogue_ellipse apart[2] = {circle(75, 100, 24), circle(125, 100, 24)};
    const drogue_inner_edge zero = {0};
    drogue_inner_edge e;
    int k;
    for (k = 0; k < 3; k++) {
        draw_disc(101, 99, k == 0 ? 24 : k == 1 ? 25.5 : 22.5);
        MUST(find(&e, discs, 2) == DROGUE_OK && e.rays == DROGUE_RAYS, "case %d", k);
        MUST(hypot(real_of_q16(e.x_px_q16) - 101, real_of_q16(e.y_px_q16) - 99) < 0.1, "case %d: at %g, %g", k,
             real_of_q16(e.x_px_q16), real_of_q16(e.y_px_q16));
        /* too far from both to be believed */
        MUST(find(&e, apart, 2) == DROGUE_E_NO_INNER_PART, "case %d, apart", k);
        ck_assert_int_eq(memcmp(&e, &zero, sizeof e), 0);
    }
}
END_TEST

/* Rays choose what rises, in noise as well; the grey beyond such an edge is that within it. */
START_TEST(no_disc_in_noise)
{
    const drogue_ellipse disc = circle(100, 100, 24);
    uint64_t rng = 77;
    drogue_inner_edge e;
    int k;
    for (k = 0; k < 20; k++) {
        memset(pixels, 60, sizeof pixels);
        add_noise(&rng, 4 + k);
        MUST(find(&e, &disc, 1) == DROGUE_E_NO_INNER_PART, "case %d: %u rays", k, e.rays);
    }
    draw_disc(100, 100, 24);
    add_noise(&rng, 20);
    ck_assert_int_eq(find(&e, &disc, 1), DROGUE_OK);
}
END_TEST

START_TEST(nothing_there)
{
    const drogue_ellipse disc = circle(100, 100, 24);
    drogue_inner_edge e;
    drogue_inner_edge zero;
    memset(&zero, 0, sizeof zero);
    memset(pixels, 90, sizeof pixels);
    ck_assert_int_eq(find(&e, &disc, 1), DROGUE_E_NO_INNER_PART);
    ck_assert_int_eq(memcmp(&e, &zero, sizeof e), 0);
    ck_assert_int_eq(find(&e, &disc, 0), DROGUE_E_NO_INNER_PART);
    draw_disc(100, 100, 24);
    {
        int i;
        for (i = 0; i < SIDE * SIDE; i++) { /* brighter inside */
            pixels[i] = (uint8_t)(255 - pixels[i]);
        }
    }
    ck_assert_int_eq(find(&e, &disc, 1), DROGUE_E_NO_INNER_PART);
}
END_TEST

START_TEST(rays_meet_the_edge)
{
    static drogue_ray rays[DROGUE_RAYS];
    const drogue_ellipse e = circle(100, 100, 30);
    int k;
    draw_disc(100, 100, 31);
    drogue_rays_cast(rays, &image, &e, 0, 4, 1, 6, DROGUE_RAY_RISES);
    for (k = 0; k < DROGUE_RAYS; k++) {
        ck_assert_uint_eq(rays[k].count, 1);
        MUST(fabs(real_of_q16(rays[k].edges[0].at_px_q16) - 1) < 0.1, "ray %d", k);
        ck_assert_int_lt(abs(rays[k].edges[0].level_q8 - 70 * 256), 12 * 256);
    }
    drogue_rays_cast(rays, &image, &e, DROGUE_Q16(2, 1), 4, 1, 190, DROGUE_RAY_LINES);
    for (k = 0; k < DROGUE_RAYS; k++) {
        ck_assert_int_eq(rays[k].step_px_q16,
                         DROGUE_Q16(1, 4)); /* where a fourth of 190 is enough of the 100 grey levels */
        ck_assert_uint_eq(rays[k].count, 1);
    }
    drogue_rays_cast(rays, &image, &e, DROGUE_Q16(18, 1), 4, 1, 190, DROGUE_RAY_LINES);
    for (k = 0; k < DROGUE_RAYS; k++) {
        ck_assert_int_ge(rays[k].step_px_q16, DROGUE_Q16(1, 2)); /* and half of it is needed */
        ck_assert_uint_eq(rays[k].count, 0);
    }
    drogue_rays_cast(rays, &image, &e, DROGUE_Q16(2, 1), 4, 1, 190, DROGUE_RAY_FINE_RISES);
    for (k = 0; k < DROGUE_RAYS; k++) {
        ck_assert_int_eq(rays[k].step_px_q16, DROGUE_Q16(1, 4));
        ck_assert_uint_eq(rays[k].count, 1);
    }
    for (k = 0; k < SIDE * SIDE; k++) { /* what falls does not rise */
        pixels[k] = (uint8_t)(255 - pixels[k]);
    }
    drogue_rays_cast(rays, &image, &e, DROGUE_Q16(2, 1), 4, 1, 190, DROGUE_RAY_FINE_RISES);
    for (k = 0; k < DROGUE_RAYS; k++) {
        ck_assert_uint_eq(rays[k].count, 0);
    }
    drogue_rays_cast(rays, &image, &e, DROGUE_Q16(1000, 1), 4, 1, 6, DROGUE_RAY_RISES);
    for (k = 0; k < DROGUE_RAYS; k++) {
        ck_assert_int_eq(rays[k].step_px_q16, DROGUE_Q16(16, 1)); /* from sample to sample */
    }
}
END_TEST

SUITE_MAIN("edge", place_and_size, an_encoded_disc_has_its_size, noise_shows_in_the_standard_deviation,
           what_touches_it_costs_rays_alone, neither_light_nor_a_ring_moves_it, the_size_decides_between_two_edges,
           one_edge_of_another_size_stays, what_is_steeper_may_be_another_edge, what_lies_between, no_disc_in_noise,
           nothing_there, rays_meet_the_edge)
