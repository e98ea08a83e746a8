/* SPDX-License-Identifier: Apache-2.0 */
/* The inner black part against exact variances, cv::threshold, morphologyEx and connectedComponents. */
#include "golden.hpp"
#include "reference.hpp"
#include "workspace.h"

#include "drogue/centroid.h"

namespace {

/* Pixels of the disc on which two thresholds differ. */
double mask_difference(const cv::Mat &image, const drogue_mask &disc, int t, const cv::Mat &dark)
{
    double different = 0;
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            different += (drogue_mask_in_disc(&disc, x, y) && image.at<std::uint8_t>(y, x) <= t) !=
                         (dark.at<std::uint8_t>(y, x) != 0);
        }
    }
    return different;
}

} // namespace

int main()
{
    Report threshold("otsu_threshold", 0), opencv("otsu_opencv", 0), mask("dark_mask", 0), area("dark_area", 0),
        centroid("centroid", 1);
    int equals = 0;
    for (int seed = 1; seed <= RANDOM_IMAGES; seed++) {
        const NamedImage image = random_image(seed);
        const cv::Mat &pixels = image.pixels;
        std::uint64_t rng = image.seed + 55;
        test_workspace t = test_workspace_ample(pixels.cols, pixels.rows);
        drogue_mask disc = drogue_mask_of_size(pixels.cols, pixels.rows);
        if (seed % 2 == 0) {
            disc.longest_px = rng_range(&rng, 1, 3 * disc.longest_px);
        }
        const drogue_image view = {pixels.data, pixels.cols, pixels.rows, (std::int32_t)pixels.step};
        const reference::DarkPart m = reference::dark_part(pixels, disc.centre2_x, disc.centre2_y, disc.longest_px, 1);
        drogue_dark_part got;
        const drogue_status status = drogue_dark_part_find(&got, &t.workspace, &view, &disc, 1);
        /* OpenCV's double may prefer another of two equals. */
        equals += m.opencv_equal && m.threshold_opencv != m.threshold;
        opencv.add(m.opencv_equal ? 0 : std::abs(m.threshold_opencv - m.threshold), image.name);
        threshold.add(std::abs(got.threshold - m.threshold), image.name);
        mask.add(mask_difference(pixels, disc, got.threshold, m.dark), image.name);
        area.add(status == DROGUE_OK || status == DROGUE_E_NO_DARK_PART ? std::fabs((double)got.area_px - m.area)
                                                                        : INFINITY,
                 image.name);
        if (m.found) {
            centroid.add(status == DROGUE_OK ? std::max(lsb_from(got.x_px_q16, m.x), lsb_from(got.y_px_q16, m.y))
                                             : INFINITY,
                         image.name);
        }
        test_workspace_free(&t);
    }
    std::printf("otsu_threshold: %d cases of equal variances decided otherwise by OpenCV\n", equals);
    const bool ok[] = {threshold.finish(RANDOM_IMAGES), opencv.finish(RANDOM_IMAGES), mask.finish(250),
                       area.finish(250), centroid.finish(150)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
