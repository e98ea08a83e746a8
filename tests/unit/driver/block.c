/* SPDX-License-Identifier: Apache-2.0 */
/* The driver against a register bank of C: what a block that works gives, and each way in which one can fail. */
#include "own_workspace.h"
#include "suite.h"

#include "driver/block.h"
#include "driver/registers.h"
#include "drogue_hls.h"
#include "frontend/frontend.h"

enum { SIDE = 64, WORDS = 0x30000 / 4, MAPPED = DROGUE_BANK_LIST_WORDS };

/* What the bank does wrong, once. */
typedef enum fault {
    NONE,
    OTHER_IDENTITY,
    LARGE_TABLE,
    NEVER_ENDS,
    EDGES_TOO_MANY,
    ARCS_TOO_MANY,
    ARC_BEYOND,
    ARC_GAP,
    NO_STATUS
} fault;

static uint32_t words[WORDS];
static uint8_t memory[SIDE * SIDE];
static fault wrong;
static uint32_t polls_left; /* reads of the state while busy */
static uint32_t resets;
static uint32_t starts;
static uint32_t interrupts; /* times the line went high */

static const drogue_bank_of_registers bank = {NULL, memory, sizeof memory, 100};

/* The C of the block, on the frame memory. */
static void run_block(void)
{
    static uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
    static uint64_t edges[DROGUE_HLS_EDGES];
    static uint64_t arcs[DROGUE_HLS_ARCS];
    uint32_t results[DROGUE_HLS_FRONTEND_RESULTS];
    const uint32_t *r = words;
#define R(name) r[DROGUE_BANK_##name / 4]
    const uint32_t width = R(WIDTH_PX);
    uint32_t i;
    for (i = 0; i < width * R(HEIGHT_PX); i++) {
        pixels[i] = memory[R(SOURCE) + i / width * R(STRIDE) + i % width];
    }
    drogue_hls_frontend(pixels, edges, arcs, (int32_t)width, (int32_t)R(HEIGHT_PX), (int32_t)R(CANNY_LOW),
                        (int32_t)R(CANNY_HIGH), (int32_t)R(SMOOTH), R(MIN_ARC_PX), (int32_t)R(USE_RING),
                        (int32_t)R(CENTRE2_X), (int32_t)R(CENTRE2_Y), (int32_t)R(LONGEST_PX), results);
    words[DROGUE_BANK_STATUS / 4] = wrong == NO_STATUS ? 200 : results[DROGUE_HLS_FRONTEND_STATUS];
    words[DROGUE_BANK_EDGE_COUNT / 4] =
        wrong == EDGES_TOO_MANY ? DROGUE_HLS_EDGES + 1 : results[DROGUE_HLS_FRONTEND_EDGE_COUNT];
    words[DROGUE_BANK_ARC_COUNT / 4] =
        wrong == ARCS_TOO_MANY ? DROGUE_HLS_ARCS + 1 : results[DROGUE_HLS_FRONTEND_ARC_COUNT];
    if (wrong == ARC_BEYOND) {
        arcs[0] += (uint64_t)5000 << 24; /* more points than there are */
    } else if (wrong == ARC_GAP) {
        arcs[1]++;
    }
    memcpy(words + DROGUE_BANK_EDGE_LIST / 4, edges, sizeof edges);
    memcpy(words + DROGUE_BANK_ARC_LIST / 4, arcs, sizeof arcs);
}

static int line(void) { return words[DROGUE_BANK_INTERRUPT / 4] && words[DROGUE_BANK_STATE / 4] == DROGUE_BANK_DONE; }

uint32_t drogue_bank_read(const drogue_bank_of_registers *of, uint32_t offset)
{
    ck_assert_ptr_eq(of, &bank);
    switch (offset) {
    case DROGUE_BANK_IDENTITY: return DROGUE_BANK_IS + (wrong == OTHER_IDENTITY);
    case DROGUE_BANK_WIDTH: return SIDE;
    case DROGUE_BANK_EDGES: return wrong == LARGE_TABLE ? MAPPED + 1 : DROGUE_HLS_EDGES;
    case DROGUE_BANK_ARCS: return DROGUE_HLS_ARCS;
    case DROGUE_BANK_LABELS: return DROGUE_HLS_LABELS;
    case DROGUE_BANK_STATE:
        if (polls_left > 0 && wrong != NEVER_ENDS && --polls_left == 0) {
            run_block();
            words[DROGUE_BANK_STATE / 4] = DROGUE_BANK_DONE;
            interrupts += (uint32_t)line();
        }
        return words[DROGUE_BANK_STATE / 4];
    default: break;
    }
    MUST(offset % 4 == 0 && offset / 4 < WORDS, "read of 0x%x", (unsigned)offset);
    return words[offset / 4];
}

void drogue_bank_write(const drogue_bank_of_registers *of, uint32_t offset, uint32_t word)
{
    const int was_high = line();
    ck_assert_ptr_eq(of, &bank);
    if (offset == DROGUE_BANK_INTERRUPT) {
        words[offset / 4] = word;
    } else if (offset != DROGUE_BANK_CONTROL) {
        MUST((words[DROGUE_BANK_STATE / 4] & DROGUE_BANK_BUSY) == 0, "0x%x written while busy", (unsigned)offset);
        words[offset / 4] = word;
    } else if (word == DROGUE_BANK_START) {
        starts++;
        words[DROGUE_BANK_STATE / 4] = DROGUE_BANK_BUSY;
        polls_left = 3;
    } else {
        ck_assert_uint_eq(word, DROGUE_BANK_RESET);
        resets++;
        words[DROGUE_BANK_STATE / 4] = 0;
    }
    interrupts += (uint32_t)(!was_high && line());
}

static void draw_disc(void)
{
    int32_t i;
    for (i = 0; i < SIDE * SIDE; i++) {
        const int32_t dx = i % SIDE - SIDE / 2;
        const int32_t dy = i / SIDE - SIDE / 2;
        memory[i] = dx * dx + dy * dy < 26 * 26 ? 40 : 200;
    }
}

static drogue_block_frame whole_frame(void)
{
    drogue_block_frame f;
    f.config.canny_low = 100;
    f.config.canny_high = 200;
    f.config.smooth = 1;
    f.config.use_ring = 1;
    f.config.ring = drogue_mask_of_size(SIDE, SIDE);
    f.config.min_arc_px = 5;
    f.width_px = SIDE;
    f.height_px = SIDE;
    f.source = 0;
    f.stride = SIDE;
    return f;
}

static test_workspace begin(fault f)
{
    wrong = f;
    resets = 0;
    starts = 0;
    interrupts = 0;
    polls_left = 0;
    memset(words, 0, sizeof words);
    draw_disc();
    drogue_block_use(&bank);
    return test_workspace_of(SIDE, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS);
}

/* A frame from start to lists; returns what reading them gave. */
static drogue_block_status one_frame(drogue_edge_list *list, drogue_status *status, fault f)
{
    test_workspace t = begin(f);
    const drogue_block_frame frame = whole_frame();
    drogue_block_status ended;
    ck_assert_int_eq(drogue_block_examine(&bank, &t.workspace.capacity), DROGUE_BLOCK_OK);
    ck_assert_int_eq(drogue_block_start(&bank, &frame, 1), DROGUE_BLOCK_OK);
    ck_assert_int_eq(words[DROGUE_BANK_INTERRUPT / 4], 1);
    ck_assert_int_eq(drogue_block_wait(&bank), DROGUE_BLOCK_OK);
    ended = drogue_block_read(list, status, &t.workspace, &bank);
    if (ended == DROGUE_BLOCK_OK) {
        uint32_t i;
        uint32_t in_arcs = 0;
        for (i = 0; i < list->edge_count; i++) {
            in_arcs += t.workspace.edges[i].arc != DROGUE_NO_ARC;
        }
        for (i = 0; i < list->arc_count; i++) {
            in_arcs -= t.workspace.arcs[i].count;
        }
        ck_assert_uint_eq(in_arcs, 0);
    } else {
        ck_assert_uint_eq(list->edge_count, 0);
        ck_assert_uint_eq(list->arc_count, 0);
    }
    test_workspace_free(&t);
    return ended;
}

START_TEST(a_frame)
{
    drogue_edge_list list;
    drogue_status status;
    ck_assert_int_eq(one_frame(&list, &status, NONE), DROGUE_BLOCK_OK);
    ck_assert_int_eq(status, DROGUE_OK);
    ck_assert_uint_ge(list.edge_count, 120);
    ck_assert_uint_ge(list.arc_count, 4);
    ck_assert_uint_eq(starts, 1);
}
END_TEST

START_TEST(lists_that_cannot_be)
{
    static const struct {
        fault wrong;
        drogue_block_status status;
    } cases[] = {{EDGES_TOO_MANY, DROGUE_BLOCK_LENGTH},
                 {ARCS_TOO_MANY, DROGUE_BLOCK_LENGTH},
                 {ARC_BEYOND, DROGUE_BLOCK_LIST},
                 {ARC_GAP, DROGUE_BLOCK_LIST},
                 {NO_STATUS, DROGUE_BLOCK_LIST}};
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_edge_list list;
        drogue_status status;
        ck_assert_int_eq(one_frame(&list, &status, cases[i].wrong), cases[i].status);
        ck_assert_int_eq(status, DROGUE_E_ARGUMENT);
    }
}
END_TEST

START_TEST(too_early_and_too_late)
{
    test_workspace t = begin(NONE);
    const drogue_block_frame frame = whole_frame();
    drogue_edge_list list;
    drogue_status status;
    ck_assert_int_eq(drogue_block_poll(&bank), DROGUE_BLOCK_EARLY);
    ck_assert_int_eq(drogue_block_wait(&bank), DROGUE_BLOCK_EARLY);
    ck_assert_int_eq(drogue_block_read(&list, &status, &t.workspace, &bank), DROGUE_BLOCK_EARLY);
    ck_assert_int_eq(drogue_block_start(&bank, &frame, 0), DROGUE_BLOCK_OK);
    ck_assert_int_eq(drogue_block_start(&bank, &frame, 0), DROGUE_BLOCK_BUSY);
    ck_assert_int_eq(drogue_block_read(&list, &status, &t.workspace, &bank), DROGUE_BLOCK_BUSY);
    ck_assert_uint_eq(starts, 1);
    wrong = NEVER_ENDS;
    ck_assert_int_eq(drogue_block_wait(&bank), DROGUE_BLOCK_STUCK);
    ck_assert_uint_eq(resets, 1);
    ck_assert_int_eq(drogue_block_poll(&bank), DROGUE_BLOCK_EARLY);
    test_workspace_free(&t);
}
END_TEST

/* The line: once a frame that asked, never for the frame before; low when acknowledged, the lists still there. */
START_TEST(an_interrupt_a_frame)
{
    static const int asked[] = {0, 1, 1, 0, 1};
    test_workspace t = begin(NONE);
    const drogue_block_frame frame = whole_frame();
    drogue_edge_list list;
    drogue_status status;
    uint32_t expected = 0;
    size_t i;
    for (i = 0; i < sizeof asked / sizeof asked[0]; i++) {
        ck_assert_int_eq(drogue_block_start(&bank, &frame, asked[i]), DROGUE_BLOCK_OK);
        ck_assert_int_eq(line(), 0);
        ck_assert_int_eq(drogue_block_wait(&bank), DROGUE_BLOCK_OK);
        ck_assert_int_eq(line(), asked[i]);
        expected += (uint32_t)asked[i];
        ck_assert_uint_eq(interrupts, expected);
        if (i != 1) { /* start lowers it, too */
            drogue_block_acknowledge(&bank);
            ck_assert_int_eq(line(), 0);
        }
        ck_assert_int_eq(drogue_block_read(&list, &status, &t.workspace, &bank), DROGUE_BLOCK_OK);
    }
    test_workspace_free(&t);
}
END_TEST

START_TEST(another_block)
{
    test_workspace t = begin(OTHER_IDENTITY);
    drogue_capacity wide = t.workspace.capacity;
    wide.width_px = SIDE + 1;
    ck_assert_int_eq(drogue_block_examine(&bank, &t.workspace.capacity), DROGUE_BLOCK_ABSENT);
    wrong = NONE;
    ck_assert_int_eq(drogue_block_examine(&bank, &wide), DROGUE_BLOCK_SMALL);
    wide.width_px = SIDE - 1; /* line buffers alone: no list differs */
    ck_assert_int_eq(drogue_block_examine(&bank, &wide), DROGUE_BLOCK_OK);
    wrong = LARGE_TABLE; /* longer than the map */
    t.workspace.capacity.edges = MAPPED + 1;
    ck_assert_int_eq(drogue_block_examine(&bank, &t.workspace.capacity), DROGUE_BLOCK_SMALL);
    test_workspace_free(&t);
}
END_TEST

/* A table with an entry less or more than the workspace's is not the library's. */
START_TEST(tables_of_other_sizes)
{
    static const size_t tables[] = {offsetof(drogue_capacity, edges), offsetof(drogue_capacity, arcs),
                                    offsetof(drogue_capacity, labels)};
    test_workspace t = begin(NONE);
    size_t i;
    for (i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        drogue_capacity capacity = t.workspace.capacity;
        uint32_t *entries = (uint32_t *)(void *)((char *)&capacity + tables[i]);
        ck_assert_int_eq(drogue_block_examine(&bank, &capacity), DROGUE_BLOCK_OK);
        ++*entries;
        ck_assert_int_eq(drogue_block_examine(&bank, &capacity), DROGUE_BLOCK_SMALL);
        *entries -= 2;
        ck_assert_int_eq(drogue_block_examine(&bank, &capacity), DROGUE_BLOCK_LARGE);
    }
    test_workspace_free(&t);
}
END_TEST

/* Through the library's own front end functions, which the block stands behind here. */
static drogue_status through_rows(drogue_edge_list *list, test_workspace *t, const uint8_t *first, int32_t stride,
                                  int32_t side)
{
    drogue_frontend frontend;
    drogue_frontend_config config = whole_frame().config;
    drogue_status status;
    int32_t y;
    config.ring = drogue_mask_of_size(side, side);
    status = drogue_frontend_begin(&frontend, &t->workspace, &config, side, side);
    for (y = 0; y < side && status == DROGUE_OK; y++) {
        drogue_frontend_row(&frontend, first + y * stride);
    }
    return status == DROGUE_OK ? drogue_frontend_end(list, &frontend) : status;
}

START_TEST(in_the_place_of_the_front_end)
{
    test_workspace t = begin(NONE);
    static const uint8_t elsewhere[SIDE * SIDE] = {0};
    const drogue_frontend_config config = whole_frame().config;
    drogue_frontend frontend;
    drogue_edge_list list;
    int32_t y;
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_OK);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_OK);
    ck_assert_uint_ge(list.edge_count, 120);
    ck_assert_int_eq(through_rows(&list, &t, memory + 3 * SIDE + 2, SIDE, 60), DROGUE_OK);
    ck_assert_uint_eq(words[DROGUE_BANK_SOURCE / 4], 3 * SIDE + 2);
    ck_assert_uint_eq(words[DROGUE_BANK_STRIDE / 4], SIDE);
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE + 1), DROGUE_E_WORKSPACE);
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, 0), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(through_rows(&list, &t, elsewhere, SIDE, SIDE), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_LENGTH);
    ck_assert_int_eq(through_rows(&list, &t, memory + SIDE, SIDE, SIDE), DROGUE_E_ARGUMENT); /* one row too low */
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_LENGTH);
    ck_assert_int_eq(drogue_frontend_begin(&frontend, &t.workspace, &config, SIDE, SIDE), DROGUE_OK);
    for (y = 0; y <= SIDE; y++) { /* one row too many */
        drogue_frontend_row(&frontend, memory + y % SIDE * SIDE);
    }
    ck_assert_int_eq(drogue_frontend_end(&list, &frontend), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_frontend_begin(&frontend, &t.workspace, &config, SIDE, 0), DROGUE_E_REGION);
    drogue_frontend_row(&frontend, memory);
    ck_assert_int_eq(drogue_frontend_end(&list, &frontend), DROGUE_E_ARGUMENT);
    wrong = NEVER_ENDS;
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_STUCK);
    ck_assert_uint_eq(list.edge_count, 0);
    wrong = OTHER_IDENTITY;
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_ABSENT);
    test_workspace_free(&t);
}
END_TEST

/* A table of the block that fills is what the library says of its own. */
START_TEST(a_full_table)
{
    test_workspace t = begin(NONE);
    uint64_t state = 1;
    drogue_edge_list list;
    size_t i;
    for (i = 0; i < sizeof memory; i++) {
        memory[i] = (uint8_t)rng_u64(&state);
    }
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_E_EDGES_FULL);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_OK);
    ck_assert_uint_gt(list.edge_count, 0);
    test_workspace_free(&t);
}
END_TEST

/* In a workspace whose tables are smaller than the block's the library would say that one is full; the block, which has
 * room for more, does not: it is refused, rather than its list. */
START_TEST(a_table_that_the_block_would_not_fill)
{
    test_workspace t = begin(NONE);
    const drogue_capacity all = t.workspace.capacity;
    drogue_edge_list list;
    uint32_t points;
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_OK);
    points = list.edge_count;
    t.workspace.capacity.edges = points - 1; /* too many points for the workspace */
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_LARGE);
    t.workspace.capacity.edges = points; /* and just room for them: weak points took some of it */
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(drogue_block_last(), DROGUE_BLOCK_LARGE);
    t.workspace.capacity = all;
    ck_assert_int_eq(through_rows(&list, &t, memory, SIDE, SIDE), DROGUE_OK);
    ck_assert_uint_eq(list.edge_count, points);
    ck_assert_uint_eq(starts, 2);
    test_workspace_free(&t);
}
END_TEST

START_TEST(names)
{
    ck_assert_str_eq(drogue_block_status_name(DROGUE_BLOCK_OK), "ok");
    ck_assert_str_eq(drogue_block_status_name(DROGUE_BLOCK_LARGE), "large");
    ck_assert_str_eq(drogue_block_status_name(DROGUE_BLOCK_LIST), "list");
    ck_assert_str_eq(drogue_block_status_name(DROGUE_BLOCK_STATUSES), "unknown");
}
END_TEST

SUITE_MAIN("block", a_frame, lists_that_cannot_be, too_early_and_too_late, an_interrupt_a_frame, another_block,
           tables_of_other_sizes, in_the_place_of_the_front_end, a_full_table, a_table_that_the_block_would_not_fill,
           names)
