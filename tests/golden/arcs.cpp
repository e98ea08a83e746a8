/* SPDX-License-Identifier: Apache-2.0 */
/* Arcs: the partition of the edge points of each direction class in the ring into connected components. */
#include <map>
#include <opencv2/imgproc.hpp>

#include "golden.hpp"
#include "workspace.h"

namespace {

/* Class of (2) from OpenCV's gradient, gy counted upward; 255 where there is none. */
cv::Mat direction_classes(const cv::Mat &image)
{
    cv::Mat gx, gy, classes(image.size(), CV_8U, cv::Scalar(255));
    cv::Sobel(image, gx, CV_16S, 1, 0, 3, 1, 0, cv::BORDER_REPLICATE);
    cv::Sobel(image, gy, CV_16S, 0, 1, 3, -1, 0, cv::BORDER_REPLICATE);
    classes.setTo(0, (gx >= 0) & (gy > 0));
    classes.setTo(1, (gx < 0) & (gy >= 0));
    classes.setTo(2, (gx <= 0) & (gy < 0));
    classes.setTo(3, (gx > 0) & (gy <= 0));
    return classes;
}

/* Points on which the two partitions disagree. */
double partition_difference(const cv::Mat &image, const drogue_frontend_config &config)
{
    test_workspace t = test_workspace_ample(image.cols, image.rows);
    drogue_edge_list list;
    cv::Mat edges, arc = cv::Mat::zeros(image.size(), CV_32S), ring = cv::Mat::zeros(image.size(), CV_8U);
    double different = 0;
    if (frontend_run(&list, &t.workspace, &config, image.data, image.cols, image.rows) != DROGUE_OK ||
        !guarded_intact(&t.memory)) {
        test_workspace_free(&t);
        return INFINITY;
    }
    cv::Mat blurred = image;
    if (config.smooth) {
        cv::GaussianBlur(image, blurred, cv::Size(5, 5), 0, 0, cv::BORDER_REFLECT_101);
    }
    cv::Canny(blurred, edges, config.canny_low, config.canny_high, 3, false);
    const cv::Mat classes = direction_classes(blurred);
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            ring.at<std::uint8_t>(y, x) = drogue_mask_in_ring(&config.ring, x, y) ? 255 : 0;
        }
    }
    for (std::uint32_t i = 0; i < list.edge_count; i++) {
        const drogue_edge *e = &t.workspace.edges[i];
        const int x = drogue_edge_x_px(e), y = drogue_edge_y_px(e);
        different += e->arc >= list.arc_count || t.workspace.arcs[e->arc].direction != classes.at<std::uint8_t>(y, x);
        arc.at<std::int32_t>(y, x) = (std::int32_t)e->arc + 1;
    }
    for (int c = 0; c < 4; c++) {
        cv::Mat labels, members = (classes == c) & edges & ring;
        std::map<int, int> forth, back;
        cv::connectedComponents(members, labels, 8, CV_32S);
        for (int y = 0; y < image.rows; y++) {
            for (int x = 0; x < image.cols; x++) {
                const int label = labels.at<std::int32_t>(y, x), a = arc.at<std::int32_t>(y, x);
                if (label != 0) {
                    different += a == 0 || forth.emplace(label, a).first->second != a ||
                                 back.emplace(a, label).first->second != label;
                }
            }
        }
    }
    different += std::fabs((double)list.edge_count - cv::countNonZero(edges & ring));
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
