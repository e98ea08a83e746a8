/* SPDX-License-Identifier: Apache-2.0 */
/* Arcs: the edge points of candidates in the ring, their partition by direction class into connected components, and the
 * order of those. */
#include "golden.hpp"
#include "own_workspace.h"
#include "reference.hpp"

namespace {

/* Points on which the two partitions disagree. */
double partition_difference(const cv::Mat &image, const drogue_frontend_config &config)
{
    test_workspace t = test_workspace_ample(image.cols, image.rows);
    drogue_edge_list list;
    cv::Mat arc = cv::Mat::zeros(image.size(), CV_32S), gx, gy;
    double different = 0;
    if (frontend_run(&list, &t.workspace, &config, image.data, image.cols, image.rows) != DROGUE_OK ||
        !guarded_intact(&t.memory)) {
        test_workspace_free(&t);
        return INFINITY;
    }
    const cv::Mat ring =
        reference::ring(image.cols, image.rows, config.ring.centre2_x, config.ring.centre2_y, config.ring.longest_px);
    const cv::Mat edges = reference::canny_within(image, config.canny_low, config.canny_high, config.smooth != 0, ring);
    reference::gradient(config.smooth ? reference::smooth(image) : image, gx, gy);
    const std::vector<reference::Arc> expected = reference::arcs(edges, gx, gy);
    for (std::uint32_t i = 0; i < list.edge_count; i++) {
        const drogue_edge *e = &t.workspace.edges[i];
        const int x = drogue_edge_x_px(e), y = drogue_edge_y_px(e);
        different += e->arc >= list.arc_count;
        arc.at<std::int32_t>(y, x) = (std::int32_t)e->arc + 1;
    }
    different += std::fabs((double)list.arc_count - (double)expected.size());
    for (std::size_t i = 0; i < expected.size() && different == 0; i++) { /* the same arcs in the same order */
        different += t.workspace.arcs[i].direction != (std::uint32_t)expected[i].direction;
        for (const cv::Point p : expected[i].pixels) {
            different += arc.at<std::int32_t>(p) != (std::int32_t)i + 1;
        }
    }
    different += std::fabs((double)list.edge_count - cv::countNonZero(edges));
    test_workspace_free(&t);
    return different;
}

bool test_arcs(const std::vector<NamedImage> &images)
{
    Report report("arcs", 0);
    for (const NamedImage &image : images) {
        std::uint64_t rng = image.seed + 99;
        for (int smooth = 0; smooth <= 1; smooth++) {
            drogue_frontend_config config = {};
            config.canny_low = rng_range(&rng, 0, 120);
            config.canny_high = config.canny_low + rng_range(&rng, 0, 200);
            config.smooth = smooth;
            config.use_ring = 1;
            config.ring = drogue_mask_of_size(image.pixels.cols, image.pixels.rows);
            config.min_arc_px = 1;
            report.add(partition_difference(image.pixels, config), image.name + (smooth ? " smoothed" : " raw"));
        }
    }
    return report.finish(2 * (long)images.size());
}

} // namespace

int main(int argc, char **argv) { return run_on_images(argc, argv, test_arcs); }
