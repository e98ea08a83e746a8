/* SPDX-License-Identifier: Apache-2.0 */
/* The symmetric eigen-solver against quadruple precision and against cv::eigen in double, in units of 2^-30 of the normalised matrix. */
#include "golden.hpp"
#include "reference.hpp"

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

long double value_of(const drogue_eigen3 &e, std::size_t k)
{
    return std::ldexp((long double)e.value[k].mantissa, e.value[k].exponent);
}

/* Worst differences of values and vectors, in LSB, signs aside. */
struct Difference {
    double values = 0, vectors = 0;
};

Difference difference(const drogue_eigen3 &got, const reference::Eigen3 &expected)
{
    Difference d;
    for (std::size_t k = 0; k < 3; k++) {
        double minus = 0, plus = 0;
        for (std::size_t i = 0; i < 3; i++) {
            const long double v = std::ldexp((long double)got.vector_q30[k][i], -30), w = expected.vector[k][i];
            minus = std::max(minus, (double)std::fabs(v - w));
            plus = std::max(plus, (double)std::fabs(v + w));
        }
        d.values = std::max(d.values, (double)std::fabs(value_of(got, k) - expected.value[k]) / LSB);
        d.vectors = std::max(d.vectors, std::min(minus, plus) * 0x1p30);
    }
    return d;
}

reference::Eigen3 opencv_eigen(const cv::Matx33d &m)
{
    cv::Mat value, vector;
    reference::Eigen3 e;
    cv::eigen(cv::Mat(m), value, vector);
    for (int k = 0; k < 3; k++) {
        e.value[(std::size_t)k] = value.at<double>(k);
        for (int i = 0; i < 3; i++) {
            e.vector[(std::size_t)k][(std::size_t)i] = vector.at<double>(k, i);
        }
    }
    return e;
}

} // namespace

int main()
{
    static const double spectra[][3] = {{1, 0.3, -0.5},    {1, 2e-4, -1}, {2e-4, 1.9e-4, -1},
                                        {1, 1 - 1e-9, -1}, {1, 1, -2e-4}, {1, 1e-7, -2e-4},
                                        {1, 1, 1},         {1, 0, 0},     {1, 1e-14, -1e-14}};
    Report values("eigenvalues", 4), residual("eigen_residual", 8), vectors("eigenvectors", 16);
    Report opencv_values("eigenvalues_opencv", 4), opencv_vectors("eigenvectors_opencv", 16);
    long number = 0;
    for (const auto &spectrum : spectra) {
        for (int i = 0; i < 500; i++) {
            std::uint64_t rng = 0xE16E4u + (std::uint64_t)++number;
            const cv::Matx33d m = random_matrix(spectrum, &rng);
            const std::string name = name_of("matrix", number);
            const std::array<std::int64_t, 6> entries = {(std::int64_t)m(0, 0), (std::int64_t)m(0, 1),
                                                         (std::int64_t)m(0, 2), (std::int64_t)m(1, 1),
                                                         (std::int64_t)m(1, 2), (std::int64_t)m(2, 2)};
            const std::array<double, 6> a = {(double)entries[0], (double)entries[1], (double)entries[2],
                                             (double)entries[3], (double)entries[4], (double)entries[5]};
            const cv::Matx33d exact(a[0], a[1], a[2], a[1], a[3], a[4], a[2], a[4], a[5]);
            drogue_real s[6];
            drogue_eigen3 got;
            for (std::size_t k = 0; k < 6; k++) {
                drogue_real_set(&s[k], entries[k], 0);
            }
            (void)drogue_eigen_sym3(&got, s);
            double residual_error = 0;
            for (int k = 0; k < 3; k++) {
                const cv::Vec3d v((double)got.vector_q30[k][0] * 0x1p-30, (double)got.vector_q30[k][1] * 0x1p-30,
                                  (double)got.vector_q30[k][2] * 0x1p-30);
                const cv::Vec3d r = exact * v - (double)value_of(got, (std::size_t)k) * v;
                residual_error = std::max(residual_error, cv::norm(r, cv::NORM_INF) / LSB);
            }
            const Difference d = difference(got, reference::eigen(entries)), o = difference(got, opencv_eigen(exact));
            values.add(d.values, name);
            opencv_values.add(o.values, name);
            residual.add(residual_error, name);
            if (number <= 500) { /* the first spectrum: directions well apart */
                vectors.add(d.vectors, name);
                opencv_vectors.add(o.vectors, name);
            }
        }
    }
    const bool ok[] = {values.finish(4500), residual.finish(4500), vectors.finish(500), opencv_values.finish(4500),
                       opencv_vectors.finish(500)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
