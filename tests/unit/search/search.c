/* SPDX-License-Identifier: Apache-2.0 */
/* The search over drawn frames: discs inside rings of every size and shade, frames without any, limits. */
#include "suite.h"

#include "drogue/track.h"
#include "own_workspace.h"
#include "results.h"

static const drogue_model model = {22938, 7864, 16384}; /* 0.35, 0.12, 0.25 m */

typedef struct frame {
    int32_t width, height;
    uint8_t *pixels;
} frame;

typedef struct shades {
    int background, canopy, inner;
} shades;

static const shades all_shades[3] = {{210, 60, 14}, {45, 140, 20}, {120, 75, 14}};

static frame new_frame(int32_t width, int32_t height, int background, uint64_t seed)
{
    frame f = {width, height, NULL};
    int32_t i;
    f.pixels = (uint8_t *)malloc((size_t)width * (size_t)height);
    if (f.pixels == NULL) {
        abort();
    }
    for (i = 0; i < width * height; i++) {
        f.pixels[i] = (uint8_t)(background + rng_range(&seed, -4, 4));
    }
    return f;
}

/* Part of a pixel inside an ellipse, about. */
static double inside(const ellipse_real *e, double x, double y)
{
    const double c = cos(e->angle), s = sin(e->angle), u = c * (x - e->xc) + s * (y - e->yc),
                 v = c * (y - e->yc) - s * (x - e->xc), r = hypot(u / e->a, v / e->b),
                 scale = hypot(u, v) / fmax(r, 1e-9);
    return fmin(fmax((1 - r) * (scale > 0 ? scale : e->b) + 0.5, 0), 1);
}

static void draw_ellipse(frame *f, const ellipse_real *e, int grey)
{
    int32_t x, y;
    for (y = (int32_t)fmax(0, e->yc - e->a - 2); y < fmin(f->height, e->yc + e->a + 2); y++) {
        for (x = (int32_t)fmax(0, e->xc - e->a - 2); x < fmin(f->width, e->xc + e->a + 2); x++) {
            uint8_t *p = &f->pixels[(size_t)y * (size_t)f->width + (size_t)x];
            double share = inside(e, x, y);
            *p = (uint8_t)(*p + share * (grey - *p) + 0.5);
        }
    }
}

/* A drogue at a place, for the camera of 'camera_for': outline and inner part as projected circles. */
static ellipse_real draw_drogue(frame *f, const double centre[3], double yaw, double pitch, const shades *s)
{
    double axis[3], inner_centre[3];
    ellipse_real rim, inner;
    int k;
    axis_of_angles(axis, yaw, pitch);
    for (k = 0; k < 3; k++) {
        inner_centre[k] = centre[k] + 0.25 * axis[k];
    }
    if (!ellipse_of_circle(&rim, centre, axis, 0.35, 1000, 1000, f->width / 2.0, f->height / 2.0) ||
        !ellipse_of_circle(&inner, inner_centre, axis, 0.12, 1000, 1000, f->width / 2.0, f->height / 2.0)) {
        abort();
    }
    draw_ellipse(f, &rim, s->canopy);
    draw_ellipse(f, &inner, s->inner);
    return rim;
}

static drogue_camera camera_for(const frame *f) { return pinhole(1000, 1000, f->width / 2.0, f->height / 2.0); }

static drogue_image image_of(const frame *f)
{
    drogue_image image;
    image.data = f->pixels;
    image.width_px = f->width;
    image.height_px = f->height;
    image.stride = f->width;
    return image;
}

typedef struct test_search {
    guarded memory;
    drogue_search search;
} test_search;

static test_search new_search(int32_t width)
{
    test_search s;
    s.memory = guarded_alloc(DROGUE_SEARCH_BYTES(width));
    ck_assert_int_eq(drogue_search_init(&s.search, s.memory.data, s.memory.bytes, width), DROGUE_OK);
    return s;
}

static void free_search(test_search *s)
{
    MUST(guarded_intact(&s->memory), "written past the memory");
    guarded_free(&s->memory);
}

static int32_t run(drogue_search *s, const frame *f)
{
    int32_t y;
    ck_assert_int_eq(drogue_search_begin(s, f->width), DROGUE_OK);
    for (y = 0; y < f->height; y++) {
        drogue_search_row(s, f->pixels + (size_t)y * (size_t)f->width);
    }
    return drogue_search_end(s);
}

/* Index of the sighting that suits an outline, or -1. */
static int32_t rank_of(const drogue_search *s, const ellipse_real *rim)
{
    int32_t i;
    for (i = 0; i < s->count; i++) {
        const drogue_sighting *c = &s->best[i];
        const double side = c->region.width_px / rim->a;
        if (hypot(c->x_px - rim->xc, c->y_px - rim->yc) < 0.3 * rim->a && side > 2.1 && side < 2.9) {
            return i;
        }
    }
    return -1;
}

START_TEST(every_size_tilt_and_shade)
{
    uint64_t rng = 3;
    test_search s = new_search(1024);
    int i, k, first = 0;
    for (i = 0; i < 120; i++) {
        const double z = 25 * pow(0.9 / 25, i / 119.0); /* 14 to 390 px */
        const double room = fmax(0, 0.5 - 0.45 / z);
        double at[4], centre[3];
        frame f = new_frame(1024, 1024, all_shades[i % 3].background, (uint64_t)i);
        ellipse_real rim;
        int32_t rank;
        for (k = 0; k < 4; k++) {
            at[k] = rng_real(&rng, -1, 1);
        }
        centre[0] = z * room * at[0];
        centre[1] = z * room * at[1];
        centre[2] = z;
        /* tilted to 30 degrees from the line of sight */
        rim = draw_drogue(&f, centre, atan2(centre[0], z) + 0.52 * at[2] * cos(TEST_PI * at[3]),
                          atan2(centre[1], hypot(centre[0], z)) + 0.52 * at[2] * sin(TEST_PI * at[3]),
                          &all_shades[i % 3]);
        (void)run(&s.search, &f);
        rank = rank_of(&s.search, &rim);
        MUST(rank >= 0,
             "case %d: semi-axes %.1f and %.1f px at (%.1f, %.1f): not among %d, the first of radius %d at (%d, %d)", i,
             rim.a, rim.b, rim.xc, rim.yc, (int)s.search.count, (int)s.search.best[0].radius_px,
             (int)s.search.best[0].x_px, (int)s.search.best[0].y_px);
        first += rank == 0;
        free(f.pixels);
    }
    MUST(first >= 116, "first of the sightings in %d of 120", first);
    free_search(&s);
}
END_TEST

START_TEST(nothing_in_flat_and_noisy_frames)
{
    test_search s = new_search(640);
    int k;
    for (k = 0; k < 3; k++) {
        frame f = new_frame(640, 480, 40 + 70 * k, 5 + (uint64_t)k);
        ck_assert_int_eq(run(&s.search, &f), 0);
        free(f.pixels);
    }
    free_search(&s);
}
END_TEST

START_TEST(the_best_eight_in_order)
{
    frame f = new_frame(1280, 960, 210, 1);
    test_search s = new_search(1280);
    int i, k;
    for (i = 0; i < 12; i++) {
        const double centre[3] = {3.2 * (i % 4 - 1.5), 3.2 * (i / 4 - 1), 11};
        shades shade = all_shades[0];
        shade.canopy = 40 + 5 * i;
        (void)draw_drogue(&f, centre, 0, 0, &shade);
    }
    ck_assert_int_eq(run(&s.search, &f), DROGUE_SEARCH_MAX);
    for (i = 0; i + 1 < DROGUE_SEARCH_MAX; i++) {
        ck_assert_uint_ge(s.search.best[i].score, s.search.best[i + 1].score);
        for (k = i + 1; k < DROGUE_SEARCH_MAX; k++) {
            MUST(abs(s.search.best[i].x_px - s.search.best[k].x_px) > 30 ||
                     abs(s.search.best[i].y_px - s.search.best[k].y_px) > 30,
                 "%d and %d are one", i, k);
        }
    }
    free_search(&s);
    free(f.pixels);
}
END_TEST

START_TEST(any_size_of_frame)
{
    static const int32_t sizes[][2] = {{1, 1},   {1, 300}, {300, 1},  {2, 2},    {7, 9},
                                       {64, 48}, {333, 2}, {511, 37}, {97, 1000}};
    size_t i;
    for (i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        frame f = new_frame(sizes[i][0], sizes[i][1], 100, i);
        test_search s = new_search(sizes[i][0]);
        uint64_t rng = i;
        int32_t k;
        for (k = 0; k < f.width * f.height; k++) { /* all contrast there can be */
            f.pixels[k] = (uint8_t)rng_u64(&rng);
        }
        for (k = run(&s.search, &f) - 1; k >= 0; k--) {
            MUST(s.search.best[k].region.width_px > 0 && s.search.best[k].region.width_px < 2600, "side %d",
                 (int)s.search.best[k].region.width_px);
        }
        free_search(&s);
        free(f.pixels);
    }
}
END_TEST

/* A drogue above the last row that may be measured is sighted, one below it is not. */
START_TEST(no_more_rows_than_can_be_measured)
{
    static const double centre[3] = {0, 0, 10};
    frame f = new_frame(120, 120, 210, 5);
    test_search s = new_search(120);
    const ellipse_real rim = draw_drogue(&f, centre, 0.1, 0.1, &all_shades[0]);
    int below;
    for (below = 0; below < 2; below++) {
        const int32_t first = DROGUE_SEARCH_MOST_ROWS - (below ? 10 : 110);
        int32_t y, count;
        ck_assert_int_eq(drogue_search_begin(&s.search, 120), DROGUE_OK);
        for (y = 0; y < first + 2 * f.height; y++) {
            const int32_t own = y < first ? 0 : (y - first) % f.height;
            drogue_search_row(&s.search, f.pixels + (size_t)own * (size_t)f.width);
        }
        count = drogue_search_end(&s.search);
        ck_assert_int_eq(s.search.rows_in, DROGUE_SEARCH_MOST_ROWS);
        MUST((count > 0) == !below, "%d sightings", (int)count);
        MUST(below || fabs(s.search.best[0].y_px - first - rim.yc) < 5, "at %d", (int)s.search.best[0].y_px);
    }
    free_search(&s);
    free(f.pixels);
}
END_TEST

START_TEST(refusals)
{
    static uint8_t memory[DROGUE_SEARCH_BYTES(100)];
    drogue_search s;
    ck_assert_int_eq(drogue_search_init(&s, NULL, sizeof memory, 100), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_search_begin(&s, 1), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_search_init(&s, memory, sizeof memory, 0), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_search_init(&s, memory, sizeof memory, 32768), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_search_init(&s, memory, sizeof memory - 1, 100), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(drogue_search_init(&s, memory, sizeof memory, 100), DROGUE_OK);
    ck_assert_int_eq(s.min_contrast, 6);
    ck_assert_int_eq(drogue_search_begin(&s, 101), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(drogue_search_begin(&s, 0), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_search_begin(&s, 100), DROGUE_OK);
    s.count = s.dark_count = 2; /* of a frame */
    ck_assert_int_eq(drogue_search_begin(&s, 101), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(s.width_px, 0);
    ck_assert_int_eq(drogue_search_end(&s), 0);
    ck_assert_int_eq(s.dark_count, 0);
    s.min_contrast = -1;
    ck_assert_int_eq(drogue_search_begin(&s, 100), DROGUE_E_ARGUMENT);
    s.min_contrast = 256;
    ck_assert_int_eq(drogue_search_begin(&s, 100), DROGUE_E_ARGUMENT);
    s.min_contrast = 255;
    ck_assert_int_eq(drogue_search_begin(&s, 100), DROGUE_OK);
    ck_assert_int_eq(drogue_search_end(&s), 0);
}
END_TEST

/* Everything that finds and follows a drogue in frames; frames may be wider than a region. */
typedef struct rig {
    test_workspace workspace;
    test_search search;
    drogue_config config;
    drogue_camera camera;
} rig;

static rig new_rig(const frame *f)
{
    const uint32_t side = (uint32_t)(f->width < DROGUE_MAX_SIDE ? f->width : DROGUE_MAX_SIDE);
    rig r;
    r.workspace = test_workspace_of(side, (uint32_t)DROGUE_EDGES_FOR(side), (uint32_t)DROGUE_LABELS_FOR(side),
                                    (uint32_t)DROGUE_ARCS_FOR(side));
    r.search = new_search(f->width);
    drogue_config_default(&r.config);
    r.camera = camera_for(f);
    return r;
}

static void free_rig(rig *r)
{
    test_workspace_free(&r->workspace);
    free_search(&r->search);
}

START_TEST(acquire_measures_what_it_finds)
{
    int i;
    for (i = 0; i < 6; i++) {
        const double centre[3] = {0.6 - 0.2 * i, 0.1 * i, 3.0 + i};
        frame f = new_frame(800, 600, all_shades[i % 3].background, (uint64_t)i);
        rig r = new_rig(&f);
        const drogue_image image = image_of(&f);
        const drogue_region away = {0, 0, 30, 30}, outside = {-40, 0, 30, 30};
        drogue_result result;
        (void)draw_drogue(&f, centre, 0.2, -0.15, &all_shades[i % 3]);
        ck_assert_int_eq(drogue_acquire(&result, &r.workspace.workspace, &r.search.search,
                                        &(drogue_setup){&r.camera, &model, &r.config}, &image, NULL),
                         DROGUE_OK);
        MUST(fabs(real_of_q16(result.pose.position_m_q16[0]) - centre[0]) < 0.005 &&
                 fabs(real_of_q16(result.pose.position_m_q16[1]) - centre[1]) < 0.005 &&
                 fabs(real_of_q16(result.pose.position_m_q16[2]) - centre[2]) < 0.05,
             "case %d: at (%g, %g, %g)", i, real_of_q16(result.pose.position_m_q16[0]),
             real_of_q16(result.pose.position_m_q16[1]), real_of_q16(result.pose.position_m_q16[2]));
        MUST(fabs(real_of_q16(result.pose.yaw_rad_q16) - 0.2) < 0.02 &&
                 fabs(real_of_q16(result.pose.pitch_rad_q16) + 0.15) < 0.02,
             "case %d: yaw %g, pitch %g", i, real_of_q16(result.pose.yaw_rad_q16),
             real_of_q16(result.pose.pitch_rad_q16));
        ck_assert_int_ne(drogue_acquire(&result, &r.workspace.workspace, &r.search.search,
                                        &(drogue_setup){&r.camera, &model, &r.config}, &image, &away),
                         DROGUE_OK);
        ck_assert_int_eq(drogue_acquire(&result, &r.workspace.workspace, &r.search.search,
                                        &(drogue_setup){&r.camera, &model, &r.config}, &image, &outside),
                         DROGUE_E_REGION);
        ck_assert_int_eq(result.status, DROGUE_E_REGION);
        free_rig(&r);
        free(f.pixels);
    }
}
END_TEST

/* Nothing is left, or a part of [0, limit), whatever the numbers are. */
START_TEST(clipping_saturates)
{
    static const int32_t edges[] = {INT32_MIN, INT32_MIN + 1, -70000,        -65,      -64, -1, 0, 1, 63, 64,
                                    65,        70000,         INT32_MAX - 1, INT32_MAX};
    enum { EDGES = sizeof edges / sizeof edges[0] };
    int i;
    for (i = 0; i < EDGES * EDGES * EDGES; i++) {
        const int32_t from = edges[i / EDGES / EDGES], length = edges[i / EDGES % EDGES], limit = edges[i % EDGES];
        const int64_t most = limit > 0 ? limit : 0, end = (int64_t)from + length, first = from > 0 ? from : 0;
        const int64_t left = (end < most ? end : most) - first;
        int32_t at = from, rest = length;
        drogue_clip(&at, &rest, limit);
        MUST(at >= 0 && at <= most && rest >= 0 && at + (int64_t)rest <= most && rest == (left > 0 ? left : 0) &&
                 (rest == 0 || at == first),
             "[%ld, + %ld) of %ld: [%ld, + %ld)", (long)from, (long)length, (long)limit, (long)at, (long)rest);
    }
}
END_TEST

/* Regions that wrap when their sides are clipped carelessly: refused before a pixel is read; the image is a block of its
 * own, so that a sanitizer sees any that is. */
START_TEST(acquire_refuses_hostile_regions)
{
    static const drogue_region regions[] = {{0, INT32_MIN, 64, INT32_MIN + 5000},
                                            {INT32_MIN, 0, INT32_MIN + 5000, 64},
                                            {INT32_MIN, INT32_MIN, INT32_MIN + 64, INT32_MIN + 64},
                                            {INT32_MIN, INT32_MIN, -1, -1},
                                            {0, INT32_MIN, 64, INT32_MAX},
                                            {0, INT32_MAX, 64, INT32_MAX},
                                            {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX},
                                            {0, 0, 0, 64},
                                            {0, 0, 64, 0},
                                            {0, 0, INT32_MIN, INT32_MIN},
                                            {64, 0, 64, 64}};
    frame f = new_frame(64, 64, 210, 1);
    rig r = new_rig(&f);
    const drogue_image image = image_of(&f);
    drogue_result result;
    size_t i;
    for (i = 0; i < sizeof regions / sizeof regions[0]; i++) {
        const drogue_status status = drogue_acquire(&result, &r.workspace.workspace, &r.search.search,
                                                    &(drogue_setup){&r.camera, &model, &r.config}, &image, &regions[i]);
        MUST(status == DROGUE_E_REGION && result.status == status, "region %d: %s", (int)i, drogue_status_name(status));
    }
    ck_assert_int_eq(drogue_acquire(&result, &r.workspace.workspace, &r.search.search,
                                    &(drogue_setup){&r.camera, &model, &r.config}, &(drogue_image){NULL, 64, 64, 64},
                                    NULL),
                     DROGUE_E_ARGUMENT);
    free_rig(&r);
    free(f.pixels);
}
END_TEST

/* Wide with a drogue at the far end, tall with one at the bottom, one as large as a region bears, none. */
START_TEST(frames_larger_than_a_region)
{
    static const struct {
        int32_t width, height;
        double centre[3];
        drogue_status want;
    } cases[] = {{2348, 600, {4, 0.1, 4}, DROGUE_OK}, /* 45 degrees off the axis */
                 {600, 2348, {0.1, 4, 4}, DROGUE_OK},
                 {2600, 2200, {0.01, 0, 0.446}, DROGUE_OK},
                 {2348, 600, {0}, DROGUE_E_NO_INNER_PART}};
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double *centre = cases[i].centre;
        const int there = centre[2] > 0;
        frame f = new_frame(cases[i].width, cases[i].height, 210, 3);
        rig r = new_rig(&f);
        const drogue_image image = image_of(&f);
        drogue_result result;
        int32_t k;
        if (there) {
            (void)draw_drogue(&f, centre, atan2(centre[0], centre[2]), atan2(centre[1], centre[2]), &all_shades[0]);
        }
        MUST(drogue_acquire(&result, &r.workspace.workspace, &r.search.search,
                            &(drogue_setup){&r.camera, &model, &r.config}, &image, NULL) == cases[i].want,
             "case %d: %s, %d sightings, cover %g, resolved %d", (int)i, drogue_status_name(result.status),
             (int)r.search.search.count, real_of_q16(result.cover_q16), (int)result.orientation_resolved);
        MUST(!there || (fabs(real_of_q16(result.pose.position_m_q16[0]) - centre[0]) < 0.005 &&
                        fabs(real_of_q16(result.pose.position_m_q16[1]) - centre[1]) < 0.005),
             "case %d: x %g, y %g", (int)i, real_of_q16(result.pose.position_m_q16[0]),
             real_of_q16(result.pose.position_m_q16[1]));
        for (k = 0; k < r.search.search.count; k++) {
            ck_assert_int_le(r.search.search.best[k].region.width_px, DROGUE_MAX_SIDE);
        }
        free_rig(&r);
        free(f.pixels);
    }
}
END_TEST

/* From a whole frame, through blanks, a loss and a jump while lost. */
START_TEST(track_frames)
{
    drogue_track_config config;
    drogue_track t;
    int k, searched = 0;
    frame f = new_frame(640, 480, 0, 0);
    rig r = new_rig(&f);
    drogue_track_config_default(&config);
    config.max_missed = 5;
    (void)drogue_track_init(&t, &config, &r.camera, &model, NULL);
    free(f.pixels);
    for (k = 0; k < 60; k++) {
        const int blank = k < 2 || k == 12 || (k >= 20 && k < 24) || (k >= 30 && k < 40);
        const double x = k < 35 ? -0.5 + 0.01 * k : 0.8, centre[3] = {x, 0.1, 5 - 0.02 * k};
        drogue_track_state want = k < 2 || (k >= 35 && k < 40) ? DROGUE_LOST
                                  : blank                      ? DROGUE_COASTING
                                                               : DROGUE_TRACKING;
        drogue_track_state state;
        drogue_result result;
        drogue_region region;
        drogue_image image;
        f = new_frame(640, 480, 210, (uint64_t)k);
        image = image_of(&f);
        if (!blank) {
            (void)draw_drogue(&f, centre, 0.1, 0.1, &all_shades[0]);
        }
        state = drogue_track_frame(&result, &region, &t, &r.workspace.workspace, &r.search.search, &r.config, &image,
                                   40000);
        searched += t.search;
        MUST(state == want, "frame %d: %s, not %s", k, drogue_track_state_name(state), drogue_track_state_name(want));
        if (state == DROGUE_TRACKING) {
            drogue_track_estimate e;
            drogue_track_get(&e, &t);
            MUST(fabs(real_of_q16(e.position_m_q16[0]) - x) < 0.01 &&
                     fabs(real_of_q16(e.position_m_q16[2]) - centre[2]) < 0.05,
                 "frame %d: x %g, not %g; z %g, not %g", k, real_of_q16(e.position_m_q16[0]), x,
                 real_of_q16(e.position_m_q16[2]), centre[2]);
        }
        free(f.pixels);
    }
    ck_assert_int_ge(searched, 8); /* frames while lost at least */
    free_rig(&r);
}
END_TEST

/* A track that has coasted until the drogue may be anywhere in 'reach': what shows up there is found, also when it is not
 * in the predicted region, and not what is elsewhere; half an outline without an inner part is not believed. */
START_TEST(uncertain_searches_within_reach)
{
    int shown, k;
    for (shown = 0; shown < 2; shown++) {
        const double start[3] = {-1, 0, 5}, other[3] = {1.2, 0.2, 3.5};
        frame blank = new_frame(640, 480, 210, 1), first = new_frame(640, 480, 210, 2),
              last = new_frame(640, 480, 210, 3);
        rig r = new_rig(&blank);
        drogue_track_config config;
        drogue_track t;
        drogue_result result;
        drogue_region region;
        drogue_image image = image_of(&first);
        drogue_track_config_default(&config);
        config.max_missed = 30;
        (void)drogue_track_init(&t, &config, &r.camera, &model, NULL);
        (void)draw_drogue(&first, start, 0.1, 0.1, &all_shades[0]);
        for (k = 0; k < 8; k++) {
            ck_assert_int_eq(drogue_track_frame(&result, &region, &t, &r.workspace.workspace, &r.search.search,
                                                &r.config, &image, 40000),
                             DROGUE_TRACKING);
        }
        image = image_of(&blank);
        for (k = 0; k < 30 && (t.search == 0 || t.reach.width_px < 320); k++) { /* 70 px semi-axis */
            ck_assert_int_eq(drogue_track_frame(&result, &region, &t, &r.workspace.workspace, &r.search.search,
                                                &r.config, &image, 40000),
                             DROGUE_COASTING);
        }
        MUST(t.search == 1 && t.reach.width_px >= 320, "reach %d px", (int)t.reach.width_px);
        image = image_of(&last);
        if (shown) {
            const double near[3] = {-1 + 0.4, 0.2, 5};
            (void)draw_drogue(&last, near, 0.1, 0.1, &all_shades[0]);
            (void)draw_drogue(&last, other, 0.1, 0.1, &all_shades[0]);
        } else {
            const ellipse_real disc = {320 - 200, 240, 70, 69, 0.3};
            int32_t x, y;
            draw_ellipse(&last, &disc, 60);
            for (y = 0; y < last.height; y++) {
                for (x = 0; x < 110; x++) {
                    last.pixels[y * last.width + x] = 60;
                }
            }
        }
        (void)drogue_track_frame(&result, &region, &t, &r.workspace.workspace, &r.search.search, &r.config, &image,
                                 40000);
        if (shown) {
            MUST(result.status == DROGUE_OK && fabs(real_of_q16(result.pose.position_m_q16[0]) + 0.6) < 0.02,
                 "%s, x %g", drogue_status_name(result.status), real_of_q16(result.pose.position_m_q16[0]));
        } else {
            ck_assert_int_ne(result.status, DROGUE_OK);
            ck_assert_int_eq(t.state, DROGUE_COASTING);
        }
        free_rig(&r);
        free(blank.pixels);
        free(first.pixels);
        free(last.pixels);
    }
}
END_TEST

/* A first region that holds nothing does not keep a lost track from finding the drogue elsewhere; a configuration that was
 * refused does. */
START_TEST(first_region_then_anywhere)
{
    const drogue_region first = {0, 0, 100, 100};
    const double centre[3] = {0.5, 0.2, 5};
    frame f = new_frame(640, 480, 210, 3);
    rig r = new_rig(&f);
    const drogue_image image = image_of(&f);
    int refused;
    (void)draw_drogue(&f, centre, 0.1, 0.1, &all_shades[0]);
    for (refused = 0; refused < 2; refused++) {
        drogue_track_config config;
        drogue_track t;
        drogue_result result;
        drogue_region region;
        drogue_track_config_default(&config);
        config.gate_q16 = refused ? -1 : config.gate_q16;
        ck_assert_int_eq(drogue_track_init(&t, &config, &r.camera, &model, &first),
                         refused ? DROGUE_E_ARGUMENT : DROGUE_OK);
        ck_assert_int_eq(drogue_track_frame(&result, &region, &t, &r.workspace.workspace, &r.search.search, &r.config,
                                            &image, 40000),
                         refused ? DROGUE_LOST : DROGUE_TRACKING);
        ck_assert_int_eq(result.status, refused ? DROGUE_E_ARGUMENT : DROGUE_OK);
        ck_assert_int_eq(memcmp(&region, &first, sizeof first) == 0, !refused);
    }
    free_rig(&r);
    free(f.pixels);
}
END_TEST

/* A track of a plain disc gives way to the drogue, but not without it, and not when told to stay. */
START_TEST(what_shows_no_inner_part_is_reconsidered)
{
    const drogue_region first = {75, 75, 150, 150};
    const double centre[3] = {0.7, 0.3, 5};
    const ellipse_real disc = {150, 150, 60, 58, 0.5};
    int with, k;
    for (with = 0; with < 3; with++) {
        frame f = new_frame(640, 480, 210, 3);
        rig r = new_rig(&f);
        const drogue_image image = image_of(&f);
        drogue_track_config config;
        drogue_track t;
        drogue_track_estimate e;
        drogue_result result;
        drogue_region region;
        draw_ellipse(&f, &disc, 60);
        if (with > 0) {
            (void)draw_drogue(&f, centre, 0.1, 0.1, &all_shades[0]);
        }
        drogue_track_config_default(&config);
        if (with == 2) {
            config.reconsider_frames = 0;
        }
        (void)drogue_track_init(&t, &config, &r.camera, &model, &first);
        for (k = 0; k < 60; k++) {
            MUST(drogue_track_frame(&result, &region, &t, &r.workspace.workspace, &r.search.search, &r.config, &image,
                                    40000) == DROGUE_TRACKING,
                 "case %d, frame %d", with, k);
            drogue_track_get(&e, &t);
            MUST((e.position_m_q16[0] > 0) == (with == 1 && k > 50), "case %d, frame %d: at x %g", with, k,
                 real_of_q16(e.position_m_q16[0]));
        }
        free_rig(&r);
        free(f.pixels);
    }
}
END_TEST

SUITE_MAIN("search", every_size_tilt_and_shade, nothing_in_flat_and_noisy_frames, the_best_eight_in_order,
           any_size_of_frame, no_more_rows_than_can_be_measured, refusals, acquire_measures_what_it_finds,
           clipping_saturates, acquire_refuses_hostile_regions, frames_larger_than_a_region, track_frames,
           uncertain_searches_within_reach, first_region_then_anywhere, what_shows_no_inner_part_is_reconsidered)
