/* SPDX-License-Identifier: Apache-2.0 */
/* The reference tier of what finds, looks again and decides, by the mirrors of tests/golden/mirror. */
#include <algorithm>
#include <cmath>

#include "drogue/search.h"
#include "frame_words.hpp"
#include "search.hpp"

namespace vectors {

namespace {

using reference::q16;
using reference::Real;
using Words = std::vector<int64_t>;

drogue_region region_of(const int64_t *w) { return {as_int(w[0]), as_int(w[1]), as_int(w[2]), as_int(w[3])}; }

reference::Pose pose_of(const int64_t *w)
{
    return {{real(w[0]), real(w[1]), real(w[2])}, {real(w[3]), real(w[4]), real(w[5])}, real(w[6]), real(w[7])};
}

/* A measurement by the library itself, for the mirror to follow where it resolves no more. */
drogue_result library_measures(const mirror::Task &task)
{
    std::vector<uint32_t> memory(drogue_workspace_bytes(&task.capacity) / 4 + 1);
    const drogue_image image = {task.image.data, task.image.cols, task.image.rows,
                                static_cast<int32_t>(task.image.step)};
    const drogue_setup setup = {&task.library_camera, &task.library_model, &task.config};
    const drogue_region region = region_of(task.region.data());
    drogue_workspace workspace;
    drogue_result result;
    drogue_workspace_init(&workspace, memory.data(), memory.size() * 4, &task.capacity);
    (void)drogue_measure(&result, &workspace, &setup, &image, &region);
    return result;
}

} // namespace

Tiers rim_tier(const Arrays &in, const Arrays &exact)
{
    const Words &d = in[1].words;
    Words words(exact[0].words.size(), 0);
    const auto rims = mirror::rims_about(image_of(in[0]), {as_int(d[0]), as_int(d[1]), as_int(d[2]), as_int(d[3])});
    words[0] = static_cast<int64_t>(rims.size());
    for (size_t i = 0; i < rims.size(); i++) {
        const mirror::Rim &r = rims[i];
        std::copy_n(Words{r.x, r.y, r.radius, r.score}.begin(), 4, words.begin() + 1 + 4 * static_cast<long>(i));
    }
    return {{like(exact[0], words), bounds("rim", like(exact[0], words))}};
}

Tiers search_tier(const Arrays &in, const Arrays &exact)
{
    const int64_t least = in[1].words[0];
    Words words(exact[0].words.size(), 0);
    if (least < 0 || least > 255) {
        words[0] = DROGUE_E_ARGUMENT;
        return {{like(exact[0], words), {}}};
    }
    const auto found = mirror::sightings_in(image_of(in[0]), as_int(least));
    words[1] = static_cast<int64_t>(found.best.size());
    words[2] = static_cast<int64_t>(found.dark.size());
    const auto put = [&](const std::vector<mirror::Sighting> &sightings, long at) {
        for (const mirror::Sighting &s : sightings) {
            const Words own = {s.x, s.y, s.radius, s.score, s.region.x, s.region.y, s.region.width, s.region.height};
            std::copy(own.begin(), own.end(), words.begin() + at);
            at += 8;
        }
    };
    put(found.best, 3);
    put(found.dark, 3 + 8 * DROGUE_SEARCH_MAX);
    return {{like(exact[0], words), {}}};
}

Tiers decide_tier(const Arrays &in, const Arrays &exact)
{
    const Words &e = in[0].words, &c = in[1].words, &bins = in[2].words, &p = in[3].words;
    mirror::Task task = {
        {}, {real(c[0]), real(c[1]), real(c[2]), real(c[3])}, {real(p[0]), real(p[1]), real(p[2])}, {}, {}, {}, {}, {}};
    drogue_config_default(&task.config);
    task.config.outline_shading_q16 = as_int(p[23]);
    task.config.optics_blur_std_px2_q16 = as_int(p[24]);
    task.config.max_chi2_q16 = as_int(p[25]);
    task.config.min_chi2_gap_q16 = as_int(p[26]);
    mirror::Features f = {{real(e[0]), real(e[1]), real(e[2]), real(e[3]), real(e[4]), true},
                          {},
                          {{real(p[20]), real(p[21])}, real(p[22])},
                          true,
                          true,
                          real(p[28]),
                          real(p[29]),
                          as_int(p[30])};
    for (size_t k = 0; k < reference::SUPPORT_BINS; k++) {
        f.support.count[k][0] = as_int(bins[2 * k]);
        f.support.sum[k] = real(bins[2 * k + 1]);
        f.support.points += as_int(bins[2 * k]);
    }
    f.support.gradient = static_cast<Real>(p[27]);
    mirror::Result r;
    r.has_inner = p[22] > 0;
    mirror::decide(r, task, f, {pose_of(&p[3]), pose_of(&p[11])}, p[19] != 0 ? 1 : 0);
    Words words(19, 0), covariance(15, 0), std(4, 0);
    words[0] = r.status;
    if (r.status != DROGUE_OK) {
        return {{like(exact[0], words), {}}, {like(exact[1], covariance), {}}, {like(exact[2], std), {}}};
    }
    std::vector<Real> more, std_more;
    size_t at = 1;
    for (const reference::Pose &pose : {r.pose, r.alternative}) {
        for (const Real v : {pose.position[0], pose.position[1], pose.position[2], pose.axis[0], pose.axis[1],
                             pose.axis[2], pose.yaw, pose.pitch}) {
            words[at++] = q16(v);
        }
    }
    words[at++] = r.resolved;
    words[at] = q16(r.doubt);
    at = 0;
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j <= i; j++) {
            const Real scale = std::sqrt(static_cast<Real>(r.covariance(i, i)) * r.covariance(j, j));
            covariance[at++] = rounded(r.covariance(i, j), 48);
            more.push_back(std::ldexp(scale, 48) * 0x1p-14L);
        }
    }
    for (size_t k = 0; k < 4; k++) {
        std[k] = rounded(k < 3 ? r.position_std[k] : r.axis_std, 32);
        std_more.push_back(static_cast<Real>(std[k]) * 0x1p-14L);
    }
    const Array matrix = like(exact[1], covariance), roots = like(exact[2], std);
    return {{like(exact[0], words), bounds("decide", like(exact[0], words))},
            {matrix, bounds("decide", matrix, more)},
            {roots, bounds("decide", roots, std_more)}};
}

namespace {

/* Five words of an ellipse seen, with what they may be off. */
void put_seen(Words &words, std::vector<Real> &more, size_t at, const FrameWords &f)
{
    std::copy_n(f.words.begin() + frame_words::SEEN, 5, words.begin() + static_cast<long>(at));
    std::copy_n(f.more.begin() + frame_words::SEEN, 5, more.begin() + static_cast<long>(at));
}

void put_region(Words &words, size_t at, const cv::Rect &r)
{
    std::copy_n(Words{r.x, r.y, r.width, r.height}.begin(), 4, words.begin() + static_cast<long>(at));
}

} // namespace

Tiers look_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[3].words;
    mirror::Task task = frame_words::task_of(in, {p[0], p[1], p[2], p[3]});
    task.capacity = {static_cast<uint32_t>(p[4]), static_cast<uint32_t>(p[5]), static_cast<uint32_t>(p[6]),
                     static_cast<uint32_t>(p[7])};
    task.config.transfer = static_cast<drogue_transfer>(p[8]);
    const FrameWords f = frame_words::of(task, library_measures(task));
    Words words(15, 0);
    std::vector<Real> more(15, EXACTLY);
    words[0] = f.words[frame_words::STATUS];
    words[1] = f.result.second_look;
    words[2] = f.result.tried;
    put_region(words, 3, f.result.region);
    words[7] = f.result.found ? q16(f.result.outline.cover) : 0;
    put_seen(words, more, 8, f);
    words[13] = f.words[frame_words::HAS_INNER];
    words[14] = f.words[frame_words::RESOLVED];
    return {{like(exact[0], words), bounds("look", like(exact[0], words), more)}};
}

namespace {

/* What drogue_acquire() weighs in a measurement, by drogue/search.h. */
class Weighed {
public:
    Weighed(const mirror::Result &r, const reference::Model &m)
        : ok_(r.status == DROGUE_OK), with_inner_(m.inner_radius > 0), cover_(r.outline.cover),
          reliable_(ok_ && r.outline.quality.reliability >= 0.9L), decided_(r.resolved && r.doubt < 1 / 64.0L)
    {
        const Real z = r.pose.position[2], end = z + m.inner_depth;
        log_odds_ = cover_ - 3;
        if (ok_ && r.has_inner && z > 0 && end > 0) {
            const Real expected = std::sqrt(r.seen.a * r.seen.b) * m.inner_radius / m.rim_radius * z / end;
            const Real radius = std::max<Real>(1, expected), power = std::floor(std::log2(radius));
            const Real log2 = power + radius / std::exp2(power) - 1; /* straight from one power to the next */
            const Real seen = r.part.rays / Real(DROGUE_RAYS);
            log_odds_ = (5 * log2 + 9 * cover_ - 2 * r.outline.outside + 10 * seen - 14 * r.part.rms - 7 * r.ambiguity +
                         3 * decided_) /
                            4 -
                        5;
        }
    }
    bool sure() const { return ok_ && (with_inner_ ? log_odds_ >= 0.625L : cover_ >= 0.75L && reliable_); }
    bool settles() const { return sure() && (!with_inner_ || decided_); }
    /* To whole units of Q16: of what is equal in it the first stands. */
    Real worth() const
    {
        return !ok_ ? -1000 : with_inner_ ? std::floor(log_odds_ * 65536 + 0.5L) / 65536 : (sure() ? 0 : -100) + cover_;
    }

private:
    bool ok_, with_inner_;
    Real cover_;
    bool reliable_, decided_;
    Real log_odds_;
};

} // namespace

Tiers acquire_tier(const Arrays &in, const Arrays &exact)
{
    const Words &p = in[3].words;
    const cv::Mat image = image_of(in[0]);
    const std::array<int64_t, 4> all = {0, 0, image.cols, image.rows};
    const std::array<int64_t, 4> asked = p[0] != 0 ? std::array<int64_t, 4>{p[1], p[2], p[3], p[4]} : all;
    Words words(20, 0);
    std::vector<Real> more(20, EXACTLY);
    const auto refused = [&](drogue_status status) -> Tiers {
        words[0] = status;
        return {{like(exact[0], words), {}}};
    };
    const auto clip = [](int64_t from, int64_t length,
                         int64_t limit) { /* [first, end) in whole numbers of any size */
                                          return std::pair<int64_t, int64_t>(std::clamp<int64_t>(from, 0, limit),
                                                                             std::min(from + length, limit));
    };
    const auto [left, right] = clip(asked[0], asked[2], image.cols);
    const auto [top, bottom] = clip(asked[1], asked[3], image.rows);
    if (asked[2] < 1 || asked[3] < 1 || right <= left || bottom <= top) {
        return refused(DROGUE_E_REGION);
    }
    if (p[7] < 0 || p[7] > 255) {
        return refused(DROGUE_E_ARGUMENT);
    }
    if (right - left > p[5]) {
        return refused(DROGUE_E_WORKSPACE);
    }
    const cv::Rect part(as_int(left), as_int(top), as_int(right - left), as_int(bottom - top));
    const auto measured = [&](const std::array<int64_t, 4> &region) {
        mirror::Task task = frame_words::task_of(in, region);
        task.capacity.width_px = static_cast<uint32_t>(p[6]);
        return frame_words::of(task, library_measures(task));
    };
    std::vector<FrameWords> tried;
    const reference::Model model = {real(in[2].words[0]), real(in[2].words[1]), real(in[2].words[2])};
    const mirror::Sightings found = mirror::sightings_in(image(part), as_int(p[7]));
    const auto weigh = [&](const FrameWords &f) { return Weighed(f.result, model); };
    const Real none = -1000;
    Real most = none;
    bool any_sure = false;
    size_t best = 0;
    const auto attempt = [&](const std::array<int64_t, 4> &region) {
        tried.push_back(measured(region));
        const Weighed w = weigh(tried.back());
        if (w.worth() <= most) {
            return false;
        }
        any_sure = w.sure();
        most = w.worth();
        best = tried.size() - 1;
        return w.settles();
    };
    const auto about = [x = left, y = top](const cv::Rect &r) {
        return std::array<int64_t, 4>{r.x + x, r.y + y, r.width, r.height};
    };
    std::vector<mirror::Sighting> measured_ones;
    bool settled = false;
    for (const mirror::Sighting &s : found.best) {
        if (settled && model.inner_radius <= 0) {
            break;
        }
        if (settled) { /* a larger outline about it? */
            const mirror::Sighting &of = measured_ones[best];
            const int room = s.radius / 4 + 1;
            if (8 * s.radius <= 9 * of.radius || std::abs(s.x - of.x) > room || std::abs(s.y - of.y) > room) {
                continue;
            }
        }
        measured_ones.push_back(s);
        settled = attempt(about(s.region)) || settled;
    }
    for (size_t i = 0; i < found.dark.size() && !any_sure && model.inner_radius > 0; i++) {
        const mirror::Sighting &s = found.dark[i]; /* the disc's radius as the rim's */
        const Real radius = std::floor((s.radius + 0.5L) * model.rim_radius / model.inner_radius + 0.5L);
        (void)attempt(about(mirror::frame_of(s.x, s.y, static_cast<int>(std::min<Real>(radius, DROGUE_MAX_SIDE)))));
    }
    if (!any_sure && (model.inner_radius <= 0 || std::max(part.width, part.height) <= 512)) {
        (void)attempt(asked);
    }
    if (tried.empty()) {
        return refused(DROGUE_E_NO_INNER_PART);
    }
    if (most <= none) {
        return refused(static_cast<drogue_status>(
            std::max_element(tried.begin(), tried.end(), [](const FrameWords &a, const FrameWords &b) {
                return a.result.status < b.result.status;
            })->result.status));
    }
    const FrameWords &f = tried[best];
    words[0] = f.result.status;
    if (f.result.status == DROGUE_OK && !weigh(f).sure()) {
        words[0] = DROGUE_E_UNSURE;
    }
    if (std::any_of(tried.begin(), tried.end(), [](const FrameWords &t) { return t.result.contradicted; })) {
        words[0] = -1; /* as a frame's status */
    }
    put_region(words, 1, f.result.region);
    words[5] = f.words[frame_words::HAS_INNER];
    words[6] = f.words[frame_words::RESOLVED];
    put_seen(words, more, 7, f);
    std::copy_n(f.words.begin() + frame_words::POSE, 8, words.begin() + 12);
    std::copy_n(f.more.begin() + frame_words::POSE, 8, more.begin() + 12);
    return {{like(exact[0], words), bounds("acquire", like(exact[0], words), more)}};
}

} // namespace vectors
