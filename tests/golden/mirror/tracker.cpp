/* SPDX-License-Identifier: Apache-2.0 */
/* The tracker in floating point: what drogue/track.h, bank.h and kalman.h describe. */
#include "tracker.hpp"

#include <algorithm>
#include <cmath>

#include "mirror.hpp"

namespace mirror {

namespace {

constexpr size_t Z = DROGUE_Z, PITCH = DROGUE_PITCH, YAW = DROGUE_YAW;
constexpr size_t MOST_AGILE = DROGUE_BANK_MODELS - 1;
constexpr int TRIAL_FRAMES = 5;
const Real PI = std::acos(Real(-1));

Real real(int32_t q16) { return static_cast<Real>(q16) / 65536; }
Real rounded(Real v) { return static_cast<Real>(reference::q16(v)) / 65536; }
Real at_least_one(Real v) { return std::max(v, 1 / Real(65536)); }
Real squared(Real v) { return v * v; }

/* Measured less predicted; an angle's less its whole turns. */
Real innovation(const Filter &f, size_t p, Real value)
{
    const Real d = value - f.parameter[p].state[0];
    return p >= PITCH ? std::remainder(d, 2 * PI) : d;
}

void predict(Filter &f, Real dt, const Five &std)
{
    const Real step[3][3] = {{1, dt, dt * dt / 2}, {0, 1, dt}, {0, 0, 1}};
    for (size_t p = 0; p < 5; p++) {
        Filter::Parameter &own = f.parameter[p];
        const Filter::Parameter was = own;
        for (size_t i = 0; i < 3; i++) {
            own.state[i] = 0;
            for (size_t j = 0; j < 3; j++) {
                own.state[i] += step[i][j] * was.state[j];
                own.covariance[i][j] = step[i][2] * step[j][2] * squared(std[p]);
                for (size_t k = 0; k < 9; k++) {
                    own.covariance[i][j] += step[i][k / 3] * was.covariance[k / 3][k % 3] * step[j][k % 3];
                }
            }
        }
        own.state[0] = p >= PITCH ? std::remainder(own.state[0], 2 * PI) : own.state[0];
    }
}

void update(Filter::Parameter &own, Real off, Real variance)
{
    const Filter::Parameter was = own;
    const Real sum = was.covariance[0][0] + variance;
    for (size_t i = 0; i < 3; i++) {
        own.state[i] += was.covariance[i][0] / sum * off;
        for (size_t j = 0; j < 3; j++) {
            own.covariance[i][j] -= was.covariance[i][0] * was.covariance[0][j] / sum;
        }
    }
    own.covariance[0][0] = was.covariance[0][0] / sum * variance;
}

void restart(Filter::Parameter &own, Real value, Real std, const drogue_track_config &c)
{
    own = {};
    own.state[0] = value;
    own.covariance[0][0] = squared(std);
    own.covariance[1][1] = squared(real(c.start_rate_std_q16));
    own.covariance[2][2] = squared(real(c.start_accel_std_q16));
}

/* d' (P + N)^-1 d over the first n parameters; by the diagonal where the sum is not positive definite. */
Real distance2(const Filter &f, const Measured &m, size_t n)
{
    std::array<std::array<Real, 5>, 5> a = m.noise;
    Five d = {};
    Real alone = 0, sum = 0;
    for (size_t p = 0; p < n; p++) {
        a[p][p] += f.parameter[p].covariance[0][0];
        d[p] = innovation(f, p, m.value[p]);
        alone += squared(d[p]) / a[p][p];
    }
    const std::array<std::array<Real, 5>, 5> whole = a;
    for (size_t p = 0; p < n; p++) { /* elimination: what is left of a row's own entry is its pivot */
        if (!(a[p][p] > whole[p][p] * 0x1p-26L)) {
            return alone;
        }
        sum += squared(d[p]) / a[p][p];
        for (size_t q = p + 1; q < n; q++) {
            const Real share = a[q][p] / a[p][p];
            d[q] -= share * d[p];
            for (size_t k = p; k < n; k++) {
                a[q][k] -= share * a[p][k];
            }
        }
    }
    return sum;
}

bool passes(const Filter &f, const Measured &m, size_t n, Real gate) { return distance2(f, m, n) <= gate; }

} // namespace

Tracker::Tracker(const drogue_track_config &config, const drogue_camera &camera, const drogue_model &model,
                 const drogue_region &first)
    : config_(config), camera_(camera), model_(model), first_(first)
{
    reach = first;
}

void Tracker::mix(int wider, Filter &out) const
{
    for (size_t p = 0; p < 5; p++) {
        out.parameter[p] = bank_[std::min(chosen_[p] + static_cast<size_t>(wider), MOST_AGILE)].parameter[p];
    }
}

/* By how much predictions so many frames ahead were wrong of late, squared. */
Real Tracker::wrong2(size_t p, int frames) const
{
    return weighed_ == 0 ? 0 : error2_[chosen_[p]][p] * frames * frames * (weighed_ + 2) / weighed_;
}

/* What lasts of a measurement's variance does not go with filtering; a prediction is no better than the last ones. */
void Tracker::estimate(int ahead)
{
    Filter own;
    mix(0, own);
    for (size_t p = 0; p < 5; p++) {
        const Real variance = own.parameter[p].covariance[0][0];
        value[p] = own.parameter[p].state[0];
        value[p] = ahead > 0 ? value[p] : rounded(value[p]) + rounded(shake_[p]);
        rate[p] = own.parameter[p].state[1];
        std[p] = std::sqrt(std::max(
            variance + std::max<Real>(0, noise_[p] - variance) * real(config_.lasting_share_q16), wrong2(p, ahead)));
    }
    value[PITCH] = std::remainder(value[PITCH], 2 * PI);
    value[YAW] = std::remainder(value[YAW], 2 * PI);
    axis_std = std::hypot(std[YAW] * std::cos(value[PITCH]), std[PITCH]);
}

drogue_region Tracker::square(Real x, Real y, Real side) const
{
    const auto whole = [](Real v) { return static_cast<int32_t>(std::floor(v + 0.5L)); };
    const int32_t px = whole(std::clamp<Real>(std::floor(side + 0.5L), config_.min_region_px, config_.max_region_px));
    return {whole(x) - px / 2, whole(y) - px / 2, px, px};
}

bool Tracker::place(drogue_region &region)
{
    const auto pixel = [this](const Five &v, reference::Point &at) {
        const reference::Camera c = {real(camera_.fx_px_q16), real(camera_.fy_px_q16), real(camera_.cx_px_q16),
                                     real(camera_.cy_px_q16), real(camera_.k1_q16),    real(camera_.k2_q16),
                                     real(camera_.p1_q16),    real(camera_.p2_q16),    real(camera_.k3_q16)};
        const bool lens = c.k1 != 0 || c.k2 != 0 || c.p1 != 0 || c.p2 != 0 || c.k3 != 0;
        at = {c.fx * v[0] / v[2] + c.cx, c.fy * v[1] / v[2] + c.cy};
        return v[2] > 0 && (!lens || reference::distort(c, at));
    };
    const Real radius = real(model_.rim_radius_m_q16), scale = real(config_.region_scale_q16);
    reference::Point at, other;
    estimate(missed + 1);
    Five seen = value;
    std::transform(seen.begin(), seen.end(), seen.begin(), rounded);
    if (!pixel(seen, at)) {
        return false;
    }
    const Real semi_axis = radius / seen[2] * real(std::max(camera_.fx_px_q16, camera_.fy_px_q16));
    Real spread = real(config_.region_sigmas_q16) * (std::max(std[0], std[1]) / radius + std[2] / seen[2]);
    for (size_t p = 0; p < 5; p++) {
        seen[p] = rounded(second_.parameter[p].state[0]);
    }
    if (agreeing > 0 && pixel(seen, other)) { /* room for what follows the refused measurements */
        const Real dx = (other.x - at.x) / 2, dy = (other.y - at.y) / 2, half = std::hypot(dx, dy) / semi_axis;
        if (half <= 0.3L) {
            at = {at.x + dx, at.y + dy};
            spread += half;
        }
    }
    search = spread > real(DROGUE_Q16(4, 10));
    reach = square(at.x, at.y, (scale + 2 * spread) * semi_axis);
    region = square(at.x, at.y, scale * (1 + std::min<Real>(spread, real(DROGUE_Q16(4, 10))) / 4) * semi_axis);
    return true;
}

drogue_region Tracker::begin(uint32_t dt_us)
{
    const Real dt = dt_us / Real(1000000), step = real(config_.process_step_q16);
    std::array<Five, DROGUE_BANK_MODELS> process;
    for (size_t p = 0; p < 5; p++) {
        process[0][p] = real(config_.process_std_q16[p]);
        process[1][p] = rounded(process[0][p] * step);
        process[2][p] = rounded(process[1][p] * step);
    }
    gated = false;
    if (agreeing > 0) {
        predict(second_, dt, process[MOST_AGILE]);
    }
    if (state != DROGUE_LOST) {
        drogue_region region;
        for (size_t m = 0; m < bank_.size(); m++) {
            predict(bank_[m], dt, process[m]);
        }
        if (place(region)) {
            return region;
        }
        state = DROGUE_LOST;
        agreeing = 0;
    }
    reach = first_;
    search = first_.width_px <= 0;
    return first_;
}

/* --- the measurement --- */

Measured Tracker::read(const drogue_result &r, bool twin) const
{
    static const size_t order[5] = {0, 1, 2, 4, 3}; /* of the result's covariance: it ends with yaw, pitch */
    const drogue_pose &pose = twin ? r.alternative : r.pose;
    const auto values = [](const drogue_pose &p) {
        return Five{real(p.position_m_q16[0]), real(p.position_m_q16[1]), real(p.position_m_q16[2]),
                    real(p.pitch_rad_q16), real(p.yaw_rad_q16)};
    };
    const auto entry = [&r](size_t p, size_t q) {
        const size_t i = std::max(order[p], order[q]), j = std::min(order[p], order[q]);
        return std::ldexp(static_cast<Real>(r.covariance_q48[i][j]), r.covariance_halved - 48);
    };
    Measured m;
    m.value = values(pose);
    m.solid = r.has_inner != 0 || r.orientation_resolved != 0 || model_.inner_radius_m_q16 == 0;
    if (r.covariance_q48[0][0] > 0) {
        Five apart = values(r.alternative); /* of the twins, where the covariance holds half its square */
        const Five own = values(r.pose);
        auto doubt = doubt_covariance({own[0], own[1], own[2]}, real(r.doubt_q16), real(model_.rim_radius_m_q16));
        for (size_t p = 0; p < 5; p++) {
            apart[p] = std::clamp<Real>(apart[p] - own[p], -64, 64);
        }
        for (size_t p = 0; p < 5; p++) {
            if (r.orientation_resolved != 0 || entry(p, p) <= squared(apart[p]) / 2) {
                apart = {};
            }
        }
        for (size_t p = 0; p <= Z; p++) {
            if (doubt[p][p] >= entry(p, p) - squared(apart[p]) / 2) { /* the covariance does not hold it */
                doubt = {};
            }
        }
        for (size_t p = 0; p < 5; p++) {
            const Real floor =
                at_least_one(real(p < PITCH ? config_.position_floor_m_q16 : config_.angle_floor_rad_q16));
            for (size_t q = 0; q < 5; q++) {
                const bool known = p == q || !twin || std::max(p, q) <= Z;
                m.noise[p][q] = known ? entry(p, q) - apart[p] * apart[q] / 2 : 0;
                m.noise[p][q] -= std::max(p, q) <= Z ? doubt[p][q] : 0;
            }
            m.apart[p] = squared(apart[p]) / 2;
            const Real own = std::max<Real>(entry(p, p), 0) - m.apart[p];
            m.doubt[p] = p <= Z ? doubt[p][p] : 0;
            m.noise[p][p] = own - m.doubt[p] + squared(floor);
        }
    } else {
        const Real z = m.value[Z], lateral = rounded(real(config_.lateral_std_q16) * z);
        const Five std = {lateral, lateral, rounded(real(config_.depth_std_q16) * z), real(config_.angle_std_rad_q16),
                          real(config_.angle_std_rad_q16)};
        for (size_t p = 0; p < 5; p++) {
            m.noise[p][p] = squared(at_least_one(std[p]));
        }
    }
    if (r.second_look > DROGUE_SECOND_BETTER &&
        r.second_look != DROGUE_SECOND_ROOM) { /* a cut outline may be another than it seems */
        const Real lacking = std::trunc((65536 - r.cover_q16) / Real(3)) / 65536;
        for (size_t p = 0; p < 5; p++) {
            m.noise[p][p] += squared(lacking * (p == Z ? m.value[Z] : p < Z ? real(model_.rim_radius_m_q16) : 1));
        }
    }
    for (size_t p = 0; p < 5; p++) {
        m.std[p] = at_least_one(rounded(std::sqrt(m.noise[p][p])));
    }
    return m;
}

/* --- what to believe --- */

void Tracker::start(Filter &f, const Measured &m) const
{
    for (size_t p = 0; p < 5; p++) {
        restart(f.parameter[p], m.value[p], m.std[p], config_);
    }
}

/* What z's correction leaves of its innovation is taken out of x and y by their regression on z. */
void Tracker::correct(Filter &f, const Measured &m) const
{
    const Real zz = m.noise[Z][Z], variance = f.parameter[Z].covariance[0][0];
    const Real left = zz / (variance + zz);
    for (size_t p = 0; p < 5; p++) {
        Real at = m.value[p], std = m.std[p];
        if (p < Z) {
            const Real k = m.noise[Z][p] / zz;
            const Real own =
                std::max(m.noise[p][p] - k * k * zz, squared(at_least_one(real(config_.position_floor_m_q16))));
            at = rounded(at - k * left * (m.value[Z] - f.parameter[Z].state[0]));
            std = at_least_one(rounded(std::sqrt(own + k * k * variance * left)));
        }
        update(f.parameter[p], innovation(f, p, at), squared(std));
    }
}

void Tracker::keep_noise(const Measured &m)
{
    for (size_t p = 0; p < 5; p++) {
        noise_[p] = m.noise[p][p] + m.doubt[p] + (orientation_known ? 0 : m.apart[p]);
    }
}

/* A filter begins the track. */
void Tracker::follow(const Filter &f, bool known)
{
    bank_.fill(f);
    error2_ = {};
    weighed_ = 0;
    shake_ = {};
    chosen_.fill(MOST_AGILE);
    orientation_known = known;
    trial = open_frames = turned = agreeing = missed = 0;
    state = DROGUE_TRACKING;
}

void Tracker::believe(const Measured &m)
{
    for (size_t p = 0; p < 5 && weighed_ > 0; p++) { /* the first prediction knew no rate */
        for (size_t i = 0; i < bank_.size(); i++) {
            error2_[i][p] += (squared(innovation(bank_[i], p, m.value[p])) - error2_[i][p]) / weighed_;
        }
        size_t best = chosen_[p];
        Real least = error2_[best][p] * 7 / 8;
        for (size_t i = 0; i < bank_.size(); i++) {
            if (i != chosen_[p] && error2_[i][p] < least) {
                least = error2_[i][p];
                best = i;
            }
        }
        chosen_[p] = best;
    }
    weighed_ = std::min(weighed_ + 1, 16);
    for (size_t p = 0; p < 5; p++) {
        const Real expected = bank_[chosen_[p]].parameter[p].covariance[0][0] + m.noise[p][p];
        const Real shake = std::max<Real>(0, error2_[chosen_[p]][p] - 2 * expected);
        shake_[p] = shake / (shake + m.noise[p][p]);
    }
    for (Filter &f : bank_) {
        correct(f, m);
    }
    for (size_t p = 0; p < 5; p++) { /* what the filters take for noise, but is the camera's */
        shake_[p] *= innovation(bank_[chosen_[p]], p, m.value[p]);
    }
    keep_noise(m);
    missed = agreeing = 0;
    state = DROGUE_TRACKING;
    if (m.solid) {
        trial = 0;
    } else if (trial > 0 && --trial == 0) {
        state = DROGUE_LOST;
    }
}

void Tracker::miss()
{
    missed++;
    if (state != DROGUE_LOST) {
        state = missed > static_cast<int>(config_.max_missed) ? DROGUE_LOST : DROGUE_COASTING;
    }
    agreeing = state == DROGUE_LOST ? 0 : agreeing;
}

void Tracker::refuse(const Measured &m, bool known)
{
    gated = true;
    if (!m.solid) {
        miss();
        return;
    }
    missed++;
    if (agreeing > 0 && passes(second_, m, 5, real(config_.gate_q16))) {
        correct(second_, m);
        agreeing++;
        second_known = second_known || known;
    } else {
        start(second_, m);
        agreeing = 1;
        second_known = known;
    }
    state = DROGUE_COASTING;
    if (agreeing >= static_cast<int>(config_.agree_frames) || missed > static_cast<int>(config_.max_missed)) {
        follow(second_, second_known);
        gated = false;
        keep_noise(m);
    }
}

/* A step more agile than the estimate, no narrower than predictions were wrong, with room in depth. */
Filter Tracker::gate() const
{
    Filter f;
    mix(1, f);
    for (size_t p = 0; p < 5; p++) {
        Real &variance = f.parameter[p].covariance[0][0];
        variance = std::max(variance, wrong2(p, missed + 1));
    }
    f.parameter[Z].covariance[0][0] += squared(real(config_.depth_std_q16) * f.parameter[Z].state[0]);
    return f;
}

void Tracker::unresolved(const Measured &pose, const Measured &twin)
{
    const Filter f = gate();
    const bool turn = distance2(f, twin, 5) < distance2(f, pose, 5);
    const Measured &nearer = turn ? twin : pose, &farther = turn ? pose : twin;
    const Real most = rounded(std::trunc(nearer.value[Z] * 65536 / 20) / 65536);
    const bool range_fits = nearer.solid || std::fabs(innovation(f, Z, nearer.value[Z])) <= std::fabs(most);
    if (!passes(f, nearer, 5, real(config_.gate_q16)) || !range_fits) {
        refuse(nearer, false);
        return;
    }
    open_frames++;
    if (passes(f, farther, 5, 3 * real(config_.gate_q16)) ||
        (config_.known_frames > 0 && open_frames >= static_cast<int>(config_.known_frames))) {
        orientation_known = false;
    }
    believe(nearer);
}

void Tracker::resolved(const Measured &pose, const Measured &twin)
{
    const Filter f = gate();
    open_frames = 0;
    if (!passes(f, pose, 5, real(config_.gate_q16))) {
        if (!(orientation_known ? passes(f, twin, 5, real(config_.gate_q16))
                                : passes(f, pose, 3, real(config_.position_gate_q16)))) {
            refuse(pose, true);
            return;
        }
        turned++;
        if (orientation_known && turned < static_cast<int>(config_.agree_frames)) {
            believe(twin);
            return;
        }
        for (Filter &model : bank_) { /* the angles start anew, to a radian unknown */
            for (const size_t p : {PITCH, YAW}) {
                restart(model.parameter[p], pose.value[p], 1, config_);
            }
        }
    }
    orientation_known = true;
    turned = 0;
    believe(pose);
}

void Tracker::end(const drogue_result &r)
{
    if (r.status != DROGUE_OK) {
        miss();
    } else if (state == DROGUE_LOST) {
        const Measured m = read(r, false);
        Filter f;
        start(f, m);
        follow(f, r.orientation_resolved != 0);
        trial = m.solid && model_.inner_radius_m_q16 > 0 ? TRIAL_FRAMES : 0;
        keep_noise(m);
    } else if (r.orientation_resolved != 0) {
        resolved(read(r, false), read(r, true));
    } else {
        unresolved(read(r, false), read(r, true));
    }
    if (state != DROGUE_LOST) {
        estimate(missed);
    }
}

} // namespace mirror
