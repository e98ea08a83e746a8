/* SPDX-License-Identifier: Apache-2.0 */
/* What fixed point costs: the library's errors beside those of the same pipeline in floating point, on the same edge
 * points and pixels. */
#include <cmath>

#include "mirror.hpp"
#include "parallel.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

constexpr double most_ratio = 1.01;

mirror::Task task_of(const Trial &t, const cv::Mat &image)
{
    const Camera &c = t.scene.camera;
    const auto q = [](double v) { return from_q16(to_q16(v)); }; /* the numbers that the library is given */
    const auto side = static_cast<uint32_t>(std::max(t.region.width, t.region.height));
    mirror::Task task = {
        image,
        {q(c.fx_px), q(c.fy_px), q(c.cx_px), q(c.cy_px), q(c.k1), q(c.k2), q(c.p1), q(c.p2), q(c.k3)},
        {from_q16(t.model.rim_radius_m_q16), from_q16(t.model.inner_radius_m_q16), from_q16(t.model.inner_depth_m_q16)},
        {t.region.x, t.region.y, t.region.width, t.region.height},
        {},
        DROGUE_CAPACITY_FOR(side),
        {},
        t.model};
    drogue_config_default(&task.config);
    return task;
}

Ellipse plain(const reference::Ellipse &e)
{
    return {static_cast<double>(e.xc), static_cast<double>(e.yc), static_cast<double>(e.a), static_cast<double>(e.b),
            static_cast<double>(e.angle)};
}

Pose plain(const reference::Pose &p)
{
    Pose out;
    for (int k = 0; k < 3; k++) {
        out.position_m[k] = static_cast<double>(p.position[static_cast<size_t>(k)]);
        out.axis[k] = static_cast<double>(p.axis[static_cast<size_t>(k)]);
    }
    return out;
}

/* The mirror's result in the form that is judged. */
Measurement measured(const mirror::Result &r)
{
    Measurement m = {};
    m.raw.status = r.status;
    m.raw.has_inner = r.has_inner;
    m.raw.orientation_resolved = r.resolved;
    m.ok = r.status == DROGUE_OK;
    m.seen = plain(r.seen);
    m.ideal = plain(r.ideal);
    m.pose = plain(r.pose);
    m.alternative = plain(r.alternative);
    return m;
}

struct Both {
    Outcome library, mirror;
};

std::vector<Both> run_both(Report &report, const std::vector<Trial> &trials, const StudyOptions &options)
{
    std::vector<Both> all(trials.size());
    parallel_for(
        trials.size(), options.threads,
        [&](size_t i) {
            const Trial &t = trials[i];
            cv::Mat image = cv::Mat::zeros(t.scene.image_px, CV_8U);
            picture_of(t, options.cache).copyTo(image(t.region)); /* nothing else is looked at */
            all[i].library = judge(t, measure(image, t.scene.camera, t.model, t.region));
            all[i].mirror = judge(t, measured(mirror::measure(task_of(t, image))));
        },
        [&](size_t done, size_t total) { report.progress("loss against double", done, total); });
    return all;
}

bool counts(const Outcome &o) { return o.verdict == Verdict::right && o.resolved && !o.twin; }

/* x, y, z, axis; position in metres or in % of the distance. */
double error_of(const Outcome &o, int quantity, bool relative)
{
    if (quantity == 3) {
        return o.axis_deg;
    }
    return o.position_m[quantity] * (relative ? 100 / o.distance_m : 1);
}

double rms(const std::vector<Both> &all, Outcome Both::*side, int quantity, bool relative)
{
    double sum = 0;
    int count = 0;
    for (const Both &b : all) {
        if (counts(b.library) && counts(b.mirror)) {
            const double e = error_of(b.*side, quantity, relative);
            sum += e * e;
            count++;
        }
    }
    return std::sqrt(sum / count);
}

/* Largest difference between the two over the scenes that count. */
double most_apart(const std::vector<Both> &all, int quantity)
{
    double most = 0;
    for (const Both &b : all) {
        if (counts(b.library) && counts(b.mirror)) {
            most = std::max(most, std::fabs(error_of(b.library, quantity, true) - error_of(b.mirror, quantity, true)));
        }
    }
    return most;
}

} // namespace

void section_loss(Report &report, const StudyOptions &options)
{
    static const char *const names[] = {"x", "y", "z", "axis"};
    const std::vector<Trial> trials = study_trials(options);
    const std::vector<Both> all = run_both(report, trials, options);
    int both = 0, library_alone = 0, mirror_alone = 0;
    for (const Both &b : all) {
        both += counts(b.library) && counts(b.mirror);
        library_alone += counts(b.library) && !counts(b.mirror);
        mirror_alone += !counts(b.library) && counts(b.mirror);
    }
    report.section("Loss against double");
    report.text(
        "The library beside the same pipeline in floating point of 53 bits and more, every decision its own, from "
        "the same edge points and pixels. Over the scenes of all conditions that both measure right, with the "
        "orientation resolved and not as the twin: " +
        std::to_string(both) + " of " + std::to_string(all.size()) + "; only the library does so in " +
        std::to_string(library_alone) + ", only floating point in " + std::to_string(mirror_alone) +
        ". A pose that is the other one's twin is off by degrees and would be all that the root of the mean "
        "square shows. 'apart': the largest difference between the two in one scene.");
    std::vector<Report::Row> rows;
    for (int q = 0; q < 4; q++) {
        double worst = 0;
        for (const bool relative : {false, true}) {
            if (q == 3 && relative) {
                continue;
            }
            const double fixed_point = rms(all, &Both::library, q, relative),
                         real = rms(all, &Both::mirror, q, relative);
            const double ratio = fixed_point / real;
            worst = std::isfinite(ratio) ? std::max(worst, ratio) : ratio;
            const bool percent = relative && q < 3;
            rows.push_back({std::string(names[q]) + (q == 3    ? ", degrees"
                                                     : percent ? ", % of the distance"
                                                               : ", mm"),
                            significant(fixed_point * (q == 3 || percent ? 1 : 1000), 5),
                            significant(real * (q == 3 || percent ? 1 : 1000), 5), fixed(ratio, 5),
                            q == 3 || percent ? significant(most_apart(all, q), 2) : "-"});
        }
        report.at_most(std::string("fixed point over double, RMS, ") + names[q], worst, most_ratio, "");
    }
    report.table({"RMS error", "fixed point", "double", "ratio", "apart"}, rows);
}

} // namespace accuracy
