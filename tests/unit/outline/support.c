/* SPDX-License-Identifier: Apache-2.0 */
/* Support of an ellipse: bins against atan2, counts and sums against double precision, polarity and cover of outlines of
 * every mixture. */
#include "suite.h"

#include "../../band_points.h"
#include "geometry.h"

enum { MOST = 16384 };

static drogue_edge edges[MOST];

static int32_t q14_of(double v) { return (int32_t)floor(v * 16384 + 0.5); }

START_TEST(bins_of_random_directions)
{
    uint64_t rng = 1;
    int i;
    for (i = 0; i < 500000; i++) {
        double t = rng_real(&rng, 0, 2 * TEST_PI), r = rng_real(&rng, 0.5, 1.42), bin = t * 16 / TEST_PI;
        int32_t u = q14_of(r * cos(t)), v = q14_of(r * sin(t));
        if (fabs(bin - floor(bin + 0.5)) > 1e-3) { /* components are Q14 */
            MUST(bin_of(u, v) == (uint32_t)bin, "direction %g is in bin %u", t, (unsigned)bin_of(u, v));
        }
    }
}
END_TEST

START_TEST(bins_of_axes_and_diagonals)
{
    static const int32_t at[][3] = {{1, 0, 0},   {1, 1, 4},    {0, 1, 7},   {-1, 1, 11},
                                    {-1, 0, 15}, {-1, -1, 20}, {0, -1, 24}, {1, -1, 27}};
    size_t i;
    int scale;
    for (i = 0; i < sizeof at / sizeof at[0]; i++) {
        for (scale = 0; scale <= 14; scale += 7) {
            uint32_t bin = bin_of(at[i][0] * (1 << scale), at[i][1] * (1 << scale));
            int apart = abs((int)bin - at[i][2]);
            /* on a border either neighbour is right, the same for every size */
            ck_assert(apart <= 1 || apart == 31);
            ck_assert_uint_eq(bin, bin_of(at[i][0], at[i][1]));
        }
    }
    ck_assert_uint_eq(bin_of(1 << 14, 1), 0);
    ck_assert_uint_eq(bin_of(1 << 14, -1), 31);
    ck_assert_uint_eq(bin_of(-(1 << 14), 1), 15);
    ck_assert_uint_eq(bin_of(-(1 << 14), -1), 16);
}
END_TEST

/* Every bin is reached from as wide an angle as any other. */
START_TEST(bins_are_alike)
{
    uint32_t count[DROGUE_SUPPORT_BINS] = {0}, k;
    int i;
    for (i = 0; i < 320000; i++) {
        double t = 2 * TEST_PI * (i + 0.5) / 320000;
        count[bin_of(q14_of(cos(t)), q14_of(sin(t)))]++;
    }
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        MUST(count[k] >= 9990 && count[k] <= 10010, "bin %u holds %u of 10000", (unsigned)k, (unsigned)count[k]);
    }
}
END_TEST

static ellipse_real random_ellipse(uint64_t *rng)
{
    ellipse_real e;
    e.a = exp(rng_real(rng, log(15.0), log(600.0)));
    e.b = e.a * rng_real(rng, 0.4, 1);
    e.xc = rng_real(rng, e.a + 20, 2027 - e.a);
    e.yc = rng_real(rng, e.a + 20, 2027 - e.a);
    e.angle = rng_real(rng, -1.57, 1.57);
    return e;
}

/* Edge points off an ellipse, in part of it, with gradients turned off its normal; the first 'bright' radians of the
 * eccentric angle from 'from' on are brighter inside. */
static uint32_t put_edges(const ellipse_real *e, double from, double span, double bright, double spread_px,
                          double spread_rad, double density, uint64_t *rng)
{
    const double length = TEST_PI * (1.5 * (e->a + e->b) - sqrt(e->a * e->b));
    uint32_t count = (uint32_t)(density * length * span / (2 * TEST_PI)), i;
    count = count < MOST ? count : MOST;
    for (i = 0; i < count; i++) {
        double t = from + span * (i + 0.5) / count, x, y, nx, ny, n, off = spread_px * rng_real(rng, -1, 1),
               turn = spread_rad * rng_real(rng, -1, 1), strength = rng_real(rng, 100, 900);
        ellipse_point(&x, &y, e, t);
        nx = cos(t) / e->a * cos(e->angle) - sin(t) / e->b * sin(e->angle);
        ny = cos(t) / e->a * sin(e->angle) + sin(t) / e->b * cos(e->angle);
        n = hypot(nx, ny);
        edges[i].x_q5 = (uint16_t)floor(32 * (x + off * nx / n) + 0.5);
        edges[i].y_q5 = (uint16_t)floor(32 * (y + off * ny / n) + 0.5);
        strength *= t - from < bright ? -1 : 1;
        edges[i].gx = (int16_t)floor(strength * (nx * cos(turn) - ny * sin(turn)) / n + 0.5);
        edges[i].gy = (int16_t)floor(strength * (nx * sin(turn) + ny * cos(turn)) / n + 0.5);
    }
    return count;
}

typedef struct tally {
    double count[DROGUE_SUPPORT_BINS][2], doubtful[DROGUE_SUPPORT_BINS][2]; /* a doubtful point may be here or not */
} tally;

/* Brute force: every point in double precision. Points on a border of band, angle or bin are doubtful where they might
 * go. */
static void count_all(tally *out, const ellipse_real *e, double width, double cosine, uint32_t count, uint32_t stride)
{
    uint32_t i;
    memset(out, 0, sizeof *out);
    for (i = 0; i < count; i += stride) {
        double dx = edges[i].x_q5 / 32.0 - e->xc, dy = edges[i].y_q5 / 32.0 - e->yc;
        double u = (dx * cos(e->angle) + dy * sin(e->angle)) / e->a,
               v = (dy * cos(e->angle) - dx * sin(e->angle)) / e->b;
        double nx = u / e->a * cos(e->angle) - v / e->b * sin(e->angle),
               ny = u / e->a * sin(e->angle) + v / e->b * cos(e->angle), n = hypot(nx, ny);
        double distance = fabs(u * u + v * v - 1) / (2 * n),
               c = (nx * edges[i].gx + ny * edges[i].gy) / n / hypot(edges[i].gx, edges[i].gy);
        double bin = fmod(atan2(v, u) * 16 / TEST_PI + 32, 32);
        int at = (int)bin, neighbour = (int)(bin + (bin - at > 0.5 ? 1e-3 : -1e-3) + 32) % 32, p = c < 0;
        int sure = distance < 0.99 * width && fabs(c) > cosine + 0.004;
        if (distance > 1.01 * width || fabs(c) < cosine - 0.004) {
            continue;
        }
        out->count[at][p] += sure && neighbour == at;
        if (!sure || neighbour != at) {
            out->doubtful[at][p]++;
            out->doubtful[neighbour][p] += neighbour != at;
        }
    }
}

START_TEST(counts_against_brute_force)
{
    uint64_t rng = 2;
    int i, k, p;
    double total = 0, doubtful = 0;
    for (i = 0; i < 400; i++) {
        const ellipse_real truth = random_ellipse(&rng);
        const drogue_ellipse q = ellipse_to_q16(&truth);
        const ellipse_real e = ellipse_from_q16(&q);
        const double width = rng_real(&rng, 0.5, fmin(8, 0.1 * e.b)), cosine = rng_real(&rng, 0.3, 0.95);
        const drogue_band band = drogue_band_of(q16_of(width), q16_of(cosine));
        const uint32_t stride = (uint32_t)rng_range(&rng, 1, 4);
        uint32_t count = put_edges(&e, rng_real(&rng, 0, 6), rng_real(&rng, 1, 6.28), rng_real(&rng, 0, 6.28),
                                   2 * width, 1.5, 2, &rng);
        drogue_ellipse_frame frame;
        drogue_support got;
        tally model;
        ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
        memset(&got, 0x5A, sizeof got);
        support_count(&got, &frame, &band, edges, count, stride);
        count_all(&model, &e, width, cosine, count, stride);
        for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
            for (p = 0; p < 2; p++) {
                MUST(got.bin[k].count[p] >= model.count[k][p] &&
                         got.bin[k].count[p] <= model.count[k][p] + model.doubtful[k][p],
                     "case %d, bin %d: %u counted, %g to %g there", i, k, (unsigned)got.bin[k].count[p],
                     model.count[k][p], model.count[k][p] + model.doubtful[k][p]);
                total += model.count[k][p];
                doubtful += model.doubtful[k][p];
            }
            ck_assert_int_eq(got.bin[k].sum_q16, 0);
        }
        ck_assert(got.squares_q32 == 0 && got.gradient == 0 && got.points == 0 && got.covered == 0);
    }
    MUST(total > 50000, "%g points that are sure", total);
    ck_assert(doubtful < 0.1 * total);
}
END_TEST

/* Judge the outline put into 'edges'. */
static drogue_support judged(const ellipse_real *e, uint32_t count, drogue_polarity polarity, uint32_t stride)
{
    const drogue_ellipse q = ellipse_to_q16(e);
    const drogue_band band = drogue_band_of(q16_of(1.5), q16_of(0.87));
    drogue_ellipse_frame frame;
    drogue_support s;
    ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
    support_count(&s, &frame, &band, edges, count, stride);
    drogue_support_judge(&s, &q, polarity, stride);
    return s;
}

START_TEST(outlines_of_one_polarity)
{
    uint64_t rng = 3;
    int i, p;
    for (i = 0; i < 300; i++) {
        const ellipse_real e = random_ellipse(&rng);
        const int bright = i & 1;
        const uint32_t count = put_edges(&e, 0, 2 * TEST_PI, bright ? 7 : 0, 0.5, 0.3, 0.9, &rng);
        for (p = 0; p <= DROGUE_POLARITY_BOTH; p++) {
            const drogue_support s = judged(&e, count, (drogue_polarity)p, count / 512 + 1);
            const int fits = p == DROGUE_POLARITY_BOTH || p == bright;
            MUST(s.covered == (fits ? 32 : 0), "case %d, polarity %d: %u covered", i, p, (unsigned)s.covered);
            MUST(drogue_support_cover(&s) == (fits ? 65536 : 0), "case %d, polarity %d: cover", i, p);
            MUST(!fits || s.bright_bins == (bright ? UINT32_MAX : 0), "case %d, polarity %d: bins", i, p);
            MUST(fits || s.bright_bins == (p ? UINT32_MAX : 0), "case %d, polarity %d: bins as asked", i, p);
        }
    }
}
END_TEST

START_TEST(parts_that_show)
{
    uint64_t rng = 7;
    int i;
    for (i = 0; i < 300; i++) {
        const ellipse_real e = random_ellipse(&rng);
        const drogue_ellipse q = ellipse_to_q16(&e);
        const int first = (int)rng_real(&rng, 0, 8), parts = (int)rng_real(&rng, 1, 9), bright = i & 1;
        const uint32_t count =
            put_edges(&e, first * TEST_PI / 4, parts * TEST_PI / 4, bright ? 7 : 0, 0.3, 0.2, 0.9, &rng);
        const drogue_support s = judged(&e, count, DROGUE_POLARITY_BOTH, 1);
        const drogue_support other = judged(&e, count, bright ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT, 1);
        MUST(drogue_support_parts(&s, &q) == (uint32_t)parts, "case %d: %u parts of %d", i,
             (unsigned)drogue_support_parts(&s, &q), parts);
        MUST(drogue_support_parts(&other, &q) == 0, "case %d: parts of the other polarity", i);
    }
    for (i = 0; i < 32; i++) { /* one bin shows its part */
        const ellipse_real e = random_ellipse(&rng);
        const drogue_ellipse q = ellipse_to_q16(&e);
        const uint32_t count = put_edges(&e, i * TEST_PI / 16, TEST_PI / 16, 0, 0.3, 0.2, 0.9, &rng);
        const drogue_support s = judged(&e, count, DROGUE_POLARITY_DARK, 1);
        MUST(drogue_support_parts(&s, &q) == 1, "bin %d: %u parts", i, (unsigned)drogue_support_parts(&s, &q));
    }
}
END_TEST

START_TEST(outlines_of_two_halves)
{
    uint64_t rng = 4;
    int i, k;
    for (i = 0; i < 300; i++) {
        const ellipse_real e = random_ellipse(&rng);
        const double from = rng_real(&rng, 0, 6.28), part = rng_real(&rng, 0.2, 0.8);
        const uint32_t count = put_edges(&e, from, 2 * TEST_PI, 2 * TEST_PI * part, 0.5, 0.3, 0.9, &rng);
        const drogue_support s = judged(&e, count, DROGUE_POLARITY_BOTH, 1);
        int bright = 0;
        for (k = 0; k < 32; k++) {
            const double middle = fmod(2 * TEST_PI * (k + 0.5) / 32 - from + 4 * TEST_PI, 2 * TEST_PI);
            const int inside = middle < 2 * TEST_PI * part;
            const double border = fmin(fabs(middle - 2 * TEST_PI * part), fmin(middle, 2 * TEST_PI - middle));
            bright += (int)((s.bright_bins >> k) & 1u);
            MUST(border < TEST_PI / 32 || (int)((s.bright_bins >> k) & 1u) == inside, "case %d: bin %d", i, k);
        }
        /* the bins of the changes are split, but for small ones one part is enough */
        MUST(s.covered == 30 || (s.covered == 29 && e.b < 40), "case %d: %u covered, not 32 less two changes", i,
             (unsigned)s.covered);
        MUST(fabs(bright - 32 * part) <= 1.5, "case %d: %d bright bins of %g", i, bright, 32 * part);
        MUST(fabs(judged(&e, count, DROGUE_POLARITY_BRIGHT, 1).covered - 32 * part) < 1.7 &&
                 fabs(judged(&e, count, DROGUE_POLARITY_DARK, 1).covered - 32 * (1 - part)) < 1.7,
             "case %d: covered with the polarity given", i);
    }
}
END_TEST

/* Bins whose polarity is a coin's are clutter: each change costs what it gains, and one polarity is as good. */
START_TEST(random_polarity_is_penalised)
{
    uint64_t rng = 5;
    int i, k, most = 0;
    for (i = 0; i < 2000; i++) {
        const drogue_ellipse e = {0, 0, 100 * 65536, 80 * 65536, 0};
        drogue_support s;
        int changes = 0, dark = 0, first = 0, last = 0;
        memset(&s, 0, sizeof s);
        for (k = 0; k < 32; k++) {
            const int p = rng_range(&rng, 0, 1);
            s.bin[k].count[p] = 20;
            dark += !p;
            changes += k > 0 && p != last;
            first = k == 0 ? p : first;
            last = p;
        }
        changes += first != last;
        drogue_support_judge(&s, &e, DROGUE_POLARITY_BOTH, 1);
        k = dark > 16 ? dark : 32 - dark;
        MUST((int)s.covered == (32 - changes > k ? 32 - changes : k), "case %d: %u covered, %d changes, %d of one", i,
             (unsigned)s.covered, changes, k);
        most = (int)s.covered > most ? (int)s.covered : most;
    }
    ck_assert_int_lt(most, 29);
}
END_TEST

START_TEST(partial_outlines)
{
    uint64_t rng = 6;
    int i;
    for (i = 0; i < 500; i++) {
        const ellipse_real e = random_ellipse(&rng);
        const double span = rng_real(&rng, 0, 6.28);
        const uint32_t count = put_edges(&e, rng_real(&rng, 0, 6), span, 0, 0.5, 0.3, 0.9, &rng);
        const drogue_support s = judged(&e, count, DROGUE_POLARITY_BOTH, 1);
        /* 0.35 of about 0.9 points a pixel: a bin counts from 0.3 to 0.5 of its length on, shorter ones are coarser */
        MUST(fabs(s.covered - 32 * span / (2 * TEST_PI)) <= (e.b < 40 ? 2.0 : 1.5), "case %d: %u covered of %g", i,
             (unsigned)s.covered, 32 * span / (2 * TEST_PI));
    }
}
END_TEST

/* A bin needs 0.35 points a pixel. */
START_TEST(thin_outlines_cover_nothing)
{
    const drogue_ellipse circle = {0, 0, 163 * 65536, 163 * 65536, 0}; /* a bin is 32.0 px long */
    drogue_support s;
    uint32_t n, stride;
    int k;
    for (stride = 1; stride <= 3; stride++) {
        for (n = 0; n < 20; n++) {
            memset(&s, 0, sizeof s);
            for (k = 0; k < 32; k++) {
                s.bin[k].count[1] = n;
            }
            drogue_support_judge(&s, &circle, DROGUE_POLARITY_BOTH, stride);
            ck_assert_uint_eq(s.covered, n * stride > 11 ? 32 : 0);
        }
    }
}
END_TEST

/* Sums over the points whose polarity is their bin's, against double; the others are counted and refused. */
START_TEST(sums)
{
    uint64_t rng = 7;
    int i, refused = 0;
    for (i = 0; i < 100; i++) {
        const ellipse_real truth = random_ellipse(&rng);
        const drogue_ellipse q = ellipse_to_q16(&truth);
        const ellipse_real e = ellipse_from_q16(&q);
        const uint32_t count = put_edges(&e, 0, 2 * TEST_PI, 7 * rng_real(&rng, 0, 1), 1, 0.3, 1, &rng);
        const drogue_band band = drogue_band_of(q16_of(1.5), q16_of(0.87));
        const uint32_t bright_bins = (uint32_t)rng_u64(&rng);
        drogue_ellipse_frame frame;
        drogue_support s, counted;
        double sum[32] = {0}, squares = 0, gradient = 0;
        uint32_t points = 0, j;
        int k;
        ck_assert_int_eq(drogue_ellipse_frame_of(&frame, &q), DROGUE_OK);
        support_count(&counted, &frame, &band, edges, count, 1);
        memset(&s, 0, sizeof s);
        s.bright_bins = bright_bins;
        for (j = 0; j < count; j++) {
            band_point p;
            double offset;
            uint32_t bin;
            int own;
            if (!point_holds(&p, &frame, &band, &edges[j])) {
                continue;
            }
            bin = point_bin(&p);
            own = ((bright_bins >> bin) & 1u) == (uint32_t)p.polarity;
            MUST(point_add(&s, &p, &edges[j]) == own, "case %d, point %u", i, (unsigned)j);
            if (own) {
                offset = p.offset_q16;
                sum[bin] += offset;
                squares += offset * offset;
                gradient += abs(edges[j].gx) + abs(edges[j].gy);
                points++;
            }
            refused += !own;
        }
        for (k = 0; k < 32; k++) {
            MUST(fabs(s.bin[k].sum_q16 - sum[k]) <= 0.6 * (counted.bin[k].count[0] + counted.bin[k].count[1]),
                 "case %d: sum of bin %d", i, k);
            MUST(memcmp(s.bin[k].count, counted.bin[k].count, sizeof s.bin[k].count) == 0, "case %d: counts", i);
        }
        MUST(fabs((double)s.squares_q32 - squares) <= 2 * sqrt(squares * points) + points, "case %d: squares", i);
        MUST((double)s.gradient == gradient && s.points == points && s.bright_bins == bright_bins, "case %d: totals",
             i);
    }
    ck_assert_int_gt(refused, 1000);
}
END_TEST

/* The harmonics of a bin's middle: 1, cos, sin, cos of twice and sin of twice its angle. */
START_TEST(basis_of_every_bin)
{
    uint32_t k;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const double t = 2 * TEST_PI * (k + 0.5) / DROGUE_SUPPORT_BINS;
        const double want[5] = {1, cos(t), sin(t), cos(2 * t), sin(2 * t)};
        int32_t basis_q30[5];
        int i;
        drogue_support_basis(basis_q30, k);
        for (i = 0; i < 5; i++) {
            MUST(fabs((double)basis_q30[i] - ldexp(want[i], 30)) <= 3, "bin %u, harmonic %d: %lld", (unsigned)k, i,
                 (long long)basis_q30[i]);
        }
    }
}
END_TEST

/* From any axis to any other one: each bin stays where it is in the picture, to a whole bin. */
START_TEST(turned_to_another_axis)
{
    uint64_t rng = 11;
    int i;
    uint32_t k;
    for (i = 0; i < 2000; i++) {
        const double from = rng_real(&rng, -TEST_PI / 2, TEST_PI / 2), to = rng_real(&rng, -TEST_PI / 2, TEST_PI / 2);
        const double off = (to - from) * 16 / TEST_PI;
        const int32_t whole = (int32_t)lround(off);
        drogue_support before, after;
        memset(&before, 0, sizeof before);
        for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
            before.bin[k].count[0] = k;
            before.bin[k].sum_q16 = -(int32_t)k;
        }
        before.bright_bins = (uint32_t)rng_u64(&rng);
        before.axis_rad_q16 = q16_of(from);
        after = before;
        drogue_support_turn(&after, q16_of(to));
        ck_assert_int_eq(after.axis_rad_q16, q16_of(to));
        if (fabs(fabs(off - whole) - 0.5) < 0.001) {
            continue; /* halfway between two bins */
        }
        for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
            const uint32_t was = (k + (uint32_t)whole) % DROGUE_SUPPORT_BINS;
            MUST(after.bin[k].count[0] == was && after.bin[k].sum_q16 == -(int32_t)was &&
                     (after.bright_bins >> k & 1u) == (before.bright_bins >> was & 1u),
                 "%g to %g: bin %u", from, to, (unsigned)k);
        }
    }
}
END_TEST

SUITE_MAIN("support", bins_of_random_directions, bins_of_axes_and_diagonals, bins_are_alike, counts_against_brute_force,
           outlines_of_one_polarity, parts_that_show, outlines_of_two_halves, random_polarity_is_penalised,
           partial_outlines, thin_outlines_cover_nothing, sums, basis_of_every_bin, turned_to_another_axis)
