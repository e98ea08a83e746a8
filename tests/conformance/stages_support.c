/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of the support of an ellipse by edge points and of the joint pose. */
#include "stage_run.h"

#include <string.h>

#include "../../src/outline/near.h"
#include "drogue/joint.h"

/* Edge points from words x_q5 y_q5 gx gy; 0 when one is out of the front end's range. */
static int edges_of_words(drogue_edge *edges, const int32_t *w, size_t count)
{
    size_t i;
    for (i = 0; i < count; i++, w += 4) {
        if (w[0] < 0 || w[0] > UINT16_MAX || w[1] < 0 || w[1] > UINT16_MAX || w[2] < -1020 || w[2] > 1020 ||
            w[3] < -1020 || w[3] > 1020) {
            return 0;
        }
        edges[i].arc = DROGUE_NO_ARC;
        edges[i].x_q5 = (uint16_t)w[0];
        edges[i].y_q5 = (uint16_t)w[1];
        edges[i].gx = (int16_t)w[2];
        edges[i].gy = (int16_t)w[3];
    }
    return 1;
}

/* Word of a member from what one point changed in the counts: bin, and polarity; -1 when it does not belong. */
static int32_t member_of(const drogue_support *before, const drogue_support *after)
{
    uint32_t k;
    for (k = 0; k < 2 * DROGUE_SUPPORT_BINS; k++) {
        if (after->bin[k % DROGUE_SUPPORT_BINS].count[k / DROGUE_SUPPORT_BINS] !=
            before->bin[k % DROGUE_SUPPORT_BINS].count[k / DROGUE_SUPPORT_BINS]) {
            return (int32_t)k;
        }
    }
    return -1;
}

/* Add every edge point that belongs to the sums of the bins, whose polarity is decided. */
static void add_members(int32_t *members, drogue_support *support, const drogue_ellipse_frame *frame,
                        const drogue_band *band, const drogue_edge *edges, size_t count)
{
    const uint32_t bright_bins = support->bright_bins;
    const uint32_t covered = support->covered;
    drogue_moments moments;
    size_t i;
    drogue_moments_clear(&moments);
    memset(support, 0, sizeof *support);
    support->bright_bins = bright_bins;
    support->covered = covered;
    for (i = 0; i < count; i++) {
        const drogue_support before = *support;
        drogue_collect_edges(&moments, support, frame, band, &edges[i], 1, 1, 0);
        members[i] = member_of(&before, support);
    }
}

static int32_t counted(const drogue_support *support)
{
    uint32_t sum = 0;
    uint32_t k;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        sum += support->bin[k].count[0] + support->bin[k].count[1];
    }
    return (int32_t)sum;
}

int stage_support(stage_run *r)
{
    const drogue_ellipse ellipse = stage_ellipse(stage_input32(r, 0));
    const int32_t *p = stage_input32(r, 2);
    size_t count = r->in[1].count / 4;
    int32_t *summary = stage_output32(r, "summary", 6);
    int32_t *bins = stage_output32(r, "bins", 3 * DROGUE_SUPPORT_BINS);
    int32_t *members = stage_output32(r, "members", count);
    int64_t *sums = (int64_t *)stage_output(r, "sums", 64, 2);
    drogue_edge *edges = (drogue_edge *)stage_take(r, count * sizeof *edges);
    drogue_ellipse_frame frame;
    drogue_support support;
    drogue_moments moments;
    drogue_band band;
    uint32_t k;
    if (summary == NULL || bins == NULL || members == NULL || sums == NULL || edges == NULL) {
        return CONF_E_MEMORY;
    }
    if (!stage_angle_valid(&ellipse) || !edges_of_words(edges, stage_input32(r, 1), count) || p[0] < 1 ||
        p[0] > DROGUE_Q16(8, 1) || p[1] < 0 || p[1] > DROGUE_Q16_ONE || p[2] < 1 || p[2] > 1024 || p[3] < 0 ||
        p[3] > 2) {
        return CONF_E_MALFORMED;
    }
    band = drogue_band_of(p[0], p[1]);
    sums[0] = sums[1] = 0;
    summary[0] = (int32_t)drogue_ellipse_frame_of(&frame, &ellipse);
    if (summary[0] != DROGUE_OK) {
        return 0;
    }
    memset(&support, 0, sizeof support);
    drogue_moments_clear(&moments);
    drogue_collect_edges(&moments, &support, &frame, &band, edges, (uint32_t)count, (uint32_t)p[2], 0);
    drogue_support_judge(&support, &ellipse, (drogue_polarity)p[3], (uint32_t)p[2]);
    summary[1] = counted(&support);
    summary[2] = (int32_t)support.bright_bins;
    summary[3] = (int32_t)support.covered;
    summary[4] = drogue_support_cover(&support);
    add_members(members, &support, &frame, &band, edges, count);
    summary[5] = (int32_t)support.points;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        bins[3 * k] = (int32_t)support.bin[k].count[0];
        bins[3 * k + 1] = (int32_t)support.bin[k].count[1];
        bins[3 * k + 2] = support.bin[k].sum_q16;
    }
    sums[0] = support.squares_q32;
    sums[1] = (int64_t)support.gradient;
    return 0;
}

int stage_support_of_words(drogue_support *support, const int32_t *bins, int32_t gradient, int32_t axis)
{
    uint32_t k;
    memset(support, 0, sizeof *support);
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        if (bins[2 * k] < 0 || bins[2 * k] > 4096) {
            return 0;
        }
        support->bin[k].count[0] = (uint32_t)bins[2 * k];
        support->bin[k].sum_q16 = bins[2 * k + 1];
        support->points += (uint32_t)bins[2 * k];
    }
    support->gradient = (uint64_t)gradient;
    support->axis_rad_q16 = axis;
    return gradient >= 0;
}

static void put_packed(int64_t *at, const drogue_real *packed)
{
    int k;
    for (k = 0; k < DROGUE_PACKED_MAX; k++) {
        at[k] = drogue_real_to_s64(packed[k], 48);
    }
}

static void put_joint(int32_t *out, const drogue_joint *joint)
{
    (void)stage_put_pose(out, &joint->pose);
    out[8] = drogue_real_to_q16(joint->chi2);
}

int stage_joint(stage_run *r)
{
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const int32_t *p = stage_input32(r, 3);
    const drogue_model model = {p[0], p[1], p[2]};
    const drogue_joint_inner inner = {p[8], p[9], p[10]};
    int32_t *out = stage_output32(r, "joint", 10);
    int32_t *disc = stage_output32(r, "disc", 6);
    int64_t *covariance = (int64_t *)stage_output(r, "covariance", 64, DROGUE_PACKED_MAX);
    int64_t *outline_covariance = (int64_t *)stage_output(r, "outline", 64, DROGUE_PACKED_MAX);
    drogue_joint_outline outline;
    drogue_real stated[DROGUE_PACKED_MAX];
    drogue_support support;
    drogue_ellipse ellipse;
    drogue_ellipse image;
    drogue_pose start;
    drogue_joint joint;
    if (out == NULL || disc == NULL || covariance == NULL || outline_covariance == NULL) {
        return CONF_E_MEMORY;
    }
    memset(covariance, 0, DROGUE_PACKED_MAX * sizeof *covariance);
    memset(outline_covariance, 0, DROGUE_PACKED_MAX * sizeof *outline_covariance);
    memset(&start, 0, sizeof start);
    memcpy(start.position_m_q16, p + 3, sizeof start.position_m_q16);
    start.yaw_rad_q16 = p[6];
    start.pitch_rad_q16 = p[7];
    ellipse = stage_ellipse(stage_input32(r, 0));
    if (!stage_angle_valid(&ellipse) || ellipse.b_px_q16 < DROGUE_Q16_ONE || ellipse.a_px_q16 < ellipse.b_px_q16 ||
        camera.fx_px_q16 <= 0 || camera.fy_px_q16 <= 0 || p[0] <= 0 || p[1] < 0 || p[6] < -DROGUE_Q16_HALF_PI ||
        p[6] > DROGUE_Q16_HALF_PI || p[7] < -DROGUE_Q16_HALF_PI || p[7] > DROGUE_Q16_HALF_PI || p[10] < 0 ||
        p[11] < 0 || p[12] < 0 || p[14] < 0 || p[14] > 16 ||
        !stage_support_of_words(&support, stage_input32(r, 2), p[13], stage_input32(r, 0)[4])) {
        return CONF_E_MALFORMED;
    }
    disc[0] = (int32_t)drogue_inner_disc_image(&image, &start, &camera, &model);
    if (disc[0] == DROGUE_OK) {
        disc[1] = image.xc_px_q16;
        disc[2] = image.yc_px_q16;
        disc[3] = image.a_px_q16;
        disc[4] = image.b_px_q16;
        disc[5] = image.angle_rad_q16;
    }
    out[0] = (int32_t)drogue_joint_outline_covariance(stated, &ellipse, &support, p[11], p[12]);
    if (out[0] == DROGUE_OK) {
        out[0] = (int32_t)drogue_joint_outline_weigh(&outline, &ellipse, stated);
    }
    if (out[0] == DROGUE_OK) {
        put_packed(outline_covariance, stated);
        out[0] = (int32_t)drogue_joint_solve(&joint, &start, &outline, &inner, &camera, &model, p[14]);
    }
    if (out[0] == DROGUE_OK) {
        put_joint(out + 1, &joint);
        put_packed(covariance, joint.covariance);
    }
    return 0;
}
