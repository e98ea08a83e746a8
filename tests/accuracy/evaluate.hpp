/* SPDX-License-Identifier: Apache-2.0 */
/* Trials rendered, measured with the library and judged against their truth, on several threads. */
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "conditions.hpp"
#include "measure.hpp"

namespace accuracy {

/* wrong: reported as ok, but the ellipse is off by more than 1 px and 3 % of the semi-major axis. */
enum class Verdict { right, wrong, unmeasured };

struct Outcome {
    Verdict verdict = Verdict::unmeasured;
    drogue_status status = DROGUE_OK;
    double distance_m = 0;
    bool inner = false;    /* the inner part was found */
    bool resolved = false; /* the orientation was */
    bool twin = false;     /* resolved, but the other pose's axis is nearer to the truth by more than 2 degrees */
    /* Zero when unmeasured: */
    double ellipse_px = 0;
    double ellipse_share = 0;    /* of the semi-major axis */
    double centroid_px = 0;      /* of the inner part from the true centroid of the disc's image; NaN without one */
    cv::Vec3d position_m = {};   /* measured - true */
    cv::Vec2d angles_rad = {};   /* yaw and pitch, measured - true */
    double axis_deg = 0;         /* angle between measured and true axis, of the pose reported */
    bool has_covariance = false; /* the library gave one, and it is positive definite */
    double nees = 0;             /* e' C^-1 e over x, y, z, yaw, pitch; 5 on average when calibrated */
    double nees_position = 0;    /* the same over x, y, z: 3 */
    double nees_angles = 0;      /* over yaw and pitch: 2 */
    cv::Vec3d percent() const;   /* |x|, |y|, |z| error in % of the distance */
    double percent_mean() const; /* mean of the three */
};

Outcome judge(const Trial &t, const Measurement &m);

struct RunOptions {
    int threads = 0;        /* 0: as many as the machine has */
    std::string cache;      /* folder of rendered regions, reused; none when empty */
    std::string processing; /* of every picture (processing.hpp); none when empty */
    double side = 1;        /* of the region, in parts of the trial's; unless 1 the picture reaches beyond both */
    std::function<void(size_t, size_t)> progress; /* called with done and total, from one thread at a time */
    /* Called for every trial, from one thread at a time, in no fixed order. */
    std::function<void(const Trial &, const cv::Mat &region, const Measurement &, const Outcome &)> inspect;
};

/* The trial's region as the sensor gives it; from the cache when it is there. */
cv::Mat picture_of(const Trial &t, const std::string &cache);

/* Outcomes in the order of the trials. */
std::vector<Outcome> run_trials(const std::vector<Trial> &trials, const RunOptions &options);

/* Figures over a set of outcomes; errors are over right ones, NaN where there are none. */
struct Summary {
    int scenes = 0, right = 0, wrong = 0, unmeasured = 0;
    int no_inner = 0;   /* measured without the inner part */
    int unresolved = 0; /* measured, orientation left open */
    int twin = 0;
    std::map<std::string, int> statuses; /* of the unmeasured */
    cv::Vec3d median_percent, mean_percent;
    double median_position = 0, mean_position = 0; /* of the mean over x, y, z */
    double median_axis = 0, mean_axis = 0;         /* degrees */
    double p90_axis = 0;
    int with_covariance = 0; /* right, resolved, with a covariance */
    double mean_nees = 0, median_nees = 0, mean_nees_position = 0, mean_nees_angles = 0;
};
Summary summarise(const std::vector<Outcome> &outcomes);

/* The region enlarged: truth in green, measurement in red. */
cv::Mat overlay(const Trial &t, const cv::Mat &region, const Measurement &m);

} // namespace accuracy
