/* SPDX-License-Identifier: Apache-2.0 */
/* The outline from edge lists made by hand: found, filtered by polarity and thresholds, and freed of distortion. */
#include "suite.h"

#include "../../../src/outline/harmonics.h"

#include "drogue/outline.h"
#include "drogue/undistort.h"
#include "geometry.h"
#include "own_workspace.h"
#include "rectangle.h"

enum { SIDE = 256, MOST = 8192 };

/* Edge points around an ellipse from parameter 'from' over 'span', one arc a direction class. The gradient points
 * outward, or inward for a bright inside. A camera, where given, distorts the points. */
static drogue_edge_list put_ellipse(test_workspace *t, const ellipse_real *truth, double from, double span, int bright,
                                    const drogue_camera *camera)
{
    static drogue_edge edge[4][MOST];
    uint32_t count[4] = {0, 0, 0, 0}, k, total = 0;
    drogue_edge_list list = {0, 0};
    int i, n = (int)(1.12 * span * truth->a);
    for (i = 0; i < n; i++) {
        double angle = from + span * i / n, x, y, nx, ny, length;
        drogue_edge e;
        uint32_t c;
        ellipse_point(&x, &y, truth, angle);
        nx = cos(angle) / truth->a * cos(truth->angle) - sin(angle) / truth->b * sin(truth->angle);
        ny = cos(angle) / truth->a * sin(truth->angle) + sin(angle) / truth->b * cos(truth->angle);
        length = hypot(nx, ny) * (bright ? -1 : 1);
        if (camera != NULL) {
            drogue_q16 u = q16_of(x), v = q16_of(y);
            ck_assert_int_eq(drogue_distort_point(&u, &v, camera), DROGUE_OK);
            x = real_of_q16(u);
            y = real_of_q16(v);
        }
        e.arc = 0;
        e.x_q5 = (uint16_t)floor(x * 32 + 0.5);
        e.y_q5 = (uint16_t)floor(y * 32 + 0.5);
        e.gx = (int16_t)floor(700 * nx / length + 0.5);
        e.gy = (int16_t)floor(700 * ny / length + 0.5);
        c = drogue_direction_class(e.gx, e.gy);
        edge[c][count[c]++] = e;
    }
    for (k = 0; k < 4; k++) {
        if (count[k] > 0) {
            qsort(edge[k], count[k], sizeof(drogue_edge), raster_order);
            memcpy(t->workspace.edges + total, edge[k], count[k] * sizeof(drogue_edge));
            t->workspace.arcs[list.arc_count].first = total;
            t->workspace.arcs[list.arc_count].count = count[k];
            t->workspace.arcs[list.arc_count].direction = k;
            list.arc_count++;
            total += count[k];
        }
    }
    list.edge_count = total;
    return list;
}

/* Largest difference of centre and semi-axes, px. */
static double apart(const drogue_ellipse *q, const ellipse_real *truth)
{
    ellipse_real e = ellipse_from_q16(q);
    return fmax(hypot(e.xc - truth->xc, e.yc - truth->yc), fmax(fabs(e.a - truth->a), fabs(e.b - truth->b)));
}

static drogue_config plain_config(void)
{
    drogue_config c;
    drogue_config_default(&c);
    c.smooth = 0; /* the points made here were never drawn inward */
    return c;
}

/* The front end's own inward shift, half a squared pixel times the curvature at most, is put back even where there was
 * none. */
static double tolerance(const ellipse_real *e) { return 0.03 + 0.5 * e->a / (e->b * e->b); }

START_TEST(whole_ellipses_of_both_polarities)
{
    uint64_t rng = 1;
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    drogue_config c = plain_config();
    int i, k;
    for (i = 0; i < 300; i++) {
        ellipse_real e = {127 + rng_real(&rng, -8, 8), 127 + rng_real(&rng, -8, 8), rng_real(&rng, 60, 115), 0, 0};
        drogue_edge_list list;
        drogue_outline out;
        int bright = i & 1;
        e.b = e.a * rng_real(&rng, 0.6, 1);
        e.angle = rng_real(&rng, -1.5, 1.5);
        list = put_ellipse(&t, &e, rng_real(&rng, 0, 6), 2 * TEST_PI, bright, NULL);
        c.polarity = DROGUE_POLARITY_BOTH;
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK, "case %d not found", i);
        MUST((int)out.polarity == bright, "case %d: polarity", i);
        MUST(apart(&out.ellipse, &e) < tolerance(&e), "case %d: %g px off", i, apart(&out.ellipse, &e));
        MUST(out.cluster_members >= 1 && out.refit_points > 0 && out.refit_points <= list.edge_count, "case %d: counts",
             i);
        MUST(out.cover_q16 == 65536 && out.quality.reliability_q16 > 40000, "case %d: cover %d, reliability %d", i,
             (int)out.cover_q16, (int)out.quality.reliability_q16);
        for (k = 0; k < 4; k++) {
            MUST(out.arcs[k] == DROGUE_NO_ARC ||
                     (out.arcs[k] < list.arc_count &&
                      t.workspace.arcs[out.arcs[k]].direction == (uint32_t)(bright ? (k + 2) & 3 : k)),
                 "case %d: arc of quadrant %d", i, k);
        }
        c.polarity = bright ? DROGUE_POLARITY_BRIGHT : DROGUE_POLARITY_DARK;
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK, "case %d not found by polarity",
             i);
        c.polarity = bright ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT;
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_E_NO_ARCS, "case %d: wrong polarity",
             i); /* no arc of it */
    }
    ck_assert(guarded_intact(&t.memory));
    test_workspace_free(&t);
}
END_TEST

/* Move an arc outward from the middle of the region. */
static void move_out(const test_workspace *t, const drogue_arc *a, int num, int den)
{
    uint32_t i;
    for (i = a->first; i < a->first + a->count; i++) {
        drogue_edge *p = &t->workspace.edges[i];
        p->x_q5 = (uint16_t)(4080 + (p->x_q5 - 4080) * num / den);
        p->y_q5 = (uint16_t)(4080 + (p->y_q5 - 4080) * num / den);
    }
    qsort(t->workspace.edges + a->first, a->count, sizeof(drogue_edge), raster_order);
}

/* An arc that lies farther out but on another ellipse takes its quadrant, and the winner does without it. */
START_TEST(foreign_arc_is_left_out)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    drogue_config c = plain_config();
    drogue_outline out;
    uint32_t k, foreign, arcs;
    for (foreign = 0; foreign < 4; foreign++) {
        const ellipse_real e = {127.5, 127.5, 95, 90, 0};
        drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
        ck_assert_uint_eq(list.arc_count, 4);
        move_out(&t, &t.workspace.arcs[foreign], 5, 4);
        ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
        MUST(apart(&out.ellipse, &e) < tolerance(&e), "arc %u: %g px off", (unsigned)foreign, apart(&out.ellipse, &e));
        for (k = 0, arcs = 0; k < 4; k++) {
            ck_assert(out.arcs[k] == DROGUE_NO_ARC || (k != foreign && out.arcs[k] == k));
            arcs += out.arcs[k] != DROGUE_NO_ARC;
        }
        ck_assert_uint_eq(arcs, 2);                /* candidates are pairs */
        ck_assert_uint_ge(out.cluster_members, 3); /* the pairs of the other three */
        ck_assert_int_eq(out.cover_q16, 65536 * 3 / 4);
    }
    test_workspace_free(&t);
}
END_TEST

/* Farther arcs of another ellipse in every quadrant: the outline's own are the second choice of each. */
START_TEST(second_choice_of_every_quadrant)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    drogue_config c = plain_config();
    const ellipse_real e = {127.5, 127.5, 80, 76, 0.3};
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    drogue_outline out;
    uint32_t k, first = list.edge_count;
    ck_assert_uint_eq(list.arc_count, 4);
    for (k = 0; k < 4; k++) { /* two thirds of each arc again, each farther out by another factor */
        drogue_arc a = t.workspace.arcs[k];
        memcpy(t.workspace.edges + first, t.workspace.edges + a.first, a.count * sizeof(drogue_edge));
        a.first = first;
        a.count = a.count * 2 / 3;
        move_out(&t, &a, 20 + (int)k, 17);
        t.workspace.arcs[4 + k] = a;
        first += a.count;
    }
    list.edge_count = first;
    list.arc_count = 8;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    MUST(apart(&out.ellipse, &e) < tolerance(&e), "%g px off", apart(&out.ellipse, &e));
    for (k = 0; k < 4; k++) {
        ck_assert(out.arcs[k] == DROGUE_NO_ARC || out.arcs[k] == k);
    }
    ck_assert_int_eq(out.cover_q16, 65536);
    test_workspace_free(&t);
}
END_TEST

/* Turn the gradients of some points of an outline round, and sort the arcs again by their new classes. */
static drogue_edge_list turned(test_workspace *t, const ellipse_real *e, double from, double to)
{
    drogue_edge_list list = put_ellipse(t, e, to, 2 * TEST_PI - (to - from), 0, NULL), other;
    drogue_edge *kept = malloc(list.edge_count * sizeof *kept);
    drogue_arc arcs[8];
    uint32_t k;
    memcpy(kept, t->workspace.edges, list.edge_count * sizeof *kept);
    memcpy(arcs, t->workspace.arcs, list.arc_count * sizeof *arcs);
    other = put_ellipse(t, e, from, to - from, 1, NULL);
    memcpy(t->workspace.edges + other.edge_count, kept, list.edge_count * sizeof *kept);
    for (k = 0; k < list.arc_count; k++) {
        arcs[k].first += other.edge_count;
        t->workspace.arcs[other.arc_count + k] = arcs[k];
    }
    other.edge_count += list.edge_count;
    other.arc_count += list.arc_count;
    free(kept);
    return other;
}

/* The background crosses the drogue's own grey: part of the outline is brighter inside. It is found whole, with the
 * polarity of each bin; with the polarity fixed it is found by what has it. */
START_TEST(outline_of_mixed_polarity)
{
    uint64_t rng = 4;
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    int i;
    for (i = 0; i < 200; i++) {
        ellipse_real e = {127 + rng_real(&rng, -8, 8), 127 + rng_real(&rng, -8, 8), rng_real(&rng, 60, 115), 0, 0};
        double from = rng_real(&rng, 0, 6), part = rng_real(&rng, 0.3, 0.7) * 2 * TEST_PI;
        drogue_config c = plain_config();
        drogue_edge_list list;
        drogue_outline out;
        uint32_t k;
        int bright = 0;
        e.b = e.a * rng_real(&rng, 0.6, 1);
        e.angle = rng_real(&rng, -1.5, 1.5);
        list = turned(&t, &e, from, from + part);
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK, "case %d not found", i);
        MUST(out.polarity == DROGUE_POLARITY_BOTH, "case %d: polarity %d", i, (int)out.polarity);
        MUST(apart(&out.ellipse, &e) < tolerance(&e), "case %d: %g px off", i, apart(&out.ellipse, &e));
        for (k = 0; k < 32; k++) {
            bright += (int)((out.support.bright_bins >> k) & 1u);
        }
        MUST(fabs(bright - 32 * part / (2 * TEST_PI)) <= 1.5, "case %d: %d bright bins of %g rad", i, bright, part);
        MUST(out.support.covered == 30, "case %d: %u bins", i, (unsigned)out.support.covered); /* two changes */
        c.polarity = DROGUE_POLARITY_BRIGHT;
        c.min_cover_q16 = 0;
        if (drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK) {
            MUST(out.polarity == DROGUE_POLARITY_BRIGHT, "case %d: polarity %d, BRIGHT asked", i, (int)out.polarity);
            MUST(fabs(real_of_q16(out.cover_q16) - part / (2 * TEST_PI)) < 1.5 / 32, "case %d: cover %g of %g", i,
                 real_of_q16(out.cover_q16), part / (2 * TEST_PI));
        } else {
            MUST(part < 0.45 * 2 * TEST_PI, "case %d: bright part not found", i);
        }
    }
    ck_assert(guarded_intact(&t.memory));
    test_workspace_free(&t);
}
END_TEST

/* A bump on the outline, as of a hose or a fitting behind the rim, drops out as the band narrows. */
START_TEST(bump_drops_out_of_the_band)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const ellipse_real e = {127.3, 127.8, 100, 90, 0.4};
    drogue_config c = plain_config();
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    drogue_outline out;
    uint32_t i, moved = 0;
    for (i = 0; i < list.edge_count; i++) { /* a twentieth of it, 1.4 px outward: in the first band */
        drogue_edge *p = &t.workspace.edges[i];
        double dx = p->x_q5 / 32.0 - e.xc, dy = p->y_q5 / 32.0 - e.yc;
        if (fabs(atan2(dy, dx) - 1) < TEST_PI / 20) {
            p->x_q5 = (uint16_t)(p->x_q5 + (int)floor(45 * dx / hypot(dx, dy) + 0.5));
            p->y_q5 = (uint16_t)(p->y_q5 + (int)floor(45 * dy / hypot(dx, dy) + 0.5));
            moved++;
        }
    }
    ck_assert_uint_gt(moved, 25);
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    MUST(apart(&out.ellipse, &e) < tolerance(&e), "%g px off", apart(&out.ellipse, &e));
    ck_assert_uint_le(out.refit_points, list.edge_count - moved + 8);
    ck_assert_int_lt(out.band_px_q16, c.refit_band_px_q16);
    ck_assert_int_ge(out.band_px_q16, c.refit_band_px_q16 / 3);
    test_workspace_free(&t);
}
END_TEST

/* Points as far apart as the band is wide, each of them twice, so that every second one shows the same ellipse: that it
 * does not change with those that were looked at is no reason not to collect all. */
START_TEST(all_points_are_collected)
{
    const ellipse_real e = {127, 127, 100, 90, 0.3};
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const drogue_config c = plain_config();
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    static drogue_edge twice[MOST];
    drogue_outline out;
    uint32_t i, n = 0;
    for (i = 0; i < list.arc_count; i++) {
        drogue_arc *arc = &t.workspace.arcs[i];
        const uint32_t first = n;
        uint32_t k;
        for (k = 0; k < arc->count; k += 2) { /* in turn 0.9 px outward and inward */
            drogue_edge p = t.workspace.edges[arc->first + k];
            const double off = (k % 4 < 2 ? 28.8 : -28.8) / hypot(p.gx, p.gy);
            p.x_q5 = (uint16_t)(p.x_q5 + lround(off * p.gx));
            p.y_q5 = (uint16_t)(p.y_q5 + lround(off * p.gy));
            twice[n++] = p;
            twice[n++] = p;
        }
        arc->first = first;
        arc->count = n - first;
    }
    memcpy(t.workspace.edges, twice, n * sizeof twice[0]);
    list.edge_count = n;
    ck_assert(n >= 512 && n < 1024); /* of so many every second one is looked at */
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    ck_assert_uint_eq(out.refit_points, n);
    test_workspace_free(&t);
}
END_TEST

START_TEST(thresholds_decide)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const ellipse_real e = {127, 128, 100, 70, 0.4};
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    drogue_config c = plain_config();
    drogue_outline out;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    c.min_axis_ratio_q16 = q16_of(0.69);
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    c.min_axis_ratio_q16 = q16_of(0.71);
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_ELLIPSE);
    c = plain_config();
    c.max_size_q16 = q16_of(99.0 / SIDE);
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_ELLIPSE);
    c = plain_config();
    c.min_size_q16 = q16_of(101.0 / SIDE);
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_ELLIPSE);
    c = plain_config();
    c.min_fit_ratio_q16 = 65536; /* the least share may be the whole: every point lies on a perfect ellipse */
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    c.quality.fit_error_px_q16 = 1; /* but none this exactly, */
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    c.search_band_q16 = 0; /* which the search band hides */
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_ELLIPSE);
    c = plain_config();
    c.min_short_px_q16 = q16_of(90); /* no arc is as round */
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_ARCS);
    c = plain_config();
    c.refit_rounds = 0;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    ck_assert_uint_eq(out.refit_points, 0);
    test_workspace_free(&t);
}
END_TEST

/* A bin counts when 0.35 points a pixel lie in it, of about 1.1 here: of a bin at either end of the arc 0.32 can be
 * lost, or 0.68 gained. */
START_TEST(cover_is_the_share_of_the_circumference)
{
    uint64_t rng = 6;
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const ellipse_real e = {127, 128, 100, 90, 0.4};
    int i;
    for (i = 0; i < 100; i++) {
        drogue_config c = plain_config();
        double span = rng_real(&rng, 3.2, 6.28), excess;
        drogue_edge_list list = put_ellipse(&t, &e, rng_real(&rng, 0, 6), span, 0, NULL);
        drogue_outline out;
        drogue_q16 cover;
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK, "case %d not found", i);
        cover = out.cover_q16;
        excess = 32 * (real_of_q16(cover) - span / (2 * TEST_PI));
        MUST(excess > -0.8 && excess < 1.5, "case %d: %g of %g", i, real_of_q16(cover), span / (2 * TEST_PI));
        c.min_cover_q16 = cover + 1;
        MUST(cover == 65536 || drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_E_NO_ELLIPSE,
             "case %d found", i);
        c.min_cover_q16 = cover;
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK, "case %d not found again", i);
    }
    test_workspace_free(&t);
}
END_TEST

START_TEST(nothing_to_find)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const ellipse_real e = {127, 128, 100, 90, 0.4};
    drogue_config c = plain_config();
    drogue_edge_list list = {0, 0};
    drogue_outline out, empty;
    int k;
    memset(&empty, 0, sizeof empty);
    for (k = 0; k < 4; k++) {
        empty.arcs[k] = DROGUE_NO_ARC;
    }
    memset(&out, 0x5A, sizeof out);
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_EDGES);
    ck_assert_int_eq(memcmp(&out.ellipse, &empty.ellipse, sizeof out.ellipse), 0);
    ck_assert_int_eq(memcmp(out.arcs, empty.arcs, sizeof out.arcs), 0);
    ck_assert_uint_eq(out.cluster_members + out.refit_points, 0);
    list = put_ellipse(&t, &e, 0, 6.28, 0, NULL);
    list.arc_count = 0;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_E_NO_ARCS);
    ck_assert_int_eq(memcmp(&out.ellipse, &empty.ellipse, sizeof out.ellipse), 0);
    test_workspace_free(&t);
}
END_TEST

START_TEST(distortion_is_removed)
{
    uint64_t rng = 2;
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    drogue_config c = plain_config();
    int i;
    for (i = 0; i < 100; i++) {
        drogue_camera shifted = pinhole(400, 390, 80, 100), camera;
        ellipse_real e = {127, 128, rng_real(&rng, 60, 105), 0, 0.4};
        int32_t x = 300, y = -40;
        drogue_edge_list list;
        drogue_ellipse ideal;
        drogue_outline out;
        e.b = e.a * rng_real(&rng, 0.7, 1);
        shifted.k1_q16 = q16_of(rng_real(&rng, -0.15, 0.15));
        shifted.p1_q16 = q16_of(rng_real(&rng, -0.003, 0.003));
        list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, &shifted);
        MUST(drogue_outline_find(&out, &t.workspace, &list, &mask, &c) == DROGUE_OK, "case %d not found", i);
        camera = shifted; /* the same camera in coordinates of the whole image */
        camera.cx_px_q16 += x * 65536;
        camera.cy_px_q16 += y * 65536;
        MUST(drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, x, y) ==
                 DROGUE_OK,
             "case %d", i);
        e.xc += x;
        e.yc += y;
        MUST(apart(&ideal, &e) < tolerance(&e), "case %d: %g px off", i, apart(&ideal, &e));
    }
    test_workspace_free(&t);
}
END_TEST

START_TEST(undistorted_without_points)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const ellipse_real e = {127, 128, 100, 90, 0.4};
    const drogue_camera camera = pinhole(400, 390, 80, 100);
    drogue_config c = plain_config();
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    drogue_ellipse ideal;
    drogue_outline out;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    list.edge_count = 0;
    ck_assert_int_eq(
        drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, 0, 0),
        DROGUE_E_TOO_FEW_POINTS);
    memset(&out.fitted, 0, sizeof out.fitted);
    ck_assert_int_eq(
        drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, 0, 0),
        DROGUE_E_DEGENERATE);
    test_workspace_free(&t);
}
END_TEST

/* Of the symmetric matrix whose eigenvalues are the semi-axes, px. */
static double shape(const drogue_ellipse *e, int n)
{
    const double a = real_of_q16(e->a_px_q16), b = real_of_q16(e->b_px_q16);
    const double s = sin(real_of_q16(e->angle_rad_q16)), c = cos(real_of_q16(e->angle_rad_q16));
    return n == 0 ? a * c * c + b * s * s : n == 1 ? a * s * s + b * c * c : (a - b) * s * c;
}

/* What is put back goes the same way whatever the angle of the axis, past the vertical too, where it wraps. */
START_TEST(undistorted_and_put_back)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    drogue_camera camera = pinhole(800, 800, 350, 420);
    drogue_config c = plain_config();
    int i;
    camera.k1_q16 = q16_of(-0.05);
    for (i = -40; i <= 40; i++) {
        const ellipse_real e = {127, 128, 100, i % 2 ? 85 : 98, TEST_PI / 2 + 0.001 * i};
        const drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
        const drogue_setup setup = {&camera, NULL, &c};
        drogue_ellipse seen, ideal, moved;
        drogue_outline out;
        int k, n;
        ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
        ck_assert_int_eq(drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &setup, 0, 0), DROGUE_OK);
        for (k = 1; k < 5; k++) {
            double dx, dy;
            memset(out.support.pull_q24, 0, sizeof out.support.pull_q24);
            out.support.pull_q24[k] = (1 << 24) / 100;
            seen = out.fitted;
            drogue_outline_put_back(&seen, out.support.pull_q24);
            ck_assert_int_eq(drogue_outline_undistorted(&moved, &out, &t.workspace, &list, &setup, 0, 0), DROGUE_OK);
            dx = real_of_q16(seen.xc_px_q16 - out.fitted.xc_px_q16) - real_of_q16(moved.xc_px_q16 - ideal.xc_px_q16);
            dy = real_of_q16(seen.yc_px_q16 - out.fitted.yc_px_q16) - real_of_q16(moved.yc_px_q16 - ideal.yc_px_q16);
            MUST(hypot(dx, dy) < 0.06, "angle %d, wave %d: %g, %g px", i, k, dx, dy);
            for (n = 0; n < 3; n++) {
                const double by = shape(&seen, n) - shape(&out.fitted, n) - shape(&moved, n) + shape(&ideal, n);
                MUST(fabs(by) < 0.15, "angle %d, wave %d: shape %d by %g px", i, k, n, by);
            }
        }
    }
    test_workspace_free(&t);
}
END_TEST

/* A lens may take a wide outline to less than a pixel: none, either. */
START_TEST(undistorted_to_less_than_a_pixel)
{
    enum { SMALL = 34 };
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SMALL, SMALL);
    const ellipse_real e = {16.5, 16.5, 14, 13.5, 0};
    drogue_camera camera = pinhole(3.7, 3.7, 16.5, 16.5);
    drogue_config c = plain_config();
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    drogue_ellipse ideal;
    drogue_outline out;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    camera.k1_q16 = q16_of(100); /* to 1.2 px */
    ck_assert_int_eq(
        drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, 0, 0),
        DROGUE_OK);
    camera.k1_q16 = q16_of(256); /* 0.89 px */
    ck_assert_int_eq(
        drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, 0, 0),
        DROGUE_E_DEGENERATE);
    test_workspace_free(&t);
}
END_TEST

/* What the lens model makes too flat of a round outline is none. */
START_TEST(undistorted_to_a_flat_one)
{
    test_workspace t = test_workspace_of(SIDE, MOST, 4096, 64);
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const ellipse_real e = {127, 128, 100, 80, 0};
    const drogue_camera camera = pinhole(400, 400, 127, 128);
    drogue_config c = plain_config();
    drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
    drogue_ellipse ideal;
    drogue_outline out;
    ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
    c.min_axis_ratio_q16 = DROGUE_Q16(79, 100);
    ck_assert_int_eq(
        drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, 0, 0),
        DROGUE_OK);
    c.min_axis_ratio_q16 = DROGUE_Q16(81, 100);
    ck_assert_int_eq(
        drogue_outline_undistorted(&ideal, &out, &t.workspace, &list, &(drogue_setup){&camera, NULL, &c}, 0, 0),
        DROGUE_E_DEGENERATE);
    test_workspace_free(&t);
}
END_TEST

/* An arc of more points than moments hold is noise: the outline is found without it. */
START_TEST(an_arc_of_too_many_points)
{
    enum { NOISE = DROGUE_MAX_FIT_POINTS / 4 + 1 };
    const ellipse_real e = {127, 128, 100, 90, 0.4};
    const drogue_mask mask = drogue_mask_of_size(SIDE, SIDE);
    const drogue_config c = plain_config();
    test_workspace t = test_workspace_of(SIDE, MOST + NOISE, 4096, 64);
    static drogue_edge many[NOISE];
    uint32_t n;
    for (n = NOISE - 1; n <= NOISE; n++) {
        drogue_edge_list list = put_ellipse(&t, &e, 0, 2 * TEST_PI, 0, NULL);
        const uint32_t index = list.arc_count - 1;
        drogue_arc *last = &t.workspace.arcs[index];
        drogue_outline out;
        uint32_t i;
        int used = 0;
        for (i = 0; i < n; i++) { /* the same points over and over, in their order */
            many[i] = t.workspace.edges[last->first + (uint64_t)i * last->count / n];
        }
        memcpy(t.workspace.edges + last->first, many, n * sizeof many[0]);
        last->count = n;
        list.edge_count = last->first + n;
        ck_assert_int_eq(drogue_outline_find(&out, &t.workspace, &list, &mask, &c), DROGUE_OK);
        for (i = 0; i < 4; i++) {
            used |= out.arcs[i] == index;
        }
        MUST(used == (n < NOISE), "%u points: used %d", (unsigned)n, used);
        MUST(apart(&out.ellipse, &e) < 0.5, "%u points: %g px off", (unsigned)n, apart(&out.ellipse, &e));
    }
    test_workspace_free(&t);
}
END_TEST

SUITE_MAIN("outline", whole_ellipses_of_both_polarities, foreign_arc_is_left_out, second_choice_of_every_quadrant,
           outline_of_mixed_polarity, bump_drops_out_of_the_band, all_points_are_collected, thresholds_decide,
           cover_is_the_share_of_the_circumference, nothing_to_find, distortion_is_removed, undistorted_without_points,
           undistorted_and_put_back, undistorted_to_a_flat_one, undistorted_to_less_than_a_pixel,
           an_arc_of_too_many_points)
