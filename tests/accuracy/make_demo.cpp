/* SPDX-License-Identifier: Apache-2.0 */
/* Writes the pictures of vectors/frame with their truth beside them, or checks that they are still the same.
 *
 *  make_demo DIR          write
 *  make_demo --check DIR  compare: text exactly, pixels to 1 grey level (another C library's last bits) */
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include <opencv2/imgcodecs.hpp>

#include "scene.hpp"

using namespace accuracy;

namespace {

struct Frame {
    std::string name;
    Scene scene;
    cv::Rect crop; /* of the scene's camera */
};

double radians(double degrees) { return degrees * CV_PI / 180; }
double degrees(double radians) { return radians * 180 / CV_PI; }

std::array<Frame, 4> frames()
{
    std::array<Frame, 4> f;

    Scene demo;
    demo.seed = 6;
    demo.pose = {{-0.6, 0.4, 6}, axis_of(radians(14), radians(-9))};
    demo.look.canopy_grey = 68;
    demo.look.rib_gain = 1.35;
    demo.look.ambient = 0.6;
    demo.background = {165, 225, 34, 320, 5};
    f[0] = {"demo", demo, {620, 880, 640, 480}};

    Scene ground;
    ground.seed = 7;
    ground.pose = {{0.5, 0.3, 5}, axis_of(radians(-11), radians(-6))};
    ground.look = Look::bright();
    ground.background = Background::ground();
    f[1] = {"bright_ground", ground, {960, 910, 360, 360}};

    Scene cloud;
    cloud.seed = 8;
    cloud.pose = {{-1.2, -0.9, 10}, axis_of(radians(5), radians(17))};
    cloud.background = Background::cloud();
    f[2] = {"cloud", cloud, {740, 800, 240, 180}};

    Scene far;
    far.seed = 9;
    far.pose = {{2.1, 1.4, 22}, axis_of(radians(-16), radians(-8))};
    far.background = Background::sky();
    f[3] = {"far", far, {1100, 1060, 128, 96}};
    return f;
}

std::string format(const char *form, ...) __attribute__((format(printf, 1, 2)));

std::string format(const char *form, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, form);
    std::vsnprintf(text, sizeof text, form, arguments);
    va_end(arguments);
    return text;
}

/* Truth in the picture's own pixels. */
std::string sidecar(const Frame &frame)
{
    Scene s = frame.scene;
    s.camera = s.camera.cropped(frame.crop.tl());
    const Ellipse e = s.rim();
    const Drogue &d = s.drogue;
    const cv::Point2d inner = s.camera.project(s.inner_centre_m());
    const cv::Vec3d &p = s.pose.position_m;
    const cv::Vec3d &n = s.pose.axis;
    const int side = cvRound(2.5 * e.a_px);
    return format("{\n  \"image\": \"%s.png\",\n  \"width_px\": %d,\n  \"height_px\": %d,\n", frame.name.c_str(),
                  frame.crop.width, frame.crop.height) +
           format("  \"camera\": { \"fx_px\": %.6f, \"fy_px\": %.6f, \"cx_px\": %.6f, \"cy_px\": %.6f },\n",
                  s.camera.fx_px, s.camera.fy_px, s.camera.cx_px, s.camera.cy_px) +
           format("  \"drogue\": { \"rim_radius_m\": %.6f, \"inner_radius_m\": %.6f, \"inner_depth_m\": %.6f },\n",
                  d.rim_radius_m, d.inner_radius_m, d.inner_depth_m) +
           format("  \"region\": { \"x_px\": %d, \"y_px\": %d, \"width_px\": %d, \"height_px\": %d },\n",
                  cvRound(e.xc_px - (side - 1) / 2.0), cvRound(e.yc_px - (side - 1) / 2.0), side, side) +
           format("  \"position_m\": [%.6f, %.6f, %.6f],\n  \"axis\": [%.6f, %.6f, %.6f],\n", p[0], p[1], p[2], n[0],
                  n[1], n[2]) +
           format("  \"yaw_deg\": %.6f,\n  \"pitch_deg\": %.6f,\n", degrees(yaw_of(n)), degrees(pitch_of(n))) +
           format("  \"ellipse\": { \"xc_px\": %.6f, \"yc_px\": %.6f, \"a_px\": %.6f, \"b_px\": %.6f, "
                  "\"angle_deg\": %.6f },\n",
                  e.xc_px, e.yc_px, e.a_px, e.b_px, degrees(e.angle_rad)) +
           format("  \"inner_centre_px\": [%.6f, %.6f]\n}\n", inner.x, inner.y);
}

void write(const std::string &folder, const Frame &frame)
{
    const std::string stem = folder + "/" + frame.name;
    std::ofstream out(stem + ".json", std::ios::binary);
    out << sidecar(frame);
    out.close();
    if (!out || !cv::imwrite(stem + ".png", render(frame.scene, frame.crop), {cv::IMWRITE_PNG_COMPRESSION, 9})) {
        throw std::runtime_error("cannot write " + stem + ".*");
    }
}

/* True when the files hold what write() would write. */
bool check(const std::string &folder, const Frame &frame)
{
    const std::string stem = folder + "/" + frame.name;
    std::ifstream in(stem + ".json", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const cv::Mat stored = cv::imread(stem + ".png", cv::IMREAD_UNCHANGED);
    const bool text_same = text == sidecar(frame);
    const bool pixels_same = stored.type() == CV_8UC1 && stored.size() == frame.crop.size() &&
                             cv::norm(stored, render(frame.scene, frame.crop), cv::NORM_INF) <= 1;
    std::printf("%-14s truth %s, picture %s\n", frame.name.c_str(), text_same ? "same" : "DIFFERS",
                pixels_same ? "same" : "DIFFERS");
    return text_same && pixels_same;
}

} // namespace

int main(int argc, char **argv)
{
    const bool checking = argc == 3 && std::strcmp(argv[1], "--check") == 0;
    if (!checking && argc != 2) {
        std::fputs("usage: make_demo [--check] DIR\n", stderr);
        return 2;
    }
    const std::string folder = argv[argc - 1];
    bool good = true;
    try {
        for (const Frame &frame : frames()) {
            if (checking) {
                good = check(folder, frame) && good;
            } else {
                write(folder, frame);
            }
        }
    } catch (const std::exception &e) {
        std::fprintf(stderr, "make_demo: %s\n", e.what());
        return 2;
    }
    return good ? 0 : 1;
}
