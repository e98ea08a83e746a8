/* SPDX-License-Identifier: Apache-2.0 */
/* Support of an ellipse by edge points: membership, polarity and bins against double where the limits are not nearer than
 * the library resolves; sums from the same members. */
#include "geometry.h"
#include "golden.hpp"
#include "reference.hpp"

#include "../band_points.h"

namespace {

struct Scene {
    ellipse_real oval;
    drogue_ellipse ellipse;
    std::vector<drogue_edge> edges;
    drogue_band band;
    reference::Band model_band;
    drogue_polarity polarity;
};

/* A noisy outline whose polarity changes now and then, and edge points of any place and direction. */
Scene random_scene(int seed)
{
    std::uint64_t rng = 0x50F0u + (std::uint64_t)seed;
    Scene s;
    s.oval.a = rng_real(&rng, 8, seed % 5 == 0 ? 600 : 120);
    s.oval.b = s.oval.a * rng_real(&rng, 0.41, 1);
    s.oval.xc = s.oval.a + rng_real(&rng, 5, 60);
    s.oval.yc = s.oval.a + rng_real(&rng, 5, 60);
    s.oval.angle = rng_real(&rng, -1.57, 1.57);
    s.ellipse = ellipse_to_q16(&s.oval);
    const double noise = rng_real(&rng, 0.05, 1.5);
    const int count = (int)(6 * s.oval.a);
    double sign = 1;
    for (int i = 0; i < count; i++) {
        double x, y;
        ellipse_real own = s.oval;
        own.a += noise * rng_normal(&rng);
        own.b += own.a - s.oval.a;
        const double t = 2 * TEST_PI * i / count;
        ellipse_point(&x, &y, &own, t);
        sign = rng_range(&rng, 0, count / 4) == 0 ? -sign : sign;
        const double c = std::cos(s.oval.angle), d = std::sin(s.oval.angle), u = std::cos(t) / s.oval.a,
                     v = std::sin(t) / s.oval.b, n = std::hypot(u, v), turn = rng_real(&rng, -0.7, 0.7);
        double nx = (c * u - d * v) / n * sign, ny = (d * u + c * v) / n * sign;
        if (i % 9 == 0) {
            x = rng_real(&rng, 0, 2 * s.oval.xc);
            y = rng_real(&rng, 0, 2 * s.oval.yc);
        }
        const double strength = rng_real(&rng, 20, 700);
        drogue_edge e = {DROGUE_NO_ARC, (std::uint16_t)std::lround(32 * x), (std::uint16_t)std::lround(32 * y),
                         (std::int16_t)std::lround(strength * (nx * std::cos(turn) - ny * std::sin(turn))),
                         (std::int16_t)std::lround(strength * (nx * std::sin(turn) + ny * std::cos(turn)))};
        s.edges.push_back(e);
    }
    const drogue_q16 width = rng_range(&rng, 3000, 8 * 65536), cosine = rng_range(&rng, 0, 65536);
    s.band = drogue_band_of(width, cosine);
    s.model_band = {real_of_q16(width), real_of_q16(cosine)};
    s.polarity = (drogue_polarity)(seed % 3);
    return s;
}

reference::Ellipse reference_ellipse(const drogue_ellipse &q)
{
    return {real_of_q16(q.xc_px_q16), real_of_q16(q.yc_px_q16), real_of_q16(q.a_px_q16), real_of_q16(q.b_px_q16),
            real_of_q16(q.angle_rad_q16)};
}

} // namespace

int main()
{
    Report held("band_member", 0), bins("bin", 0), covered("covered", 0), bright("bright_bins", 0), sums("bin_sum", 1);
    long undecided = 0, decided = 0;
    for (int seed = 1; seed <= 400; seed++) {
        const std::string name = name_of("seed", seed);
        const Scene s = random_scene(seed);
        const reference::Ellipse e = reference_ellipse(s.ellipse);
        drogue_ellipse_frame frame;
        drogue_support got;
        reference::Support model;
        std::vector<reference::BandPoint> points;
        double wrong = 0, misplaced = 0;
        if (drogue_ellipse_frame_of(&frame, &s.ellipse) != DROGUE_OK) {
            held.add(INFINITY, name);
            continue;
        }
        support_count(&got, &frame, &s.band, s.edges.data(), (std::uint32_t)s.edges.size(), 1);
        for (const drogue_edge &q : s.edges) {
            const reference::Edge edge = {
                {q.x_q5 / 32.0L, q.y_q5 / 32.0L}, (reference::Real)q.gx, (reference::Real)q.gy};
            band_point p;
            reference::BandPoint m = reference::band_point(e, s.model_band, edge);
            const bool own = point_holds(&p, &frame, &s.band, &q) != 0;
            const bool open = m.undecided(3e-4L * s.model_band.width + 1e-4L, 3e-4L);
            undecided += open;
            decided += !open;
            wrong += !open && own != m.held;
            m.held = own;
            if (own) {
                const int bin = (int)point_bin(&p);
                misplaced += m.from_next_bin > e.a / e.b / 8192 && (bin != m.bin || (int)p.polarity != m.polarity);
                m.bin = bin;
                reference::support_add(model, m, edge);
            }
            points.push_back(m);
        }
        held.add(wrong, name);
        bins.add(misplaced, name);
        drogue_support_judge(&got, &s.ellipse, s.polarity, 1);
        reference::support_judge(model, e, s.polarity, 1);
        covered.add(std::fabs((double)got.covered - model.covered), name);
        bright.add(got.bright_bins == model.bright ? 0 : 1, name);
        /* the mean of a bin's offsets: each is rounded to an LSB */
        drogue_support added = {};
        reference::Support expected;
        added.bright_bins = expected.bright = model.bright;
        for (std::size_t i = 0; i < points.size(); i++) {
            band_point p;
            const drogue_edge &q = s.edges[i];
            if (point_holds(&p, &frame, &s.band, &q)) {
                point_add(&added, &p, &q);
                reference::support_add(expected, points[i], {{0, 0}, (reference::Real)q.gx, (reference::Real)q.gy});
            }
        }
        double most = added.points == (std::uint32_t)expected.points ? 0 : INFINITY;
        for (std::size_t k = 0; k < DROGUE_SUPPORT_BINS; k++) {
            const int n = expected.count[k][expected.bright >> k & 1];
            if (n > 0) {
                most = std::max(most, lsb_from(added.bin[k].sum_q16, expected.sum[k]) / n);
            }
        }
        sums.add(most, name);
    }
    std::printf("band_member: %ld of %ld points nearer to a limit than the library resolves\n", undecided,
                undecided + decided);
    const bool ok[] = {held.finish(400),   bins.finish(400), covered.finish(400),
                       bright.finish(400), sums.finish(400), undecided * 100 < decided};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
