/* SPDX-License-Identifier: Apache-2.0 */
/* Smallest rectangles of arcs: against every hull edge, and the short side against cv::minAreaRect. */
#include <opencv2/imgproc.hpp>

#include "golden.hpp"
#include "own_workspace.h"
#include "reference.hpp"

#include "drogue/constraints.h"

namespace {

struct Result {
    double against_reference;
    double against_opencv; /* of the short side */
    bool comparable;       /* false: another hull edge gives the same area to float's precision, and OpenCV took that */
    bool verdict;          /* straightness judged alike */
};

double rect_difference(const drogue_min_rect &got, const reference::Rect &r)
{
    return std::max(std::max(lsb_from(got.xc_px_q16, r.xc), lsb_from(got.yc_px_q16, r.yc)),
                    std::max(lsb_from(got.short_px_q16, r.shorter), lsb_from(got.long_px_q16, r.longer)));
}

Result compare(const drogue_edge *edges, std::uint32_t count, double threshold)
{
    drogue_point hull[DROGUE_HULL_MAX];
    drogue_min_rect rect;
    std::vector<cv::Point> points;
    if (drogue_min_area_rect(&rect, hull, edges, count) != DROGUE_OK) {
        return {INFINITY, INFINITY, true, false};
    }
    for (std::uint32_t i = 0; i < count; i++) {
        points.emplace_back(drogue_edge_x_px(&edges[i]), drogue_edge_y_px(&edges[i]));
    }
    const cv::RotatedRect r = cv::minAreaRect(points);
    const double shorter = std::min(r.size.width, r.size.height), area = (double)r.size.width * r.size.height;
    const double own = real_of_q16(rect.short_px_q16), own_area = own * real_of_q16(rect.long_px_q16);
    const double off = std::fabs(own - shorter) * 65536;
    const bool other = off > 4 && std::fabs(area - own_area) <= 1e-5 * (1 + own_area);
    const bool near = std::fabs(shorter - threshold) < 1e-4;
    return {rect_difference(rect, reference::min_area_rect(points)), off, !other,
            near || other || (own >= threshold) == (shorter >= threshold)};
}

} // namespace

int main()
{
    Report exact("rectangle", 1), opencv("rectangle_opencv", 4), verdicts("straightness_verdict", 0);
    for (int seed = 1; seed <= RANDOM_IMAGES; seed++) {
        const NamedImage image = random_image(seed);
        test_workspace t = test_workspace_ample(image.pixels.cols, image.pixels.rows);
        drogue_frontend_config config = {};
        drogue_edge_list list;
        config.canny_low = 40;
        config.canny_high = 100;
        config.smooth = 1;
        config.min_arc_px = 3;
        if (frontend_run(&list, &t.workspace, &config, image.pixels.data, image.pixels.cols, image.pixels.rows) ==
            DROGUE_OK) {
            for (std::uint32_t i = 0; i < list.arc_count && i < 60; i++) {
                const drogue_arc *a = &t.workspace.arcs[i];
                const std::string name = image.name + " arc " + std::to_string(i);
                const Result r = compare(t.workspace.edges + a->first, a->count, 1.5);
                exact.add(r.against_reference, name);
                if (r.comparable) {
                    opencv.add(r.against_opencv, name);
                }
                verdicts.add(r.verdict ? 0 : 1, name);
            }
        }
        test_workspace_free(&t);
    }
    const bool ok[] = {exact.finish(2000), opencv.finish(2000), verdicts.finish(2000)};
    return ok[0] && ok[1] && ok[2] ? EXIT_SUCCESS : EXIT_FAILURE;
}
