/* SPDX-License-Identifier: Apache-2.0 */
/* The inner black part against exact variances, cv::threshold, morphologyEx and connectedComponents. */
#include "golden.hpp"
#include "reference.hpp"
#include "workspace.h"

#include "drogue/inner.h"

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

/* One or two expected discs near the part that was found, or anywhere. */
std::vector<drogue_ellipse> random_expectation(std::uint64_t *rng, const cv::Mat &image, const reference::InnerPart &m)
{
    std::vector<drogue_ellipse> all((std::size_t)rng_range(rng, 1, 2));
    for (drogue_ellipse &e : all) {
        const bool near_part = m.found && rng_range(rng, 0, 2) > 0;
        const double a = rng_real(rng, 1, 20);
        e.xc_px_q16 = q16_of(near_part ? (double)m.x + rng_real(rng, -8, 8) : rng_real(rng, 0, image.cols));
        e.yc_px_q16 = q16_of(near_part ? (double)m.y + rng_real(rng, -8, 8) : rng_real(rng, 0, image.rows));
        e.a_px_q16 = q16_of(a);
        e.b_px_q16 = q16_of(a * rng_real(rng, 0.7, 1));
        e.angle_rad_q16 = 0;
    }
    return all;
}

/* The inner disc where it is expected. */
struct DiscReports {
    Report choice{"disc_choice", 0}, threshold{"disc_threshold", 0}, area{"disc_area", 0}, centroid{"disc_centroid", 1},
        spread{"disc_spread", 3};

    void add(const drogue_image *view, const drogue_mask &disc, drogue_workspace *workspace, const cv::Mat &pixels,
             const std::vector<drogue_ellipse> &expected, const std::string &name)
    {
        std::vector<reference::Ellipse> model;
        drogue_inner_expected task = {{}, (std::uint32_t)expected.size(), 1};
        drogue_inner_part got;
        std::uint32_t which;
        std::copy(expected.begin(), expected.end(), task.disc);
        for (const drogue_ellipse &e : expected) {
            model.push_back({real_of_q16(e.xc_px_q16), real_of_q16(e.yc_px_q16), real_of_q16(e.a_px_q16),
                             real_of_q16(e.b_px_q16), 0});
        }
        const reference::InnerDisc m =
            reference::inner_disc(pixels, disc.centre2_x, disc.centre2_y, disc.longest_px, 1, model);
        const drogue_status status = drogue_inner_find(&got, &which, workspace, view, &disc, &task);
        choice.add((status == DROGUE_OK) == m.found && (!m.found || (int)which == m.which) ? 0 : 1, name);
        threshold.add(std::abs(got.threshold - m.threshold), name);
        if (m.found && status == DROGUE_OK) {
            area.add(std::fabs((double)got.area_px - (double)m.area), name);
            centroid.add(std::max(lsb_from(got.x_px_q16, m.x), lsb_from(got.y_px_q16, m.y)), name);
            spread.add(lsb_from(got.spread_px_q16, m.spread), name);
        }
    }
    bool finish() const
    {
        const bool ok[] = {choice.finish(RANDOM_IMAGES), threshold.finish(RANDOM_IMAGES), area.finish(100),
                           centroid.finish(100), spread.finish(100)};
        return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; });
    }
};

} // namespace

int main()
{
    Report threshold("otsu_threshold", 0), opencv("otsu_opencv", 0), mask("dark_mask", 0), area("dark_area", 0),
        centroid("centroid", 1);
    DiscReports discs;
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
        const reference::InnerPart m =
            reference::inner_part(pixels, disc.centre2_x, disc.centre2_y, disc.longest_px, 1);
        drogue_inner_part got;
        const drogue_status status = drogue_inner_part_find(&got, &t.workspace, &view, &disc, 1);
        /* OpenCV's double may prefer another of two equals. */
        equals += m.opencv_equal && m.threshold_opencv != m.threshold;
        opencv.add(m.opencv_equal ? 0 : std::abs(m.threshold_opencv - m.threshold), image.name);
        threshold.add(std::abs(got.threshold - m.threshold), image.name);
        mask.add(mask_difference(pixels, disc, got.threshold, m.dark), image.name);
        area.add(status == DROGUE_OK || status == DROGUE_E_NO_INNER_PART ? std::fabs((double)got.area_px - m.area)
                                                                         : INFINITY,
                 image.name);
        if (m.found) {
            centroid.add(status == DROGUE_OK ? std::max(lsb_from(got.x_px_q16, m.x), lsb_from(got.y_px_q16, m.y))
                                             : INFINITY,
                         image.name);
        }
        discs.add(&view, disc, &t.workspace, pixels, random_expectation(&rng, pixels, m), image.name);
        test_workspace_free(&t);
    }
    std::printf("otsu_threshold: %d cases of equal variances decided otherwise by OpenCV\n", equals);
    const bool ok[] = {threshold.finish(RANDOM_IMAGES),
                       opencv.finish(RANDOM_IMAGES),
                       mask.finish(250),
                       area.finish(250),
                       centroid.finish(150),
                       discs.finish()};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
