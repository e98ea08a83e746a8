/* SPDX-License-Identifier: Apache-2.0 */
/* The inner black part against cv::threshold, morphologyEx, connectedComponentsWithStats and moments. */
#include <opencv2/imgproc.hpp>

#include "golden.hpp"
#include "workspace.h"

#include "drogue/centroid.h"

namespace {

struct Model {
    int threshold;
    cv::Mat dark; /* binary, in the disc */
    cv::Mat opened;
    int area;                           /* of the largest component */
    std::vector<cv::Point2d> centroids; /* of the components of that area */
};

Model model_of(const cv::Mat &image, const drogue_mask &disc)
{
    Model m;
    cv::Mat inside = cv::Mat::zeros(image.size(), CV_8U), binary, labels, stats, centres;
    std::vector<std::uint8_t> levels;
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            if (drogue_mask_in_disc(&disc, x, y)) {
                inside.at<std::uint8_t>(y, x) = 255;
                levels.push_back(image.at<std::uint8_t>(y, x));
            }
        }
    }
    m.area = 0;
    m.threshold =
        levels.empty() ? 0 : (int)cv::threshold(levels, binary, 0, 255, cv::THRESH_BINARY_INV | cv::THRESH_OTSU);
    m.dark = (image <= m.threshold) & inside;
    cv::morphologyEx(m.dark, m.opened, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8U));
    const int n = cv::connectedComponentsWithStats(m.opened, labels, stats, centres, 8);
    for (int i = 1; i < n; i++) {
        m.area = std::max(m.area, stats.at<int>(i, cv::CC_STAT_AREA));
    }
    for (int i = 1; i < n; i++) {
        if (stats.at<int>(i, cv::CC_STAT_AREA) == m.area) {
            const cv::Moments moments = cv::moments(labels == i, true);
            m.centroids.emplace_back(moments.m10 / moments.m00, moments.m01 / moments.m00);
        }
    }
    return m;
}

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

/* Variance between the classes of the disc, up to a factor: to tell equals from a wrong threshold. */
long double variance(const cv::Mat &image, const drogue_mask &disc, int t)
{
    long double n[2] = {0, 0}, sum[2] = {0, 0};
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            const int v = image.at<std::uint8_t>(y, x), k = v > t;
            n[k] += drogue_mask_in_disc(&disc, x, y) ? 1 : 0;
            sum[k] += drogue_mask_in_disc(&disc, x, y) ? v : 0;
        }
    }
    return n[0] > 0 && n[1] > 0 ? n[0] * n[1] * std::pow(sum[0] / n[0] - sum[1] / n[1], 2) : 0;
}

} // namespace

int main()
{
    Report threshold("otsu_threshold", 0), mask("dark_mask", 0), area("dark_area", 0), centroid("centroid", 1);
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
        const Model m = model_of(pixels, disc);
        drogue_dark_part got;
        const drogue_status status = drogue_dark_part_find(&got, &t.workspace, &view, &disc, 1);
        bool alike = true;
        if (got.threshold != m.threshold) { /* OpenCV's double may prefer one of two equals */
            const long double p = variance(pixels, disc, got.threshold), q = variance(pixels, disc, m.threshold);
            alike = std::fabs(p - q) <= 1e-12L * p;
            equals += alike;
            threshold.add(alike ? 0 : std::abs(got.threshold - m.threshold), image.name);
            alike = alike && mask_difference(pixels, disc, got.threshold, m.dark) == 0;
        } else {
            threshold.add(0, image.name);
        }
        if (alike) {
            mask.add(mask_difference(pixels, disc, got.threshold, m.dark), image.name);
            area.add(status == DROGUE_OK || status == DROGUE_E_NO_DARK_PART ? std::fabs((double)got.area_px - m.area)
                                                                            : INFINITY,
                     image.name);
            double nearest = status == DROGUE_OK ? INFINITY : 0;
            for (const cv::Point2d &c : m.centroids) {
                nearest = std::min(nearest, std::max(lsb_from(got.x_px_q16, c.x), lsb_from(got.y_px_q16, c.y)));
            }
            if (m.area > 0) {
                centroid.add(status == DROGUE_OK ? nearest : INFINITY, image.name);
            }
        }
        test_workspace_free(&t);
    }
    std::printf("otsu_threshold: %d cases of equal variances decided otherwise by OpenCV\n", equals);
    const bool ok[] = {threshold.finish(RANDOM_IMAGES), mask.finish(250), area.finish(250), centroid.finish(150)};
    return ok[0] && ok[1] && ok[2] && ok[3] ? EXIT_SUCCESS : EXIT_FAILURE;
}
