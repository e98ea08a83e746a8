/* SPDX-License-Identifier: Apache-2.0 */
/* Noise on the ellipse, pose by the library. */
#include "pose_noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "drogue/pose.h"
#include "geometry.hpp"
#include "measure.hpp"
#include "scene.hpp"

namespace accuracy {

namespace {

struct Exact {
    Pose pose;
    Ellipse rim;
    cv::Point2d inner_px;
};

Exact random_exact(const Scene &view, double distance_m, Random &random)
{
    const double tilt = 20 * CV_PI / 180;
    const double yaw = random.uniform(-tilt, tilt);
    const double pitch = random.uniform(-tilt, tilt);
    for (;;) {
        Exact e;
        const double u = random.uniform(0, view.image_px.width - 1);
        const double v = random.uniform(0, view.image_px.height - 1);
        e.pose = {distance_m * view.camera.ray({u, v}), axis_of(yaw, pitch)};
        e.rim = project_circle(view.camera, e.pose, view.drogue.rim_radius_m, 0);
        e.inner_px = view.camera.project_ideal(e.pose.position_m + view.drogue.inner_depth_m * e.pose.axis);
        const double reach = e.rim.a_px + 1;
        if (e.rim.xc_px >= reach && e.rim.yc_px >= reach && e.rim.xc_px <= view.image_px.width - 1 - reach &&
            e.rim.yc_px <= view.image_px.height - 1 - reach) {
            return e;
        }
    }
}

double normal(Random &random)
{
    const double radius = std::sqrt(-2 * std::log(1 - random.uniform(0, 1)));
    return radius * std::cos(random.uniform(0, 2 * CV_PI));
}

Ellipse disturbed(const Ellipse &exact, Noisy noisy, double sigma_px, Random &random)
{
    Ellipse e = exact;
    const double first = sigma_px * normal(random);
    const double second = sigma_px * normal(random); /* drawn always: every experiment sees the same poses */
    switch (noisy) {
    case Noisy::semi_major: e.a_px += first; break;
    case Noisy::semi_minor: e.b_px += first; break;
    case Noisy::centre:
        e.xc_px += first;
        e.yc_px += second;
        break;
    }
    if (e.a_px < e.b_px) { /* the axes change names */
        std::swap(e.a_px, e.b_px);
        e.angle_rad += e.angle_rad > 0 ? -CV_PI / 2 : CV_PI / 2;
    }
    return e;
}

Pose from_library(const drogue_pose &p)
{
    return {{from_q16(p.position_m_q16[0]), from_q16(p.position_m_q16[1]), from_q16(p.position_m_q16[2])},
            {from_q16(p.axis_q16[0]), from_q16(p.axis_q16[1]), from_q16(p.axis_q16[2])}};
}

double angle_error_deg(double got_rad, double want_rad)
{
    return std::fabs(std::remainder(got_rad - want_rad, 2 * CV_PI)) * 180 / CV_PI;
}

void add_pose(NoiseCell &cell, const Scene &view, const Exact &truth, const Ellipse &wrong)
{
    const drogue_camera camera = {to_q16(view.camera.fx_px),
                                  to_q16(view.camera.fy_px),
                                  to_q16(view.camera.cx_px),
                                  to_q16(view.camera.cy_px),
                                  0,
                                  0,
                                  0,
                                  0,
                                  0};
    const drogue_ellipse ellipse = {to_q16(wrong.xc_px), to_q16(wrong.yc_px), to_q16(wrong.a_px), to_q16(wrong.b_px),
                                    to_q16(wrong.angle_rad)};
    drogue_pose poses[2];
    drogue_choice choice;
    cell.poses++;
    if (drogue_pose_from_ellipse(poses, &ellipse, &camera, to_q16(view.drogue.rim_radius_m)) != DROGUE_OK ||
        drogue_choose_pose(&choice, poses, to_q16(truth.inner_px.x), to_q16(truth.inner_px.y),
                           to_q16(view.drogue.inner_depth_m), &camera) != DROGUE_OK) {
        cell.refused++;
        return;
    }
    const Pose got = from_library(poses[choice.index]);
    const Pose other = from_library(poses[1 - choice.index]);
    const bool twin = angle_between_deg(other.axis, truth.pose.axis) < angle_between_deg(got.axis, truth.pose.axis);
    const Pose &best = twin ? other : got;
    cell.other += twin;
    for (int k = 0; k < 3; k++) {
        cell.mean_m[k] += std::fabs(got.position_m[k] - truth.pose.position_m[k]); /* divided at the end */
    }
    cell.pitch_deg.push_back(angle_error_deg(pitch_of(got.axis), pitch_of(truth.pose.axis)));
    cell.yaw_deg.push_back(angle_error_deg(yaw_of(got.axis), yaw_of(truth.pose.axis)));
    cell.pitch_best_deg.push_back(angle_error_deg(pitch_of(best.axis), pitch_of(truth.pose.axis)));
    cell.yaw_best_deg.push_back(angle_error_deg(yaw_of(best.axis), yaw_of(truth.pose.axis)));
}

} // namespace

AngleErrors summary_of(const std::vector<double> &absolute_deg)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    AngleErrors s = {nan, nan, nan, nan};
    if (!absolute_deg.empty()) {
        double sum2 = 0;
        s.min = *std::min_element(absolute_deg.begin(), absolute_deg.end());
        s.max = *std::max_element(absolute_deg.begin(), absolute_deg.end());
        s.mean = mean(absolute_deg);
        for (const double v : absolute_deg) {
            sum2 += (v - s.mean) * (v - s.mean);
        }
        s.std = std::sqrt(sum2 / static_cast<double>(absolute_deg.size()));
    }
    return s;
}

std::vector<NoiseCell> run_noise(const NoiseExperiment &experiment)
{
    const Scene view; /* the study's camera and drogue */
    std::vector<NoiseCell> cells;
    for (const double sigma : experiment.sigmas_px) {
        for (const double distance : experiment.distances_m) {
            NoiseCell cell = {sigma, distance, {0, 0, 0}, 0, 0, 0, 0, {}, {}, {}, {}};
            Random random(hash_at(experiment.seed, std::lround(distance * 1000), 0));
            for (int i = 0; i < experiment.poses; i++) {
                const Exact truth = random_exact(view, distance, random);
                add_pose(cell, view, truth, disturbed(truth.rim, experiment.noisy, sigma, random));
            }
            cell.mean_m *= 1.0 / (cell.poses - cell.refused);
            cell.mean_lateral_px = (cell.mean_m[0] + cell.mean_m[1]) / 2 / distance * view.camera.fx_px;
            cells.push_back(std::move(cell));
        }
    }
    return cells;
}

} // namespace accuracy
