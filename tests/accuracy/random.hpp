/* SPDX-License-Identifier: Apache-2.0 */
/* Random numbers that are the same everywhere: SplitMix64 (Steele, Lea, Flood 2014) as a sequence and as a hash. */
#pragma once

#include <cmath>
#include <cstdint>

namespace accuracy {

inline uint64_t mix64(uint64_t v)
{
    v = (v ^ (v >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    v = (v ^ (v >> 27)) * UINT64_C(0x94D049BB133111EB);
    return v ^ (v >> 31);
}

/* A number in [0, 1) from the top 53 bits. */
inline double unit(uint64_t v) { return static_cast<double>(v >> 11) * 0x1p-53; }

/* The hash of a lattice point: the same for one seed whichever points are asked for, in whichever order. */
inline uint64_t hash_at(uint64_t seed, int64_t x, int64_t y)
{
    const uint64_t row = mix64(seed + UINT64_C(0x9E3779B97F4A7C15) * (static_cast<uint64_t>(y) + 1));
    return mix64(row + UINT64_C(0x9E3779B97F4A7C15) * (static_cast<uint64_t>(x) + 1));
}

/* Standard normal number of a lattice point, by Box and Muller. */
inline double normal_at(uint64_t seed, int64_t x, int64_t y)
{
    const uint64_t h = hash_at(seed, x, y);
    const double radius = std::sqrt(-2.0 * std::log(1.0 - unit(h)));
    return radius * std::cos(6.283185307179586 * unit(mix64(h + UINT64_C(0x9E3779B97F4A7C15))));
}

class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    uint64_t next()
    {
        state_ += UINT64_C(0x9E3779B97F4A7C15);
        return mix64(state_);
    }

    double uniform(double low, double high) { return low + (high - low) * unit(next()); }

private:
    uint64_t state_;
};

} // namespace accuracy
