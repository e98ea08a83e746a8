/* SPDX-License-Identifier: Apache-2.0 */
/* Self-test of the renderer and of its truth: every formula against OpenCV, against points put through the other
 * way round, or against what a rendered picture shows. */
#include <cmath>
#include <cstdio>
#include <vector>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "check.hpp"
#include "scene.hpp"

using namespace accuracy;

namespace {

const Camera barrel = {842.16254, 841.36851, 510.2825,   365.61146, -0.4352204,
                       0.2898102, 0.0008622, -0.0001471, -0.1643185};

/* Point of the drogue at a depth, radius and angle about the axis. */
cv::Vec3d place(const Pose &pose, double depth, double radius, double angle)
{
    return pose.position_m + depth * pose.axis +
           radius * (std::cos(angle) * pose.first() + std::sin(angle) * pose.second());
}

Scene tilted()
{
    Scene s;
    s.pose = {{0.7, -0.4, 5}, axis_of(0.3, -0.2)};
    return s;
}

void test_camera()
{
    const cv::Matx33d k(barrel.fx_px, 0, barrel.cx_px, 0, barrel.fy_px, barrel.cy_px, 0, 0, 1);
    const cv::Vec<double, 5> d(barrel.k1, barrel.k2, barrel.p1, barrel.p2, barrel.k3);
    Random random(1);
    for (int i = 0; i < 50; i++) {
        const cv::Vec3d p(random.uniform(-1, 1), random.uniform(-0.7, 0.7), 2);
        std::vector<cv::Point2d> seen;
        cv::projectPoints(std::vector<cv::Point3d>{cv::Point3d(p)}, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), k, d, seen);
        near("project against cv::projectPoints", cv::norm(barrel.project(p) - seen[0]), 0, 1e-9);
        near("undistort inverts distort", cv::norm(barrel.undistort(seen[0]) - barrel.project_ideal(p)), 0, 1e-7);
        near("ray goes through its point", cv::norm(barrel.ray(seen[0]) - p / p[2]), 0, 1e-9);
    }
    const cv::Point2d moved = barrel.cropped({100, 50}).project({0.3, 0.2, 1});
    near("cropped camera", cv::norm(moved + cv::Point2d(100, 50) - barrel.project({0.3, 0.2, 1})), 0, 1e-9);
}

void test_pose()
{
    const cv::Vec3d n = axis_of(0.3, -0.2);
    near("axis is a unit vector", cv::norm(n), 1, 1e-12);
    near("yaw", yaw_of(n), 0.3, 1e-12);
    near("pitch", pitch_of(n), -0.2, 1e-12);
    near("positive pitch points down", axis_of(0, 0.1)[1], std::sin(0.1), 1e-12);
    const Pose pose = {{0, 0, 1}, n};
    const cv::Matx33d r(pose.first()[0], pose.first()[1], pose.first()[2], pose.second()[0], pose.second()[1],
                        pose.second()[2], n[0], n[1], n[2]);
    near("frame is orthonormal", cv::norm(r * r.t() - cv::Matx33d::eye()), 0, 1e-12);
    near("frame is right-handed", cv::determinant(r), 1, 1e-12);
    near("angle between axes", angle_between_deg(axis_of(0, 0), axis_of(0.01, 0)), 0.01 * 180 / CV_PI, 1e-9);
}

void test_ellipse()
{
    Random random(2);
    for (int i = 0; i < 20; i++) {
        Scene s;
        s.pose = {{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(3, 25)},
                  axis_of(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5))};
        const Ellipse e = s.rim();
        std::vector<cv::Point2f> outline;
        for (int j = 0; j < 64; j++) {
            const cv::Point2d p = s.camera.project(place(s.pose, 0, s.drogue.rim_radius_m, j * CV_PI / 32));
            const double direction = std::atan2(p.y - e.yc_px, p.x - e.xc_px);
            near("rim point on the ellipse", e.radius_from({e.xc_px, e.yc_px}, direction),
                 std::hypot(p.x - e.xc_px, p.y - e.yc_px), 1e-8);
            outline.push_back(cv::Point2f(p));
        }
        const cv::RotatedRect fitted = cv::fitEllipse(outline);
        near("a against cv::fitEllipse", e.a_px, std::max(fitted.size.width, fitted.size.height) / 2.0, 1e-3);
        near("b against cv::fitEllipse", e.b_px, std::min(fitted.size.width, fitted.size.height) / 2.0, 1e-3);
        const cv::Point2d end = e.at(0);
        near("angle points along a", std::atan((end.y - e.yc_px) / (end.x - e.xc_px)), std::atan(std::tan(e.angle_rad)),
             1e-9);
        truth("angle in (-pi/2, pi/2]", e.angle_rad > -CV_PI / 2 && e.angle_rad <= CV_PI / 2 && e.a_px >= e.b_px);
    }
    const Ellipse e = {10, 20, 8, 5, 0.4};
    near("error of an equal ellipse", ellipse_error_px(e, e), 0, 1e-12);
    near("error of a circle 0.1 px larger", ellipse_error_px({0, 0, 5.1, 5.1, 0}, {0, 0, 5, 5, 0}), 0.1, 1e-9);
    near("error of a circle moved 0.1 px", ellipse_error_px({0.1, 0, 50, 50, 0}, {0, 0, 50, 50, 0}), 0.2 / CV_PI, 1e-4);
    truth("error of an ellipse elsewhere", std::isinf(ellipse_error_px({30, 20, 8, 5, 0.4}, e)));
    near("outline from a point off the centre", cv::norm(e.at(1) - cv::Point2d(11, 21)),
         e.radius_from({11, 21}, std::atan2(e.at(1).y - 21, e.at(1).x - 11)), 1e-9);
}

/* Put points of each surface through the camera; the ray of that pixel must come back to the point. */
void test_trace(const Camera &camera)
{
    Scene s = tilted();
    s.camera = camera;
    s.pose.position_m = {0.2, -0.1, 3};
    const double slope = (s.drogue.coupling_radius_m - s.drogue.rim_radius_m) / s.drogue.inner_depth_m;
    for (int i = 0; i < 48; i++) {
        const double angle = (i + 0.3) * CV_PI / 24;
        const auto at = [&](double depth, double radius) {
            return trace(s, s.camera.project(place(s.pose, depth, radius, angle)));
        };
        const Hit wall = at(0.1, s.drogue.rim_radius_m + 0.1 * slope);
        truth("wall seen from inside", wall.surface == Surface::inside || wall.surface == Surface::inside_rib);
        near("wall point",
             cv::norm(wall.point_m -
                      cv::Vec3d(std::cos(angle) * (0.35 + 0.1 * slope), std::sin(angle) * (0.35 + 0.1 * slope), 0.1)),
             0, 1e-8);
        truth("inner disc", at(0.25, 0.999 * s.drogue.inner_radius_m).surface == Surface::inner);
        truth("coupling's face", at(0.25, 1.001 * s.drogue.inner_radius_m).surface == Surface::coupling);
        const Surface in = at(0, 0.9999 * s.drogue.rim_radius_m).surface;
        truth("just inside the rim", in == Surface::inside || in == Surface::inside_rib);
        const Surface out = at(0, 1.0001 * s.drogue.rim_radius_m).surface;
        truth("just outside the rim", out == Surface::background || out == Surface::hose);
    }
    const double ribs = s.drogue.ribs;
    const double mid = s.drogue.rim_radius_m + 0.05 * slope;
    truth("middle of rib 3",
          trace(s, s.camera.project(place(s.pose, 0.05, mid, 3 * 2 * CV_PI / ribs))).surface == Surface::inside_rib);
    truth("between two ribs",
          trace(s, s.camera.project(place(s.pose, 0.05, mid, 3.5 * 2 * CV_PI / ribs))).surface == Surface::inside);

    /* From the side the outside hides the inner part, and the hose comes into sight. */
    s.pose.axis = axis_of(1.2, 0);
    const cv::Vec3d near_wall = place(s.pose, 0.1, s.drogue.rim_radius_m + 0.1 * slope, 0); /* the nearest line of it */
    const Hit side = trace(s, s.camera.project(near_wall));
    truth("wall seen from outside", side.surface == Surface::outside || side.surface == Surface::outside_rib);
    near("outside point", side.point_m[2], 0.1, 1e-8);
    truth("inner disc hidden", trace(s, s.camera.project(s.inner_centre_m())).surface != Surface::inner);
    const Hit housing = trace(s, s.camera.project(place(s.pose, 0.35, s.drogue.coupling_radius_m, 0)));
    truth("housing", housing.surface == Surface::housing && std::fabs(housing.point_m[2] - 0.35) < 1e-8);
    const Hit hose = trace(s, s.camera.project(place(s.pose, 1.5, s.drogue.hose_radius_m, 0)));
    truth("hose", hose.surface == Surface::hose && std::fabs(hose.point_m[2] - 1.5) < 1e-8);
}

/* Bars before the disc and dark patches are where the scene puts them, and nowhere when it has none. */
void test_parts()
{
    Scene s = tilted();
    s.drogue.spokes = 3;
    s.drogue.spoke_width_m = 0.02;
    s.drogue.spoke_phase_rad = 0.4;
    s.drogue.patches = {{1.0, 0.3, 0.05, 0.15}, {3.1, 0.2, 0.1, 0.2}};
    const Drogue &d = s.drogue;
    const double slope = (d.coupling_radius_m - d.rim_radius_m) / d.inner_depth_m;
    const auto disc = [&](double radius, double angle) {
        return trace(s, s.camera.project(place(s.pose, d.inner_depth_m, radius, angle))).surface;
    };
    const auto wall = [&](double depth, double angle) {
        const Surface at =
            trace(s, s.camera.project(place(s.pose, depth, d.rim_radius_m + slope * depth, angle))).surface;
        return at == Surface::inside_rib ? Surface::inside : at;
    };
    for (int i = 0; i < 3; i++) {
        const double angle = 0.4 + i * 2 * CV_PI / 3;
        const double half = std::asin(0.01 / 0.1); /* of the bar, seen at a radius of 0.1 m */
        truth("middle of a spoke", disc(0.1, angle) == Surface::spoke);
        truth("within a spoke", disc(0.1, angle + 0.98 * half) == Surface::spoke);
        truth("beside a spoke", disc(0.1, angle + 1.02 * half) == Surface::inner);
        truth("beside a spoke, other side", disc(0.1, angle - 1.02 * half) == Surface::inner);
        truth("opposite a spoke", disc(0.1, angle + CV_PI) == Surface::inner);
        truth("beyond the disc", disc(0.125, angle) == Surface::coupling);
    }
    truth("patch", wall(0.1, 1.0) == Surface::patch);
    truth("patch's corners within", wall(0.051, 0.71) == Surface::patch && wall(0.149, 1.29) == Surface::patch);
    truth("above and below the patch", wall(0.049, 1.0) == Surface::inside && wall(0.151, 1.0) == Surface::inside);
    truth("beside the patch", wall(0.1, 0.69) == Surface::inside && wall(0.1, 1.31) == Surface::inside);
    truth("patch across half a turn", wall(0.15, -3.1) == Surface::patch);
    truth("beside that", wall(0.15, 3.31 - 2 * CV_PI) == Surface::inside);
    s.drogue.patches.clear();
    s.drogue.spokes = 0;
    truth("none", wall(0.1, 1.0) == Surface::inside && disc(0.1, 0.4) == Surface::inner);
}

void test_background()
{
    Scene s;
    s.background = {100, 100, 0, 64, 0};
    s.background.ramp_at_px = {1000, 500};
    s.background.ramp_per_px = {0.5, -0.25};
    near("ramp", background_grey(s, 1040, 480), 125, 1e-9);
    near("ramp stops at white", background_grey(s, 2040, 480), 255, 0);
    s.background.ramp_per_px = {0, 0};
    s.background.clutter.push_back({{300, 200}, 50, 20, CV_PI / 6, 180, true, 1});
    s.background.clutter.push_back({{800, 700}, 60, 5, CV_PI / 2, 10, false, 4});
    near("ellipse's middle", background_grey(s, 300, 200), 180, 1e-9);
    double area = 0;
    double bar = 0;
    for (int y = 0; y < 1000; y++) {
        for (int x = 0; x < 1000; x++) {
            const double more = background_grey(s, x, y) - 100;
            (x < 500 ? area : bar) += more;
        }
    }
    near("ellipse's area", area / 80, CV_PI * 50 * 20, 5);
    near("bar's area", bar / -90, 4 * 60 * 5, 20); /* soft corners */
    near("bar's length lies along y", background_grey(s, 800, 755), 10, 1e-9);
    near("bar's soft edge", background_grey(s, 805, 700), 55, 1e-9);
    near("beside the bar", background_grey(s, 808, 700), 100, 1e-9);
}

void test_light()
{
    Scene s;
    s.pose = {{0, 0, 5}, {0, 0, 1}};
    s.look = Look();
    s.look.sun = {0, 0, -1};
    const double slope = (s.drogue.coupling_radius_m - s.drogue.rim_radius_m) / s.drogue.inner_depth_m;
    const cv::Vec3d p = place(s.pose, 0.1, s.drogue.rim_radius_m + 0.1 * slope, CV_PI / s.drogue.ribs);
    const double cosine =
        -slope / std::sqrt(1 + slope * slope); /* wall's inward normal with the sun behind the camera */
    near("Lambert's law on the wall", trace(s, s.camera.project(p)).grey,
         s.look.canopy_grey * (1 - s.look.depth_loss * 0.4) * (s.look.ambient + (1 - s.look.ambient) * cosine), 1e-6);
    s.look.sun = {0, 0, 1};
    near("wall turned from the sun", trace(s, s.camera.project(p)).grey,
         s.look.canopy_grey * (1 - s.look.depth_loss * 0.4) * s.look.ambient, 1e-6);
}

/* Noise-free picture of a white disc-like drogue on black: its area and centre must be the ellipse's. */
Scene silhouette()
{
    Scene s = tilted();
    s.background = {0, 0, 0, 64, 0};
    s.look.canopy_grey = s.look.coupling_grey = s.look.inner_grey = s.look.hose_grey = 100;
    s.look.rib_gain = 1;
    s.look.depth_loss = 0;
    s.look.ambient = 1;
    s.drogue.hose_length_m = 0;
    s.sensor = Sensor();
    s.sensor.noise = 0;
    return s;
}

cv::Rect around(const Ellipse &e, double half)
{
    const int x = cvFloor(e.xc_px - half);
    const int y = cvFloor(e.yc_px - half);
    return cv::Rect(x, y, cvCeil(e.xc_px + half) - x + 1, cvCeil(e.yc_px + half) - y + 1);
}

void test_picture()
{
    for (const double distance : {3.0, 5.0, 25.0}) {
        Scene s = silhouette();
        s.pose.position_m *= distance / 5;
        for (const double blur : {0.0, 0.7}) {
            s.sensor.blur_px = blur;
            const Ellipse e = s.rim();
            const cv::Rect region = around(e, e.a_px + 6);
            const cv::Moments m = cv::moments(render_light(s, region));
            near("area of the silhouette, as radius in px", std::sqrt(m.m00 / 100 / CV_PI), std::sqrt(e.a_px * e.b_px),
                 1e-3);
            near("centre x of the silhouette", m.m10 / m.m00 + region.x, e.xc_px, 2e-3);
            near("centre y of the silhouette", m.m01 / m.m00 + region.y, e.yc_px, 2e-3);
            near("spread of the silhouette", (m.mu20 + m.mu02) / m.m00,
                 (e.a_px * e.a_px + e.b_px * e.b_px) / 4 + 2 * blur * blur + 2 / 12.0, 1e-2 * e.a_px);
        }
    }
    /* Inner part alone bright. */
    Scene s = silhouette();
    s.look.canopy_grey = s.look.coupling_grey = 0;
    const Ellipse inner = project_circle(s.camera, s.pose, s.drogue.inner_radius_m, s.drogue.inner_depth_m);
    const cv::Rect region = around(inner, inner.a_px + 6);
    const cv::Moments m = cv::moments(render_light(s, region));
    near("centre x of the inner part", m.m10 / m.m00 + region.x, inner.xc_px, 1e-3);
    near("centre y of the inner part", m.m01 / m.m00 + region.y, inner.yc_px, 1e-3);
    const cv::Point2d on_axis = s.inner_centre_ideal();
    near("inner centre off the disc's image by perspective alone",
         cv::norm(on_axis - cv::Point2d(inner.xc_px, inner.yc_px)), s.camera.fx_px * 0.0144 / 5.25 / 5.25 * 0.33, 0.1);

    /* Scallops take area away, ribs keep their place. */
    Scene cut = silhouette();
    cut.drogue.scallop_m = 0.02;
    const Ellipse e = cut.rim();
    const double area = cv::sum(render_light(cut, around(e, e.a_px + 6)))[0] / 100;
    truth("scallops cut the edge", area < 0.995 * CV_PI * e.a_px * e.b_px && area > 0.9 * CV_PI * e.a_px * e.b_px);
}

void test_sensor()
{
    Scene s = tilted();
    s.background = Background::cloud();
    const Ellipse e = s.rim();
    const cv::Rect whole = around(e, 1.2 * e.a_px);
    const cv::Rect part(whole.x + 31, whole.y + 17, 60, 80);
    const cv::Mat image = render(s, whole);
    truth("any region is the same as that part of the whole",
          cv::norm(image(part - whole.tl()), render(s, part), cv::NORM_INF) == 0);
    truth("the same again", cv::norm(image, render(s, whole), cv::NORM_INF) == 0);
    s.seed++;
    truth("another seed is another picture", cv::norm(image, render(s, whole), cv::NORM_INF) > 5);

    Scene flat;
    flat.pose.position_m = {0, 0, 1000};
    flat.background = {100, 100, 0, 64, 0};
    const cv::Rect corner(0, 0, 300, 300);
    cv::Scalar mean, sigma;
    cv::meanStdDev(render(flat, corner), mean, sigma);
    near("noise, mean", mean[0], 100, 4 * 2.0 / 300);
    near("noise with quantisation, sigma", sigma[0], std::sqrt(4 + 1 / 12.0), 0.03);
    flat.sensor.light_radius_px = 500;
    flat.sensor.light_k = 1.2;
    flat.sensor.light_at_px = {30, 40};
    near("(41) at the source", render_light(flat, corner).at<double>(40, 30), 120, 1e-9);
    near("(41) at half the radius", render_light(flat, corner).at<double>(40, 280), 60, 1e-9);

    /* Texture stays in its bounds and is not flat. */
    Scene sky;
    sky.background = Background::ground();
    double low = 1e9;
    double high = -1e9;
    for (int y = 0; y < 2048; y += 7) {
        for (int x = 0; x < 2048; x += 7) {
            const double g = background_grey(sky, x, y) - (60 - 10.0 * y / 2048);
            low = std::min(low, g);
            high = std::max(high, g);
        }
    }
    truth("texture within its amplitude", low >= -18 && high <= 18 && low < -9 && high > 9);
}

void test_motion()
{
    Scene s = silhouette();
    s.pose = {{0, 0, 25}, {0, 0, 1}};
    const Ellipse e = s.rim();
    const cv::Rect region = around(e, e.a_px + 20);
    const cv::Moments still = cv::moments(render_light(s, region));
    s.sensor.motion_length_px = 12;
    s.sensor.motion_angle_rad = CV_PI / 6;
    const cv::Moments moved = cv::moments(render_light(s, region));
    const double added = 144 / 12.0;
    near("linear blur keeps the light", moved.m00 / still.m00, 1, 1e-9);
    near("linear blur spreads along x", (moved.mu20 - still.mu20) / still.m00, added * 0.75, 0.3);
    near("linear blur spreads along y", (moved.mu02 - still.mu02) / still.m00, added * 0.25, 0.3);
    near("linear blur's direction", (moved.mu11 - still.mu11) / still.m00, added * std::sqrt(3.0) / 4, 0.3);
    near("linear blur stays in place", moved.m10 / moved.m00, still.m10 / still.m00, 1e-6);
    s.sensor.motion_length_px = 0;
    s.sensor.motion_sigma_px = 3;
    const cv::Moments soft = cv::moments(render_light(s, region));
    near("Gaussian blur spreads", (soft.mu20 - still.mu20) / still.m00, 9, 0.05);

    Scene poked = silhouette();
    poked.probe = {{1000, 900}, {1400, 1400}, 6, 33};
    near("probe", render_light(poked, cv::Rect(1200, 1150, 1, 1)).at<double>(0, 0), 33, 1e-9);
    truth("beside the probe", trace(poked, {1210, 1150}).surface != Surface::probe);
    truth("beyond the tip", trace(poked, {995, 895}).surface != Surface::probe);
}

} // namespace

int main()
{
    test_camera();
    test_pose();
    test_ellipse();
    test_trace(Camera{1465.5, 1465.5, 1023.5, 1023.5});
    test_trace(barrel);
    test_parts();
    test_background();
    test_light();
    test_picture();
    test_sensor();
    test_motion();
    return finish("scene_test");
}
