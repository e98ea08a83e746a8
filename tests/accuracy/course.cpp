/* SPDX-License-Identifier: Apache-2.0 */
/* Sequences for the tracker, and how it did. */
#include "course.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include <opencv2/imgproc.hpp>

#include "tracker.hpp"

namespace accuracy {

namespace {

constexpr double turns = 2 * CV_PI;
constexpr double frames_per_second = 50;
const cv::Size image_px = {1280, 720};

/* One sine of a motion across or down. */
struct Sine {
    double amplitude_m, hertz, phase_rad; /* of an angle: rad */
    double at(double t) const { return amplitude_m * std::sin(turns * hertz * t + phase_rad); }
};

/* What a course is made of; times in seconds. */
struct Plan {
    int frames = 300;
    double from_m = 8, to_m = 8;
    std::vector<Sine> across, down;
    std::vector<Sine> yaw, pitch; /* of the camera, rad for m */
    double down_m = 0;            /* the drogue goes down by so much and comes back, every 4 s */
    double turn_per_m = 0.2;      /* rad that the axis turns a metre of motion */
    double tilt_yaw = 0, tilt_pitch = 0.08;
    double blank_share = 0;
    int gap_from = 0, gap_frames = 0;
    bool probe = false, bar = false, light_steps = false, sun = false;
    double blur_px = 0, noise = 2;
    Ground ground = Ground::sky;
    bool discs = false, crossed = false;
};

Plan plan_of(const std::string &name, Random &random, int index)
{
    Plan p;
    const auto phase = [&] { return random.uniform(0, turns); };
    p.tilt_yaw = random.uniform(-0.2, 0.2);
    p.tilt_pitch = random.uniform(-0.2, 0.2);
    p.ground = static_cast<Ground>(index % 4);
    p.across = {{0.1, 0.2, phase()}};
    p.down = {{0.07, 0.15, phase()}};
    if (name == "A") {
        p.frames = 350;
        p.from_m = 25;
        p.to_m = 4;
    } else if (name == "B0") {
        p.across = {{0.2, 0.3, phase()}, {0.1, 0.8, phase()}};
        p.down = {{0.2, 0.25, phase()}, {0.08, 0.7, phase()}};
    } else if (name == "B") {
        p.across = {{0.25, 0.4, phase()}, {0.15, 0.9, phase()}, {0.1, 1.5, phase()}};
        p.down = {{0.25, 0.3, phase()}, {0.15, 0.8, phase()}, {0.1, 1.4, phase()}};
    } else if (name == "B2") {
        p.across = {{0.5, 1.5, phase()}};
        p.down = {{0.35, 1.5, phase()}};
    } else if (name == "C") {
        p.from_m = p.to_m = 10;
        p.across = {{0.3, 0.25, phase()}};
        p.down = {{0.2, 0.2, phase()}};
        p.blank_share = 0.3;
        p.gap_from = 150;
        p.gap_frames = 20;
    } else if (name == "D") {
        p.to_m = 5;
        p.probe = index % 2 == 0;
        p.bar = !p.probe;
    } else if (name == "E") {
        p.light_steps = true;
        p.to_m = 6;
    } else if (name == "E2") {
        p.sun = true;
        p.across = {{0.15, 0.3, phase()}};
    } else if (name == "F") {
        p.across = {{1.3, 0.3, phase()}};
        p.crossed = true;
    } else if (name == "F2") {
        p.frames = 400;
        p.down_m = 1.9;
        p.discs = true;
    } else if (name == "G") {
        p.across = {{0.2, 0.4, phase()}};
        p.blur_px = 6;
        p.noise = 6;
    } else if (name == "H") {
        p.frames = 250;
        p.from_m = 45;
        p.to_m = 15;
    } else if (name == "S") { /* 4 and 2 px */
        p.from_m = 18;
        p.to_m = 5;
        p.yaw = {{0.0036, 6.3, phase()}, {0.0018, 10.7, phase()}};
        p.pitch = {{0.0036, 7.1, phase()}, {0.0018, 11.9, phase()}};
    } else {
        throw std::invalid_argument("no course " + name);
    }
    return p;
}

double sum_at(const std::vector<Sine> &sines, double t)
{
    double sum = 0;
    for (const Sine &s : sines) {
        sum += s.at(t);
    }
    return sum;
}

/* A vector as the camera sees it that has turned. */
cv::Vec3d turned(const cv::Vec3d &v, double yaw, double pitch)
{
    const cv::Vec3d u(v[0] * std::cos(yaw) - v[2] * std::sin(yaw), v[1], v[0] * std::sin(yaw) + v[2] * std::cos(yaw));
    return {u[0], u[1] * std::cos(pitch) - u[2] * std::sin(pitch), u[1] * std::sin(pitch) + u[2] * std::cos(pitch)};
}

Pose pose_at(const Plan &p, double t)
{
    const double x = sum_at(p.across, t);
    const double y = sum_at(p.down, t) + p.down_m * (1 - std::cos(turns * t / 4));
    const double z = p.from_m + (p.to_m - p.from_m) * t * frames_per_second / p.frames;
    const double yaw = sum_at(p.yaw, t), pitch = sum_at(p.pitch, t);
    const cv::Vec3d axis = axis_of(p.tilt_yaw + p.turn_per_m * x, p.tilt_pitch + p.turn_per_m * std::min(y, 1.0));
    return {turned({x, y, z}, yaw, pitch), turned(axis, yaw, pitch)};
}

/* Glow of the sun about a point: saturated in the middle. */
void add_sun(cv::Mat &light, const cv::Point2d &at, double radius)
{
    const int reach = static_cast<int>(4 * radius);
    const cv::Rect part =
        cv::Rect(static_cast<int>(at.x) - reach, static_cast<int>(at.y) - reach, 2 * reach, 2 * reach) &
        cv::Rect({0, 0}, light.size());
    for (int y = part.y; y < part.y + part.height; y++) {
        for (int x = part.x; x < part.x + part.width; x++) {
            const double d2 = ((x - at.x) * (x - at.x) + (y - at.y) * (y - at.y)) / (radius * radius);
            light.at<float>(y, x) += static_cast<float>(300 * std::exp(-3 * d2) + 40 * std::exp(-0.4 * d2));
        }
    }
}

void put_before(Probe &probe, const Plan &p, const Ellipse &rim, double t, double grey)
{
    const cv::Point2d centre(rim.xc_px, rim.yc_px);
    const double a = rim.a_px;
    probe.grey = grey;
    if (p.probe) {
        const double off = 0.6 + 0.35 * std::sin(turns * 0.31 * t);
        const double angle = 1.1 + 0.4 * std::sin(turns * 0.17 * t);
        probe.tip_px = centre + off * a * cv::Point2d(std::cos(angle), std::sin(angle));
        probe.root_px = centre + 8 * a * cv::Point2d(std::cos(angle + 0.1), std::sin(angle + 0.1));
        probe.half_width_px = 0.12 * a;
    } else {
        const double off = 0.7 * std::sin(turns * 0.23 * t);
        probe.tip_px = centre + a * cv::Point2d(off - 0.3, -6);
        probe.root_px = centre + a * cv::Point2d(off + 0.3, 6);
        probe.half_width_px = 0.07 * a;
    }
}

/* Frames of a plan, without those of the cache. */
cv::Mat render_frame(const Plan &p, Scene scene, const CourseFrame &frame, int i, double gain, double grey,
                     uint64_t seed)
{
    const double t = i / frames_per_second;
    scene.pose = frame.truth;
    const bool blank = scene.pose.position_m[2] < 0;
    if (p.probe || p.bar) {
        put_before(scene.probe, p, scene.rim(), t, grey);
    }
    if (p.blur_px > 0) {
        const cv::Vec3d v = pose_at(p, t + 0.01).position_m - pose_at(p, t).position_m;
        scene.sensor.motion_length_px = p.blur_px;
        scene.sensor.motion_angle_rad = std::atan2(v[1], v[0]);
    }
    cv::Mat light = blank ? scene.background.plate.clone() : light_of(scene);
    if (p.sun) {
        const Ellipse rim = project_circle(scene.camera, pose_at(p, 0), scene.drogue.rim_radius_m, 0);
        add_sun(light, {rim.xc_px + 1.1 * rim.a_px, rim.yc_px - 0.5 * rim.a_px}, 0.45 * rim.a_px);
    }
    return exposed(light, gain, p.noise, hash_at(seed, i, 3));
}

bool read_frames(Course &course, const std::string &path)
{
    std::ifstream in(path, std::ios::binary);
    for (CourseFrame &f : course.frames) {
        f.image.create(image_px, CV_8U);
        if (!in.read(reinterpret_cast<char *>(f.image.data), image_px.area())) {
            return false;
        }
    }
    return true;
}

void write_frames(const Course &course, const std::string &path)
{
    std::ofstream out(path, std::ios::binary);
    for (const CourseFrame &f : course.frames) {
        out.write(reinterpret_cast<const char *>(f.image.data), image_px.area());
    }
}

bool within(const Ellipse &rim)
{
    return rim.xc_px - rim.a_px > 2 && rim.yc_px - rim.a_px > 2 && rim.xc_px + rim.a_px < image_px.width - 3 &&
           rim.yc_px + rim.a_px < image_px.height - 3;
}

double nees_of(const drogue_result &r, const Pose &truth)
{
    cv::Matx<double, 5, 5> c;
    cv::Matx<double, 5, 1> e, solved;
    const auto error = pose_error(pose_of(r.pose), truth);
    for (int i = 0; i < 5; i++) {
        e(i) = i < 3 ? error[i] : std::remainder(error[i], turns);
        for (int j = 0; j < 5; j++) {
            c(i, j) = std::ldexp(static_cast<double>(r.covariance_q48[i][j]), r.covariance_halved - 48);
        }
    }
    return cv::solve(c, e, solved, cv::DECOMP_CHOLESKY) ? e.dot(solved) : 1e6;
}

} // namespace

const std::vector<std::string> &course_names()
{
    static const std::vector<std::string> names = {"A", "B0", "B", "B2", "C", "D", "E", "E2", "F", "F2", "G", "H", "S"};
    return names;
}

Course make_course(const std::string &name, const CourseOptions &o)
{
    uint64_t seed = hash_at(o.seed, o.index, o.variety.held_out ? 91 : 90);
    for (const char c : name) {
        seed = hash_at(seed, c, 0);
    }
    Random random(seed);
    const Plan p = plan_of(name, random, o.index);
    Course course;
    Scene &s = course.scene;
    s.image_px = image_px;
    s.camera = {o.variety.held_out ? 1250.0 : 1100.0, o.variety.held_out ? 1250.0 : 1100.0, 639.5, 359.5};
    if (name == "H") { /* a longer lens: 9 px at least */
        s.camera.fx_px = s.camera.fy_px = 1800;
    }
    s.seed = seed;
    s.coarse = true;
    s.sensor.blur_px = random.uniform(0.5, 0.9);
    cv::Mat painted = paint_ground(random, p.ground, image_px);
    draw_drogue(s, random, cv::mean(painted(cv::Rect(400, 200, 480, 320)))[0], o.variety);
    const double scale = s.camera.fx_px / p.from_m;
    if (p.crossed) {
        for (const double side : {-0.75, 0.75}) {
            const double r = scale * s.drogue.inner_radius_m * random.uniform(0.9, 1.6);
            cv::circle(painted, cv::Point(static_cast<int>(639 + side * scale), 360), static_cast<int>(r), 20,
                       cv::FILLED, cv::LINE_AA);
        }
    }
    if (p.discs) {
        paint_discs(painted, random, {});
        paint_discs(painted, random, {});
    }
    s.background.plate = plate_of(painted, s.sensor.blur_px);
    double gain = 1;
    const double probe_grey = random.uniform(30, 230);
    std::vector<double> gains;
    for (int i = 0; i < p.frames; i++) {
        CourseFrame f;
        f.truth = pose_at(p, i / frames_per_second);
        const bool blank =
            (i > 0 && random.uniform(0, 1) < p.blank_share) || (i >= p.gap_from && i < p.gap_from + p.gap_frames);
        f.visible = !blank && within(project_circle(s.camera, f.truth, s.drogue.rim_radius_m, 0));
        if (blank) {
            f.truth.position_m[2] = -1000;
        }
        if (p.light_steps && i % 17 == 16) {
            gain = random.uniform(0.4, 1.6);
        }
        gains.push_back(gain);
        course.frames.push_back(f);
    }
    const std::string path = o.cache.empty() ? "" : o.cache + "/" + name + "_" + std::to_string(seed) + ".raw";
    if (path.empty() || !read_frames(course, path)) {
        for (int i = 0; i < p.frames; i++) {
            CourseFrame &f = course.frames[static_cast<size_t>(i)];
            f.image = render_frame(p, s, f, i, gains[static_cast<size_t>(i)], probe_grey, seed);
        }
        if (!path.empty()) {
            write_frames(course, path);
        }
    }
    return course;
}

void CourseScore::operator+=(const CourseScore &o)
{
    frames += o.frames;
    visible += o.visible;
    right += o.right;
    false_frames += o.false_frames;
    wrong_twins += o.wrong_twins;
    resolved += o.resolved;
    known += o.known;
    gated += o.gated;
    first_right = std::max(first_right, o.first_right);
    again_right = std::max(again_right, o.again_right);
    compared += o.compared;
    raw2 += o.raw2;
    filtered2 += o.filtered2;
    axis_raw2 += o.axis_raw2;
    axis_filtered2 += o.axis_filtered2;
    axes += o.axes;
    velocity2 += o.velocity2;
    velocities += o.velocities;
    z_share2 += o.z_share2;
    nees_raw += o.nees_raw;
    nees_filtered += o.nees_filtered;
    nees_frames += o.nees_frames;
}

namespace {

/* Errors of a frame that was measured and believed. */
void add_errors(CourseScore &s, const SequenceFrame &f, const drogue_result &r, const Pose &truth, bool known)
{
    const auto raw = pose_error(f.raw, truth);
    const auto filtered = pose_error(f.filtered, truth);
    double nees = 0;
    s.raw2 += raw.mul(raw);
    s.filtered2 += filtered.mul(filtered);
    s.z_share2 += std::pow(raw[2] / truth.position_m[2], 2);
    s.compared++;
    if (r.orientation_resolved && known) {
        s.axis_raw2 += std::pow(angle_between_deg(f.raw.axis, truth.axis), 2);
        s.axis_filtered2 += std::pow(angle_between_deg(f.filtered.axis, truth.axis), 2);
        s.axes++;
    }
    for (int k = 0; k < 5; k++) {
        nees += std::pow(filtered[k] / f.filtered_std[k], 2) / 5;
    }
    s.nees_filtered += nees;
    s.nees_raw += nees_of(r, truth) / 5;
    s.nees_frames++;
}

} // namespace

CourseScore run_course(const Course &course)
{
    Tracker tracker(course.scene);
    CourseScore s;
    int waiting = 0; /* frames in sight and not right since the drogue came in sight */
    bool held = false, ever = false;
    for (size_t i = 0; i < course.frames.size(); i++) {
        const CourseFrame &frame = course.frames[i];
        const drogue_image view = {frame.image.data, frame.image.cols, frame.image.rows,
                                   static_cast<int32_t>(frame.image.step)};
        drogue_result result;
        drogue_track_estimate estimate;
        tracker.frame(result, view, static_cast<uint32_t>(1e6 / frames_per_second));
        drogue_track_get(&estimate, &tracker.track);
        const SequenceFrame f = describe(tracker.track, result);
        const bool tracking = f.state == DROGUE_TRACKING;
        const double range = cv::norm(frame.truth.position_m);
        const bool near = cv::norm(f.filtered.position_m - frame.truth.position_m) < 0.03 * range;
        const bool known = estimate.orientation_resolved != 0;
        const bool off = known && angle_between_deg(f.filtered.axis, frame.truth.axis) > 10;
        const bool right = frame.visible && tracking && near && !off;
        s.frames++;
        s.visible += frame.visible;
        s.right += right;
        s.false_frames += tracking && !near;
        s.wrong_twins += tracking && near && off;
        s.resolved += frame.visible && f.measured && result.orientation_resolved;
        s.known += frame.visible && tracking && known;
        s.gated += f.gated;
        if (right) {
            held = ever = true;
            waiting = 0;
        } else if (frame.visible && !held) {
            waiting++;
            int &worst = ever ? s.again_right : s.first_right;
            worst = std::max(worst, waiting);
        }
        if (!frame.visible) {
            held = false;
            waiting = 0;
        }
        if (right && f.measured && !f.gated && i >= 10) {
            add_errors(s, f, result, frame.truth, known);
            const cv::Vec3d v = (course.frames[std::min(i + 1, course.frames.size() - 1)].truth.position_m -
                                 course.frames[i - 1].truth.position_m) *
                                (frames_per_second / 2);
            if (course.frames[i - 1].visible && i + 1 < course.frames.size() && course.frames[i + 1].visible) {
                for (int k = 0; k < 2; k++) {
                    s.velocity2 += std::pow(from_q16(estimate.velocity_mps_q16[k]) - v[k], 2) / 2;
                }
                s.velocities++;
            }
        }
    }
    return s;
}

} // namespace accuracy
