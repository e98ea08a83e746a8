/* SPDX-License-Identifier: Apache-2.0 */
/* Whole frames with clutter: the library's search beside the methods that the paper names. */
#include <array>

#include "all_systems.hpp"
#include "parallel.hpp"
#include "regions.hpp"
#include "study.hpp"
#include "whole_frame.hpp"

namespace accuracy {

namespace {

enum : size_t { ours_search, ours_measured, ours_inner, huang, ma, xin, finders };
constexpr std::array<const char *, finders> names = {
    "ours, first sighting",        "ours, sighted and measured", "ours, that with its inner part",
    "Huang: the port's dark disc", "Ma: nested outlines",        "Xin: matched views"};

struct Found {
    std::array<Sight, finders> with, without; /* the drogue in the frame */
    std::array<double, finders> ms;
};

Sight first_sighting(const cv::Mat &image)
{
    std::vector<uint8_t> memory(DROGUE_SEARCH_BYTES(static_cast<size_t>(image.cols)));
    drogue_search search;
    CV_Assert(drogue_search_init(&search, memory.data(), memory.size(), image.cols) == DROGUE_OK &&
              drogue_search_begin(&search, image.cols) == DROGUE_OK);
    for (int y = 0; y < image.rows; y++) {
        drogue_search_row(&search, image.ptr<uint8_t>(y));
    }
    if (drogue_search_end(&search) == 0) {
        return {};
    }
    const drogue_sighting &s = search.best[0];
    return {true, cv::Point2d(s.x_px, s.y_px), s.region.width_px / 2.5};
}

Sight sight_of(const drogue_result &r, bool believed)
{
    return {r.status == DROGUE_OK && believed,
            {from_q16(r.ideal.xc_px_q16), from_q16(r.ideal.yc_px_q16)},
            from_q16(r.ideal.a_px_q16)};
}

/* The reference view for Xin: the same drogue in the same light 8 m off, frontal, before an even background. */
ViewMatcher reference_of(const Trial &t)
{
    Scene s = t.scene;
    s.pose = {{0, 0, 8}, {0, 0, 1}};
    s.background = Background::cloud();
    s.sensor = Sensor();
    s.probe = Probe();
    const Ellipse rim = s.rim();
    const int half = static_cast<int>(1.5 * rim.a_px);
    const cv::Rect part(static_cast<int>(rim.xc_px) - half, static_cast<int>(rim.yc_px) - half, 2 * half, 2 * half);
    return {render(s, part), {rim.xc_px - part.x, rim.yc_px - part.y, rim.a_px, rim.b_px, rim.angle_rad}};
}

std::array<Sight, finders> look(const cv::Mat &image, const Trial &t, const ViewMatcher &matcher,
                                const cv::Point &origin, std::array<double, finders> &ms)
{
    const Body body = body_of(t.model);
    std::array<Sight, finders> found;
    double begin = thread_ms();
    const auto timed = [&](size_t which, const Sight &sight) {
        found[which] = sight;
        const double now = thread_ms();
        ms[which] = now - begin;
        begin = now;
    };
    timed(ours_search, first_sighting(image));
    const drogue_result r = acquire(image, t.scene.camera.cropped(origin), t.model).result;
    timed(ours_measured, sight_of(r, true));
    found[ours_inner] = sight_of(r, r.has_inner != 0);
    ms[ours_inner] = ms[ours_measured];
    timed(huang, find_port(image, body));
    timed(ma, find_nested(image, body));
    timed(xin, matcher.find(image));
    return found;
}

Found find_in(const Trial &t)
{
    const cv::Rect frame = frame_of(t);
    const ViewMatcher matcher = reference_of(t);
    Found f;
    f.without = look(empty_frame(t, frame), t, matcher, frame.tl(), f.ms);
    f.with = look(whole_frame(t, frame), t, matcher, frame.tl(), f.ms);
    for (Sight &s : f.with) {
        s.middle_px += cv::Point2d(frame.tl());
    }
    return f;
}

} // namespace

void section_regions(Report &report, const StudyOptions &options)
{
    std::vector<Trial> trials;
    for (int i = 0; i < options.pick(40, 6); i++) {
        trials.push_back(trial(hash_at(options.seed, 43, 7), Condition::clutter, i));
    }
    std::vector<Found> found(trials.size());
    report.section("Finding the drogue in whole frames");
    parallel_for(
        trials.size(), options.threads, [&](size_t i) { found[i] = find_in(trials[i]); },
        [&](size_t done, size_t total) { report.progress("finding regions", done, total); });
    report.text(
        "Frames of " + std::to_string(frame_px) +
        " px and more a side with clutter, 2 to 25 m, each with the drogue and without. Hit: the region named first "
        "is one that a measurement can use (middle within 0.35 semi-axes, size within a quarter); false alarm: a "
        "region is named elsewhere, or where there is no drogue. Time: over that of our search with measurement.");
    std::vector<Report::Row> rows;
    std::array<int, finders> hits = {}, alarms = {};
    for (size_t k = 0; k < finders; k++) {
        int none = 0, elsewhere = 0, empty = 0;
        std::vector<double> times;
        for (size_t i = 0; i < found.size(); i++) {
            const Sight &s = found[i].with[k];
            const bool hit = s.ok && suits(s.middle_px, 2.5 * s.semi_axis_px, trials[i].rim);
            hits[k] += hit;
            none += !s.ok;
            elsewhere += s.ok && !hit;
            empty += found[i].without[k].ok;
            times.push_back(found[i].ms[k] / found[i].ms[ours_measured]);
        }
        alarms[k] = elsewhere + empty;
        rows.push_back({names[k], std::to_string(hits[k]) + " of " + std::to_string(trials.size()),
                        std::to_string(none), std::to_string(elsewhere),
                        std::to_string(empty) + " of " + std::to_string(trials.size()), significant(median(times), 2)});
    }
    report.table({"method", "hits", "nothing named", "false, with drogue", "false, without", "time, ours"}, rows);
    for (const size_t k : {size_t{huang}, size_t{ma}, size_t{xin}}) {
        report.at_least(std::string("hits in whole frames: ours, measured, less those of ") + names[k],
                        hits[ours_measured] - hits[k], 0, "");
    }
}

} // namespace accuracy
