/* SPDX-License-Identifier: Apache-2.0 */
/* Runs each case through the C library and the reference, and says how far apart they are. */
#include "case.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>

#include "stages_words.h"

namespace vectors {

namespace {

/* Words as the native array that a stage takes. */
std::vector<int64_t> pack(const Array &array)
{
    const size_t bytes = static_cast<size_t>(array.bits / 8);
    std::vector<int64_t> memory((array.words.size() * bytes + 7) / 8 + 1); /* aligned for every width */
    auto *at = reinterpret_cast<unsigned char *>(memory.data());
    for (const int64_t word : array.words) {
        const auto w8 = static_cast<uint8_t>(word);
        const auto w16 = static_cast<uint16_t>(word);
        const auto w32 = static_cast<uint32_t>(word);
        const void *from = array.bits == 8    ? static_cast<const void *>(&w8)
                           : array.bits == 16 ? static_cast<const void *>(&w16)
                           : array.bits == 32 ? static_cast<const void *>(&w32)
                                              : static_cast<const void *>(&word);
        std::memcpy(at, from, bytes);
        at += bytes;
    }
    return memory;
}

/* Fractional bits of a stage's output; README.md says which of its words are whole numbers. */
int format_of(const std::string &stage, const std::string &output)
{
    static const std::map<std::string, int> formats = {{"smooth/image", 0},
                                                       {"gradient/gx", 0},
                                                       {"gradient/gy", 0},
                                                       {"canny/map", 0},
                                                       {"mask/ring", 0},
                                                       {"arcs/arcs", 0},
                                                       {"arcs/edges", 5},
                                                       {"constraints/verdict", 16},
                                                       {"constraints/distance2", 32},
                                                       {"ellipse/ellipse", 16},
                                                       {"select/choices", 0},
                                                       {"quality/quality", 16},
                                                       {"quality/status", 0},
                                                       {"support/summary", 16},
                                                       {"support/bins", 16},
                                                       {"support/members", 0},
                                                       {"support/sums", 32},
                                                       {"cluster/winner", 0},
                                                       {"eigen/values", 30},
                                                       {"eigen/vectors", 30},
                                                       {"eigen/full", 0},
                                                       {"undistort/undistorted", 16},
                                                       {"undistort/distorted", 16},
                                                       {"pose/pose", 16},
                                                       {"joint/joint", 16},
                                                       {"joint/disc", 16},
                                                       {"joint/covariance", 48},
                                                       {"joint/outline", 48},
                                                       {"kalman/states", 16},
                                                       {"frame/frame", 16},
                                                       {"frame/detail", 16},
                                                       {"frame/covariance", 48},
                                                       {"frame/std", 32},
                                                       {"decide/decision", 16},
                                                       {"decide/covariance", 48},
                                                       {"decide/std", 32},
                                                       {"look/looked", 16},
                                                       {"rim/rims", 4},
                                                       {"search/sightings", 0},
                                                       {"acquire/found", 16},
                                                       {"follow/states", 0},
                                                       {"follow/estimates", 16},
                                                       {"track/states", 0},
                                                       {"track/estimates", 16},
                                                       {"track/std", 32}};
    const auto found = formats.find(stage + "/" + output);
    if (found == formats.end()) {
        throw std::runtime_error("no format for output " + stage + "/" + output);
    }
    return found->second;
}

std::vector<Array> run_library(const std::string &id, const std::string &stage, const std::vector<Array> &inputs)
{
    std::vector<std::vector<int64_t>> memory;
    std::vector<conf_array> in;
    conf_array out[CONF_MAX_OUTPUTS];
    for (const Array &a : inputs) {
        memory.push_back(pack(a));
        in.push_back({a.name.c_str(), a.bits, a.words.size(), memory.back().data(), a.width, a.height});
    }
    const int count = conf_run_stage(stage.c_str(), in.data(), static_cast<int>(in.size()), out, CONF_MAX_OUTPUTS);
    if (count < 0) {
        throw std::runtime_error(id + ": " + conf_failure_text(count));
    }
    std::vector<Array> arrays;
    for (int i = 0; i < count; i++) {
        Array a;
        a.name = out[i].name;
        a.bits = out[i].bits;
        a.q = format_of(stage, a.name);
        a.width = out[i].width_px;
        a.height = out[i].height_px;
        for (size_t k = 0; k < out[i].count; k++) {
            a.words.push_back(conf_word(&out[i], k));
        }
        arrays.push_back(a);
    }
    return arrays;
}

const Array *named(const std::vector<Expected> &arrays, const std::string &name)
{
    for (const Expected &e : arrays) {
        if (e.array.name == name) {
            return &e.array;
        }
    }
    return nullptr;
}

uint64_t bound_at(const Expected &e, size_t i) { return e.bound.empty() ? 0 : e.bound[i % e.bound.size()]; }

struct StageReport {
    long cases = 0, words = 0, excess = 0;
    double worst = 0, sum = 0, share = 0; /* share: of a word's own bound */
    std::string worst_id = "-", share_id = "-";
};

void compare(StageReport &r, const Case &c, const Expected &reference)
{
    const Array *exact = named(c.exact, reference.array.name);
    if (exact == nullptr || exact->words.size() != reference.array.words.size()) {
        throw std::runtime_error(c.id() + ": the reference's " + reference.array.name + " has another size");
    }
    for (size_t i = 0; i < exact->words.size(); i++) {
        const int64_t own = exact->words[i], other = reference.array.words[i];
        const auto lsb = static_cast<double>(own > other ? static_cast<uint64_t>(own) - static_cast<uint64_t>(other)
                                                         : static_cast<uint64_t>(other) - static_cast<uint64_t>(own));
        const auto bound = static_cast<double>(bound_at(reference, i));
        if (bound_at(reference, i) == CONF_UNDEFINED) {
            continue;
        }
        if (lsb > bound) {
            std::printf("EXCESS %s %s word %zu: reference %lld, library %lld, bound %g\n", c.id().c_str(),
                        exact->name.c_str(), i, static_cast<long long>(reference.array.words[i]),
                        static_cast<long long>(exact->words[i]), bound);
            r.excess++;
        }
        if (lsb > r.worst) {
            r.worst = lsb;
            r.worst_id = c.id() + " " + exact->name + " word " + std::to_string(i);
        }
        if (bound > 0 && lsb / bound > r.share) {
            r.share = lsb / bound;
            r.share_id = c.id() + " " + exact->name + " word " + std::to_string(i);
        }
        r.sum += lsb;
        r.words++;
    }
}

} // namespace

Array image_array(const std::string &name, const cv::Mat &image)
{
    Array a;
    a.name = name;
    a.bits = 8;
    a.width = image.cols;
    a.height = image.rows;
    for (int y = 0; y < image.rows; y++) {
        for (int x = 0; x < image.cols; x++) {
            a.words.push_back(image.at<uint8_t>(y, x));
        }
    }
    return a;
}

Array word_array(const std::string &name, int bits, int q, std::vector<int64_t> words)
{
    Array a;
    a.name = name;
    a.bits = bits;
    a.q = q;
    a.words = std::move(words);
    for (const int64_t w : a.words) {
        if (bits < 64 && (w < -(INT64_C(1) << (bits - 1)) || w >= INT64_C(1) << (bits - 1))) {
            throw std::runtime_error("a word of " + name + " does not fit " + std::to_string(bits) + " bits");
        }
    }
    return a;
}

cv::Mat image_of(const Array &array)
{
    cv::Mat image(array.height, array.width, CV_8U);
    for (int y = 0; y < array.height; y++) {
        for (int x = 0; x < array.width; x++) {
            image.at<uint8_t>(y, x) = static_cast<uint8_t>(array.words[static_cast<size_t>(y * array.width + x)]);
        }
    }
    return image;
}

const char *tier_name(Tier tier)
{
    switch (tier) {
    case Tier::ordinary: return "ordinary";
    case Tier::boundary: return "boundary";
    case Tier::stress: return "stress";
    case Tier::must_reject: break;
    }
    return "must-reject";
}

uint64_t seed_of(const std::string &id)
{
    uint32_t hash = 2166136261u;
    for (const char c : id) {
        hash = (hash ^ static_cast<uint8_t>(c)) * 16777619u;
    }
    return hash;
}

double normal(accuracy::Random &random)
{
    const double radius = std::sqrt(-2.0 * std::log(1.0 - accuracy::unit(random.next())));
    return radius * std::cos(2 * CV_PI * accuracy::unit(random.next()));
}

std::vector<Array> Set::run(const std::vector<Array> &inputs) const { return run_library(stage_, stage_, inputs); }

void Set::add(const std::string &name, Tier tier, Flags flags, std::vector<Array> inputs)
{
    Case c{stage_, name, tier, std::move(flags), seed_of(stage_ + "/" + name), std::move(inputs), {}, {}};
    for (const Case &other : cases_) {
        if (other.id() == c.id()) {
            throw std::runtime_error("two cases are called " + c.id());
        }
    }
    const std::vector<Array> exact = run_library(c.id(), c.stage, c.inputs);
    for (const Array &a : exact) {
        c.exact.push_back({a, {}});
    }
    try {
        c.reference = reference_of(c.stage, c.inputs, exact);
    } catch (const std::runtime_error &e) {
        throw std::runtime_error(c.id() + ": " + e.what());
    }
    cases_.push_back(std::move(c));
}

bool Set::report() const
{
    std::vector<std::string> order;
    std::map<std::string, StageReport> reports;
    bool good = true;
    for (const Case &c : cases_) {
        if (reports.find(c.stage) == reports.end()) {
            order.push_back(c.stage);
        }
        StageReport &r = reports[c.stage];
        r.cases++;
        for (const Expected &e : c.reference) {
            compare(r, c, e);
        }
    }
    std::printf("%-12s %5s %9s %9s %9s  %s\n", "stage", "cases", "worst LSB", "mean LSB", "of bound",
                "nearest to its bound");
    for (const std::string &stage : order) {
        const StageReport &r = reports[stage];
        std::printf("%-12s %5ld %9.0f %9.4f %8.0f%%  %s\n", stage.c_str(), r.cases, r.worst,
                    r.words > 0 ? r.sum / static_cast<double>(r.words) : 0.0, 100 * r.share, r.share_id.c_str());
        good = good && r.excess == 0;
    }
    std::printf("%zu cases\n", cases_.size());
    return good;
}

} // namespace vectors
