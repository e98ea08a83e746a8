/* SPDX-License-Identifier: Apache-2.0 */
/* A case's bounds from the table of measures. */
#include "tiers.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stages_words.h"

namespace vectors {

namespace {

conf_array as_conf(const Array &a)
{
    if (a.bits != 64) { /* of 32-bit words only absolute measures and shares of the word itself are asked */
        throw std::runtime_error("bounds: 64-bit words expected of " + a.name);
    }
    return {a.name.c_str(), a.bits, a.words.size(), a.words.data(), 0, 0};
}

/* A share of a word or a scale, rounded down to 20 significant bits: the last digits of an uncertain one are not the same
 * on every processor. */
reference::Real share(reference::Real more)
{
    int exponent = 0;
    std::frexp(more, &exponent);
    const reference::Real unit = std::ldexp(reference::Real(1), std::max(exponent - 20, 0));
    return std::floor(more / unit) * unit;
}

/* One word's bound; 'wide' has the words as 64 bits. */
uint64_t bound_of(const std::string &stage, const Array &wide, size_t i, reference::Real more)
{
    const conf_array words = as_conf(wide);
    const conf_measure *m = conf_measure_of(stage.c_str(), wide.name.c_str(), i);
    if (m == nullptr) {
        throw std::runtime_error(stage + "/" + wide.name + ": no measure for word " + std::to_string(i));
    }
    if (m->kind == CONF_UNREFERENCED) {
        return CONF_UNDEFINED;
    }
    if (more == EXACTLY) {
        return 0;
    }
    const bool relative = m->kind == CONF_OF_ITSELF || m->kind == CONF_OF_SCALE;
    const reference::Real bound = m->base_lsb + (relative ? share(more) : std::ceil(more));
    if (bound <= static_cast<reference::Real>(conf_measure_widest(m, &words, i))) {
        return static_cast<uint64_t>(bound);
    }
    if (m->undefined == nullptr) {
        throw std::runtime_error(stage + "/" + wide.name + ": word " + std::to_string(i) + " (" + m->name + ") needs " +
                                 std::to_string(bound) + " LSB, more than its measure grants");
    }
    return CONF_UNDEFINED;
}

} // namespace

Array like(const Array &exact, std::vector<int64_t> words)
{
    Array a = exact;
    a.words = std::move(words);
    return a;
}

Bound bounds(const std::string &stage, const Array &reference, const std::vector<reference::Real> &more)
{
    Array wide = reference;
    Bound bound;
    size_t before;
    const size_t period = conf_measure_period(&before, stage.c_str(), reference.name.c_str());
    wide.bits = 64;
    for (size_t i = 0; i < reference.words.size(); i++) {
        bound.push_back(bound_of(stage, wide, i, more.empty() ? 0 : more.at(i)));
    }
    if (std::all_of(bound.begin(), bound.end(), [&](uint64_t b) { return b == bound[0]; })) {
        bound.resize(std::min<size_t>(bound.size(), 1));
    } else if (before == 0 && period > 0 && more.empty()) {
        bound.resize(std::min(bound.size(), period));
    }
    return bound.size() == 1 && bound[0] == 0 ? Bound() : bound;
}

Expected unreferenced(const std::string &stage, const Array &exact) { return {exact, bounds(stage, exact)}; }

reference::Real angle_turn(reference::Real a, reference::Real b, reference::Real px)
{
    return std::ceil(px / std::max<reference::Real>(a - b, 1e-9L));
}

} // namespace vectors
