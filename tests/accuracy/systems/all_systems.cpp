/* SPDX-License-Identifier: Apache-2.0 */
/* The list of systems, and all of them on one scene. */
#include "all_systems.hpp"

#include <cmath>
#include <ctime>
#include <functional>

#include <opencv2/calib3d.hpp>

#include "beacons.hpp"
#include "detectors.hpp"
#include "evaluate.hpp"
#include "measure.hpp"
#include "stereo.hpp"

namespace accuracy {

namespace {

constexpr const char *nothing = "nothing";
constexpr const char *camera = "camera";
constexpr const char *lamps = "8 lamps";

void add_single(std::vector<System> &list)
{
    list.push_back({"ours", Sensors::one_camera, 0, nothing, camera});
    for (const char *name : {"Martinez", "Yin", "Ma, Zhao", "Sun", "Shiu, Ahmad"}) {
        list.push_back({name, Sensors::one_camera, 0, nothing, camera});
    }
    for (const OutlineDetector &d : outline_detectors()) {
        list.push_back({d.name, Sensors::one_camera, 0, nothing, camera});
    }
}

void add_marks(std::vector<System> &list, double noise_px)
{
    list.push_back(
        {"VisNav", Sensors::marks, noise_px, "8 lamps, each of a frequency of its own", "position-sensing diode"});
    list.push_back({"Pollini", Sensors::marks, noise_px, lamps, "camera with infrared filter"});
    list.push_back({"Meng", Sensors::marks, noise_px, "8 lamps that can be told apart", camera});
    list.push_back({"Wang", Sensors::marks, noise_px, "coloured ring, 5 cm wide", "colour camera"});
    list.push_back({"solvePnP, ITERATIVE", Sensors::stand_in, noise_px, lamps, camera});
    list.push_back({"solvePnP, SQPNP", Sensors::stand_in, noise_px, lamps, camera});
    list.push_back({"solvePnP, IPPE", Sensors::stand_in, noise_px, "5 lamps on the rim", camera});
}

std::vector<System> build()
{
    std::vector<System> list;
    add_single(list);
    for (const double noise_px : mark_noises_px) {
        add_marks(list, noise_px);
    }
    list.push_back({"Duan", Sensors::two_cameras, 0, nothing, "two cameras, 0.5 m apart"});
    list.push_back({"Xu", Sensors::two_cameras, 0, nothing, "two cameras, 0.5 m apart"});
    list.push_back({"Chen", Sensors::range, 0, nothing, "3D flash lidar, 128 x 128"});
    return list;
}

Estimate ours(const Measurement &m)
{
    Estimate e;
    e.ok = e.has_axis = m.ok;
    e.position_m = m.pose.position_m;
    e.axis = m.pose.axis;
    return e;
}

/* A picture as large as the sensor with the region in its place. */
cv::Mat placed(const Scene &scene, const cv::Mat &region, const cv::Rect &at)
{
    cv::Mat image = cv::Mat::zeros(scene.image_px, CV_8U);
    region.copyTo(image(at));
    return image;
}

/* Where a detector would send the right camera's measurement: as far off as the left one's. */
cv::Rect right_region(const Trial &t, const Scene &right)
{
    const Ellipse rim = right.rim();
    const cv::Point shift(static_cast<int>(std::lround(rim.xc_px - t.rim.xc_px)),
                          static_cast<int>(std::lround(rim.yc_px - t.rim.yc_px)));
    return t.region + shift;
}

/* Collects estimates with their times, in the order of all_systems(). */
class Collector {
public:
    void add(const std::function<Estimate()> &run, double before_ms = 0)
    {
        const double begin = thread_ms();
        all.estimates.push_back(run());
        all.ms.push_back(before_ms + thread_ms() - begin);
    }
    SceneEstimates all;
};

void run_marks(Collector &c, const Trial &t, const Body &body, double noise_px)
{
    const Camera &cam = t.scene.camera;
    Random random(hash_at(t.scene.seed, 17, std::lround(noise_px * 1000)));
    const double roll = random.uniform(-CV_PI, CV_PI);
    const std::vector<cv::Point2d> seen = see_lamps(cam, t.pose, roll, noise_px, random);
    const std::vector<cv::Point2d> outer = see_circle(cam, t.pose, body.rim_radius_m, noise_px, random);
    const std::vector<cv::Point2d> inner = see_circle(cam, t.pose, ring_inner_radius_m, noise_px, random);
    c.add([&] { return visnav(seen, cam); });
    c.add([&] { return pollini(seen, cam); });
    c.add([&] { return meng(seen, cam); });
    c.add([&] { return wang(outer, inner, cam, body.rim_radius_m); });
    c.add([&] { return opencv_pnp(seen, cam, cv::SOLVEPNP_ITERATIVE, false); });
    c.add([&] { return opencv_pnp(seen, cam, cv::SOLVEPNP_SQPNP, false); });
    c.add([&] { return opencv_pnp(seen, cam, cv::SOLVEPNP_IPPE, true); });
}

} // namespace

const std::vector<System> &all_systems()
{
    static const std::vector<System> list = build();
    return list;
}

double thread_ms()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

SceneEstimates estimate_all(const Trial &t, const std::string &cache)
{
    const Camera &cam = t.scene.camera;
    const Body body = body_of(t.model);
    const cv::Mat picture = picture_of(t, cache);
    const cv::Mat image = placed(t.scene, picture, t.region);
    Collector c;

    /* One camera. */
    const double begin = thread_ms();
    const Measurement m = measure(image, cam, t.model, t.region);
    const double measured_ms = thread_ms() - begin;
    const Features features = m.ok ? features_of(m, image) : Features();
    const double features_ms = thread_ms() - begin;
    c.add([&] { return ours(m); }, measured_ms);
    using Rule = Estimate (*)(const Features &, const Camera &, const Body &);
    for (const Rule rule : {Rule(martinez), Rule(yin), Rule(ma_zhao), Rule(sun), Rule(shiu_ahmad)}) {
        c.add([&] { return m.ok ? rule(features, cam, body) : Estimate(); }, rule == sun ? features_ms : measured_ms);
    }
    for (const OutlineDetector &d : outline_detectors()) {
        c.add([&] {
            Features f = features; /* the inner part is ours, to choose between the two poses */
            if (!choose_outline(f.outer, d.detect(picture), picture)) {
                return Estimate();
            }
            f.outer.xc_px += t.region.x;
            f.outer.yc_px += t.region.y;
            return shiu_ahmad(f, cam, body);
        });
    }

    for (const double noise_px : mark_noises_px) {
        run_marks(c, t, body, noise_px);
    }

    /* Two cameras. */
    const Scene right = seen_from_right(t.scene);
    const cv::Rect region = right_region(t, right) & cv::Rect({0, 0}, right.image_px);
    const cv::Mat right_image = placed(right, render(right, region), region);
    const double right_begin = thread_ms();
    const Measurement r = measure(right_image, cam, t.model, region);
    const double both_ms = measured_ms + thread_ms() - right_begin;
    const Features right_features = r.ok ? features_of(r, right_image) : Features();
    const bool both = m.ok && r.ok;
    c.add([&] { return both ? duan(features, right_features, cam, body) : Estimate(); }, both_ms);
    c.add([&] { return both ? xu(features, right_features, cam, body) : Estimate(); }, both_ms);

    const cv::Mat range = lidar_range(t.scene, lidar_noise_m);
    c.add([&] { return chen(range, body, t.scene.seed); });
    return c.all;
}

} // namespace accuracy
