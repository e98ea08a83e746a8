/* SPDX-License-Identifier: Apache-2.0 */
/* Dark discs in whole images of block means, rays from each, circles through what the rays meet. */
#include "search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "drogue/search.h"

namespace mirror {

namespace {

constexpr int RAYS = 16;

/* What a ray may meet: at t cells the change from the cell before to the one behind; at the first from itself. */
struct Ray {
    int dx, dy; /* Q8 */
    int first;
    std::vector<int> steps;
    int at(int t) const { return steps[static_cast<size_t>(t - first)]; }
};

Ray read_ray(const cv::Mat &cells, const DarkDisc &disc, int index)
{
    const double angle = index * CV_PI / 8;
    Ray ray = {cvRound(256 * std::cos(angle)), cvRound(256 * std::sin(angle)), (disc.ring_q4 + 8) / 16, {}};
    const int last = std::min((7 * disc.ring_q4 + 16) / 32, DROGUE_SEARCH_REACH - 1);
    const auto cell = [&](int t) -> std::optional<int> {
        const cv::Point p(disc.x + cvFloor((ray.dx * t + 128) / 256.0), disc.y + cvFloor((ray.dy * t + 128) / 256.0));
        return p.inside({0, 0, cells.cols, cells.rows}) ? std::optional<int>(cells.at<uint8_t>(p)) : std::nullopt;
    };
    bool inside = true;
    for (int t = ray.first; t <= last; t++) {
        for (int k = ray.first; k <= t + 1; k++) { /* a ray ends where it leaves the level */
            inside = inside && cell(k).has_value();
        }
        ray.steps.push_back(inside ? *cell(t + 1) - *cell(std::max(t - 1, ray.first)) : 0);
    }
    return ray;
}

enum class Choice { largest, outermost, innermost };

struct Taken {
    int at = 0, step = 0; /* cells; 0: none */
    cv::Point place;      /* 16ths */
    bool used = false;
};

Taken take(const Ray &ray, int sign, Choice which)
{
    Taken out;
    const int first = ray.first, last = first + static_cast<int>(ray.steps.size()) - 1;
    const auto height = [&](int t) { return sign * ray.at(t); };
    for (int t = first; t <= last; t++) {
        if (height(t) >= 3 && height(t) > out.step) {
            out = {t, height(t), {}, true};
        }
    }
    if (out.at <= 0) {
        return Taken();
    }
    if (which != Choice::largest) {
        const int least = std::max((out.step + 1) / 2, 3), way = which == Choice::outermost ? -1 : 1;
        int t = which == Choice::outermost ? last : first;
        for (; height(t) < least; t += way) {}
        for (; t + way >= first && t + way <= last && height(t + way) > height(t); t += way) {}
        out = {t, height(t), {}, t > 0};
    }
    out.place = {cvFloor(ray.dx * out.at / 16.0), cvFloor(ray.dy * out.at / 16.0)};
    return out;
}

/* Least squares of x^2 + y^2 = 2 a x + 2 b y + c, its centre rounded to 16ths. */
bool fit(Rim &rim, const std::array<Taken, RAYS> &taken)
{
    double n = 0, mx = 0, my = 0, mz = 0;
    for (const Taken &t : taken) {
        if (t.used) {
            n++;
            mx += t.place.x;
            my += t.place.y;
            mz += t.place.ddot(t.place);
        }
    }
    if (n < 5) {
        return false;
    }
    mx /= n;
    my /= n;
    mz /= n;
    double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, mean = 0;
    for (const Taken &t : taken) {
        if (t.used) {
            const double x = t.place.x - mx, y = t.place.y - my, z = t.place.ddot(t.place) - mz;
            xx += x * x;
            xy += x * y;
            yy += y * y;
            xz += x * z;
            yz += y * z;
        }
    }
    const double det = xx * yy - xy * xy;
    if (det * n * n < 0x1p24) {
        return false;
    }
    const double x = std::floor((xz * yy - yz * xy) / (2 * det) + 0.5),
                 y = std::floor((yz * xx - xz * xy) / (2 * det) + 0.5);
    if (std::max(std::fabs(x), std::fabs(y)) > 1024) {
        return false;
    }
    for (const Taken &t : taken) {
        mean += t.used ? ((t.place.x - x) * (t.place.x - x) + (t.place.y - y) * (t.place.y - y)) / n : 0;
    }
    rim = {static_cast<int>(x), static_cast<int>(y), static_cast<int>(std::sqrt(std::floor(mean + 0.5))), 0};
    return rim.radius > 0;
}

int count_used(const std::array<Taken, RAYS> &taken)
{
    return static_cast<int>(std::count_if(taken.begin(), taken.end(), [](const Taken &t) { return t.used; }));
}

/* The circle that at least nine rays meet, three times with those near it; one that suits no drogue scores nothing. */
Rim circle_through(std::array<Taken, RAYS> taken, const DarkDisc &disc)
{
    Rim rim = {0, 0, 0, 0};
    for (const int tolerance_q8 : {90, 56, 40}) {
        if (count_used(taken) < 9 || !fit(rim, taken)) {
            return {0, 0, 0, 0};
        }
        const double room = 16 + std::floor(rim.radius * tolerance_q8 / 256.0);
        for (Taken &t : taken) {
            const double r = std::hypot(t.place.x - rim.x, t.place.y - rim.y);
            t.used = t.step > 0 && r >= rim.radius - room && r <= rim.radius + room;
        }
    }
    const int count = count_used(taken);
    const double share = rim.radius / static_cast<double>(disc.ring_q4);
    int sum = 0;
    for (const Taken &t : taken) {
        sum += t.used ? std::min(t.step, 64) : 0;
    }
    if (count >= 9 && share >= 1.3 && share <= 2.9 && 2 * (rim.x * rim.x + rim.y * rim.y) <= rim.radius * rim.radius) {
        rim.score = count * count * (sum / count + std::min(disc.contrast, 64));
    }
    return rim;
}

} // namespace

std::vector<Rim> rims_about(const cv::Mat &cells, const DarkDisc &disc)
{
    std::array<Ray, RAYS> rays;
    std::vector<Rim> rims;
    for (int i = 0; i < RAYS; i++) {
        rays[static_cast<size_t>(i)] = read_ray(cells, disc, i);
    }
    for (const int sign : {1, -1}) {
        std::array<Taken, RAYS> before;
        for (const Choice which : {Choice::largest, Choice::outermost, Choice::innermost}) {
            std::array<Taken, RAYS> taken;
            int differ = 0;
            for (size_t i = 0; i < RAYS; i++) {
                taken[i] = take(rays[i], sign, which);
                differ += taken[i].at != before[i].at;
            }
            before = taken;
            const Rim rim = differ >= 3 ? circle_through(taken, disc) : Rim{0, 0, 0, 0};
            if (rim.score > 0) {
                rims.push_back(rim);
            }
        }
    }
    return rims;
}

namespace {

struct Scale {
    int p, q, inner, ring_q4;
};
constexpr Scale SCALES[] = {{2, 1, 1, 36}, {3, 1, 1, 51}, {4, 2, 2, 72}, {5, 2, 2, 86}};

/* By how much the second darkest of eight cells about a place is brighter than its middle; nothing where two of the four
 * that are looked at first are no brighter than the centre by more than the least contrast. */
int contrast_at(const cv::Mat &m, int x, int y, const Scale &s, int least)
{
    const auto cell = [&](int dx, int dy) -> int { return m.at<uint8_t>(y + dy, x + dx); };
    std::array<int, 8> ring = {cell(-s.p, -s.q), cell(s.p, s.q),  cell(s.q, -s.p), cell(-s.q, s.p),
                               cell(-s.q, -s.p), cell(s.p, -s.q), cell(-s.p, s.q), cell(s.q, s.p)};
    if (std::count_if(ring.begin(), ring.begin() + 4, [&](int v) { return v - cell(0, 0) <= least; }) > 1) {
        return 0;
    }
    std::sort(ring.begin(), ring.end());
    const int i = s.inner;
    return ring[1] - (2 * cell(0, 0) + cell(-i, 0) + cell(i, 0) + cell(0, -i) + cell(0, i) + 3) / 6;
}

/* The dark discs of a level that still wait for stronger ones beside them. */
class Waiting {
public:
    void add(const DarkDisc &d)
    {
        const int near = d.ring_q4 / 16;
        for (DarkDisc &w : discs_) {
            if (w.ring_q4 == d.ring_q4 && d.y - w.y <= near && std::abs(d.x - w.x) <= near) {
                w = d.contrast > w.contrast ? d : w;
                return;
            }
        }
        if (discs_.size() < DROGUE_SEARCH_PENDING) {
            discs_.push_back(d);
            return;
        }
        DarkDisc &faintest = *std::min_element(
            discs_.begin(), discs_.end(), [](const DarkDisc &a, const DarkDisc &b) { return a.contrast < b.contrast; });
        faintest = d.contrast > faintest.contrast ? d : faintest;
    }
    /* Those above a row, which wait no longer. */
    std::vector<DarkDisc> above(int y)
    {
        std::vector<DarkDisc> out;
        std::copy_if(discs_.begin(), discs_.end(), std::back_inserter(out), [y](const DarkDisc &d) { return d.y < y; });
        discs_.erase(std::remove_if(discs_.begin(), discs_.end(), [y](const DarkDisc &d) { return d.y < y; }),
                     discs_.end());
        return out;
    }

private:
    std::vector<DarkDisc> discs_;
};

bool same_outline(const Sighting &a, const Sighting &b)
{
    const int larger = std::max(a.radius, b.radius), smaller = std::min(a.radius, b.radius);
    return larger * 5 <= smaller * 6 + 5 && 2 * std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) < larger;
}

/* The best so far; of the same outline the better. */
void keep(std::vector<Sighting> &best, size_t most, const Sighting &s)
{
    const auto same = [&s](const Sighting &other) { return same_outline(other, s); };
    if (std::any_of(best.begin(), best.end(), [&](const Sighting &o) { return same(o) && o.score >= s.score; })) {
        return;
    }
    for (size_t i = best.size(); i-- > 0;) {
        if (same(best[i])) {
            best[i] = best.back();
            best.pop_back();
        }
    }
    if (best.size() < most) {
        best.push_back(s);
        return;
    }
    Sighting &least = *std::min_element(best.begin(), best.end(),
                                        [](const Sighting &a, const Sighting &b) { return a.score < b.score; });
    least = s.score > least.score ? s : least;
}

Sighting sighting_of(const Rim &rim, const DarkDisc &d, int cell_px)
{
    const auto pixels = [cell_px](int q4) { return cvFloor(q4 * cell_px / 16.0); };
    Sighting s = {pixels(16 * d.x + 8 + rim.x), pixels(16 * d.y + 8 + rim.y), pixels(rim.radius), rim.score, {}};
    s.region = frame_of(s.x, s.y, s.radius);
    return s;
}

/* By exchange: the order of equals is the library's. */
void sort(std::vector<Sighting> &best)
{
    for (size_t i = 0; i < best.size(); i++) {
        for (size_t k = i + 1; k < best.size(); k++) {
            if (best[k].score > best[i].score) {
                std::swap(best[i], best[k]);
            }
        }
    }
}

/* The disc by itself: where grey is half way up on each ray, of twelve rays that end together the median. */
Rim disc_itself(const cv::Mat &cells, const DarkDisc &disc)
{
    const int centre = cells.at<uint8_t>(disc.y, disc.x), half = centre + 1 + disc.contrast / 2;
    std::vector<int> ends;
    for (int i = 0; i < RAYS; i++) {
        const double angle = i * CV_PI / 8;
        const int dx = cvRound(256 * std::cos(angle)), dy = cvRound(256 * std::sin(angle));
        int before = centre;
        for (int t = 1; 8 * t <= disc.ring_q4; t++) {
            const cv::Point p(disc.x + cvFloor((dx * t + 128) / 256.0), disc.y + cvFloor((dy * t + 128) / 256.0));
            if (!p.inside({0, 0, cells.cols, cells.rows})) {
                break;
            }
            const int here = cells.at<uint8_t>(p);
            if (here >= half) {
                ends.push_back(16 * t - cvFloor(16.0 * (here - half) / (here - before)));
                break;
            }
            before = here;
        }
    }
    std::sort(ends.begin(), ends.end());
    const int median = ends.empty() ? 0 : ends[ends.size() / 2];
    const auto together =
        std::count_if(ends.begin(), ends.end(), [median](int r) { return std::abs(r - median) <= median / 4.0 + 4; });
    const int share = cvFloor(256.0 * disc.contrast / (centre + disc.contrast + 8));
    return {0, 0, median, together < 12 ? 0 : share * together * together};
}

} // namespace

cv::Rect frame_of(int x, int y, int radius)
{
    const int side = std::min(cvFloor((radius + (radius < 10)) * 21 / 8.0), DROGUE_MAX_SIDE);
    return {x - side / 2, y - side / 2, side, side};
}

Sightings sightings_in(const cv::Mat &image, int min_contrast)
{
    std::vector<cv::Mat> levels;
    std::vector<std::tuple<int64_t, int, int>> rows; /* when a level's row is looked at: image row, level, row */
    cv::Mat above = image;
    for (int k = 0; k < DROGUE_SEARCH_LEVELS; k++) {
        cv::Mat level(above.rows / 2, above.cols / 2, CV_8U);
        for (int y = 0; y < level.rows; y++) {
            for (int x = 0; x < level.cols; x++) {
                level.at<uint8_t>(y, x) = static_cast<uint8_t>(
                    (above.at<uint8_t>(2 * y, 2 * x) + above.at<uint8_t>(2 * y, 2 * x + 1) +
                     above.at<uint8_t>(2 * y + 1, 2 * x) + above.at<uint8_t>(2 * y + 1, 2 * x + 1) + 2) /
                    4);
            }
            const bool reach = y + DROGUE_SEARCH_REACH < level.rows;
            rows.emplace_back(reach ? static_cast<int64_t>(y + DROGUE_SEARCH_REACH + 1) << (k + 1) : INT32_MAX, k, y);
        }
        rows.emplace_back(INT32_MAX, k, INT32_MAX); /* the level's end */
        levels.push_back(level);
        above = level;
    }
    std::sort(rows.begin(), rows.end());
    std::array<Waiting, DROGUE_SEARCH_LEVELS> waiting;
    Sightings found;
    for (const auto &[when, k, y] : rows) {
        const cv::Mat &m = levels[static_cast<size_t>(k)];
        Waiting &w = waiting[static_cast<size_t>(k)];
        for (const Scale &s : SCALES) {
            if ((&s == SCALES && k > 0) || y == INT32_MAX || y < s.p || y + s.p >= m.rows) {
                continue;
            }
            for (int x = s.p; x + s.p < m.cols; x++) {
                const int contrast = contrast_at(m, x, y, s, min_contrast);
                if (contrast > min_contrast) {
                    w.add({x, y, s.ring_q4, contrast});
                }
            }
        }
        for (const DarkDisc &d : w.above(y == INT32_MAX ? INT32_MAX : y - 5)) {
            const Rim itself = disc_itself(m, d);
            if (itself.score > 0) {
                keep(found.dark, DROGUE_SEARCH_DARK, sighting_of(itself, d, 2 << k));
            }
            for (const Rim &rim : rims_about(m, d)) {
                keep(found.best, DROGUE_SEARCH_MAX, sighting_of(rim, d, 2 << k));
            }
        }
    }
    sort(found.best);
    sort(found.dark);
    return found;
}

} // namespace mirror
