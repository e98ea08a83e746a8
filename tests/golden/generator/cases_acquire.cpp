/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of acquisition and of the second look: small rendered scenes, parts of images, workspaces of any size. */
#include <cmath>

#include "drogue/config.h"
#include "images.hpp"
#include "processing.hpp"
#include "sky_scene.hpp"
#include "varied.hpp"

namespace vectors {

namespace {

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

struct Picture {
    cv::Mat image;
    accuracy::Camera camera = {500, 500, 0, 0};
    double radius = 0.35, inner_radius = 0.12, depth = 0.25;
};

std::vector<Array> inputs_of(const Picture &p, std::vector<int64_t> params)
{
    const accuracy::Camera &c = p.camera;
    return {image_array("image", p.image),
            word_array("camera", 32, 16,
                       {q16(c.fx_px), q16(c.fy_px), q16(c.cx_px), q16(c.cy_px), q16(c.k1), q16(c.k2), q16(c.p1),
                        q16(c.p2), q16(c.k3)}),
            word_array("model", 32, 16, {q16(p.radius), q16(p.inner_radius), q16(p.depth)}),
            word_array("params", 32, 0, std::move(params))};
}

/* A drogue of 500 px focal length before the sky, in a frame of the given size. */
Picture picture(uint64_t seed, int width, int height, double x, double y, double z, double yaw, double pitch)
{
    const accuracy::Scene s = sky_scene(seed, x, y, z, yaw, pitch);
    Picture p;
    const cv::Rect part(1024 - width / 2, 1024 - height / 2, width, height);
    p.image = accuracy::render(s, part);
    p.camera = s.camera.cropped(part.tl());
    return p;
}

/* A trial's region of its scene. */
Picture picture_of(const accuracy::Trial &t)
{
    const accuracy::Drogue &d = t.scene.drogue;
    return {accuracy::render(t.scene, t.region), t.scene.camera.cropped(t.region.tl()), d.rim_radius_m,
            d.inner_radius_m, d.inner_depth_m};
}

/* One to three drogues before a plain background, by number: some cut, some with an inner part of another size or none. */
Picture drawn_drogues(uint64_t number)
{
    constexpr int WIDTH = 132, HEIGHT = 64;
    struct Drogue {
        double xc, yc, a, ratio, tilt, lean, inner_radius, from, wide;
        int canopy, inner;
    };
    uint64_t state = number * 7919 + 17;
    const auto draw = [&state](int low, int high) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return low + static_cast<int>((state >> 33) % static_cast<uint64_t>(high - low + 1));
    };
    const int count = draw(1, 3), background = draw(150, 240);
    std::vector<Drogue> drogues;
    for (int i = 0; i < count; i++) {
        Drogue d;
        d.a = draw(130, 230) / 10.0;
        d.xc = WIDTH * (2 * i + 1) / (2.0 * count) + draw(-20, 20) / 10.0;
        d.yc = HEIGHT / 2.0 + draw(-80, 80) / 10.0;
        d.ratio = draw(0, 3) == 0 ? 1 : draw(80, 100) / 100.0;
        d.tilt = draw(0, 62) / 10.0;
        const int away = draw(0, 4) == 0 ? 0 : 1;
        const double size = draw(0, 2) == 0 ? draw(60, 150) / 100.0 : 1, z = 500 * 0.35 / d.a;
        d.lean = std::sqrt(1 - d.ratio * d.ratio) * away * d.a * 0.25 / 0.35;
        d.inner_radius = d.a * 0.12 / 0.35 * z / (z + 0.25) * size;
        d.from = draw(0, 62) / 10.0;
        d.wide = draw(0, 1) == 0 ? draw(0, 30) / 10.0 : 0;
        d.canopy = draw(30, 130);
        d.inner = draw(0, 4) == 0 ? d.canopy : draw(0, d.canopy - 15);
        drogues.push_back(d);
    }
    const auto grey_at = [&](double x, double y) {
        int grey = background;
        for (const Drogue &d : drogues) {
            const double dx = x - d.xc, dy = y - d.yc, c = std::cos(d.tilt), s = std::sin(d.tilt);
            const double u = dx * c + dy * s, v = (dy * c - dx * s) / d.ratio, inner_v = v - d.lean / d.ratio;
            double turn = std::atan2(dy, dx) - d.from;
            turn -= 2 * CV_PI * std::floor(turn / (2 * CV_PI));
            if (u * u + inner_v * inner_v <= d.inner_radius * d.inner_radius) {
                grey = d.inner;
            } else if (u * u + v * v <= d.a * d.a && (turn >= d.wide || u * u + v * v <= d.a * d.a / 2)) {
                grey = d.canopy;
            }
        }
        return grey;
    };
    Picture p;
    p.camera = {500, 500, 66, 32};
    p.image = image_from(WIDTH, HEIGHT, [&](int x, int y) {
        int sum = 8;
        for (int k = 0; k < 16; k++) {
            sum += grey_at(x + (2 * (k % 4) - 3) / 8.0, y + (2 * (k / 4) - 3) / 8.0);
        }
        return sum / 16;
    });
    return p;
}

/* A drogue seen along its axis with a canopy from 'within' a to a, a wall and an inner part of 'size' times what it should be. */
Picture banded(double a, double within, int ground, int canopy, int wall, int inner, double size = 1)
{
    const int side = static_cast<int>(std::ceil(4 * a));
    const double middle = side / 2.0 + 0.3, z = 500 * 0.35 / a, disc = size * a * 0.12 / 0.35 * z / (z + 0.25);
    Picture p;
    p.camera = {500, 500, middle, middle};
    p.image = image_from(side, side, [&](int x, int y) {
        double sum = 0;
        for (int k = 0; k < 36; k++) { /* two pixels wide: some blur */
            const double r = std::hypot(x + (2 * (k % 6) - 5) / 6.0 - middle, y + (2 * (k / 6) - 5) / 6.0 - middle);
            sum += r < disc ? inner : r < within * a ? wall : r < a ? canopy : ground;
        }
        return static_cast<int>(std::lround(sum / 36));
    });
    return p;
}

/* A drogue that part of the rim is hidden of, and about its dark opening a bright ring, as wide as so many openings, with
 * a darker middle: what a smaller drogue in the same attitude shows. */
Picture coupled(double a, double ratio, double ring, double hidden_rad)
{
    struct Shape {
        double x, y, a;
    };
    const int side = static_cast<int>(std::ceil(4 * a));
    const double c = std::cos(0.6), s = std::sin(0.6), turned = std::sqrt(1 - ratio * ratio);
    const auto disc_of = [&](const Shape &rim) {
        const double z = 500 * 0.35 / rim.a, farther = z / (z + 0.25), lean = turned * rim.a * 0.25 / 0.35;
        return Shape{rim.x - lean * s * farther, rim.y + lean * c * farther, rim.a * 0.12 / 0.35 * farther};
    };
    const Shape rim = {side / 2.0 + 0.3, side / 2.0 + 0.2, a}, opening = disc_of(rim),
                about = {opening.x, opening.y, ring * opening.a}, middle = disc_of(about);
    Picture p;
    p.camera = {500, 500, rim.x, rim.y};
    p.image = image_from(side, side, [&](int x, int y) {
        double sum = 0;
        for (int k = 0; k < 36; k++) { /* two pixels wide: some blur */
            const double px = x + (2 * (k % 6) - 5) / 6.0, py = y + (2 * (k / 6) - 5) / 6.0;
            const auto in = [&](const Shape &e) {
                const double dx = px - e.x, dy = py - e.y;
                return std::hypot(dx * c + dy * s, (dy * c - dx * s) / ratio) < e.a;
            };
            const bool hidden = std::fabs(std::atan2(py - rim.y, px - rim.x)) < hidden_rad / 2;
            sum += in(middle) ? 10 : in(opening) ? 60 : in(about) ? 175 : in(rim) && !hidden ? 120 : 200;
        }
        return static_cast<int>(std::lround(sum / 36));
    });
    return p;
}

/* What is asked of an acquisition. */
struct Ask {
    bool part = false;
    std::array<int64_t, 4> region = {0, 0, 0, 0};
    int64_t search = 256, workspace = 256, contrast = 6;
};

void add_ask(Set &set, const std::string &name, Tier tier, const Flags &flags, const Picture &p, const Ask &a)
{
    set.add(
        name, tier, flags,
        inputs_of(p, {a.part, a.region[0], a.region[1], a.region[2], a.region[3], a.search, a.workspace, a.contrast}));
}

} // namespace

void add_acquire(Set &set)
{
    set.begin("acquire");
    Picture p = picture(61, 150, 120, 0.3, -0.1, 6, 0.2, -0.15);
    Ask ask;
    add_ask(set, "whole", Tier::ordinary, {}, p, ask);
    ask.part = true;
    ask.region = {45, 9, 90, 83};
    add_ask(set, "part", Tier::ordinary, {}, p, ask);
    ask.region = {-30, -700, 5000, 807}; /* past the image */
    add_ask(set, "part-past-the-image", Tier::boundary, {"border"}, p, ask);
    ask.region = {0, 0, 60, 120}; /* the drogue is elsewhere */
    add_ask(set, "part-beside-it", Tier::must_reject, {}, p, ask);
    ask.region = {63, 20, 50, 70}; /* much of the outline is cut */
    add_ask(set, "part-cuts-it", Tier::stress, {"arc"}, p, ask);
    const int64_t low = INT32_MIN, high = INT32_MAX;
    const std::pair<const char *, std::array<int64_t, 4>> hostile[] = {{"wraps-down", {0, low, 64, low + 5000}},
                                                                       {"wraps-left", {low, 0, low + 5000, 64}},
                                                                       {"far-away", {high, high, high, high}},
                                                                       {"no-width", {0, 0, 0, 64}},
                                                                       {"negative", {0, 0, 64, -1}},
                                                                       {"to-the-border", {-64, 0, 64, 64}},
                                                                       {"beside", {64, 0, 64, 64}}};
    Picture blank;
    blank.image = constant(64, 64, 210);
    for (const auto &[name, region] : hostile) {
        ask.region = region;
        add_ask(set, std::string("region-") + name, Tier::must_reject, {"argument", "saturation"}, blank, ask);
    }
    ask.region = {low, low, high, high};
    add_ask(set, "region-largest", Tier::must_reject, {"saturation"}, blank, ask);
    ask.region = {-1000000, -1000000, 2000000, 2000000};
    add_ask(set, "region-all", Tier::boundary, {"saturation"}, p, ask);
    ask = Ask();
    ask.search = 63;
    add_ask(set, "search-too-narrow", Tier::must_reject, {"table-full"}, blank, ask);
    ask.search = 150;
    ask.workspace = 60;
    add_ask(set, "workspace-too-narrow", Tier::must_reject, {"table-full"}, p, ask);
    ask = Ask();
    ask.contrast = 256;
    add_ask(set, "contrast-too-large", Tier::must_reject, {"argument"}, blank, ask);
    ask.contrast = 255; /* nothing is sighted: the image itself is measured, the drogue not in its middle */
    add_ask(set, "nothing-sighted", Tier::stress, {}, p, ask);
    ask = Ask();
    p = picture(62, 110, 110, 0.02, 0.01, 5, 0.1, 0.1);
    ask.contrast = 255;
    add_ask(set, "nothing-sighted-middle", Tier::ordinary, {}, p, ask);
    ask.contrast = 6;
    p.inner_radius = 0;
    add_ask(set, "inner-unknown", Tier::ordinary, {"inner-missing"}, p, ask);
    p.inner_radius = 0.2; /* not of its size: seen, not sure */
    add_ask(set, "inner-of-another-size", Tier::stress, {"inner-missing"}, p, ask);
    for (const int larger : {25, 40, 48}) { /* as shade makes it, by per cent; the last too much so */
        p = picture(71, 90, 80, -0.05, 0.05, 9, 0.2, -0.15);
        p.inner_radius = 0.12 / (1 + larger / 100.0);
        add_ask(set, "inner-in-shade-" + std::to_string(larger), Tier::stress, {}, p, ask);
    }
    p = picture(63, 130, 110, -0.2, 0.2, 7, -0.1, 0.2);
    fill(p.image, 0, 0, 62, 110, 150); /* half of it is hidden */
    add_ask(set, "half-hidden", Tier::stress, {"occlusion"}, p, ask);
    p = picture(64, 160, 100, 0.35, 0, 6, 0.2, 0.1); /* beside it a darker disc in a ring, which is none */
    cv::Mat decoy = soft_disc(70, 100, 58, 98, 92, 8, 40, 190);
    const cv::Mat dark = soft_disc(70, 100, 58, 98, 30, 6, 0, 255);
    decoy = cv::min(decoy, dark);
    decoy.copyTo(p.image(cv::Rect(0, 0, 70, 100)));
    add_ask(set, "decoy", Tier::stress, {"tie"}, p, ask);
    p = picture(65, 120, 100, 0.2, 0.1, 5.5, 0.25, -0.2);
    p.image = 255 - p.image;
    add_ask(set, "negative-picture", Tier::stress, {"polarity"}, p, ask);
    for (const int hidden :
         {16, 24, 30}) { /* under haze: of an inner part that is exact less than all of the rim will do */
        p = picture(66, 130, 120, -0.05, 0.05, 5, 0.12, -0.1);
        p.image.convertTo(p.image, CV_8U, 0.35, 140);
        fill(p.image, 0, 0, 130, hidden, 200);
        fill(p.image, 0, 0, hidden, 120, 200);
        add_ask(set, "haze-hidden-" + std::to_string(hidden), Tier::stress, {"occlusion"}, p, ask);
    }
    ask = Ask();
    for (const int number :
         {0, 1, 10, 16, 19, 36, 42, 44, 56, 328, 363}) { /* several sighted: which settles, and which is worth more */
        add_ask(set, "drawn-" + std::to_string(number), Tier::stress, {"tie"},
                drawn_drogues(static_cast<uint64_t>(number)), ask);
    }
    for (const int number : {14, 19, 48}) {
        p = drawn_drogues(static_cast<uint64_t>(number));
        p.inner_radius = 0;
        add_ask(set, "drawn-inner-unknown-" + std::to_string(number), Tier::stress, {"tie", "inner-missing"}, p, ask);
    }
    for (const double a : {11.0, 12.5, 14.0, 17.0, 22.0, 30.0}) { /* the canopy's inner edge is an outline, too */
        const std::string name = "band-" + std::to_string(std::lround(10 * a));
        add_ask(set, name, Tier::stress, {"tie"}, banded(a, 0.8, 120, 180, 50, 12), ask);
        add_ask(set, name + "-small-inner", Tier::stress, {"tie"}, banded(a, 0.8, 120, 180, 50, 12, 0.88), ask);
        add_ask(set, name + "-smaller-inner", Tier::stress, {"tie"}, banded(a, 0.8, 120, 180, 50, 12, 0.83), ask);
        add_ask(set, name + "-dark", Tier::stress, {"tie"}, banded(a, 0.74, 15, 90, 160, 10), ask);
        add_ask(set, name + "-haze", Tier::stress, {"tie"}, banded(a, 0.8, 230, 150, 135, 103), ask);
        add_ask(set, name + "-thick-haze", Tier::stress, {"tie"}, banded(a, 0.8, 230, 150, 135, 90), ask);
    }
    int number = 0;
    for (const double ring : {1.2, 1.5, 2.0}) { /* a ring about the opening is no drogue of its own */
        for (const double hidden : {0.0, 1.2, 2.4}) {
            add_ask(set, "coupling-" + std::to_string(number++), Tier::stress, {"tie"}, coupled(44, 0.95, ring, hidden),
                    ask);
        }
    }
    p.image = constant(520, 8, 90);
    ask.search = 520;
    add_ask(set, "too-wide-to-measure-whole", Tier::must_reject, {"threshold-met"}, p, ask);
    p.image = constant(512, 8, 90);
    add_ask(set, "wide-enough-to-measure-whole", Tier::must_reject, {"threshold-met"}, p, ask);
    p.image = constant(8, 513, 90);
    add_ask(set, "too-high-to-measure-whole", Tier::must_reject, {"threshold-met"}, p, ask);
}

namespace {

struct Look {
    std::array<int64_t, 4> region;
    int64_t width = 256, edges = 4096, labels = 2048, arcs = 512, transfer = DROGUE_TRANSFER_LINEAR;
};

void add_one(Set &set, const std::string &name, Tier tier, const Flags &flags, const Picture &p, const Look &l)
{
    set.add(name, tier, flags,
            inputs_of(p, {l.region[0], l.region[1], l.region[2], l.region[3], l.width, l.edges, l.labels, l.arcs,
                          l.transfer}));
}

/* Rendered scenes, then encoded for display: by size, brighter or darker than the sky, before what hides it, in motion. */
void add_encoded(Set &set)
{
    using accuracy::Variety;
    int k = 0;
    for (const Variety v :
         {Variety::plain, Variety::far, Variety::offset, Variety::noise, Variety::probe, Variety::blur, Variety::blur,
          Variety::tilted, Variety::half, Variety::clutter, Variety::ribs, Variety::torus}) {
        const accuracy::Trial t = accuracy::varied_trial(43, v, k, false);
        Picture p = picture_of(t);
        p.image = accuracy::processed(p.image, "srgb");
        Look l = {{0, 0, t.region.width, t.region.height}};
        l.width = l.region[2];
        l.transfer = DROGUE_TRANSFER_SRGB;
        add_one(set, "srgb-" + std::to_string(k++), v == Variety::blur ? Tier::stress : Tier::ordinary, {}, p, l);
    }
}

/* Regions too small or too large for the outline, or beside it, where the inner disc leads to it; every second one through a
 * lens. */
void add_led_by_disc(Set &set)
{
    using accuracy::Variety;
    int k = 0;
    for (const Variety v : {Variety::plain, Variety::tilted, Variety::probe, Variety::ribs, Variety::offset,
                            Variety::half, Variety::torus, Variety::clutter, Variety::far, Variety::bright,
                            Variety::tilted, Variety::plain, Variety::spot, Variety::tilted}) {
        accuracy::Trial t = accuracy::varied_trial(47, v, k, false);
        if (k % 2 == 1) {
            t.scene.camera.k1 = -0.2;
            t.scene.camera.k2 = 0.03;
        }
        const accuracy::Ellipse rim = t.scene.rim();
        const cv::Point2d centre = t.scene.camera.distort({rim.xc_px, rim.yc_px});
        const int wide = cvRound(3.6 * rim.a_px),
                  side = cvRound((k % 3 == 0   ? 1.7
                                  : k % 3 == 1 ? 3.5
                                               : 2.1) *
                                 rim.a_px),
                  off = k % 3 == 2 ? wide / 8 : 0;
        t.region = {cvRound(centre.x) - wide / 2, cvRound(centre.y) - wide / 2, wide, wide};
        Look l = {{(wide - side) / 2 + off, (wide - side) / 2 - off / 2, side, side}};
        l.width = wide;
        add_one(set, "led-by-disc-" + std::to_string(k), Tier::stress, {}, picture_of(t), l);
        k++;
    }
}

} // namespace

void add_look(Set &set)
{
    set.begin("look");
    Picture p;
    p.camera = {400, 400, 63.5, 63.5};
    p.inner_radius = 0;
    p.image = image_from(128, 128,
                         [](int x, int y) { return (x - 76) * (x - 76) + (y - 60) * (y - 60) <= 40 * 40 ? 60 : 200; });
    Look l = {{0, 0, 128, 128}};
    for (const int edges :
         {100, 140, 180, 220, 260, 280, 400}) { /* the list fills in the first look, in the second, never */
        l.edges = edges;
        add_one(set, "edges-" + std::to_string(edges), Tier::stress, {"table-full", "arc"}, p, l);
    }
    l = {{0, 0, 128, 128}};
    for (const int width : {127, 128, 150, 200}) {
        l.width = width;
        add_one(set, "width-" + std::to_string(width), Tier::boundary, {"table-full", "threshold-met"}, p, l);
    }
    l = {{0, 0, 128, 128}};
    for (const int labels : {8, 12, 16, 24, 40}) {
        l.labels = labels;
        add_one(set, "labels-" + std::to_string(labels), Tier::stress, {"table-full"}, p, l);
    }
    l = {{0, 0, 128, 128}};
    for (const int arcs : {1, 2, 3, 4, 6}) {
        l.arcs = arcs;
        add_one(set, "arcs-" + std::to_string(arcs), Tier::stress, {"table-full"}, p, l);
    }
    p.image = image_from(110, 128,
                         [](int x, int y) { return (x - 60) * (x - 60) + (y - 64) * (y - 64) <= 46 * 46 ? 60 : 200; });
    for (const int width : {105, 106, 107, 110, 116}) { /* the wider region's part within the image has 107 columns */
        l = {{-30, 0, 128, 128}};
        l.width = width;
        add_one(set, "clipped-" + std::to_string(width), Tier::boundary, {"border", "arc", "threshold-met"}, p, l);
    }
    p = picture(71, 130, 120, 0.2, -0.1, 4.5, 0.2, -0.2);
    const int x = 65 + 22, y = 60 - 11;        /* where it is, about */
    for (const int off : {0, 6, 12, 18, 24}) { /* the region's middle beside it: the ring cuts the outline */
        l = {{x - 49 + off, y - 49, 97, 97}};
        add_one(set, "beside-" + std::to_string(off), Tier::ordinary, {"arc"}, p, l);
        l = {{x - 49, y - 49 - off, 97, 97}};
        l.width = 97; /* no room for a wider region */
        add_one(set, "above-" + std::to_string(off), Tier::boundary, {"arc", "table-full"}, p, l);
    }
    for (const int side : {66, 76, 120, 150}) {
        l = {{x - side / 2, y - side / 2, side, side}};
        add_one(set, "side-" + std::to_string(side), Tier::ordinary, {}, p, l);
    }
    l = {{x - 38, y - 38, 76, 76}}; /* too small for the outline, which the disc leads to: but for room */
    for (const int width : {76, 85, 86, 100}) {
        l.width = width;
        add_one(set, "disc-width-" + std::to_string(width), Tier::boundary, {"table-full", "threshold-met"}, p, l);
    }
    l.width = 400;
    for (const int edges : {60, 240, 300, 400}) {
        l.edges = edges;
        add_one(set, "disc-edges-" + std::to_string(edges), Tier::stress, {"table-full"}, p, l);
    }
    l = {{x - 20, y - 49, 97, 97}}; /* past the image's right border */
    add_one(set, "past-the-border", Tier::boundary, {"border", "arc"}, p, l);
    p.inner_radius = 0.12;
    p.camera = {600, 600, 63.5, 63.5};
    const auto within = [](int x, int y, double radius) {
        return std::clamp(radius - std::hypot(x - 62.3, y - 64.6) + 0.5, 0.0, 1.0);
    };
    for (const int rim : {205, 208, 211, 214, 217, 223}) { /* before 205: along rays, and where it is an edge at once */
        p.image = image_from(128, 128, [rim, within](int x, int y) {
            const double grey =
                205 + (rim - 205) * within(x, y, 48) + (90 - rim) * within(x, y, 42) - 78 * within(x, y, 16.2);
            return static_cast<int>(grey + 0.5) + (x * 7 + y * 5) % 3;
        });
        l = {{0, 0, 128, 128}};
        add_one(set, "rim-" + std::to_string(rim), Tier::stress, {}, p, l);
    }
    for (const int wall :
         {36, 38, 40, 42, 43, 44, 45}) { /* in noise: the disc is 7 to 33 % too large for the wall's edge */
        accuracy::Random noise(17);
        p.image = image_from(128, 128, [wall, within, &noise](int x, int y) {
            const double grey = 200 + 8 * within(x, y, 48) - 118 * within(x, y, wall) - 78 * within(x, y, 16.2);
            return static_cast<int>(grey + noise.uniform(-6, 6) + 0.5);
        });
        l = {{10, 13, 106, 106}};
        add_one(set, "wall-" + std::to_string(wall), Tier::stress, {"noise"}, p, l);
    }
    const accuracy::Trial faint = accuracy::varied_trial(41, accuracy::Variety::bright, 12, false);
    p = picture_of(faint);
    l = {{0, 0, faint.region.width, faint.region.height}};
    add_one(set, "along-rays", Tier::stress, {}, p, l);
    l.transfer = DROGUE_TRANSFER_SRGB; /* which it is not: other outlines */
    add_one(set, "srgb-along-rays", Tier::stress, {}, p, l);
    add_led_by_disc(set);
    add_encoded(set);
    p.image = constant(100, 100, 80);
    l = {{0, 0, 100, 100}};
    add_one(set, "nothing", Tier::must_reject, {"degenerate"}, p, l);
}

} // namespace vectors
