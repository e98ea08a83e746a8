/* SPDX-License-Identifier: Apache-2.0 */
/* Lens distortion and its inverse against long double, cv::projectPoints, and cv::undistortPoints to convergence. */
#include <opencv2/calib3d.hpp>

#include "geometry.h"
#include "golden.hpp"
#include "reference.hpp"

#include "drogue/undistort.h"

namespace {

struct Camera {
    drogue_camera q16;
    reference::Camera real;
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
    c.real = {c.matrix(0, 0),  c.matrix(1, 1),  c.matrix(0, 2),  c.matrix(1, 2), c.distortion[0],
              c.distortion[1], c.distortion[2], c.distortion[3], c.distortion[4]};
    return c;
}

cv::Point2d opencv_distort(const Camera &c, cv::Point2d ideal)
{
    const std::vector<cv::Point3d> point = {
        {(ideal.x - c.matrix(0, 2)) / c.matrix(0, 0), (ideal.y - c.matrix(1, 2)) / c.matrix(1, 1), 1}};
    std::vector<cv::Point2d> out;
    cv::projectPoints(point, cv::Vec3d(), cv::Vec3d(), c.matrix, c.distortion, out);
    return out[0];
}

/* The point that OpenCV's fixed-point iteration finds; false when it finds none. */
bool opencv_undistort(const Camera &c, cv::Point2d seen, cv::Point2d &ideal)
{
    std::vector<cv::Point2d> out;
    cv::undistortPoints(std::vector<cv::Point2d>{seen}, out, c.matrix, c.distortion, cv::noArray(), c.matrix,
                        cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 2000, 1e-12));
    ideal = out[0];
    return cv::norm(opencv_distort(c, ideal) - seen) <= 1e-8;
}

template <class P> double difference(drogue_q16 x, drogue_q16 y, const P &p)
{
    return std::max(lsb_from(x, p.x), lsb_from(y, p.y));
}

} // namespace

int main()
{
    Report forth("distort", 1), back("undistort", 3), accepted("undistort_accepted", 0);
    Report opencv_forth("distort_opencv", 1), opencv_back("undistort_opencv", 3);
    long diverged = 0;
    for (int seed = 1; seed <= 200; seed++) {
        const Camera c = random_camera(seed);
        std::uint64_t rng = (std::uint64_t)seed;
        for (int k = 0; k < 100; k++) { /* 0.6 focal lengths: 62 degrees across */
            drogue_q16 x = q16_of(c.matrix(0, 2) + rng_real(&rng, -0.6, 0.6) * c.matrix(0, 0));
            drogue_q16 y = q16_of(c.matrix(1, 2) + rng_real(&rng, -0.6, 0.6) * c.matrix(1, 1));
            const std::string name = name_of("camera", seed) + " point " + std::to_string(k);
            const cv::Point2d seen(real_of_q16(x), real_of_q16(y));
            reference::Point distorted = {seen.x, seen.y}, undistorted = distorted;
            cv::Point2d ideal;
            drogue_q16 u = x, v = y;
            const bool distorts = drogue_distort_point(&u, &v, &c.q16) == DROGUE_OK;
            const bool expected = reference::distort(c.real, distorted);
            forth.add(distorts && expected ? difference(u, v, distorted) : INFINITY, name);
            opencv_forth.add(distorts ? difference(u, v, opencv_distort(c, seen)) : INFINITY, name);
            const bool inverts = drogue_undistort_point(&x, &y, &c.q16) == DROGUE_OK;
            const bool invertible = reference::undistort(c.real, undistorted);
            const bool found = opencv_undistort(c, seen, ideal);
            accepted.add(inverts == invertible && (inverts || !found) ? 0 : 1, name);
            if (inverts && invertible) {
                back.add(difference(x, y, undistorted), name);
            }
            if (inverts && found) {
                opencv_back.add(difference(x, y, ideal), name);
            }
            diverged += found ? 0 : 1;
        }
    }
    std::printf("undistort: %ld points not converged in OpenCV\n", diverged);
    const bool ok[] = {forth.finish(20000), back.finish(18000), accepted.finish(20000), opencv_forth.finish(20000),
                       opencv_back.finish(18000)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
