/* SPDX-License-Identifier: Apache-2.0 */
/* What lies beside an outline: drawn rings whose edge is known, fitted where the front end's blur shows it. */
#include "suite.h"

#include "../../../src/outline/collection.h"

enum { SIDE = 96 };

static const double optics2 = 0.36 + 1 / 12.0;            /* px^2: 0.6 px of optics, the pixel */
static const double all2 = 0.36 + 1 / 12.0 + 1 + 1 / 3.0; /* with the smoothing and Sobel's operator */

/* A ring about (xc, yc) whose outer edge is drawn at 'outer': bright, its grey falling by 'ramp' a pixel inwards, and dark
 * again within 'width'; both only where the row is at least 'from'. */
typedef struct ring {
    double outer, width, ramp, noise, xc, yc;
    int from, negative;
} ring;

static uint8_t pixels[SIDE * SIDE];
static drogue_ray rays[DROGUE_RAYS];

static double step(double x) { return 0.5 * erfc(-x / sqrt(2 * optics2)); }

static double bell(double x, double variance) { return exp(-x * x / (2 * variance)) / sqrt(2 * TEST_PI * variance); }

static double noise(uint64_t *rng, double std)
{
    double sum = 0;
    int i;
    for (i = 0; i < 12; i++) {
        sum += rng_real(rng, -0.5, 0.5);
    }
    return std * sum;
}

static drogue_image draw(const ring *r, uint64_t seed)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double d = hypot(x - r->xc, y - r->yc), within = r->outer - d;
            const int beside = y >= r->from;
            double grey = 60 + 100 * step(within);
            grey -= beside ? r->ramp * (within * step(within) + optics2 * bell(within, optics2)) : 0;
            grey -= beside && r->width > 0 ? 100 * step(within - r->width) : 0;
            grey += noise(&seed, r->noise);
            pixels[y * SIDE + x] = (uint8_t)lround(fmin(fmax(r->negative ? 220 - grey : grey, 0), 255));
        }
    }
    return view;
}

static drogue_ellipse circle(double xc, double yc, double radius)
{
    const drogue_ellipse e = {q16_of(xc), q16_of(yc), q16_of(radius), q16_of(radius), 0};
    return e;
}

/* Fitted about the ring's centre. */
static drogue_outline fitted_at(const ring *r, double radius)
{
    const int bright = !r->negative;
    drogue_outline o;
    uint32_t k;
    memset(&o, 0, sizeof o);
    o.fitted = circle(r->xc, r->yc, radius);
    o.support.bright_bins = bright ? UINT32_MAX : 0;
    o.support.points = 320;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        o.support.bin[k].count[bright] = 10;
    }
    return o;
}

/* Radius less what drogue_undo_blur() adds. */
static double radius_of(const drogue_outline *o, const drogue_config *config)
{
    drogue_ellipse e = o->ellipse;
    drogue_undo_blur(&e, config);
    return 2 * real_of_q16(o->ellipse.a_px_q16) - real_of_q16(e.a_px_q16);
}

/* Slope of what is at a band's outer edge, of what follows it where the band is no ramp. */
static double slope(double x, double width, double ramp)
{
    const double inner = width > 0 ? bell(x + width, all2) : 0;
    return 100 * (bell(x, all2) - inner) - ramp * 0.5 * erfc(x / sqrt(2 * all2));
}

/* How far beyond the edge the front end sees it: the mean over where pixels lie, along rows and diagonals. */
static double beyond(double width, double ramp)
{
    double sum = 0;
    int i, k;
    for (i = 0; i < 200; i++) {
        const double apart = i < 100 ? 1 : sqrt(2);
        double at = 0, before, after, highest = -1;
        for (k = -2; k < 5; k++) {
            const double x = apart * (k + (i % 100 - 49.5) / 100);
            if (slope(x, width, ramp) > highest) {
                at = x;
                highest = slope(x, width, ramp);
            }
        }
        before = slope(at - apart, width, ramp);
        after = slope(at + apart, width, ramp);
        sum += at + apart * (after - before) / (2 * (2 * highest - before - after));
    }
    return sum / 200;
}

static int32_t largest(const drogue_outline *o)
{
    int32_t most = 0;
    int i;
    for (i = 0; i < 5; i++) {
        const int32_t c = o->support.pull_q24[i];
        most = (c < 0 ? -c : c) > most ? (c < 0 ? -c : c) : most;
    }
    return most;
}

enum { PLACES = 16 };

/* Pull at places between pixels, where it depends on how the ring lies on them; the mean radius, and the worst off. */
static double mean_radius(double *worst, ring r, double off)
{
    uint64_t rng = 5;
    double sum = 0;
    int i;
    drogue_config config;
    drogue_config_default(&config);
    *worst = 0;
    for (i = 0; i < PLACES; i++) {
        drogue_image view;
        drogue_outline o;
        double at, moved;
        r.xc = rng_real(&rng, 47, 48);
        r.yc = rng_real(&rng, 47, 48);
        r.outer = rng_real(&rng, 29, 31);
        r.negative = i % 2;
        view = draw(&r, 1);
        o = fitted_at(&r, r.outer + off);
        drogue_outline_pull(&o, rays, &view, &config);
        at = radius_of(&o, &config) - r.outer;
        sum += at;
        *worst = fabs(at) > *worst ? fabs(at) : *worst;
        moved = hypot(real_of_q16(o.ellipse.xc_px_q16) - r.xc, real_of_q16(o.ellipse.yc_px_q16) - r.yc);
        MUST(moved < 0.08, "place %d, %g wide: centre moved by %g", i, r.width, moved);
    }
    return sum / PLACES;
}

START_TEST(a_band_is_as_wide_as_it_is)
{
    double width;
    for (width = 2; width < 4.5; width += 0.25) {
        const ring r = {0, width, 0, 0, 0, 0, 0, 0};
        const double off = beyond(width, 0);
        double worst;
        const double mean = mean_radius(&worst, r, off);
        MUST(fabs(mean) < 0.02 + 0.25 * off && worst < 0.14, "%g px wide: off by %g, %g; was %g", width, mean, worst,
             off);
    }
}
END_TEST

/* A ramp of m a pixel on a step A moves the steepest place of an edge of blur s outwards by s^2 m / A, and where gradients a
 * pixel apart see it a fifth farther. */
START_TEST(shading_goes_back)
{
    double ramp;
    for (ramp = 0; ramp < 9; ramp += 1) {
        const ring r = {0, 0, ramp, 0, 0, 0, 0, 0};
        const double off = beyond(0, ramp);
        double worst;
        const double mean = mean_radius(&worst, r, off);
        MUST(fabs(mean) < 0.015 + 0.2 * off && worst < 0.03 + 0.4 * off, "%g a pixel: off by %g, %g; was %g", ramp,
             mean, worst, off);
    }
}
END_TEST

START_TEST(half_a_band_moves_the_centre)
{
    const double off = beyond(2.5, 0);
    const ring r = {30, 2.5, 0, 0, 47.3, 46.9, 47, 0};
    const drogue_image view = draw(&r, 1);
    drogue_outline o = fitted_at(&r, 30 + off / 2);
    drogue_config config;
    drogue_config_default(&config);
    o.fitted.yc_px_q16 = q16_of(r.yc + off * 2 / TEST_PI); /* of a half wave: 2 / pi */
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert(fabs(real_of_q16(o.ellipse.yc_px_q16) - r.yc) < 0.125 * off);
    ck_assert(fabs(real_of_q16(o.ellipse.xc_px_q16) - r.xc) < 0.01);
    ck_assert(fabs(radius_of(&o, &config) - 30) < 0.125 * off);
}
END_TEST

/* Of what noise alone makes of harmonics next to nothing is left, and little of a shading that it hides. */
START_TEST(no_more_than_noise)
{
    double moved = 0, left[2] = {0, 0};
    uint64_t seed;
    drogue_config config;
    drogue_config_default(&config);
    for (seed = 1; seed <= 100; seed++) {
        ring r = {30, 0, 0, 6, 47.3, 46.9, 0, 0};
        drogue_image view = draw(&r, seed);
        drogue_outline o = fitted_at(&r, 30);
        int i;
        drogue_outline_pull(&o, rays, &view, &config);
        for (i = 0; i < 5; i++) {
            moved += fabs(ldexp(o.support.pull_q24[i], -24)) * 30 / 500;
        }
        for (i = 0; i < 2; i++) { /* the same shading, with little noise and with much */
            r.ramp = 4;
            r.noise = i == 0 ? 1 : 20;
            view = draw(&r, seed);
            o = fitted_at(&r, 30 + beyond(0, 4));
            drogue_outline_pull(&o, rays, &view, &config);
            left[i] += ldexp(o.support.pull_q24[0], -24) * 30 / 100;
        }
    }
    MUST(moved < 0.01, "%g px at the mean", moved);
    MUST(left[0] > 0.75 * beyond(0, 4) && left[1] < 0.55 * beyond(0, 4), "of %g px %g and %g", beyond(0, 4), left[0],
         left[1]);
}
END_TEST

/* Without anything beside it next to nothing is moved, and from what was fitted, not from what is there. */
START_TEST(even_grey_moves_nothing)
{
    uint64_t rng = 6;
    double most = 0;
    int place;
    drogue_config config;
    drogue_config_default(&config);
    for (place = 0; place < 40; place++) {
        const ring r = {rng_real(&rng, 15, 40), 0, 0, 0, rng_real(&rng, 47, 48), rng_real(&rng, 47, 48), 0, 0};
        const drogue_image view = draw(&r, 1);
        drogue_outline o = fitted_at(&r, r.outer);
        drogue_ellipse undone;
        drogue_outline_pull(&o, rays, &view, &config);
        most += ldexp(largest(&o), -24) * r.outer / 40;
        MUST(ldexp(largest(&o), -24) * r.outer < 0.05, "place %d: %g px", place, ldexp(largest(&o), -24) * r.outer);
        undone = o.ellipse;
        drogue_outline_pull(&o, rays, &view, &config);
        ck_assert_int_eq(memcmp(&o.ellipse, &undone, sizeof undone), 0);
    }
    MUST(most < 0.012, "%g px at the mean", most);
}
END_TEST

START_TEST(only_where_the_outline_has_points)
{
    const ring r = {30, 2.5, 0, 0, 47.3, 46.9, 47, 0};
    const drogue_image view = draw(&r, 1);
    drogue_config config;
    drogue_outline o = fitted_at(&r, 30);
    uint32_t k;
    drogue_config_default(&config);
    for (k = 0; k < DROGUE_SUPPORT_BINS / 2; k++) { /* along +v: below */
        o.support.bin[k].count[1] = 0;
        o.support.bin[k].count[0] = 10; /* of the other sense: none of its own */
    }
    drogue_outline_pull(&o, rays, &view, &config);
    MUST(ldexp(largest(&o), -24) * 30 < 0.005, "%g px", ldexp(largest(&o), -24) * 30);
    o.support.points = 0;
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert_int_eq(largest(&o), 0);
}
END_TEST

/* Of the rim's outer edge along rays nothing is put back but blur, and what is in doubt stays. */
START_TEST(nothing_of_an_outer_edge)
{
    const ring r = {30, 2.5, 0, 0, 47.3, 46.9, 47, 0};
    const drogue_image view = draw(&r, 1);
    drogue_config config;
    drogue_outline o = fitted_at(&r, 30);
    drogue_outline without = o;
    int32_t k;
    drogue_config_default(&config);
    without.support.points = 0;
    drogue_outline_pull(&without, rays, &view, &config);
    o.outer = 1;
    for (k = 0; k < 5; k++) {
        o.support.pull_q24[k] = -3000 * (k + 1);
    }
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert_int_eq(memcmp(&o.ellipse, &without.ellipse, sizeof o.ellipse), 0);
    for (k = 0; k < 5; k++) {
        ck_assert_int_eq(o.support.pull_q24[k], -3000 * (k + 1));
    }
    o.outer = 0;
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert_int_ne(memcmp(&o.ellipse, &without.ellipse, sizeof o.ellipse), 0);
}
END_TEST

/* An eighth of the semi-axis at most, and no ellipse turned inside out; where there is none nothing is done. */
START_TEST(the_smallest)
{
    const ring r = {2.2, 1.2, 0, 0, 47.3, 46.9, 0, 0};
    const drogue_image view = draw(&r, 1);
    drogue_config config;
    double radius;
    int limited = 0;
    drogue_config_default(&config);
    for (radius = 1; radius < 5; radius += 0.125) {
        drogue_outline o = fitted_at(&r, radius);
        drogue_outline_pull(&o, rays, &view, &config);
        ck_assert_int_le(largest(&o), 1 << 21);
        ck_assert(o.ellipse.b_px_q16 > o.fitted.b_px_q16 / 2 && o.ellipse.a_px_q16 >= o.ellipse.b_px_q16);
        limited += largest(&o) == 1 << 21;
    }
    ck_assert_int_gt(limited, 0);
    {
        drogue_outline o = fitted_at(&r, 0.999);
        o.support.pull_q24[2] = 77;
        o.support.smear_px2_q16[1] = 88;
        drogue_outline_pull(&o, rays, &view, &config);
        ck_assert_int_eq(memcmp(&o.ellipse, &o.fitted, sizeof o.fitted), 0);
        ck_assert_int_eq(largest(&o), 0);
        ck_assert_int_eq(o.support.smear_px2_q16[1], 0);
    }
}
END_TEST

/* What is beyond the region's border reads as the border does: no edge there. */
START_TEST(across_the_border)
{
    const ring r = {30, 0, 0, 0, 47.3, 46.9, 0, 0};
    const drogue_image all = draw(&r, 1);
    const drogue_image view = {all.data, 76, SIDE, SIDE}; /* the outline's right end is cut at 77.5 */
    drogue_config config;
    drogue_outline o = fitted_at(&r, 30);
    drogue_config_default(&config);
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert(fabs(radius_of(&o, &config) - 30) < 0.02);
    ck_assert(fabs(real_of_q16(o.ellipse.xc_px_q16) - r.xc) < 0.02);
}
END_TEST

/* Of a checkerboard the front end's blur leaves waves of a pixel: peaks as high as others two slopes away, through which goes
 * no parabola. */
START_TEST(waves_of_a_pixel)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    const ring r = {0, 0, 0, 0, 47.3, 46.9, 0, 0};
    drogue_config config;
    double a, ratio;
    int x, y;
    drogue_config_default(&config);
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            pixels[y * SIDE + x] = ((x ^ y) & 1) != 0 ? 255 : 0;
        }
    }
    for (a = 5; a < 46; a += 0.0625) {
        for (ratio = 0.5; ratio <= 1; ratio += 0.05) {
            drogue_outline o = fitted_at(&r, a);
            o.fitted.b_px_q16 = q16_of(a * ratio);
            drogue_outline_pull(&o, rays, &view, &config);
            MUST(hypot(o.support.smear_px2_q16[0], o.support.smear_px2_q16[1]) > 32000 ||
                     ldexp(largest(&o), -24) * a * ratio < 1.2,
                 "a %g, b %g: %g px", a, a * ratio, ldexp(largest(&o), -24) * a * ratio);
        }
    }
}
END_TEST

/* --- levels that are encoded --- */

static double encoded(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055; }

static double decoded(double level) { return level <= 0.04045 ? level / 12.92 : pow((level + 0.055) / 1.055, 2.4); }

/* Level so far within a disc's edge, light of 0.6 before 0.05 or the other way round. */
static double level_within(double within, int bright)
{
    return encoded(bright ? 0.05 + 0.55 * step(within) : 0.6 - 0.55 * step(within));
}

/* Its slope with the front end's blur. */
static double encoded_slope(double within, int bright)
{
    double sum = 0, t;
    for (t = -6; t < 6; t += 0.05) {
        sum += level_within(within - t, bright) * t * bell(t, 4 / 3.0);
    }
    return fabs(sum);
}

/* How far beyond the edge the front end sees it, between pixels as along a row. */
static double encoded_beyond(int bright)
{
    double sum = 0, at;
    int i, k;
    for (i = 0; i < 50; i++) {
        double before, after, highest = -1;
        at = 0;
        for (k = -2; k <= 2; k++) {
            const double x = k + (i - 24.5) / 50, s = encoded_slope(-x, bright);
            at = s > highest ? x : at;
            highest = fmax(s, highest);
        }
        before = encoded_slope(1 - at, bright);
        after = encoded_slope(-1 - at, bright);
        sum += at + (after - before) / (2 * (2 * highest - before - after));
    }
    return sum / 50;
}

/* Mean error of a disc's radius at places between pixels, fitted where the front end sees its edge. */
static double encoded_error(int bright, drogue_transfer transfer)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    const double off = encoded_beyond(bright);
    uint64_t rng = 9;
    double sum = 0;
    drogue_config config;
    int i, x, y;
    drogue_config_default(&config);
    config.transfer = transfer;
    for (i = 0; i < PLACES; i++) {
        const ring r = {rng_real(&rng, 29, 31), 0, 0, 0, rng_real(&rng, 47, 48), rng_real(&rng, 47, 48), 0, !bright};
        drogue_outline o = fitted_at(&r, r.outer + off);
        for (y = 0; y < SIDE; y++) {
            for (x = 0; x < SIDE; x++) {
                pixels[y * SIDE + x] = (uint8_t)lround(255 * level_within(r.outer - hypot(x - r.xc, y - r.yc), bright));
            }
        }
        drogue_outline_pull(&o, rays, &view, &config);
        sum += radius_of(&o, &config) - r.outer;
    }
    return sum / PLACES;
}

START_TEST(encoded_levels_are_light)
{
    int bright;
    for (bright = 0; bright < 2; bright++) {
        const double told = encoded_error(bright, DROGUE_TRANSFER_SRGB);
        const double not_told = encoded_error(bright, DROGUE_TRANSFER_LINEAR);
        MUST(fabs(told) < 0.02, "%d: off by %g", bright, told);
        MUST(bright ? not_told > 0.1 : not_told < -0.1, "%d: off by %g", bright, not_told);
    }
}
END_TEST

/* Light of every level, between pixels and at the border. */
START_TEST(light_along_a_ray)
{
    const drogue_image view = {pixels, 16, 16, SIDE};
    drogue_ray ray;
    int32_t light[2];
    int k;
    memset(&ray, 0, sizeof ray);
    ray.nx_q14 = 1 << 14;
    ray.step_px_q16 = DROGUE_Q16(1, 2);
    ray.y_px_q16 = DROGUE_Q16(13, 4); /* a quarter of the row below */
    for (k = 0; k < 256; k++) {
        const double a = 65280 * decoded(k / 255.0), b = 65280 * decoded((255 - k) / 255.0);
        memset(pixels, 0, sizeof pixels);
        pixels[3 * SIDE + 14] = (uint8_t)k;
        pixels[3 * SIDE + 15] = (uint8_t)(255 - k);
        ray.x_px_q16 = 14 * DROGUE_Q16_ONE;
        drogue_ray_read_light(light, &ray, &view, 0, 2);
        MUST(fabs(light[0] - 0.75 * a) < 1.5 && fabs(light[1] - 0.375 * (a + b)) < 1.5, "level %d: %d, %d", k,
             (int)light[0], (int)light[1]);
        ray.y_px_q16 = 3 * DROGUE_Q16_ONE;
        ray.x_px_q16 = DROGUE_Q16(31, 2); /* the border stands */
        drogue_ray_read_light(light, &ray, &view, 0, 2);
        MUST(fabs(light[0] - b) < 1 && light[1] == light[0], "level %d: %d, %d", 255 - k, (int)light[0], (int)light[1]);
        ray.y_px_q16 = DROGUE_Q16(13, 4);
    }
}
END_TEST

/* A band about the outline shows in all parts, every time that it is looked at; a plain edge in none. */
START_TEST(another_edge_outside)
{
    drogue_config config;
    const ring r = {34, 3, 0, 0, 48, 47.5, 0, 0};
    const ring alone = {31, 0, 0, 0, 48, 47.5, 0, 1};
    drogue_image view = draw(&r, 1);
    drogue_outline o = fitted_at(&alone, 31); /* the band's inner edge: dark within */
    drogue_config_default(&config);
    drogue_outline_pull(&o, rays, &view, &config);
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert_uint_eq(o.support.outside, 8);
    view = draw(&alone, 1);
    drogue_outline_pull(&o, rays, &view, &config);
    ck_assert_uint_eq(o.support.outside, 0);
}
END_TEST

SUITE_MAIN("pull", encoded_levels_are_light, light_along_a_ray, a_band_is_as_wide_as_it_is, shading_goes_back,
           half_a_band_moves_the_centre, no_more_than_noise, even_grey_moves_nothing, only_where_the_outline_has_points,
           nothing_of_an_outer_edge, the_smallest, across_the_border, waves_of_a_pixel, another_edge_outside)
