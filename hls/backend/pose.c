/* SPDX-License-Identifier: Apache-2.0 */
/* Top: outline and inner part in, pose and covariance out. The same calls as drogue_measure() makes. */
#include "backend.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/inner.h"

/* What the second step needs of the first. */
typedef struct first_step {
    drogue_ellipse ellipse; /* as seen, coordinates of the region */
    drogue_pose poses[2];
    drogue_support support;
} first_step;

static void get_support(drogue_support *support, const int32_t words[DROGUE_HLS_OUTLINE_WORDS])
{
    int k;
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        support->bin[k].count[0] = (uint32_t)words[DROGUE_HLS_O_BINS + 3 * k];
        support->bin[k].count[1] = (uint32_t)words[DROGUE_HLS_O_BINS + 3 * k + 1];
        support->bin[k].sum_q16 = words[DROGUE_HLS_O_BINS + 3 * k + 2];
    }
    support->squares_q32 = (int64_t)drogue_hls_unpack_u64(words + DROGUE_HLS_O_SQUARES);
    support->gradient = drogue_hls_unpack_u64(words + DROGUE_HLS_O_GRADIENT);
    support->points = (uint32_t)words[DROGUE_HLS_O_POINTS];
    support->bright_bins = (uint32_t)words[DROGUE_HLS_O_BRIGHT_BINS];
    support->covered = (uint32_t)words[DROGUE_HLS_O_COVERED];
}

/* The inner part as a measurement; the index of the expected disc that it is nearest to. */
static uint32_t get_inner(drogue_inner_part *part, const int32_t words[DROGUE_HLS_INNER_WORDS])
{
    part->x_px_q16 = words[DROGUE_HLS_D_X];
    part->y_px_q16 = words[DROGUE_HLS_D_Y];
    part->area_px = (uint32_t)words[DROGUE_HLS_D_AREA];
    part->spread_px_q16 = words[DROGUE_HLS_D_SPREAD];
    part->threshold = (uint8_t)(words[DROGUE_HLS_D_THRESHOLD] & 0xFF);
    part->contrast = (uint8_t)(words[DROGUE_HLS_D_CONTRAST] & 0xFF);
    return (uint32_t)words[DROGUE_HLS_D_WHICH] & 1u;
}

static void put(int32_t words[DROGUE_HLS_RESULT_WORDS], int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS],
                int64_t std[DROGUE_HLS_STD_WORDS], const drogue_result *r)
{
    int i;
    int j;
    words[DROGUE_HLS_R_HAS_INNER] = r->has_inner;
    words[DROGUE_HLS_R_INNER] = r->inner.x_px_q16;
    words[DROGUE_HLS_R_INNER + 1] = r->inner.y_px_q16;
    words[DROGUE_HLS_R_INNER + 2] = (int32_t)r->inner.area_px;
    words[DROGUE_HLS_R_INNER + 3] = r->inner.spread_px_q16;
    words[DROGUE_HLS_R_INNER + 4] = r->inner.threshold;
    words[DROGUE_HLS_R_INNER + 5] = r->inner.contrast;
    drogue_hls_pack_pose(words + DROGUE_HLS_R_POSE, &r->pose);
    drogue_hls_pack_pose(words + DROGUE_HLS_R_ALTERNATIVE, &r->alternative);
    words[DROGUE_HLS_R_RESOLVED] = r->orientation_resolved;
    words[DROGUE_HLS_R_AMBIGUITY] = r->ambiguity_q16;
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            covariance[i * (i + 1) / 2 + j] = r->covariance_q48[i][j];
        }
    }
    for (i = 0; i < 3; i++) {
        std[i] = r->position_std_m_q32[i];
    }
    std[3] = r->axis_std_rad_q32;
}

/* Weigh the inner part, if there is one, and decide. */
static drogue_status solve(drogue_result *out, const first_step *f, const drogue_hls_parameters *p,
                           const int32_t outline[DROGUE_HLS_OUTLINE_WORDS], const int32_t dark[DROGUE_HLS_INNER_WORDS])
{
    drogue_joint_inner inner = {0, 0, 0};
    uint32_t nearer = 0;
    drogue_status status = DROGUE_E_NO_INNER_PART;
    if (p->model.inner_radius_m_q16 > 0 && outline[DROGUE_HLS_O_DISC + 2] > 0) {
        status = (drogue_status)((uint32_t)dark[DROGUE_HLS_D_STATUS] & DROGUE_HLS_STATUS);
    }
    if (status == DROGUE_OK) {
        const uint32_t which = get_inner(&out->inner, dark);
        const drogue_ellipse expected = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED + 5 * which);
        nearer = drogue_inner_weigh(&inner, out, &expected, &f->ellipse, f->poses, &p->config, &p->camera, &p->model);
    } else if (status != DROGUE_E_NO_INNER_PART) {
        return status;
    }
    return drogue_decide(out, f->poses, nearer, &f->support, &inner, &p->config, &p->camera, &p->model);
}

void drogue_hls_pose(const int32_t parameters[DROGUE_HLS_PARAMETERS], const int32_t outline[DROGUE_HLS_OUTLINE_WORDS],
                     const int32_t dark[DROGUE_HLS_INNER_WORDS], int32_t result[DROGUE_HLS_RESULT_WORDS],
                     int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS], int64_t std[DROGUE_HLS_STD_WORDS])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = parameters
#pragma HLS interface mode = s_axilite port = outline
#pragma HLS interface mode = s_axilite port = dark
#pragma HLS interface mode = s_axilite port = result
#pragma HLS interface mode = s_axilite port = covariance
#pragma HLS interface mode = s_axilite port = std
#pragma HLS interface mode = s_axilite port = return
#endif
    drogue_hls_parameters p;
    first_step f;
    drogue_result out;
    uint32_t bits = (uint32_t)outline[DROGUE_HLS_O_STATUS];
    drogue_hls_unpack_parameters(&p, parameters);
    memset(&out, 0, sizeof out);
    out.ambiguity_q16 = DROGUE_Q16_ONE;
    if ((bits & DROGUE_HLS_STATUS) == DROGUE_OK) {
        out.region.x_px = p.x_px;
        out.region.y_px = p.y_px;
        out.ideal = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_IDEAL);
        f.ellipse = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_ELLIPSE);
        drogue_hls_unpack_pose(&f.poses[0], outline + DROGUE_HLS_O_POSES);
        drogue_hls_unpack_pose(&f.poses[1], outline + DROGUE_HLS_O_POSES + 8);
        get_support(&f.support, outline);
        bits |= (uint32_t)dark[DROGUE_HLS_D_STATUS] & ~DROGUE_HLS_STATUS;
        bits |= (uint32_t)solve(&out, &f, &p, outline, dark);
    }
    result[DROGUE_HLS_R_STATUS] = (int32_t)bits;
    put(result, covariance, std, &out);
}
