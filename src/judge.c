/* SPDX-License-Identifier: Apache-2.0 */
/* From an outline to the pose: without the lens distortion, with the inner part where a pose expects it, decided. */
#include "look.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/inner.h"
#include "drogue/undistort.h"

static void describe(drogue_result *out, const drogue_outline *outline)
{
    memcpy(out->arcs, outline->arcs, sizeof out->arcs);
    out->quality = outline->quality;
    out->polarity = outline->polarity;
    out->cluster_members = outline->cluster_members;
    out->refit_points = outline->refit_points;
    out->cover_q16 = outline->cover_q16;
    out->outside = outline->support.outside;
    out->ellipse = outline->ellipse;
    drogue_frame_move(&out->ellipse, out->region.x_px, out->region.y_px);
    out->ideal = out->ellipse;
}

/* Find the inner part where a pose expects it, weigh it, and see which pose it is nearer to. */
static void find_inner(drogue_evidence *evidence, drogue_frame *f)
{
    drogue_result *out = f->out;
    const drogue_ellipse *outline = &f->outline.ellipse;
    drogue_inner_evidence inner;
    drogue_inner_expected expected;
    drogue_inner_edge edge;
    memset(&inner, 0, sizeof inner);
    f->doubt_q16 = DROGUE_Q16_ONE;
    drogue_inner_expect(&expected, evidence->poses, f->setup, out->region.x_px, out->region.y_px);
    if (drogue_inner_edge_find(&edge, f->workspace->rays, &f->view, &expected, outline, f->setup->config) ==
        DROGUE_OK) {
        drogue_inner_weigh(&inner, &edge, &out->region, &expected, outline, evidence->poses, f->setup);
        drogue_inner_testify(evidence, &inner);
        out->inner = inner.part;
        out->has_inner = inner.weighed.std_px_q16 > 0;
        out->ambiguity_q16 = inner.ambiguity_q16;
        f->doubt_q16 = out->has_inner ? inner.doubt_q16 : DROGUE_Q16_ONE;
        if ((out->has_inner || inner.too_large) && edge.grown_px_q16 > 0) {
            f->larger_q16 = drogue_q16_div(edge.grown_px_q16, expected.disc[edge.which].a_px_q16);
        }
    }
}

/* Decide between the poses; the result has what was decided. */
static drogue_status decide(drogue_result *out, const drogue_evidence *evidence, const drogue_setup *setup)
{
    drogue_decision decision;
    drogue_status status = drogue_decide(&decision, evidence, setup);
    if (status == DROGUE_OK) {
        out->pose = decision.pose;
        out->alternative = decision.alternative;
        out->orientation_resolved = decision.orientation_resolved;
        memcpy(out->covariance_q48, decision.covariance_q48, sizeof out->covariance_q48);
        out->covariance_halved = decision.covariance_halved;
        memcpy(out->position_std_m_q32, decision.position_std_m_q32, sizeof out->position_std_m_q32);
        out->axis_std_rad_q32 = decision.axis_std_rad_q32;
        out->doubt_q16 = decision.doubt_q16;
    }
    return status;
}

drogue_status drogue_frame_judge(drogue_frame *f)
{
    drogue_result *out = f->out;
    drogue_evidence evidence;
    drogue_status status;
    drogue_outline_pull(&f->outline, f->workspace->rays, &f->view, f->setup->config);
    describe(out, &f->outline);
    if (drogue_camera_distorts(f->setup->camera)) {
        status = drogue_outline_undistorted(&out->ideal, &f->outline, f->workspace, &f->list, f->setup,
                                            out->region.x_px, out->region.y_px);
        if (status != DROGUE_OK) {
            memset(&out->ideal, 0, sizeof out->ideal);
            return DROGUE_E_NO_ELLIPSE;
        }
    }
    memset(&evidence, 0, sizeof evidence);
    evidence.ideal = out->ideal;
    evidence.support = &f->outline.support;
    status = drogue_pose_from_ellipse(evidence.poses, &out->ideal, f->setup->camera, f->setup->model->rim_radius_m_q16);
    if (status != DROGUE_OK) {
        return status;
    }
    f->doubt_q16 = 0;
    if (f->setup->model->inner_radius_m_q16 > 0) {
        find_inner(&evidence, f);
    }
    status = decide(out, &evidence, f->setup);
    if (status == DROGUE_OK && out->has_inner && out->doubt_q16 > drogue_doubt_outside(f->doubt_q16, out->outside)) {
        f->doubt_q16 += DROGUE_CONTRADICTION_Q16; /* or the outline is too far: another one may be right */
    }
    return status;
}
