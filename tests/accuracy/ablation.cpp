/* SPDX-License-Identifier: Apache-2.0 */
/* Front end once, then an ellipse by each reduced extraction, then the pose as the library makes it. */
#include "ablation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "drogue/ellipse.h"
#include "measure.hpp"

namespace accuracy {

namespace {

/* Edge points of a region, from the library's front end with the library's thresholds. */
class Edges {
public:
    Edges(const cv::Mat &image, const cv::Rect &region);

    drogue_status status() const { return status_; }
    const cv::Point &origin_px() const { return origin_px_; }
    drogue_status fit_all(drogue_ellipse &out) const;
    drogue_status fit_farthest_arcs(drogue_ellipse &out) const;
    drogue_status fit_quadrants(drogue_ellipse &out); /* reorders the points: last */

private:
    drogue_status fit(drogue_ellipse &out, const std::vector<drogue_edge> &points) const;
    std::vector<drogue_edge> points_of(const drogue_arc &arc) const;

    std::vector<uint32_t> memory_;
    drogue_workspace workspace_;
    drogue_config config_;
    drogue_edge_list list_ = {0, 0};
    drogue_mask mask_;
    cv::Point origin_px_;
    drogue_status status_;
};

Edges::Edges(const cv::Mat &image, const cv::Rect &region)
{
    const cv::Rect seen = region & cv::Rect({0, 0}, image.size());
    const auto side = static_cast<uint32_t>(std::max(region.width, region.height));
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(side);
    drogue_frontend frontend;
    drogue_frontend_config front;
    memory_.resize(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
    if (drogue_workspace_init(&workspace_, memory_.data(), memory_.size() * sizeof(uint32_t), &capacity) != DROGUE_OK) {
        throw std::runtime_error("workspace refused");
    }
    drogue_config_default(&config_);
    origin_px_ = seen.tl();
    mask_ = drogue_mask_of_size(region.width, region.height);
    mask_.centre2_x += 2 * (region.x - seen.x);
    mask_.centre2_y += 2 * (region.y - seen.y);
    front.canny_low = config_.canny_low;
    front.canny_high = config_.canny_high;
    front.smooth = config_.smooth;
    front.use_ring = 1;
    front.ring = mask_;
    front.min_arc_px = std::max(
        config_.min_arc_px, static_cast<uint32_t>(std::lround(from_q16(config_.min_arc_share_q16) * mask_.longest_px)));
    status_ = drogue_frontend_begin(&frontend, &workspace_, &front, seen.width, seen.height);
    if (status_ == DROGUE_OK) {
        for (int y = 0; y < seen.height; y++) {
            drogue_frontend_row(&frontend, image.ptr<uint8_t>(seen.y + y) + seen.x);
        }
        status_ = drogue_frontend_end(&list_, &frontend);
    }
}

/* The library's direct fit, in region coordinates. Blur draws an edge of curvature c inward by c / 2 of its variance,
 * 0.82 px^2 for smoothing and gradient, as measured for the library's own fit. */
drogue_status Edges::fit(drogue_ellipse &out, const std::vector<drogue_edge> &points) const
{
    constexpr int fraction = 5; /* of the edge points' coordinates */
    const int32_t origin_q5 = 16 * mask_.longest_px;
    const double half_variance = 0.82;
    drogue_moments m;
    drogue_moments_clear(&m);
    for (const drogue_edge &e : points) {
        drogue_moments_add_point(&m, e.x_q5 - origin_q5, e.y_q5 - origin_q5);
    }
    const drogue_status status = drogue_ellipse_fit(&out, &m, fraction);
    if (status != DROGUE_OK) {
        return status;
    }
    if (out.b_px_q16 < DROGUE_Q16_ONE || out.a_px_q16 > drogue_q16_from_int(DROGUE_MAX_SIDE)) {
        return DROGUE_E_DEGENERATE; /* a line, or larger than any image */
    }
    const double a = from_q16(out.a_px_q16);
    const double b = from_q16(out.b_px_q16);
    out.a_px_q16 = to_q16(a + half_variance * a / (b * b));
    out.b_px_q16 = std::min(out.a_px_q16, to_q16(b + half_variance * b / (a * a)));
    out.xc_px_q16 += origin_q5 * (1 << (16 - fraction));
    out.yc_px_q16 += origin_q5 * (1 << (16 - fraction));
    return DROGUE_OK;
}

std::vector<drogue_edge> Edges::points_of(const drogue_arc &arc) const
{
    return {workspace_.edges + arc.first, workspace_.edges + arc.first + arc.count};
}

drogue_status Edges::fit_all(drogue_ellipse &out) const
{
    if (list_.edge_count == 0) {
        return DROGUE_E_NO_EDGES;
    }
    return fit(out, {workspace_.edges, workspace_.edges + list_.edge_count});
}

drogue_status Edges::fit_farthest_arcs(drogue_ellipse &out) const
{
    drogue_farthest farthest;
    std::array<std::vector<drogue_edge>, 2> points;
    const drogue_status status = drogue_select_farthest(&farthest, workspace_.hull, workspace_.edges, workspace_.arcs,
                                                        list_.arc_count, &mask_, config_.min_short_px_q16);
    if (status != DROGUE_OK) {
        return status;
    }
    for (size_t polarity = 0; polarity < 2; polarity++) {
        for (const uint32_t index : farthest.arc[polarity]) {
            if (index != DROGUE_NO_ARC) {
                const std::vector<drogue_edge> arc = points_of(workspace_.arcs[index]);
                points[polarity].insert(points[polarity].end(), arc.begin(), arc.end());
            }
        }
    }
    return fit(out, points[points[1].size() > points[0].size() ? 1 : 0]);
}

drogue_status Edges::fit_quadrants(drogue_ellipse &out)
{
    std::vector<drogue_edge> all(workspace_.edges, workspace_.edges + list_.edge_count);
    constexpr uint32_t undecided = DROGUE_NO_ARC;
    for (drogue_edge &e : all) {
        e.arc = undecided;
    }
    std::stable_sort(all.begin(), all.end(), [](const drogue_edge &p, const drogue_edge &q) {
        const int32_t py = drogue_edge_y_px(&p);
        const int32_t qy = drogue_edge_y_px(&q);
        return py != qy ? py < qy : drogue_edge_x_px(&p) < drogue_edge_x_px(&q); /* raster order, as in an arc */
    });
    uint32_t next = 0;
    list_.arc_count = 0;
    for (int quadrant = 0; quadrant < 4; quadrant++) {
        for (const int turn : {0, 2}) { /* gradient outward, inward */
            const auto direction = static_cast<uint32_t>((quadrant + turn) % 4);
            const uint32_t first = next;
            for (drogue_edge &e : all) {
                const int32_t dx = 2 * drogue_edge_x_px(&e) - mask_.centre2_x;
                const int32_t dy = 2 * drogue_edge_y_px(&e) - mask_.centre2_y;
                if (e.arc == undecided && drogue_quadrant(dx, dy) == quadrant &&
                    drogue_direction_class(e.gx, e.gy) == direction) {
                    e.arc = list_.arc_count;
                    workspace_.edges[next++] = e;
                }
            }
            if (next > first && list_.arc_count < workspace_.capacity.arcs) {
                workspace_.arcs[list_.arc_count] = {first, next - first, direction};
                list_.arc_count++;
            }
        }
    }
    for (const drogue_edge &e : all) { /* the refit may still want those of other directions */
        if (e.arc == undecided) {
            workspace_.edges[next++] = e;
        }
    }
    drogue_outline outline;
    const drogue_status status = drogue_outline_find(&outline, &workspace_, &list_, &mask_, &config_);
    out = outline.ellipse;
    return status;
}

/* Pose and choice as in the library. */
void add_pose(drogue_result &r, const drogue_ellipse &region_ellipse, const cv::Point &origin_px, const Camera &camera,
              const drogue_model &model)
{
    const drogue_camera q_camera = {
        to_q16(camera.fx_px), to_q16(camera.fy_px), to_q16(camera.cx_px), to_q16(camera.cy_px), 0, 0, 0, 0, 0};
    drogue_pose poses[2];
    drogue_choice choice;
    drogue_config config;
    drogue_config_default(&config);
    std::memset(&choice, 0, sizeof choice);
    choice.ambiguity_q16 = DROGUE_Q16_ONE;
    r.ellipse = region_ellipse;
    r.ellipse.xc_px_q16 = drogue_q16_add(r.ellipse.xc_px_q16, drogue_q16_from_int(origin_px.x));
    r.ellipse.yc_px_q16 = drogue_q16_add(r.ellipse.yc_px_q16, drogue_q16_from_int(origin_px.y));
    r.ideal = r.ellipse;
    r.status = drogue_pose_from_ellipse(poses, &r.ideal, &q_camera, model.rim_radius_m_q16);
    if (r.status == DROGUE_OK && r.has_inner) {
        r.status =
            drogue_choose_pose(&choice, poses, r.inner.x_px_q16, r.inner.y_px_q16, model.inner_depth_m_q16, &q_camera);
        r.orientation_resolved =
            choice.distance_px_q16[choice.index] <= drogue_q16_mul(config.inner_gate_q16, r.ideal.a_px_q16) &&
            choice.ambiguity_q16 <= config.max_ambiguity_q16;
    }
    r.ambiguity_q16 = choice.ambiguity_q16;
    r.pose = poses[choice.index];
    r.alternative = poses[1 - choice.index];
}

} // namespace

std::array<drogue_result, extractions> ablate(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                                              const cv::Rect &region, const drogue_result &library)
{
    CV_Assert(!camera.distorts());
    Edges edges(image, region);
    std::array<drogue_result, extractions> results;
    for (size_t i = 0; i < extractions; i++) {
        const auto extraction = static_cast<Extraction>(i);
        drogue_result &r = results[i];
        drogue_ellipse ellipse = {0, 0, 0, 0, 0};
        r = library;
        if (extraction == Extraction::both) {
            continue;
        }
        r.orientation_resolved = 0;
        std::memset(&r.pose, 0, sizeof r.pose);
        std::memset(&r.alternative, 0, sizeof r.alternative);
        r.status = edges.status();
        if (r.status == DROGUE_OK) {
            r.status = extraction == Extraction::nothing ? edges.fit_all(ellipse)
                       : extraction == Extraction::arcs  ? edges.fit_farthest_arcs(ellipse)
                                                         : edges.fit_quadrants(ellipse);
        }
        if (r.status == DROGUE_OK) {
            add_pose(r, ellipse, edges.origin_px(), camera, model);
        }
    }
    return results;
}

} // namespace accuracy
