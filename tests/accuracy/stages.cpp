/* SPDX-License-Identifier: Apache-2.0 */
/* The library's stages called one by one. */
#include "stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <utility>

#include "drogue/joint.h"
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
        const uint32_t bin = drogue_support_bin_of(u_q24, v_q24);
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

namespace {

/* The inner part as the library weighs it, for the disc of the two expected that is nearer. */
drogue_joint_inner weigh_inner(const drogue_result &r, const RegionEdges &edges, const drogue_ellipse &rim,
                               const drogue_pose poses[2], const drogue_camera &camera, const drogue_model &model)
{
    const drogue_config &config = edges.config;
    drogue_joint_inner inner = {r.inner.x_px_q16, r.inner.y_px_q16, 0};
    drogue_ellipse disc = {0, 0, 0, 0, 0};
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 2 && r.has_inner; i++) {
        drogue_ellipse e;
        if (drogue_inner_disc_image(&e, &poses[i], &camera, &model) == DROGUE_OK && e.a_px_q16 >= DROGUE_Q16_ONE) {
            const double miss = std::hypot(from_q16(e.xc_px_q16) - from_q16(r.inner.x_px_q16),
                                           from_q16(e.yc_px_q16) - from_q16(r.inner.y_px_q16));
            disc = miss < nearest ? e : disc;
            nearest = std::min(nearest, miss);
        }
    }
    if (!(nearest <= from_q16(config.inner_gate_q16) * from_q16(rim.a_px_q16))) {
        return inner;
    }
    const drogue_q16 fill = drogue_dark_fill(&r.inner, &disc);
    drogue_ellipse_frame frame;
    int32_t u_q24;
    int32_t v_q24;
    if (fill < config.min_fill_q16 || fill > config.max_fill_q16 ||
        drogue_ellipse_frame_of(&frame, &rim) != DROGUE_OK) {
        return inner;
    }
    drogue_ellipse_frame_point(&u_q24, &v_q24, &frame, r.inner.x_px_q16 - drogue_q16_from_int(edges.origin_px.x),
                               r.inner.y_px_q16 - drogue_q16_from_int(edges.origin_px.y));
    const double room = 1 - from_q16(disc.a_px_q16) / from_q16(rim.b_px_q16);
    if (room > 0 && std::hypot(std::ldexp(u_q24, -24), std::ldexp(v_q24, -24)) <= room) {
        const int64_t share = drogue_q16_mul(config.inner_std_share_q16, disc.a_px_q16);
        const int64_t least = config.inner_std_px_q16;
        const int64_t spread = drogue_q16_mul(r.inner.spread_px_q16, config.inner_std_spread_q16);
        inner.std_px_q16 =
            drogue_sat_s32((int64_t)drogue_isqrt_u64((uint64_t)(share * share + least * least + spread * spread)));
    }
    return inner;
}

/* Do two solutions differ by less than their standard deviations? */
bool same_solution(const drogue_joint &p, const drogue_joint &q)
{
    const double yaw = from_q16(p.pose.yaw_rad_q16 - q.pose.yaw_rad_q16);
    const double pitch = from_q16(p.pose.pitch_rad_q16 - q.pose.pitch_rad_q16);
    const auto variance = [&](int k) {
        return std::ldexp(drogue_wide_to_s64(p.covariance[DROGUE_PACKED(k, k)], 48), -48);
    };
    return yaw * yaw <= variance(3) && pitch * pitch <= variance(4);
}

double chi2_of(const drogue_joint &j) { return std::ldexp(drogue_wide_to_s64(j.chi2, 32), -32); }

/* Solutions from both poses, the better one first. */
drogue_status solve_both(std::array<drogue_joint, 2> &joint, const drogue_pose poses[2],
                         const drogue_joint_outline &outline, const drogue_joint_inner &inner,
                         const drogue_camera &camera, const drogue_model &model)
{
    for (size_t i = 0; i < 2; i++) {
        const drogue_status status = drogue_joint_solve(&joint[i], &poses[i], &outline, &inner, &camera, &model);
        if (status != DROGUE_OK) {
            return status;
        }
    }
    if (drogue_wide_cmp(joint[1].chi2, joint[0].chi2) < 0) {
        std::swap(joint[0], joint[1]);
    }
    return DROGUE_OK;
}

} // namespace

void put_pose(drogue_result &result, const RegionEdges &edges, const drogue_ellipse &ellipse,
              const drogue_support &support, const Camera &camera, const drogue_model &model)
{
    CV_Assert(!camera.distorts());
    const drogue_camera q_camera = {
        to_q16(camera.fx_px), to_q16(camera.fy_px), to_q16(camera.cx_px), to_q16(camera.cy_px), 0, 0, 0, 0, 0};
    drogue_joint_outline outline;
    std::array<drogue_joint, 2> joint;
    drogue_pose poses[2];
    result.ellipse = ellipse;
    result.ellipse.xc_px_q16 = drogue_q16_add(ellipse.xc_px_q16, drogue_q16_from_int(edges.origin_px.x));
    result.ellipse.yc_px_q16 = drogue_q16_add(ellipse.yc_px_q16, drogue_q16_from_int(edges.origin_px.y));
    result.ideal = outline.ellipse = result.ellipse;
    result.orientation_resolved = 0;
    result.status = drogue_pose_from_ellipse(poses, &result.ideal, &q_camera, model.rim_radius_m_q16);
    if (result.status != DROGUE_OK) {
        return;
    }
    const drogue_joint_inner inner = weigh_inner(result, edges, ellipse, poses, q_camera, model);
    const drogue_joint_inner none = {0, 0, 0};
    bool trusted = inner.std_px_q16 > 0;
    result.status = drogue_joint_outline_covariance(&outline, &support, edges.config.outline_shading_q16,
                                                    edges.config.optics_blur_std_px2_q16);
    if (result.status == DROGUE_OK && trusted) {
        result.status = solve_both(joint, poses, outline, inner, q_camera, model);
        trusted = result.status == DROGUE_OK && chi2_of(joint[0]) <= from_q16(edges.config.max_chi2_q16);
    }
    if (result.status == DROGUE_OK && !trusted) { /* they contradict each other: the outline alone */
        result.status = solve_both(joint, poses, outline, none, q_camera, model);
    }
    if (result.status != DROGUE_OK) {
        return;
    }
    result.orientation_resolved =
        trusted && (same_solution(joint[0], joint[1]) ||
                    chi2_of(joint[1]) - chi2_of(joint[0]) >= from_q16(edges.config.min_chi2_gap_q16));
    result.pose = joint[0].pose;
    result.alternative = joint[1].pose;
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 5; j++) {
            result.covariance_q48[i][j] = drogue_wide_to_s64(joint[0].covariance[DROGUE_PACKED(i, j)], 48);
        }
    }
}

} // namespace accuracy
