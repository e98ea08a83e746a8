/* SPDX-License-Identifier: Apache-2.0 */
/* Fits to the edges along rays, in floating point. */
#include "edge.hpp"

#include <array>
#include <cmath>

namespace mirror {

namespace {

using Offset = std::array<Real, 3>; /* x, y, larger by */
using Rays = std::array<drogue_ray, DROGUE_RAYS>;

Real real(int64_t q16) { return static_cast<Real>(q16) / 65536; }

struct Sums {
    cv::Matx33d normal = cv::Matx33d::zeros();
    cv::Vec3d right = {0, 0, 0};
    Real squares = 0, slopes = 0, levels = 0;
    std::array<Real, DROGUE_RAYS / 4> bin{}, bin_weight{};
    int rays = 0;
};

void add_rays(Sums &s, const Rays &rays, const Offset &v, Real within, bool by_slope)
{
    for (size_t k = 0; k < rays.size(); k++) {
        const drogue_ray &r = rays[k];
        const cv::Vec3d row(r.nx_q14 / 16384.0, r.ny_q14 / 16384.0, 1);
        const Real at = row[0] * v[0] + row[1] * v[1] + v[2];
        const drogue_ray_edge *best = nullptr;
        Real most = 0;
        for (uint32_t i = 0; i < r.count; i++) {
            const Real room = within - std::fabs(real(r.edges[i].at_px_q16) - at);
            if (room > 0 && room * r.edges[i].slope_q8 > most) {
                most = room * r.edges[i].slope_q8;
                best = &r.edges[i];
            }
        }
        if (best != nullptr) {
            const Real off = real(best->at_px_q16) - at;
            const int grey =
                std::min(best->slope_q8 / (DROGUE_RAY_WEIGHT * 256), 254) + 1; /* whole levels, by definition */
            const Real weight = by_slope ? grey * grey : 1;
            s.normal += static_cast<double>(weight) * (row * row.t());
            s.right += static_cast<double>(weight * off) * row;
            s.squares += off * off;
            s.slopes += best->slope_q8;
            s.levels += best->level_q8;
            s.rays++;
            s.bin[k / 4] += weight * off;
            s.bin_weight[k / 4] += weight;
        }
    }
}

bool solve(Offset &v, const Sums &s, bool size)
{
    if (s.rays < 8) {
        return false;
    }
    const int n = size ? 3 : 2;
    const cv::Mat normal = cv::Mat(s.normal)(cv::Rect(0, 0, n, n)).clone();
    cv::Mat step;
    if (!cv::solve(normal, cv::Mat(s.right).rowRange(0, n).clone(), step, cv::DECOMP_CHOLESKY)) {
        return false;
    }
    for (int i = 0; i < n; i++) {
        v[static_cast<size_t>(i)] += step.at<double>(i);
    }
    return true;
}

Rays cast(const drogue_image &view, const drogue_ellipse &e, drogue_q16 reach, int phase, int least)
{
    Rays rays;
    drogue_rays_cast(rays.data(), &view, &e, reach, phase, 0, least);
    return rays;
}

Real rms_of(const Sums &s) { return std::sqrt(s.squares / s.rays); }

} // namespace

Disc inner_edge(const drogue_image &view, const drogue_inner_expected &expected, const drogue_ellipse &outline,
                const drogue_config &config)
{
    const Real gate = real(config.inner_gate_px_q16) + real(config.inner_gate_q16) * real(outline.a_px_q16);
    const int least = config.min_inner_contrast;
    Disc out;
    Offset first = {0, 0, 0};
    Real steepest = 0;
    for (uint32_t i = 0; i < expected.count; i++) {
        const Real reach = gate + real(expected.disc[i].a_px_q16) / 16 + 2;
        const Rays rays = cast(view, expected.disc[i], reference::q16(reach), 4, least);
        Offset v = {0, 0, 0};
        Sums s;
        Real within = gate + 1;
        bool good = true;
        for (int round = 0; round < 10 && good; round++) {
            s = Sums();
            add_rays(s, rays, v, within, false);
            good = solve(v, s, round > 1);
            within = std::max({within * 3 / 4, Real(1.5), reach / 16});
        }
        if (good && s.slopes > steepest) {
            steepest = s.slopes;
            first = v;
            out.which = static_cast<int>(i);
        }
    }
    if (steepest == 0) {
        return out;
    }
    drogue_ellipse at = expected.disc[out.which];
    at.xc_px_q16 += reference::q16(first[0]);
    at.yc_px_q16 += reference::q16(first[1]);
    at.a_px_q16 += reference::q16(first[2]);
    at.b_px_q16 += reference::q16(first[2]);
    if (at.b_px_q16 < 65536) {
        return out;
    }
    const int phases = std::min(std::max(at.a_px_q16 / (10 * 65536), 1), 8);
    const Rays rays = cast(view, at, 0, 4, least);
    Offset v = {0, 0, 0};
    Sums s;
    Real within = 1.5;
    for (int round = 0; round < 3; round++) {
        s = Sums();
        add_rays(s, rays, v, within, false);
        if (!solve(v, s, true)) {
            return out;
        }
        within = std::max<Real>(0.25, std::min(3 * rms_of(s), within));
    }
    s = Sums();
    for (int k = 0; k < phases; k++) {
        add_rays(s, cast(view, at, 0, (8 * k + 4) / phases % 8, least), v, within, true);
    }
    Real scatter = 0;
    int bins = 0;
    for (size_t k = 0; k < s.bin.size(); k++) {
        if (s.bin_weight[k] > 0) {
            scatter += s.bin[k] * s.bin[k] / s.bin_weight[k];
            bins++;
        }
    }
    if (!solve(v, s, true) || bins < 5) {
        return out;
    }
    const cv::Matx33d inverse = s.normal.inv(cv::DECOMP_CHOLESKY);
    out.found = true;
    out.std = std::sqrt(scatter / (bins - 3) * std::max(inverse(0, 0), inverse(1, 1)));
    out.rms = rms_of(s);
    out.x = real(at.xc_px_q16) + v[0];
    out.y = real(at.yc_px_q16) + v[1];
    out.grown = real(reference::q16(first[2])) + v[2];
    out.rays = (s.rays + phases / 2) / phases;
    const auto grey = [&](Real sum, Real per) {
        return static_cast<int>(std::min<Real>(255, std::floor(sum / (s.rays * per) + 0.5L)));
    };
    out.contrast = grey(s.slopes, DROGUE_RAY_WEIGHT * 256);
    out.level = grey(s.levels, 256);
    return out;
}

} // namespace mirror
