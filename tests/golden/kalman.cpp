/* SPDX-License-Identifier: Apache-2.0 */
/* The five small filters against cv::KalmanFilter of 15 states and 5 measurements over 1000 frames. */
#include <opencv2/video/tracking.hpp>

#include "golden.hpp"

#include "drogue/kalman.h"

namespace {

constexpr int N = DROGUE_PARAMETERS;

double square(drogue_q16 v) { return real_of_q16(v) * real_of_q16(v); }

void set_step(cv::KalmanFilter &k, double dt, const drogue_q16 *process)
{
    const double g[3] = {dt * dt / 2, dt, 1};
    cv::setIdentity(k.transitionMatrix);
    k.processNoiseCov.setTo(0);
    for (int i = 0; i < N; i++) {
        k.transitionMatrix.at<double>(i, N + i) = k.transitionMatrix.at<double>(N + i, 2 * N + i) = dt;
        k.transitionMatrix.at<double>(i, 2 * N + i) = dt * dt / 2;
        for (int p = 0; p < 3; p++) {
            for (int q = 0; q < 3; q++) {
                k.processNoiseCov.at<double>(p * N + i, q * N + i) = g[p] * g[q] * square(process[i]);
            }
        }
    }
}

} // namespace

int main()
{
    Report report("kalman", 16);
    for (int run = 1; run <= 12; run++) {
        std::uint64_t rng = 0x4A1u + (std::uint64_t)run;
        cv::KalmanFilter reference(3 * N, N, 0, CV_64F);
        drogue_kalman filter;
        drogue_q16 value[N], std[N], process[N], start[N][3];
        double t = 0;
        cv::setIdentity(reference.measurementMatrix);
        reference.measurementNoiseCov.setTo(0);
        reference.errorCovPost.setTo(0);
        reference.statePost.setTo(0);
        for (int i = 0; i < N; i++) {
            value[i] = i == DROGUE_Z ? q16_of(15) : rng_range(&rng, -30000, 30000);
            std[i] = rng_range(&rng, 30, 2000);
            process[i] = rng_range(&rng, 100, 30000);
            reference.measurementNoiseCov.at<double>(i, i) = square(std[i]);
            reference.statePost.at<double>(i) = real_of_q16(value[i]);
            for (int k = 0; k < 3; k++) {
                start[i][k] = k == 0 ? std[i] : 131072;
                reference.errorCovPost.at<double>(k * N + i, k * N + i) = square(start[i][k]);
            }
        }
        drogue_kalman_init(&filter, value, start);
        for (int frame = 1; frame <= 1000; frame++) {
            const std::uint32_t dt_us = run % 2 ? 20000u : (std::uint32_t)rng_range(&rng, 5000, 50000);
            double worst = 0;
            t += dt_us * 1e-6;
            set_step(reference, dt_us * 1e-6, process);
            reference.predict();
            drogue_kalman_predict(&filter, dt_us, process);
            if (rng_range(&rng, 0, 19) != 0) { /* else missed */
                cv::Mat measured(N, 1, CV_64F);
                for (int i = 0; i < N; i++) {
                    value[i] = q16_of((i == DROGUE_Z ? 15 - 0.2 * t : 0) + 0.4 * std::sin(t * (0.5 + 0.2 * i)) +
                                      real_of_q16(std[i]) * rng_normal(&rng));
                    measured.at<double>(i) = real_of_q16(value[i]);
                }
                reference.correct(measured);
                drogue_kalman_correct(&filter, value, std);
            }
            for (int k = 0; k < 3; k++) {
                drogue_q16 state[N];
                drogue_kalman_state(state, &filter, k);
                for (int i = 0; i < N; i++) {
                    const double x = reference.statePost.at<double>(k * N + i);
                    worst = std::max(worst, lsb_from(state[i], x));
                }
            }
            report.add(worst, name_of("run", run) + " frame " + std::to_string(frame));
        }
    }
    return report.finish(12000) ? EXIT_SUCCESS : EXIT_FAILURE;
}
