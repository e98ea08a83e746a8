/* SPDX-License-Identifier: Apache-2.0 */
/* Every method of the paper's table 5 on the same pictures: baselines, reduced extractions, each with and without
 * the filter. */
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "ablation.hpp"
#include "approach.hpp"
#include "baselines.hpp"
#include "conditions.hpp"
#include "measure.hpp"

namespace accuracy {

/* Rows of the table, in the paper's order; its row of Shiu and Ahmad's form is ours. */
struct Method {
    const char *name;
    bool arcs, quality, filter;  /* (1), (2), (3); of our own rows */
    std::array<double, 4> paper; /* x, y, z, average, % of the distance; 0 where the paper has none */
    bool baseline() const { return name[0] != '\0' && std::string(name) != "ours"; }
    Extraction extraction() const;
};
constexpr size_t methods = 12;
extern const std::array<Method, methods> method_table;
constexpr size_t ours_whole = methods - 1; /* (1) + (2) + (3) */
constexpr size_t ours_single = 8;          /* (1) + (2), no filter */

Body body_of(const drogue_model &model);

/* The library's features of a picture, and an inner ellipse at its threshold; without distortion. */
Features features_of(const Measurement &m, const cv::Mat &image);

/* What each method says of one picture; rows with the filter are empty here. */
struct FrameResult {
    std::array<Estimate, methods> estimate;
    std::array<drogue_result, extractions> result; /* for the filter */
};

/* All methods but the filter on one picture.
 *
 *  image    the whole image; only the region is looked at
 */
FrameResult compare_frame(const cv::Mat &image, const Camera &camera, const drogue_model &model,
                          const cv::Rect &region);

/* Errors of one method over pictures. */
struct MethodErrors {
    int pictures = 0;
    std::array<std::vector<double>, 3> percent; /* |x|, |y|, |z| error, % of the distance, where there is an estimate */
    std::vector<double> axis_deg;               /* of methods that give an axis */
    int gross = 0;                              /* estimates off by more than 3 % of the distance */

    void add(const Estimate &estimate, const Pose &truth);
    size_t measured() const { return percent[0].size(); }
    std::array<double, 4> mean_percent() const; /* x, y, z, average */
    std::array<double, 4> median_percent() const;
};
using Comparison = std::array<MethodErrors, methods>;

using Progress = std::function<void(size_t, size_t)>;

/* Approaches, picture by picture in the detector's regions; the filter is the library's tracker at its defaults, fed
 * with each extraction's results in turn. One comparison for each approach. */
std::vector<Comparison> compare_approaches(const std::vector<Approach> &approaches, int threads,
                                           const Progress &progress);

/* Single scenes; rows with the filter stay empty. */
Comparison compare_trials(const std::vector<Trial> &trials, const std::string &cache, int threads,
                          const Progress &progress);

/* One comparison over all of several. */
Comparison joined(const std::vector<Comparison> &parts);

} // namespace accuracy
