/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tier of the tracker by its mirror. */
#include <algorithm>
#include <cmath>

#include "tiers.hpp"
#include "tracker.hpp"

namespace vectors {

namespace {

using reference::q16;
using reference::Real;
using Words = std::vector<int64_t>;

drogue_region region_of(const int64_t *w) { return {as_int(w[0]), as_int(w[1]), as_int(w[2]), as_int(w[3])}; }

drogue_track_config track_config_of(const Words &w)
{
    const auto n = [&w](size_t i) { return static_cast<uint32_t>(w[i]); };
    const auto q = [&w](size_t i) { return as_int(w[i]); };
    drogue_track_config c = {};
    c.max_missed = n(0);
    c.agree_frames = n(1);
    c.reconsider_frames = n(2);
    c.known_frames = n(3);
    c.min_region_px = q(4);
    c.max_region_px = q(5);
    c.gate_q16 = q(6);
    c.position_gate_q16 = q(7);
    c.region_scale_q16 = q(8);
    c.region_sigmas_q16 = q(9);
    c.lateral_std_q16 = q(10);
    c.depth_std_q16 = q(11);
    c.angle_std_rad_q16 = q(12);
    c.position_floor_m_q16 = q(13);
    c.angle_floor_rad_q16 = q(14);
    for (size_t k = 0; k < 5; k++) {
        c.process_std_q16[k] = q(15 + k);
    }
    c.process_step_q16 = q(20);
    c.lasting_share_q16 = q(21);
    c.start_rate_std_q16 = q(22);
    c.start_accel_std_q16 = q(23);
    return c;
}

drogue_result result_of(const int64_t *f, const int64_t *covariance)
{
    drogue_result r = {};
    r.status = static_cast<drogue_status>(f[1]);
    r.second_look = static_cast<drogue_second_look>(f[2]);
    r.has_inner = as_int(f[3]);
    r.orientation_resolved = as_int(f[4]);
    r.cover_q16 = as_int(f[5]);
    r.doubt_q16 = as_int(f[16]);
    for (drogue_pose *pose : {&r.pose, &r.alternative}) {
        const int64_t *at = f + (pose == &r.pose ? 6 : 11);
        for (size_t k = 0; k < 3; k++) {
            pose->position_m_q16[k] = as_int(at[k]);
        }
        pose->yaw_rad_q16 = as_int(at[3]);
        pose->pitch_rad_q16 = as_int(at[4]);
    }
    for (size_t i = 0; i < 5; i++) {
        for (size_t j = 0; j <= i; j++) {
            r.covariance_q48[i][j] = r.covariance_q48[j][i] = *covariance++;
        }
    }
    return r;
}

bool valid(const Words &w)
{
    const auto negative = [&w](size_t i) { return w[i] < 0; };
    for (size_t i = 6; i < 24; i++) {
        if (negative(i)) {
            return false;
        }
    }
    return w[1] > 0 && w[4] > 0 && w[4] <= w[5] && w[5] <= DROGUE_MAX_SIDE && w[8] > 0 && w[20] >= 65536 &&
           w[21] <= 65536;
}

} // namespace

Tiers track_tier(const Arrays &in, const Arrays &exact)
{
    const Words &s = in[0].words, &f = in[2].words;
    const size_t count = f.size() / 17;
    Words states(19 * count, 0), estimates(12 * count, 0), std(6 * count, 0);
    if (!valid(in[1].words)) {
        for (size_t i = 0; i < count; i++) {
            states[19 * i] = DROGUE_E_ARGUMENT;
        }
        return {{like(exact[0], states), {}}, {like(exact[1], estimates), {}}, {like(exact[2], std), {}}};
    }
    const auto q = [&s](size_t i) { return as_int(s[i]); };
    const drogue_region first = s[14] > 0 ? region_of(&s[12]) : drogue_region{0, 0, 0, 0};
    mirror::Tracker t(track_config_of(in[1].words), {q(0), q(1), q(2), q(3), q(4), q(5), q(6), q(7), q(8)},
                      {q(9), q(10), q(11)}, first);
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        const drogue_region r = t.begin(static_cast<uint32_t>(f[17 * i]));
        const int64_t search = t.search;
        const drogue_region reach = t.reach;
        t.end(result_of(&f[17 * i], &in[3].words[15 * i]));
        for (const int64_t v : {int64_t{DROGUE_OK}, int64_t{r.x_px}, int64_t{r.y_px}, int64_t{r.width_px},
                                int64_t{r.height_px}, search, int64_t{reach.x_px}, int64_t{reach.y_px},
                                int64_t{reach.width_px}, int64_t{reach.height_px}, int64_t{t.state}, int64_t{t.missed},
                                int64_t{t.gated}, int64_t{t.orientation_known}, int64_t{t.open_frames},
                                int64_t{t.turned}, int64_t{t.trial}, int64_t{t.agreeing}, int64_t{t.second_known}}) {
            states[at++] = v;
        }
        if (t.state == DROGUE_LOST) {
            continue;
        }
        const Real yaw = t.value[DROGUE_YAW], pitch = t.value[DROGUE_PITCH];
        const Real values[11] = {t.value[0],
                                 t.value[1],
                                 t.value[2],
                                 t.rate[0],
                                 t.rate[1],
                                 t.rate[2],
                                 std::sin(yaw) * std::cos(pitch),
                                 std::sin(pitch),
                                 std::cos(yaw) * std::cos(pitch),
                                 yaw,
                                 pitch};
        std::transform(values, values + 11, estimates.begin() + static_cast<long>(12 * i), q16);
        estimates[12 * i + 11] = t.orientation_known && t.turned == 0;
        const Real stds[6] = {t.std[0], t.std[1], t.std[2], t.std[DROGUE_YAW], t.std[DROGUE_PITCH], t.axis_std};
        for (size_t k = 0; k < 6; k++) {
            std[6 * i + k] = rounded(stds[k], 32);
        }
    }
    const Array words = like(exact[0], states), numbers = like(exact[1], estimates), roots = like(exact[2], std);
    return {{words, bounds("track", words)}, {numbers, bounds("track", numbers)}, {roots, bounds("track", roots)}};
}

} // namespace vectors
