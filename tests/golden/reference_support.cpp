/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the support of an ellipse by edge points (drogue/support.h). */
#include "reference.hpp"

#include <algorithm>
#include <cmath>

namespace reference {

namespace {

constexpr Real PI = 3.14159265358979323846264338327950288L;

int set_bits(uint32_t v)
{
    int count = 0;
    for (; v != 0; v &= v - 1) {
        count++;
    }
    return count;
}

/* Changes of a bit of 'bright' between one covered bin and the next, round and round. */
int changes(uint32_t bright, uint32_t covered)
{
    std::vector<uint32_t> own;
    int count = 0;
    for (int k = 0; k < SUPPORT_BINS; k++) {
        if ((covered >> k & 1) != 0) {
            own.push_back(bright >> k & 1);
        }
    }
    for (size_t i = 0; i < own.size(); i++) {
        count += own[i] != own[(i + 1) % own.size()];
    }
    return count;
}

} // namespace

BandPoint band_point(const Ellipse &e, const Band &band, const Edge &edge)
{
    const Real c = std::cos(e.angle), s = std::sin(e.angle), dx = edge.at.x - e.xc, dy = edge.at.y - e.yc;
    BandPoint p;
    p.u = std::clamp<Real>((dx * c + dy * s) / e.a, -16, 16);
    p.v = std::clamp<Real>((dy * c - dx * s) / e.b, -16, 16);
    p.f = p.u * p.u + p.v * p.v - 1;
    const Real nx = p.u * c / e.a - p.v * s / e.b, ny = p.u * s / e.a + p.v * c / e.b; /* half the gradient of f */
    const Real n = std::hypot(nx, ny), g = std::hypot(edge.gx, edge.gy);
    const Real distance = n > 0 ? std::fabs(p.f) / (2 * n) : band.width + 1;
    const Real along = edge.gx * nx + edge.gy * ny, cosine = g * n > 0 ? std::fabs(along) / (g * n) : 0;
    const Real least = std::sqrt(std::floor(band.cosine * band.cosine * 1024 + 0.5L) / 1024); /* a format of the band */
    p.held = p.f <= 1 && p.f >= -0.75L && distance <= band.width && along != 0 && cosine >= least;
    p.polarity = along > 0 ? 0 : 1;
    const Real angle = std::atan2(p.v, p.u), turn = (angle < 0 ? angle + 2 * PI : angle) * SUPPORT_BINS / (2 * PI);
    p.bin = static_cast<int>(turn) % SUPPORT_BINS;
    p.from_next_bin = std::fabs(turn - std::floor(turn + 0.5L)) * 2 * PI / SUPPORT_BINS;
    p.past_width = distance - band.width;
    p.past_cosine = least - cosine;
    return p;
}

bool support_add(Support &s, const BandPoint &p, const Edge &edge)
{
    const auto bin = static_cast<size_t>(p.bin);
    s.count[bin][static_cast<size_t>(p.polarity)]++;
    if (static_cast<int>(s.bright >> bin & 1) != p.polarity) {
        return false;
    }
    s.sum[bin] += p.f / 2;
    s.squares += p.f * p.f / 4;
    s.gradient += std::fabs(edge.gx) + std::fabs(edge.gy);
    s.points++;
    return true;
}

Real support_needed(const Ellipse &e, int bin)
{
    const Real sine = std::sin((bin + 0.5L) * 2 * PI / SUPPORT_BINS);
    return 0.35L * (e.b + (e.a - e.b) * sine * sine) * 2 * PI / SUPPORT_BINS;
}

/* The bins that more bright points than dark ones lie in. */
static uint32_t support_majority(const Support &s)
{
    uint32_t majority = 0;
    for (int k = 0; k < SUPPORT_BINS; k++) {
        const auto &count = s.count[static_cast<size_t>(k)];
        majority |= static_cast<uint32_t>(count[1] > count[0]) << k;
    }
    return majority;
}

/* The bins that points of the given polarities cover. */
static uint32_t support_covered(const Support &s, const Ellipse &e, uint32_t bright, int stride)
{
    uint32_t covered = 0;
    for (int k = 0; k < SUPPORT_BINS; k++) {
        const int count = s.count[static_cast<size_t>(k)][bright >> k & 1];
        covered |= static_cast<uint32_t>(count * stride >= support_needed(e, k)) << k;
    }
    return covered;
}

void support_judge_as(Support &s, const Ellipse &e, uint32_t bright, int stride)
{
    const uint32_t covered = support_covered(s, e, bright, stride);
    s.bright = bright;
    s.covered = std::max(0, set_bits(covered) - changes(bright, covered));
}

void support_judge(Support &s, const Ellipse &e, int polarity, int stride)
{
    support_judge_as(s, e, polarity == 1 ? UINT32_MAX : 0, stride);
    for (const uint32_t other : {UINT32_MAX, support_majority(s)}) {
        Support t = s;
        support_judge_as(t, e, other, stride);
        if (polarity == 2 && t.covered > s.covered) {
            s = t;
        }
    }
}

} // namespace reference
