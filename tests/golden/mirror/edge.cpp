/* SPDX-License-Identifier: Apache-2.0 */
/* Fits to the edges along rays, in floating point. */
#include "edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mirror {

namespace {

Real real(int64_t q16) { return static_cast<Real>(q16) / 65536; }

Real along(const drogue_ray &r, const Offset &v)
{
    return r.nx_q14 / 16384.0L * v[0] + r.ny_q14 / 16384.0L * v[1] + v[2];
}

/* The edge that an offset is about; NULL when there is none. */
const drogue_ray_edge *chosen(const drogue_ray &r, Real at, Real within)
{
    const drogue_ray_edge *best = nullptr;
    Real most = 0;
    for (uint32_t i = 0; i < r.count; i++) {
        const Real room = within - std::fabs(real(r.edges[i].at_px_q16) - at);
        if (room > 0 && room * r.edges[i].slope_q8 > most) {
            most = room * r.edges[i].slope_q8;
            best = &r.edges[i];
        }
    }
    return best;
}

void add_ray(Sums &s, const drogue_ray &r, Real weight, Real off)
{
    const cv::Vec3d row(r.nx_q14 / 16384.0, r.ny_q14 / 16384.0, 1);
    s.normal += static_cast<double>(weight) * (row * row.t());
    s.right += static_cast<double>(weight * off) * row;
    s.squares += off * off;
    s.rays++;
}

void add_rays(Sums &s, const Rays &rays, const Offset &v, Real within, bool by_slope)
{
    for (size_t k = 0; k < rays.size(); k++) {
        const Real at = along(rays[k], v);
        const drogue_ray_edge *best = chosen(rays[k], at, within);
        if (best != nullptr) {
            const Real off = real(best->at_px_q16) - at;
            const int grey =
                std::min(best->slope_q8 / (DROGUE_RAY_WEIGHT * 256), 254) + 1; /* whole levels, by definition */
            const Real weight = by_slope ? grey * grey : 1;
            add_ray(s, rays[k], weight, off);
            s.slopes += best->slope_q8;
            s.levels += best->level_q8;
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

} // namespace

reference::Ellipse real_of(const drogue_ellipse &e)
{
    return {real(e.xc_px_q16), real(e.yc_px_q16), real(e.a_px_q16), real(e.b_px_q16), real(e.angle_rad_q16), true};
}

bool settle(Sums &s, Offset &v, const Rays &rays, Real within, Real last, bool size)
{
    for (int round = 0; round < 10; round++) {
        s = Sums();
        add_rays(s, rays, v, within, false);
        if (!solve(v, s, size && round > 1)) {
            return false;
        }
        within = std::max(within * 3 / 4, last);
    }
    return true;
}

namespace {

/* An edge of the size expected for one that is not: among the edges that lie beyond the first on that side. */
bool prefer_size(Offset &first, Rays rays, int least)
{
    Offset v = {first[0], first[1], 0};
    Sums s;
    for (drogue_ray &r : rays) {
        const Real at = along(r, first);
        const auto end = std::remove_if(r.edges, r.edges + r.count, [&](const drogue_ray_edge &e) {
            const Real off = real(e.at_px_q16) - at;
            return (first[2] > 0 ? -off : off) <= 0.75L;
        });
        r.count = static_cast<uint32_t>(end - r.edges);
    }
    const bool found = settle(s, v, rays, std::fabs(first[2]) + 1, 0.75L, false) && s.rays >= least;
    first = found ? v : first;
    return found;
}

Rays cast(const drogue_image &view, const drogue_ellipse &e, drogue_q16 reach, int every, int least,
          drogue_ray_look look)
{
    Rays rays;
    drogue_rays_cast(rays.data(), &view, &e, reach, 4, every, least, look);
    return rays;
}

Real rms_of(const Sums &s) { return std::sqrt(s.squares / s.rays); }

bool narrow(Sums &s, Offset &v, Real &within, const Rays &rays)
{
    for (int round = 0; round < 3; round++) {
        s = Sums();
        add_rays(s, rays, v, within, false);
        if (!solve(v, s, true)) {
            return false;
        }
        within = std::max<Real>(0.25, std::min(3 * rms_of(s), within));
    }
    return true;
}

/* Grey about an edge: half a pixel apart from 3.5 to 4 px within it outwards. */
using Profile = std::array<int32_t, 13>;
Real begin_of(Real at) { return std::floor(2 * (at - 3.5L)) / 2; } /* a multiple of the distance of samples */

/* Of light, where grey levels are encoded. */
Profile profile_of(const drogue_ray &r, const drogue_image &view, drogue_transfer transfer, Real at)
{
    Profile p;
    const auto read = transfer == DROGUE_TRANSFER_SRGB ? drogue_ray_read_light : drogue_ray_read;
    read(p.data(), &r, &view, reference::q16(begin_of(at)), static_cast<int32_t>(p.size()));
    return p;
}

/* Grey of the disc as a plane over the normal, and the rise above it to the level looked for. */
struct Shade {
    Offset dark = {0, 0, 0};
    Real rise = 0;
};

Real median_of(std::vector<Real> v)
{
    std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
    return v[v.size() / 2];
}

bool find_shade(Shade &out, const Rays &rays, const drogue_image &view, drogue_transfer transfer, const Offset &v,
                Real within)
{
    struct Seen {
        const drogue_ray *ray;
        Real dark, beyond;
    };
    std::vector<Seen> seen;
    for (const drogue_ray &r : rays) {
        const Real at = along(r, v);
        if (chosen(r, at, within) != nullptr) {
            const Profile p = profile_of(r, view, transfer, at);
            const Real part = 2 * (at - 3.5L - begin_of(at));
            seen.push_back({&r, (p[0] + (p[4] - p[0]) * part + p[1] + p[2] + p[3]) / 1024,
                            (p[11] + (p[12] - p[11]) * part) / 256});
        }
    }
    Real room = 256;
    Sums s;
    for (int round = 0; round < 4; round++) {
        s = Sums();
        for (const Seen &at : seen) {
            const Real off = at.dark - along(*at.ray, out.dark);
            if (std::fabs(off) <= room) {
                add_ray(s, *at.ray, 1, off);
            }
        }
        if (!solve(out.dark, s, true)) {
            return false;
        }
        room = std::max<Real>(2, 2 * rms_of(s));
    }
    for (const Real v : out.dark) {
        if (std::fabs(v) > 256) {
            return false;
        }
    }
    const Real change = out.dark[0] * out.dark[0] + out.dark[1] * out.dark[1];
    const Real noise = 50 * s.squares / s.rays / s.rays;
    const Real kept = change > 0 ? change / (change + noise) : 0;
    out.dark[0] *= kept;
    out.dark[1] *= kept;
    std::vector<Real> rises;
    for (const Seen &at : seen) {
        rises.push_back(at.beyond - along(*at.ray, out.dark));
    }
    out.rise = median_of(rises) / 4;
    return out.rise > 0 && 16 * out.rise * out.rise > 3 * noise; /* else it is found in noise */
}

/* Where the grey passes the level, as the rays' edges. */
void cross(Rays &rays, const drogue_image &view, drogue_transfer transfer, const Shade &shade, const Offset &v,
           size_t every)
{
    for (size_t k = 0; k < rays.size(); k += every) {
        drogue_ray &r = rays[k];
        const Real at = along(r, v), level = 256 * (along(r, shade.dark) + shade.rise);
        const Profile p = profile_of(r, view, transfer, at);
        r.count = 0;
        for (size_t i = 3; i <= 9; i++) {
            if (p[i] < level && p[i + 1] >= level && r.count < DROGUE_RAY_EDGES) {
                const Real step = p[i + 1] - p[i];
                r.edges[r.count++] = {reference::q16(begin_of(at) + (static_cast<Real>(i) + (level - p[i]) / step) / 2),
                                      static_cast<int32_t>(DROGUE_RAY_WEIGHT * 2 * step), p[i]};
            }
        }
    }
}

/* A first place, by which expected disc, in 1/256 px: in such rays read the image. */
struct Place {
    int which;
    std::array<int, 3> at; /* x, y, size */
    drogue_ray_look look;
};

/* May the disc about a first place that is larger by so much, 1/256 px, be jagged? */
bool is_jagged(const drogue_ellipse &expected, int larger) { return expected.a_px_q16 + 256 * larger > 15 * 65536; }

/* Measure about a first place; 'wide': of a disc that may be jagged. */
Disc about(const drogue_image &view, const drogue_inner_expected &expected, const Place &place, bool wide,
           const drogue_config &config)
{
    Disc out;
    drogue_ellipse at = expected.disc[place.which];
    at.xc_px_q16 = 256 * place.at[0];
    at.yc_px_q16 = 256 * place.at[1];
    at.a_px_q16 += 256 * place.at[2];
    at.b_px_q16 += 256 * place.at[2];
    out.which = place.which;
    if (at.b_px_q16 < 65536) {
        return out;
    }
    const int phases = std::min(std::max(at.a_px_q16 / (20 * 65536), 1), 8);
    const int every = at.a_px_q16 < 10 * 65536 ? 2 : 1;
    Rays rays = cast(view, at, 0, every, config.min_inner_contrast, place.look);
    Offset v = {0, 0, 0};
    Shade shade;
    Sums s;
    const Real widest = wide ? real(98304 + (std::min(at.a_px_q16, 25 * 65536) - 15 * 65536) / 10) : 1.5L;
    Real within = widest;
    if (!narrow(s, v, within, rays) || !find_shade(shade, rays, view, config.transfer, v, within)) {
        return out;
    }
    const auto grey = [&](Real sum, Real per) {
        return static_cast<int>(std::min<Real>(255, std::floor(sum / (s.rays * per) + 0.5L)));
    };
    out.contrast = grey(s.slopes, DROGUE_RAY_WEIGHT * 256);
    out.level = grey(s.levels, 256);
    const Real size = v[2];
    cross(rays, view, config.transfer, shade, v, static_cast<size_t>(every));
    within = widest;
    if (!narrow(s, v, within, rays)) {
        return out;
    }
    s = Sums();
    for (int k = 0; k < phases; k++) {
        if (phases > 1) {
            drogue_rays_aim(rays.data(), &at, (8 * k + 4) / phases % 8, 0, DROGUE_RAYS / 2);
            cross(rays, view, config.transfer, shade, {v[0], v[1], size}, 1);
        }
        add_rays(s, rays, v, within, true);
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
    out.grown = place.at[2] / 256.0L + v[2] + 0.45L;
    const auto away = [&](const drogue_ellipse &e) {
        return std::hypot(out.x - real(e.xc_px_q16), out.y - real(e.yc_px_q16));
    };
    const drogue_ellipse &reached = expected.disc[out.which], &other = expected.disc[1 - out.which];
    if (expected.count == 2 && away(other) < away(reached)) {
        out.which = 1 - out.which;
        out.grown += real(reached.a_px_q16) - real(other.a_px_q16);
    }
    out.rays = (every * s.rays + phases / 2) / phases;
    return out;
}

/* A first place of one of the expected discs, not rounded yet, and how steep the edges are that say so; 0: none. */
struct First {
    Offset v = {0, 0, 0};
    Real slopes = 0;
    drogue_ray_look look = DROGUE_RAY_RISES;
};

/* Look for a disc about where it is expected. 1 when it is seen in its place, of its size. */
bool look_about(First &out, const drogue_image &view, const drogue_ellipse &e, Real gate, const drogue_config &config)
{
    const Real reach = gate + real(e.a_px_q16) / 16 + 2;
    const auto seen = [&](drogue_ray_look look) {
        return cast(view, e, reference::q16(reach), 2, config.min_inner_contrast, look);
    };
    const Rays rays = seen(DROGUE_RAY_RISES);
    Sums s;
    if (!settle(s, out.v, rays, gate + 1, std::max<Real>(1.5, reach / 16), true)) {
        return false;
    }
    out.slopes = s.slopes;
    if (std::fabs(out.v[2]) > real(e.a_px_q16) / 64 + 0.5L) {
        const bool too_large = out.v[2] > room_of(real_of(e), config);
        if (!prefer_size(out.v, rays, DROGUE_RAYS / 8) && too_large &&
            prefer_size(out.v, seen(DROGUE_RAY_FINE_RISES), 3 * DROGUE_RAYS / 16)) {
            out.look = DROGUE_RAY_FINE_RISES;
        }
    }
    return 16 * s.rays >= 7 * DROGUE_RAYS && std::fabs(out.v[2]) <= room_of(real_of(e), config) &&
           std::hypot(out.v[0], out.v[1]) <= gate;
}

/* Look between the discs of the two poses; the place is told from the first one's. */
bool look_between(First &out, const drogue_image &view, const drogue_inner_expected &expected, Real gate,
                  const drogue_config &config)
{
    drogue_ellipse e = expected.disc[0];
    const drogue_q16 x = (expected.disc[1].xc_px_q16 - e.xc_px_q16) / 2,
                     y = (expected.disc[1].yc_px_q16 - e.yc_px_q16) / 2;
    const Real half = std::fabs(real(x)) + std::fabs(real(y));
    e.xc_px_q16 += x;
    e.yc_px_q16 += y;
    if (half <= gate || !look_about(out, view, e, gate + half / 4, config)) {
        return false;
    }
    out.v[0] += real(x);
    out.v[1] += real(y);
    return true;
}

/* Measure about a first place; near the middle between two in which rays read the image, that of the library's disc is
 * taken. */
Disc measure_at(const drogue_image &view, const drogue_inner_expected &expected, int which, const First &place_of,
                const drogue_config &config, const drogue_inner_edge *library)
{
    const drogue_ellipse &e = expected.disc[which];
    const Offset &first = place_of.v;
    const Real exact[3] = {256 * (real(e.xc_px_q16) + first[0]), 256 * (real(e.yc_px_q16) + first[1]), 256 * first[2]};
    Place place = {which, {0, 0, 0}, place_of.look};
    Disc best;
    Real nearest = -1;
    for (int way = 0; way < 8; way++) {
        bool open = true;
        for (size_t k = 0; k < 3; k++) {
            const Real up = std::floor(exact[k] + 0.5L), other = up + (exact[k] < up ? -1 : 1);
            const bool turn = way >> k & 1;
            open = open && (!turn || (library != nullptr && std::fabs(std::fabs(exact[k] - up) - 0.5L) < 8 / 256.0L));
            place.at[k] = static_cast<int>(turn ? other : up);
        }
        if (open) {
            Disc d = about(view, expected, place, false, config);
            if (d.found && d.rms > real(config.inner_rms_px_q16) && is_jagged(expected.disc[which], place.at[2])) {
                d = about(view, expected, place, true, config);
            }
            const Real off = library == nullptr
                                 ? 0
                                 : std::fabs(d.x - real(library->x_px_q16)) + std::fabs(d.y - real(library->y_px_q16)) +
                                       std::fabs(d.grown - real(library->grown_px_q16));
            if (nearest < 0 || off < nearest) {
                nearest = off;
                best = d;
            }
        }
    }
    return best;
}

} // namespace

Real room_of(const reference::Ellipse &expected, const drogue_config &config)
{
    return real(config.inner_size_px_q16) + real(config.inner_size_q16) * expected.a;
}

bool in_its_place(const Disc &d, const reference::Ellipse &expected, const reference::Ellipse &rim,
                  const drogue_config &config)
{
    const Real c = std::cos(rim.angle), s = std::sin(rim.angle), dx = d.x - rim.xc, dy = d.y - rim.yc;
    const Real u = (dx * c + dy * s) / rim.a, v = (dy * c - dx * s) / rim.b, room = 1 - expected.a / rim.a;
    const bool all_about = 8 * d.rays >= 7 * DROGUE_RAYS;
    const Real larger = all_about ? std::min<Real>(10, std::max<Real>(0, expected.a - 15)) : 0;
    const bool evident =
        all_about && 2 * d.rms <= real(config.inner_rms_px_q16) && std::fabs(d.grown) <= 0.3L + expected.a / 64;
    const Real gate = (evident ? 2 : 1) * (real(config.inner_gate_px_q16) + real(config.inner_gate_q16) * rim.a);
    return d.found && d.contrast >= config.min_inner_contrast &&
           static_cast<Real>(d.rays) >= real(config.min_inner_cover_q16) * DROGUE_RAYS &&
           d.rms <= real(config.inner_rms_px_q16) * (1 + larger / 15) && d.grown >= -room_of(expected, config) &&
           std::hypot(d.x - expected.xc, d.y - expected.yc) <= gate && room > 0 && std::hypot(u, v) <= room;
}

Disc inner_edge(const drogue_image &view, const drogue_inner_expected &expected, const drogue_ellipse &outline,
                const drogue_config &config, const drogue_inner_edge *library)
{
    const Real gate = real(config.inner_gate_px_q16) + real(config.inner_gate_q16) * real(outline.a_px_q16);
    const reference::Ellipse rim = real_of(outline);
    const auto holds = [&](const Disc &d) { return in_its_place(d, real_of(expected.disc[d.which]), rim, config); };
    std::array<First, 2> first;
    size_t which = 0;
    bool seen = false;
    for (size_t i = 0; i < expected.count && !seen; i++) {
        seen = look_about(first[i], view, expected.disc[i], gate, config);
        which = first[i].slopes > first[which].slopes ? i : which;
    }
    First between;
    if (!seen && expected.count == 2 && look_between(between, view, expected, gate, config)) {
        const Disc d = measure_at(view, expected, 0, between, config, library);
        if (holds(d) && d.grown <= room_of(real_of(expected.disc[d.which]), config)) {
            return d;
        }
    }
    if (first[which].slopes == 0) {
        return {};
    }
    const Disc steeper = measure_at(view, expected, static_cast<int>(which), first[which], config, library);
    if (first[1 - which].slopes > 0 && !holds(steeper)) {
        const Disc other = measure_at(view, expected, static_cast<int>(1 - which), first[1 - which], config, library);
        if (holds(other) && other.grown <= real(expected.disc[other.which].a_px_q16) / 64) {
            return other;
        }
    }
    return steeper;
}

} // namespace mirror
