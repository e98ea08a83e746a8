/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the whole measurement: rendered scenes, drawn rings, and frames in which there is nothing to measure. */
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "conditions.hpp"
#include "images.hpp"
#include "scene.hpp"
#include "varied.hpp"

namespace vectors {

namespace {

using Words = std::vector<int64_t>;

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

struct Frame {
    cv::Mat image;
    accuracy::Camera camera = {1465.5, 1465.5, 0, 0};
    double radius = 0.35, inner_radius = 0.12, depth = 0.25;
    cv::Rect region;
};

void add_frame(Set &set, const std::string &name, Tier tier, const Flags &flags, const Frame &f)
{
    const accuracy::Camera &c = f.camera;
    set.add(name, tier, flags,
            {image_array("image", f.image),
             word_array("camera", 32, 16,
                        {q16(c.fx_px), q16(c.fy_px), q16(c.cx_px), q16(c.cy_px), q16(c.k1), q16(c.k2), q16(c.p1),
                         q16(c.p2), q16(c.k3)}),
             word_array("model", 32, 16, {q16(f.radius), q16(f.inner_radius), q16(f.depth)}),
             word_array("region", 32, 0, {f.region.x, f.region.y, f.region.width, f.region.height})});
}

/* A scene's picture about its region, 'margin' pixels wider on every side. */
Frame photograph(const accuracy::Scene &scene, const cv::Rect &region, int margin)
{
    const cv::Rect part(region.x - margin, region.y - margin, region.width + 2 * margin, region.height + 2 * margin);
    Frame f;
    f.image = accuracy::render(scene, part);
    f.camera = scene.camera.cropped(part.tl());
    f.region = {margin, margin, region.width, region.height};
    return f;
}

/* Region of 2.5 semi-axes about the rim as seen. */
cv::Rect region_of(const accuracy::Scene &scene)
{
    const accuracy::Ellipse e = scene.rim();
    const cv::Point2d centre = scene.camera.distort({e.xc_px, e.yc_px});
    const int side = cvRound(2.5 * e.a_px);
    return {cvRound(centre.x - (side - 1) / 2.0), cvRound(centre.y - (side - 1) / 2.0), side, side};
}

accuracy::Scene scene_at(uint64_t seed, double x, double y, double z, double yaw_deg, double pitch_deg)
{
    accuracy::Scene s;
    s.seed = seed;
    s.pose = {{x, y, z}, accuracy::axis_of(yaw_deg * CV_PI / 180, pitch_deg * CV_PI / 180)};
    return s;
}

void add_demo_scenes(Set &set, const std::string &folder)
{
    struct Demo {
        const char *name;
        double cx, cy;
        cv::Rect region;
    };
    /* as in the .json beside each picture */
    static const Demo demos[] = {{"demo", 403.5, 143.5, {152, 134, 214, 214}},
                                 {"bright_ground", 63.5, 113.5, {81, 73, 256, 256}},
                                 {"cloud", 283.5, 223.5, {44, 28, 129, 129}},
                                 {"far", -76.5, -36.5, {35, 28, 58, 58}}};
    for (const Demo &d : demos) {
        const cv::Mat whole = cv::imread(folder + "/" + d.name + ".png", cv::IMREAD_UNCHANGED);
        if (whole.type() != CV_8UC1) {
            throw std::runtime_error("cannot read the grey picture " + folder + "/" + d.name + ".png");
        }
        Frame f;
        f.image = whole(d.region).clone();
        f.camera = {1465.5, 1465.5, d.cx - d.region.x, d.cy - d.region.y};
        f.region = {0, 0, d.region.width, d.region.height};
        add_frame(set, std::string(d.name) + "-region", Tier::ordinary, {}, f);
    }
}

/* Drogues before sky, ground and cloud, at the distances of a docking. */
void add_plain_scenes(Set &set)
{
    static const double distances[] = {8, 12, 16, 20, 25};
    for (const double z : distances) {
        for (int index = 0; index < 3; index++) {
            const std::string name = "scene-" + std::to_string(static_cast<int>(z)) + "m-" + std::to_string(index);
            accuracy::Random random = set.random(name);
            const double x = z * random.uniform(-0.25, 0.25);
            const double y = z * random.uniform(-0.25, 0.25);
            const double yaw = random.uniform(-20, 20);
            const double pitch = random.uniform(-20, 20);
            accuracy::Scene s = scene_at(random.next(), x, y, z, yaw, pitch);
            s.drogue.rib_phase = random.uniform(0, 1);
            s.sensor.blur_px = random.uniform(0.5, 0.9);
            s.background = index == 0   ? accuracy::Background::sky()
                           : index == 1 ? accuracy::Background::ground()
                                        : accuracy::Background::cloud();
            s.look = index == 1 || random.next() % 2 == 0 ? accuracy::Look::bright() : accuracy::Look::dark();
            if (index == 0) {
                s.look = accuracy::Look::dark();
            }
            cv::Rect region = region_of(s);
            region.x += between(random, -1, 1);
            region.y += between(random, -1, 1);
            add_frame(set, name, Tier::ordinary, {"polarity"}, photograph(s, region, index));
        }
    }
}

void add_disturbed_scenes(Set &set)
{
    accuracy::Scene s = scene_at(31, 0.9, -0.7, 12, 12, -8);
    s.sensor.noise = 9;
    add_frame(set, "strong-noise", Tier::stress, {"noise"}, photograph(s, region_of(s), 0));
    for (const double noise : {18, 30}) { /* fills a table: thresholds of its own strength, once and raised */
        s.sensor.noise = noise;
        add_frame(set, "noise-fills-a-table-" + std::to_string(static_cast<int>(noise)), Tier::stress, {"noise"},
                  photograph(s, region_of(s), 0));
    }
    s = scene_at(71, 0.1, -0.1, 6.8, 8, -6);
    s.drogue.inner_radius_m = s.drogue.coupling_radius_m = 0.2; /* 42 px: measured by twice the rays */
    Frame large = photograph(s, region_of(s), 0);
    large.inner_radius = 0.2;
    add_frame(set, "large-disc", Tier::ordinary, {}, large);
    for (const int metres : {18, 22}) { /* a sixth too large: believed, and maybe something else */
        s = scene_at(static_cast<uint64_t>(metres), 0.4, -0.2, metres, 9, -5);
        s.drogue.inner_radius_m = s.drogue.coupling_radius_m = 0.14;
        add_frame(set, "small-disc-off-" + std::to_string(metres), Tier::stress, {}, photograph(s, region_of(s), 0));
    }
    s = scene_at(32, -0.6, 0.5, 12, -14, 6);
    s.sensor.motion_length_px = 6;
    s.sensor.motion_angle_rad = 0.6;
    add_frame(set, "motion-blur", Tier::stress, {"motion-blur"}, photograph(s, region_of(s), 0));
    for (int k = 0; k < 3; k++) { /* a dark collar about the inner disc, its outer edge steeper than the disc's own */
        accuracy::Scene collar = scene_at(static_cast<uint64_t>(51 + k), 0.1, -0.05, 7.0 + k, 9 - 6 * k, -5 + 4 * k);
        collar.look.canopy_grey = 165;
        collar.look.coupling_grey = 62;
        collar.drogue.coupling_radius_m = 0.137 + 0.005 * k;
        add_frame(set, "collar-" + std::to_string(k), Tier::stress, {}, photograph(collar, region_of(collar), 0));
    }
    s = scene_at(33, 0.2, 0.3, 14, 3, 14);
    s.background = accuracy::Background::ground();
    s.look = accuracy::Look::bright();
    const accuracy::Ellipse rim = s.rim();
    s.probe = {{rim.xc_px + 8, rim.yc_px + 5}, {rim.xc_px + 90, rim.yc_px + 60}, 5, 60};
    add_frame(set, "probe-before-it", Tier::stress, {"occlusion"}, photograph(s, region_of(s), 0));
    s = scene_at(34, 0.1, -0.2, 14, 0, 0);
    add_frame(set, "head-on", Tier::boundary, {"head-on", "near-circle"}, photograph(s, region_of(s), 0));
    s = scene_at(35, 0.5, 0.1, 13, 25, 14);
    add_frame(set, "steep-view", Tier::stress, {"twin-pose"}, photograph(s, region_of(s), 0));
    s.look.inner_grey = 110;
    s.look.coupling_grey = 60;
    add_frame(set, "inner-not-dark", Tier::stress, {"inner-missing"}, photograph(s, region_of(s), 0));

    const accuracy::Camera barrel = {1200, 1195, 1023.5, 1023.5, -0.32, 0.12, 0.0008, -0.0005, -0.02};
    s = scene_at(36, 3.5, 2.6, 9, 10, -6);
    s.camera = barrel;
    add_frame(set, "barrel-lens", Tier::ordinary, {"barrel"}, photograph(s, region_of(s), 2));
    s = scene_at(37, -3.0, 3.4, 11, -9, 12);
    s.camera = barrel;
    s.background = accuracy::Background::ground();
    s.look = accuracy::Look::bright();
    add_frame(set, "barrel-lens-bright", Tier::ordinary, {"barrel"}, photograph(s, region_of(s), 0));
    /* far off, where wall and rim blur into each other; the major axis near the vertical */
    for (int index = 0; index < 6; index++) {
        s = scene_at(40 + static_cast<uint64_t>(index), 4.0, 3.0, 20, 16 + index, index % 2 == 0 ? -3 : 3);
        s.camera = barrel;
        s.background = index % 3 == 0 ? accuracy::Background::ground() : accuracy::Background::cloud();
        s.look = index < 3 ? accuracy::Look::bright() : accuracy::Look::dark();
        add_frame(set, "barrel-lens-far-" + std::to_string(index), Tier::ordinary, {"barrel"},
                  photograph(s, region_of(s), 0));
    }
    s = scene_at(38, 1.0, -2.0, 12, 8, 9);
    s.camera = {1400, 1410, 1023.5, 1023.5, 0.15, 0.05, 0, 0, 0};
    add_frame(set, "pincushion-lens", Tier::ordinary, {"pincushion"}, photograph(s, region_of(s), 0));
    /* the picture's own camera without distortion, measured with one whose image folds before the drogue */
    Frame folded = photograph(scene_at(39, 4, 3, 12, 5, 5), region_of(scene_at(39, 4, 3, 12, 5, 5)), 0);
    folded.camera.k1 = -3;
    add_frame(set, "folded-lens", Tier::must_reject, {"folded-lens"}, folded);
    /* the same, the fold running through the outline: much, a third, a little of it cannot be undone */
    for (const double k1 : {-0.80, -0.76, -0.74, -0.72}) {
        folded.camera.k1 = k1;
        add_frame(set, "fold-through-outline-" + std::to_string(cvRound(-100 * k1)), Tier::stress, {"folded-lens"},
                  folded);
    }
}

void add_regions(Set &set)
{
    const accuracy::Scene s = scene_at(41, 0.4, 0.3, 13, -10, 11);
    const cv::Rect region = region_of(s);
    Frame all = photograph(s, region, 6);
    Frame f = all;
    const auto crop = [&](int left, int top, int right, int bottom) {
        f = all;
        f.image = all.image(cv::Rect(left, top, all.image.cols - left - right, all.image.rows - top - bottom)).clone();
        f.camera.cx_px -= left;
        f.camera.cy_px -= top;
        f.region.x -= left;
        f.region.y -= top;
    };
    add_frame(set, "region-inside", Tier::ordinary, {}, all);
    crop(20, 14, 0, 0);
    add_frame(set, "region-past-top-left", Tier::boundary, {"border", "rounding-negative"}, f);
    crop(0, 0, 22, 17);
    add_frame(set, "region-past-bottom-right", Tier::boundary, {"border"}, f);
    accuracy::Scene grainy = s; /* edges all over the image: which of them lie in the ring shows */
    grainy.sensor.noise = 14;
    all = photograph(grainy, region, 6);
    crop(20, 14, 0, 0);
    add_frame(set, "grain-past-top-left", Tier::boundary, {"border", "noise"}, f);
    crop(0, 0, 22, 17);
    add_frame(set, "grain-past-bottom-right", Tier::boundary, {"border", "noise"}, f);
    all = photograph(s, region, 6);
    f = all;
    f.region.width += 5;
    f.region.height -= 4;
    add_frame(set, "region-not-square", Tier::ordinary, {"odd-size"}, f);
    f = all;
    f.region.x += 7;
    f.region.y -= 5;
    add_frame(set, "region-off-centre", Tier::stress, {}, f);
    const int by = region.width / 7; /* a side: 3.2 and 1.8 semi-axes */
    const cv::Rect wide(region.x - by, region.y - by, region.width + 2 * by, region.height + 2 * by);
    add_frame(set, "region-wide", Tier::ordinary, {}, photograph(s, wide, 6));
    f = all;
    f.region.x += by;
    f.region.y += by;
    f.region.width -= 2 * by;
    f.region.height -= 2 * by;
    add_frame(set, "region-tight", Tier::ordinary, {}, f);
    f = all;
    f.region = {all.image.cols, 0, 40, 40};
    add_frame(set, "region-beside-image", Tier::must_reject, {"border"}, f);
    f.region = {-40, 0, 40, 40};
    add_frame(set, "region-left-of-image", Tier::must_reject, {"border"}, f);
    f.region = {0, 0, 0, 40};
    add_frame(set, "region-empty", Tier::must_reject, {"degenerate"}, f);
    f.region = {0, 0, 8193, 8193};
    add_frame(set, "region-too-large", Tier::must_reject, {"saturation"}, f);
    f.region = {-1048577, 0, 64, 64};
    add_frame(set, "region-too-far", Tier::must_reject, {"saturation"}, f);
    f.region = {0, 0, 8193, 60};
    add_frame(set, "region-too-wide", Tier::must_reject, {"threshold-met"}, f);
    f.region = {0, 0, 60, 8193};
    add_frame(set, "region-too-high", Tier::must_reject, {"threshold-met"}, f);
    f.region = {0, 0, 8192, 8192};
    add_frame(set, "region-largest", Tier::must_reject, {"threshold-met"}, f);
    f.region = {4, 40, 90, 1};
    add_frame(set, "region-one-row", Tier::must_reject, {"1xN"}, f);
    f.region = {40, 4, 1, 90};
    add_frame(set, "region-one-column", Tier::must_reject, {"1xN"}, f);
    f = all;
    f.camera.fx_px = 0;
    add_frame(set, "no-focal-length", Tier::must_reject, {"argument"}, f);
    f = all;
    f.radius = 0;
    add_frame(set, "no-radius", Tier::must_reject, {"argument"}, f);
    f.radius = -0.35;
    add_frame(set, "radius-negative", Tier::must_reject, {"argument"}, f);
    f = all;
    f.camera.fy_px = 0;
    add_frame(set, "no-focal-length-y", Tier::must_reject, {"argument"}, f);
    f = all;
    f.inner_radius = -1.0 / 65536;
    add_frame(set, "inner-radius-negative", Tier::must_reject, {"argument"}, f);
    f.inner_radius = 1.0 / 65536;
    add_frame(set, "inner-radius-one-lsb", Tier::boundary, {"threshold-met"}, f);
    f.inner_radius = 0;
    add_frame(set, "inner-unknown", Tier::ordinary, {"inner-missing"}, f);
    f.inner_radius = f.radius + 1.0 / 65536;
    add_frame(set, "inner-radius-above-rim", Tier::must_reject, {"argument"}, f);
    f = all;
    f.depth = -1.0 / 65536;
    add_frame(set, "inner-depth-negative", Tier::must_reject, {"argument"}, f);
    f = all;
    f.camera.k1 = 256 + 1.0 / 65536;
    add_frame(set, "lens-out-of-range", Tier::must_reject, {"argument"}, f);
    f.camera.k1 = 0;
    f.camera.p2 = -256 - 1.0 / 65536;
    add_frame(set, "lens-out-of-range-tangential", Tier::must_reject, {"argument"}, f);
}

/* A scene that varies the drogue itself. */
Frame varied_frame(const accuracy::Trial &t, const cv::Rect &region)
{
    Frame f = photograph(t.scene, region, 0);
    f.radius = t.model.rim_radius_m_q16 / 65536.0;
    f.inner_radius = t.model.inner_radius_m_q16 / 65536.0;
    f.depth = t.model.inner_depth_m_q16 / 65536.0;
    return f;
}

/* Which disc it is, and what it decides: a wall's edge is steeper where the other pose expects the disc; the disc of a
 * drogue that is tilted by 40 degrees lies near its rim; outline and disc contradict each other, and one pose is far
 * worse than the other. */
void add_choices(Set &set)
{
    using accuracy::Variety;
    static const struct {
        const char *name;
        Variety variety;
        uint64_t seed;
        int index;
    } chosen[] = {{"steeper-wall-0", Variety::far, 1, 10},        {"steeper-wall-1", Variety::far, 21, 22},
                  {"steeper-wall-2", Variety::noise, 21, 4},      {"steeper-wall-3", Variety::tilted, 1, 23},
                  {"disc-near-rim-0", Variety::tilted, 1, 21},    {"disc-near-rim-1", Variety::tilted, 11, 14},
                  {"disc-near-rim-2", Variety::tilted, 11, 12},   {"contradicted-disc-0", Variety::half, 11, 1},
                  {"contradicted-disc-1", Variety::offset, 1, 6}, {"contradicted-disc-2", Variety::torus, 1, 7},
                  {"contradicted-disc-3", Variety::torus, 21, 2}};
    for (const auto &c : chosen) {
        const accuracy::Trial t = accuracy::varied_trial(c.seed, c.variety, c.index, false);
        add_frame(set, c.name, Tier::stress, {"twin-pose"}, varied_frame(t, t.region));
    }
}

/* A camera from which the rim has so many px and the drogue is seen head-on; returns the disc's. */
double look_head_on(Frame &f, int width, double rim_px)
{
    f.camera = {800, 800, width / 2.0, width / 2.0};
    const double z = f.camera.fx_px * f.radius / rim_px;
    return f.camera.fx_px * f.inner_radius / (z + f.depth);
}

/* A disc of the model's size in a rim that is drawn for part of each so many-th of a turn, a collar between and a circle
 * about it; the disc lies (x, y) off the middle. */
struct Dashed {
    double rim_px, collar_px, drawn;
    int dashes, side;
    double outer_px = 0;
    int outer = 200, dash = 140, collar = 100;
    double x_px = 0, y_px = 0;
    double blank = 0; /* part of a turn without dashes */
};

Frame dashed_drogue(const Dashed &d)
{
    constexpr int WIDTH = 160;
    Frame f;
    const double disc_px = look_head_on(f, WIDTH, d.rim_px);
    f.image = image_from(WIDTH, WIDTH, [&](int x, int y) {
        double sum = 0;
        for (int k = 0; k < 16; k++) {
            const double u = x + k % 4 / 4.0 - 0.075 - WIDTH / 2, v = y + k / 4 / 4.0 - 0.625 - WIDTH / 2;
            const double r = std::hypot(u, v), turn = std::atan2(v, u) / (2 * CV_PI) + 1;
            const bool dash =
                turn * d.dashes - std::floor(turn * d.dashes) < d.drawn && turn - std::floor(turn) >= d.blank;
            sum += std::hypot(u - d.x_px, v - d.y_px) < disc_px ? 30
                   : r < d.collar_px                            ? d.collar
                   : r < d.rim_px && dash                       ? d.dash
                   : r < d.outer_px                             ? d.outer
                                                                : 200;
        }
        return static_cast<int>(sum / 16 + 0.5);
    });
    f.region = {(WIDTH - d.side) / 2, (WIDTH - d.side) / 2, d.side, d.side};
    return f;
}

/* A whole rim about a disc in shade, as a coupling's: a dark band about it, or of its own grey, so that it is hidden. */
struct Shaded {
    double rim_px, shade_px;
    int disc, shade;
    double blur_px, x_px, y_px; /* disc and shade beside the middle */
};

Frame shaded_drogue(const Shaded &d)
{
    constexpr int WIDTH = 160;
    Frame f;
    const double disc_px = look_head_on(f, WIDTH, d.rim_px);
    f.image = image_from(WIDTH, WIDTH, [&](int x, int y) {
        const double u = x - WIDTH / 2 + 0.3, v = y - WIDTH / 2 - 0.2, r = std::hypot(u - d.x_px, v - d.y_px);
        const auto rise = [&](double by) { return (1 + std::erf(by / (d.blur_px * std::sqrt(2.0)))) / 2; };
        return cvRound(d.disc + (d.shade - d.disc) * rise(r - disc_px) + (100 - d.shade) * rise(r - d.shade_px) +
                       100 * rise(std::hypot(u, v) - d.rim_px));
    });
    const int side = cvRound(2.5 * d.rim_px);
    f.region = {(WIDTH - side) / 2, (WIDTH - side) / 2, side, side};
    return f;
}

/* A whole rim about a disc whose edge has teeth, so many px to either side; part of a turn is as dark as the disc. */
Frame toothed_drogue(double tooth_px, double dark)
{
    constexpr int WIDTH = 160, TEETH = 18;
    Frame f;
    f.inner_radius = 0.2;
    const double disc_px = look_head_on(f, WIDTH, 60);
    f.image = image_from(WIDTH, WIDTH, [&](int x, int y) {
        double sum = 0;
        for (int k = 0; k < 16; k++) {
            const double u = x + k % 4 / 4.0 - 0.075 - WIDTH / 2, v = y + k / 4 / 4.0 - 0.625 - WIDTH / 2;
            const double r = std::hypot(u, v), turn = std::atan2(v, u) / (2 * CV_PI) + 1;
            const double tooth = turn * TEETH - std::floor(turn * TEETH) < 0.5 ? tooth_px : -tooth_px;
            const bool inside = r < disc_px + tooth || (r < 50 && turn - std::floor(turn) < dark);
            sum += inside ? 30 : r < 60 ? 130 : 200;
        }
        return static_cast<int>(sum / 16 + 0.5);
    });
    f.region = {5, 5, 150, 150};
    return f;
}

/* A rim so much darker than what is behind it, in noise of up to so many grey levels. */
Frame noisy_drogue(int step, int noise, uint32_t seed)
{
    Frame f = dashed_drogue({40, 0, 1, 1, 96});
    f.image.forEach<uint8_t>(
        [&](uint8_t &grey, const int *) { grey = grey > 100 && grey < 200 ? grey + 60 - step : grey; });
    for (int y = 0; y < f.image.rows; y++) {
        for (int x = 0; x < f.image.cols; x++) {
            seed = seed * 1664525u + 1013904223u;
            f.image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(
                f.image.at<uint8_t>(y, x) + static_cast<int>((seed >> 16) % (2 * static_cast<uint32_t>(noise) + 1)) -
                noise);
        }
    }
    return f;
}

/* What the disc leads to: a drogue on a plain sky in a region far larger than it, so that the ring is blank; a rim
 * whose pieces are no arcs, about a collar that is whole. And a disc without a rim. */
void add_led_by_disc(Set &set)
{
    int k = 0;
    for (const double share : {3.3, 3.6}) {
        add_frame(set, "blank-ring-" + std::to_string(k++), Tier::stress, {},
                  dashed_drogue({40, 0, 1, 1, cvRound(40 * share)}));
    }
    k = 0;
    static const struct {
        double collar, drawn;
        int dashes;
    } dashed[] = {{40, 0.3, 12}, {40, 0.4, 16}, {40, 0.5, 12},  {40, 0.35, 16}, /* collars that are an outline, */
                  {20, 0.4, 12}, {22, 0.4, 16}, {18, 0.35, 24}, {47, 0.4, 8},
                  {40, 0.2, 12}}; /* or taken for the disc */
    for (const auto &d : dashed) {
        add_frame(set, "dashed-rim-" + std::to_string(k++), Tier::stress, {},
                  dashed_drogue({50, d.collar, d.drawn, d.dashes, 120}));
    }
    k = 0;
    for (const Dashed &d :
         {Dashed{48, 45, 0.77, 16, 148, 52, 110, 120, 100, -3, -3}, /* more shows of the circle, a twelfth larger */
          Dashed{37, 3, 0.36, 6, 92, 39, 120, 140, 100, 4, -4},
          Dashed{42, 35, 0.59, 12, 117, 55, 130, 100, 100, -1, -2}, /* or far larger */
          Dashed{52, 33, 0.66, 4, 150, 72, 170, 180, 160, -2, 2},
          Dashed{38, 36, 0.65, 20, 121, 47, 150, 60, 160, -4, -2}, /* the disc is off its place */
          Dashed{44, 19, 0.5, 14, 123, 0, 0, 140, 100, -2, 1},     /* the collar is taken for the disc at first */
          Dashed{41, 22, 0.71, 12, 135, 47, 140, 160, 80, -1, 1},
          Dashed{26, 7, 0.46, 4, 80, 33, 120, 160, 180, -4, -1}, /* the circle is too large for the disc */
          Dashed{49, 34, 0.38, 8, 156, 62, 110, 120, 160, 2, -4}}) {
        add_frame(set, "rim-in-circle-" + std::to_string(k++), Tier::stress, {}, dashed_drogue(d));
    }
    k = 0;
    for (const Dashed &d :
         {Dashed{48, 45.6, 1, 1, 120, 0, 0, 140, 70}, /* a lip, whose inner edge is found first */
          Dashed{36, 34, 1, 1, 90, 0, 0, 150, 60, 1, 1}, Dashed{30, 28, 1, 1, 76, 0, 0, 130, 50, -1, 1},
          Dashed{50, 47, 1, 1, 126, 0, 0, 160, 110}}) {
        add_frame(set, "lip-" + std::to_string(k++), Tier::stress, {}, dashed_drogue(d));
    }
    k = 0;
    for (const Dashed &d :
         {Dashed{49, 34.5, 0.45, 12, 118, 45, 50, 160, 60, 2, -2}, /* less shows of it than of one within */
          Dashed{39, 25, 0.38, 8, 122, 37, 60, 100, 70, -1, -4},
          Dashed{57, 53, 0.52, 4, 153, 0, 90, 120, 110, -4, -4}}) {
        add_frame(set, "larger-rim-" + std::to_string(k++), Tier::stress, {}, dashed_drogue(d));
    }
    k = 0;
    for (const Dashed &d :
         {Dashed{45, 42.5, 0.41, 14, 119, 0, 100, 90, 110, -1, -4}, /* the best outline has a disc, too */
          Dashed{52, 47.5, 0.6, 14, 130, 47, 50, 50, 180, -1, 3}}) {
        add_frame(set, "doubted-rim-" + std::to_string(k++), Tier::stress, {}, dashed_drogue(d));
    }
    k = 0;
    for (const uint32_t seed : {1u, 2u, 3u, 4u}) {
        add_frame(set, "noisy-rim-" + std::to_string(k++), Tier::stress, {"noise"}, noisy_drogue(12, 20, seed));
    }
    k = 0;
    static const Shaded shaded[] = {{28, 12.9, 12, 30, 0.5, -1.6, -0.9}, /* the disc shows in the shade, */
                                    {56, 21.7, 16, 30, 0.5, 1.1, 1.1},
                                    {48, 19.6, 8, 36, 0.7, 0.5, 1.1},
                                    {32, 14.2, 16, 36, 0.7, -0.3, -1.1},
                                    {36, 14.7, 12, 36, 0.5, 1.7, -0.9}, /* or not quite, */
                                    {36, 15.6, 8, 8, 0.9, -1.9, 0},     /* or not, */
                                    {24, 11.9, 12, 8, 0.5, 0.7, -1.9},
                                    {40, 19, 10, 10, 0.8, 0, 0}}; /* nor is the shade where any pose expects it */
    for (const Shaded &d : shaded) {
        add_frame(set, "shaded-disc-" + std::to_string(k++), Tier::stress, {}, shaded_drogue(d));
    }
    k = 0;
    for (const Dashed &d :
         {Dashed{40, 0, 0.5, 16, 100}, Dashed{55, 0, 0.45, 12, 138}, Dashed{22, 0, 0.5, 12, 55},
          Dashed{40, 0, 0.55, 16, 100, 0, 200, 140, 100, 0, 0, 0.14}, /* less than one part is blank, */
          Dashed{40, 0, 0.6, 16, 100, 0, 200, 140, 100, 0, 0, 0.2},
          Dashed{40, 0, 0.7, 16, 100, 0, 200, 140, 100, 0, 0, 0.4}}) { /* or some are */
        add_frame(set, "panelled-rim-" + std::to_string(k++), Tier::stress, {}, dashed_drogue(d));
    }
    k = 0;
    static const struct {
        double tooth_px, dark;
    } toothed[] = {{0.6, 0}, {1.0, 0}, {1.3, 0}, {1.0, 0.1}, {1.8, 0}, {1.0, 0.3}}; /* too long, or not all about */
    for (const auto &t : toothed) {
        add_frame(set, "toothed-disc-" + std::to_string(k++), Tier::stress, {}, toothed_drogue(t.tooth_px, t.dark));
    }
    add_frame(set, "rim-missing", Tier::must_reject, {}, dashed_drogue({40, 0, 0, 1, 76}));
}

/* What only many pixels together show: a rim hardly brighter than the ground behind it about a dark wall, whose edge is
 * found first; a rim narrower than the motion that blurs it. */
void add_faint_rims(Set &set)
{
    int k = 0;
    static const struct {
        uint64_t seed;
        int index;
    } faint[] = {{1, 7}, {1, 21}, {41, 3}, {41, 12}, {1, 21}}; /* the last through a lens */
    for (const auto &chosen : faint) {
        accuracy::Trial t = accuracy::varied_trial(chosen.seed, accuracy::Variety::bright, chosen.index, false);
        cv::Rect region = t.region;
        if (k == 4) {
            t.scene.camera.k1 = -0.2;
            region = region_of(t.scene);
        }
        add_frame(set, "faint-rim-" + std::to_string(k++), Tier::stress, {}, varied_frame(t, region));
    }
    /* a drogue as faint, whose inner disc is larger than the model's: nothing is beyond its rim */
    accuracy::Scene larger = scene_at(69, 0.3, 0.2, 10, 8, -6);
    larger.drogue.coupling_radius_m = 0.121;
    larger.look.canopy_grey = 214;
    larger.look.ambient = 1;
    larger.look.rib_gain = 1;
    larger.background = {205, 205, 1, 256, 3};
    Frame disc = photograph(larger, region_of(larger), 0);
    disc.inner_radius = 0.115;
    add_frame(set, "faint-rim-larger-inner", Tier::stress, {"inner-missing"}, disc);
    for (k = 0; k < 6; k++) {
        accuracy::Scene s = scene_at(static_cast<uint64_t>(70 + k), 0.2, 0.1 * k, 7.5 + k, 12 - 5 * k, 3 * k - 8);
        s.drogue.wall_share = 0.84 + 0.02 * k;
        s.background = accuracy::Background::ground();
        s.look = accuracy::Look::bright();
        s.look.wall_grey = 70;
        s.sensor.motion_length_px = 5 + k;
        s.sensor.motion_angle_rad = 0.5 * k;
        if (k == 4) {
            s.camera = {1400, 1410, 1023.5, 1023.5, 0.1, 0.02, 0, 0, 0};
        }
        add_frame(set, "motion-blur-narrow-" + std::to_string(k), Tier::stress, {"motion-blur"},
                  photograph(s, region_of(s), 0));
    }
}

/* A scene of each condition of the accuracy study, at a distance that makes it small. */
void add_conditions(Set &set)
{
    for (int i = 1; i < accuracy::conditions; i++) {
        for (int index = 0; index < 2; index++) {
            const auto condition = static_cast<accuracy::Condition>(i);
            const accuracy::Trial t = accuracy::trial_at(7, condition, index, 13 + index);
            Frame f = photograph(t.scene, t.region, 0);
            f.radius = t.model.rim_radius_m_q16 / 65536.0;
            f.inner_radius = t.model.inner_radius_m_q16 / 65536.0;
            f.depth = t.model.inner_depth_m_q16 / 65536.0;
            std::string name = std::string("condition-") + accuracy::name_of(condition) + "-" + std::to_string(index);
            std::replace(name.begin(), name.end(), '_', '-');
            add_frame(set, name, Tier::ordinary, {}, f);
        }
    }
}

/* A dark cone that ends in a band, on which light falls from one side and some from all, before a ground that may be
 * brighter than the sensor bears: 'over' is its light, 1 what is white. */
struct Banded {
    double rim_px, band_px, lit;
    int cone, band, tilt;
    double over, all_about = 0;
};

Frame banded_drogue(const Banded &b)
{
    constexpr int WIDTH = 160, FINE = 6;
    Frame f;
    const double disc_px = look_head_on(f, WIDTH, b.rim_px);
    f.image = image_from(WIDTH, WIDTH, [&](int x, int y) {
        double sum = 0;
        for (int k = 0; k < FINE * FINE; k++) { /* two pixels wide */
            const double u = x + (k % FINE - 2.5) / 3 - WIDTH / 2, v = y + (k / FINE - 2.5) / 3 - WIDTH / 2;
            const double r = std::hypot(u, v * (1 + b.tilt / 100.0));
            const double light = b.all_about + (1 - b.all_about) * std::max(0.0, std::cos(std::atan2(v, u) - b.lit));
            sum += r < disc_px                ? 12
                   : r < b.rim_px - b.band_px ? b.cone
                   : r < b.rim_px             ? b.cone + light * (b.band - b.cone)
                                              : 255 * b.over;
        }
        return std::min(255, static_cast<int>(sum / (FINE * FINE) + 0.5));
    });
    const int side = cvRound(2.5 * b.rim_px);
    f.region = {(WIDTH - side) / 2, (WIDTH - side) / 2, side, side};
    return f;
}

/* A rim with lobes: their crests are farther out than what is between them, and no ray has both. */
Frame lobed_drogue(double rim_px, double deep_px, int lobes)
{
    constexpr int WIDTH = 220;
    Frame f;
    const double disc_px = look_head_on(f, WIDTH, rim_px);
    f.image = image_from(WIDTH, WIDTH, [&](int x, int y) {
        double sum = 0;
        for (int k = 0; k < 64; k++) {
            const double u = x + k % 8 / 4.0 - WIDTH / 2 - 0.6, v = y + k / 8 / 4.0 - WIDTH / 2 - 1.1;
            const double r = std::hypot(u, v);
            sum += r < disc_px ? 20 : r < rim_px + deep_px * std::sin(lobes * std::atan2(v, u)) ? 90 : 200;
        }
        return static_cast<int>(sum / 64 + 0.5);
    });
    const int side = cvRound(2.4 * rim_px);
    f.region = {(WIDTH - side) / 2, (WIDTH - side) / 2, side, side};
    return f;
}

/* The rim's outer edge where its inner one is clearer, and saturated ground. */
void add_bands(Set &set)
{
    int k = 0;
    for (const Banded &b :
         {Banded{57.5, 3.2, -0.2, 90, 210, 12, 0.3, 0.6}, Banded{53.5, 2.1, -1.2, 70, 210, 12, 0.4, 0.4},
          Banded{46.5, 2.6, -1, 90, 240, 12, 0.5, 0.8}, Banded{42.5, 1.6, -0.1, 50, 240, 16, 0.25, 0.3},
          Banded{57, 3.5, 1.4, 70, 240, 12, 0.2, 0.5}, Banded{53, 1.6, -0.3, 60, 240, 8, 0.5, 0.7},
          Banded{51, 1.7, 2.8, 90, 150, 8, 0.2, 0.5}, Banded{63, 3.9, 2.7, 70, 120, 20, 0.6, 0.8},
          Banded{49.5, 2.5, 1.6, 70, 180, 16, 0.7, 0.5}, Banded{58, 3.2, 1.6, 70, 250, 0, 0.5},
          Banded{52, 2.6, 4, 60, 220, 0, 0.5}}) { /* the last two have it at once, or on one side */
        add_frame(set, "banded-rim-" + std::to_string(k++), Tier::stress, {}, banded_drogue(b));
    }
    for (const Banded &b : {Banded{49.5, 2.5, 1.6, 70, 180, 16, 0.7, 0.5}, Banded{51, 1.7, 2.8, 90, 150, 8, 0.2, 0.5},
                            Banded{63, 3.9, 2.7, 70, 120, 20, 0.6, 0.8}}) {
        Frame f = banded_drogue(b);
        f.camera.k1 = -0.1;
        add_frame(set, "banded-rim-lens-" + std::to_string(cvRound(b.rim_px)), Tier::stress, {"barrel"}, f);
    }
    add_frame(set, "lobed-rim", Tier::stress, {}, lobed_drogue(90, 1.6, 20));
    k = 0;
    for (const Banded &b :
         {Banded{40, 0, 0, 80, 80, 0, 1.3}, Banded{20, 0, 0, 40, 40, 3, 2.2}, Banded{50, 8, 3, 60, 400, 0, 0.3},
          Banded{45, 30, 2, 90, 300, 5, 1.6}, Banded{48, 0, 0, 70, 70, 2, 1}}) { /* white, but not cut off */
        add_frame(set, "saturated-" + std::to_string(k++), Tier::stress, {}, banded_drogue(b));
    }
}

/* Outlines whose shape puts both expected discs beside the one that is there; the last too far for it to be believed. And
 * discs of noise, in which nothing is another one. */
void add_between(Set &set)
{
    int k = 0;
    for (const Banded &b : {Banded{50, 0, 0, 80, 80, 1, 0.8}, Banded{46.5, 0, 0, 60, 60, 2, 0.7},
                            Banded{57, 0, 0, 90, 90, 1, 0.9}, Banded{36, 0, 0, 60, 60, 6, 0.8}}) {
        add_frame(set, "between-" + std::to_string(k++), Tier::stress, {}, banded_drogue(b));
    }
    Frame another = banded_drogue({50, 0, 0, 80, 80, 1, 0.8});
    another.inner_radius = 0.113; /* what is there is larger */
    add_frame(set, "between-larger", Tier::stress, {}, another);
    for (k = 0; k < 4; k++) {
        accuracy::Random random(500 + static_cast<uint64_t>(k));
        Frame f = banded_drogue({k < 2 ? 40.0 + 2 * k : 46.5 + 2 * k, 0, 0, 30, 30, 6 + 3 * k, 0.9});
        const int noise = 10 + 5 * k;
        for (auto p = f.image.begin<uint8_t>(); p != f.image.end<uint8_t>(); ++p) {
            *p = static_cast<uint8_t>(std::clamp(std::max<int>(*p, 30) + between(random, -noise, noise), 0, 255));
        }
        add_frame(set, "disc-of-noise-" + std::to_string(k), Tier::stress, {}, f);
    }
}

/* Ring with an inner disc, drawn. */
Frame drawn(int side, int radius4, int rim, int paper, int inner)
{
    Frame f;
    f.image = soft_disc(side, side, side - 1, side - 1, radius4, 8, rim, paper);
    const cv::Mat dark = soft_disc(side, side, side - 3, side + 1, radius4 / 3, 6, 0, 255);
    for (int y = 0; y < side; y++) {
        for (int x = 0; x < side; x++) {
            const int share = dark.at<uint8_t>(y, x);
            uint8_t &p = f.image.at<uint8_t>(y, x);
            p = static_cast<uint8_t>((p * share + inner * (255 - share)) / 255);
        }
    }
    f.camera.cx_px = (side - 1) / 2.0 + 40;
    f.camera.cy_px = (side - 1) / 2.0 - 30;
    f.region = {0, 0, side, side};
    return f;
}

void add_drawings(Set &set)
{
    add_frame(set, "drawn-dark", Tier::ordinary, {"near-circle"}, drawn(80, 128, 70, 200, 10));
    add_frame(set, "drawn-bright", Tier::ordinary, {"near-circle"}, drawn(81, 131, 220, 90, 15));
    Frame f = drawn(80, 128, 70, 200, 10);
    fill(f.image, 0, 0, 40, 80, 135); /* the left half is gone */
    add_frame(set, "half-an-outline", Tier::stress, {"arc"}, f);
    f = drawn(80, 128, 70, 200, 10);
    fill(f.image, 0, 0, 80, 40, 70);
    add_frame(set, "lower-half", Tier::stress, {"arc"}, f);
    f = drawn(80, 128, 70, 200, 10);
    fill(f.image, 36, 0, 8, 80, 70);
    fill(f.image, 0, 36, 80, 8, 70);
    add_frame(set, "four-gaps", Tier::ordinary, {"arc"}, f);
    f = drawn(90, 132, 70, 200, 10);
    for (int y = 0; y < 90; y++) { /* a second, fainter ring further out */
        for (int x = 0; x < 90; x++) {
            const int d = (2 * x - 89) * (2 * x - 89) + (2 * y - 89) * (2 * y - 89);
            f.image.at<uint8_t>(y, x) = static_cast<uint8_t>(d > 80 * 80 ? 150 : f.image.at<uint8_t>(y, x));
        }
    }
    add_frame(set, "two-rings", Tier::stress, {"farthest-arc"}, f);
    f = drawn(80, 128, 70, 200, 10);
    for (int i = 0; i < 80; i++) { /* gaps on the diagonals: two arcs a quadrant, mirror images of each other */
        fill(f.image, i - 4, i - 4, 9, 9, 135);
        fill(f.image, i - 4, 79 - i - 4, 9, 9, 135);
    }
    add_frame(set, "arcs-of-equal-distance", Tier::boundary, {"tie", "farthest-arc"}, f);
    f = drawn(20, 30, 20, 220, 20); /* small enough for the finest unit of the fit */
    add_frame(set, "smallest-outline", Tier::boundary, {"near-circle"}, f);
    /* outlines that are too flat, too small, too large for the region */
    f.region = {0, 0, 80, 80};
    f.image = image_from(80, 80, [](int x, int y) {
        return 4 * (2 * x - 79) * (2 * x - 79) + 29 * (2 * y - 79) * (2 * y - 79) < 4 * 72 * 72 ? 60 : 200;
    });
    add_frame(set, "outline-too-flat", Tier::must_reject, {"threshold-met"}, f);
    f.image =
        image_from(80, 80, [](int x, int y) { return (x - 60) * (x - 60) + (y - 19) * (y - 19) < 90 ? 60 : 200; });
    add_frame(set, "outline-too-small", Tier::must_reject, {"threshold-met"}, f);
    f.image = image_from(80, 80,
                         [](int x, int y) { return (x + 20) * (x + 20) + (y - 99) * (y - 99) < 111 * 111 ? 60 : 200; });
    add_frame(set, "outline-too-large", Tier::must_reject, {"threshold-met"}, f);
    accuracy::Random random = set.random("drawings");
    f.image = constant(64, 64, 0);
    f.region = {0, 0, 64, 64};
    add_frame(set, "all-black", Tier::must_reject, {"degenerate"}, f);
    f.image = noise(64, 64, random);
    add_frame(set, "noise", Tier::must_reject, {"noise"}, f);
    f.image = noise(72, 72, random, 100, 112);
    f.region = {0, 0, 72, 72};
    add_frame(set, "faint-noise", Tier::must_reject, {"noise"}, f);
    accuracy::Scene sky = scene_at(51, 3, 3, 12, 0, 0);
    f.image = accuracy::render(sky, {100, 100, 70, 70});
    f.region = {0, 0, 70, 70};
    add_frame(set, "no-drogue", Tier::must_reject, {"degenerate"}, f);
    cv::Mat square = constant(72, 72, 60);
    fill(square, 10, 10, 52, 52, 190);
    f.image = square;
    f.region = {0, 0, 72, 72};
    add_frame(set, "square", Tier::must_reject, {"straight"}, f);
    f.image = image_from(72, 72, [](int x, int) { return x < 63 ? 190 : 60; });
    add_frame(set, "straight-edge", Tier::must_reject, {"straight"}, f);
    f.image = drawn(64, 160, 60, 200, 60).image;
    f.region = {0, 0, 64, 64};
    add_frame(set, "outline-outside-ring", Tier::must_reject, {"border"}, f);
    f.image = constant(2048, 3, 50); /* the largest sides of a region */
    f.region = {0, 0, 2048, 3};
    add_frame(set, "flat-2048x3", Tier::must_reject, {"threshold-met"}, f);
    f.image = constant(3, 2048, 50);
    f.region = {0, 0, 3, 2048};
    add_frame(set, "flat-3x2048", Tier::must_reject, {"threshold-met"}, f);
    f.image = image_from(40, 1, [](int x, int) { return x * 6; });
    f.region = {0, 0, 40, 1};
    add_frame(set, "one-row", Tier::must_reject, {"1xN"}, f);
    f.image = image_from(1, 40, [](int, int y) { return y * 6; });
    f.region = {0, 0, 1, 40};
    add_frame(set, "one-column", Tier::must_reject, {"1xN"}, f);
}

} // namespace

void add_frame(Set &set, const std::string &scenes_folder)
{
    set.begin("frame");
    add_demo_scenes(set, scenes_folder);
    add_plain_scenes(set);
    add_disturbed_scenes(set);
    add_regions(set);
    add_conditions(set);
    add_choices(set);
    add_led_by_disc(set);
    add_bands(set);
    add_between(set);
    add_faint_rims(set);
    add_drawings(set);
}

/* Regions of other sizes than the rim asks for, and what else is chosen among outlines in them: each the smallest of
 * some thousand in which one condition makes the difference. */
void add_narrow_regions(Set &set)
{
    using accuracy::Variety;
    static const struct {
        Variety variety;
        uint64_t seed;
        int index;
        double side; /* of the proper region's */
    } chosen[] = {{Variety::far, 101, 0, 0.76},    {Variety::bright, 303, 49, 0.82}, {Variety::half, 101, 14, 0.76},
                  {Variety::blur, 101, 5, 1},      {Variety::torus, 303, 45, 0.76},  {Variety::torus, 303, 48, 0.82},
                  {Variety::blur, 303, 40, 0.84},  {Variety::far, 303, 7, 0.76},     {Variety::far, 101, 6, 0.76},
                  {Variety::offset, 101, 8, 0.74}, {Variety::blur, 202, 17, 1},      {Variety::clutter, 303, 48, 0.74},
                  {Variety::far, 303, 49, 0.74}};
    int k = 0;
    set.begin("frame");
    for (const auto &c : chosen) {
        const accuracy::Trial t = accuracy::varied_trial(c.seed, c.variety, c.index, false);
        const int margin = t.region.width / 6;
        const int side = cvRound(c.side * t.region.width);
        const int off = margin + (t.region.width - side) / 2;
        Frame f = varied_frame(
            t, {t.region.x - margin, t.region.y - margin, t.region.width + 2 * margin, t.region.height + 2 * margin});
        f.region = {off, off, side, side};
        add_frame(set, "narrow-region-" + std::to_string(k++), Tier::stress, {}, f);
    }
}

} // namespace vectors
