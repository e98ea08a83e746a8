/* SPDX-License-Identifier: Apache-2.0 */
/* The five small filters against cv::KalmanFilter of 15 states and 5 measurements over 1000 frames. */
#include "golden.hpp"
#include "reference.hpp"

#include "drogue/kalman.h"

namespace {

constexpr int N = DROGUE_PARAMETERS;

using Parameters = std::array<double, N>;

Parameters real_of(const drogue_q16 *q)
{
    Parameters p;
    std::transform(q, q + N, p.begin(), real_of_q16);
    return p;
}

} // namespace

int main()
{
    Report report("kalman", 2);
    for (int run = 1; run <= 12; run++) {
        std::uint64_t rng = 0x4A1u + (std::uint64_t)run;
        drogue_kalman filter;
        drogue_q16 value[N], std[N], process[N], start[N][3];
        double t = 0;
        std::array<std::array<double, 3>, N> start_real;
        for (int i = 0; i < N; i++) {
            value[i] = i == DROGUE_Z ? q16_of(15) : rng_range(&rng, -30000, 30000);
            std[i] = rng_range(&rng, 30, 2000);
            process[i] = rng_range(&rng, 100, 30000);
            for (int k = 0; k < 3; k++) {
                start[i][k] = k == 0 ? std[i] : 131072;
                start_real[(std::size_t)i][(std::size_t)k] = real_of_q16(start[i][k]);
            }
        }
        reference::Kalman expected(real_of(value), start_real);
        drogue_kalman_init(&filter, value, start);
        for (int frame = 1; frame <= 1000; frame++) {
            const std::uint32_t dt_us = run % 2 ? 20000u : (std::uint32_t)rng_range(&rng, 5000, 50000);
            double worst = 0;
            t += dt_us * 1e-6;
            expected.predict(dt_us * 1e-6, real_of(process));
            drogue_kalman_predict(&filter, dt_us, process);
            if (rng_range(&rng, 0, 19) != 0) { /* else missed */
                for (int i = 0; i < N; i++) {
                    value[i] = q16_of((i == DROGUE_Z ? 15 - 0.2 * t : 0) + 0.4 * std::sin(t * (0.5 + 0.2 * i)) +
                                      real_of_q16(std[i]) * rng_normal(&rng));
                }
                expected.correct(real_of(value), real_of(std));
                drogue_kalman_correct(&filter, value, std);
            }
            for (int k = 0; k < 3; k++) {
                drogue_q16 state[N];
                drogue_kalman_state(state, &filter, k);
                for (int i = 0; i < N; i++) {
                    worst = std::max(worst, lsb_from(state[i], expected.state(i, k)));
                }
            }
            report.add(worst, name_of("run", run) + " frame " + std::to_string(frame));
        }
    }
    return report.finish(12000) ? EXIT_SUCCESS : EXIT_FAILURE;
}
