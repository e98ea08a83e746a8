/* SPDX-License-Identifier: Apache-2.0 */
/* Where a track looks in a frame, and what of it it takes: what is measured there is told by the test, whose
 * drogue_measure() takes the place of the library's; the search sights drawn discs. */
#include "track_steps.h"

#include "drogue/search.h"

enum { WIDTH = 2048, HEIGHT = 1024, CALLS = 16 };

static uint8_t pixels[WIDTH * HEIGHT];
static uint8_t memory[DROGUE_SEARCH_BYTES(WIDTH)];
static drogue_search search;

/* What is to be measured in the predicted region and elsewhere. */
static drogue_region predicted;
static drogue_result expected, elsewhere;
static drogue_workspace workspace = {.capacity = {DROGUE_MAX_SIDE, 1, 2, 1}};
static drogue_region measured[CALLS];
static int calls;

drogue_status drogue_measure(drogue_result *out, drogue_workspace *w, const drogue_setup *setup,
                             const drogue_image *image, const drogue_region *region)
{
    (void)w;
    (void)setup;
    (void)image;
    ck_assert_int_lt(calls, CALLS);
    measured[calls++] = *region;
    *out = memcmp(region, &predicted, sizeof predicted) == 0 ? expected : elsewhere;
    return out->status;
}

/* A drogue that shows its inner part in the size expected of it, in so much of the outline. */
static drogue_result covered(double x, int32_t cover_percent, int has_inner)
{
    drogue_result r = seen(x, 0, 12, 0.1, 0.05);
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = 100 * DROGUE_Q16_ONE;
    r.cover_q16 = DROGUE_Q16(cover_percent, 100);
    r.has_inner = has_inner;
    return r;
}

static void draw(int xc, int yc)
{
    int x, y;
    for (y = yc - 40; y <= yc + 40; y++) {
        for (x = xc - 40; x <= xc + 40; x++) {
            const int d = (x - xc) * (x - xc) + (y - yc) * (y - yc);
            if (d <= 40 * 40) {
                pixels[y * WIDTH + x] = (uint8_t)(9 * d <= 40 * 40 ? 20 : 90);
            }
        }
    }
}

static drogue_track_state frame(drogue_result *result, drogue_track *t)
{
    static const drogue_image image = {pixels, WIDTH, HEIGHT, WIDTH};
    drogue_track next = *t;
    drogue_region region;
    drogue_config config;
    drogue_config_default(&config);
    drogue_track_begin(&predicted, &next, DT_US);
    calls = 0;
    ck_assert_int_eq(drogue_search_init(&search, memory, sizeof memory, WIDTH), DROGUE_OK);
    return drogue_track_frame(result, &region, t, &workspace, &search, &config, &image, DT_US);
}

/* A track that has missed the drogue until it may be beside its predicted region. */
static drogue_track uncertain_track(void)
{
    const drogue_result hit = covered(0, 100, 1), miss = missed(DROGUE_E_NO_ELLIPSE);
    drogue_track t = steady_track(&hit);
    int k;
    t.config.max_missed = 100;
    for (k = 0; k < 50 && !t.search; k++) {
        ck_assert_int_eq(step(&t, &miss), DROGUE_COASTING);
    }
    ck_assert_int_eq(t.search, 1);
    return t;
}

/* While the drogue may be elsewhere, an outline of which a tenth lacks must show its inner part to be believed. */
START_TEST(what_is_believed_while_uncertain)
{
    static const struct {
        int32_t cover_percent;
        int has_inner, believed;
    } cases[] = {{90, 0, 1}, {89, 0, 0}, {89, 1, 1}, {61, 1, 1}, {59, 1, 0}};
    const drogue_track start = uncertain_track();
    size_t i;
    memset(pixels, 220, sizeof pixels);
    elsewhere = missed(DROGUE_E_NO_ELLIPSE);
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_track t = start;
        drogue_result result;
        drogue_track_state state;
        expected = covered(0, cases[i].cover_percent, cases[i].has_inner);
        expected.list.edge_count = 7;
        expected.list.arc_count = 1;
        expected.arcs[0] = 0;
        expected.inner.spread_px_q16 = DROGUE_Q16(1046, 1000); /* so unsharp that it needs a cover of 0.6 */
        state = frame(&result, &t);
        MUST(state == (cases[i].believed ? DROGUE_TRACKING : DROGUE_COASTING) &&
                 result.status == (cases[i].believed ? DROGUE_OK : DROGUE_E_UNSURE),
             "case %d: %s, %s", (int)i, drogue_track_state_name(state), drogue_status_name(result.status));
        MUST(!cases[i].believed || calls == 1, "case %d: looked at %d places", (int)i, calls);
        /* where something else was looked at after it the workspace holds that */
        MUST(result.list.edge_count == (cases[i].believed ? 7u : 0u) &&
                 result.list.arc_count == (cases[i].believed ? 1u : 0u),
             "case %d: %u edges", (int)i, (unsigned)result.list.edge_count);
    }
}
END_TEST

/* While uncertain what is within reach is looked at, what is beyond is not; when lost, all is. */
START_TEST(search_ends_at_reach)
{
    drogue_track t = uncertain_track();
    drogue_result result;
    int k, within = 0;
    memset(pixels, 220, sizeof pixels);
    expected = elsewhere = missed(DROGUE_E_NO_ELLIPSE);
    draw(1003, 950); /* the track is at (1023, 940) */
    draw(200, 200);
    t.camera.cy_px_q16 = q16_of(940);
    ck_assert_int_eq(frame(&result, &t), DROGUE_COASTING);
    MUST(t.reach.x_px > 300 && t.reach.x_px + t.reach.width_px > 1050, "reach from %d, %d px", (int)t.reach.x_px,
         (int)t.reach.width_px);
    for (k = 0; k < calls; k++) {
        MUST(measured[k].x_px > 300, "looked at x = %d", (int)measured[k].x_px);
        within |= abs(measured[k].x_px + measured[k].width_px / 2 - 1003) < 20 && measured[k].width_px < 160;
    }
    ck_assert_int_eq(within, 1);
    t.state = DROGUE_LOST;
    elsewhere = covered(-8, 100, 1);
    ck_assert_int_eq(frame(&result, &t), DROGUE_TRACKING);
}
END_TEST

/* A track whose orientation stays open looks elsewhere once in so many frames, and begins anew from what decides. */
START_TEST(reconsidered_once_in_a_while)
{
    const drogue_result hit = covered(0, 100, 1);
    drogue_track t = steady_track(&hit);
    drogue_result result;
    drogue_result found[4];
    int k;
    memset(pixels, 220, sizeof pixels);
    draw(200, 200);
    t.config.reconsider_frames = 10;
    t.config.min_reliability_q16 = DROGUE_Q16(1, 2);
    expected = hit;
    expected.quality.reliability_q16 = DROGUE_Q16(6, 10);
    expected.orientation_resolved = 0;
    found[0] = missed(DROGUE_E_NO_ELLIPSE); /* nothing; open, too; not reliable; decided */
    found[1] = found[2] = found[3] = covered(-8, 100, 1);
    found[1].quality.reliability_q16 = found[3].quality.reliability_q16 = DROGUE_Q16(9, 10);
    found[1].orientation_resolved = 0;
    for (k = 0; k <= 40; k++) {
        elsewhere = found[k / 10 > 0 ? k / 10 - 1 : 0];
        ck_assert_int_eq(frame(&result, &t), DROGUE_TRACKING);
        MUST((calls > 1 || k == 40) == (k > 0 && k % 10 == 0), "frame %d: looked at %d places", k, calls);
        must_be_at(&t, k < 40 ? 0 : -8, 0, 12, 0.01);
    }
}
END_TEST

/* What is known of the orientation goes after known_frames, though the frame is searched more often. */
START_TEST(forgotten_though_reconsidered)
{
    const drogue_result hit = covered(0, 100, 1);
    drogue_track t = steady_track(&hit);
    drogue_result result;
    unsigned k;
    memset(pixels, 220, sizeof pixels);
    draw(200, 200);
    t.config.reconsider_frames = 10;
    expected = hit;
    expected.orientation_resolved = 0;
    expected.alternative = seen(0, 0, 12, -0.3, 0.05).pose;
    elsewhere = missed(DROGUE_E_NO_ELLIPSE);
    for (k = 1; k <= t.config.known_frames; k++) {
        ck_assert_int_eq(t.orientation_known, 1);
        ck_assert_int_eq(frame(&result, &t), DROGUE_TRACKING);
        MUST((calls > 1) == (k == 11 || k == 21), "frame %u: looked at %d places", k, calls);
    }
    ck_assert_int_eq(t.orientation_known, 0);
    for (; k < 31; k++) {
        ck_assert_int_eq(frame(&result, &t), DROGUE_TRACKING);
    }
    expected = missed(DROGUE_E_NO_ELLIPSE); /* frames without a measurement are not counted again */
    ck_assert_int_eq(frame(&result, &t), DROGUE_COASTING);
    elsewhere = covered(-8, 100, 1);
    ck_assert_int_eq(frame(&result, &t), DROGUE_COASTING);
}
END_TEST

/* Where the predicted region is wider than the workspace, its middle is measured, as wide as that, if the rim still fits:
 * four fifths of a region of 2.5 semi-axes. The first region is the caller's. */
START_TEST(no_wider_than_the_workspace)
{
    const drogue_result hit = covered(0, 100, 1);
    drogue_track t = steady_track(&hit);
    drogue_result result;
    int32_t most;
    expected = elsewhere = hit;
    ck_assert_int_eq(frame(&result, &t), DROGUE_TRACKING);
    for (most = predicted.width_px + 1; most >= predicted.width_px - 41; most -= 7) {
        const int fits = 5 * most >= 4 * predicted.width_px;
        const int32_t over = predicted.width_px > most && fits ? predicted.width_px - most : 0;
        drogue_track next = t;
        workspace.capacity.width_px = (uint32_t)most;
        ck_assert_int_eq(frame(&result, &next), DROGUE_TRACKING);
        ck_assert_int_eq(measured[0].width_px, predicted.width_px - over);
        ck_assert_int_eq(measured[0].height_px, predicted.width_px - over);
        ck_assert_int_eq(measured[0].x_px, predicted.x_px + over / 2);
        ck_assert_int_eq(measured[0].y_px, predicted.y_px + over / 2);
    }
    t.first_region = predicted;
    t.camera.cx_px_q16 = 0; /* half of it is beside the image */
    workspace.capacity.width_px = (uint32_t)predicted.width_px - 10;
    expected = elsewhere = hit;
    {
        drogue_track next = t;
        ck_assert_int_eq(frame(&result, &next), DROGUE_TRACKING);
        ck_assert_int_lt(predicted.x_px, -40);
        ck_assert_int_eq(memcmp(&measured[0], &predicted, sizeof predicted), 0);
    }
    t.state = DROGUE_LOST;
    ck_assert_int_eq(frame(&result, &t), DROGUE_TRACKING);
    ck_assert_int_eq(measured[0].width_px, predicted.width_px);
    workspace.capacity.width_px = DROGUE_MAX_SIDE;
}
END_TEST

SUITE_MAIN("frame", no_wider_than_the_workspace, what_is_believed_while_uncertain, search_ends_at_reach,
           reconsidered_once_in_a_while, forgotten_though_reconsidered)
