/* SPDX-License-Identifier: Apache-2.0 */
/* Cases of the joint pose: distances, tilts, with and without the inner part, the twin, few bins, steps. */
#include <array>
#include <cmath>
#include <stdexcept>

#include "case.hpp"
#include "reference.hpp"

namespace vectors {

namespace {

int64_t q16(double v) { return static_cast<int64_t>(std::floor(v * 65536 + 0.5)); }

struct Job {
    double position[3] = {0.6, -0.4, 9}, yaw = 0.15, pitch = -0.1; /* the truth */
    double fx = 1465.5, fy = 1465.5, cx = 1023.5, cy = 1023.5;
    double rim = 0.35, inner = 0.12, depth = 0.25;
    double noise = 0.1;  /* px, of a bin's mean */
    double shift = 0.02; /* px, of the ellipse's members */
    double inner_std = 0.05, shading = 3.8, blur = 0.12;
    int gradient = 120; /* a point's */
    int steps = 5, other = 0, from = 0, bins = 32;
    bool start_at_truth = false;
};

struct Words {
    std::vector<int64_t> ellipse, camera, bins, params;
    std::array<reference::Pose, 2> pair; /* that the outline allows, the nearer to the truth first */
};

/* Image of the circle by points on it and the reference's fit. */
reference::Ellipse image_of_rim(const Job &j, const reference::Camera &c)
{
    const cv::Vec3d n(std::sin(j.yaw) * std::cos(j.pitch), std::sin(j.pitch), std::cos(j.yaw) * std::cos(j.pitch));
    const cv::Vec3d e1(std::cos(j.yaw), 0, -std::sin(j.yaw)), e2 = n.cross(e1);
    std::vector<cv::Point2d> points;
    for (int i = 0; i < 40; i++) {
        const double t = i * CV_PI / 20;
        const cv::Vec3d p = cv::Vec3d(j.position) + j.rim * (std::cos(t) * e1 + std::sin(t) * e2);
        points.emplace_back(static_cast<double>(c.fx) * p[0] / p[2] + static_cast<double>(c.cx),
                            static_cast<double>(c.fy) * p[1] / p[2] + static_cast<double>(c.cy));
    }
    const reference::Ellipse e = reference::fit(points);
    if (!e.ok) {
        throw std::runtime_error("no ellipse for a case of the joint pose");
    }
    return e;
}

Words words_of(const Job &j, accuracy::Random &random)
{
    const reference::Camera c = {j.fx, j.fy, j.cx, j.cy};
    reference::Ellipse e = image_of_rim(j, c);
    for (reference::Real *member : {&e.xc, &e.yc, &e.a, &e.b}) {
        *member += j.shift * normal(random);
    }
    e.b = std::min(e.b, e.a);
    const double cos_pitch = std::cos(j.pitch);
    const reference::Pose truth = {{j.position[0], j.position[1], j.position[2]},
                                   {std::sin(j.yaw) * cos_pitch, std::sin(j.pitch), std::cos(j.yaw) * cos_pitch},
                                   j.yaw,
                                   j.pitch};
    std::array<reference::Pose, 2> pair;
    reference::Ellipse disc;
    if (!reference::poses(e, c, j.rim, pair)) {
        throw std::runtime_error("no poses for a case of the joint pose");
    }
    const auto apart = [&](size_t i) {
        return std::fabs(pair[i].yaw - truth.yaw) + std::fabs(pair[i].pitch - truth.pitch);
    };
    const size_t nearer = apart(1) < apart(0) ? 1 : 0;
    const reference::Pose start = j.start_at_truth ? truth : pair[j.other != 0 ? 1 - nearer : nearer];
    (void)reference::disc_image(disc, truth, c, {j.rim, j.inner, j.depth});
    Words w;
    w.pair = {pair[nearer], pair[1 - nearer]};
    w.ellipse = {q16(static_cast<double>(e.xc)), q16(static_cast<double>(e.yc)), q16(static_cast<double>(e.a)),
                 q16(static_cast<double>(e.b)), q16(static_cast<double>(e.angle))};
    w.camera = {q16(j.fx), q16(j.fy), q16(j.cx), q16(j.cy), 0, 0, 0, 0, 0};
    int64_t points = 0;
    for (int k = 0; k < 32; k++) {
        const double length = static_cast<double>(e.a + e.b) / 2 * CV_PI / 16;
        const bool there = (k - j.from + 32) % 32 < j.bins;
        const int64_t n = there ? std::max<int64_t>(1, static_cast<int64_t>(length * random.uniform(0.7, 0.95))) : 0;
        const double mean = j.noise * normal(random) / static_cast<double>(e.a);
        w.bins.push_back(n);
        w.bins.push_back(there ? q16(mean * static_cast<double>(n)) : 0);
        points += n;
    }
    const double ix = static_cast<double>(disc.xc) + j.inner_std * normal(random);
    const double iy = static_cast<double>(disc.yc) + j.inner_std * normal(random);
    w.params = {q16(j.rim), q16(j.inner), q16(j.depth)};
    for (const reference::Real v : {start.position[0], start.position[1], start.position[2], start.yaw, start.pitch}) {
        w.params.push_back(q16(static_cast<double>(v)));
    }
    for (const double v : {ix, iy, j.inner_std, j.shading, j.blur}) {
        w.params.push_back(q16(v));
    }
    w.params.push_back(points * j.gradient);
    w.params.push_back(j.steps);
    return w;
}

void add_words(Set &set, const std::string &name, Tier tier, const Flags &flags, const Words &w)
{
    set.add(name, tier, flags,
            {word_array("ellipse", 32, 16, w.ellipse), word_array("camera", 32, 16, w.camera),
             word_array("bins", 32, 16, w.bins), word_array("params", 32, 16, w.params)});
}

void add_job(Set &set, const std::string &name, Tier tier, const Flags &flags, const Job &j)
{
    accuracy::Random random = set.random(name);
    add_words(set, name, tier, flags, words_of(j, random));
}

void place(Job &j, double x, double y, double z, double yaw_deg, double pitch_deg)
{
    j.position[0] = x;
    j.position[1] = y;
    j.position[2] = z;
    j.yaw = yaw_deg * CV_PI / 180;
    j.pitch = pitch_deg * CV_PI / 180;
}

void add_grid(Set &set)
{
    for (const int z : {2, 3, 5, 9, 15, 25}) {
        for (const int tilt : {0, 8, 20, 30}) {
            const std::string name = "at-" + std::to_string(z) + "m-tilt-" + std::to_string(tilt);
            accuracy::Random random = set.random(name + " place");
            const double turn = random.uniform(0, 6.2);
            const double x = random.uniform(-0.15, 0.15);
            const double y = random.uniform(-0.15, 0.15);
            Job j;
            place(j, x * z, y * z, z, tilt * std::cos(turn), tilt * std::sin(turn));
            Flags flags;
            if (tilt == 0) {
                flags = {"head-on", "near-circle"};
            }
            add_job(set, name, Tier::ordinary, flags, j);
            j.inner_std = 0;
            flags.push_back("inner-missing");
            add_job(set, name + "-no-inner", Tier::ordinary, flags, j);
        }
    }
}

void add_starts(Set &set)
{
    Job j;
    place(j, 0.9, -0.7, 8, 14, -11);
    for (const int steps : {0, 1, 2, 5, 16}) {
        j.steps = steps;
        j.other = 0;
        add_job(set, "steps-" + std::to_string(steps), Tier::ordinary, {}, j);
        j.other = 1;
        add_job(set, "from-the-twin-steps-" + std::to_string(steps), Tier::ordinary, {"twin-pose"}, j);
    }
    j = Job();
    place(j, 0.1, 0.05, 6, 1, -1);
    j.start_at_truth = true;
    j.shift = 0;
    add_job(set, "from-the-truth", Tier::ordinary, {}, j);
    j = Job();
    place(j, 0, 0, 7, 0, 0);
    j.shift = 0;
    add_job(set, "on-the-axis", Tier::boundary, {"head-on", "near-circle"}, j);
}

/* From far off the limit of a step's length decides where it ends, and what is two semi-axes off ends it: x, y, z, yaw,
 * pitch. */
void add_far_starts(Set &set)
{
    static const std::array<int64_t, 5> starts[] = {
        {214995, -134986, 1582177, -21718, -30783}, {264126, -195135, 2128742, 22275, 5403},
        {136679, -92092, 983269, 55000, -6109},     {67633, -40429, 474488, 33501, -46565},
        {71510, -59491, 823120, -57225, 14017},     {262798, -49950, 1840003, 47135, -56830}};
    Job j;
    place(j, 2.1, -1.4, 15, -19, -5);
    j.inner_std = 0;
    for (size_t i = 0; i < std::size(starts); i++) {
        accuracy::Random random = set.random("far-start");
        Words w = words_of(j, random);
        std::copy(starts[i].begin(), starts[i].end(), w.params.begin() + 3);
        w.params.back() = i == 2 ? 1 : j.steps; /* one, of yaw, ends before it is there */
        add_words(set, "far-start-" + std::to_string(i + 1), Tier::stress, {"inner-missing"}, w);
    }
}

void add_weights(Set &set)
{
    struct Weight {
        const char *name;
        double noise, inner_std, shading, blur;
    };
    static const Weight weights[] = {{"outline-exact", 0.001, 0.5, 0.01, 0},   {"outline-rough", 1.5, 0.03, 3.8, 0.12},
                                     {"strong-shading", 0.1, 0.05, 300, 0.12}, {"strong-blur", 0.1, 0.05, 3.8, 4},
                                     {"vague-inner", 0.1, 8, 3.8, 0.12},       {"sharp-inner", 0.1, 0.002, 3.8, 0.12}};
    for (const Weight &w : weights) {
        Job j;
        place(j, -0.8, 0.6, 7, -12, 9);
        j.noise = w.noise;
        j.inner_std = w.inner_std;
        j.shading = w.shading;
        j.blur = w.blur;
        add_job(set, w.name, Tier::ordinary, {}, j);
    }
    for (const int bins : {5, 6, 8, 12, 20, 31}) {
        Job j;
        j.bins = bins;
        j.from = 9;
        add_job(set, "bins-" + std::to_string(bins), bins <= 5 ? Tier::must_reject : Tier::stress,
                {"arc", "threshold-met"}, j);
    }
}

void add_cameras(Set &set)
{
    Job j;
    j.fx = 800;
    j.fy = 820;
    add_job(set, "short-lens", Tier::ordinary, {}, j);
    j.fx = j.fy = 4000;
    place(j, 0.3, 0.2, 20, 10, 10);
    add_job(set, "long-lens", Tier::ordinary, {}, j);
    j = Job();
    j.fx = 1400;
    j.fy = 1500;
    j.cx = 320.25;
    j.cy = 240.75;
    add_job(set, "unequal-focal-lengths", Tier::ordinary, {}, j);
    j = Job();
    j.depth = 0;
    add_job(set, "inner-in-the-plane", Tier::boundary, {}, j);
    j.depth = -0.25;
    add_job(set, "inner-before-the-plane", Tier::ordinary, {"rounding-negative"}, j);
    j.depth = 0.25;
    j.inner = 0;
    add_job(set, "inner-a-point", Tier::boundary, {"degenerate"}, j);
    j = Job();
    place(j, 3, -2.5, 9, 20, -15);
    add_job(set, "far-off-the-axis", Tier::ordinary, {}, j);
}

void add_refusals(Set &set)
{
    Job j;
    accuracy::Random random = set.random("refusals");
    const Words good = words_of(j, random);
    Words w = good;
    w.params[2] = q16(-12);
    add_words(set, "inner-behind-camera", Tier::must_reject, {"behind-camera"}, w);
    w = good;
    w.params[5] = q16(-9);
    add_words(set, "start-behind-camera", Tier::must_reject, {"behind-camera"}, w);
    w = good;
    w.params[1] = q16(30);
    add_words(set, "inner-around-the-camera", Tier::must_reject, {"domain"}, w);
    w = good;
    w.params[3] = q16(12);
    w.params[6] = q16(-1.4);
    add_words(set, "inner-from-behind", Tier::must_reject, {"domain"}, w);
    w = good;
    w.params[13] = 0;
    add_words(set, "no-gradient", Tier::must_reject, {"degenerate"}, w);
    w = good;
    for (size_t k = 1; k < 64; k += 2) {
        w.bins[k] = 0;
    }
    add_words(set, "no-residuals", Tier::boundary, {"degenerate"}, w);
    w = good;
    w.params[8] = INT32_MAX;
    w.params[9] = INT32_MIN;
    add_words(set, "inner-far-outside", Tier::must_reject, {"saturation"}, w);
}

} // namespace

void add_joint(Set &set)
{
    set.begin("joint");
    add_grid(set);
    add_starts(set);
    add_far_starts(set);
    add_weights(set);
    add_cameras(set);
    add_refusals(set);
}

namespace {

/* What a case of the decision changes of a job's evidence. */
struct Evidence {
    int nearer = 0;
    double off_px = 0; /* of the inner part, to the right */
    double max_chi2 = 16, gap = 9;
    double doubt = 0;   /* share by which the inner part is not of its size */
    double too_far = 0; /* share by which the outline's pose is */
    int outside = 0;    /* parts outside which another edge shows */
    int behind = -1;    /* pose whose z is negative */
    bool inner = true;
};

void add_evidence(Set &set, const std::string &name, Tier tier, const Flags &flags, const Job &j, const Evidence &e)
{
    accuracy::Random random = set.random(name);
    const Words w = words_of(j, random);
    std::vector<int64_t> params(w.params.begin(), w.params.begin() + 3);
    for (size_t i = 0; i < 2; i++) {
        const reference::Pose &p = w.pair[i];
        for (const reference::Real v :
             {p.position[0], p.position[1], p.position[2], p.axis[0], p.axis[1], p.axis[2], p.yaw, p.pitch}) {
            params.push_back(q16(static_cast<double>(v)));
        }
        if (e.behind == static_cast<int>(i) || e.behind == 2) {
            params[params.size() - 6] = q16(-3);
        }
    }
    params.push_back(e.nearer);
    params.push_back(w.params[8] + q16(e.off_px));
    params.push_back(w.params[9]);
    params.push_back(e.inner ? w.params[10] : 0);
    params.insert(params.end(), {w.params[11], w.params[12], q16(e.max_chi2), q16(e.gap), w.params[13], q16(e.doubt),
                                 q16(e.too_far), e.outside});
    set.add(name, tier, flags,
            {word_array("ellipse", 32, 16, w.ellipse), word_array("camera", 32, 16, w.camera),
             word_array("bins", 32, 16, w.bins), word_array("params", 32, 16, params)});
}

} // namespace

void add_decide(Set &set)
{
    set.begin("decide");
    Job j;
    Evidence e;
    for (const int z : {3, 9, 20}) {
        for (const int tilt : {0, 3, 12, 28}) {
            place(j, 0.1 * z, -0.07 * z, z, tilt * 0.8, -tilt * 0.6);
            const std::string name = "at-" + std::to_string(z) + "m-tilt-" + std::to_string(tilt);
            Flags flags;
            if (tilt == 0) {
                flags = {"head-on", "near-circle"};
            }
            for (e.nearer = 0; e.nearer < 2; e.nearer++) { /* the other one is named nearer: the better wins */
                add_evidence(set, name + (e.nearer != 0 ? "-twin-nearer" : ""), Tier::ordinary, flags, j, e);
            }
        }
    }
    e = Evidence();
    place(j, 0.9, -0.7, 8, 14, -11);
    e.inner = false;
    for (e.nearer = 0; e.nearer < 2; e.nearer++) {
        add_evidence(set, e.nearer != 0 ? "no-inner-second" : "no-inner", Tier::ordinary, {"inner-missing"}, j, e);
    }
    e = Evidence();
    for (const double off : {0.1, 0.2, 0.3, 1.0, 4.0, 60.0}) { /* agrees less and less, then contradicts the outline */
        e.off_px = off;
        e.nearer = 0;
        const std::string name = off < 1 ? "inner-off-tenths-" + std::to_string(std::lround(10 * off))
                                         : "inner-off-" + std::to_string(std::lround(off));
        add_evidence(set, name, Tier::stress, {"twin-pose"}, j, e);
        e.nearer = 1;
        add_evidence(set, name + "-twin", Tier::stress, {"twin-pose"}, j, e);
    }
    for (const int tilt :
         {1, 2, 3, 5}) { /* and the poses lie so near each other that this decides nothing, then does */
        place(j, 0.9, -0.7, 8, tilt, -0.8 * tilt);
        e = Evidence();
        e.off_px = 4;
        add_evidence(set, "inner-off-4-tilt-" + std::to_string(tilt), Tier::stress, {"twin-pose", "near-circle"}, j, e);
    }
    place(j, 0.9, -0.7, 8, 14, -11);
    e = Evidence();
    e.off_px = 4;
    e.max_chi2 = 10000;
    add_evidence(set, "contradiction-allowed", Tier::stress, {"twin-pose"}, j, e);
    e = Evidence();
    for (const double doubt : {0.03, 0.1, 1.0}) {
        e.doubt = doubt;
        for (const double off : {0.0, 60.0}) { /* agrees, contradicts the outline */
            e.off_px = off;
            add_evidence(
                set, "doubt-percent-" + std::to_string(std::lround(100 * doubt)) + (off > 0 ? "-contradiction" : ""),
                Tier::stress, {"twin-pose"}, j, e);
        }
    }
    e.off_px = 0;
    e.inner = false;
    add_evidence(set, "doubt-of-nothing", Tier::stress, {"inner-missing"}, j, e);
    e.doubt = 0;
    e.outside = 5;
    add_evidence(set, "outside-5-without-inner", Tier::stress, {"inner-missing"}, j, e);
    e.inner = true;
    for (const int outside : {1, 4, 8}) {
        for (const double doubt : {0.0, 0.03, 1.0}) { /* with all of it there is no more */
            e.outside = outside;
            e.doubt = doubt;
            add_evidence(set,
                         "outside-" + std::to_string(outside) + "-doubt-percent-" +
                             std::to_string(std::lround(100 * doubt)),
                         Tier::stress, {"twin-pose"}, j, e);
        }
    }
    for (const double too_far : {0.004, 0.03, 0.09}) { /* more than is in doubt, less, of nothing */
        e = Evidence();
        e.too_far = too_far;
        e.doubt = 0.02;
        for (const double off : {0.1, 0.2, 0.3, 1.0, 60.0}) { /* by noise, by more, and is anything */
            e.off_px = off;
            add_evidence(set,
                         "too-far-" + std::to_string(std::lround(1000 * too_far)) + "-of-1000-off-" +
                             std::to_string(std::lround(10 * off)),
                         Tier::stress, {"twin-pose"}, j, e);
        }
    }
    e.inner = false;
    add_evidence(set, "too-far-of-nothing", Tier::stress, {"inner-missing"}, j, e);
    e = Evidence();
    e.gap = 30000;
    add_evidence(set, "gap-never", Tier::boundary, {"threshold-met"}, j, e);
    e.gap = 0;
    add_evidence(set, "gap-always", Tier::boundary, {"threshold-met"}, j, e);
    e = Evidence();
    for (e.behind = 0; e.behind < 3; e.behind++) { /* one solve fails, or both */
        for (e.nearer = 0; e.nearer < 2; e.nearer++) {
            add_evidence(set, "behind-" + std::to_string(e.behind) + "-nearer-" + std::to_string(e.nearer),
                         e.behind == 2 ? Tier::must_reject : Tier::stress, {"behind-camera"}, j, e);
        }
    }
    e = Evidence();
    j.bins = 5;
    add_evidence(set, "too-few-bins", Tier::must_reject, {"arc", "degenerate"}, j, e);
    j.bins = 10;
    add_evidence(set, "few-bins", Tier::stress, {"arc"}, j, e);
    j = Job();
    place(j, 0.2, 0.1, 6, 2, 1);
    j.inner_std = 1.5; /* says little: what lies between the poses is in the covariance */
    add_evidence(set, "vague-inner", Tier::ordinary, {"twin-pose"}, j, e);
    place(j, 0, 0, 6, 0, 0);
    j.shift = 0;
    j.inner_std = 0.05;
    add_evidence(set, "same-solution", Tier::boundary, {"head-on", "near-circle"}, j, e);
    j = Job();
    place(j, 0.4, 0.5, 7, 10, 60); /* the axis's deviation counts yaw by cos^2 pitch */
    add_evidence(set, "steep-pitch", Tier::stress, {}, j, e);
    place(j, 0.4, 0.5, 7, 60, 10);
    add_evidence(set, "steep-yaw", Tier::stress, {}, j, e);
}

} // namespace vectors
