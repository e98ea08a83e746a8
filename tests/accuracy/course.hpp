/* SPDX-License-Identifier: Apache-2.0 */
/* Courses: sequences of 1280 x 720 at 50 frames a second that begin with a search of the whole image, each with what
 * a tracker has to bear. */
#pragma once

#include <map>
#include <string>
#include <vector>

#include "painted.hpp"
#include "sequence.hpp"

namespace accuracy {

/* A   approach from 25 to 4 m, light turbulence
 * B0  8 m, swing of 0.3 m up to 0.8 Hz
 * B   8 m, gusts of 0.5 m, 0.3 to 1.5 Hz
 * B2  8 m, 0.5 m, all of it at 1.5 Hz
 * C   10 m, 30 % of the frames blank, and a gap of 20 frames
 * D   8 to 5 m, a probe or a bar before the drogue
 * E   the light steps between 0.4 and 1.6
 * E2  the sun beside or over the rim
 * F   crosses two dark discs
 * F2  leaves the image and comes back, discs and rings about
 * G   motion blur of 6 px along the motion, noise of 6 grey levels
 * H   45 to 15 m */
const std::vector<std::string> &course_names();

struct CourseOptions {
    uint64_t seed = 1;
    int index = 0; /* of the sequences of this course */
    Variety variety;
    std::string cache; /* folder of rendered frames, reused; none when empty */
};

struct CourseFrame {
    cv::Mat image;
    Pose truth;
    bool visible; /* the whole rim lies in the image, and the frame is not blank */
};

struct Course {
    Scene scene; /* camera and drogue */
    std::vector<CourseFrame> frames;
};

Course make_course(const std::string &name, const CourseOptions &options);

/* Counts and sums over frames; add up. */
struct CourseScore {
    int frames = 0, visible = 0;
    int right = 0;        /* visible and tracking, within 3 % of the range and, where resolved, 10 degrees */
    int false_frames = 0; /* tracking, and farther than 3 % of the range from it or not visible at all */
    int wrong_twins = 0;  /* tracking, the orientation called resolved, more than 10 degrees off */
    int resolved = 0;     /* visible frames whose own measurement is resolved */
    int known = 0;        /* visible, tracking and the orientation called resolved */
    int gated = 0;
    int first_right = 0;                /* frames from the first visible one until right, worst of the runs */
    int again_right = 0;                /* the same after each time out of sight */
    int compared = 0;                   /* frames that count below: right, measured, resolved or not, not refused */
    cv::Vec<double, 5> raw2, filtered2; /* sums of squared errors */
    double axis_raw2 = 0, axis_filtered2 = 0; /* degrees; of those whose orientation is resolved */
    int axes = 0;
    double velocity2 = 0; /* x and y together */
    int velocities = 0;
    double z_share2 = 0;                    /* squared error of raw z over z */
    double nees_raw = 0, nees_filtered = 0; /* sums of e' C^-1 e, and of e^2 / std^2, over 5 */
    int nees_frames = 0;
    void operator+=(const CourseScore &other);
};

CourseScore run_course(const Course &course);

} // namespace accuracy
