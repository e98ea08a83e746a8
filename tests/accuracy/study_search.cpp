/* SPDX-License-Identifier: Apache-2.0 */
/* The search of whole frames in the study: how often it sights the drogue, and how often a measurement follows. */
#include <algorithm>
#include <cmath>

#include "drogue/search.h"
#include "parallel.hpp"
#include "study.hpp"

namespace accuracy {

namespace {

constexpr int frame_px = 1024; /* larger when the drogue is */

struct Found {
    Condition condition;
    int rank = -1; /* of the sighting that suits the drogue */
    bool right = false;
    bool wrong = false;
};

/* A part of the trial's image with the drogue somewhere in it. */
cv::Rect frame_of(const Trial &t)
{
    const int side = std::max(frame_px, static_cast<int>(std::lround(3.2 * t.rim.a_px)));
    const double room = 0.5 - 0.5 * std::min(1.0, 2.6 * t.rim.a_px / side);
    Random random(hash_at(t.scene.seed, 1, 2));
    const int x = static_cast<int>(std::lround(t.rim.xc_px - side * (0.5 + room * random.uniform(-1, 1))));
    const int y = static_cast<int>(std::lround(t.rim.yc_px - side * (0.5 + room * random.uniform(-1, 1))));
    return cv::Rect(x, y, side, side) & cv::Rect({0, 0}, t.scene.image_px);
}

/* The frame: about the drogue as rendered, elsewhere the background with the sensor's noise alone. */
cv::Mat picture(const Trial &t, const cv::Rect &frame)
{
    const Scene &s = t.scene;
    cv::Mat image(frame.size(), CV_8U);
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            image.at<uint8_t>(y, x) = cv::saturate_cast<uint8_t>(background_grey(s, x + frame.x, y + frame.y) +
                                                                 s.sensor.noise * normal_at(s.seed + 5, x, y));
        }
    }
    const int half = static_cast<int>(std::lround(2 * t.rim.a_px)) + 20;
    const cv::Rect about = cv::Rect(static_cast<int>(std::lround(t.rim.xc_px)) - half,
                                    static_cast<int>(std::lround(t.rim.yc_px)) - half, 2 * half, 2 * half) &
                           frame;
    render(s, about).copyTo(image(about - frame.tl()));
    return image;
}

/* A sighting suits when its region is one that drogue_measure() can use: centre within 0.35 semi-axes, side within a
 * quarter of 2.5 of them. */
int rank_of(const drogue_search &search, const Ellipse &rim, const cv::Point &origin)
{
    for (int k = 0; k < search.count; k++) {
        const drogue_sighting &s = search.best[k];
        const double off = std::hypot(s.x_px + origin.x - rim.xc_px, s.y_px + origin.y - rim.yc_px);
        const double side = s.region.width_px / (2.5 * rim.a_px);
        if (off < 0.35 * rim.a_px && side > 0.8 && side < 1.25) {
            return k;
        }
    }
    return -1;
}

Found search_frame(const Trial &t)
{
    const cv::Rect frame = frame_of(t);
    const cv::Mat image = picture(t, frame);
    const Camera c = t.scene.camera.cropped(frame.tl());
    const drogue_camera camera = {to_q16(c.fx_px), to_q16(c.fy_px), to_q16(c.cx_px), to_q16(c.cy_px), to_q16(c.k1),
                                  to_q16(c.k2),    to_q16(c.p1),    to_q16(c.p2),    to_q16(c.k3)};
    const drogue_image view = {image.data, image.cols, image.rows, static_cast<int32_t>(image.step)};
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(std::max(image.cols, image.rows));
    std::vector<uint32_t> memory(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
    std::vector<uint8_t> search_memory(DROGUE_SEARCH_BYTES(static_cast<size_t>(image.cols)));
    drogue_workspace workspace;
    drogue_search search;
    drogue_config config;
    drogue_result result;
    Found found;
    found.condition = t.condition;
    CV_Assert(drogue_workspace_init(&workspace, memory.data(), memory.size() * sizeof(uint32_t), &capacity) ==
                  DROGUE_OK &&
              drogue_search_init(&search, search_memory.data(), search_memory.size(), image.cols) == DROGUE_OK);
    drogue_config_default(&config);
    const drogue_setup setup = {&camera, &t.model, &config};
    (void)drogue_acquire(&result, &search, &workspace, &setup, &view, nullptr);
    found.rank = rank_of(search, t.rim, frame.tl());
    if (result.status == DROGUE_OK) {
        const double limit = std::max(1.0, 0.03 * t.rim.a_px);
        found.right = std::fabs(from_q16(result.ideal.xc_px_q16) + frame.x - t.rim.xc_px) < limit &&
                      std::fabs(from_q16(result.ideal.yc_px_q16) + frame.y - t.rim.yc_px) < limit &&
                      std::fabs(from_q16(result.ideal.a_px_q16) - t.rim.a_px) < limit;
        found.wrong = !found.right;
    }
    return found;
}

} // namespace

void section_search(Report &report, const StudyOptions &options)
{
    std::vector<Trial> trials;
    for (int c = 0; c < conditions; c++) {
        const auto condition = static_cast<Condition>(c);
        const int count = condition == Condition::plain ? options.pick(100, 3) : options.pick(16, 1);
        for (int i = 0; i < count; i++) {
            trials.push_back(trial(hash_at(options.seed, 41, 7), condition, i));
        }
    }
    std::vector<Found> found(trials.size());
    report.section("Search of whole frames");
    parallel_for(
        trials.size(), options.threads, [&](size_t i) { found[i] = search_frame(trials[i]); },
        [&](size_t done, size_t total) { report.progress("search", done, total); });
    report.text("Frames of " + std::to_string(frame_px) +
                " px and more a side with the drogue anywhere in them, 2 to "
                "25 m: its place among the sightings, and what drogue_acquire() made of them (right: centre and "
                "semi-axis within 3 % of the semi-axis or 1 px).");
    std::vector<Report::Row> rows;
    for (int c = 0; c < conditions; c++) {
        const auto condition = static_cast<Condition>(c);
        int frames = 0, first = 0, among = 0, right = 0, wrong = 0;
        for (const Found &f : found) {
            if (f.condition == condition) {
                frames++;
                first += f.rank == 0;
                among += f.rank >= 0;
                right += f.right;
                wrong += f.wrong;
            }
        }
        rows.push_back({name_of(condition), std::to_string(frames), std::to_string(first), std::to_string(among),
                        std::to_string(right), std::to_string(wrong)});
        if (condition == Condition::plain) {
            report.at_least("plain frames whose drogue is among the first eight sightings", 100.0 * among / frames, 98,
                            "%");
        }
    }
    report.table({"condition", "frames", "first", "first eight", "measured right", "wrong"}, rows);
}

} // namespace accuracy
