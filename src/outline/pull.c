/* SPDX-License-Identifier: Apache-2.0 */
/* What lies beside the outline, and what it does to it.
 *
 * Shading that runs up to the outline, or another edge nearby as that of a narrow wall, moves the place where the grey
 * changes fastest, the farther the more blur there is. So the edge is looked for at two blurs along rays: as the front
 * end sees it, and sharpened. It goes from the one towards the other. Where grey levels are encoded, the sharpened edge
 * is that of the light. */
#include "collection.h"

#include <string.h>

#include "slopes.h"

#define GROUPS DROGUE_EDGE_GROUPS
#define GROUP (DROGUE_RAYS / GROUPS)        /* rays taken together */
#define BINS (DROGUE_SUPPORT_BINS / GROUPS) /* of a support beside them */

#define HALF_TURN (DROGUE_SUPPORT_BINS / 2) /* bins */

#define MIDDLE DROGUE_SLOPE_MIDDLE
#define SLOPES DROGUE_SLOPES
#define NEAR DROGUE_SLOPE_NEAR
#define HALF DROGUE_Q16(1, 2) /* px between slopes */
#define ONE_Q20 (1 << 20)
#define FAR (12 * (ONE_Q20 / 5))   /* slopes: so far from there, 1.2 px, lies the sharpened one */
#define OUTSIDE (MIDDLE + 5)       /* slopes from there on are of what is behind the drogue */
#define OUTSIDES 4                 /* of them, whose differences show noise */
#define NOISY_Q24 (1 << 26)        /* px: more noise is not told apart */
#define LEAST_Q24 (8 << 16)        /* px: what the pixels' grid makes of any edge */
#define TWO_SETS DROGUE_Q16(24, 1) /* px: of a larger outline twice as many rays are read */
#define TAPS 7
#define SMEARED_Q32 (1u << 30) /* px^4: square of a smear of half a px^2; of less an edge has a steepest place */
#define MOST_Q24 (1 << 21)     /* semi-axes, of a harmonic */

/* As the front end blurs: variance 1.33 px^2, 1 of its smoothing and 1/3 of Sobel's operator. */
static int32_t blurred(const int32_t slope[SLOPES], int32_t i)
{
    static const int32_t tap_q7[TAPS] = {117, 88, 55, 28, 12, 4, 1};
    int32_t sum = slope[i] * 128;
    int32_t k;
    for (k = 0; k < TAPS; k++) {
        sum += tap_q7[k] * (slope[i - 1 - k] + slope[i + 1 + k]);
    }
    return sum;
}

static void see(int32_t seen[SLOPES], const int32_t slope[SLOPES])
{
    int32_t i;
    seen[0] = 0; /* what a peak is to be higher than */
    for (i = DROGUE_SLOPE_FIRST; i <= DROGUE_SLOPE_LAST; i++) {
        seen[i] = blurred(slope, i);
    }
}

/* Less a quarter of the second difference, times 4: what blur of half a pixel took. */
static int32_t sharpened(const int32_t slope[SLOPES], int32_t i) { return 6 * slope[i] - slope[i - 2] - slope[i + 2]; }

/* The highest peak of a curve within [from, to]; 0 when there is none. */
static int32_t find_peak(const int32_t curve[SLOPES], int32_t from, int32_t to)
{
    int32_t best = 0;
    int32_t i;
    for (i = from; i <= to; i++) {
        if (curve[i] > curve[best] && curve[i] > curve[i - 1] && curve[i] >= curve[i + 1]) {
            best = i;
        }
    }
    return best;
}

/* The vertex of the parabola through a peak and the values so many slopes from it, Q20; there is one. */
static int32_t vertex_q20(const int32_t curve[SLOPES], int32_t at, int32_t apart)
{
    const int32_t before = curve[at - apart];
    const int32_t after = curve[at + apart];
    const int64_t bend = 2 * (int64_t)curve[at] - before - after; /* > 0 */
    return at * ONE_Q20 + (int32_t)drogue_div_round_s64(((int64_t)after - before) * (apart * (ONE_Q20 / 2)), bend);
}

/* Where the front end sees a peak that is at 'at_q20': by gradients a pixel to either side, or along diagonals 1.4 of
 * them, which where a peak is skew is a quarter farther. */
static int32_t as_seen_q20(const int32_t seen[SLOPES], int32_t best, int32_t at_q20)
{
    int32_t wide_q20;
    if (seen[best] <= seen[best - 2] || seen[best] < seen[best + 2]) {
        return at_q20;
    }
    wide_q20 = vertex_q20(seen, best, 2);
    return wide_q20 + (wide_q20 - at_q20) / 4;
}

/* Standard deviation by noise of a sharpened peak's place, px Q24, from how sharp it is and how slopes differ outside:
 * three times the variance of white noise, since most outlines are moved by less than noise would. */
static int32_t noise_q24(const int32_t slope[SLOPES], int32_t bend)
{
    uint64_t squares = 0;
    int64_t noise;
    int half;
    int32_t i;
    for (i = OUTSIDE; i < OUTSIDE + OUTSIDES; i++) {
        squares += drogue_square_sum(slope[i + 2] - slope[i], 0);
    }
    half = drogue_clz_u64(squares | 1u) / 2; /* the root to 32 bits, below 2^21 before */
    noise = drogue_isqrt_u64(squares << (2 * half)) * (INT64_C(25) << 20);
    noise = drogue_div_round_s64(noise, (int64_t)bend << half);
    return noise < NOISY_Q24 ? (int32_t)noise : NOISY_Q24;
}

/* An edge as the front end sees it, in slopes Q20. */
typedef struct seen_edge {
    int32_t at_q20;   /* its steepest place; 0: there is none */
    int32_t seen_q20; /* where the front end finds that */
} seen_edge;

static seen_edge find_seen(const int32_t seen[SLOPES])
{
    const int32_t best = find_peak(seen, MIDDLE - NEAR, MIDDLE + NEAR);
    seen_edge edge = {0, 0};
    if (best > 0) {
        edge.at_q20 = vertex_q20(seen, best, 1);
        edge.seen_q20 = as_seen_q20(seen, best, edge.at_q20);
    }
    return edge;
}

/* How far outwards of the sharpened edge the blurred one lies, in slopes Q20; 0 when there are not both. And what noise
 * makes of it. */
static int32_t moved_by(int32_t *noise_px_q24, const int32_t slope[SLOPES], const seen_edge *edge)
{
    const int32_t at_q20 = edge->at_q20;
    int32_t curve[SLOPES];
    int32_t is;
    int32_t from;
    int32_t to;
    int32_t i;
    *noise_px_q24 = 0;
    if (at_q20 == 0) {
        return 0;
    }
    curve[0] = 0; /* what a peak is to be higher than */
    from = (at_q20 - FAR) >> 20;
    to = (at_q20 + FAR + ONE_Q20 - 1) >> 20;
    for (i = from - 1; i <= to + 1; i++) {
        curve[i] = sharpened(slope, i);
    }
    is = find_peak(curve, from, to);
    if (is == 0) {
        return 0;
    }
    *noise_px_q24 = noise_q24(slope, 2 * curve[is] - curve[is - 1] - curve[is + 1]);
    return edge->seen_q20 - vertex_q20(curve, is, 1);
}

/* Add grey, or the light that a transfer function makes of it, along a group's rays where the outline has points,
 * 'middle' samples and one of them within it, so that it falls outwards: as it is or negative, as its bin. */
static void add_grey(int32_t sum[], int32_t samples, int32_t middle, const drogue_ray rays[DROGUE_RAYS], int32_t group,
                     const drogue_image *view, drogue_transfer transfer, const drogue_support *support)
{
    int32_t grey[DROGUE_SMEARED_SLOPES + 2];
    int32_t i;
    int32_t k;
    for (k = group * GROUP; k < (group + 1) * GROUP; k++) {
        const int32_t bin = k * DROGUE_SUPPORT_BINS / DROGUE_RAYS;
        const uint32_t bright = support->bright_bins >> bin & 1u;
        if (support->bin[bin].count[bright] > 0) {
            const int32_t sign = bright ? 1 : -1;
            const drogue_q16 from = -(middle + 1) * rays[k].step_px_q16;
            drogue_ray_read_as(grey, &rays[k], view, transfer, from, samples);
            for (i = 0; i < samples; i++) { /* bound: DROGUE_SMEARED_SLOPES + 2 */
                sum[i] += sign * grey[i];
            }
        }
    }
}

/* Slopes of a group and of the one across, the mean over the sets of rays that the outline is large for: the noise of a
 * few rays is more than that of its edge points. */
static void read_slopes(int32_t slope[2][SLOPES], const drogue_outline *outline, drogue_ray rays[DROGUE_RAYS],
                        int32_t group, const drogue_image *view, drogue_transfer transfer)
{
    const int32_t shift = outline->fitted.a_px_q16 >= TWO_SETS;
    int32_t sum[2][SLOPES + 2];
    int32_t set;
    int32_t across;
    int32_t i;
    memset(sum, 0, sizeof sum);
    for (set = 0; set < 1 << shift; set++) { /* bound: 2 */
        drogue_rays_aim(rays, &outline->fitted, (8 * set + 4) >> shift, group * GROUP, (group + 1) * GROUP);
        for (across = 0; across < 2; across++) {
            add_grey(sum[across], SLOPES + 2, MIDDLE, rays, group + across * (GROUPS / 2), view, transfer,
                     &outline->support);
        }
    }
    for (across = 0; across < 2; across++) {
        for (i = 0; i < SLOPES; i++) {
            slope[across][i] = (int32_t)drogue_shr_round_s64(sum[across][i] - sum[across][i + 2], shift);
        }
    }
}

/* Offsets along the normal as radial ones, in semi-axes times b: times the length of the normal in semi-axes, which is
 * the same in all quadrants. */
static void spread(int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t moved_q20[GROUPS], const drogue_ellipse *e)
{
    const int64_t ratio_q24 = drogue_div_round_s64(e->b_px_q16 * (INT64_C(1) << 24), e->a_px_q16);
    uint32_t k;
    for (k = 0; k < DROGUE_SUPPORT_BINS / 4; k++) {
        const uint32_t bins[4] = {k, HALF_TURN - 1 - k, HALF_TURN + k, 2 * HALF_TURN - 1 - k};
        int64_t basis_q30[5];
        int64_t length_q24;
        int32_t u_q24;
        int32_t v_q24;
        int i;
        drogue_support_basis(basis_q30, k);
        u_q24 = (int32_t)drogue_shr_round_s64(basis_q30[1] * ratio_q24, 30);
        v_q24 = (int32_t)drogue_shr_round_s64(basis_q30[2], 6);
        length_q24 = drogue_isqrt_u64(drogue_square_sum(u_q24, v_q24));
        for (i = 0; i < 4; i++) { /* half a pixel each */
            off_px_q24[bins[i]] = (int32_t)drogue_shr_round_s64(moved_q20[bins[i] / BINS] * length_q24, 21);
        }
    }
}

static void find_harmonics(int32_t c_px_q24[5], const int32_t off_px_q24[DROGUE_SUPPORT_BINS])
{
    int64_t sum_q54[5] = {0, 0, 0, 0, 0};
    uint32_t k;
    int i;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        int64_t basis_q30[5];
        drogue_support_basis(basis_q30, k);
        for (i = 0; i < 5; i++) {
            sum_q54[i] += off_px_q24[k] * basis_q30[i];
        }
    }
    for (i = 0; i < 5; i++) {
        c_px_q24[i] = (int32_t)drogue_shr_round_s64(sum_q54[i], i > 0 ? 34 : 35);
    }
}

/* Squares of the groups' offsets that the harmonics leave, px^2 Q48; each the sum of its bins'. */
static uint64_t squares_left(const int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t c_px_q24[5])
{
    uint64_t squares_q48 = 0;
    int64_t left_q54 = 0;
    uint32_t k;
    int i;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        int64_t basis_q30[5];
        drogue_support_basis(basis_q30, k);
        left_q54 += off_px_q24[k] * basis_q30[0];
        for (i = 0; i < 5; i++) {
            left_q54 -= c_px_q24[i] * basis_q30[i];
        }
        if (k % BINS == BINS - 1) {
            squares_q48 += drogue_square_sum((int32_t)drogue_shr_round_s64(left_q54, 30), 0);
            left_q54 = 0;
        }
    }
    return squares_q48;
}

/* Variance of a wave, px^2 Q48, a quarter of what it is of a group's mean: by half of what the three degrees of freedom
 * show that the harmonics leave, some of which lies beside the outline, by noise, and by the grid; as of a round
 * outline. */
static uint64_t variance_of(const int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t c_px_q24[5],
                            const int32_t noise_px_q24[GROUPS])
{
    uint64_t noise_q48 = 0;
    int32_t i;
    for (i = 0; i < GROUPS; i++) {
        noise_q48 += drogue_square_sum(noise_px_q24[i], 0);
    }
    return squares_left(off_px_q24, c_px_q24) / (24 * BINS * BINS) + noise_q48 / (4 * GROUPS) +
           drogue_square_sum(LEAST_Q24, 0);
}

/* Less what is likely noise of it: c c^2 / (c^2 + variance), as Wiener's filter. */
static int32_t shrunk(int32_t c_px_q24, uint64_t variance_q48)
{
    const uint64_t both_q48 = drogue_square_sum(c_px_q24, 0) + variance_q48;
    int64_t noise_q30;
    int shift;
    if (variance_q48 == 0) {
        return c_px_q24;
    }
    shift = 33 - drogue_clz_u64(both_q48); /* to 31 bits; the grid's variance alone has more */
    noise_q30 = drogue_div_round_s64((int64_t)((variance_q48 >> shift) << 30), (int64_t)(both_q48 >> shift));
    return c_px_q24 - (int32_t)drogue_shr_round_s64(c_px_q24 * noise_q30, 30);
}

/* Does motion blur the outline, and is it so large that rays hardly reach its middle? */
static int is_smeared(const drogue_outline *outline)
{
    const int32_t *smear = outline->support.smear_px2_q16;
    return drogue_square_sum(smear[0], smear[1]) > SMEARED_Q32 &&
           outline->fitted.b_px_q16 >= DROGUE_SMEARED_MIDDLE * HALF;
}

/* An edge that motion blurs has no steepest place: it is where its lobe says. */
static void find_smeared(int32_t moved_q20[GROUPS], const drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                         drogue_transfer transfer, const drogue_support *support)
{
    drogue_lobe lobe[GROUPS];
    int32_t moved_q16[GROUPS];
    int32_t i;
    for (i = 0; i < GROUPS; i++) {
        int32_t slope[DROGUE_SMEARED_SLOPES + 2];
        int32_t k;
        memset(slope, 0, sizeof slope);
        add_grey(slope, DROGUE_SMEARED_SLOPES + 2, DROGUE_SMEARED_MIDDLE, rays, i, view, transfer, support);
        for (k = 0; k < DROGUE_SMEARED_SLOPES; k++) {
            slope[k] -= slope[k + 2];
        }
        drogue_find_lobe(&lobe[i], slope);
    }
    drogue_find_smeared(moved_q16, lobe);
    for (i = 0; i < GROUPS; i++) {
        moved_q20[i] = moved_q16[i] * (ONE_Q20 / DROGUE_Q16_ONE);
    }
}

static void pull(drogue_outline *outline, drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                 drogue_transfer transfer)
{
    int32_t moved_q20[GROUPS];
    int32_t noise_px_q24[GROUPS];
    int32_t variance_px2_q16[GROUPS];
    int32_t off_px_q24[DROGUE_SUPPORT_BINS];
    int32_t c_px_q24[5];
    uint64_t variance_q48;
    int smeared;
    int32_t across;
    int32_t i;
    for (i = 0; i < GROUPS / 2; i++) {
        int32_t slope[2][SLOPES];
        seen_edge edge[2];
        read_slopes(slope, outline, rays, i, view, DROGUE_TRANSFER_LINEAR);
        for (across = 0; across < 2; across++) {
            int32_t seen[SLOPES];
            see(seen, slope[across]);
            edge[across] = find_seen(seen);
            variance_px2_q16[i + across * (GROUPS / 2)] = drogue_edge_variance(slope[across], seen);
        }
        if (transfer != DROGUE_TRANSFER_LINEAR) {
            read_slopes(slope, outline, rays, i, view, transfer);
        }
        for (across = 0; across < 2; across++) {
            const int32_t group = i + across * (GROUPS / 2);
            moved_q20[group] = moved_by(&noise_px_q24[group], slope[across], &edge[across]);
        }
    }
    drogue_find_smear(outline->support.smear_px2_q16, variance_px2_q16);
    smeared = is_smeared(outline);
    if (smeared) {
        drogue_rays_aim(rays, &outline->fitted, 4, 0, DROGUE_RAYS / 2);
        find_smeared(moved_q20, rays, view, transfer, &outline->support);
    }
    drogue_turn_wave(outline->support.smear_px2_q16, outline->fitted.angle_rad_q16);
    spread(off_px_q24, moved_q20, &outline->fitted);
    find_harmonics(c_px_q24, off_px_q24);
    /* where motion blurs the outline, what the harmonics leave is the motion's own */
    variance_q48 = smeared ? 0 : variance_of(off_px_q24, c_px_q24, noise_px_q24);
    for (i = 0; i < 5; i++) {
        const uint64_t own_q48 = i > 0 ? variance_q48 : variance_q48 / 2; /* of a mean half that of a wave */
        const int64_t c_px_q40 = shrunk(c_px_q24[i], own_q48) * (int64_t)DROGUE_Q16_ONE;
        const int64_t c_q24 = drogue_div_round_s64(c_px_q40, outline->fitted.b_px_q16);
        outline->support.pull_q24[i] = drogue_clamp_s32(drogue_sat_s32(c_q24), -MOST_Q24, MOST_Q24);
    }
}

void drogue_outline_pull(drogue_outline *outline, drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                         const drogue_config *config)
{
    memset(outline->support.pull_q24, 0, sizeof outline->support.pull_q24);
    memset(outline->support.smear_px2_q16, 0, sizeof outline->support.smear_px2_q16);
    outline->ellipse = outline->fitted;
    if (outline->fitted.b_px_q16 < DROGUE_Q16_ONE) {
        return;
    }
    if (outline->support.points > 0) {
        pull(outline, rays, view, config->transfer);
        drogue_outline_put_back(&outline->ellipse, outline->support.pull_q24);
    }
    drogue_undo_blur(&outline->ellipse, config);
}

void drogue_outline_put_back(drogue_ellipse *e, const int32_t pull_q24[5])
{
    const int64_t a =
        (int64_t)e->a_px_q16 - drogue_shr_round_s64((int64_t)e->a_px_q16 * (pull_q24[0] + pull_q24[3]), 24);
    const int64_t b =
        (int64_t)e->b_px_q16 - drogue_shr_round_s64((int64_t)e->b_px_q16 * (pull_q24[0] - pull_q24[3]), 24);
    const int64_t harmonic = (int64_t)e->a_px_q16 * e->b_px_q16 / ((int64_t)e->a_px_q16 + e->b_px_q16);
    const int64_t cross = -drogue_shr_round_s64(2 * harmonic * pull_q24[4], 24);
    const int64_t half = (a - b) / 2;
    const int64_t u = -drogue_shr_round_s64((int64_t)e->a_px_q16 * pull_q24[1], 24);
    const int64_t v = -drogue_shr_round_s64((int64_t)e->b_px_q16 * pull_q24[2], 24);
    const int32_t apart = (int32_t)drogue_isqrt_u64((uint64_t)(half * half + cross * cross));
    int32_t s_q30;
    int32_t c_q30;
    int64_t moved_px_q16[2];
    int64_t angle;
    if (pull_q24[0] == 0 && pull_q24[1] == 0 && pull_q24[2] == 0 && pull_q24[3] == 0 && pull_q24[4] == 0) {
        return;
    }
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 13));
    drogue_rotate_q30(moved_px_q16, drogue_sat_s32(u), drogue_sat_s32(v), c_q30, s_q30);
    e->xc_px_q16 = drogue_sat_s32(e->xc_px_q16 + moved_px_q16[0]);
    e->yc_px_q16 = drogue_sat_s32(e->yc_px_q16 + moved_px_q16[1]);
    e->a_px_q16 = (drogue_q16)((a + b) / 2 + apart);
    e->b_px_q16 = (drogue_q16)((a + b) / 2 - apart);
    angle = e->angle_rad_q16 + drogue_shr_round_s64(drogue_atan2_q29(cross, half), 14);
    angle = angle > DROGUE_Q16_PI / 2     ? angle - DROGUE_Q16_PI
            : angle <= -DROGUE_Q16_PI / 2 ? angle + DROGUE_Q16_PI
                                          : angle;
    e->angle_rad_q16 = (drogue_q16)angle;
}
