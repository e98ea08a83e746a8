/* SPDX-License-Identifier: Apache-2.0 */
/* Top: edge points, arcs and the region's pixels in; outline, both poses and where to look for the inner part out. The same calls as
 * drogue_measure() makes. */
#include "../words.h"

#include <string.h>

#include "drogue/inner.h"
#include "drogue/undistort.h"

/* A frame on its way. */
typedef struct frame {
    drogue_outline outline;
    drogue_ellipse ideal;
    drogue_pose poses[2];
    drogue_inner_expected expected;
} frame;

static int valid(const drogue_hls_parameters *p)
{
    return drogue_camera_valid(&p->camera) && drogue_model_valid(&p->model) && drogue_config_valid(&p->config) &&
           drogue_mask_valid(&p->mask);
}

/* The lists into the workspace; 0 when they cannot be a front end's. */
static inline int read_lists(drogue_edge edges[DROGUE_HLS_EDGES], drogue_arc arcs[DROGUE_HLS_ARCS],
                             const uint64_t edge_words[DROGUE_HLS_EDGES], const uint64_t arc_words[DROGUE_HLS_ARCS],
                             const drogue_edge_list *list)
{
    const uint32_t edge_count = list->edge_count;
    const uint32_t arc_count = list->arc_count;
    uint32_t wrong = 0;
    uint32_t i;
    if (edge_count > (uint32_t)DROGUE_HLS_EDGES || arc_count > (uint32_t)DROGUE_HLS_ARCS) {
        return 0;
    }
    for (i = 0; i < edge_count; i++) {
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
#endif
        edges[i] = drogue_hls_unpack_edge(edge_words[i]);
    }
    for (i = 0; i < arc_count; i++) {
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#pragma HLS loop_tripcount max = DROGUE_HLS_ARCS
#endif
        arcs[i] = drogue_hls_unpack_arc(arc_words[i]);
        wrong |= (uint32_t)(arcs[i].count < 1 || arcs[i].first + arcs[i].count > edge_count);
    }
    return !wrong;
}

static drogue_status find(frame *f, const drogue_workspace *workspace, const drogue_edge_list *list,
                          const drogue_image *view, const drogue_hls_parameters *p)
{
    const drogue_setup setup = {&p->camera, &p->model, &p->config};
    drogue_status status;
    drogue_outline_pull(&f->outline, workspace->rays, view, &p->config);
    f->ideal = f->outline.ellipse;
    f->ideal.xc_px_q16 = drogue_q16_add(f->ideal.xc_px_q16, drogue_q16_from_int(p->x_px));
    f->ideal.yc_px_q16 = drogue_q16_add(f->ideal.yc_px_q16, drogue_q16_from_int(p->y_px));
    if (drogue_camera_distorts(&p->camera) &&
        drogue_outline_undistorted(&f->ideal, &f->outline, workspace, list, &setup, p->x_px, p->y_px) != DROGUE_OK) {
        memset(&f->ideal, 0, sizeof f->ideal);
        return DROGUE_E_NO_ELLIPSE;
    }
    status = drogue_pose_from_ellipse(f->poses, &f->ideal, &p->camera, p->model.rim_radius_m_q16);
    if (status == DROGUE_OK && p->model.inner_radius_m_q16 > 0) {
        drogue_inner_expect(&f->expected, f->poses, &setup, p->x_px, p->y_px);
    }
    return status;
}

static inline void put_support(int32_t words[DROGUE_HLS_OUTLINE_WORDS], const drogue_support *support)
{
    int k;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        words[DROGUE_HLS_O_BINS + 3 * k] = (int32_t)support->bin[k].count[0];
        words[DROGUE_HLS_O_BINS + 3 * k + 1] = (int32_t)support->bin[k].count[1];
        words[DROGUE_HLS_O_BINS + 3 * k + 2] = support->bin[k].sum_q16;
    }
    drogue_hls_pack_u64(words + DROGUE_HLS_O_SQUARES, (uint64_t)support->squares_q32);
    drogue_hls_pack_u64(words + DROGUE_HLS_O_GRADIENT, support->gradient);
    words[DROGUE_HLS_O_POINTS] = (int32_t)support->points;
    words[DROGUE_HLS_O_BRIGHT_BINS] = (int32_t)support->bright_bins;
    words[DROGUE_HLS_O_COVERED] = (int32_t)support->covered;
    words[DROGUE_HLS_O_AXIS] = support->axis_rad_q16;
    words[DROGUE_HLS_O_OUTSIDE] = (int32_t)support->outside;
    for (k = 0; k < 5; k++) {
        words[DROGUE_HLS_O_PULL + k] = support->pull_q24[k];
    }
    for (k = 0; k < 2; k++) {
        words[DROGUE_HLS_O_SMEAR + k] = support->smear_px2_q16[k];
    }
}

static inline void put(int32_t words[DROGUE_HLS_OUTLINE_WORDS], const frame *f)
{
    const drogue_outline *o = &f->outline;
    int k;
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_ELLIPSE, &o->ellipse);
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_FITTED, &o->fitted);
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_IDEAL, &f->ideal);
    words[DROGUE_HLS_O_QUALITY] = o->quality.fit_ratio_q16;
    words[DROGUE_HLS_O_QUALITY + 1] = o->quality.length_ratio_q16;
    words[DROGUE_HLS_O_QUALITY + 2] = o->quality.axis_ratio_q16;
    words[DROGUE_HLS_O_QUALITY + 3] = o->quality.score_q16;
    words[DROGUE_HLS_O_QUALITY + 4] = o->quality.reliability_q16;
    words[DROGUE_HLS_O_POLARITY] = (int32_t)o->polarity;
    for (k = 0; k < 4; k++) {
        words[DROGUE_HLS_O_ARCS + k] = o->arcs[k] == DROGUE_NO_ARC ? -1 : (int32_t)o->arcs[k];
    }
    words[DROGUE_HLS_O_CLUSTER_MEMBERS] = (int32_t)o->cluster_members;
    words[DROGUE_HLS_O_REFIT_POINTS] = (int32_t)o->refit_points;
    words[DROGUE_HLS_O_COVER] = o->cover_q16;
    words[DROGUE_HLS_O_BAND] = o->band_px_q16;
    drogue_hls_pack_pose(words + DROGUE_HLS_O_POSES, &f->poses[0]);
    drogue_hls_pack_pose(words + DROGUE_HLS_O_POSES + 8, &f->poses[1]);
    words[DROGUE_HLS_O_EXPECTED_COUNT] = (int32_t)f->expected.count;
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_EXPECTED, &f->expected.disc[0]);
    drogue_hls_pack_ellipse(words + DROGUE_HLS_O_EXPECTED + 5, &f->expected.disc[1]);
    put_support(words, &o->support);
}

void drogue_hls_outline(const uint64_t edges[DROGUE_HLS_EDGES], uint32_t edge_count,
                        const uint64_t arcs[DROGUE_HLS_ARCS], uint32_t arc_count, uint32_t frontend_status,
                        const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], int32_t width_px, int32_t height_px,
                        const int32_t parameters[DROGUE_HLS_PARAMETERS], int32_t outline[DROGUE_HLS_OUTLINE_WORDS])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = parameters
#pragma HLS interface mode = s_axilite port = outline
#pragma HLS interface mode = s_axilite port = return
#endif
    static drogue_edge edge_memory[DROGUE_HLS_EDGES];
    static drogue_arc arc_memory[DROGUE_HLS_ARCS];
    static drogue_point hull[DROGUE_HULL_MAX];
    static drogue_outline_room room;
    static drogue_ray rays[DROGUE_RAYS];
    static uint8_t pixel_memory[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT];
    drogue_workspace workspace;
    drogue_image view;
    drogue_hls_parameters p;
    drogue_edge_list list;
    frame f;
    drogue_status status = (drogue_status)(frontend_status & DROGUE_HLS_STATUS);
    drogue_status found;
    int k;
    memset(&f, 0, sizeof f);
    memset(&workspace, 0, sizeof workspace);
    for (k = 0; k < 4; k++) {
        f.outline.arcs[k] = DROGUE_NO_ARC;
    }
    list.edge_count = edge_count;
    list.arc_count = arc_count;
    drogue_hls_unpack_parameters(&p, parameters);
    if (status == DROGUE_OK &&
        !(valid(&p) && drogue_hls_take_pixels(&view, pixel_memory, pixels, width_px, height_px) &&
          read_lists(edge_memory, arc_memory, edges, arcs, &list))) {
        status = DROGUE_E_ARGUMENT;
    }
    found = status;
    if (status == DROGUE_OK) {
        workspace.edges = edge_memory;
        workspace.arcs = arc_memory;
        workspace.hull = hull;
        workspace.outline = &room;
        workspace.rays = rays;
        status = found = drogue_outline_find(&f.outline, &workspace, &list, &p.mask, &p.config);
    }
    if (status == DROGUE_OK && p.larger && !drogue_outline_enlarge(&f.outline, &workspace, &list, &p.mask, &p.config)) {
        status = DROGUE_E_NO_ELLIPSE;
    }
    if (status == DROGUE_OK) {
        status = find(&f, &workspace, &list, &view, &p);
    }
    outline[DROGUE_HLS_O_STATUS] = (int32_t)((frontend_status & ~DROGUE_HLS_STATUS) | (uint32_t)status);
    outline[DROGUE_HLS_O_FOUND] = (int32_t)found;
    put(outline, &f);
}
