/* SPDX-License-Identifier: Apache-2.0 */
/* What acquisition makes of measurements: which of the sightings' results stands, when none is looked at any more, when
 * the part itself is measured. The search sights drawn discs; what is measured there is told by the test, whose
 * drogue_measure() takes the place of the library's. */
#include "suite.h"

#include "drogue/search.h"

static const drogue_model model = {22938, 7864, 16384}; /* 0.35, 0.12, 0.25 m */
static const drogue_model no_inner = {22938, 0, 0};
static const drogue_camera camera = {.fx_px_q16 = 1000 * DROGUE_Q16_ONE, .fy_px_q16 = 1000 * DROGUE_Q16_ONE};

enum { MOST = 514, CALLS = 5 };

static uint8_t pixels[MOST * MOST];
static uint8_t memory[DROGUE_SEARCH_BYTES(DROGUE_MAX_SIDE + 1)];
static drogue_search search;

/* What is to be measured in the first sighting, the second, about any dark disc, and elsewhere: in the part itself. */
static drogue_result first, second, elsewhere;
static drogue_result about_disc = {.status = DROGUE_E_NO_ELLIPSE};
static drogue_workspace workspace = {.capacity = {DROGUE_MAX_SIDE, 1, 2, 1}};
static drogue_region measured[CALLS];
static int calls;      /* apart from those about dark discs: */
static int disc_calls; /* in the order of their scores, each once or, where it stands, twice */

static int same_region(const drogue_region *p, const drogue_region *q)
{
    return p->x_px == q->x_px && p->y_px == q->y_px && p->width_px == q->width_px && p->height_px == q->height_px;
}

drogue_status drogue_measure(drogue_result *out, drogue_workspace *w, const drogue_setup *setup,
                             const drogue_image *image, const drogue_region *region)
{
    int32_t i;
    (void)w;
    (void)setup;
    (void)image;
    for (i = 0; i < search.dark_count; i++) {
        if (same_region(region, &search.dark[i].region)) {
            MUST(i == disc_calls || disc_calls == search.dark_count, "disc %d at turn %d", (int)i, disc_calls);
            disc_calls++;
            *out = about_disc;
            return out->status;
        }
    }
    ck_assert_int_lt(calls, CALLS);
    measured[calls++] = *region;
    *out = search.count > 0 && same_region(region, &search.best[0].region)   ? first
           : search.count > 1 && same_region(region, &search.best[1].region) ? second
                                                                             : elsewhere;
    return out->status;
}

static drogue_result nothing(void)
{
    drogue_result r;
    memset(&r, 0, sizeof r);
    r.status = DROGUE_E_NO_ELLIPSE;
    return r;
}

/* A circle of 100 px at 4 m, of whose inner part 32.3 px are expected, so unsharp that a cover of 3/4 is sure, of 0.55
 * where it decides. */
static drogue_result with_inner(int32_t cover_percent, int resolved)
{
    drogue_result r;
    memset(&r, 0, sizeof r);
    r.status = DROGUE_OK;
    r.ellipse.a_px_q16 = r.ellipse.b_px_q16 = 100 * DROGUE_Q16_ONE;
    r.pose.position_m_q16[2] = 4 * DROGUE_Q16_ONE;
    r.cover_q16 = DROGUE_Q16(cover_percent, 100);
    r.has_inner = 1;
    r.inner.spread_px_q16 = DROGUE_Q16(6637, 10000);
    r.orientation_resolved = resolved;
    r.ambiguity_q16 = resolved ? DROGUE_Q16(17, 100) : 0;
    return r;
}

static drogue_result without_inner(int32_t cover_percent, int32_t reliability_percent)
{
    drogue_result r = with_inner(cover_percent, 0);
    r.has_inner = 0;
    r.quality.reliability_q16 = DROGUE_Q16(reliability_percent, 100);
    return r;
}

static void draw_disc(int width, int xc, int yc, int radius, int grey)
{
    int x, y;
    for (y = -radius; y <= radius; y++) {
        for (x = -radius; x <= radius; x++) {
            if (x * x + y * y <= radius * radius) {
                pixels[(yc + y) * width + xc + x] = (uint8_t)grey;
            }
        }
    }
}

/* A dark disc on a bright ground with a darker one in it. */
static void draw(int width, int xc, int yc, int grey)
{
    draw_disc(width, xc, yc, 40, grey);
    draw_disc(width, xc, yc, 14, 20);
}

static const drogue_region *part; /* searched; NULL: the whole image */
static int collared;              /* whether there is a larger disc about the first, sighted second */

/* Acquire in an image with so many discs; the first of them shows more contrast. */
static drogue_status acquire(drogue_result *out, const drogue_model *m, int32_t width, int32_t height, int discs)
{
    const drogue_image image = {pixels, width, height, width};
    drogue_config config;
    const drogue_setup setup = {&camera, m, &config};
    drogue_config_default(&config);
    memset(pixels, 220, sizeof pixels);
    if (collared) {
        draw_disc(width, 100, 120, 65, 180);
    }
    if (discs > 0) {
        draw(width, 100, 120, 90);
    }
    if (discs > 1) {
        draw(width, 300, 260, 60);
    }
    if (discs > 2) {
        draw(width, 60, 300, 50);
    }
    calls = disc_calls = 0;
    ck_assert_int_eq(drogue_search_init(&search, memory, sizeof memory, width), DROGUE_OK);
    (void)drogue_acquire(out, &workspace, &search, &setup, &image, part);
    ck_assert_int_eq(search.count, discs + collared);
    MUST(discs < 1 || abs(search.best[0].x_px - 100) < 10, "first of the sightings at %d", (int)search.best[0].x_px);
    MUST(discs < 2 || abs(search.best[1].x_px - 300) < 10, "second of the sightings at %d", (int)search.best[1].x_px);
    return out->status;
}

static drogue_result stood; /* the last acquisition's */

/* Of these measurements in the first and in the second sighting, which stands? The last is measured again when it is not what
 * was measured last. */
static int stands(const drogue_result *of_first, const drogue_result *of_second, const drogue_model *m)
{
    first = *of_first;
    second = *of_second;
    elsewhere = nothing();
    (void)acquire(&stood, m, 480, 360, 2);
    ck_assert_int_gt(calls, 0);
    MUST(!same_region(&search.best[0].region, &search.best[1].region), "one region");
    return same_region(&measured[calls - 1], &search.best[1].region) ? 2 : 1;
}

/* The better one stands, whichever was sighted first. */
static void better(const drogue_result *r, const drogue_result *than, const drogue_model *m, drogue_status status)
{
    ck_assert_int_eq(stands(r, than, m), 1);
    ck_assert_int_eq(stood.cover_q16, r->cover_q16);
    ck_assert_int_eq(stood.status, status);
    ck_assert_int_eq(stands(than, r, m), 2);
    ck_assert_int_eq(stood.cover_q16, r->cover_q16);
    ck_assert_int_eq(stood.status, status);
}

START_TEST(what_is_worth_more_stands)
{
    const drogue_result none = nothing(), unsure = with_inner(40, 0), less = with_inner(39, 0),
                        sure = with_inner(79, 0), decided = with_inner(61, 1), covered = without_inner(90, 50),
                        alone = without_inner(76, 95), decides = with_inner(50, 1), seen = with_inner(69, 0),
                        unseen = without_inner(98, 50);
    drogue_result tiny = with_inner(79, 0);
    const drogue_model pinprick = {22938, 1, 0};
    tiny.ellipse.a_px_q16 = tiny.ellipse.b_px_q16 = DROGUE_Q16(1, 10); /* of which an inner part rounds to nothing */
    better(&tiny, &none, &pinprick, DROGUE_E_UNSURE);
    better(&unsure, &none, &model, DROGUE_E_UNSURE);
    better(&unsure, &less, &model, DROGUE_E_UNSURE);
    better(&decides, &seen, &model, DROGUE_E_UNSURE);
    better(&unsure, &unseen, &model, DROGUE_E_UNSURE);
    better(&sure, &unsure, &model, DROGUE_OK);
    better(&decided, &sure, &model, DROGUE_OK);     /* with less cover */
    better(&alone, &covered, &no_inner, DROGUE_OK); /* sure, where the model has no inner part, with less cover */
    better(&unseen, &covered, &no_inner, DROGUE_E_UNSURE);
}
END_TEST

/* Of concentric outlines the rim is the largest: 115 px for 100 are worth as much as 8.4 % of cover. */
START_TEST(the_larger_of_two)
{
    const drogue_result small = with_inner(90, 0);
    drogue_result large = with_inner(82, 0);
    large.ellipse.a_px_q16 = large.ellipse.b_px_q16 = 115 * DROGUE_Q16_ONE;
    better(&large, &small, &model, DROGUE_OK);
    large.cover_q16 = DROGUE_Q16(81, 100);
    better(&small, &large, &model, DROGUE_OK);
}
END_TEST

/* After what settles nothing is looked at; what has no pose does not settle, whatever else was measured. */
START_TEST(what_settles)
{
    drogue_result out;
    first = with_inner(80, 1);
    second = with_inner(90, 1);
    elsewhere = nothing();
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 1);
    ck_assert_int_eq(out.cover_q16, first.cover_q16);
    first.doubt_q16 = DROGUE_Q16(1, 64); /* the outline contradicts it */
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
    first = with_inner(95, 0);
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
    first = without_inner(95, 95);
    ck_assert_int_eq(acquire(&out, &no_inner, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 1);
    first = with_inner(100, 0); /* worth more than what would settle, which is not kept: the third is looked at */
    second = with_inner(78, 1);
    elsewhere = with_inner(95, 1);
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 3), DROGUE_OK);
    ck_assert_int_eq(calls, 3);
    ck_assert_int_eq(out.cover_q16, elsewhere.cover_q16);
    elsewhere = nothing();
    first = without_inner(95, 95);
    first.status = DROGUE_E_DOMAIN; /* farther away than numbers go */
    second = without_inner(85, 95);
    ck_assert_int_eq(acquire(&out, &no_inner, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(out.cover_q16, second.cover_q16);
}
END_TEST

/* Of what failed the status says how far the best attempt got, not the last; and there is nothing else in the result. */
START_TEST(why_there_is_none)
{
    drogue_result out;
    drogue_result none;
    drogue_result_clear(&none);
    first = nothing();
    second = without_inner(85, 95);
    second.status = none.status = DROGUE_E_DOMAIN;
    elsewhere.status = DROGUE_E_NO_ARCS;
    memset(&out, 1, sizeof out);
    ck_assert_int_eq(acquire(&out, &no_inner, 480, 360, 2), DROGUE_E_DOMAIN);
    ck_assert_int_eq(calls, 3);
    ck_assert_mem_eq(&out, &none, sizeof out);
    memset(&out, 1, sizeof out);
    none.status = DROGUE_E_NO_INNER_PART;
    ck_assert_int_eq(acquire(&out, &model, 513, 360, 0), DROGUE_E_NO_INNER_PART);
    ck_assert_mem_eq(&out, &none, sizeof out);
    ck_assert_int_eq(acquire(&out, &no_inner, DROGUE_MAX_SIDE + 1, 64, 0), DROGUE_E_NO_INNER_PART);
    ck_assert_int_eq(calls, 0); /* it is too large to be measured itself */
    ck_assert_int_eq(acquire(&out, &no_inner, DROGUE_MAX_SIDE, 64, 0), DROGUE_E_NO_ARCS);
}
END_TEST

/* A part is searched as far down as anything can be measured. */
START_TEST(no_lower_than_can_be_measured)
{
    const drogue_image image = {pixels, 8, DROGUE_SEARCH_MOST_ROWS + 100, 8};
    const drogue_region across = {0, DROGUE_SEARCH_MOST_ROWS - 7, 8, 50}, below = {0, DROGUE_SEARCH_MOST_ROWS, 8, 50};
    drogue_config config;
    const drogue_setup setup = {&camera, &model, &config};
    drogue_result out;
    drogue_config_default(&config);
    memset(pixels, 220, sizeof pixels);
    first = second = elsewhere = nothing();
    ck_assert_int_eq(drogue_search_init(&search, memory, sizeof memory, 8), DROGUE_OK);
    (void)drogue_acquire(&out, &workspace, &search, &setup, &image, &across);
    ck_assert_int_eq(search.rows_in, 7);
    ck_assert_int_eq(drogue_acquire(&out, &workspace, &search, &setup, &image, &below), DROGUE_E_REGION);
}
END_TEST

/* Too little room for any place is said, whatever else is the matter with the others. */
START_TEST(too_little_room)
{
    drogue_result out;
    first = second = elsewhere = nothing();
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(out.second_look, DROGUE_SECOND_NONE);
    second.status = DROGUE_E_EDGES_FULL;
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(out.second_look, DROGUE_SECOND_FULL);
    first.status = DROGUE_E_WORKSPACE;
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(out.second_look, DROGUE_SECOND_TOO_WIDE);
    first = without_inner(40, 50);
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_E_UNSURE);
    ck_assert_int_eq(out.second_look, DROGUE_SECOND_ROOM);
    second = nothing();
    second.second_look = DROGUE_SECOND_FULL;
    first = nothing();
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(out.second_look, DROGUE_SECOND_FULL);
    second = with_inner(61, 1); /* what is sure needs no other */
    first.status = DROGUE_E_WORKSPACE;
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(out.second_look, DROGUE_SECOND_NONE);
}
END_TEST

/* Input out of its range is refused before anything is sighted. */
START_TEST(refused_before_the_search)
{
    const drogue_image image = {pixels, 480, 360, 480};
    const drogue_model backward = {22938, 7864, -1};
    drogue_config config;
    drogue_setup setup = {&camera, &backward, &config};
    drogue_result out;
    drogue_config_default(&config);
    ck_assert_int_eq(drogue_search_init(&search, memory, sizeof memory, 480), DROGUE_OK);
    ck_assert_int_eq(drogue_acquire(&out, &workspace, &search, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    setup.model = &model;
    config.canny_low = -1;
    ck_assert_int_eq(drogue_acquire(&out, &workspace, &search, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(out.arcs[0], DROGUE_NO_ARC);
    ck_assert_int_eq(out.ambiguity_q16, DROGUE_Q16_ONE);
}
END_TEST

/* Where no sighting is sure the drogue is looked for about the darkest discs, until it is found. */
START_TEST(about_dark_discs)
{
    static const drogue_region lower_right = {20, 40, 460, 320};
    drogue_result out;
    int32_t i;
    first = second = elsewhere = nothing();
    about_disc = with_inner(61, 1);
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(disc_calls, 1);
    ck_assert_int_ge(search.dark_count, 2);
    for (part = NULL;; part = &lower_right) {
        ck_assert_int_eq(acquire(&out, &model, 480, 360, 1), DROGUE_OK);
        for (i = 0; i < search.dark_count && abs(search.dark[i].region.width_px - 107) > 20; i++) {}
        ck_assert_int_lt(i, search.dark_count); /* 14 px * 0.35 / 0.12 * 21 / 8 */
        MUST(abs(search.dark[i].region.x_px + search.dark[i].region.width_px / 2 - 100) <= 4 &&
                 abs(search.dark[i].region.y_px + search.dark[i].region.height_px / 2 - 120) <= 4,
             "about %d, %d", (int)search.dark[i].x_px, (int)search.dark[i].y_px);
        if (part != NULL) {
            break;
        }
    }
    part = NULL;
    about_disc = with_inner(50, 1); /* not sure: all, and the part; but it stands */
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_E_UNSURE);
    ck_assert_int_eq(disc_calls, search.dark_count + 1);
    ck_assert_int_eq(calls, 3);
    ck_assert_int_eq(out.cover_q16, about_disc.cover_q16);
    second = with_inner(61, 1); /* sure */
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 2), DROGUE_OK);
    ck_assert_int_eq(disc_calls, 0);
    second = nothing();
    ck_assert_int_eq(acquire(&out, &no_inner, 480, 360, 2), DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(disc_calls, 0);
    about_disc = nothing();
}
END_TEST

/* Once one settles, larger ones about it are looked at: of one of those more is to be had. Without an inner part, none. */
START_TEST(what_is_about_what_settles)
{
    drogue_result out;
    first = with_inner(80, 1);
    second = with_inner(75, 1);
    second.ellipse.a_px_q16 = second.ellipse.b_px_q16 = 115 * DROGUE_Q16_ONE;
    collared = 1;
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 1), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(out.cover_q16, second.cover_q16);
    first = without_inner(95, 95);
    ck_assert_int_eq(acquire(&out, &no_inner, 480, 360, 1), DROGUE_OK);
    ck_assert_int_eq(calls, 1);
    collared = 0;
}
END_TEST

/* The part itself is measured up to 512 px a side, and of any size without an inner part. */
START_TEST(when_the_part_is_measured)
{
    static const struct {
        int32_t width, height;
        int measured;
    } cases[] = {{512, 512, 1}, {513, 512, 0}, {512, 513, 0}, {511, 511, 1}};
    size_t i;
    first = second = nothing();
    elsewhere = with_inner(90, 1);
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_result out;
        MUST(acquire(&out, &model, cases[i].width, cases[i].height, 0) ==
                     (cases[i].measured ? DROGUE_OK : DROGUE_E_NO_INNER_PART) &&
                 calls == cases[i].measured,
             "%d x %d: %s after %d", (int)cases[i].width, (int)cases[i].height, drogue_status_name(out.status), calls);
        elsewhere = without_inner(90, 95);
        ck_assert_int_eq(acquire(&out, &no_inner, cases[i].width, cases[i].height, 0), DROGUE_OK);
        ck_assert_int_eq(calls, 1);
        MUST(measured[0].x_px == 0 && measured[0].y_px == 0 && measured[0].width_px == cases[i].width &&
                 measured[0].height_px == cases[i].height,
             "case %d: another part", (int)i);
        elsewhere = with_inner(90, 1);
    }
}
END_TEST

/* What is unsure does not keep the part from being measured; an inner part that decides, and one that is sure, does. */
START_TEST(the_part_after_its_sightings)
{
    drogue_result out;
    first = with_inner(40, 0);
    elsewhere = with_inner(70, 1);
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 1), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
    ck_assert_int_eq(out.cover_q16, elsewhere.cover_q16);
    elsewhere = with_inner(30, 0); /* less than what was sighted, which is measured again */
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 1), DROGUE_E_UNSURE);
    ck_assert_int_eq(calls, 3);
    ck_assert_int_eq(out.cover_q16, first.cover_q16);
    first = with_inner(79, 0);
    elsewhere = with_inner(90, 1);
    ck_assert_int_eq(acquire(&out, &model, 480, 360, 1), DROGUE_OK);
    ck_assert_int_eq(calls, 1);
    ck_assert_int_eq(out.cover_q16, first.cover_q16);
    first = second = without_inner(90, 50);
    elsewhere = nothing();
    ck_assert_int_eq(acquire(&out, &no_inner, 480, 514, 2), DROGUE_E_UNSURE);
    ck_assert_int_eq(calls, 4); /* both, the part, and the first again */
    ck_assert_int_eq(acquire(&out, &model, 480, 514, 2), DROGUE_E_UNSURE);
    ck_assert_int_eq(calls, 3); /* both, and the first again: the part is too high */
    second = with_inner(76, 0); /* sure */
    ck_assert_int_eq(acquire(&out, &model, 480, 514, 2), DROGUE_OK);
    ck_assert_int_eq(calls, 2);
}
END_TEST

SUITE_MAIN("acquire", what_is_worth_more_stands, the_larger_of_two, what_settles, why_there_is_none,
           no_lower_than_can_be_measured, too_little_room, refused_before_the_search, about_dark_discs,
           what_is_about_what_settles, when_the_part_is_measured, the_part_after_its_sightings)
