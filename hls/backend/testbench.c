/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_outline() and drogue_hls_pose(): every frame vector through the library's front end, the
 * outline's top, the library's search for the dark disc, and the pose's top. Every word of the tops is compared with the
 * library's functions, and the end of the chain with the vector's words. */
#include "testbench.h"
#include "backend.h"
#include "drogue/decide.h"
#include "drogue/inner.h"
#include "drogue/undistort.h"

static uint32_t
    memory[(DROGUE_WORKSPACE_BYTES(DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS) + 3) / 4];
static uint64_t edges[DROGUE_HLS_EDGES];
static uint64_t arcs[DROGUE_HLS_ARCS];
static int32_t registers[DROGUE_HLS_PARAMETERS];
static int32_t outline[DROGUE_HLS_OUTLINE_WORDS];
static int32_t dark[DROGUE_HLS_DARK_WORDS];
static int32_t result[DROGUE_HLS_RESULT_WORDS];
static int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS];
static int64_t std_q32[DROGUE_HLS_STD_WORDS];

/* A frame on its way through the library. */
typedef struct frame {
    drogue_workspace workspace;
    drogue_hls_parameters p;
    drogue_image image;
    drogue_image view;
    drogue_region asked;
    drogue_region region;
    drogue_edge_list list;
    drogue_outline outline;
    drogue_result result; /* what the tops should lead to */
} frame;

static drogue_q16 word(const conf_case *c, int input, size_t i) { return (drogue_q16)conf_word(&c->inputs[input], i); }

static void read_case(frame *f, const conf_case *c)
{
    drogue_hls_parameters *p = &f->p;
    memset(f, 0, sizeof *f);
    f->image.data = (const uint8_t *)c->inputs[0].data;
    f->image.width_px = f->image.stride = c->inputs[0].width_px;
    f->image.height_px = c->inputs[0].height_px;
    p->camera.fx_px_q16 = word(c, 1, 0);
    p->camera.fy_px_q16 = word(c, 1, 1);
    p->camera.cx_px_q16 = word(c, 1, 2);
    p->camera.cy_px_q16 = word(c, 1, 3);
    p->camera.k1_q16 = word(c, 1, 4);
    p->camera.k2_q16 = word(c, 1, 5);
    p->camera.p1_q16 = word(c, 1, 6);
    p->camera.p2_q16 = word(c, 1, 7);
    p->camera.k3_q16 = word(c, 1, 8);
    p->model.rim_radius_m_q16 = word(c, 2, 0);
    p->model.inner_radius_m_q16 = word(c, 2, 1);
    p->model.inner_depth_m_q16 = word(c, 2, 2);
    drogue_config_default(&p->config);
    f->asked.x_px = word(c, 3, 0);
    f->asked.y_px = word(c, 3, 1);
    f->asked.width_px = word(c, 3, 2);
    f->asked.height_px = word(c, 3, 3);
}

static void clip(int32_t *at, int32_t *length, int32_t limit)
{
    const int32_t end = *at + *length;
    *at = *at < 0 ? 0 : *at;
    *length = (end > limit ? limit : end) - *at;
}

/* The part of the region within the image, and the mask of the whole region in its coordinates; 0 when there is none or
 * the blocks are too small. */
static int place(frame *f)
{
    const int32_t most = DROGUE_MAX_REGION;
    f->region = f->asked;
    if (f->asked.width_px < 1 || f->asked.height_px < 1 || f->asked.width_px > most || f->asked.height_px > most ||
        f->asked.x_px > most || f->asked.x_px < -most || f->asked.y_px > most || f->asked.y_px < -most) {
        return 0;
    }
    clip(&f->region.x_px, &f->region.width_px, f->image.width_px);
    clip(&f->region.y_px, &f->region.height_px, f->image.height_px);
    f->p.mask = drogue_mask_of_size(f->asked.width_px, f->asked.height_px);
    f->p.mask.centre2_x += 2 * (f->asked.x_px - f->region.x_px);
    f->p.mask.centre2_y += 2 * (f->asked.y_px - f->region.y_px);
    f->p.x_px = f->region.x_px;
    f->p.y_px = f->region.y_px;
    f->view = f->image;
    f->view.data += f->region.y_px * f->image.stride + f->region.x_px;
    f->view.width_px = f->region.width_px;
    f->view.height_px = f->region.height_px;
    return f->region.width_px >= 1 && f->region.height_px >= 1 && f->asked.width_px <= DROGUE_HLS_WIDTH &&
           f->region.height_px <= DROGUE_HLS_HEIGHT;
}

static drogue_status lay_out(frame *f)
{
    drogue_capacity capacity;
    capacity.width_px = (uint32_t)f->asked.width_px;
    capacity.edges = (uint32_t)DROGUE_HLS_EDGES;
    capacity.labels = (uint32_t)DROGUE_HLS_LABELS;
    capacity.arcs = (uint32_t)DROGUE_HLS_ARCS;
    return drogue_workspace_init(&f->workspace, memory, sizeof memory, &capacity);
}

/* The front end as drogue_measure() runs it. */
static drogue_status run_frontend(frame *f)
{
    drogue_frontend_config config;
    drogue_frontend frontend;
    drogue_status status;
    int32_t y;
    config.canny_low = f->p.config.canny_low;
    config.canny_high = f->p.config.canny_high;
    config.smooth = f->p.config.smooth;
    config.use_ring = 1;
    config.ring = f->p.mask;
    config.min_arc_px =
        (uint32_t)drogue_shr_round_s64((int64_t)f->p.config.min_arc_share_q16 * f->p.mask.longest_px, 16);
    if (config.min_arc_px < f->p.config.min_arc_px) {
        config.min_arc_px = f->p.config.min_arc_px;
    }
    status = drogue_frontend_begin(&frontend, &f->workspace, &config, f->view.width_px, f->view.height_px);
    for (y = 0; status == DROGUE_OK && y < f->view.height_px; y++) {
        drogue_frontend_row(&frontend, drogue_image_row(&f->view, y));
    }
    return status == DROGUE_OK ? drogue_frontend_end(&f->list, &frontend) : status;
}

/* Ideal outline and poses by the library. */
static drogue_status find_poses(frame *f, drogue_pose poses[2])
{
    const drogue_hls_parameters *p = &f->p;
    drogue_result *r = &f->result;
    r->ellipse = f->outline.ellipse;
    r->ellipse.xc_px_q16 = drogue_q16_add(r->ellipse.xc_px_q16, drogue_q16_from_int(p->x_px));
    r->ellipse.yc_px_q16 = drogue_q16_add(r->ellipse.yc_px_q16, drogue_q16_from_int(p->y_px));
    r->ideal = r->ellipse;
    if (drogue_camera_distorts(&p->camera) &&
        drogue_outline_undistorted(&r->ideal, &f->outline, &f->workspace, &f->list, &p->config, &p->camera, p->x_px,
                                   p->y_px) != DROGUE_OK) {
        memset(&r->ideal, 0, sizeof r->ideal);
        return DROGUE_E_NO_ELLIPSE;
    }
    return drogue_pose_from_ellipse(poses, &r->ideal, &p->camera, p->model.rim_radius_m_q16);
}

/* Does drogue_measure() refuse the parameters before it looks at the image? */
static int refused(frame *f)
{
    drogue_workspace workspace = f->workspace;
    drogue_result r;
    f->workspace.capacity.width_px = 0; /* no room: the next thing that it would answer */
    (void)drogue_measure(&r, &f->workspace, &f->p.config, &f->p.camera, &f->p.model, &f->image, &f->asked);
    f->workspace = workspace;
    return r.status == DROGUE_E_ARGUMENT;
}

/* The library's words for the outline's top. */
static drogue_status expect_outline(int32_t *words, frame *f, drogue_status status)
{
    const drogue_outline *o = &f->outline;
    drogue_pose poses[2];
    drogue_ellipse discs[2];
    drogue_mask disc = {0, 0, 0};
    int k;
    memset(poses, 0, sizeof poses);
    memset(discs, 0, sizeof discs);
    if (status == DROGUE_OK && refused(f)) {
        status = DROGUE_E_ARGUMENT;
    }
    words[DROGUE_HLS_O_FOUND] = (int32_t)status;
    if (status == DROGUE_OK) {
        status = drogue_outline_find(&f->outline, &f->workspace, &f->list, &f->p.mask, &f->p.config);
        words[DROGUE_HLS_O_FOUND] = (int32_t)status;
    } else {
        memset(f->outline.arcs, 0xFF, sizeof f->outline.arcs);
    }
    if (status == DROGUE_OK) {
        status = find_poses(f, poses);
        drogue_hls_pack_ellipse(words + DROGUE_HLS_O_IDEAL, &f->result.ideal);
    }
    if (status == DROGUE_OK && f->p.model.inner_radius_m_q16 > 0) {
        disc = drogue_inner_disc(&o->ellipse);
        words[DROGUE_HLS_O_EXPECTED_COUNT] =
            (int32_t)drogue_inner_expect(discs, poses, &f->p.camera, &f->p.model, f->p.x_px, f->p.y_px);
        disc.longest_px = drogue_mask_valid(&disc) ? disc.longest_px : 0;
    }
    words[DROGUE_HLS_O_STATUS] = (int32_t)status;
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_ELLIPSE, &o->ellipse);
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_FITTED, &o->fitted);
    memcpy(words + DROGUE_HLS_O_QUALITY, &o->quality, sizeof o->quality);
    words[DROGUE_HLS_O_POLARITY] = (int32_t)o->polarity;
    memcpy(words + DROGUE_HLS_O_ARCS, o->arcs, sizeof o->arcs);
    words[DROGUE_HLS_O_CLUSTER_MEMBERS] = (int32_t)o->cluster_members;
    words[DROGUE_HLS_O_REFIT_POINTS] = (int32_t)o->refit_points;
    words[DROGUE_HLS_O_COVER] = o->cover_q16;
    words[DROGUE_HLS_O_BAND] = o->band_px_q16;
    for (k = 0; k < 2; k++) {
        drogue_hls_pack_pose(words + DROGUE_HLS_O_POSES + 8 * k, &poses[k]);
        drogue_hls_pack_ellipse(words + DROGUE_HLS_O_EXPECTED + 5 * k, &discs[k]);
    }
    words[DROGUE_HLS_O_DISC] = disc.longest_px > 0 ? disc.centre2_x : 0;
    words[DROGUE_HLS_O_DISC + 1] = disc.longest_px > 0 ? disc.centre2_y : 0;
    words[DROGUE_HLS_O_DISC + 2] = disc.longest_px;
    memcpy(words + DROGUE_HLS_O_BINS, o->support.bin, sizeof o->support.bin);
    drogue_hls_pack_u64(words + DROGUE_HLS_O_SQUARES, (uint64_t)o->support.squares_q32);
    drogue_hls_pack_u64(words + DROGUE_HLS_O_GRADIENT, o->support.gradient);
    words[DROGUE_HLS_O_POINTS] = (int32_t)o->support.points;
    words[DROGUE_HLS_O_BRIGHT_BINS] = (int32_t)o->support.bright_bins;
    words[DROGUE_HLS_O_COVERED] = (int32_t)o->support.covered;
    return status;
}

static void run_outline(bench *b, frame *f, drogue_status front)
{
    int32_t expected[DROGUE_HLS_OUTLINE_WORDS];
    uint32_t i;
    memset(expected, 0, sizeof expected);
    for (i = 0; i < f->list.edge_count; i++) {
        edges[i] = drogue_hls_pack_edge(&f->workspace.edges[i]);
    }
    for (i = 0; i < f->list.arc_count; i++) {
        arcs[i] = drogue_hls_pack_arc(&f->workspace.arcs[i]);
    }
    drogue_hls_pack_parameters(registers, &f->p);
    memset(outline, 0x55, sizeof outline);
    BENCH_ARRAY(0, edges);
    BENCH_ARRAY(2, arcs);
    BENCH_ARRAY(5, registers);
    BENCH_ARRAY(6, outline);
    drogue_hls_outline(edges, f->list.edge_count, arcs, f->list.arc_count, (uint32_t)front, registers, outline);
    f->result.status = expect_outline(expected, f, front);
    bench_words32(b, "outline", outline, expected, DROGUE_HLS_OUTLINE_WORDS);
}

/* The dark disc by the library, where the outline's top says. */
static void find_dark(const frame *f)
{
    const drogue_ellipse expected[2] = {drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED),
                                        drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED + 5)};
    drogue_workspace workspace = f->workspace;
    drogue_mask disc;
    drogue_dark_part part;
    uint32_t which = 0;
    memset(dark, 0, sizeof dark);
    memset(&part, 0, sizeof part);
    disc.centre2_x = outline[DROGUE_HLS_O_DISC];
    disc.centre2_y = outline[DROGUE_HLS_O_DISC + 1];
    disc.longest_px = outline[DROGUE_HLS_O_DISC + 2];
    if (disc.longest_px == 0) {
        dark[DROGUE_HLS_D_STATUS] = DROGUE_E_ARGUMENT; /* which nobody is to look at */
        return;
    }
    dark[DROGUE_HLS_D_STATUS] =
        (int32_t)drogue_dark_disc_find(&part, &which, &workspace, &f->view, &disc, f->p.config.min_dark_area_px,
                                       expected, (uint32_t)outline[DROGUE_HLS_O_EXPECTED_COUNT]);
    dark[DROGUE_HLS_D_X] = part.x_px_q16;
    dark[DROGUE_HLS_D_Y] = part.y_px_q16;
    dark[DROGUE_HLS_D_AREA] = (int32_t)part.area_px;
    dark[DROGUE_HLS_D_SPREAD] = part.spread_px_q16;
    dark[DROGUE_HLS_D_THRESHOLD] = part.threshold;
    dark[DROGUE_HLS_D_CONTRAST] = part.contrast;
    dark[DROGUE_HLS_D_WHICH] = (int32_t)which;
}

static void run_pose(void)
{
    memset(result, 0x55, sizeof result);
    memset(covariance, 0x55, sizeof covariance);
    memset(std_q32, 0x55, sizeof std_q32);
    BENCH_ARRAY(0, registers);
    BENCH_ARRAY(1, outline);
    BENCH_ARRAY(2, dark);
    BENCH_ARRAY(3, result);
    BENCH_ARRAY(4, covariance);
    BENCH_ARRAY(5, std_q32);
    drogue_hls_pose(registers, outline, dark, result, covariance, std_q32);
}

/* The words of a frame vector from those of the tops. */
static void frame_words(int32_t words[38], const frame *f)
{
    const int seen = outline[DROGUE_HLS_O_FOUND] == DROGUE_OK;
    drogue_ellipse e = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_ELLIPSE);
    int k;
    memset(words, 0, 38 * sizeof *words);
    words[0] = result[DROGUE_HLS_R_STATUS] & (int32_t)DROGUE_HLS_STATUS;
    if (seen) {
        e.xc_px_q16 += f->p.x_px * DROGUE_Q16_ONE;
        e.yc_px_q16 += f->p.y_px * DROGUE_Q16_ONE;
        drogue_hls_pack_ellipse(words + 1, &e);
        memcpy(words + 6, outline + DROGUE_HLS_O_IDEAL, 5 * sizeof *words);
        words[11] = outline[DROGUE_HLS_O_POLARITY];
        for (k = 0; k < 4; k++) {
            words[12] |= outline[DROGUE_HLS_O_ARCS + k] >= 0 ? 1 << k : 0;
        }
        words[13] = outline[DROGUE_HLS_O_REFIT_POINTS];
    }
    words[14] = result[DROGUE_HLS_R_HAS_INNER];
    words[15] = result[DROGUE_HLS_R_INNER];
    words[16] = result[DROGUE_HLS_R_INNER + 1];
    words[17] = result[DROGUE_HLS_R_INNER + 2];
    words[18] = result[DROGUE_HLS_R_INNER + 4];
    words[19] = result[DROGUE_HLS_R_INNER + 3];
    memcpy(words + 20, result + DROGUE_HLS_R_POSE, 18 * sizeof *words);
}

static void detail_words(int32_t words[17], const frame *f)
{
    const int seen = outline[DROGUE_HLS_O_FOUND] == DROGUE_OK;
    int k;
    memset(words, 0, 17 * sizeof *words);
    words[0] = f->region.x_px;
    words[1] = f->region.y_px;
    words[2] = f->region.width_px;
    words[3] = f->region.height_px;
    words[4] = (int32_t)f->list.edge_count;
    words[5] = (int32_t)f->list.arc_count;
    for (k = 0; k < 4; k++) {
        words[6 + k] = seen ? outline[DROGUE_HLS_O_ARCS + k] : -1;
    }
    if (seen) {
        memcpy(words + 10, outline + DROGUE_HLS_O_QUALITY, 5 * sizeof *words);
        words[15] = outline[DROGUE_HLS_O_CLUSTER_MEMBERS];
        words[16] = outline[DROGUE_HLS_O_COVER];
    }
}

/* Is what the vector expects that of the region asked for, not of another one that the library looked at after it? */
static int first_look(const frame *f, const conf_case *c)
{
    const conf_array *detail = &c->exact[1].array;
    return conf_word(detail, 0) == f->region.x_px && conf_word(detail, 1) == f->region.y_px &&
           conf_word(detail, 2) == f->region.width_px && conf_word(detail, 3) == f->region.height_px;
}

static int table_full(drogue_status front)
{
    return front == DROGUE_E_EDGES_FULL || front == DROGUE_E_LABELS_FULL || front == DROGUE_E_ARCS_FULL;
}

/* The library's second half on the same first half: the tops' end whatever the vector looked at. */
static void expect_pose(bench *b, frame *f)
{
    int32_t expected[DROGUE_HLS_RESULT_WORDS];
    drogue_joint_inner inner = {0, 0, 0};
    drogue_result *r = &f->result;
    drogue_pose poses[2];
    drogue_status status = (drogue_status)dark[DROGUE_HLS_D_STATUS];
    uint32_t nearer = 0;
    int i;
    int j;
    memset(expected, 0, sizeof expected);
    r->ambiguity_q16 = DROGUE_Q16_ONE;
    r->region = f->region;
    drogue_hls_unpack_pose(&poses[0], outline + DROGUE_HLS_O_POSES);
    drogue_hls_unpack_pose(&poses[1], outline + DROGUE_HLS_O_POSES + 8);
    if (r->status == DROGUE_OK && f->p.model.inner_radius_m_q16 > 0 && outline[DROGUE_HLS_O_DISC + 2] > 0) {
        if (status == DROGUE_OK) {
            const drogue_ellipse e =
                drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED + 5 * dark[DROGUE_HLS_D_WHICH]);
            r->inner.x_px_q16 = dark[DROGUE_HLS_D_X];
            r->inner.y_px_q16 = dark[DROGUE_HLS_D_Y];
            r->inner.area_px = (uint32_t)dark[DROGUE_HLS_D_AREA];
            r->inner.spread_px_q16 = dark[DROGUE_HLS_D_SPREAD];
            r->inner.threshold = (uint8_t)dark[DROGUE_HLS_D_THRESHOLD];
            r->inner.contrast = (uint8_t)dark[DROGUE_HLS_D_CONTRAST];
            nearer =
                drogue_inner_weigh(&inner, r, &e, &f->outline.ellipse, poses, &f->p.config, &f->p.camera, &f->p.model);
        }
        r->status = status == DROGUE_E_NO_DARK_PART ? DROGUE_OK : status;
    }
    if (r->status == DROGUE_OK) {
        r->status =
            drogue_decide(r, poses, nearer, &f->outline.support, &inner, &f->p.config, &f->p.camera, &f->p.model);
    }
    expected[DROGUE_HLS_R_STATUS] = (int32_t)r->status;
    expected[DROGUE_HLS_R_HAS_INNER] = r->has_inner;
    expected[DROGUE_HLS_R_INNER] = r->inner.x_px_q16;
    expected[DROGUE_HLS_R_INNER + 1] = r->inner.y_px_q16;
    expected[DROGUE_HLS_R_INNER + 2] = (int32_t)r->inner.area_px;
    expected[DROGUE_HLS_R_INNER + 3] = r->inner.spread_px_q16;
    expected[DROGUE_HLS_R_INNER + 4] = r->inner.threshold;
    expected[DROGUE_HLS_R_INNER + 5] = r->inner.contrast;
    drogue_hls_pack_pose(expected + DROGUE_HLS_R_POSE, &r->pose);
    drogue_hls_pack_pose(expected + DROGUE_HLS_R_ALTERNATIVE, &r->alternative);
    expected[DROGUE_HLS_R_RESOLVED] = r->orientation_resolved;
    expected[DROGUE_HLS_R_AMBIGUITY] = r->ambiguity_q16;
    bench_words32(b, "result", result, expected, DROGUE_HLS_RESULT_WORDS);
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            bench_word(b, "covariance", (size_t)(5 * i + j), covariance[i * (i + 1) / 2 + j], r->covariance_q48[i][j]);
        }
    }
    bench_words64(b, "std", std_q32, r->position_std_m_q32, 3);
    bench_word(b, "std", 3, std_q32[3], r->axis_std_rad_q32);
}

static void run(bench *b, const conf_case *c)
{
    static frame f;
    int32_t words[38];
    int32_t detail[17];
    drogue_status front;
    read_case(&f, c);
    if (!place(&f)) {
        bench_skip(b, c->id, "no region within the image and the blocks");
        return;
    }
    bench_begin(b, c->id);
    bench_word(b, "workspace", 0, lay_out(&f), DROGUE_OK);
    front = run_frontend(&f);
    run_outline(b, &f, front);
    find_dark(&f);
    run_pose();
    expect_pose(b, &f);
    if (table_full(front)) {
        bench_end(b, " (a table is full)");
    } else if (f.result.status == DROGUE_E_ARGUMENT) {
        frame_words(words, &f);
        bench_vector32(b, c, "frame", words, 38);
        bench_end(b, " (refused)");
    } else if (!first_look(&f, c)) {
        bench_end(b, " (the vector's is another region)");
    } else {
        frame_words(words, &f);
        detail_words(detail, &f);
        bench_vector32(b, c, "frame", words, 38);
        bench_vector32(b, c, "detail", detail, 17);
        bench_vector64(b, c, "covariance", covariance, DROGUE_HLS_COVARIANCE_WORDS);
        bench_vector64(b, c, "std", std_q32, DROGUE_HLS_STD_WORDS);
        bench_end(b, "");
    }
}

static void expect_refused(bench *b, const char *what, uint32_t edge_count, uint32_t arc_count)
{
    size_t i;
    memset(outline, 0x55, sizeof outline);
    drogue_hls_outline(edges, edge_count, arcs, arc_count, 0, registers, outline);
    for (i = 0; i < DROGUE_HLS_OUTLINE_WORDS; i++) {
        const int is_arc = i >= DROGUE_HLS_O_ARCS && i < DROGUE_HLS_O_CLUSTER_MEMBERS;
        bench_word(b, what, i, outline[i], i <= DROGUE_HLS_O_FOUND ? DROGUE_E_ARGUMENT : is_arc ? -1 : 0);
    }
}

/* Lists and parameters that no front end and no driver should give. */
static void run_refused(bench *b)
{
    drogue_arc arc = {0, 5, 0};
    int k;
    bench_begin(b, "refused");
    arcs[0] = drogue_hls_pack_arc(&arc);
    expect_refused(b, "more edges than the memory", (uint32_t)DROGUE_HLS_EDGES + 1, 0);
    expect_refused(b, "more arcs than the memory", 0, (uint32_t)DROGUE_HLS_ARCS + 1);
    expect_refused(b, "arc beyond the list", 4, 1);
    arc.count = 0;
    arcs[0] = drogue_hls_pack_arc(&arc);
    expect_refused(b, "empty arc", 4, 1);
    for (k = 0; k < 3; k++) {
        static const int at[3] = {DROGUE_HLS_P_MASK_LONGEST, DROGUE_HLS_P_FY, DROGUE_HLS_P_REFIT_ROUNDS};
        const int32_t was = registers[at[k]];
        registers[at[k]] = -1;
        expect_refused(b, "parameter", 0, 0);
        registers[at[k]] = was;
    }
    bench_end(b, "");
}

int main(void)
{
    bench b = {"backend", "", 0, 0, 0, 0};
    size_t l;
    size_t i;
    for (l = 0; l < conf_case_list_count; l++) {
        for (i = 0; i < conf_case_lists[l].count; i++) {
            if (bench_wants(&conf_case_lists[l].cases[i], "frame")) {
                run(&b, &conf_case_lists[l].cases[i]);
            }
        }
    }
#ifndef __BAMBU_SIM__
    run_refused(&b);
#endif
    return bench_report(&b);
}
