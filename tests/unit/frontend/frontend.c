/* SPDX-License-Identifier: Apache-2.0 */
/* The one-pass front end against two passes with flood fill: same points, same arcs, same order; full tables. */
#include "suite.h"

#include "frontend_model.h"
#include "images.h"
#include "own_workspace.h"

#ifdef EXPECTED_ROW_PARTS
#include "rows.h"
#endif

static void compare(const model *m, const drogue_workspace *w, const drogue_edge_list *list, int seed)
{
    uint32_t i, next = 0;
    MUST(list->edge_count == m->listed, "seed %d: %u points instead of %u", seed, (unsigned)list->edge_count,
         (unsigned)m->listed);
    MUST(list->arc_count == m->long_arcs, "seed %d: %u arcs instead of %u", seed, (unsigned)list->arc_count,
         (unsigned)m->long_arcs);
    for (i = 0; i < m->listed; i++) {
        const drogue_edge *e = &w->edges[i], *f = &m->list[i];
        MUST(e->x_q5 == f->x_q5 && e->y_q5 == f->y_q5 && e->gx == f->gx && e->gy == f->gy, "seed %d: point %u", seed,
             (unsigned)i);
        MUST(e->arc == m->list_arc[i], "seed %d: arc of point %u", seed, (unsigned)i);
        MUST(m->edge[drogue_edge_y_px(e) * m->width + drogue_edge_x_px(e)].x_q5 == f->x_q5,
             "seed %d: pixel of point %u", seed, (unsigned)i);
    }
    for (i = 0; i < list->arc_count; i++) {
        const drogue_arc *a = &w->arcs[i];
        MUST(a->first == next && a->count > 0, "seed %d: arc %u is not where the last one ends", seed, (unsigned)i);
        next += a->count;
        MUST(a->direction == drogue_direction_class(w->edges[a->first].gx, w->edges[a->first].gy) &&
                 w->edges[a->first].arc == i && w->edges[next - 1].arc == i,
             "seed %d: arc %u", seed, (unsigned)i);
    }
}

static drogue_frontend_config random_config(int32_t width, int32_t height, uint64_t *rng)
{
    drogue_frontend_config c;
    static const int32_t most[4] = {0, 60, 600, 3000};
    c.canny_low = rng_range(rng, 0, most[rng_range(rng, 0, 3)]);
    c.canny_high = c.canny_low + rng_range(rng, 0, most[rng_range(rng, 0, 3)]);
    c.smooth = rng_range(rng, 0, 1);
    c.use_ring = rng_range(rng, 0, 1);
    c.ring = drogue_mask_of_size(width, height);
    c.ring.centre2_x += rng_range(rng, -8, 8) * rng_range(rng, 0, 1);
    c.ring.longest_px += rng_range(rng, 0, 8) * rng_range(rng, 0, 1);
    c.min_arc_px = (uint32_t)rng_range(rng, 0, 12);
    return c;
}

/* One random image through 'workspace' of the width and more, or through a fresh one. */
static void check_seed(int seed, int32_t width, int32_t height, test_workspace *shared)
{
    uint64_t rng = (uint64_t)seed;
    drogue_frontend_config config = random_config(width, height, &rng);
    uint8_t *pixels = malloc((size_t)width * (size_t)height);
    test_workspace fresh = test_workspace_ample(width, height);
    test_workspace *t = shared != NULL ? shared : &fresh;
    drogue_edge_list list;
    model m;
    image_fill(pixels, width, height, seed % IMAGE_KINDS, &rng);
    m = model_of(pixels, width, height, &config);
    MUST(frontend_run(&list, &t->workspace, &config, pixels, width, height) == DROGUE_OK, "seed %d refused", seed);
    compare(&m, &t->workspace, &list, seed);
    MUST(guarded_intact(&t->memory), "seed %d wrote outside", seed);
    model_free(&m);
    test_workspace_free(&fresh);
    free(pixels);
}

START_TEST(every_small_size)
{
    int32_t width, height, k;
    for (height = 1; height <= 8; height++) {
        for (width = 1; width <= 8; width++) {
            for (k = 0; k < 14; k++) {
                check_seed(1000 * height + 100 * width + k, width, height, NULL);
            }
        }
    }
    for (k = 0; k < 14; k++) {
        check_seed(k, 1, 200, NULL);
        check_seed(k, 200, 1, NULL);
        check_seed(k, DROGUE_MAX_SIDE, 2, NULL);
        check_seed(k, 2, DROGUE_MAX_SIDE, NULL);
    }
}
END_TEST

START_TEST(random_images)
{
    int seed;
    for (seed = 1; seed <= 350; seed++) {
        uint64_t rng = (uint64_t)seed + 7000u;
        check_seed(seed, rng_range(&rng, 1, 64), rng_range(&rng, 1, 64), NULL);
    }
}
END_TEST

START_TEST(one_workspace_for_many_sizes)
{
    test_workspace t = test_workspace_ample(80, 80);
    int seed;
    for (seed = 1; seed <= 150; seed++) {
        uint64_t rng = (uint64_t)seed + 9000u;
        check_seed(seed, rng_range(&rng, 1, 80), rng_range(&rng, 1, 80), &t);
    }
    test_workspace_free(&t);
}
END_TEST

/* What is tested is the form of the row kernels that was asked for: on any machine one of them is not the usual. */
START_TEST(the_form_asked_for)
{
#ifdef EXPECTED_ROW_PARTS
    ck_assert_int_eq(DROGUE_ROW_PARTS, EXPECTED_ROW_PARTS);
#endif
}
END_TEST

/* The most merges there can be in a row, of both kinds: their list is as long as the row. */
START_TEST(merges_fill_no_more_than_a_row)
{
    int seed;
    for (seed = 0; seed < 200; seed++) {
        const int32_t width = 3 + seed % 14, height = 9;
        uint64_t rng = (uint64_t)seed + 400u;
        uint8_t pixels[16 * 9];
        drogue_frontend_config config;
        test_workspace t = test_workspace_ample(width, height);
        drogue_edge_list list;
        model m;
        int32_t i;
        for (i = 0; i < width * height; i++) {
            pixels[i] = (uint8_t)(255 * rng_range(&rng, 0, 1));
        }
        memset(&config, 0, sizeof config);
        m = model_of(pixels, width, height, &config);
        ck_assert_int_eq(frontend_run(&list, &t.workspace, &config, pixels, width, height), DROGUE_OK);
        compare(&m, &t.workspace, &list, seed);
        ck_assert(guarded_intact(&t.memory));
        model_free(&m);
        test_workspace_free(&t);
    }
}
END_TEST

/* A ring of noise in a 60 x 60 image: enough of everything to fill each table. */
static model full_case(uint8_t pixels[3600], drogue_frontend_config *config)
{
    uint64_t rng = 5;
    image_fill(pixels, 60, 60, IMAGE_NOISE, &rng);
    memset(config, 0, sizeof *config);
    config->canny_low = 100;
    config->canny_high = 500;
    config->use_ring = 1;
    config->ring = drogue_mask_of_size(60, 60);
    config->min_arc_px = 3;
    return model_of(pixels, 60, 60, config);
}

START_TEST(edge_table_overfilled_by_one)
{
    uint8_t pixels[3600];
    drogue_frontend_config config;
    model m = full_case(pixels, &config);
    uint32_t less, i;
    for (less = 0; less <= 1; less++) {
        test_workspace t = test_workspace_of(60, m.candidates - less, 3600, 3600);
        drogue_edge_list list;
        drogue_status status = frontend_run(&list, &t.workspace, &config, pixels, 60, 60);
        ck_assert_int_eq(status, less ? DROGUE_E_EDGES_FULL : DROGUE_OK);
        ck_assert(guarded_intact(&t.memory));
        ck_assert_uint_le(m.listed - list.edge_count, less);
        for (i = 0; i < list.edge_count; i++) {
            const drogue_edge *e = &t.workspace.edges[i];
            int32_t at = drogue_edge_y_px(e) * 60 + drogue_edge_x_px(e);
            MUST(m.alive[at] && m.key[at] && m.edge[at].gx == e->gx && m.edge[at].gy == e->gy, "point %u is none",
                 (unsigned)i);
        }
        test_workspace_free(&t);
    }
    model_free(&m);
}
END_TEST

START_TEST(arc_table_overfilled_by_one)
{
    uint8_t pixels[3600];
    drogue_frontend_config config;
    model m = full_case(pixels, &config);
    uint32_t less, i;
    ck_assert_uint_gt(m.long_arcs, 2);
    for (less = 0; less <= 1; less++) {
        test_workspace t = test_workspace_of(60, 3600, 3600, m.long_arcs - less);
        drogue_edge_list list;
        drogue_status status = frontend_run(&list, &t.workspace, &config, pixels, 60, 60);
        ck_assert_int_eq(status, less ? DROGUE_E_ARCS_FULL : DROGUE_OK);
        ck_assert(guarded_intact(&t.memory));
        ck_assert_uint_eq(list.edge_count, m.listed);
        ck_assert_uint_eq(list.arc_count, m.long_arcs - less);
        for (i = 0; i < list.edge_count && m.list_arc[i] < list.arc_count; i++) {
            MUST(t.workspace.edges[i].x_q5 == m.list[i].x_q5 && t.workspace.edges[i].y_q5 == m.list[i].y_q5, "point %u",
                 (unsigned)i);
        }
        for (; i < list.edge_count; i++) {
            MUST(t.workspace.edges[i].arc == DROGUE_NO_ARC, "point %u has an arc", (unsigned)i);
        }
        test_workspace_free(&t);
    }
    model_free(&m);
}
END_TEST

START_TEST(label_table_overfilled_by_one)
{
    uint8_t pixels[3600];
    drogue_frontend_config config;
    model m = full_case(pixels, &config);
    uint32_t low = 2, high = 3600, i; /* low is too few, high enough */
    drogue_edge_list list;
    while (high - low > 1) {
        uint32_t middle = (low + high) / 2;
        test_workspace t = test_workspace_of(60, 3600, middle, 3600);
        drogue_status status = frontend_run(&list, &t.workspace, &config, pixels, 60, 60);
        ck_assert(status == DROGUE_OK || status == DROGUE_E_LABELS_FULL);
        ck_assert(guarded_intact(&t.memory));
        for (i = 0; i < list.edge_count; i++) {
            const drogue_edge *e = &t.workspace.edges[i];
            MUST(m.key[drogue_edge_y_px(e) * 60 + drogue_edge_x_px(e)] != 0, "point %u is none", (unsigned)i);
        }
        if (status == DROGUE_OK) {
            compare(&m, &t.workspace, &list, 0);
            high = middle;
        } else {
            low = middle;
        }
        test_workspace_free(&t);
    }
    ck_assert_uint_gt(high, m.long_arcs);
    model_free(&m);
}
END_TEST

START_TEST(workspace_arguments)
{
    static const drogue_capacity good = {33, 7, 5, 3};
    static const drogue_capacity bad[] = {{0, 7, 5, 3},
                                          {DROGUE_MAX_SIDE + 1, 7, 5, 3},
                                          {33, 0, 5, 3},
                                          {33, 7, 1, 3},
                                          {33, 7, 5, 0},
                                          {33, (1u << 24) + 1u, 5, 3},
                                          {33, 7, (1u << 24) + 1u, 3},
                                          {33, 7, 5, (1u << 24) + 1u}};
    static uint32_t macro_memory[DROGUE_WORKSPACE_BYTES(33, 7, 5, 3) / 4 + 1];
    drogue_workspace w;
    guarded g = guarded_alloc(drogue_workspace_bytes(&good) + 4u);
    size_t i, bytes = drogue_workspace_bytes(&good);
    ck_assert_uint_eq(bytes, DROGUE_WORKSPACE_BYTES(33, 7, 5, 3));
    ck_assert_int_eq(drogue_workspace_init(&w, macro_memory, sizeof macro_memory, &good), DROGUE_OK);
    ck_assert_int_eq(drogue_workspace_init(&w, g.data, bytes, &good), DROGUE_OK);
    ck_assert_int_eq(drogue_workspace_init(&w, g.data, bytes - 1u, &good), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(drogue_workspace_init(&w, g.data, 0, &good), DROGUE_E_WORKSPACE);
    for (i = 1; i <= 3; i++) {
        ck_assert_int_eq(drogue_workspace_init(&w, (uint8_t *)g.data + i, bytes, &good), DROGUE_E_ARGUMENT);
    }
    ck_assert_int_eq(drogue_workspace_init(&w, NULL, bytes, &good), DROGUE_E_ARGUMENT);
    for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        ck_assert_int_eq(drogue_workspace_init(&w, g.data, g.bytes, &bad[i]), DROGUE_E_ARGUMENT);
    }
    guarded_free(&g);
}
END_TEST

/* What was refused has room for nothing, whatever the struct held; its own capacity may be what it is made with. */
START_TEST(refused_workspace_is_empty)
{
    static const drogue_capacity good = {33, 7, 5, 3}, none = {0, 7, 5, 3};
    static const drogue_frontend_config config = {40, 100, 1, 0, {0, 0, 1}, 10};
    static uint32_t memory[DROGUE_WORKSPACE_BYTES(33, 7, 5, 3) / 4 + 1];
    drogue_workspace w;
    drogue_frontend f;
    ck_assert_int_eq(drogue_workspace_init(&w, memory, sizeof memory, &good), DROGUE_OK);
    ck_assert_int_eq(drogue_workspace_init(&w, memory, sizeof memory, &w.capacity), DROGUE_OK);
    ck_assert_int_eq(drogue_frontend_begin(&f, &w, &config, 1, 1), DROGUE_OK);
    ck_assert_int_eq(drogue_workspace_init(&w, memory, sizeof memory, &none), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_frontend_begin(&f, &w, &config, 1, 1), DROGUE_E_WORKSPACE);
    memset(&w, 0xA5, sizeof w);
    ck_assert_int_eq(drogue_workspace_init(&w, memory, sizeof memory / 2, &good), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(drogue_frontend_begin(&f, &w, &config, 1, 1), DROGUE_E_WORKSPACE);
}
END_TEST

START_TEST(begin_arguments)
{
    test_workspace t = test_workspace_of(16, 16, 16, 16);
    drogue_frontend f;
    drogue_frontend_config c = {40, 100, 1, 1, {15, 15, 16}, 10}, bad = c;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 16, DROGUE_MAX_SIDE), DROGUE_OK);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 17, 16), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 0, 16), DROGUE_E_REGION);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 16, 0), DROGUE_E_REGION);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, -1, 16), DROGUE_E_REGION);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, DROGUE_MAX_SIDE + 1, 16), DROGUE_E_REGION);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 16, DROGUE_MAX_SIDE + 1), DROGUE_E_REGION);
    bad.canny_low = -1;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_E_ARGUMENT);
    bad.canny_low = 101;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_E_ARGUMENT);
    bad = c;
    bad.ring.longest_px = 0;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_E_ARGUMENT);
    bad.ring.longest_px = (1 << 20) + 1;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_E_ARGUMENT);
    bad = c;
    bad.ring.centre2_x = (1 << 15) + 1;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_E_ARGUMENT);
    bad = c;
    bad.ring.centre2_y = -(1 << 15) - 1;
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_E_ARGUMENT);
    bad.use_ring = 0; /* not looked at */
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &bad, 16, 16), DROGUE_OK);
    test_workspace_free(&t);
}
END_TEST

/* A camera that has lost its step sends too many. */
START_TEST(missing_rows_and_too_many)
{
    test_workspace t = test_workspace_of(16, 16, 16, 16);
    drogue_frontend f;
    const drogue_frontend_config c = {40, 100, 1, 0, {15, 15, 16}, 10};
    static const uint8_t row[16] = {0};
    drogue_edge_list list;
    int rows, k;
    for (rows = 0; rows < 20; rows += rows == 15 ? 2 : 1) {
        list.edge_count = list.arc_count = 77;
        ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 16, 16), DROGUE_OK);
        for (k = 0; k < rows; k++) {
            drogue_frontend_row(&f, row);
        }
        ck_assert_int_eq(drogue_frontend_end(&list, &f), DROGUE_E_ARGUMENT);
        ck_assert_uint_eq(list.edge_count, 0);
        ck_assert_uint_eq(list.arc_count, 0);
    }
    test_workspace_free(&t);
}
END_TEST

START_TEST(a_frame_ends_once)
{
    test_workspace t = test_workspace_of(16, 64, 64, 16);
    drogue_frontend f;
    const drogue_frontend_config c = {40, 100, 1, 0, {15, 15, 16}, 1};
    uint8_t row[16] = {0};
    drogue_edge_list list;
    int k;
    memset(row + 8, 255, 8);
    ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &c, 16, 16), DROGUE_OK);
    for (k = 0; k < 16; k++) {
        drogue_frontend_row(&f, row);
    }
    ck_assert_int_eq(drogue_frontend_end(&list, &f), DROGUE_OK);
    ck_assert_uint_eq(list.edge_count, 16);
    drogue_frontend_row(&f, row);
    ck_assert_int_eq(drogue_frontend_end(&list, &f), DROGUE_E_ARGUMENT);
    ck_assert_uint_eq(list.edge_count, 0);
    test_workspace_free(&t);
}
END_TEST

/* What is refused takes no rows, whatever was there before. */
START_TEST(a_refused_frame)
{
    test_workspace t = test_workspace_of(16, 64, 64, 16);
    const drogue_frontend_config refused = {100, 40, 1, 0, {15, 15, 16}, 1};
    static const uint8_t row[16] = {0};
    int rows, k;
    for (rows = 0; rows < 20; rows++) {
        drogue_frontend f;
        drogue_edge_list list;
        memset(&f, rows % 2 ? 0x7F : 0, sizeof f);
        ck_assert_int_eq(drogue_frontend_begin(&f, &t.workspace, &refused, 16, 16), DROGUE_E_ARGUMENT);
        for (k = 0; k < rows; k++) {
            drogue_frontend_row(&f, row);
        }
        ck_assert_int_eq(drogue_frontend_end(&list, &f), DROGUE_E_ARGUMENT);
    }
    test_workspace_free(&t);
}
END_TEST

/* As many arcs of an eighth of the side as fit into the edge points fit into the table, too. */
START_TEST(arcs_for_any_side)
{
    uint32_t side;
    for (side = 64; side <= DROGUE_MAX_SIDE; side++) {
        MUST(DROGUE_ARCS_FOR(side) >= DROGUE_EDGES_FOR(side) / ((side + 4) / 8), "side %u", side);
    }
}
END_TEST

/* A weak circle of one long chain with a single strong pixel survives whole, and without it vanishes. */
START_TEST(endless_weak_chain)
{
    enum { SIDE = 180 };
    static uint8_t pixels[SIDE * SIDE];
    test_workspace t = test_workspace_ample(SIDE, SIDE);
    drogue_frontend_config c = {30, 300, 0, 0, {SIDE - 1, SIDE - 1, SIDE}, 1};
    drogue_edge_list list;
    int32_t i, strong;
    for (strong = 0; strong <= 1; strong++) {
        for (i = 0; i < SIDE * SIDE; i++) {
            pixels[i] = image_grey(100 + 30 * (hypot(i % SIDE - 89.5, i / SIDE - 89.5) < 75.3));
        }
        if (strong) {
            pixels[89 * SIDE + 14] = 0; /* just outside the left end */
        }
        ck_assert_int_eq(frontend_run(&list, &t.workspace, &c, pixels, SIDE, SIDE), DROGUE_OK);
        if (strong) {
            ck_assert_uint_ge(list.edge_count, 400);
        } else {
            ck_assert_uint_eq(list.edge_count, 0);
        }
    }
    test_workspace_free(&t);
}
END_TEST

/* Rings off the middle, cut by the image, larger and smaller than it, over every width; nothing is left from a frame before. */
START_TEST(rings_anywhere)
{
    test_workspace t = test_workspace_ample(100, 100);
    int seed;
    for (seed = 1; seed <= 1500; seed++) {
        uint64_t rng = (uint64_t)seed + 11000u;
        const int32_t width = 1 + seed % 100, height = rng_range(&rng, 1, 100);
        const int32_t side = width > height ? width : height;
        uint8_t *pixels = malloc((size_t)width * (size_t)height);
        drogue_frontend_config config = random_config(width, height, &rng);
        drogue_edge_list list;
        model m;
        config.use_ring = 1;
        config.ring.centre2_x = rng_range(&rng, -side, 2 * width + side);
        config.ring.centre2_y = rng_range(&rng, -side, 2 * height + side);
        config.ring.longest_px = rng_range(&rng, 1, 3 * side);
        image_fill(pixels, width, height, seed % 3 == 0 ? IMAGE_RINGS : IMAGE_NOISE, &rng);
        m = model_of(pixels, width, height, &config);
        ck_assert_int_eq(frontend_run(&list, &t.workspace, &config, pixels, width, height), DROGUE_OK);
        compare(&m, &t.workspace, &list, seed);
        ck_assert(guarded_intact(&t.memory));
        model_free(&m);
        free(pixels);
    }
    test_workspace_free(&t);
}
END_TEST

/* A horizontal edge through the ring, weak within it: strong parts outside do not keep it, one within keeps that side whole. */
START_TEST(strength_counts_within_the_ring)
{
    enum { SIDE = 60 };
    uint8_t pixels[SIDE * SIDE];
    test_workspace t = test_workspace_ample(SIDE, SIDE);
    drogue_frontend_config c = {60, 300, 0, 1, {SIDE - 1, SIDE - 1, SIDE}, 1};
    drogue_edge_list list;
    int32_t i, within;
    for (within = 0; within <= 1; within++) {
        for (i = 0; i < SIDE * SIDE; i++) {
            const int32_t x = i % SIDE, y = i / SIDE;
            const int near = drogue_mask_in_ring(&c.ring, x - 2, y) || drogue_mask_in_ring(&c.ring, x + 2, y);
            const int strong = !near || (within && x == 4);
            pixels[i] = (uint8_t)(y < SIDE / 2 ? 100 : strong ? 200 : 130);
        }
        c.use_ring = 0;
        ck_assert_int_eq(frontend_run(&list, &t.workspace, &c, pixels, SIDE, SIDE), DROGUE_OK);
        ck_assert_uint_ge(list.edge_count, SIDE);
        c.use_ring = 1;
        ck_assert_int_eq(frontend_run(&list, &t.workspace, &c, pixels, SIDE, SIDE), DROGUE_OK);
        for (i = 0; i < (int32_t)list.edge_count; i++) {
            ck_assert_int_lt(drogue_edge_x_px(&t.workspace.edges[i]), SIDE / 2);
        }
        if (within) {
            ck_assert_uint_ge(list.edge_count, SIDE / 6);
        } else {
            ck_assert_uint_eq(list.edge_count, 0);
        }
    }
    test_workspace_free(&t);
}
END_TEST

SUITE_MAIN("frontend", every_small_size, random_images, rings_anywhere, strength_counts_within_the_ring,
           one_workspace_for_many_sizes, edge_table_overfilled_by_one, arc_table_overfilled_by_one,
           label_table_overfilled_by_one, workspace_arguments, refused_workspace_is_empty, begin_arguments,
           missing_rows_and_too_many, a_frame_ends_once, a_refused_frame, arcs_for_any_side, endless_weak_chain,
           merges_fill_no_more_than_a_row, the_form_asked_for)
