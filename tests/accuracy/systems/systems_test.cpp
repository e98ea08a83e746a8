/* SPDX-License-Identifier: Apache-2.0 */
/* Self-test of the related systems: without noise each must give what is exact in its theory to 0.1 %, on rendered scenes
 * each must stay within a bound of its own, and what is impossible must be refused. */
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include <opencv2/calib3d.hpp>

#include "all_systems.hpp"
#include "beacons.hpp"
#include "check.hpp"
#include "detectors.hpp"
#include "evaluate.hpp"
#include "regions.hpp"
#include "stereo.hpp"
#include "whole_frame.hpp"

using namespace accuracy;

namespace {

const Camera camera = {1465.5, 1465.5, 1023.5, 1023.5};
const Body body = {0.35, 0.12, 0.25};

Pose random_pose(Random &random)
{
    const double distance = random.uniform(3, 25);
    const cv::Vec3d place = draw_place(random, distance, 0.25);
    const double yaw = random.uniform(-0.35, 0.35);
    return {place, axis_of(yaw, random.uniform(-0.35, 0.35))};
}

void check(const std::string &what, const Estimate &e, const Pose &pose)
{
    truth((what + ": an estimate with an axis").c_str(), e.ok && e.has_axis);
    near((what + ": position, % of the distance").c_str(),
         100 * cv::norm(e.position_m - pose.position_m) / pose.position_m[2], 0, 0.1);
    near((what + ": axis, degrees").c_str(), angle_between_deg(e.axis, pose.axis), 0, 0.1);
}

/* Exact in theory: all that have marks. */
void test_marks()
{
    Random random(5);
    for (int i = 0; i < 40; i++) {
        const Pose pose = random_pose(random);
        std::vector<cv::Point2d> seen = see_lamps(camera, pose, random.uniform(-CV_PI, CV_PI), 0, random);
        check("VisNav", visnav(seen, camera), pose);
        check("Meng", meng(seen, camera), pose);
        check("SQPNP", opencv_pnp(seen, camera, cv::SOLVEPNP_SQPNP, false), pose);
        check("IPPE", opencv_pnp(seen, camera, cv::SOLVEPNP_IPPE, true), pose);
        check("Wang",
              wang(see_circle(camera, pose, body.rim_radius_m, 0, random),
                   see_circle(camera, pose, ring_inner_radius_m, 0, random), camera, body.rim_radius_m),
              pose);
        for (size_t k = seen.size() - 1; k > 0; k--) { /* Pollini is not told which is which */
            std::swap(seen[k], seen[random.next() % (k + 1)]);
        }
        check("Pollini", pollini(seen, camera), pose);
    }
}

/* With noise the errors of two ways to the same least squares must be alike, and grow with the noise. */
void test_noise()
{
    double last = 0;
    for (const double noise_px : mark_noises_px) {
        Random random(6);
        double gauss_newton = 0, object_space = 0;
        for (int i = 0; i < 200; i++) {
            const Pose pose = {{0, 0, 10}, axis_of(0.1, -0.2)};
            const std::vector<cv::Point2d> seen = see_lamps(camera, pose, 0.3, noise_px, random);
            gauss_newton += std::fabs(visnav(seen, camera).position_m[2] - 10) / 200;
            object_space += std::fabs(opencv_pnp(seen, camera, cv::SOLVEPNP_SQPNP, false).position_m[2] - 10) / 200;
        }
        near("VisNav's mean z error over SQPNP's", gauss_newton / object_space, 1, 0.1);
        truth("more noise, more error", gauss_newton > 1.5 * last);
        last = gauss_newton;
    }
}

Features exact(const Pose &pose)
{
    Features f;
    f.outer = project_circle(camera, pose, body.rim_radius_m, 0);
    f.has_inner = true;
    f.inner_px = camera.project_ideal(pose.position_m + body.inner_depth_m * pose.axis);
    return f;
}

/* Exact in theory: two cameras. */
void test_two_cameras()
{
    Random random(7);
    for (int i = 0; i < 40; i++) {
        Scene s;
        s.pose = random_pose(random);
        const Features left = exact(s.pose);
        const Features right = exact(seen_from_right(s).pose);
        check("Duan", duan(left, right, camera, body), s.pose);
        check("Xu", xu(left, right, camera, body), s.pose);
    }
    const Features same = exact({{0, 0, 8}, {0, 0, 1}});
    truth("two views from one place are refused",
          !duan(same, same, camera, body).ok && !xu(same, same, camera, body).ok);
}

/* The lidar's pixels are coarse: a tenth of one across at 0.3 degrees a pixel, and what the funnel adds along the axis. */
void test_lidar()
{
    Random random(8);
    for (int i = 0; i < 12; i++) {
        Scene s;
        s.pose = random_pose(random);
        const Estimate e = chen(lidar_range(s, 0), body, 1);
        const cv::Vec3d miss = 100 / s.pose.position_m[2] * (e.position_m - s.pose.position_m);
        truth("Chen: an estimate", e.ok && e.has_axis);
        near("Chen: x, %", miss[0], 0, 0.4);
        near("Chen: y, %", miss[1], 0, 0.4);
        near("Chen: z, %", miss[2], 0, 0.4);
        near("Chen: axis, degrees", angle_between_deg(e.axis, s.pose.axis), 0, 12);
    }
    truth("no returns, no estimate", !chen(cv::Mat(128, 128, CV_64F, cv::Scalar(std::nan(""))), body, 1).ok);
}

/* Each detector finds a rendered outline; ours, and the closed form on it, to 0.1 % without noise. */
void test_detectors()
{
    for (const double distance : {5.0, 10.0}) {
        PlainScene p = plain_scene(3, distance, 1);
        p.scene.sensor.noise = 0;
        p.scene.pose.axis =
            cv::normalize(p.scene.pose.position_m); /* for HoughCircles: an image that is almost a circle */
        const Trial t = trial_of(p, 1);
        const cv::Mat picture = picture_of(t, "");
        for (const OutlineDetector &d : outline_detectors()) {
            Ellipse e;
            truth((std::string(d.name) + ": found").c_str(), choose_outline(e, d.detect(picture), picture));
            e.xc_px += t.region.x;
            e.yc_px += t.region.y;
            near((std::string(d.name) + ": outline, px").c_str(), ellipse_error_px(e, t.rim), 0, 1.5);
        }
        cv::Mat image = cv::Mat::zeros(t.scene.image_px, CV_8U);
        picture.copyTo(image(t.region));
        const Measurement m = measure(image, t.scene.camera, t.model, t.region);
        truth("ours, without noise: measured", m.ok);
        near("ours, without noise: position, %", 100 * cv::norm(m.pose.position_m - t.pose.position_m) / distance, 0,
             0.1);
    }
    const cv::Mat even(120, 120, CV_8U, cv::Scalar(90));
    for (const OutlineDetector &d : outline_detectors()) {
        Ellipse e;
        truth((std::string(d.name) + ": nothing in an even picture").c_str(), !choose_outline(e, d.detect(even), even));
    }
}

void test_regions()
{
    const Trial t = trial_at(4, Condition::plain, 0, 8);
    const cv::Rect frame = frame_of(t);
    const cv::Mat image = whole_frame(t, frame);
    const cv::Mat even(600, 600, CV_8U, cv::Scalar(90));
    Scene view = t.scene;
    view.pose = {{0, 0, 8}, {0, 0, 1}};
    const Ellipse rim = view.rim();
    const int half = static_cast<int>(1.5 * rim.a_px);
    const cv::Rect part(static_cast<int>(rim.xc_px) - half, static_cast<int>(rim.yc_px) - half, 2 * half, 2 * half);
    const ViewMatcher matcher(render(view, part),
                              {rim.xc_px - part.x, rim.yc_px - part.y, rim.a_px, rim.b_px, rim.angle_rad});
    const auto hit = [&](const Sight &s) {
        return s.ok && suits(s.middle_px + cv::Point2d(frame.tl()), 2.5 * s.semi_axis_px, t.rim);
    };
    truth("Huang hits", hit(find_port(image, body)));
    truth("Ma hits", hit(find_nested(image, body)));
    truth("Xin hits", hit(matcher.find(image)));
    truth("nothing in an even frame",
          !find_port(even, body).ok && !find_nested(even, body).ok && !matcher.find(even).ok);
}

/* Median z error on rendered scenes at 3 and 15 m, %, of each system: two to three times what docs/systems.md
 * has, more where a few scenes scatter. */
const std::map<std::string, std::array<double, 2>> z_bounds = {
    {"ours", {0.01, 0.08}},     {"Martinez", {3, 6}},     {"Yin", {3, 11}},
    {"Ma, Zhao", {1.5, 1.5}},   {"Sun", {0.15, 0.9}},     {"Shiu, Ahmad", {0.01, 0.09}},
    {"EdgeDrawing", {0.1, 4}},  {"HoughCircles", {7, 8}}, {"contour, direct fit", {0.5, 2}},
    {"Fornaciari", {1.5, 4}},   {"Mai", {0.06, 0.5}},     {"Bai", {0.06, 0.5}},
    {"Liu, Qiao", {0.06, 0.5}}, {"Dong", {0.03, 0.2}},    {"VisNav", {0.06, 0.25}},
    {"Pollini", {0.06, 0.25}},  {"Meng", {0.06, 0.25}},   {"Wang", {0.005, 0.05}},
    {"Duan", {0.004, 0.06}},    {"Xu", {0.004, 0.06}},    {"Chen", {0.1, 0.1}},
};

void test_rendered()
{
    const std::array<double, 2> distances = {3, 15};
    for (size_t d = 0; d < distances.size(); d++) {
        std::vector<std::vector<double>> z(all_systems().size());
        for (int i = 0; i < 7; i++) {
            const Trial t = trial_of(plain_scene(11, distances[d], i), i);
            const SceneEstimates all = estimate_all(t, "");
            truth("an estimate and a time of every system",
                  all.estimates.size() == all_systems().size() && all.ms.size() == all_systems().size());
            for (size_t k = 0; k < all.estimates.size(); k++) {
                if (all.estimates[k].ok) {
                    z[k].push_back(100 * std::fabs(all.estimates[k].position_m[2] / t.pose.position_m[2] - 1));
                }
            }
        }
        for (size_t k = 0; k < all_systems().size(); k++) {
            const System &s = all_systems()[k];
            if (s.sensors == Sensors::stand_in || (s.sensors == Sensors::marks && s.noise_px != shown_noise_px)) {
                continue;
            }
            const auto bound = z_bounds.find(s.name);
            truth((s.name + " has a bound").c_str(), bound != z_bounds.end());
            truth((s.name + " gives estimates").c_str(), z[k].size() >= 3);
            if (bound != z_bounds.end()) {
                std::printf("%2.0f m, %-20s median z error %.4f %%, at most %.3f; %zu of 7\n", distances[d],
                            s.name.c_str(), median(z[k]), bound->second[d], z[k].size());
                near((s.name + ": median z error, %").c_str(), median(z[k]), 0, bound->second[d]);
            }
        }
    }
}

} // namespace

int main()
{
    std::printf("EdgeDrawing of ximgproc: %s\n", has_ximgproc ? "tested" : "not built, not tested");
    test_marks();
    test_noise();
    test_two_cameras();
    test_lidar();
    test_detectors();
    test_regions();
    test_rendered();
    return finish("systems_test");
}
