/* SPDX-License-Identifier: Apache-2.0 */
/* Smoothing, gradient, Canny and masks: equal to OpenCV in every pixel. */
#include "golden.hpp"
#include "own_workspace.h"
#include "reference.hpp"

#include "drogue/gradient.h"
#include "drogue/smooth.h"

namespace {

double largest_difference(const cv::Mat &p, const cv::Mat &q) { return cv::norm(p, q, cv::NORM_INF); }

drogue_image view_of(const cv::Mat &m) { return {m.data, m.cols, m.rows, (std::int32_t)m.step}; }

double smooth_difference(const cv::Mat &image)
{
    cv::Mat got(image.size(), CV_8U);
    std::vector<std::uint16_t> column((std::size_t)image.cols);
    const drogue_image view = view_of(image);
    return drogue_smooth_image(got.data, column.data(), &view) == DROGUE_OK
               ? largest_difference(got, reference::smooth(image))
               : INFINITY;
}

double gradient_difference(const cv::Mat &image)
{
    cv::Mat ex, ey, gx(image.size(), CV_16S), gy(image.size(), CV_16S), magnitude(image.size(), CV_16U);
    const drogue_image view = view_of(image);
    reference::gradient(image, ex, ey);
    if (drogue_gradient_image(gx.ptr<std::int16_t>(), gy.ptr<std::int16_t>(), magnitude.ptr<std::uint16_t>(), &view) !=
        DROGUE_OK) {
        return INFINITY;
    }
    cv::Mat l1 = cv::abs(ex) + cv::abs(ey), wide;
    magnitude.convertTo(wide, CV_16S);
    return std::max({largest_difference(gx, ex), largest_difference(gy, ey), largest_difference(wide, l1)});
}

/* Edge map of the front end; empty when it fails. */
cv::Mat edge_map(const cv::Mat &image, int low, int high, bool smooth)
{
    test_workspace t = test_workspace_ample(image.cols, image.rows);
    drogue_frontend_config config = {};
    drogue_edge_list list;
    config.canny_low = low;
    config.canny_high = high;
    config.smooth = smooth;
    config.min_arc_px = 10;
    cv::Mat map = cv::Mat::zeros(image.size(), CV_8U);
    const bool ok = frontend_run(&list, &t.workspace, &config, image.data, image.cols, image.rows) == DROGUE_OK &&
                    guarded_intact(&t.memory);
    for (std::uint32_t i = 0; ok && i < list.edge_count; i++) {
        const drogue_edge *e = &t.workspace.edges[i];
        map.at<std::uint8_t>(drogue_edge_y_px(e), drogue_edge_x_px(e)) = 255;
    }
    test_workspace_free(&t);
    return ok ? map : cv::Mat();
}

/* Pixels that differ from cv::Canny. */
double canny_difference(const cv::Mat &image, int low, int high, bool smooth)
{
    const cv::Mat got = edge_map(image, low, high, smooth);
    return got.empty() ? INFINITY : cv::countNonZero(got != reference::canny(image, low, high, smooth));
}

/* Pixels of the ring of a region that differ. */
double mask_difference(cv::Size size)
{
    const drogue_mask mask = drogue_mask_of_size(size.width, size.height);
    const int longest = std::max(size.width, size.height);
    const cv::Mat ring = reference::ring(size.width, size.height, size.width - 1, size.height - 1, longest);
    double different = 0;
    for (int y = 0; y < size.height; y++) {
        for (int x = 0; x < size.width; x++) {
            different += (drogue_mask_in_ring(&mask, x, y) != 0) != (ring.at<std::uint8_t>(y, x) != 0);
        }
    }
    return different;
}

bool test_pixels(const std::vector<NamedImage> &images)
{
    Report smooth("smooth", 0), gradient("gradient", 0), canny("canny", 0), blurred("canny_smoothed", 0),
        mask("mask", 0);
    for (const NamedImage &image : images) {
        std::uint64_t rng = image.seed + 77;
        smooth.add(smooth_difference(image.pixels), image.name);
        gradient.add(gradient_difference(image.pixels), image.name);
        mask.add(mask_difference(image.pixels.size()), image.name);
        for (int k = 0; k < 4; k++) {
            static const int most[4] = {0, 80, 600, 5000};
            const int low = k == 0 ? 0 : rng_range(&rng, 0, most[k]);
            const int high = k == 0 ? rng_range(&rng, 0, 300) : rng_range(&rng, low, low + most[rng_range(&rng, 0, 3)]);
            const std::string name = image.name + " thresholds " + std::to_string(low) + " " + std::to_string(high);
            canny.add(canny_difference(image.pixels, low, high, false), name);
            blurred.add(canny_difference(image.pixels, low, high, true), name);
        }
    }
    const long n = (long)images.size();
    const bool ok[] = {smooth.finish(n), gradient.finish(n), canny.finish(4 * n), blurred.finish(4 * n),
                       mask.finish(n)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; });
}

} // namespace

int main(int argc, char **argv) { return run_on_images(argc, argv, test_pixels); }
