/* SPDX-License-Identifier: Apache-2.0 */
/* How often a measurement runs the front end: never more than docs/performance.md says. */
#include "suite.h"

#include "drogue/drogue.h"
#include "geometry.h"
#include "own_workspace.h"

static int runs;    /* of the front end */
static int returns; /* those to have the best try's edges again */
static int scored;  /* outlines that a disc allows */

/* The library's own source, its calls counted. */
#define drogue_frontend_begin(...) (runs++, drogue_frontend_begin(__VA_ARGS__))
#define drogue_outline_covered(...) (scored++, drogue_outline_covered(__VA_ARGS__))
#include "src/look.c"
#define drogue_frame_edges(f, region) (returns++, drogue_frame_edges(f, region))
#include "src/drogue.c"

enum { MOST_PX = 110, MOST_RETURNS = 2 };

/* By the configured thresholds: a look, a second one, the first again. By those of the noise as many, and one for each
 * threshold before that fills a table. About the disc. As many as first in a narrower and in a wider region. */
enum { MOST_RUNS = 3 + RAISES + 3 + 1 + 2 * 3 + MOST_RETURNS };

typedef struct scene {
    uint8_t pixels[MOST_PX * MOST_PX];
    drogue_image image;
    drogue_region region;
    drogue_camera camera;
    drogue_model model;
    drogue_config config;
    drogue_capacity capacity;
} scene;

/* From 1 within an edge to 0 outside. */
static double within_of(double out_px) { return fmin(fmax(0.5 - out_px, 0), 1); }

/* A rim with a band about it, a disc inside that need not be of its size nor at its place, noise. */
static void draw(scene *s, uint64_t *rng)
{
    const double side = rng_range(rng, 40, MOST_PX), a = rng_real(rng, 8, side / 2), b = a * rng_real(rng, 0.3, 1),
                 turn = rng_real(rng, 0, 3.14), xc = side / 2 + rng_real(rng, -8, 8),
                 yc = side / 2 + rng_real(rng, -8, 8), inner = a * rng_real(rng, 0.15, 0.6),
                 xd = xc + 0.1 * a * rng_real(rng, -1, 1), yd = yc + 0.1 * a * rng_real(rng, -1, 1),
                 wide = rng_real(rng, 1, 9), noise = rng_range(rng, 0, 2) ? rng_real(rng, 0, 6) : rng_real(rng, 0, 40),
                 ground = rng_real(rng, 0, 255), canopy = rng_real(rng, 0, 255), band = rng_real(rng, 0, 255),
                 dark = rng_real(rng, 0, 255);
    int32_t x, y;
    s->image.data = s->pixels;
    s->image.width_px = s->image.height_px = s->image.stride = (int32_t)side;
    for (y = 0; y < s->image.height_px; y++) {
        for (x = 0; x < s->image.width_px; x++) {
            const double u = cos(turn) * (x - xc) + sin(turn) * (y - yc),
                         v = cos(turn) * (y - yc) - sin(turn) * (x - xc), out = (hypot(u / a, v / b) - 1) * b;
            double grey = ground + (band - ground) * within_of(out - wide);
            grey += (canopy - grey) * within_of(out);
            grey += (dark - grey) * within_of(hypot(x - xd, y - yd) - inner);
            s->pixels[y * s->image.width_px + x] = (uint8_t)fmin(fmax(grey + noise * rng_normal(rng), 0), 255);
        }
    }
    s->region.width_px = s->region.height_px = (int32_t)(2.5 * a);
    s->region.x_px = (int32_t)(xc - 1.25 * a);
    s->region.y_px = (int32_t)(yc - 1.25 * a);
    s->camera = pinhole(rng_real(rng, 300, 2000), 0, side / 2, side / 2);
    s->camera.fy_px_q16 = s->camera.fx_px_q16;
    s->model.rim_radius_m_q16 = 22938;
    s->model.inner_radius_m_q16 = (int32_t)(22938 * inner / a);
    s->model.inner_depth_m_q16 = rng_range(rng, 0, 30000);
}

/* Any scene: room for all edges or little, and usual or easily met limits. */
static void draw_scene(scene *s, uint64_t number)
{
    uint64_t rng = number * 7919 + 1;
    draw(s, &rng);
    drogue_config_default(&s->config);
    if (rng_range(&rng, 0, 1)) {
        s->config.canny_high = rng_range(&rng, 10, 2000);
        s->config.canny_low = rng_range(&rng, 0, s->config.canny_high);
        s->config.canny_least = rng_range(&rng, 0, s->config.canny_high);
        s->config.recentre_cover_q16 = rng_range(&rng, 0, 65536);
        s->config.min_cover_q16 = rng_range(&rng, 0, 65536);
        s->config.min_arc_px = (uint32_t)rng_range(&rng, 3, 20);
    }
    drogue_capacity_for_any(&s->capacity, 2 * MOST_PX, 2 * MOST_PX, s->config.min_arc_px);
    if (rng_range(&rng, 0, 1)) {
        s->capacity.edges = (uint32_t)rng_range(&rng, 60, 900);
    }
}

static void measure_scene(drogue_result *r, const scene *s, uint32_t width_px)
{
    test_workspace t = test_workspace_of(width_px, s->capacity.edges, s->capacity.labels, s->capacity.arcs);
    (void)drogue_measure(r, &t.workspace, &(drogue_setup){&s->camera, &s->model, &s->config}, &s->image, &s->region);
    test_workspace_free(&t);
}

static void count_runs(scene *s, uint64_t number)
{
    drogue_result r;
    draw_scene(s, number);
    runs = 0;
    returns = 0;
    measure_scene(&r, s, s->capacity.width_px);
}

/* Scenes in a row, and of 40,000 some of those with the most runs, up to 13, or with two returns. */
START_TEST(no_more_than_the_page_says)
{
    static const uint64_t far[] = {491,  7982, 10547, 10317, 683,   1212,  1226,  1256,  1350,  1399, 1580,
                                   1605, 3480, 4391,  5326,  11142, 15904, 17272, 17348, 39524, 39933};
    static scene s;
    uint64_t k;
    int most = 0, most_returns = 0;
    for (k = 0; k < 300 + sizeof far / sizeof far[0]; k++) {
        const uint64_t number = k < 300 ? k : far[k - 300];
        count_runs(&s, number);
        MUST(runs >= 1 && runs <= MOST_RUNS, "scene %d: %d runs", (int)number, runs);
        MUST(returns <= MOST_RETURNS, "scene %d: %d returns", (int)number, returns);
        most = runs > most ? runs : most;
        most_returns = returns > most_returns ? returns : most_returns;
    }
    ck_assert_int_gt(most, 12); /* the scenes come near */
    ck_assert_int_eq(most_returns, MOST_RETURNS);
}
END_TEST

/* The list is that of the outline that stands, whether or not there was room to look for another one after it. */
START_TEST(lists_of_what_stands)
{
    static scene s;
    uint64_t number;
    int alike = 0;
    for (number = 0; number < 300; number++) {
        drogue_result roomy, narrow;
        draw_scene(&s, number);
        measure_scene(&roomy, &s, s.capacity.width_px);
        measure_scene(&narrow, &s, (uint32_t)s.region.width_px);
        if (roomy.status == DROGUE_OK && narrow.status == DROGUE_OK && roomy.tried == narrow.tried &&
            memcmp(&roomy.ellipse, &narrow.ellipse, sizeof roomy.ellipse) == 0 &&
            memcmp(&roomy.region, &narrow.region, sizeof roomy.region) == 0) {
            MUST(roomy.list.edge_count == narrow.list.edge_count, "scene %d: %d edges, %d", (int)number,
                 (int)roomy.list.edge_count, (int)narrow.list.edge_count);
            alike++;
        }
    }
    ck_assert_int_gt(alike, 80);
}
END_TEST

/* Uniform noise: where edges are everywhere nothing is scored about a disc, nor another region looked at. With a tenth of
 * its contrast, whose edges the configured thresholds refuse, both are. */
START_TEST(no_more_in_noise_than_its_own_edges)
{
    static scene s;
    uint64_t number;
    int faint, scored_in_faint = 0;
    for (number = 0; number < 60; number++) {
        for (faint = 0; faint <= 1; faint++) {
            const int side = number < 20 ? 64 : 100;
            uint64_t rng = number + 1;
            test_workspace t = test_workspace_ample(100, 100);
            drogue_result r;
            int k;
            draw_scene(&s, 0);
            drogue_config_default(&s.config);
            for (k = 0; k < side * side; k++) {
                s.pixels[k] = (uint8_t)(rng_range(&rng, 0, 255) / (faint ? 10 : 1));
            }
            s.image.width_px = s.image.height_px = s.image.stride = side;
            s.region = (drogue_region){0, 0, side, side};
            s.camera = pinhole(7 * side, 7 * side, side / 2, side / 2);
            s.model.inner_radius_m_q16 = 7537;
            s.model.inner_depth_m_q16 = 6554;
            runs = scored = 0;
            (void)drogue_measure(&r, &t.workspace, &(drogue_setup){&s.camera, &s.model, &s.config}, &s.image,
                                 &s.region);
            MUST(faint ? runs >= 3 : runs <= 2 && scored == 0, "noise %d, %s: %d runs, %d scored", (int)number,
                 faint ? "faint" : "strong", runs, scored);
            scored_in_faint += scored;
            test_workspace_free(&t);
        }
    }
    ck_assert_int_gt(scored_in_faint, 0);
}
END_TEST

SUITE_MAIN("runs", no_more_than_the_page_says, lists_of_what_stands, no_more_in_noise_than_its_own_edges)
