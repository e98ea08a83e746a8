/* SPDX-License-Identifier: Apache-2.0 */
/* Runs all methods of table 5 on the same pictures. */
#include "comparison.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "drogue/track.h"
#include "evaluate.hpp"
#include "measure.hpp"
#include "parallel.hpp"

namespace accuracy {

const std::array<Method, methods> method_table = {{
    {"Martinez", false, false, false, {1.17, 1.75, 4.45, 2.46}},
    {"Yin", false, false, false, {2.33, 2.60, 10.83, 5.25}},
    {"Ma, Zhao", false, false, false, {1.53, 2.31, 2.56, 2.13}},
    {"Sun", false, false, false, {1.09, 1.51, 1.89, 1.50}},
    {"Shiu, Ahmad", false, false, false, {0, 0, 0, 0}},
    {"ours", true, false, false, {1.32, 2.05, 2.42, 1.93}},
    {"ours", false, true, false, {1.13, 1.93, 1.78, 1.61}},
    {"ours", false, false, true, {1.43, 2.13, 2.25, 1.94}},
    {"ours", true, true, false, {0.89, 1.03, 1.65, 1.19}},
    {"ours", true, false, true, {1.27, 1.98, 2.13, 1.79}},
    {"ours", false, true, true, {0.93, 0.98, 1.70, 1.20}},
    {"ours", true, true, true, {0.86, 0.92, 1.54, 1.11}},
}};

Extraction Method::extraction() const
{
    return arcs ? (quality ? Extraction::both : Extraction::arcs) : quality ? Extraction::quality : Extraction::nothing;
}

namespace {

cv::Vec3d vector_of(const drogue_q16 v[3]) { return {from_q16(v[0]), from_q16(v[1]), from_q16(v[2])}; }

Estimate estimate_of(const drogue_result &r)
{
    Estimate e;
    if (r.status == DROGUE_OK) {
        e.ok = e.has_axis = true;
        e.position_m = vector_of(r.pose.position_m_q16);
        e.axis = vector_of(r.pose.axis_q16);
    }
    return e;
}

/* The tracker over one extraction's results. */
class Filter {
public:
    Filter(const Camera &camera, const drogue_model &model, const cv::Rect &first)
    {
        const drogue_camera q_camera = {
            to_q16(camera.fx_px), to_q16(camera.fy_px), to_q16(camera.cx_px), to_q16(camera.cy_px), 0, 0, 0, 0, 0};
        const drogue_region region = {first.x, first.y, first.width, first.height};
        drogue_track_config config;
        drogue_track_config_default(&config);
        (void)drogue_track_init(&track_, &config, &q_camera, &model, &region);
    }

    Estimate operator()(const drogue_result &result, double dt_s)
    {
        drogue_region unused; /* all methods look where the detector says */
        drogue_track_estimate now;
        Estimate e;
        drogue_track_begin(&unused, &track_, static_cast<uint32_t>(std::lround(dt_s * 1e6)));
        if (drogue_track_end(&track_, &result) != DROGUE_LOST) {
            drogue_track_get(&now, &track_);
            e.ok = e.has_axis = true;
            e.position_m = vector_of(now.position_m_q16);
            e.axis = vector_of(now.axis_q16);
        }
        return e;
    }

private:
    drogue_track track_;
};

void filter_rows(std::vector<FrameResult> &frames, const Approach &approach)
{
    for (size_t k = 0; k < methods; k++) {
        if (!method_table[k].filter) {
            continue;
        }
        Filter filter(approach.scene(0).camera, approach.model(), approach.region(0));
        for (FrameResult &f : frames) {
            f.estimate[k] = filter(f.result[static_cast<size_t>(method_table[k].extraction())], approach.dt_s);
        }
    }
}

} // namespace

Body body_of(const drogue_model &model)
{
    return {from_q16(model.rim_radius_m_q16), from_q16(model.inner_radius_m_q16), from_q16(model.inner_depth_m_q16)};
}

Features features_of(const Measurement &m, const cv::Mat &image)
{
    Features f;
    f.outer = m.ideal;
    f.has_inner = m.raw.has_inner != 0;
    if (f.has_inner) {
        f.inner_area_px = m.raw.inner.area_px;
        f.inner_px = m.inner_px; /* no distortion */
        f.has_inner_ellipse = inner_ellipse(f.inner, image, f.inner_px, f.inner_area_px, m.raw.inner.threshold);
    }
    return f;
}

FrameResult compare_frame(const cv::Mat &image, const Camera &camera, const drogue_model &model, const cv::Rect &region)
{
    const Body body = body_of(model);
    const Measurement m = measure(image, camera, model, region);
    FrameResult f;
    f.result = ablate(image, camera, model, region, m.raw);
    if (m.ok) {
        const Features features = features_of(m, image);
        f.estimate[0] = martinez(features, camera, body);
        f.estimate[1] = yin(features, camera, body);
        f.estimate[2] = ma_zhao(features, camera, body);
        f.estimate[3] = sun(features, camera, body);
        f.estimate[4] = shiu_ahmad(features, camera, body);
    }
    for (size_t k = 0; k < methods; k++) {
        if (!method_table[k].baseline() && !method_table[k].filter) {
            f.estimate[k] = estimate_of(f.result[static_cast<size_t>(method_table[k].extraction())]);
        }
    }
    return f;
}

void MethodErrors::add(const Estimate &estimate, const Pose &truth)
{
    pictures++;
    if (!estimate.ok) {
        return;
    }
    const cv::Vec3d miss = (estimate.position_m - truth.position_m) * (100 / truth.position_m[2]);
    for (int i = 0; i < 3; i++) {
        percent[static_cast<size_t>(i)].push_back(std::fabs(miss[i]));
    }
    gross += cv::norm(miss) > 3;
    if (estimate.has_axis) {
        axis_deg.push_back(angle_between_deg(estimate.axis, truth.axis));
    }
}

std::array<double, 4> MethodErrors::mean_percent() const
{
    const std::array<double, 3> m = {mean(percent[0]), mean(percent[1]), mean(percent[2])};
    return {m[0], m[1], m[2], (m[0] + m[1] + m[2]) / 3};
}

std::array<double, 4> MethodErrors::median_percent() const
{
    std::vector<double> average;
    for (size_t i = 0; i < measured(); i++) {
        average.push_back((percent[0][i] + percent[1][i] + percent[2][i]) / 3);
    }
    return {median(percent[0]), median(percent[1]), median(percent[2]), median(average)};
}

std::vector<Comparison> compare_approaches(const std::vector<Approach> &approaches, int threads,
                                           const Progress &progress)
{
    struct Place {
        size_t approach;
        int frame;
    };
    std::vector<Place> places;
    std::vector<std::vector<FrameResult>> results;
    for (size_t a = 0; a < approaches.size(); a++) {
        for (int i = 0; i < approaches[a].frames; i++) {
            places.push_back({a, i});
        }
        results.emplace_back(static_cast<size_t>(approaches[a].frames));
    }
    parallel_for(
        places.size(), threads,
        [&](size_t i) {
            const Approach &a = approaches[places[i].approach];
            const int frame = places[i].frame;
            const Scene scene = a.scene(frame);
            const cv::Rect region = a.region(frame);
            const cv::Rect seen = region & cv::Rect({0, 0}, scene.image_px);
            cv::Mat image = cv::Mat::zeros(scene.image_px, CV_8U);
            render(scene, seen).copyTo(image(seen));
            results[places[i].approach][static_cast<size_t>(frame)] =
                compare_frame(image, scene.camera, a.model(), region);
        },
        progress);
    std::vector<Comparison> comparisons(approaches.size());
    for (size_t a = 0; a < approaches.size(); a++) {
        filter_rows(results[a], approaches[a]);
        for (int i = 0; i < approaches[a].frames; i++) {
            for (size_t k = 0; k < methods; k++) {
                comparisons[a][k].add(results[a][static_cast<size_t>(i)].estimate[k], approaches[a].pose(i));
            }
        }
    }
    return comparisons;
}

Comparison compare_trials(const std::vector<Trial> &trials, const std::string &cache, int threads,
                          const Progress &progress)
{
    std::vector<FrameResult> results(trials.size());
    if (!cache.empty()) {
        std::filesystem::create_directories(cache);
    }
    parallel_for(
        trials.size(), threads,
        [&](size_t i) {
            const Trial &t = trials[i];
            cv::Mat image = cv::Mat::zeros(t.scene.image_px, CV_8U);
            picture_of(t, cache).copyTo(image(t.region));
            results[i] = compare_frame(image, t.scene.camera, t.model, t.region);
        },
        progress);
    Comparison c;
    for (size_t i = 0; i < trials.size(); i++) {
        for (size_t k = 0; k < methods; k++) {
            if (!method_table[k].filter) {
                c[k].add(results[i].estimate[k], trials[i].pose);
            }
        }
    }
    return c;
}

Comparison joined(const std::vector<Comparison> &parts)
{
    Comparison all;
    const auto append = [](std::vector<double> &to, const std::vector<double> &from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    for (const Comparison &part : parts) {
        for (size_t k = 0; k < methods; k++) {
            all[k].pictures += part[k].pictures;
            all[k].gross += part[k].gross;
            append(all[k].axis_deg, part[k].axis_deg);
            for (size_t i = 0; i < 3; i++) {
                append(all[k].percent[i], part[k].percent[i]);
            }
        }
    }
    return all;
}

} // namespace accuracy
