/* SPDX-License-Identifier: Apache-2.0 */
/* The pose from an ellipse that is a little wrong (paper, Fig. 7 to 9, tables 1 to 3): exact projections of random
 * poses, noise on one of the ellipse's parameters, the library's fixed-point pose and choice. */
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/core.hpp>

namespace accuracy {

/* Which parameter is wrong; both coordinates for the centre, the same noise in either. */
enum class Noisy { semi_major, semi_minor, centre };

struct NoiseExperiment {
    Noisy noisy;
    std::vector<double> sigmas_px; /* of the normal noise */
    std::vector<double> distances_m;
    int poses = 0; /* for each sigma and distance; the same ones for each sigma */
    uint64_t seed = 1;
};

/* Absolute errors of the angles, degrees. */
struct AngleErrors {
    double min = 0, max = 0, mean = 0, std = 0; /* NaN of an empty set */
};
AngleErrors summary_of(const std::vector<double> &absolute_deg);

struct NoiseCell {
    double sigma_px, distance_m;
    cv::Vec3d mean_m;       /* mean absolute error of x, y, z */
    double mean_lateral_px; /* that of x and y, as pixels at that distance */
    int poses;
    int refused;                            /* no pose: the wrong ellipse has none */
    int other;                              /* the choice fell on the pose whose axis is farther from the true one */
    std::vector<double> pitch_deg, yaw_deg; /* absolute errors of the pose chosen */
    std::vector<double> pitch_best_deg, yaw_best_deg; /* of the pose nearer to the true axis */
};

/* Cells in the order of sigmas, within each of distances.
 *
 *  axis      yaw and pitch uniform in +-20 degrees
 *  position  anywhere in the field of view where the whole outline is seen
 *  choice    between the two poses by the true image of the inner part's centre
 */
std::vector<NoiseCell> run_noise(const NoiseExperiment &experiment);

} // namespace accuracy
