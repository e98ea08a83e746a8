/* SPDX-License-Identifier: Apache-2.0 */
/* What lies beside the outline, and what it does to it.
 *
 * Shading that runs up to the outline, or another edge nearby as that of a narrow wall, moves the place where the grey
 * changes fastest, the farther the more blur there is. So the edge is looked for at two blurs along rays: as the front
 * end sees it, and sharpened. It goes from the one towards the other. */
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
#define FAR DROGUE_Q16(12, 5) /* slopes: so far from there, 1.2 px, lies the sharpened one */
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

/* Less a quarter of the second difference, times 4: what blur of half a pixel took. */
static int32_t sharpened(const int32_t slope[SLOPES], int32_t i) { return 6 * slope[i] - slope[i - 2] - slope[i + 2]; }

/* The highest peak of a curve within [from, to]; 0 when there is none. */
static int find_peak(int32_t *at_q16, const int32_t curve[SLOPES], int32_t from, int32_t to)
{
    int32_t best = 0;
    int32_t i;
    for (i = from; i <= to; i++) {
        if (curve[i] > curve[best] && curve[i] > curve[i - 1] && curve[i] >= curve[i + 1]) {
            best = i;
        }
    }
    if (best > 0) {
        *at_q16 = best * DROGUE_Q16_ONE + drogue_ray_peak_q16(curve[best - 1], curve[best], curve[best + 1]);
    }
    return best > 0;
}

/* How far outwards of the sharpened edge the blurred one lies, in slopes Q16; 0 when there are not both. */
static int32_t moved_q16(const int32_t slope[SLOPES], const int32_t seen[SLOPES])
{
    int32_t curve[SLOPES];
    int32_t seen_q16;
    int32_t is_q16;
    int32_t from;
    int32_t to;
    int32_t i;
    if (!find_peak(&seen_q16, seen, MIDDLE - NEAR, MIDDLE + NEAR)) {
        return 0;
    }
    curve[0] = 0; /* what a peak is to be higher than */
    from = (seen_q16 - FAR) >> 16;
    to = (seen_q16 + FAR + DROGUE_Q16_ONE - 1) >> 16;
    for (i = from - 1; i <= to + 1; i++) {
        curve[i] = sharpened(slope, i);
    }
    return find_peak(&is_q16, curve, from, to) ? seen_q16 - is_q16 : 0;
}

/* Slopes along a group's rays where the outline has points, 'middle' of them within it, rising from bright to dark or the
 * other way as its bin. */
static void add_slopes(int32_t slope[], int32_t slopes, int32_t middle, const drogue_ray rays[DROGUE_RAYS],
                       int32_t group, const drogue_image *view, const drogue_support *support)
{
    int32_t grey[DROGUE_SMEARED_SLOPES + 2];
    int32_t i;
    int32_t k;
    memset(slope, 0, (size_t)slopes * sizeof *slope);
    for (k = group * GROUP; k < (group + 1) * GROUP; k++) {
        const int32_t bin = k * DROGUE_SUPPORT_BINS / DROGUE_RAYS;
        const uint32_t bright = support->bright_bins >> bin & 1u;
        if (support->bin[bin].count[bright] > 0) {
            drogue_ray_read(grey, &rays[k], view, -(middle + 1) * rays[k].step_px_q16, slopes + 2);
            for (i = 0; i < slopes; i++) { /* bound: DROGUE_SMEARED_SLOPES */
                slope[i] += bright ? grey[i] - grey[i + 2] : grey[i + 2] - grey[i];
            }
        }
    }
}

/* Offsets along the normal as radial ones, in semi-axes times b: times the length of the normal in semi-axes, which is the
 * same in all quadrants. */
static void spread(int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t moved[GROUPS], const drogue_ellipse *e)
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
            off_px_q24[bins[i]] = (int32_t)drogue_shr_round_s64(moved[bins[i] / BINS] * length_q24, 17);
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

/* Variance of a wave, px^2 Q48: a quarter of what it is of a group's mean, which the three degrees of freedom show that
 * the harmonics leave (of the mean over all groups it is half that: shrunk more); and a quarter of the mean square of the
 * points' offsets, as measured. Nothing where motion blurs them: the points lie anywhere on an edge then, and what the
 * harmonics leave is the motion's own. */
static uint64_t variance_of(const int32_t off_px_q24[DROGUE_SUPPORT_BINS], const int32_t c_px_q24[5],
                            const drogue_outline *outline, int smeared)
{
    const drogue_support *s = &outline->support;
    const int64_t rms_q24 = drogue_isqrt_u64(((uint64_t)s->squares_q32 << 16) / s->points);
    const uint64_t rms_px_q24 = (uint64_t)drogue_shr_round_s64(rms_q24 * outline->fitted.b_px_q16, 16);
    return smeared ? 0 : squares_left(off_px_q24, c_px_q24) / (12 * BINS * BINS) + rms_px_q24 * rms_px_q24 / 4;
}

/* Less what noise makes of it: c (1 - variance / c^2), or nothing. */
static int32_t shrunk(int32_t c_px_q24, uint64_t variance_q48)
{
    const int32_t size = c_px_q24 < 0 ? -c_px_q24 : c_px_q24;
    int32_t kept;
    if (drogue_square_sum(size, 0) <= variance_q48) {
        return 0;
    }
    kept = size - (int32_t)drogue_div_round_s64((int64_t)variance_q48, size);
    return c_px_q24 < 0 ? -kept : kept;
}

/* Does motion blur the outline, and is it so large that rays hardly reach its middle? */
static int is_smeared(const drogue_outline *outline)
{
    const int32_t *smear = outline->support.smear_px2_q16;
    return drogue_square_sum(smear[0], smear[1]) > SMEARED_Q32 &&
           outline->fitted.b_px_q16 >= DROGUE_SMEARED_MIDDLE * HALF;
}

/* An edge that motion blurs has no steepest place: it is where its lobe says. */
static void find_smeared(int32_t moved[GROUPS], const drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                         const drogue_support *support)
{
    drogue_lobe lobe[GROUPS];
    int32_t i;
    for (i = 0; i < GROUPS; i++) {
        int32_t slope[DROGUE_SMEARED_SLOPES];
        add_slopes(slope, DROGUE_SMEARED_SLOPES, DROGUE_SMEARED_MIDDLE, rays, i, view, support);
        drogue_find_lobe(&lobe[i], slope);
    }
    drogue_find_smeared(moved, lobe);
}

static void pull(drogue_outline *outline, drogue_ray rays[DROGUE_RAYS], const drogue_image *view)
{
    int32_t moved[GROUPS];
    int32_t variance_px2_q16[GROUPS];
    int32_t off_px_q24[DROGUE_SUPPORT_BINS];
    int32_t c_px_q24[5];
    uint64_t variance_q48;
    int smeared;
    int32_t i;
    drogue_rays_aim(rays, &outline->fitted, 4);
    for (i = 0; i < GROUPS; i++) {
        int32_t slope[SLOPES];
        int32_t seen[SLOPES];
        int32_t k;
        add_slopes(slope, SLOPES, MIDDLE, rays, i, view, &outline->support);
        seen[0] = 0; /* what a peak is to be higher than */
        for (k = DROGUE_SLOPE_FIRST; k <= DROGUE_SLOPE_LAST; k++) {
            seen[k] = blurred(slope, k);
        }
        moved[i] = moved_q16(slope, seen);
        variance_px2_q16[i] = drogue_edge_variance(slope, seen);
    }
    drogue_find_smear(outline->support.smear_px2_q16, variance_px2_q16);
    smeared = is_smeared(outline);
    if (smeared) {
        find_smeared(moved, rays, view, &outline->support);
    }
    drogue_turn_wave(outline->support.smear_px2_q16, outline->fitted.angle_rad_q16);
    spread(off_px_q24, moved, &outline->fitted);
    find_harmonics(c_px_q24, off_px_q24);
    variance_q48 = variance_of(off_px_q24, c_px_q24, outline, smeared);
    for (i = 0; i < 5; i++) {
        const int64_t c_px_q40 = shrunk(c_px_q24[i], variance_q48) * (int64_t)DROGUE_Q16_ONE;
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
        pull(outline, rays, view);
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
    int64_t angle;
    if (pull_q24[0] == 0 && pull_q24[1] == 0 && pull_q24[2] == 0 && pull_q24[3] == 0 && pull_q24[4] == 0) {
        return;
    }
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 13));
    e->xc_px_q16 = drogue_sat_s32(e->xc_px_q16 + drogue_shr_round_s64(u * c_q30 - v * s_q30, 30));
    e->yc_px_q16 = drogue_sat_s32(e->yc_px_q16 + drogue_shr_round_s64(u * s_q30 + v * c_q30, 30));
    e->a_px_q16 = (drogue_q16)((a + b) / 2 + apart);
    e->b_px_q16 = (drogue_q16)((a + b) / 2 - apart);
    angle = e->angle_rad_q16 + drogue_shr_round_s64(drogue_atan2_q29(cross, half), 14);
    angle = angle > DROGUE_Q16_PI / 2     ? angle - DROGUE_Q16_PI
            : angle <= -DROGUE_Q16_PI / 2 ? angle + DROGUE_Q16_PI
                                          : angle;
    e->angle_rad_q16 = (drogue_q16)angle;
}
