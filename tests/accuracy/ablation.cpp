/* SPDX-License-Identifier: Apache-2.0 */
/* Front end once, an outline by each reduced extraction, the pose as the library makes it. */
#include "ablation.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "drogue/ellipse.h"
#include "measure.hpp"
#include "stages.hpp"

namespace accuracy {

namespace {

struct Outline {
    drogue_status status = DROGUE_E_NO_EDGES;
    drogue_ellipse ellipse = {0, 0, 0, 0, 0}; /* region coordinates */
    drogue_support support = {};
};

/* The library's direct fit to points as they are. Blur draws an edge of curvature c inward by c / 2 of its variance,
 * 0.82 px^2 for smoothing and gradient, as measured for the library's own fit: put back. */
Outline fit(const std::vector<drogue_edge> &points, const drogue_mask &mask)
{
    constexpr int fraction = 5; /* of the edge points' coordinates */
    const double half_variance = 0.82;
    const int32_t origin_q5 = 16 * mask.longest_px;
    Outline out;
    drogue_ellipse &e = out.ellipse;
    drogue_moments m;
    if (points.empty()) {
        return out;
    }
    drogue_moments_clear(&m);
    for (const drogue_edge &p : points) {
        drogue_moments_add_point(&m, p.x_q5 - origin_q5, p.y_q5 - origin_q5);
    }
    out.status = drogue_ellipse_fit(&e, &m, fraction);
    if (out.status != DROGUE_OK) {
        return out;
    }
    if (e.b_px_q16 < DROGUE_Q16_ONE || e.a_px_q16 > drogue_q16_from_int(DROGUE_MAX_SIDE)) {
        out.status = DROGUE_E_DEGENERATE; /* a line, or larger than any image */
        return out;
    }
    e.xc_px_q16 += origin_q5 * (1 << (16 - fraction));
    e.yc_px_q16 += origin_q5 * (1 << (16 - fraction));
    out.support = support_of(e, points);
    const double a = from_q16(e.a_px_q16);
    const double b = from_q16(e.b_px_q16);
    e.a_px_q16 = to_q16(a + half_variance * a / (b * b));
    e.b_px_q16 = std::min(e.a_px_q16, to_q16(b + half_variance * b / (a * a)));
    return out;
}

Outline by_arcs(const RegionEdges &edges)
{
    std::vector<drogue_edge> points[2];
    for (const drogue_polarity polarity : {DROGUE_POLARITY_DARK, DROGUE_POLARITY_BRIGHT}) {
        drogue_arc_choices choices;
        if (drogue_select_arcs(&choices, edges.workspace.hull, edges.workspace.edges, edges.workspace.arcs,
                               edges.list.arc_count, &edges.mask, edges.config.min_short_px_q16,
                               polarity) != DROGUE_OK) {
            continue;
        }
        for (const auto &quadrant : choices.arc) {
            if (quadrant[0] != DROGUE_NO_ARC) {
                const std::vector<drogue_edge> arc = edges.points_of(edges.workspace.arcs[quadrant[0]]);
                points[polarity].insert(points[polarity].end(), arc.begin(), arc.end());
            }
        }
    }
    return fit(points[points[1].size() > points[0].size() ? 1 : 0], edges.mask);
}

Outline found(const RegionEdges &edges)
{
    drogue_outline outline;
    Outline out;
    const drogue_image view = {edges.view.data, edges.view.cols, edges.view.rows,
                               static_cast<int32_t>(edges.view.step)};
    out.status = drogue_outline_find(&outline, &edges.workspace, &edges.list, &edges.mask, &edges.config);
    if (out.status == DROGUE_OK) {
        drogue_outline_pull(&outline, edges.workspace.rays, &view, &edges.config);
    }
    out.ellipse = outline.ellipse;
    out.support = outline.support;
    return out;
}

/* Puts the edge points of each quadrant and polarity in the place of the arcs. */
void arcs_by_quadrant(RegionEdges &edges)
{
    std::vector<drogue_edge> all = edges.all_points();
    for (drogue_edge &e : all) {
        e.arc = DROGUE_NO_ARC;
    }
    std::stable_sort(all.begin(), all.end(), [](const drogue_edge &p, const drogue_edge &q) {
        const int32_t py = drogue_edge_y_px(&p);
        const int32_t qy = drogue_edge_y_px(&q);
        return py != qy ? py < qy : drogue_edge_x_px(&p) < drogue_edge_x_px(&q); /* raster order, as in an arc */
    });
    drogue_edge *const out = edges.workspace.edges;
    uint32_t next = 0;
    uint32_t arcs = 0;
    for (int quadrant = 0; quadrant < 4; quadrant++) {
        for (const int turn : {0, 2}) { /* gradient outward, inward */
            const auto direction = static_cast<uint32_t>((quadrant + turn) % 4);
            const uint32_t first = next;
            for (drogue_edge &e : all) {
                const int32_t dx = 2 * drogue_edge_x_px(&e) - edges.mask.centre2_x;
                const int32_t dy = 2 * drogue_edge_y_px(&e) - edges.mask.centre2_y;
                if (e.arc == DROGUE_NO_ARC && drogue_quadrant(dx, dy) == quadrant &&
                    drogue_direction_class(e.gx, e.gy) == direction) {
                    e.arc = arcs;
                    out[next++] = e;
                }
            }
            if (next > first && arcs < edges.workspace.capacity.arcs) {
                edges.workspace.arcs[arcs++] = {first, next - first, direction};
            }
        }
    }
    for (const drogue_edge &e : all) { /* the refit may still want those of other directions */
        if (e.arc == DROGUE_NO_ARC) {
            out[next++] = e;
        }
    }
    edges.list.arc_count = arcs;
}

/* The library's result with another outline. */
drogue_result result_of(const Outline &outline, const RegionEdges &edges, const Camera &camera,
                        const drogue_model &model, const drogue_result &library)
{
    drogue_result r;
    std::memset(&r, 0, sizeof r);
    r.ambiguity_q16 = DROGUE_Q16_ONE;
    r.region = library.region;
    r.has_inner = library.has_inner;
    r.inner = library.inner;
    r.status = edges.status != DROGUE_OK ? edges.status : outline.status;
    if (r.status == DROGUE_OK) {
        put_pose(r, edges, outline.ellipse, outline.support, camera, model);
    }
    return r;
}

} // namespace

std::array<drogue_result, extractions> ablate(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                                              const cv::Rect &region, const drogue_result &library)
{
    RegionEdges edges(image, region);
    const Outline all = fit(edges.all_points(), edges.mask);
    const Outline arcs = by_arcs(edges);
    arcs_by_quadrant(edges); /* last: reorders the points */
    return {result_of(all, edges, camera, model, library), result_of(arcs, edges, camera, model, library),
            result_of(found(edges), edges, camera, model, library), library};
}

drogue_result measure_by_stages(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                                const cv::Rect &region, const drogue_result &library)
{
    const RegionEdges edges(image, region);
    return result_of(found(edges), edges, camera, model, library);
}

} // namespace accuracy
