/* SPDX-License-Identifier: Apache-2.0 */
/* Self-test of the baselines: on exact projections each must give what its own assumption makes exact, and miss by
 * what the assumption costs. */
#include <array>
#include <cmath>
#include <cstdio>

#include "baselines.hpp"
#include "check.hpp"
#include "scene.hpp"

using namespace accuracy;

namespace {

const Camera camera = {1465.5, 1465.5, 1023.5, 1023.5};
const Camera oblong = {900, 1100, 640, 300}; /* pixels that are not square */
const Body body = {0.35, 0.12, 0.25};

/* Noise-free features. The inner part's area is its ellipse's, its centroid the image of its centre. */
Features exact(const Camera &c, const Pose &pose)
{
    Features f;
    f.outer = project_circle(c, pose, body.rim_radius_m, 0);
    f.inner = project_circle(c, pose, body.inner_radius_m, body.inner_depth_m);
    f.has_inner = f.has_inner_ellipse = true;
    f.inner_area_px = CV_PI * f.inner.a_px * f.inner.b_px;
    f.inner_px = c.project_ideal(pose.position_m + body.inner_depth_m * pose.axis);
    return f;
}

cv::Vec3d position(Random &random, double field)
{
    return random.uniform(2, 25) * cv::Vec3d(random.uniform(-field, field), random.uniform(-field, field), 1);
}

cv::Vec3d tilted(Random &random, double tilt_deg)
{
    const double tilt = tilt_deg * CV_PI / 180;
    const double towards = random.uniform(-CV_PI, CV_PI);
    return {std::sin(tilt) * std::cos(towards), std::sin(tilt) * std::sin(towards), std::cos(tilt)};
}

/* The closed form and what is built on it are exact for every pose. */
void test_circle_poses()
{
    Random random(1);
    for (int i = 0; i < 400; i++) {
        const Camera &c = i % 2 == 0 ? camera : oblong;
        const Pose pose = {position(random, 0.4), tilted(random, random.uniform(1, 30))};
        const Features f = exact(c, pose);
        std::array<Pose, 2> both;
        truth("the cone has circles", circle_poses(both, c, f.outer, body.rim_radius_m));
        for (const Pose &p : both) { /* the other pose is a true pose, too: it has the same image */
            near("image of either pose", ellipse_error_px(project_circle(c, p, body.rim_radius_m, 0), f.outer), 0,
                 1e-5);
            near("unit axis", cv::norm(p.axis), 1, 1e-12);
        }
        for (const Estimate &e : {shiu_ahmad(f, c, body), sun(f, c, body)}) {
            truth("estimate with axis", e.ok && e.has_axis);
            near("position, share of the distance", cv::norm(e.position_m - pose.position_m) / pose.position_m[2], 0,
                 1e-6);
            near("axis, degrees", angle_between_deg(e.axis, pose.axis), 0, 0.01);
        }
    }
}

/* Frontal drogues anywhere in the field: no rule loses anything, each feature being that of a frontal circle. */
void test_frontal()
{
    Random random(2);
    for (int i = 0; i < 100; i++) {
        const Pose pose = {position(random, 0.5), {0, 0, 1}};
        const Features f = exact(camera, pose);
        for (const Estimate &e : {martinez(f, camera, body), yin(f, camera, body), ma_zhao(f, camera, body),
                                  shiu_ahmad(f, camera, body), sun(f, camera, body)}) {
            truth("frontal: ok", e.ok);
            near("frontal: position, share of the distance",
                 cv::norm(e.position_m - pose.position_m) / pose.position_m[2], 0, 1e-6);
        }
    }
}

/* On the optical axis the loss of the frontal rules has a closed form for a far drogue. */
void test_tilt_on_axis()
{
    for (const double degrees : {5.0, 10.0, 15.0, 20.0, 30.0}) {
        const double t = degrees * CV_PI / 180;
        const Features f = exact(camera, {{0, 0, 1000}, axis_of(t, 0)});
        near("Martinez: 2 / (1 + cos)", martinez(f, camera, body).position_m[2] / 1000, 2 / (1 + std::cos(t)), 1e-4);
        near("Ma and Zhao: none", ma_zhao(f, camera, body).position_m[2] / 1000, 1, 1e-4);
        near("Yin: 1 / sqrt(cos)", yin(f, camera, body).position_m[2] / 1000, 1 / std::sqrt(std::cos(t)), 1e-3);
    }
}

/* Mean z error over the plain scenes' field, +-14 degrees across and down, against figures found independently on
 * fewer poses: rounded to 0.1, and with a spread of their own of about as much. */
void test_tilt_in_field()
{
    struct Row {
        double tilt_deg, martinez, ma_zhao;
    };
    const std::array<Row, 5> expected = {
        {{5, 0.6, 0.7}, {10, 1.2, 1.0}, {15, 2.1, 1.2}, {20, 3.4, 1.2}, {30, 7.0, 1.2}}};
    constexpr int poses = 20000;
    for (const Row &row : expected) {
        Random random(3);
        double sum[2] = {0, 0};
        for (int i = 0; i < poses; i++) {
            const Pose pose = {position(random, 0.25), tilted(random, row.tilt_deg)};
            const Features f = exact(camera, pose);
            sum[0] += std::fabs(martinez(f, camera, body).position_m[2] / pose.position_m[2] - 1) * 100 / poses;
            sum[1] += std::fabs(ma_zhao(f, camera, body).position_m[2] / pose.position_m[2] - 1) * 100 / poses;
        }
        std::printf("tilt %2.0f degrees: mean z error, %%: (w + h) / 2 %.2f, expected %.1f; major axis %.2f, %.1f\n",
                    row.tilt_deg, sum[0], row.martinez, sum[1], row.ma_zhao);
        near("mean z error of Martinez, %", sum[0], row.martinez, 0.15);
        near("mean z error of Ma and Zhao, %", sum[1], row.ma_zhao, 0.15);
    }
}

/* What is missing or impossible must be refused. */
void test_refusals()
{
    Features f = exact(camera, {{0.3, 0.2, 8}, axis_of(0.2, 0.1)});
    f.has_inner = f.has_inner_ellipse = false;
    truth("Yin without inner part", !yin(f, camera, body).ok);
    truth("Sun without inner ellipse", !sun(f, camera, body).ok);
    truth("Shiu and Ahmad without inner part", shiu_ahmad(f, camera, body).ok);
    f.outer.b_px = 0;
    truth("flat ellipse", !shiu_ahmad(f, camera, body).ok);
}

/* The inner outline from a picture, within what its blur and noise leave. */
void test_inner_ellipse()
{
    for (const double distance : {5.0, 12.0, 25.0}) {
        for (int i = 0; i < 4; i++) {
            Scene s;
            s.pose = {{0.05 * distance, -0.08 * distance, distance}, axis_of(0.1 * i, -0.05 * i)};
            s.seed = static_cast<uint64_t>(i) + 1;
            const Ellipse want = project_circle(s.camera, s.pose, s.drogue.inner_radius_m, s.drogue.inner_depth_m);
            const int half = static_cast<int>(3 * want.a_px) + 8;
            const cv::Rect region(static_cast<int>(want.xc_px) - half, static_cast<int>(want.yc_px) - half,
                                  2 * half + 1, 2 * half + 1);
            const cv::Point2d origin(region.tl());
            Ellipse got;
            const double level = (s.look.inner_grey + s.look.coupling_grey * s.look.ambient) / 2;
            truth("inner outline found",
                  inner_ellipse(got, render(s, region), cv::Point2d(want.xc_px, want.yc_px) - origin,
                                CV_PI * want.a_px * want.b_px, static_cast<int>(level)));
            near("inner centre x", got.xc_px + origin.x, want.xc_px, 0.15);
            near("inner centre y", got.yc_px + origin.y, want.yc_px, 0.15);
            near("inner semi-major axis", got.a_px, want.a_px, 0.3);
            near("inner semi-minor axis", got.b_px, want.b_px, 0.3);
        }
    }
    Ellipse none;
    const cv::Mat bright(100, 100, CV_8U, cv::Scalar(200));
    truth("no inner part, no outline", !inner_ellipse(none, bright, {50, 50}, 100, 100));
}

} // namespace

int main()
{
    test_circle_poses();
    test_frontal();
    test_tilt_on_axis();
    test_tilt_in_field();
    test_refusals();
    test_inner_ellipse();
    return finish("baselines_test");
}
