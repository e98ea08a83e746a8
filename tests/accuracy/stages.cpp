/* SPDX-License-Identifier: Apache-2.0 */
/* The library's stages called one by one. */
#include "stages.hpp"

#include "../band_points.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "drogue/decide.h"
#include "drogue/inner.h"
#include "measure.hpp"

namespace accuracy {

RegionEdges::RegionEdges(const cv::Mat &image, const cv::Rect &region)
{
    const cv::Rect seen = region & cv::Rect({0, 0}, image.size());
    const auto side = static_cast<uint32_t>(std::max(region.width, region.height));
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(side);
    drogue_frontend frontend;
    drogue_frontend_config front;
    memory_.resize(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
    if (drogue_workspace_init(&workspace, memory_.data(), memory_.size() * sizeof(uint32_t), &capacity) != DROGUE_OK) {
        throw std::runtime_error("workspace refused");
    }
    drogue_config_default(&config);
    view = image(seen).clone();
    origin_px = seen.tl();
    mask = drogue_mask_of_size(region.width, region.height);
    mask.centre2_x += 2 * (region.x - seen.x);
    mask.centre2_y += 2 * (region.y - seen.y);
    front.canny_low = config.canny_low;
    front.canny_high = config.canny_high;
    front.smooth = config.smooth;
    front.use_ring = 1;
    front.ring = mask;
    front.min_arc_px =
        static_cast<uint32_t>(drogue_shr_round_s64((int64_t)config.min_arc_share_q16 * mask.longest_px, 16));
    front.min_arc_px = std::max(front.min_arc_px, config.min_arc_px);
    status = drogue_frontend_begin(&frontend, &workspace, &front, seen.width, seen.height);
    if (status == DROGUE_OK) {
        for (int y = 0; y < seen.height; y++) {
            drogue_frontend_row(&frontend, image.ptr<uint8_t>(seen.y + y) + seen.x);
        }
        status = drogue_frontend_end(&list, &frontend);
    }
}

std::vector<drogue_edge> RegionEdges::points_of(const drogue_arc &arc) const
{
    return {workspace.edges + arc.first, workspace.edges + arc.first + arc.count};
}

std::vector<drogue_edge> RegionEdges::all_points() const
{
    return {workspace.edges, workspace.edges + list.edge_count};
}

drogue_support support_of(const drogue_ellipse &ellipse, const std::vector<drogue_edge> &points)
{
    drogue_support support;
    drogue_ellipse_frame frame;
    std::array<int64_t, DROGUE_SUPPORT_BINS> sums = {};
    std::memset(&support, 0, sizeof support);
    if (drogue_ellipse_frame_of(&frame, &ellipse) != DROGUE_OK) {
        return support;
    }
    for (const drogue_edge &e : points) {
        int32_t u_q24;
        int32_t v_q24;
        drogue_ellipse_frame_point(&u_q24, &v_q24, &frame, drogue_edge_x_q16(&e), drogue_edge_y_q16(&e));
        const double offset = (std::pow(std::ldexp(u_q24, -24), 2) + std::pow(std::ldexp(v_q24, -24), 2) - 1) / 2;
        const double unit = 16384 / std::max(1.0, std::hypot(u_q24, v_q24));
        const uint32_t bin =
            bin_of(static_cast<int32_t>(std::lround(u_q24 * unit)), static_cast<int32_t>(std::lround(v_q24 * unit)));
        const auto offset_q16 = static_cast<int64_t>(std::lround(offset * 65536));
        support.bin[bin].count[0]++;
        sums[bin] += offset_q16;
        support.squares_q32 += offset_q16 * offset_q16;
        support.points++;
        support.gradient += static_cast<uint64_t>(std::abs(e.gx) + std::abs(e.gy));
    }
    for (size_t k = 0; k < sums.size(); k++) {
        support.bin[k].sum_q16 = drogue_sat_s32(sums[k]);
    }
    return support;
}

void put_pose(drogue_result &result, const RegionEdges &edges, const drogue_ellipse &ellipse,
              const drogue_support &support, const Camera &camera, const drogue_model &model)
{
    CV_Assert(!camera.distorts());
    const drogue_camera q_camera = {
        to_q16(camera.fx_px), to_q16(camera.fy_px), to_q16(camera.cx_px), to_q16(camera.cy_px), 0, 0, 0, 0, 0};
    drogue_joint_inner inner = {result.inner.x_px_q16, result.inner.y_px_q16, 0};
    drogue_choice choice = {};
    drogue_inner_expected expected;
    drogue_evidence evidence = {};
    const drogue_setup setup = {&q_camera, &model, &edges.config};
    result.ellipse = ellipse;
    result.ellipse.xc_px_q16 = drogue_q16_add(ellipse.xc_px_q16, drogue_q16_from_int(edges.origin_px.x));
    result.ellipse.yc_px_q16 = drogue_q16_add(ellipse.yc_px_q16, drogue_q16_from_int(edges.origin_px.y));
    result.ideal = result.ellipse;
    result.status = drogue_pose_from_ellipse(evidence.poses, &result.ideal, &q_camera, model.rim_radius_m_q16);
    if (result.status != DROGUE_OK) {
        return;
    }
    drogue_inner_expect(&expected, evidence.poses, &setup, edges.origin_px.x, edges.origin_px.y);
    if (expected.count > 0 && result.has_inner != 0) { /* its place stands, the standard deviation is the edge's */
        const drogue_image view = {edges.view.data, edges.view.cols, edges.view.rows,
                                   static_cast<int32_t>(edges.view.step)};
        drogue_ray rays[DROGUE_RAYS];
        drogue_inner_edge edge;
        if (drogue_inner_edge_find(&edge, rays, &view, &expected, &ellipse, &edges.config) == DROGUE_OK) {
            const drogue_region region = {edges.origin_px.x, edges.origin_px.y, view.width_px, view.height_px};
            drogue_inner_evidence weighed;
            drogue_inner_weigh(&weighed, &edge, &region, &expected, &ellipse, evidence.poses, &setup);
            inner.std_px_q16 = weighed.weighed.std_px_q16;
            evidence.doubt_q16 = weighed.doubt_q16;
            evidence.too_far_q16 = weighed.too_far_q16;
        }
    }
    if (result.has_inner != 0) {
        result.status = drogue_choose_pose(&choice, evidence.poses, inner.x_px_q16, inner.y_px_q16,
                                           model.inner_depth_m_q16, &q_camera);
    }
    if (result.status == DROGUE_OK) {
        drogue_decision decision;
        evidence.nearer = choice.index;
        evidence.ideal = result.ideal;
        evidence.support = &support;
        evidence.inner = inner;
        result.status = drogue_decide(&decision, &evidence, &setup);
        result.pose = decision.pose;
        result.alternative = decision.alternative;
        result.orientation_resolved = decision.orientation_resolved;
        std::memcpy(result.covariance_q48, decision.covariance_q48, sizeof result.covariance_q48);
        result.covariance_halved = decision.covariance_halved;
        std::memcpy(result.position_std_m_q32, decision.position_std_m_q32, sizeof result.position_std_m_q32);
        result.axis_std_rad_q32 = decision.axis_std_rad_q32;
    }
}

} // namespace accuracy
