/* SPDX-License-Identifier: Apache-2.0 */
/* Sequences through the tracker. */
#include "sequence.hpp"

#include <cmath>

#include "tracker.hpp"

namespace accuracy {

namespace {

constexpr double turns_to_rad = 2 * CV_PI;

/* A frame of which only those parts exist that were asked for. */
class LazyFrame {
public:
    explicit LazyFrame(const cv::Size &size) : image_(size, CV_8U, cv::Scalar(0)) {}

    void render_part(const Scene &scene, const cv::Rect &part)
    {
        const cv::Rect inside = part & cv::Rect({0, 0}, scene.image_px);
        if (inside.area() > 0) {
            render(scene, inside).copyTo(image_(inside));
        }
    }

    drogue_image view() const { return {image_.data, image_.cols, image_.rows, static_cast<int32_t>(image_.step)}; }

private:
    cv::Mat image_;
};

/* A region and room about it: the library may look again in a region about an outline off the middle. */
cv::Rect with_room(const drogue_region &r)
{
    const int room = r.width_px / 3;
    return {r.x_px - room, r.y_px - room, r.width_px + 2 * room, r.height_px + 2 * room};
}

/* What the tracker may look at in its next frame: 'track' is a copy. */
cv::Rect wanted(drogue_track track, uint32_t dt_us, const cv::Size &image)
{
    drogue_region region;
    drogue_track_begin(&region, &track, dt_us);
    if (track.state == DROGUE_LOST) {
        return {{0, 0}, image};
    }
    return track.search ? with_room(region) | with_room(track.reach) : with_room(region);
}

} // namespace

Pose Motion::at(double seconds) const
{
    const double yaw_per_m = 0.15; /* rad */
    const double pitch_at_rest = 0.08;
    const double half = (from_m - to_m) / 2;
    const double covered = shuttle ? half * (1 - std::cos(speed_mps * seconds / half)) : speed_mps * seconds;
    const double x = amplitude_m * std::sin(turns_to_rad * 0.2 * seconds + phase_rad);
    const double y = 0.7 * amplitude_m * std::sin(turns_to_rad * 0.15 * seconds + 1.3 * phase_rad + 1);
    return {{x, y, from_m - covered}, axis_of(yaw_per_m * x, pitch_at_rest + yaw_per_m * y)};
}

SequenceRun run_sequence(const SequenceOptions &o)
{
    const auto dt_us = static_cast<uint32_t>(std::lround(1e6 / o.frames_per_second));
    Tracker tracker(o.scene);
    LazyFrame frame(o.scene.image_px);
    Random random(o.seed);
    SequenceRun run;
    bool begun = false;
    for (int i = 0; i < o.frames; i++) {
        Scene scene = o.scene;
        const double seconds = i * (dt_us * 1e-6);
        const bool blanked = random.uniform(0, 1) < o.blanked_share;
        const drogue_track_state before = tracker.track.state;
        drogue_result result;
        scene.pose = o.motion.at(seconds);
        scene.seed = hash_at(o.seed, i, 0);
        const Pose truth = scene.pose;
        if (blanked) {
            scene.pose.position_m = {0, 0, -1000}; /* behind the camera */
        }
        frame.render_part(scene, wanted(tracker.track, dt_us, scene.image_px));
        tracker.frame(result, frame.view(), dt_us);
        SequenceFrame f = describe(tracker.track, result);
        f.seconds = seconds;
        f.truth = truth;
        f.blanked = blanked;
        run.frames.push_back(f);
        run.results.push_back(result);
        run.losses += begun && before != DROGUE_LOST && f.state == DROGUE_LOST;
        begun = begun || f.state == DROGUE_TRACKING;
        if (o.progress) {
            o.progress(static_cast<size_t>(i) + 1, static_cast<size_t>(o.frames));
        }
    }
    return run;
}

cv::Vec<double, 5> pose_error(const Pose &estimate, const Pose &truth)
{
    const cv::Vec3d d = estimate.position_m - truth.position_m;
    return {d[0], d[1], d[2], yaw_of(estimate.axis) - yaw_of(truth.axis),
            pitch_of(estimate.axis) - pitch_of(truth.axis)};
}

SequenceErrors sequence_errors(const SequenceRun &run, int settle)
{
    SequenceErrors e;
    for (size_t i = static_cast<size_t>(settle); i < run.frames.size(); i++) {
        const SequenceFrame &f = run.frames[i];
        if (f.measured && f.state == DROGUE_TRACKING) {
            const auto raw = pose_error(f.raw, f.truth);
            const auto filtered = pose_error(f.filtered, f.truth);
            e.raw += raw.mul(raw);
            e.filtered += filtered.mul(filtered);
            e.frames++;
        }
    }
    for (int k = 0; k < 5; k++) {
        e.raw[k] = std::sqrt(e.raw[k] / e.frames);
        e.filtered[k] = std::sqrt(e.filtered[k] / e.frames);
    }
    return e;
}

} // namespace accuracy
