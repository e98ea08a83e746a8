/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points counted and collected, against the public functions called one by one: as the library does it and as
 * hardware does. */
#include "suite.h"

#include "../../../src/outline/near.h"

#define drogue_near_count hardware_near_count
#define drogue_support_count hardware_support_count
#define drogue_collect_edges hardware_collect_edges
#include "../../../hls/outline/near.c"
#undef drogue_near_count
#undef drogue_support_count
#undef drogue_collect_edges
uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count);
void drogue_support_count(drogue_support *out, const drogue_ellipse_frame *frame, const drogue_band *band,
                          const drogue_edge *edges, uint32_t edge_count, uint32_t stride);
void drogue_collect_edges(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count,
                          const drogue_region_lens *lens);

enum { MOST = DROGUE_HLS_EDGES };

static drogue_edge edges[MOST];

/* What is collected from, and into. */
typedef struct scene {
    drogue_ellipse ellipse;
    drogue_ellipse_frame frame;
    drogue_band band;
    drogue_camera camera;
    drogue_region_lens lens;
    drogue_collection collection;
    drogue_support support;
    uint32_t count;
} scene;

static void draw_edge(drogue_edge *e, uint64_t *rng, const drogue_ellipse *l)
{
    const double t = rng_real(rng, 0, 2 * TEST_PI), off = 1 + rng_normal(rng) * 0.03,
                 turn = real_of_q16(l->angle_rad_q16);
    const double u = real_of_q16(l->a_px_q16) * cos(t) * off, v = real_of_q16(l->b_px_q16) * sin(t) * off;
    const double x = real_of_q16(l->xc_px_q16) + u * cos(turn) - v * sin(turn);
    const double y = real_of_q16(l->yc_px_q16) + u * sin(turn) + v * cos(turn);
    const double sign = rng_range(rng, 0, 5) == 0 ? -1 : 1, size = sign * rng_real(rng, 0, 700);
    const double nx = cos(t) / real_of_q16(l->a_px_q16), ny = sin(t) / real_of_q16(l->b_px_q16), n = hypot(nx, ny);
    const int lost = rng_range(rng, 0, 3) == 0; /* anywhere, any gradient */
    e->arc = DROGUE_NO_ARC;
    e->x_q5 = (uint16_t)(lost || x < 0 ? rng_range(rng, 0, UINT16_MAX) : (int)(x * 32));
    e->y_q5 = (uint16_t)(lost || y < 0 ? rng_range(rng, 0, UINT16_MAX) : (int)(y * 32));
    e->gx = (int16_t)(lost ? rng_range(rng, -1020, 1020) : (int)(size * (nx * cos(turn) - ny * sin(turn)) / n));
    e->gy = (int16_t)(lost ? rng_range(rng, -1020, 1020) : (int)(size * (nx * sin(turn) + ny * cos(turn)) / n));
}

static void draw_scene(scene *s, uint64_t *rng)
{
    const int wild = rng_range(rng, 0, 9) == 0; /* far from every region, or larger than any */
    const double a = exp(rng_real(rng, 0, wild ? 10.3 : 7)), ratio = rng_real(rng, 0.05, 1);
    const double low = wild ? -32700 : 0, high = wild ? 32700 : 2048;
    uint32_t k, i;
    memset(s, 0, sizeof *s);
    s->ellipse.xc_px_q16 = q16_of(rng_real(rng, low, high));
    s->ellipse.yc_px_q16 = q16_of(rng_real(rng, low, high));
    s->ellipse.a_px_q16 = q16_of(a);
    s->ellipse.b_px_q16 = q16_of(a * ratio < 1 ? 1 : a * ratio);
    s->ellipse.angle_rad_q16 = q16_of(rng_real(rng, -TEST_PI / 2, TEST_PI / 2));
    ck_assert_int_eq(drogue_ellipse_frame_of(&s->frame, &s->ellipse), DROGUE_OK);
    s->band = drogue_band_of(q16_of(rng_real(rng, 0.01, 8)), q16_of(rng_real(rng, 0, 1)));
    s->camera.fx_px_q16 = s->camera.fy_px_q16 = q16_of(rng_real(rng, 300, 3000));
    s->camera.cx_px_q16 = s->camera.cy_px_q16 = q16_of(1024);
    s->camera.k1_q16 = q16_of(rng_real(rng, -0.4, 0.1));
    s->lens.camera = &s->camera;
    s->lens.x_px_q16 = q16_of(rng_range(rng, wild ? -30000 : -50, 50));
    s->lens.y_px_q16 = q16_of(rng_range(rng, -50, wild ? 30000 : 50));
    s->collection.x_px_q16 = drogue_q16_from_int(s->ellipse.xc_px_q16 >> 16);
    s->collection.y_px_q16 = drogue_q16_from_int(s->ellipse.yc_px_q16 >> 16);
    s->collection.frac_bits = rng_range(rng, 0, 10);
    if (rng_range(rng, 0, 9) == 0) { /* nearly full */
        s->collection.moments.n = DROGUE_MAX_FIT_POINTS - rng_range(rng, 0, 100);
    }
    s->support.bright_bins = rng_range(rng, 0, 2) == 0 ? (uint32_t)rng_u64(rng) : 0u - (uint32_t)rng_range(rng, 0, 1);
    s->support.points = 7;
    s->support.squares_q32 = 1000;
    s->support.gradient = 70;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        s->support.bin[k].count[k & 1] = k;
        s->support.bin[k].sum_q16 = -(int32_t)k;
    }
    s->count = (uint32_t)rng_range(rng, 1, rng_range(rng, 0, 30) == 0 ? MOST : 600);
    for (i = 0; i < s->count; i++) {
        draw_edge(&edges[i], rng, &s->ellipse);
    }
}

static int64_t model_unit(int32_t px_q16, int32_t origin_px_q16, int frac_bits)
{
    return (int64_t)floor(((double)px_q16 - origin_px_q16) / 65536 * (1 << frac_bits) + 0.5);
}

/* Returns how many points were collected. */
static int64_t model(drogue_collection *c, drogue_support *support, const scene *s, int with_lens)
{
    uint32_t i;
    for (i = 0; i < s->count; i++) {
        drogue_q16 x = drogue_edge_x_q16(&edges[i]), y = drogue_edge_y_q16(&edges[i]);
        drogue_band_point p;
        int64_t u, v;
        if (!drogue_ellipse_band_holds(&p, &s->frame, &s->band, x, y, edges[i].gx, edges[i].gy) ||
            !drogue_support_add(support, &p, &edges[i])) {
            continue;
        }
        if (with_lens) {
            x = drogue_q16_add(x, s->lens.x_px_q16);
            y = drogue_q16_add(y, s->lens.y_px_q16);
            if (drogue_undistort_point(&x, &y, &s->camera) != DROGUE_OK) {
                continue;
            }
        }
        u = model_unit(x, c->x_px_q16, c->frac_bits);
        v = model_unit(y, c->y_px_q16, c->frac_bits);
        if (llabs(2 * u + 1) < 1 << 16 && llabs(2 * v + 1) < 1 << 16 && c->moments.n < DROGUE_MAX_FIT_POINTS) {
            drogue_moments_add_point(&c->moments, (int32_t)u, (int32_t)v);
        }
    }
    return c->moments.n - s->collection.moments.n;
}

static int same(const drogue_collection *c, const drogue_collection *d, const drogue_support *s,
                const drogue_support *t)
{
    return memcmp(&c->moments, &d->moments, sizeof c->moments) == 0 && c->x_px_q16 == d->x_px_q16 &&
           c->y_px_q16 == d->y_px_q16 && c->frac_bits == d->frac_bits && memcmp(s->bin, t->bin, sizeof s->bin) == 0 &&
           s->squares_q32 == t->squares_q32 && s->gradient == t->gradient && s->points == t->points &&
           s->bright_bins == t->bright_bins;
}

static void collect_both_ways(int with_lens, int scenes, int64_t least)
{
    uint64_t rng = (uint64_t)with_lens + 1;
    int64_t collected = 0;
    int i;
    for (i = 0; i < scenes; i++) {
        static scene s;
        drogue_collection expected, own, hardware;
        drogue_support expected_support, own_support, hardware_support;
        draw_scene(&s, &rng);
        expected = own = hardware = s.collection;
        expected_support = own_support = hardware_support = s.support;
        collected += model(&expected, &expected_support, &s, with_lens);
        drogue_collect_edges(&own, &own_support, &s.frame, &s.band, edges, s.count, with_lens ? &s.lens : NULL);
        hardware_collect_edges(&hardware, &hardware_support, &s.frame, &s.band, edges, s.count,
                               with_lens ? &s.lens : NULL);
        MUST(same(&own, &expected, &own_support, &expected_support), "scene %d", i);
        MUST(same(&hardware, &expected, &hardware_support, &expected_support), "scene %d, in hardware", i);
    }
    MUST(collected >= least, "%lld points collected", (long long)collected);
}

START_TEST(counts_of_random_scenes)
{
    uint64_t rng = 3;
    int i;
    for (i = 0; i < 2000; i++) {
        static scene s;
        const uint32_t stride = (uint32_t)rng_range(&rng, 1, 5);
        const drogue_q16 threshold = q16_of(rng_real(&rng, 0, 0.5));
        drogue_support expected, own, hardware;
        uint32_t expected_near = 0, k;
        draw_scene(&s, &rng);
        memset(&expected, 0, sizeof expected);
        for (k = 0; k < s.count; k++) {
            const drogue_q16 x = drogue_edge_x_q16(&edges[k]), y = drogue_edge_y_q16(&edges[k]);
            drogue_band_point p;
            expected_near += drogue_ellipse_deviation(&s.frame, x, y) < threshold;
            if (k % stride == 0 && drogue_ellipse_band_holds(&p, &s.frame, &s.band, x, y, edges[k].gx, edges[k].gy)) {
                expected.bin[drogue_support_bin_of(p.u_q24, p.v_q24)].count[p.polarity]++;
            }
        }
        drogue_support_count(&own, &s.frame, &s.band, edges, s.count, stride);
        hardware_support_count(&hardware, &s.frame, &s.band, edges, s.count, stride);
        MUST(memcmp(&own, &expected, sizeof own) == 0, "scene %d", i);
        MUST(memcmp(&hardware, &expected, sizeof hardware) == 0, "scene %d, in hardware", i);
        MUST(drogue_near_count(&s.frame, threshold, edges, s.count) == expected_near, "scene %d", i);
        MUST(hardware_near_count(&s.frame, threshold, edges, s.count) == expected_near, "scene %d, in hardware", i);
    }
}
END_TEST

/* Points that just fit 16 bits, just do not, and whose offset leaves 32. */
START_TEST(borders_of_16_bits)
{
    static const uint16_t at_q5[] = {0, 1, 2, 3, 65532, 65533, 65534, 65535};
    static const int32_t origin_q5[] = {32766, 32770, -(1 << 20)};
    static const int fit[] = {6, 6, 0};
    static scene s;
    uint32_t i;
    int k;
    for (k = 0; k < 3; k++) {
        drogue_collection expected, own, hardware;
        drogue_support expected_support, own_support, hardware_support;
        memset(&s, 0, sizeof s);
        s.ellipse.xc_px_q16 = s.ellipse.yc_px_q16 = s.ellipse.a_px_q16 = s.ellipse.b_px_q16 = q16_of(1024);
        ck_assert_int_eq(drogue_ellipse_frame_of(&s.frame, &s.ellipse), DROGUE_OK);
        s.band = drogue_band_of(q16_of(4), q16_of(0.9));
        s.collection.x_px_q16 = origin_q5[k] * (1 << 11);
        s.collection.y_px_q16 = q16_of(1024);
        s.collection.frac_bits = k < 2 ? 5 : 0;
        s.count = sizeof at_q5 / sizeof at_q5[0];
        for (i = 0; i < s.count; i++) {
            edges[i].x_q5 = at_q5[i];
            edges[i].y_q5 = 1024 * 32;
            edges[i].gx = (int16_t)(at_q5[i] < 1024 * 32 ? -500 : 500);
            edges[i].gy = 0;
        }
        expected = own = hardware = s.collection;
        expected_support = own_support = hardware_support = s.support;
        ck_assert_int_eq(model(&expected, &expected_support, &s, 0), fit[k]);
        ck_assert_uint_eq(expected_support.points, s.count);
        drogue_collect_edges(&own, &own_support, &s.frame, &s.band, edges, s.count, NULL);
        hardware_collect_edges(&hardware, &hardware_support, &s.frame, &s.band, edges, s.count, NULL);
        ck_assert(same(&own, &expected, &own_support, &expected_support));
        ck_assert(same(&hardware, &expected, &hardware_support, &expected_support));
    }
}
END_TEST

START_TEST(random_scenes) { collect_both_ways(0, 4000, 80000); }
END_TEST

START_TEST(random_scenes_through_a_lens) { collect_both_ways(1, 400, 4000); }
END_TEST

SUITE_MAIN("near", counts_of_random_scenes, borders_of_16_bits, random_scenes, random_scenes_through_a_lens)
