/* SPDX-License-Identifier: Apache-2.0 */
/* Painted backgrounds and varied drogues. */
#include "painted.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace accuracy {

namespace {

constexpr int fine = 4; /* bits of subpixels in what is drawn */

cv::Point fixed(double x, double y)
{
    return {static_cast<int>(std::lround(x * (1 << fine))), static_cast<int>(std::lround(y * (1 << fine)))};
}

/* Noise in [-1, 1] whose largest structure has the given size, CV_32F. */
cv::Mat texture(Random &random, const cv::Size &size, double structure_px, int octaves)
{
    cv::Mat sum = cv::Mat::zeros(size, CV_32F);
    double weights = 0;
    for (int k = 0; k < octaves; k++) {
        const double cell = structure_px / (1 << k);
        const double weight = 1.0 / (1 << k);
        cv::Mat small(static_cast<int>(size.height / cell) + 3, static_cast<int>(size.width / cell) + 3, CV_32F);
        cv::Mat large;
        for (int y = 0; y < small.rows; y++) {
            for (int x = 0; x < small.cols; x++) {
                small.at<float>(y, x) = static_cast<float>(random.uniform(-1, 1));
            }
        }
        cv::resize(small, large, {}, cell, cell, cv::INTER_CUBIC);
        sum += weight * large(cv::Rect({0, 0}, size));
        weights += weight;
    }
    return sum / weights;
}

cv::Mat shaded(Random &random, const cv::Size &size, double top, double bottom, double amplitude, double structure_px,
               int octaves)
{
    cv::Mat grey = amplitude * texture(random, size, structure_px, octaves);
    for (int y = 0; y < size.height; y++) {
        grey.row(y) += top + (bottom - top) * y / size.height;
    }
    return grey;
}

cv::Mat fields(Random &random, const cv::Size &size)
{
    cv::Mat grey = shaded(random, size, random.uniform(50, 110), random.uniform(50, 110), random.uniform(15, 40),
                          random.uniform(24, 120), 5);
    for (int i = 0; i < 14; i++) {
        const cv::RotatedRect r(
            cv::Point2f(static_cast<float>(random.uniform(0, size.width)),
                        static_cast<float>(random.uniform(0, size.height))),
            cv::Size2f(static_cast<float>(random.uniform(30, 260)), static_cast<float>(random.uniform(6, 160))),
            static_cast<float>(random.uniform(0, 180)));
        cv::Point2f corners[4];
        std::vector<cv::Point> polygon;
        r.points(corners);
        polygon.assign(corners, corners + 4);
        cv::Mat mask = cv::Mat::zeros(size, CV_8U);
        cv::fillConvexPoly(mask, polygon, 255);
        cv::add(grey, random.uniform(-30, 30), grey, mask);
    }
    return grey;
}

/* A place for a thing of this reach that leaves 'kept' alone; false when none was found. */
bool place(cv::Point2d &at, Random &random, const cv::Mat &plate, const cv::Rect &kept, double reach)
{
    for (int i = 0; i < 30; i++) {
        at.x = random.uniform(0, plate.cols);
        at.y = random.uniform(0, plate.rows);
        const int r = static_cast<int>(reach) + 2;
        if ((cv::Rect(static_cast<int>(at.x) - r, static_cast<int>(at.y) - r, 2 * r, 2 * r) & kept).area() == 0) {
            return true;
        }
    }
    return false;
}

void copy_part(const cv::Mat &from, const cv::Mat &to, const cv::Rect &part)
{
    const cv::Rect inside = part & cv::Rect({0, 0}, to.size());
    if (inside.area() > 0) {
        from(inside).copyTo(to(inside));
    }
}

void disc(cv::Mat &plate, const cv::Point2d &at, double radius, double aspect, double angle_deg, double grey,
          int thickness = cv::FILLED)
{
    cv::ellipse(plate, fixed(at.x, at.y), cv::Size(fixed(radius, radius * aspect)), angle_deg, 0, 360, cv::Scalar(grey),
                thickness, cv::LINE_AA, fine);
}

/* Does the canopy, as it is lit, differ from what is behind it almost all round? */
bool stands_out(const Scene &scene, double behind_grey)
{
    Scene nominal = scene;
    nominal.camera = {1000, 1000, 0, 0};
    nominal.pose = {{0, 0, 8}, {0, 0, 1}};
    const Ellipse rim = nominal.rim();
    int weak = 0;
    double sum = 0;
    for (int i = 0; i < 180; i++) {
        const cv::Point2d at = rim.at(i * CV_PI / 90);
        const double step = std::fabs(trace(nominal, 0.985 * at).grey - behind_grey);
        weak += step < 15;
        sum += step / 180;
    }
    return sum > 35 && weak < 20;
}

} // namespace

const char *name_of(Ground ground)
{
    static const char *const names[grounds] = {"sky", "clouds", "ground", "horizon", "dark"};
    return names[static_cast<int>(ground)];
}

cv::Mat paint_ground(Random &random, Ground ground, const cv::Size &size)
{
    cv::Mat grey, out;
    switch (ground) {
    case Ground::sky:
        grey = shaded(random, size, random.uniform(170, 215), random.uniform(200, 240), random.uniform(2, 8), 300, 3);
        break;
    case Ground::clouds:
        grey = shaded(random, size, random.uniform(110, 180), random.uniform(110, 180), random.uniform(25, 70),
                      random.uniform(90, 320), 4);
        break;
    case Ground::ground: grey = fields(random, size); break;
    case Ground::horizon: {
        const double slope = random.uniform(-0.4, 0.4);
        const double at = random.uniform(0.3, 0.7) * size.height;
        const cv::Mat below = fields(random, size);
        grey = shaded(random, size, random.uniform(150, 200), random.uniform(190, 235), 5, 300, 3);
        for (int x = 0; x < size.width; x++) {
            const int from = std::clamp(static_cast<int>(at + slope * (x - size.width / 2)), 0, size.height);
            copy_part(below, grey, cv::Rect(x, from, 1, size.height - from));
        }
        break;
    }
    case Ground::dark:
        grey = shaded(random, size, random.uniform(15, 40), random.uniform(15, 40), random.uniform(2, 10), 150, 4);
        break;
    }
    grey.convertTo(out, CV_8U);
    return out;
}

void paint_discs(cv::Mat &plate, Random &random, const cv::Rect &kept)
{
    const int things = static_cast<int>(random.uniform(3, 9));
    for (int i = 0; i < things; i++) {
        const double radius = 6 * std::pow(15, random.uniform(0, 1));
        const double aspect = random.uniform(0.6, 1);
        const double angle = random.uniform(0, 180);
        const double what = random.uniform(0, 3);
        cv::Point2d at;
        if (!place(at, random, plate, kept, 1.2 * radius)) {
            continue;
        }
        if (what < 1) {
            disc(plate, at, radius, aspect, angle, random.uniform(5, 45));
        } else if (what < 2) {
            disc(plate, at, radius, aspect, angle, random.uniform(190, 250),
                 std::max(1, static_cast<int>(random.uniform(0.06, 0.3) * radius)));
        } else {
            disc(plate, at, radius, aspect, angle, random.uniform(120, 250));
            disc(plate, at, radius * random.uniform(0.5, 0.9), aspect, angle, random.uniform(5, 60));
        }
    }
}

void paint_aircraft(cv::Mat &plate, Random &random, const cv::Rect &kept)
{
    const double grey = random.uniform(90, 200);
    const double x = random.uniform(0.1, 0.9) * plate.cols;
    const double y = random.uniform(0, 0.3) * plate.rows;
    const double span = random.uniform(0.2, 0.5) * plate.cols;
    const double chord = random.uniform(20, 60);
    const std::vector<cv::Point> wing = {fixed(x - span, y + 0.6 * chord), fixed(x, y - 0.3 * chord),
                                         fixed(x + span, y + 0.6 * chord), fixed(x + span, y + 0.8 * chord),
                                         fixed(x, y + 0.7 * chord),        fixed(x - span, y + 0.8 * chord)};
    const cv::Mat before = plate.clone();
    cv::fillPoly(plate, std::vector<std::vector<cv::Point>>{wing}, cv::Scalar(grey), cv::LINE_AA, fine);
    for (const double side : {-0.6, -0.3, 0.3, 0.6}) { /* pods: cowling, inlet, spinner */
        const cv::Point2d at(x + side * span, y + chord * random.uniform(0.7, 1.2));
        const double r = chord * random.uniform(0.35, 0.8);
        disc(plate, at, r, 0.95, 0, grey * 1.15);
        disc(plate, at, r * random.uniform(0.7, 0.9), 0.95, 0, random.uniform(10, 60));
        disc(plate, at, r * random.uniform(0.2, 0.4), 0.95, 0, random.uniform(30, 160));
    }
    for (int i = 0; i < 12; i++) { /* windows */
        disc(plate, {x - span / 3 + i * span / 18, y + 0.1 * chord}, 0.07 * chord + 2, 0.8, 90, 25);
    }
    copy_part(before, plate, kept);
}

void paint_probe(cv::Mat &plate, Random &random, const cv::Rect &kept)
{
    const double width = random.uniform(14, 60);
    cv::Point2d tip;
    if (!place(tip, random, plate, kept, 2 * width)) {
        return;
    }
    const cv::Mat before = plate.clone();
    const double grey = random.uniform(30, 220);
    const double to_x = random.uniform(-300, plate.cols + 300);
    cv::line(plate, fixed(tip.x, tip.y), fixed(to_x, plate.rows + 200), cv::Scalar(grey), static_cast<int>(width),
             cv::LINE_AA, fine);
    disc(plate, tip, 0.62 * width, 1, 0, grey * random.uniform(0.7, 1.1));
    disc(plate, tip, width * random.uniform(0.2, 0.4), 1, 0, random.uniform(5, 60));
    copy_part(before, plate, kept);
}

cv::Mat plate_of(const cv::Mat &painted, double blur_px)
{
    cv::Mat plate;
    painted.convertTo(plate, CV_32F);
    cv::GaussianBlur(plate, plate, {0, 0}, blur_px);
    return plate;
}

void draw_drogue(Scene &scene, Random &random, double behind_grey, const Variety &variety)
{
    const bool other = variety.held_out;
    Drogue &d = scene.drogue;
    Look &look = scene.look;
    d.rim_radius_m = other ? random.uniform(0.3, 0.6) : random.uniform(0.25, 0.45);
    d.inner_radius_m = d.rim_radius_m * (other ? random.uniform(0.26, 0.4) : random.uniform(0.28, 0.45));
    d.coupling_radius_m = d.inner_radius_m * (other ? random.uniform(1.05, 1.5) : random.uniform(1.1, 1.35));
    d.inner_depth_m = d.rim_radius_m * (other ? random.uniform(0.35, 1) : random.uniform(0.45, 0.85));
    d.housing_length_m = 0.5 * d.rim_radius_m;
    d.hose_radius_m = 0.1 * d.rim_radius_m;
    d.hose_length_m = d.rim_radius_m;
    d.ribs = static_cast<int>(other ? random.uniform(0, 44) : random.uniform(14, 37));
    d.rib_share = random.uniform(0.15, 0.4);
    d.rib_phase = random.uniform(0, 1);
    look.rib_gain = random.uniform(0.8, 1.25);
    look.inner_grey = other ? random.uniform(6, 26) : random.uniform(8, 20);
    look.ambient = random.uniform(0.6, 0.9);
    look.sun = cv::normalize(cv::Vec3d(random.uniform(-1, 1), random.uniform(-1, -0.2), random.uniform(-1, 0.5)));
    for (int i = 0; i < 60 && (i == 0 || !stands_out(scene, behind_grey)); i++) {
        look.canopy_grey = random.uniform(45, 235);
    }
    look.coupling_grey = random.uniform(70, 150);
    if (random.uniform(0, 1) < 0.5) { /* the canopy's inner edge, and a wall within */
        const double edge = other ? random.uniform(0.62, 0.88) : random.uniform(0.66, 0.85);
        const double from = d.inner_depth_m * (1 - edge) * d.rim_radius_m / (d.rim_radius_m - d.coupling_radius_m);
        do {
            look.patch_grey = random.uniform(40, 190);
        } while (std::fabs(look.patch_grey - look.canopy_grey) < 30);
        d.patches = {{0, 2 * CV_PI, std::min(from, 0.9 * d.inner_depth_m), d.inner_depth_m}};
    }
}

cv::Rect part_about(const Scene &scene)
{
    const Ellipse rim = scene.rim();
    const int half = static_cast<int>(std::ceil(1.7 * rim.a_px)) + 12;
    return cv::Rect(static_cast<int>(std::lround(rim.xc_px)) - half, static_cast<int>(std::lround(rim.yc_px)) - half,
                    2 * half + 1, 2 * half + 1) &
           cv::Rect({0, 0}, scene.image_px);
}

cv::Mat light_of(const Scene &scene)
{
    const cv::Rect part = part_about(scene);
    cv::Mat light = scene.background.plate.clone();
    if (part.area() > 0) {
        render_light(scene, part).convertTo(light(part), CV_32F);
    }
    return light;
}

cv::Mat exposed(const cv::Mat &light, double gain, double noise, uint64_t seed)
{
    cv::RNG rng(seed);
    cv::Mat grain(light.size(), CV_32F), out;
    rng.fill(grain, cv::RNG::NORMAL, 0, noise);
    cv::Mat(light * gain + grain).convertTo(out, CV_8U);
    return out;
}

} // namespace accuracy
