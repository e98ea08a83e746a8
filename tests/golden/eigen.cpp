/* SPDX-License-Identifier: Apache-2.0 */
/* The symmetric eigen-solver against cv::eigen in double, in units of 2^-30 of the normalised matrix. */
#include "golden.hpp"

#include "drogue/eigen.h"

namespace {

constexpr double LSB = 536870912.0; /* 2^59 / 2^30 */

/* Symmetric matrix of a spectrum in random directions, largest entry normalised to [2^57, 2^59]. */
cv::Matx33d random_matrix(const double spectrum[3], std::uint64_t *rng)
{
    cv::Matx33d random, q, r = cv::Matx33d::diag({spectrum[0], spectrum[1], spectrum[2]});
    for (double &v : random.val) {
        v = rng_normal(rng);
    }
    cv::SVD svd(cv::Mat(random), cv::SVD::FULL_UV);
    q = cv::Matx33d(svd.u.ptr<double>());
    r = q * r * q.t();
    double largest = 0;
    for (const double v : r.val) {
        largest = std::max(largest, std::fabs(v));
    }
    return largest > 0 ? r * (rng_real(rng, 0.26, 0.99) * 0x1p59 / largest) : r;
}

} // namespace

int main()
{
    static const double spectra[][3] = {{1, 0.3, -0.5},    {1, 2e-4, -1}, {2e-4, 1.9e-4, -1},
                                        {1, 1 - 1e-9, -1}, {1, 1, -2e-4}, {1, 1e-7, -2e-4},
                                        {1, 1, 1},         {1, 0, 0},     {1, 1e-14, -1e-14}};
    Report values("eigenvalues", 2), residual("eigen_residual", 2), vectors("eigenvectors", 16);
    long number = 0;
    for (const auto &spectrum : spectra) {
        for (int i = 0; i < 500; i++) {
            std::uint64_t rng = 0xE16E4u + (std::uint64_t)++number;
            const cv::Matx33d m = random_matrix(spectrum, &rng);
            const std::string name = name_of("matrix", number);
            drogue_sym3 s = {{(std::int64_t)m(0, 0), (std::int64_t)m(0, 1), (std::int64_t)m(0, 2),
                              (std::int64_t)m(1, 1), (std::int64_t)m(1, 2), (std::int64_t)m(2, 2)}};
            const cv::Matx33d exact((double)s.a[0], (double)s.a[1], (double)s.a[2], (double)s.a[1], (double)s.a[3],
                                    (double)s.a[4], (double)s.a[2], (double)s.a[4], (double)s.a[5]);
            drogue_eigen3 got;
            cv::Mat value, vector;
            cv::eigen(cv::Mat(exact), value, vector);
            (void)drogue_eigen_sym3(&got, &s);
            double value_error = 0, residual_error = 0, vector_error = 0;
            for (int k = 0; k < 3; k++) {
                const cv::Vec3d v((double)got.vector_q60[k][0] * 0x1p-60, (double)got.vector_q60[k][1] * 0x1p-60,
                                  (double)got.vector_q60[k][2] * 0x1p-60);
                const cv::Vec3d w(vector.ptr<double>(k)), r = exact * v - (double)got.value[k] * v;
                value_error = std::max(value_error, std::fabs((double)got.value[k] - value.at<double>(k)) / LSB);
                residual_error = std::max(residual_error, cv::norm(r, cv::NORM_INF) / LSB);
                vector_error = std::max(vector_error, std::min(cv::norm(v - w), cv::norm(v + w)) * 0x1p30);
            }
            values.add(value_error, name);
            residual.add(residual_error, name);
            if (number <= 500) { /* the first spectrum: directions well apart */
                vectors.add(vector_error, name);
            }
        }
    }
    const bool ok[] = {values.finish(4500), residual.finish(4500), vectors.finish(500)};
    return ok[0] && ok[1] && ok[2] ? EXIT_SUCCESS : EXIT_FAILURE;
}
