/* SPDX-License-Identifier: Apache-2.0 */
/* Lens distortion against cv::projectPoints, its inverse against cv::undistortPoints iterated to convergence. */
#include <opencv2/calib3d.hpp>

#include "geometry.h"
#include "golden.hpp"

#include "drogue/undistort.h"

namespace {

struct Camera {
    drogue_camera q16;
    cv::Matx33d matrix;
    cv::Vec<double, 5> distortion;
};

/* Wide to long lenses as calibration finds them. */
Camera random_camera(int seed)
{
    std::uint64_t rng = 0xCA3E4Au + (std::uint64_t)seed;
    Camera c;
    c.q16 = pinhole(rng_real(&rng, 500, 3000), rng_real(&rng, 500, 3000), rng_real(&rng, 900, 1100),
                    rng_real(&rng, 700, 1100));
    c.q16.k1_q16 = q16_of(rng_real(&rng, -0.25, 0.25));
    c.q16.k2_q16 = q16_of(rng_real(&rng, -0.05, 0.1));
    c.q16.p1_q16 = q16_of(rng_real(&rng, -0.002, 0.002));
    c.q16.p2_q16 = q16_of(rng_real(&rng, -0.002, 0.002));
    c.q16.k3_q16 = q16_of(rng_real(&rng, -0.01, 0.01));
    c.matrix = {real_of_q16(c.q16.fx_px_q16),
                0,
                real_of_q16(c.q16.cx_px_q16),
                0,
                real_of_q16(c.q16.fy_px_q16),
                real_of_q16(c.q16.cy_px_q16),
                0,
                0,
                1};
    c.distortion = {real_of_q16(c.q16.k1_q16), real_of_q16(c.q16.k2_q16), real_of_q16(c.q16.p1_q16),
                    real_of_q16(c.q16.p2_q16), real_of_q16(c.q16.k3_q16)};
    return c;
}

cv::Point2d distort(const Camera &c, cv::Point2d ideal)
{
    const std::vector<cv::Point3d> point = {
        {(ideal.x - c.matrix(0, 2)) / c.matrix(0, 0), (ideal.y - c.matrix(1, 2)) / c.matrix(1, 1), 1}};
    std::vector<cv::Point2d> out;
    cv::projectPoints(point, cv::Vec3d(), cv::Vec3d(), c.matrix, c.distortion, out);
    return out[0];
}

} // namespace

int main()
{
    Report forth("distort", 2), back("undistort", 4), accepted("undistort_accepted", 0);
    long diverged = 0;
    for (int seed = 1; seed <= 200; seed++) {
        const Camera c = random_camera(seed);
        std::uint64_t rng = (std::uint64_t)seed;
        for (int k = 0; k < 100; k++) { /* 0.6 focal lengths: 62 degrees across */
            drogue_q16 x = q16_of(c.matrix(0, 2) + rng_real(&rng, -0.6, 0.6) * c.matrix(0, 0));
            drogue_q16 y = q16_of(c.matrix(1, 2) + rng_real(&rng, -0.6, 0.6) * c.matrix(1, 1));
            const std::string name = name_of("camera", seed) + " point " + std::to_string(k);
            const std::vector<cv::Point2d> seen = {{real_of_q16(x), real_of_q16(y)}};
            std::vector<cv::Point2d> ideal;
            drogue_q16 u = x, v = y;
            const cv::Point2d d = distort(c, seen[0]);
            forth.add(drogue_distort_point(&u, &v, &c.q16) == DROGUE_OK ? std::max(lsb_from(u, d.x), lsb_from(v, d.y))
                                                                        : INFINITY,
                      name);
            cv::undistortPoints(seen, ideal, c.matrix, c.distortion, cv::noArray(), c.matrix,
                                cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 2000, 1e-12));
            if (cv::norm(distort(c, ideal[0]) - seen[0]) > 1e-8) {
                diverged++; /* OpenCV's fixed-point iteration found nothing to compare with */
                continue;
            }
            const bool ok = drogue_undistort_point(&x, &y, &c.q16) == DROGUE_OK;
            accepted.add(ok ? 0 : 1, name);
            if (ok) {
                back.add(std::max(lsb_from(x, ideal[0].x), lsb_from(y, ideal[0].y)), name);
            }
        }
    }
    std::printf("undistort: %ld points not converged in OpenCV\n", diverged);
    const bool ok[] = {forth.finish(20000), back.finish(18000), accepted.finish(18000)};
    return ok[0] && ok[1] && ok[2] ? EXIT_SUCCESS : EXIT_FAILURE;
}
