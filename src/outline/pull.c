/* SPDX-License-Identifier: Apache-2.0 */
/* What lies beside the outline, and what it does to it.
 *
 * Shading that runs up to the outline, or another edge nearby as that of a narrow wall, moves the place where the grey
 * changes fastest, the farther the more blur there is. So the edge is looked for at two blurs along rays: as the front
 * end sees it, and sharpened. It goes from the one towards the other. Where grey levels are encoded, the sharpened edge
 * is that of the light. Where the sensor is saturated beside it, what would be brighter is cut off and the edge lies
 * towards the dark side: by half the optics' blur where the light is about one and a half times what the sensor bears.
 * What is white without being cut off is white farther out. */
#include "drogue/outline.h"

#include <string.h>

#include "collection.h"
#include "harmonics.h"
#include "smear.h"

#define GROUPS DROGUE_EDGE_GROUPS
#define GROUP (DROGUE_RAYS / GROUPS) /* rays taken together */
#define MIDDLE DROGUE_SLOPE_MIDDLE
#define SLOPES DROGUE_SLOPES
#define HALF DROGUE_Q16(1, 2)      /* px between slopes */
#define TWO_SETS DROGUE_Q16(24, 1) /* px: of a larger outline twice as many rays are read */
#define STEEP DROGUE_Q16(1, 2)     /* px^2 of smear: up to that an edge has a steepest place */
#define Q20_OF_Q16 16
#define WHITE_Q8 (254 * 256) /* a level that is saturated, but for noise of processing */
#define BESIDE 3             /* samples from the outline to where only an edge that is cut off is white, 1.5 px */

/* Add grey, or the light that a transfer function makes of it, along a group's rays where the outline has points,
 * 'middle' samples and one of them within it, so that it falls outwards: as it is or negative, as its bin. Returns how
 * many of the rays are saturated outside, less those that are inside. */
static int32_t add_grey(int32_t sum[], int32_t samples, int32_t middle, const drogue_ray rays[DROGUE_RAYS],
                        int32_t group, const drogue_image *view, drogue_transfer transfer,
                        const drogue_support *support)
{
    int32_t grey[DROGUE_SMEARED_SLOPES + 2];
    int32_t white = 0;
    int32_t k;
    for (k = group * GROUP; k < (group + 1) * GROUP; k++) {
        const uint32_t bin = (uint32_t)k / (DROGUE_RAYS / DROGUE_SUPPORT_BINS);
        const uint32_t bright = support->bright_bins >> bin & 1u;
        if (support->bin[bin].count[bright] > 0) {
            const int32_t sign = bright ? 1 : -1;
            const drogue_q16 from = -(middle + 1) * rays[k].step_px_q16;
            drogue_ray_add(sum, grey, &rays[k], view, transfer, from, samples, sign);
            white += (grey[middle + 1 + BESIDE] >= WHITE_Q8) - (grey[middle + 1 - BESIDE] >= WHITE_Q8);
        }
    }
    return white;
}

/* Slopes of a group and of the one across, the mean over the sets of rays that the outline is large for: the noise of a
 * few rays is more than that of its edge points. And what add_grey() returns, of 16 rays. */
static void read_slopes(int32_t slope[2][SLOPES], int32_t white[2], const drogue_outline *outline,
                        drogue_ray rays[DROGUE_RAYS], int32_t group, const drogue_image *view, drogue_transfer transfer)
{
    const int32_t shift = outline->fitted.a_px_q16 >= TWO_SETS;
    int32_t sum[2][SLOPES + 2];
    int32_t set;
    int32_t across;
    int32_t i;
    memset(sum, 0, sizeof sum);
    white[0] = white[1] = 0;
    for (set = 0; set < 1 << shift; set++) { /* bound: 2 */
        drogue_rays_aim(rays, &outline->fitted, (8 * set + 4) >> shift, group * GROUP, (group + 1) * GROUP);
        for (across = 0; across < 2; across++) {
            white[across] += add_grey(sum[across], SLOPES + 2, MIDDLE, rays, group + across * (GROUPS / 2), view,
                                      transfer, &outline->support);
        }
    }
    for (across = 0; across < 2; across++) {
        white[across] *= 2 >> shift;
        for (i = 0; i < SLOPES; i++) {
            slope[across][i] = (int32_t)drogue_shr_round_s64(sum[across][i] - sum[across][i + 2], shift);
        }
    }
}

/* Does motion blur the outline, and is it so large that rays hardly reach its middle? */
static int is_smeared(const drogue_outline *outline)
{
    return drogue_support_smear(&outline->support) > STEEP && outline->fitted.b_px_q16 >= DROGUE_SMEARED_MIDDLE * HALF;
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
        (void)add_grey(slope, DROGUE_SMEARED_SLOPES + 2, DROGUE_SMEARED_MIDDLE, rays, i, view, transfer, support);
        for (k = 0; k < DROGUE_SMEARED_SLOPES; k++) {
            slope[k] -= slope[k + 2];
        }
        drogue_find_lobe(&lobe[i], slope);
    }
    drogue_find_smeared(moved_q16, lobe);
    for (i = 0; i < GROUPS; i++) {
        moved_q20[i] = moved_q16[i] * Q20_OF_Q16;
    }
}

static void pull(drogue_outline *outline, drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                 const drogue_config *config)
{
    const drogue_transfer transfer = config->transfer;
    int32_t moved_q20[GROUPS];
    int32_t cut_q20[GROUPS];
    int32_t noise_px_q24[GROUPS];
    int32_t variance_px2_q16[GROUPS];
    int smeared;
    int32_t across;
    int32_t i;
    for (i = 0; i < GROUPS / 2; i++) {
        int32_t slope[2][SLOPES];
        int32_t white[2];
        drogue_seen_edge edge[2];
        read_slopes(slope, white, outline, rays, i, view, DROGUE_TRANSFER_LINEAR);
        for (across = 0; across < 2; across++) {
            const int32_t group = i + across * (GROUPS / 2);
            drogue_see_edge(&edge[across], slope[across]);
            outline->support.outside += (uint32_t)drogue_edge_outside(slope[across]);
            variance_px2_q16[group] = edge[across].variance_px2_q16;
            cut_q20[group] = white[across] * config->optics_blur_px_q16; /* of 16 rays half of it, in half pixels */
        }
        if (transfer != DROGUE_TRANSFER_LINEAR) {
            read_slopes(slope, white, outline, rays, i, view, transfer);
        }
        for (across = 0; across < 2; across++) {
            const int32_t group = i + across * (GROUPS / 2);
            moved_q20[group] = drogue_edge_moved(&noise_px_q24[group], slope[across], &edge[across]);
        }
    }
    drogue_find_smear(outline->support.smear_px2_q16, variance_px2_q16);
    smeared = is_smeared(outline);
    if (smeared) {
        drogue_rays_aim(rays, &outline->fitted, 4, 0, DROGUE_RAYS / 2);
        find_smeared(moved_q20, rays, view, transfer, &outline->support);
    }
    for (i = 0; i < GROUPS; i++) {
        moved_q20[i] -= cut_q20[i];
    }
    drogue_turn_wave(outline->support.smear_px2_q16, outline->fitted.angle_rad_q16);
    if (!outline->outer) {
        drogue_find_harmonics(outline->support.pull_q24, moved_q20, smeared ? NULL : noise_px_q24, &outline->fitted);
        drogue_outline_put_back(&outline->ellipse, outline->support.pull_q24);
    }
}

void drogue_outline_pull(drogue_outline *outline, drogue_ray rays[DROGUE_RAYS], const drogue_image *view,
                         const drogue_config *config)
{
    if (!outline->outer) {
        memset(outline->support.pull_q24, 0, sizeof outline->support.pull_q24);
    }
    memset(outline->support.smear_px2_q16, 0, sizeof outline->support.smear_px2_q16);
    outline->support.outside = 0;
    outline->ellipse = outline->fitted;
    if (outline->fitted.b_px_q16 < DROGUE_Q16_ONE) {
        return;
    }
    if (outline->support.points > 0) {
        pull(outline, rays, view, config);
    }
    drogue_undo_blur(&outline->ellipse, config);
}
