/* SPDX-License-Identifier: Apache-2.0 */
/* Test benches only: a frame of the vectors through the library's own functions, step by step as drogue_measure() takes
 * them, and the words that the tops of the back end should give. */
#ifndef DROGUE_HLS_FRAME_H
#define DROGUE_HLS_FRAME_H

#include <string.h>

#include "../words.h"
#include "bench.h"
#include "drogue/decide.h"
#include "drogue/inner.h"
#include "drogue/undistort.h"

#define FRAME_BYTES DROGUE_WORKSPACE_BYTES(DROGUE_HLS_WIDTH, DROGUE_HLS_EDGES, DROGUE_HLS_LABELS, DROGUE_HLS_ARCS)

typedef struct frame {
    uint32_t memory[(FRAME_BYTES + 3) / 4];
    drogue_workspace workspace;
    drogue_hls_parameters p;
    drogue_image image;
    drogue_image view; /* the region's pixels */
    drogue_region asked;
    drogue_region region;
    drogue_edge_list list;
    drogue_status front; /* what the front end answered */
    drogue_outline outline;
    drogue_result result;
    int32_t words[DROGUE_HLS_OUTLINE_WORDS]; /* of the outline's top */
} frame;

/* The part of the region within the image, and the mask of the whole region in its coordinates; 0 when there is none or
 * the blocks are too small. */
static inline int frame_place(frame *f)
{
    if (!bench_place(&f->region, &f->p.mask, &f->image, &f->asked)) {
        return 0;
    }
    f->p.x_px = f->region.x_px;
    f->p.y_px = f->region.y_px;
    f->view = f->image;
    f->view.data += f->region.y_px * f->image.stride + f->region.x_px;
    f->view.width_px = f->region.width_px;
    f->view.height_px = f->region.height_px;
    return f->region.width_px >= 1 && f->region.height_px >= 1 && f->asked.width_px <= DROGUE_HLS_WIDTH &&
           f->region.height_px <= DROGUE_HLS_HEIGHT;
}

/* Read a case; 0 when the blocks cannot do it. */
static inline int frame_read(frame *f, const conf_case *c)
{
    drogue_capacity capacity;
    memset(f, 0, sizeof *f);
    f->image = bench_image(c);
    f->p.camera = bench_camera(c);
    f->p.model = bench_model(c);
    f->asked = bench_region(c);
    f->p.config = bench_config(c);
    if (!frame_place(f)) {
        return 0;
    }
    capacity.width_px = (uint32_t)f->asked.width_px;
    capacity.edges = (uint32_t)DROGUE_HLS_EDGES;
    capacity.labels = (uint32_t)DROGUE_HLS_LABELS;
    capacity.arcs = (uint32_t)DROGUE_HLS_ARCS;
    return drogue_workspace_init(&f->workspace, f->memory, sizeof f->memory, &capacity) == DROGUE_OK;
}

/* The region's pixels row by row, as the tops read them. */
static inline void frame_pack_pixels(uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], const frame *f)
{
    int32_t y;
    for (y = 0; y < f->view.height_px; y++) {
        memcpy(pixels + y * f->view.width_px, drogue_image_row(&f->view, y), (size_t)f->view.width_px);
    }
}

static inline void frame_run_frontend(frame *f)
{
    drogue_frontend_config config;
    drogue_frontend frontend;
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
    f->front = drogue_frontend_begin(&frontend, &f->workspace, &config, f->view.width_px, f->view.height_px);
    if (f->front == DROGUE_OK) {
        for (y = 0; y < f->view.height_px; y++) {
            drogue_frontend_row(&frontend, drogue_image_row(&f->view, y));
        }
        f->front = drogue_frontend_end(&f->list, &frontend);
    }
}

/* Does drogue_measure() refuse the parameters before it looks at the image? */
static inline int frame_refused(const frame *f)
{
    drogue_workspace none = f->workspace;
    drogue_result r;
    none.capacity.width_px = 0; /* the next thing that it would answer */
    return drogue_measure(&r, &none, &(drogue_setup){&f->p.camera, &f->p.model, &f->p.config}, &f->image, &f->asked) ==
           DROGUE_E_ARGUMENT;
}

/* Ideal outline and poses. */
static inline drogue_status frame_find_poses(frame *f, drogue_pose poses[2])
{
    const drogue_hls_parameters *p = &f->p;
    drogue_result *r = &f->result;
    drogue_outline_pull(&f->outline, f->workspace.rays, &f->view, &p->config);
    r->ellipse = f->outline.ellipse;
    r->ellipse.xc_px_q16 = drogue_q16_add(r->ellipse.xc_px_q16, drogue_q16_from_int(p->x_px));
    r->ellipse.yc_px_q16 = drogue_q16_add(r->ellipse.yc_px_q16, drogue_q16_from_int(p->y_px));
    r->ideal = r->ellipse;
    if (drogue_camera_distorts(&p->camera) &&
        drogue_outline_undistorted(&r->ideal, &f->outline, &f->workspace, &f->list,
                                   &(drogue_setup){&p->camera, &p->model, &p->config}, p->x_px, p->y_px) != DROGUE_OK) {
        memset(&r->ideal, 0, sizeof r->ideal);
        return DROGUE_E_NO_ELLIPSE;
    }
    return drogue_pose_from_ellipse(poses, &r->ideal, &p->camera, p->model.rim_radius_m_q16);
}

static inline void frame_put_outline(frame *f, const drogue_pose poses[2], const drogue_inner_expected *expected)
{
    const drogue_outline *o = &f->outline;
    int32_t *w = f->words;
    int k;
    drogue_hls_pack_ellipse(w + DROGUE_HLS_O_ELLIPSE, &o->ellipse);
    drogue_hls_pack_ellipse(w + DROGUE_HLS_O_FITTED, &o->fitted);
    drogue_hls_pack_ellipse(w + DROGUE_HLS_O_IDEAL, &f->result.ideal);
    memcpy(w + DROGUE_HLS_O_QUALITY, &o->quality, sizeof o->quality);
    w[DROGUE_HLS_O_POLARITY] = (int32_t)o->polarity;
    memcpy(w + DROGUE_HLS_O_ARCS, o->arcs, sizeof o->arcs);
    w[DROGUE_HLS_O_CLUSTER_MEMBERS] = (int32_t)o->cluster_members;
    w[DROGUE_HLS_O_REFIT_POINTS] = (int32_t)o->refit_points;
    w[DROGUE_HLS_O_COVER] = o->cover_q16;
    w[DROGUE_HLS_O_BAND] = o->band_px_q16;
    for (k = 0; k < 2; k++) {
        drogue_hls_pack_pose(w + DROGUE_HLS_O_POSES + 8 * k, &poses[k]);
        drogue_hls_pack_ellipse(w + DROGUE_HLS_O_EXPECTED + 5 * k, &expected->disc[k]);
    }
    memcpy(w + DROGUE_HLS_O_BINS, o->support.bin, sizeof o->support.bin);
    drogue_hls_pack_u64(w + DROGUE_HLS_O_SQUARES, (uint64_t)o->support.squares_q32);
    drogue_hls_pack_u64(w + DROGUE_HLS_O_GRADIENT, o->support.gradient);
    w[DROGUE_HLS_O_POINTS] = (int32_t)o->support.points;
    w[DROGUE_HLS_O_BRIGHT_BINS] = (int32_t)o->support.bright_bins;
    w[DROGUE_HLS_O_COVERED] = (int32_t)o->support.covered;
    w[DROGUE_HLS_O_AXIS] = o->support.axis_rad_q16;
    memcpy(w + DROGUE_HLS_O_PULL, o->support.pull_q24, sizeof o->support.pull_q24);
    memcpy(w + DROGUE_HLS_O_SMEAR, o->support.smear_px2_q16, sizeof o->support.smear_px2_q16);
    w[DROGUE_HLS_O_OUTSIDE] = (int32_t)o->support.outside;
}

/* The first half of the back end, after the front end; also puts its words. */
static inline void frame_find_outline(frame *f)
{
    drogue_pose poses[2];
    drogue_inner_expected expected;
    drogue_status status = f->front == DROGUE_OK && frame_refused(f) ? DROGUE_E_ARGUMENT : f->front;
    memset(poses, 0, sizeof poses);
    memset(&expected, 0, sizeof expected);
    memset(f->outline.arcs, 0xFF, sizeof f->outline.arcs);
    if (status == DROGUE_OK) {
        status = drogue_outline_find(&f->outline, &f->workspace, &f->list, &f->p.mask, &f->p.config);
    }
    f->words[DROGUE_HLS_O_FOUND] = (int32_t)status;
    if (status == DROGUE_OK && f->p.larger &&
        !drogue_outline_enlarge(&f->outline, &f->workspace, &f->list, &f->p.mask, &f->p.config)) {
        status = DROGUE_E_NO_ELLIPSE;
    }
    if (status == DROGUE_OK) {
        status = frame_find_poses(f, poses);
    }
    if (status == DROGUE_OK && f->p.model.inner_radius_m_q16 > 0) {
        drogue_inner_expect(&expected, poses, &(drogue_setup){&f->p.camera, &f->p.model, &f->p.config}, f->p.x_px,
                            f->p.y_px);
        f->words[DROGUE_HLS_O_EXPECTED_COUNT] = (int32_t)expected.count;
    }
    f->words[DROGUE_HLS_O_STATUS] = (int32_t)status;
    f->result.status = status;
    frame_put_outline(f, poses, &expected);
}

/* The inner disc, where the outline says. */
static inline void frame_find_inner(int32_t words[DROGUE_HLS_EDGE_WORDS], const frame *f)
{
    const drogue_inner_expected expected = {(uint32_t)f->words[DROGUE_HLS_O_EXPECTED_COUNT],
                                            {drogue_hls_unpack_ellipse(f->words + DROGUE_HLS_O_EXPECTED),
                                             drogue_hls_unpack_ellipse(f->words + DROGUE_HLS_O_EXPECTED + 5)}};
    drogue_ray rays[DROGUE_RAYS];
    drogue_inner_edge edge;
    memset(&edge, 0, sizeof edge);
    words[DROGUE_HLS_E_STATUS] = DROGUE_E_ARGUMENT;
    if (f->words[DROGUE_HLS_O_STATUS] == DROGUE_OK) {
        words[DROGUE_HLS_E_STATUS] =
            (int32_t)drogue_inner_edge_find(&edge, rays, &f->view, &expected, &f->outline.ellipse, &f->p.config);
    }
    drogue_hls_pack_edge_words(words, &edge);
}

/* Which try of drogue_measure() stands; -1 when it gives none. */
static inline int32_t frame_tried(const frame *f)
{
    drogue_workspace workspace = f->workspace;
    drogue_result r;
    (void)drogue_measure(&r, &workspace, &(drogue_setup){&f->p.camera, &f->p.model, &f->p.config}, &f->image,
                         &f->asked);
    return r.status == DROGUE_OK ? (int32_t)r.tried : -1;
}

#endif
