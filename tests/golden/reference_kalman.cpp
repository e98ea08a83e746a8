/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the filter: cv::KalmanFilter of 15 states, all values first, then all rates, then all accelerations. */
#include "reference.hpp"

#include <cmath>

#include <opencv2/video/tracking.hpp>

namespace reference {

namespace {

constexpr int N = 5;
constexpr int PITCH = 3;
constexpr double PI = 3.14159265358979323846;

cv::KalmanFilter filter_with(const cv::Mat &state, const cv::Mat &covariance)
{
    cv::KalmanFilter k(3 * N, N, 0, CV_64F);
    state.copyTo(k.statePost);
    state.copyTo(k.statePre);
    covariance.copyTo(k.errorCovPost);
    covariance.copyTo(k.errorCovPre);
    cv::setIdentity(k.measurementMatrix);
    return k;
}

} // namespace

Kalman::Kalman(const std::array<double, 5> &value, const std::array<std::array<double, 3>, 5> &std)
    : state_(cv::Mat::zeros(3 * N, 1, CV_64F)), covariance_(cv::Mat::zeros(3 * N, 3 * N, CV_64F))
{
    for (int i = 0; i < N; i++) {
        state_.at<double>(i) = value[static_cast<size_t>(i)];
        for (int k = 0; k < 3; k++) {
            const double s = std[static_cast<size_t>(i)][static_cast<size_t>(k)];
            covariance_.at<double>(k * N + i, k * N + i) = s * s;
        }
    }
}

void Kalman::predict(double dt, const std::array<double, 5> &std)
{
    cv::KalmanFilter filter = filter_with(state_, covariance_);
    const double g[3] = {dt * dt / 2, dt, 1};
    cv::setIdentity(filter.transitionMatrix);
    filter.processNoiseCov.setTo(0);
    for (int i = 0; i < N; i++) {
        const double s = std[static_cast<size_t>(i)];
        filter.transitionMatrix.at<double>(i, N + i) = filter.transitionMatrix.at<double>(N + i, 2 * N + i) = dt;
        filter.transitionMatrix.at<double>(i, 2 * N + i) = dt * dt / 2;
        for (int p = 0; p < 3; p++) {
            for (int q = 0; q < 3; q++) {
                filter.processNoiseCov.at<double>(p * N + i, q * N + i) = g[p] * g[q] * s * s;
            }
        }
    }
    filter.predict();
    state_ = filter.statePost.clone();
    for (int i = PITCH; i < N; i++) {
        state_.at<double>(i) = std::remainder(state_.at<double>(i), 2 * PI);
    }
    covariance_ = filter.errorCovPost.clone();
}

void Kalman::correct(const std::array<double, 5> &value, const std::array<double, 5> &std)
{
    cv::KalmanFilter filter = filter_with(state_, covariance_);
    cv::Mat measured(N, 1, CV_64F);
    filter.measurementNoiseCov.setTo(0);
    for (int i = 0; i < N; i++) {
        const double v = value[static_cast<size_t>(i)], s = std[static_cast<size_t>(i)], own = state_.at<double>(i);
        measured.at<double>(i) = i >= PITCH && std::fabs(v - own) > PI ? own + std::remainder(v - own, 2 * PI) : v;
        filter.measurementNoiseCov.at<double>(i, i) = s * s;
    }
    filter.correct(measured);
    state_ = filter.statePost.clone();
    covariance_ = filter.errorCovPost.clone();
}

double Kalman::state(int parameter, int order) const { return state_.at<double>(order * N + parameter); }

} // namespace reference
