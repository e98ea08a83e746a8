/* SPDX-License-Identifier: Apache-2.0 */
/* The block against the library, every word: on the vectors of stages disc, centroid and frame, on random images of odd
 * sizes, on patterns that merge or exceed the labels. */
#include "../../src/inner/pass.h"
#include "bench_drawn.h"
#include "disc_walk.h"
#include "drogue/drogue.h"
#include "drogue/inner.h"
#include "operators.h"

enum { FRAME_SIDE = 512 };

static int take_case(question *q, bench *b, const conf_case *c)
{
    const int32_t *p = bench_words32(bench_input(c, "params"));
    memset(q, 0, sizeof *q);
    q->image = bench_image(c);
    q->disc.centre2_x = p[0];
    q->disc.centre2_y = p[1];
    q->disc.longest_px = p[2];
    q->expected.min_area_px = (uint32_t)p[3];
    if (q->image.height_px > DROGUE_HLS_HEIGHT) {
        bench_skip(b, "higher than DROGUE_HLS_HEIGHT");
        return 0;
    }
    return 1;
}

/* The vectors' own words hold where the block has room for the region and its labels. */
static void check_disc(bench *b, const int32_t dark[DROGUE_HLS_INNER_WORDS], const conf_case *c)
{
    const int32_t *part = bench_words32(bench_expected(c, "part"));
    const uint32_t status = (uint32_t)dark[DROGUE_HLS_D_STATUS] & DROGUE_HLS_STATUS;
    if (status == DROGUE_E_WORKSPACE || status == DROGUE_E_LABELS_FULL) {
        return;
    }
    bench_word(b, "vector's status", status, part[0]);
    bench_word(b, "vector's threshold", dark[DROGUE_HLS_D_THRESHOLD], part[1]);
    bench_word(b, "vector's area", dark[DROGUE_HLS_D_AREA], part[2]);
    bench_word(b, "vector's x", dark[DROGUE_HLS_D_X], part[3]);
    bench_word(b, "vector's y", dark[DROGUE_HLS_D_Y], part[4]);
    bench_word(b, "vector's spread", dark[DROGUE_HLS_D_SPREAD], part[5]);
    bench_word(b, "vector's which", dark[DROGUE_HLS_D_WHICH], part[6]);
    bench_word(b, "vector's contrast", dark[DROGUE_HLS_D_CONTRAST], part[8]);
}

static void disc_vectors(bench *b)
{
    const conf_case *c;
    while ((c = bench_next(b, "disc")) != NULL) {
        const conf_array *discs = bench_input(c, "expected");
        int32_t dark[DROGUE_HLS_INNER_WORDS];
        question q;
        uint32_t i;
        if (!take_case(&q, b, c)) {
            continue;
        }
        q.expected.count = (uint32_t)discs->count / 4;
        for (i = 0; i < q.expected.count; i++) {
            const int32_t *w = bench_words32(discs) + 4 * i;
            q.expected.disc[i] = circle(w[0], w[1], w[2]);
            q.expected.disc[i].b_px_q16 = w[3];
        }
        compare(b, dark, &q);
        check_disc(b, dark, c);
    }
}

static void centroid_vectors(bench *b)
{
    const conf_case *c;
    while ((c = bench_next(b, "centroid")) != NULL) {
        int32_t dark[DROGUE_HLS_INNER_WORDS];
        question q;
        if (take_case(&q, b, c)) {
            expect_middle(&q);
            compare(b, dark, &q);
        }
    }
}

/* What drogue_measure() asks of the inner part's search, put together again from its result. */
static void question_of(question *q, const drogue_result *r, const drogue_camera *camera, const drogue_model *model,
                        const drogue_config *config)
{
    drogue_ellipse outline = r->ellipse;
    drogue_pose poses[2];
    outline.xc_px_q16 -= drogue_q16_from_int(r->region.x_px);
    outline.yc_px_q16 -= drogue_q16_from_int(r->region.y_px);
    q->disc = drogue_inner_disc(&outline);
    if (outline.b_px_q16 > 0 && model->inner_radius_m_q16 > 0 &&
        drogue_pose_from_ellipse(poses, &r->ideal, camera, model->rim_radius_m_q16) == DROGUE_OK) {
        drogue_inner_expect(&q->expected, poses, &(drogue_setup){camera, model, config}, r->region.x_px,
                            r->region.y_px);
    } else {
        q->disc = drogue_mask_of_size(q->image.width_px, q->image.height_px);
        expect_middle(q);
    }
}

static void frame_vectors(bench *b)
{
    static uint32_t memory[DROGUE_WORKSPACE_BYTES(FRAME_SIDE, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS) / 4 + 1];
    const drogue_capacity capacity = {FRAME_SIDE, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS};
    const conf_case *c;
    while ((c = bench_next(b, "frame")) != NULL) {
        const drogue_camera camera = bench_camera(c);
        const drogue_model model = bench_model(c);
        const drogue_region region = bench_region(c);
        drogue_image image = bench_image(c);
        int32_t dark[DROGUE_HLS_INNER_WORDS];
        drogue_workspace workspace;
        drogue_config config;
        drogue_result result;
        question q;
        drogue_config_default(&config);
        if (!bench_check(b, "workspace",
                         drogue_workspace_init(&workspace, memory, sizeof memory, &capacity) == DROGUE_OK)) {
            return;
        }
        (void)drogue_measure(&result, &workspace, &(drogue_setup){&camera, &model, &config}, &image, &region);
        memset(&q, 0, sizeof q);
        q.image = image;
        if (result.region.width_px > 0) {
            q.image.data = drogue_image_row(&image, result.region.y_px) + result.region.x_px;
            q.image.width_px = result.region.width_px;
            q.image.height_px = result.region.height_px;
        }
        if (!fits(&q)) {
            bench_skip(b, "larger than DROGUE_HLS_WIDTH or _HEIGHT");
            continue;
        }
        q.expected.min_area_px = config.min_inner_area_px;
        question_of(&q, &result, &camera, &model, &config);
        compare(b, dark, &q);
    }
}

/* Arguments out of range: refused, and no pixel taken. */
static void refusals(bench *b)
{
    int32_t dark[DROGUE_HLS_INNER_WORDS];
    question q;
    memset(&q, 0, sizeof q);
    draw_random(&q, DISC, 8);
    q.disc.longest_px = 0;
    compare(b, dark, &q);
    q.disc.longest_px = (1 << 20) + 1;
    compare(b, dark, &q);
    q.disc.longest_px = 8;
    q.disc.centre2_x = (1 << 15) + 1;
    compare(b, dark, &q);
    q.disc.centre2_x = 0;
    q.image.width_px = q.image.stride = 0;
    compare(b, dark, &q);
    q.image.width_px = q.image.stride = DROGUE_MAX_SIDE + 1;
    compare(b, dark, &q);
    q.image.width_px = q.image.stride = DROGUE_HLS_WIDTH + 1;
    compare(b, dark, &q);
    q.image.width_px = q.image.stride = 4;
    q.image.height_px = DROGUE_HLS_HEIGHT + 1; /* the library's line buffers do not mind */
    ask_block(dark, &q);
    bench_word(b, "status of too high a region", dark[DROGUE_HLS_D_STATUS],
               DROGUE_HLS_HEIGHT < DROGUE_MAX_SIDE ? DROGUE_E_WORKSPACE : DROGUE_E_ARGUMENT);
    q.image.height_px = 4;
    q.expected.count = DROGUE_HLS_DISCS + 1;
    ask_block(dark, &q);
    bench_word(b, "status of too many discs", dark[DROGUE_HLS_D_STATUS], DROGUE_E_ARGUMENT);
    b->cases += 8;
}

/* Along a row the walk says of each pixel what the library's own test and its columns by a root say. */
static int walk_differs(const drogue_mask *disc, const drogue_hls_walk *rows, int32_t y, int32_t side)
{
    drogue_hls_walk columns = drogue_hls_walk_from(rows->left, disc->centre2_x);
    int32_t first = 0;
    int32_t last = -1;
    const int any = drogue_disc_span(&first, &last, disc, y, side);
    int differ = 0;
    int32_t x;
    for (x = 0; x < side; x++) {
        const int in = drogue_hls_in_disc(columns.left) != 0;
        differ += in != (any && x >= first && x <= last) || in != drogue_mask_in_disc(disc, x, y);
        drogue_hls_walk_on(&columns);
    }
    return differ;
}

static int disc_differs(const drogue_mask *disc, int32_t side)
{
    drogue_hls_walk rows = drogue_hls_walk_from(drogue_hls_disc_left(disc), disc->centre2_y);
    int differ = 0;
    int32_t y;
    for (y = 0; y < side; y++) {
        differ += walk_differs(disc, &rows, y, side);
        drogue_hls_walk_on(&rows);
    }
    return differ;
}

/* Small discs about every place, and the largest numbers of a valid mask. */
static void disc_by_walk(bench *b)
{
    enum { SIDE = 13, FAR = 1 << 15, MOST = 1 << 20 };
    static const int32_t centres[] = {-FAR, -FAR + 1, -2049, 0, 2047, 4095, 4096, FAR - 1, FAR};
    static const int32_t sizes[] = {1, 2048, 4096, 3 * FAR / 2 - 2, 3 * FAR / 2, 3 * FAR / 2 + 300, MOST - 1, MOST};
    drogue_mask disc;
    int differ = 0;
    size_t i;
    size_t j;
    size_t k;
    for (disc.longest_px = 1; disc.longest_px <= 48; disc.longest_px++) {
        for (disc.centre2_x = -SIDE; disc.centre2_x <= 3 * SIDE; disc.centre2_x++) {
            for (disc.centre2_y = -1; disc.centre2_y <= 0; disc.centre2_y++) {
                differ += disc_differs(&disc, SIDE);
            }
        }
    }
    for (i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (j = 0; j < sizeof centres / sizeof *centres; j++) {
            for (k = 0; k < sizeof centres / sizeof *centres; k++) {
                disc.longest_px = sizes[i];
                disc.centre2_x = centres[j];
                disc.centre2_y = centres[k];
                differ += disc_differs(&disc, 300);
            }
        }
    }
    b->cases++;
    bench_word(b, "pixels in a disc by the walk", differ, 0);
}

int main(void)
{
    bench b;
    bench_begin(&b, "inner");
    first_call(&b);
    disc_vectors(&b);
    b.list = b.index = 0;
    centroid_vectors(&b);
    b.list = b.index = 0;
    frame_vectors(&b);
#ifdef __BAMBU_SIM__ /* few: each is simulated */
    largest_image(&b, DISC);
    largest_image(&b, CELLS);
    largest_image(&b, ARCHES);
#else
    random_images(&b, 400, 70);
    full_labels(&b);
    refusals(&b);
    disc_by_walk(&b);
    printf("answers: ok %u, no part %u, labels full %u, refused %u\n", answers[DROGUE_OK],
           answers[DROGUE_E_NO_INNER_PART], answers[DROGUE_E_LABELS_FULL],
           answers[DROGUE_E_ARGUMENT] + answers[DROGUE_E_WORKSPACE]);
    bench_check(&b, "each answer is among them", answers[DROGUE_OK] > 500 && answers[DROGUE_E_NO_INNER_PART] > 50);
#endif
    return bench_end(&b);
}
