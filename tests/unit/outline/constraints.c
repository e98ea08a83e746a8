/* SPDX-License-Identifier: Apache-2.0 */
/* Smallest rectangles against every hull edge tried, verdicts on arcs, choice of two of each quadrant. */
#include "suite.h"

#include "drogue/constraints.h"
#include "rectangle.h"

#define MOST_POINTS 4096

static drogue_edge edge_at(int32_t x, int32_t y, uint64_t *rng)
{
    drogue_edge e;
    memset(&e, 0, sizeof e);
    e.x_q5 = (uint16_t)(32 * x + (rng != NULL && x > 0 ? rng_range(rng, -15, 15) : 0));
    e.y_q5 = (uint16_t)(32 * y + (rng != NULL && y > 0 ? rng_range(rng, -15, 15) : 0));
    return e;
}

static void check_points(const drogue_edge *e, uint32_t count, const char *what)
{
    guarded hull = guarded_alloc(DROGUE_HULL_MAX * sizeof(drogue_point));
    drogue_min_rect r;
    double error;
    MUST(drogue_min_area_rect(&r, hull.data, e, count) == DROGUE_OK, "%s refused", what);
    MUST(guarded_intact(&hull), "%s: hull overrun", what);
    if (count > 1) {
        error = rect_error(&r, e, count);
        MUST(error <= 1.0, "%s, %u points: off by %.3f LSB", what, (unsigned)count, error);
    }
    guarded_free(&hull);
}

START_TEST(rectangle_of_random_points)
{
    uint64_t rng = 1;
    drogue_edge e[40];
    int32_t i, k;
    for (i = 0; i < 4000; i++) {
        int32_t count = rng_range(&rng, 1, 40), side = 1 << rng_range(&rng, 1, 11);
        for (k = 0; k < count; k++) {
            e[k] = edge_at(rng_range(&rng, 0, side - 1), rng_range(&rng, 0, side - 1), &rng);
        }
        check_points(e, sort_unique(e, (uint32_t)count), "random");
    }
}
END_TEST

START_TEST(rectangle_of_arcs)
{
    uint64_t rng = 2;
    static drogue_edge e[MOST_POINTS];
    int32_t i, k;
    for (i = 0; i < 150; i++) {
        double radius = rng_real(&rng, 2, i < 145 ? 60 : 800), from = rng_real(&rng, 0, 7),
               span = rng_real(&rng, 0.2, 6.3);
        int32_t count = (int32_t)(radius * span * 1.2) + 2;
        count = count < MOST_POINTS ? count : MOST_POINTS;
        for (k = 0; k < count; k++) {
            double t = from + span * k / count;
            e[k] = edge_at((int32_t)(1000 + radius * cos(t)), (int32_t)(1000 + 0.7 * radius * sin(t)), NULL);
        }
        check_points(e, sort_unique(e, (uint32_t)count), "arc");
    }
}
END_TEST

START_TEST(rectangle_of_points_on_a_line)
{
    static const int32_t step[8][2] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {3, 1}, {-2, 5}, {7, 0}, {0, 9}};
    drogue_min_rect r;
    drogue_point hull[DROGUE_HULL_MAX];
    drogue_edge e[60];
    int32_t d, count, k;
    for (d = 0; d < 8; d++) {
        for (count = 1; count <= 60; count++) {
            for (k = 0; k < count; k++) {
                e[k] = edge_at(1000 + k * step[d][0], 10 + k * step[d][1], NULL);
            }
            ck_assert_int_eq(drogue_min_area_rect(&r, hull, e, (uint32_t)count), DROGUE_OK);
            ck_assert_int_eq(r.short_px_q16, 0);
            ck_assert_int_le(abs(r.long_px_q16 - q16_of((count - 1) * hypot(step[d][0], step[d][1]))), 1);
            ck_assert_int_eq(r.xc_px_q16, (2000 + (count - 1) * step[d][0]) * 32768);
            ck_assert_int_eq(r.yc_px_q16, (20 + (count - 1) * step[d][1]) * 32768);
        }
    }
}
END_TEST

static int by_angle(const void *p, const void *q)
{
    const drogue_point *a = p, *b = q;
    double d = atan2(a->y, a->x) - atan2(b->y, b->x);
    return d < 0 ? -1 : d > 0;
}

/* Primitive steps in order of angle make the lattice polygon of the most corners in its square. */
START_TEST(hull_of_the_most_corners)
{
    static drogue_point steps[MOST_POINTS];
    static drogue_edge e[MOST_POINTS];
    drogue_min_rect r;
    guarded hull = guarded_alloc(DROGUE_HULL_MAX * sizeof(drogue_point));
    uint32_t count = 0, k;
    int32_t dx, dy, a, b, x = 1000, y = 0, low = 0, high = 0;
    const int32_t reach = 16;
    for (dy = -reach; dy <= reach; dy++) {
        for (dx = -reach; dx <= reach; dx++) {
            for (a = abs(dx), b = abs(dy); b != 0;) {
                int32_t t = a % b;
                a = b;
                b = t;
            }
            if (a == 1 && dx * dx + dy * dy <= 206) {
                steps[count].x = dx;
                steps[count++].y = dy;
            }
        }
    }
    qsort(steps, count, sizeof steps[0], by_angle);
    for (k = 0; k < count; k++) { /* find the extent first, then place the polygon within the region */
        y += steps[k].y;
        low = y < low ? y : low;
        high = y > high ? y : high;
    }
    ck_assert_int_lt(high - low, DROGUE_MAX_SIDE);
    y = -low;
    for (k = 0; k < count; k++) {
        e[k] = edge_at(x, y, NULL);
        x += steps[k].x;
        y += steps[k].y;
    }
    ck_assert_uint_gt(count, 350);
    ck_assert_uint_eq(sort_unique(e, count), count);
    ck_assert_int_eq(drogue_min_area_rect(&r, hull.data, e, count), DROGUE_OK);
    ck_assert(guarded_intact(&hull));
    ck_assert(rect_error(&r, e, count) <= 1.0);
    guarded_free(&hull);
}
END_TEST

/* Right triangles, whose rectangle on the long side has the area of that on the legs. The hull runs from its first
 * point in raster order clockwise as seen: the long side comes first in one and last in the other. */
START_TEST(first_of_equal_rectangles_wins)
{
    drogue_min_rect r;
    drogue_point hull[DROGUE_HULL_MAX];
    drogue_edge e[3];
    e[0] = edge_at(10, 10, NULL);
    e[1] = edge_at(35, 10, NULL);
    e[2] = edge_at(19, 22, NULL);
    ck_assert_int_eq(drogue_min_area_rect(&r, hull, e, 3), DROGUE_OK);
    ck_assert(r.short_px_q16 == 12 * 65536 && r.long_px_q16 == 25 * 65536);
    e[1] = edge_at(22, 19, NULL);
    e[2] = edge_at(10, 35, NULL);
    ck_assert_int_eq(drogue_min_area_rect(&r, hull, e, 3), DROGUE_OK);
    ck_assert(r.short_px_q16 == 15 * 65536 && r.long_px_q16 == 20 * 65536);
}
END_TEST

START_TEST(no_points)
{
    drogue_min_rect r;
    drogue_point hull[DROGUE_HULL_MAX];
    drogue_edge e = edge_at(3, 4, NULL);
    ck_assert_int_eq(drogue_min_area_rect(&r, hull, &e, 0), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_min_area_rect(&r, hull, &e, 1), DROGUE_OK);
    ck_assert(r.xc_px_q16 == 3 * 65536 && r.yc_px_q16 == 4 * 65536 && r.short_px_q16 == 0 && r.long_px_q16 == 0);
}
END_TEST

START_TEST(a_point_twice_is_one)
{
    drogue_min_rect r;
    drogue_point hull[DROGUE_HULL_MAX];
    drogue_edge e[4];
    int k;
    for (k = 0; k < 4; k++) {
        e[k] = edge_at(3 + k / 2, 4, NULL);
    }
    ck_assert_int_eq(drogue_min_area_rect(&r, hull, e, 2), DROGUE_OK);
    ck_assert(r.xc_px_q16 == 3 * 65536 && r.yc_px_q16 == 4 * 65536 && r.short_px_q16 == 0 && r.long_px_q16 == 0);
    ck_assert_int_eq(drogue_min_area_rect(&r, hull, e, 4), DROGUE_OK);
    ck_assert(r.xc_px_q16 == 7 * 32768 && r.long_px_q16 == 65536 && r.short_px_q16 == 0);
}
END_TEST

START_TEST(quadrants)
{
    ck_assert_int_eq(drogue_quadrant(1, -1), 0);
    ck_assert_int_eq(drogue_quadrant(-1, -1), 1);
    ck_assert_int_eq(drogue_quadrant(-1, 1), 2);
    ck_assert_int_eq(drogue_quadrant(1, 1), 3);
    ck_assert_int_eq(drogue_quadrant(INT32_MAX, INT32_MIN), 0);
    ck_assert_int_eq(drogue_quadrant(0, 1), -1);
    ck_assert_int_eq(drogue_quadrant(1, 0), -1);
    ck_assert_int_eq(drogue_quadrant(0, 0), -1);
}
END_TEST

/* An L of three points, its rectangle 2 by 1 or so, with its middle at (x + 1, y + 0.5). */
static void put_arc(drogue_edge *e, drogue_arc *arc, uint32_t first, int32_t x, int32_t y, uint32_t direction)
{
    e[first] = edge_at(x, y, NULL);
    e[first + 1] = edge_at(x + 2, y, NULL);
    e[first + 2] = edge_at(x, y + 1, NULL);
    e[first + 3] = edge_at(x + 2, y + 1, NULL);
    arc->first = first;
    arc->count = 4;
    arc->direction = direction;
}

START_TEST(verdict_on_every_direction_in_every_quadrant)
{
    static const int32_t at[4][2] = {{70, 10}, {10, 20}, {20, 80}, {90, 60}};
    const drogue_mask mask = drogue_mask_of_size(101, 101);
    drogue_point hull[DROGUE_HULL_MAX];
    drogue_arc_verdict v;
    drogue_edge e[4];
    drogue_arc arc;
    uint32_t direction;
    int q;
    for (q = 0; q < 4; q++) {
        for (direction = 0; direction < 4; direction++) {
            double dx = at[q][0] + 1 - 50, dy = at[q][1] + 0.5 - 50;
            int turn = (q - (int)direction) & 3;
            put_arc(e, &arc, 0, at[q][0], at[q][1], direction);
            drogue_judge_arc(&v, hull, e, &arc, &mask, 65536);
            ck_assert_int_eq(v.quadrant, turn == 0 || turn == 2 ? q : -1);
            ck_assert(v.distance2_q32 == (int64_t)((dx * dx + dy * dy) * 4294967296.0));
            if (v.quadrant >= 0) {
                ck_assert_int_eq(v.polarity, turn == 0 ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT);
            }
            drogue_judge_arc(&v, hull, e, &arc, &mask, 65537); /* one LSB too straight */
            ck_assert_int_eq(v.quadrant, -1);
        }
    }
    put_arc(e, &arc, 0, 49, 10, 0); /* its middle on the vertical axis */
    drogue_judge_arc(&v, hull, e, &arc, &mask, 0);
    ck_assert_int_eq(v.quadrant, -1);
}
END_TEST

/* A run of edge points along two rows, as many as wanted: its middle is about (x + (count / 2 - 1) / 2, y + 0.5). */
static void put_run(drogue_edge *e, drogue_arc *arc, uint32_t first, uint32_t count, int32_t x, int32_t y,
                    uint32_t direction)
{
    uint32_t k;
    for (k = 0; k < count; k++) {
        e[first + k] = edge_at(x + (int32_t)(k % (count / 2)), y + (int32_t)(k / (count / 2)), NULL);
    }
    arc->first = first;
    arc->count = count;
    arc->direction = direction;
}

/* The choice by its words: of the four longest arcs (the first of equals) those with half the longest one's points, of
 * these the farthest, then the longest of the others. */
static int model_choices(drogue_arc_choices *out, drogue_point *hull, const drogue_edge *e, const drogue_arc *arcs,
                         uint32_t count, const drogue_mask *mask, drogue_q16 min_short, drogue_polarity polarity)
{
    drogue_arc_verdict v[100];
    int32_t q;
    uint32_t i;
    int any = 0;
    for (i = 0; i < count; i++) {
        drogue_judge_arc(&v[i], hull, e, &arcs[i], mask, min_short);
        if (polarity != DROGUE_POLARITY_BOTH && v[i].polarity != polarity) {
            v[i].quadrant = -1;
        }
    }
    for (q = 0; q < 4; q++) {
        uint32_t longest[4], found = 0, far = 0, k;
        while (found < 4) {
            uint32_t best = DROGUE_NO_ARC;
            for (i = 0; i < count; i++) {
                int taken = 0;
                for (k = 0; k < found; k++) {
                    taken |= longest[k] == i;
                }
                if (v[i].quadrant == q && !taken && (best == DROGUE_NO_ARC || arcs[i].count > arcs[best].count)) {
                    best = i;
                }
            }
            if (best == DROGUE_NO_ARC) {
                break;
            }
            longest[found++] = best;
        }
        for (k = 1; k < found; k++) {
            if (2 * arcs[longest[k]].count >= arcs[longest[0]].count &&
                v[longest[k]].distance2_q32 > v[longest[far]].distance2_q32) {
                far = k;
            }
        }
        out->arc[q][0] = found > 0 ? longest[far] : DROGUE_NO_ARC;
        out->arc[q][1] = found > 1 ? longest[far == 0 ? 1 : 0] : DROGUE_NO_ARC;
        any |= found > 0;
    }
    return any;
}

START_TEST(choices_of_each_quadrant)
{
    enum { MOST_ARCS = 100 };
    const drogue_mask mask = drogue_mask_of_size(200, 200);
    drogue_point hull[DROGUE_HULL_MAX];
    static drogue_edge e[30 * MOST_ARCS];
    static drogue_arc arcs[MOST_ARCS];
    drogue_arc_choices got, model;
    uint64_t rng = 3;
    uint32_t i;
    int round, p, second = 0, nearer = 0, none = 0;
    for (round = 0; round < 1500; round++) {
        uint32_t count = (uint32_t)rng_range(&rng, 0, round & 1 ? MOST_ARCS : 6), total = 0;
        for (i = 0; i < count; i++) { /* a coarse grid and few lengths give equals */
            uint32_t points = 2u * (uint32_t)rng_range(&rng, 2, round % 3 ? 4 : 15);
            put_run(e, &arcs[i], total, points, 10 * rng_range(&rng, 0, 18), 10 * rng_range(&rng, 0, 19),
                    (uint32_t)rng_range(&rng, 0, 3));
            total += points;
        }
        for (p = 0; p <= DROGUE_POLARITY_BOTH; p++) {
            int any = model_choices(&model, hull, e, arcs, count, &mask, 65536, (drogue_polarity)p);
            MUST(drogue_select_arcs(&got, hull, e, arcs, count, &mask, 65536, (drogue_polarity)p) ==
                     (any ? DROGUE_OK : DROGUE_E_NO_ARCS),
                 "round %d, polarity %d: status", round, p);
            MUST(memcmp(&got, &model, sizeof got) == 0, "round %d, polarity %d: choice", round, p);
            none += !any;
            for (i = 0; i < 4; i++) {
                second += got.arc[i][1] != DROGUE_NO_ARC;
                nearer += got.arc[i][1] != DROGUE_NO_ARC && arcs[got.arc[i][1]].count > arcs[got.arc[i][0]].count;
            }
        }
    }
    ck_assert_int_gt(second, 1000);
    ck_assert_int_gt(nearer, 500); /* a farther, shorter arc came first */
    ck_assert_int_gt(none, 50);
}
END_TEST

/* A stub far out neither takes the quadrant from the outline's long arc nor hides it; an arc as long as half of it does
 * go first, and the long one stays second. */
START_TEST(stub_beyond_the_outline)
{
    const drogue_mask mask = drogue_mask_of_size(200, 200);
    drogue_point hull[DROGUE_HULL_MAX];
    static drogue_edge e[100];
    drogue_arc arcs[3];
    drogue_arc_choices got;
    put_run(e, &arcs[0], 0, 40, 110, 60, 0);
    put_run(e, &arcs[1], 40, 18, 180, 5, 0); /* stub: less than half */
    put_run(e, &arcs[2], 58, 20, 170, 20, 0);
    ck_assert_int_eq(drogue_select_arcs(&got, hull, e, arcs, 2, &mask, 65536, DROGUE_POLARITY_BOTH), DROGUE_OK);
    ck_assert_uint_eq(got.arc[0][0], 0);
    ck_assert_uint_eq(got.arc[0][1], 1);
    ck_assert_int_eq(drogue_select_arcs(&got, hull, e, arcs, 3, &mask, 65536, DROGUE_POLARITY_BOTH), DROGUE_OK);
    ck_assert_uint_eq(got.arc[0][0], 2);
    ck_assert_uint_eq(got.arc[0][1], 0);
    ck_assert_int_eq(drogue_select_arcs(&got, hull, e, arcs, 3, &mask, 65537, DROGUE_POLARITY_BOTH), DROGUE_E_NO_ARCS);
    ck_assert_int_eq(drogue_select_arcs(&got, hull, e, arcs, 3, &mask, 65536, DROGUE_POLARITY_BRIGHT),
                     DROGUE_E_NO_ARCS);
    ck_assert_int_eq(drogue_select_arcs(&got, hull, e, arcs, 0, &mask, 0, DROGUE_POLARITY_BOTH), DROGUE_E_NO_ARCS);
    ck_assert_uint_eq(got.arc[3][1], DROGUE_NO_ARC);
}
END_TEST

SUITE_MAIN("constraints", rectangle_of_random_points, rectangle_of_arcs, rectangle_of_points_on_a_line,
           hull_of_the_most_corners, first_of_equal_rectangles_wins, no_points, a_point_twice_is_one, quadrants,
           verdict_on_every_direction_in_every_quadrant, choices_of_each_quadrant, stub_beyond_the_outline)
