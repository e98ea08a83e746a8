/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points counted and collected, against the public functions called one by one: as the library does it and as
 * hardware does. */
#include "suite.h"

#include "../../band_points.h"

#include "../../../src/outline/near.h"

#define drogue_near_count hardware_near_count
#define drogue_collect_arc hardware_collect_arc
#define drogue_collect_edges hardware_collect_edges
#define drogue_collect_undistorted hardware_collect_undistorted
#include "../../../hls/outline/near.c"
#undef drogue_near_count
#undef drogue_collect_arc
#undef drogue_collect_edges
#undef drogue_collect_undistorted
uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count);
void drogue_collect_arc(drogue_moments *moments, const drogue_edge *edges, uint32_t count);
void drogue_collect_edges(drogue_moments *moments, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count, uint32_t stride,
                          uint32_t counted);
uint32_t drogue_collect_undistorted(drogue_collection *c, drogue_support *support, const drogue_ellipse_frame *frame,
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
    const double low = wild ? -16000 : 0, high = wild ? 16000 : 2048;
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

/* Values of the 96-bit sums, their carries passed on. */
static void pass_carries(drogue_moments *m)
{
    drogue_long_sum *sums[] = {&m->m40, &m->m31, &m->m22, &m->m13, &m->m04};
    size_t k;
    for (k = 0; k < sizeof sums / sizeof sums[0]; k++) {
        sums[k]->high += (int64_t)(sums[k]->low >> 32);
        sums[k]->low &= 0xFFFFFFFFu;
    }
}

/* Does edge point i belong, and is its polarity its bin's? */
static int own_of(band_point *p, const scene *s, uint32_t i)
{
    return point_holds(p, &s->frame, &s->band, &edges[i]) &&
           (s->support.bright_bins >> point_bin(p) & 1u) == (uint32_t)p->polarity;
}

/* The moments of the points that belong, apart from what they were and whether all were counted; returns how many. */
static uint32_t model(drogue_moments *m, drogue_support *support, const scene *s, uint32_t stride, uint32_t counted)
{
    uint32_t own = 0, i;
    for (i = 0; i < s->count; i += stride) {
        const int32_t x = edges[i].x_q5 - 32768, y = edges[i].y_q5 - 32768;
        band_point p;
        if (point_holds(&p, &s->frame, &s->band, &edges[i]) && point_add(support, &p, &edges[i])) {
            own++;
            if (!counted && m->n < DROGUE_MAX_FIT_POINTS) {
                drogue_moments_add_point(m, x, y);
            }
        } else if (counted) {
            drogue_moments_count_point(m, x, y, -1);
        }
    }
    return own;
}

/* Returns how many belong. */
static uint32_t model_lens(drogue_collection *c, const scene *s)
{
    uint32_t own = 0, i;
    for (i = 0; i < s->count; i++) {
        drogue_q16 x = drogue_q16_add(drogue_edge_x_q16(&edges[i]), s->lens.x_px_q16);
        drogue_q16 y = drogue_q16_add(drogue_edge_y_q16(&edges[i]), s->lens.y_px_q16);
        band_point p;
        int64_t u, v;
        if (!own_of(&p, s, i)) {
            continue;
        }
        own++;
        if (drogue_undistort_point(&x, &y, &s->camera) != DROGUE_OK) {
            continue;
        }
        u = model_unit(x, c->x_px_q16, c->frac_bits);
        v = model_unit(y, c->y_px_q16, c->frac_bits);
        if (llabs(2 * u + 1) < 1 << 16 && llabs(2 * v + 1) < 1 << 16 && c->moments.n < DROGUE_MAX_FIT_POINTS) {
            drogue_moments_add_point(&c->moments, (int32_t)u, (int32_t)v);
        }
    }
    return own;
}

static int same(drogue_moments *m, drogue_moments *n, const drogue_support *s, const drogue_support *t)
{
    pass_carries(m);
    pass_carries(n);
    return memcmp(m, n, sizeof *m) == 0 && memcmp(s->bin, t->bin, sizeof s->bin) == 0 &&
           s->squares_q32 == t->squares_q32 && s->gradient == t->gradient && s->points == t->points &&
           s->bright_bins == t->bright_bins;
}

START_TEST(random_scenes)
{
    uint64_t rng = 1;
    uint32_t collected = 0, taken_out = 0;
    int i;
    for (i = 0; i < 4000; i++) {
        static scene s;
        const uint32_t stride = rng_range(&rng, 0, 2) ? 1 : (uint32_t)rng_range(&rng, 2, 5);
        const uint32_t counted = (uint32_t)rng_range(&rng, 0, 1) & (stride == 1);
        drogue_moments expected, own, hardware;
        drogue_support expected_support, own_support, hardware_support;
        uint32_t belong;
        draw_scene(&s, &rng);
        if (counted) { /* in parts, as an outline's arcs are */
            const uint32_t part = s.count / 3;
            drogue_moments again = s.collection.moments;
            drogue_collect_arc(&s.collection.moments, edges, part);
            drogue_collect_arc(&s.collection.moments, edges + part, s.count - part);
            hardware_collect_arc(&again, edges, s.count);
            MUST(same(&again, &s.collection.moments, &s.support, &s.support), "scene %d, its arc", i);
        }
        expected = own = hardware = s.collection.moments;
        expected_support = own_support = hardware_support = s.support;
        belong = model(&expected, &expected_support, &s, stride, counted);
        collected += belong;
        taken_out += counted ? s.count - belong : 0;
        drogue_collect_edges(&own, &own_support, &s.frame, &s.band, edges, s.count, stride, counted);
        hardware_collect_edges(&hardware, &hardware_support, &s.frame, &s.band, edges, s.count, stride, counted);
        MUST(same(&own, &expected, &own_support, &expected_support), "scene %d", i);
        MUST(same(&hardware, &expected, &hardware_support, &expected_support), "scene %d, in hardware", i);
    }
    MUST(collected >= 60000 && taken_out > 60000, "%u collected, %u taken out", (unsigned)collected,
         (unsigned)taken_out);
}
END_TEST

/* What is left after some have been taken out is what the others add up to. */
START_TEST(what_is_taken_out_leaves_no_trace)
{
    uint64_t rng = 4;
    int i;
    for (i = 0; i < 200; i++) {
        static scene s;
        drogue_moments all, others;
        drogue_support support;
        uint32_t k;
        draw_scene(&s, &rng);
        drogue_moments_clear(&all);
        drogue_moments_clear(&others);
        support = s.support;
        drogue_collect_arc(&all, edges, s.count);
        drogue_collect_edges(&all, &support, &s.frame, &s.band, edges, s.count, 1, 1);
        for (k = 0; k < s.count; k++) {
            band_point p;
            if (own_of(&p, &s, k)) {
                drogue_moments_add_point(&others, edges[k].x_q5 - 32768, edges[k].y_q5 - 32768);
            }
        }
        MUST(same(&all, &others, &support, &support), "scene %d", i);
    }
}
END_TEST

START_TEST(random_scenes_through_a_lens)
{
    uint64_t rng = 2;
    uint32_t collected = 0;
    int i;
    for (i = 0; i < 400; i++) {
        static scene s;
        drogue_collection expected, own, hardware;
        drogue_support own_support, hardware_support;
        uint32_t belong;
        draw_scene(&s, &rng);
        own_support = hardware_support = s.support;
        expected = own = hardware = s.collection;
        belong = model_lens(&expected, &s);
        collected += (uint32_t)(expected.moments.n - s.collection.moments.n);
        MUST(drogue_collect_undistorted(&own, &own_support, &s.frame, &s.band, edges, s.count, &s.lens) == belong &&
                 memcmp(&own, &expected, sizeof own) == 0,
             "scene %d", i);
        MUST(hardware_collect_undistorted(&hardware, &hardware_support, &s.frame, &s.band, edges, s.count, &s.lens) ==
                     belong &&
                 memcmp(&hardware, &expected, sizeof hardware) == 0,
             "scene %d, in hardware", i);
    }
    MUST(collected >= 4000, "%u points collected", (unsigned)collected);
}
END_TEST

/* Against |X + Y - 1| of the public function, away from the threshold by what Q16 leaves. */
START_TEST(counts_of_random_scenes)
{
    uint64_t rng = 3;
    uint32_t total = 0, unsure = 0;
    int i;
    for (i = 0; i < 2000; i++) {
        static scene s;
        const drogue_q16 threshold = q16_of(rng_real(&rng, 0, 0.5));
        uint32_t least = 0, most = 0, got, k;
        draw_scene(&s, &rng);
        for (k = 0; k < s.count; k++) {
            const drogue_q16 d =
                drogue_ellipse_deviation(&s.frame, drogue_edge_x_q16(&edges[k]), drogue_edge_y_q16(&edges[k]));
            const double b = real_of_q16(s.ellipse.b_px_q16);
            const double slack =
                4 + 4 * real_of_q16(s.ellipse.a_px_q16) / b / b + real_of_q16(s.ellipse.a_px_q16) / 256;
            least += d + slack < threshold;
            most += d - slack < threshold;
        }
        got = drogue_near_count(&s.frame, threshold, edges, s.count);
        MUST(got >= least && got <= most, "scene %d: %u of %u to %u", i, (unsigned)got, (unsigned)least,
             (unsigned)most);
        MUST(hardware_near_count(&s.frame, threshold, edges, s.count) == got, "scene %d, in hardware", i);
        total += most;
        unsure += most - least;
    }
    MUST(total > 100000 && unsure * 100 < total, "%u of %u unsure", (unsigned)unsure, (unsigned)total);
}
END_TEST

/* A lens that is none: points that just fit 16 bits of the collection, just do not, and whose offset leaves 32. */
START_TEST(borders_of_16_bits)
{
    static const uint16_t at_q5[] = {0, 1, 2, 3, 65532, 65533, 65534, 65535};
    static const int32_t origin_q5[] = {32766, 32770, -(1 << 20)};
    static const int fit[] = {6, 6, 0};
    static scene s;
    uint32_t i;
    int k;
    for (k = 0; k < 3; k++) {
        drogue_collection own;
        memset(&s, 0, sizeof s);
        s.ellipse.xc_px_q16 = s.ellipse.yc_px_q16 = s.ellipse.a_px_q16 = s.ellipse.b_px_q16 = q16_of(1024);
        ck_assert_int_eq(drogue_ellipse_frame_of(&s.frame, &s.ellipse), DROGUE_OK);
        s.band = drogue_band_of(q16_of(4), q16_of(0.9));
        s.camera.fx_px_q16 = s.camera.fy_px_q16 = q16_of(1000);
        s.lens.camera = &s.camera;
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
        own = s.collection;
        ck_assert_uint_eq(drogue_collect_undistorted(&own, &s.support, &s.frame, &s.band, edges, s.count, &s.lens),
                          s.count);
        ck_assert_int_eq((int)own.moments.n, fit[k]);
    }
}
END_TEST

SUITE_MAIN("near", counts_of_random_scenes, borders_of_16_bits, random_scenes, what_is_taken_out_leaves_no_trace,
           random_scenes_through_a_lens)
