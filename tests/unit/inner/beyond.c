/* SPDX-License-Identifier: Apache-2.0 */
/* A faint outline along rays: drawn rings whose step is near the noise, a steep edge within, arcs, nothing. */
#include "suite.h"

#include "drogue/drogue.h"
#include "drogue/inner.h"

enum { SIDE = 190 };

static const double xc = 94.3, yc = 95.1;

static uint8_t pixels[SIDE * SIDE];
static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(SIDE) / 4 + 1];
static drogue_workspace workspace;

/* A step of grey at a radius over a share of the turn, of each sixteenth of it where that is more than 1, about a dark disc;
 * noise of so many grey levels to either side. */
static drogue_image draw(double radius, double step, double share, double disc, int noise)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    uint64_t rng = 77;
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double d = hypot(x - xc, y - yc), turn = atan2(y - yc, x - xc) / (2 * TEST_PI) + 0.5;
            const double in =
                (share > 1 ? fmod(16 * turn, 1) < share - 1 : turn < share) ? 0.5 * erfc((d - radius) / 1.1) : 0;
            const double dark = 0.5 * erfc((d - disc) / 1.1);
            pixels[y * SIDE + x] =
                (uint8_t)lround(180 + step * in - 120 * dark + (noise > 0 ? rng_real(&rng, -noise, noise) : 0));
        }
    }
    return view;
}

static drogue_ellipse circle(double radius)
{
    const drogue_ellipse e = {q16_of(xc), q16_of(yc), q16_of(radius), q16_of(radius), 0};
    return e;
}

static void begin(uint32_t edges)
{
    const drogue_capacity capacity = {SIDE, edges, 200, 50};
    ck_assert_int_eq(drogue_workspace_init(&workspace, memory, sizeof memory, &capacity), DROGUE_OK);
}

/* The outline lies 'off' px from where it is looked for. */
static uint32_t look(const drogue_image *view, double about, double beyond)
{
    const drogue_ellipse e = circle(about);
    return drogue_inner_beyond(&workspace, view, &e, q16_of(beyond));
}

START_TEST(points_on_a_faint_outline)
{
    double off, step;
    begin(600);
    for (step = -7; step <= 7; step += 14) { /* either sign */
        for (off = -1; off <= 2; off += 0.5) {
            const drogue_image view = draw(48, step, 1, 20, 2);
            const uint32_t count = look(&view, 48 - off, 4);
            double sum = 0, gradient = 0;
            uint32_t i;
            MUST(count > 300 && count <= 8 * 64, "off by %g: %u points", off, count);
            for (i = 0; i < count; i++) {
                const drogue_edge *e = &workspace.edges[i];
                const double x = e->x_q5 / 32.0 - xc, y = e->y_q5 / 32.0 - yc, r = hypot(x, y);
                MUST(fabs(r - 48) < 1.3 && e->arc == DROGUE_NO_ARC, "off by %g: at %g", off, r);
                sum += r - 48;
                gradient += (e->gx * x + e->gy * y) / r;
            }
            MUST(fabs(sum / count) < 0.1, "off by %g: %g", off, sum / count);
            /* the front end's gradient of a step that blur of 0.78 px and its own of 1.15 px widen */
            MUST(fabs(gradient / count / (-step * 8 / (sqrt(2 * TEST_PI) * 1.39)) - 1) < 0.25, "off by %g: %g", off,
                 gradient / count);
        }
    }
}
END_TEST

START_TEST(no_more_than_there_is_room_for)
{
    drogue_image view = draw(48, 8, 1, 20, 1);
    begin(600);
    const uint32_t all = look(&view, 47, 4);
    begin(100);
    ck_assert_int_eq(look(&view, 47, 4), 100);
    ck_assert_int_gt(all, 200);
    view = draw(80, 8, 1, 20, 0); /* as many as the outline looks at all of */
    begin(600);
    ck_assert_int_eq(look(&view, 80, 4), DROGUE_INNER_BEYOND_POINTS);
}
END_TEST

START_TEST(what_is_no_outline)
{
    drogue_image view = draw(48, 8, 0.55, 20, 1); /* half of it: not all about */
    begin(600);
    ck_assert_int_eq(look(&view, 47.5, 4), 0);
    view = draw(48, 8, 0.8, 20, 1); /* six of eight parts */
    ck_assert_int_gt(look(&view, 47.5, 4), 100);
    view = draw(48, 8, 1.3, 20, 1); /* all about, on a third of the rays; on half of them */
    ck_assert_int_eq(look(&view, 47.5, 4), 0);
    view = draw(48, 8, 1.55, 20, 1);
    ck_assert_int_gt(look(&view, 47.5, 4), 100);
    view = draw(48, 3, 1, 20, 0); /* a step of less than five grey levels */
    ck_assert_int_eq(look(&view, 47.5, 4), 0);
    view = draw(48, 0, 1, 20, 3); /* noise */
    ck_assert_int_eq(look(&view, 47.5, 4), 0);
    view = draw(48, 8, 1, 20, 1); /* farther out than 5/8 of what is beyond, and a pixel */
    ck_assert_int_eq(look(&view, 43, 4), 0);
    view = draw(48, 0, 1, 44.5, 1); /* an edge within, which is the outline's that is known */
    ck_assert_int_eq(look(&view, 47.5, 4), 0);
    ck_assert_int_gt(look(&view, 46, 4), 0);
    ck_assert_int_eq(look(&view, 0.5, 4), 0);
}
END_TEST

/* Past the region's border there are no points. */
START_TEST(across_the_border)
{
    drogue_image view = draw(48, 8, 1, 20, 1);
    uint32_t count, i;
    for (view.width_px = 130; view.width_px < 146; view.width_px++) {
        begin(600);
        count = look(&view, 47.5, 4);
        ck_assert_int_gt(count, 100);
        for (i = 0; i < count; i++) {
            ck_assert_int_le(workspace.edges[i].x_q5, (view.width_px - 1) * 32);
        }
    }
}
END_TEST

/* Of an outline of more than 180 px there are none. */
START_TEST(as_large_as_points_suffice_for)
{
    enum { LARGE = 376 };
    static uint8_t large[LARGE * LARGE];
    const drogue_image view = {large, LARGE, LARGE, LARGE};
    drogue_ellipse about = {q16_of(188), q16_of(188), q16_of(180), q16_of(180), 0};
    int x, y;
    begin(600);
    for (y = 0; y < LARGE; y++) {
        for (x = 0; x < LARGE; x++) {
            large[y * LARGE + x] = hypot(x - 188, y - 188) < 180 ? 188 : 180;
        }
    }
    ck_assert_int_gt(drogue_inner_beyond(&workspace, &view, &about, q16_of(5)), 400);
    about.a_px_q16++;
    ck_assert_int_eq(drogue_inner_beyond(&workspace, &view, &about, q16_of(5)), 0);
}
END_TEST

/* A lip about a dark cone before brighter ground, blurred by 0.78 px and its outer edge at 48 px. */
static drogue_image draw_lip(double width, int lip, int ground)
{
    const drogue_image view = {pixels, SIDE, SIDE, SIDE};
    int x, y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            const double d = hypot(x - xc, y - yc);
            const double cone = 0.5 * erfc((d - 48 + width) / 1.1), drogue = 0.5 * erfc((d - 48) / 1.1);
            pixels[y * SIDE + x] = (uint8_t)lround(ground + (lip - ground) * drogue + (70 - lip) * cone);
        }
    }
    return view;
}

/* The outer edge of a lip, whose inner one is steeper and near: of stairs, which blur draws together, and of a line, which it
 * draws apart. */
START_TEST(outer_edge_of_a_lip)
{
    static const struct {
        double width;
        int lip, ground;
        double least, most; /* px off */
    } lips[] = {{2.4, 140, 200, -0.4, 0}, {3, 140, 200, -0.1, 0}, {2.4, 230, 170, 0, 0.3}, {1.2, 230, 170, 0, 1}};
    size_t i;
    begin(600);
    for (i = 0; i < sizeof lips / sizeof lips[0]; i++) {
        const drogue_image view = draw_lip(lips[i].width, lips[i].lip, lips[i].ground);
        const uint32_t count = look(&view, 48.5, 0.5 + lips[i].width);
        double off = 0;
        uint32_t k;
        MUST(count > 400, "lip %d: %u points", (int)i, count);
        for (k = 0; k < count; k++) {
            off += hypot(workspace.edges[k].x_q5 / 32.0 - xc, workspace.edges[k].y_q5 / 32.0 - yc) - 48;
        }
        off /= count;
        MUST(off > lips[i].least && off < lips[i].most, "lip %d: off by %g px", (int)i, off);
    }
}
END_TEST

/* Noise that the least steps do not keep out: a standard deviation of 8 grey levels beside a disc, 24 times. */
START_TEST(noise_is_no_outline)
{
    static const double beyond[] = {1, 2.5, 5};
    uint64_t rng = 5;
    size_t i;
    int k, n;
    begin(600);
    for (i = 0; i < sizeof beyond / sizeof beyond[0]; i++) {
        for (k = 0; k < 24; k++) {
            const drogue_image view = draw(48, 0, 1, 30, 0);
            for (n = 0; n < SIDE * SIDE; n++) { /* of four even ones */
                const double noise =
                    rng_real(&rng, -7, 7) + rng_real(&rng, -7, 7) + rng_real(&rng, -7, 7) + rng_real(&rng, -7, 7);
                pixels[n] = (uint8_t)lround(fmax(0, pixels[n] + noise));
            }
            MUST(look(&view, 30 + beyond[i], beyond[i]) == 0, "beyond %g px, drawing %d", beyond[i], k);
        }
    }
}
END_TEST

SUITE_MAIN("beyond", noise_is_no_outline, outer_edge_of_a_lip, as_large_as_points_suffice_for,
           points_on_a_faint_outline, no_more_than_there_is_room_for, what_is_no_outline, across_the_border)
