/* SPDX-License-Identifier: Apache-2.0 */
/* Top: outline and inner part in, pose and covariance out. The same calls as drogue_measure() makes. */
#include "../words.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/inner.h"

static inline void get_support(drogue_support *support, const int32_t words[DROGUE_HLS_OUTLINE_WORDS])
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
    support->axis_rad_q16 = words[DROGUE_HLS_O_AXIS];
    support->outside = (uint32_t)words[DROGUE_HLS_O_OUTSIDE] & 15u;
    for (k = 0; k < 5; k++) {
        support->pull_q24[k] = words[DROGUE_HLS_O_PULL + k];
    }
    for (k = 0; k < 2; k++) {
        support->smear_px2_q16[k] = words[DROGUE_HLS_O_SMEAR + k];
    }
}

static inline void put(int32_t words[DROGUE_HLS_RESULT_WORDS], int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS],
                       int64_t std[DROGUE_HLS_STD_WORDS], const drogue_inner_evidence *inner, const drogue_decision *r)
{
    int i;
    int j;
    words[DROGUE_HLS_R_HAS_INNER] = inner->weighed.std_px_q16 > 0;
    words[DROGUE_HLS_R_INNER] = inner->part.x_px_q16;
    words[DROGUE_HLS_R_INNER + 1] = inner->part.y_px_q16;
    words[DROGUE_HLS_R_INNER + 2] = (int32_t)inner->part.area_px;
    words[DROGUE_HLS_R_INNER + 3] = inner->part.spread_px_q16;
    words[DROGUE_HLS_R_INNER + 4] = inner->part.threshold;
    words[DROGUE_HLS_R_INNER + 5] = inner->part.contrast;
    words[DROGUE_HLS_R_INNER + 6] = inner->part.rays;
    drogue_hls_pack_pose(words + DROGUE_HLS_R_POSE, &r->pose);
    drogue_hls_pack_pose(words + DROGUE_HLS_R_ALTERNATIVE, &r->alternative);
    words[DROGUE_HLS_R_RESOLVED] = r->orientation_resolved;
    words[DROGUE_HLS_R_AMBIGUITY] = inner->ambiguity_q16;
    words[DROGUE_HLS_R_TOO_LARGE] = inner->too_large;
    words[DROGUE_HLS_R_DOUBT] = r->doubt_q16;
    words[DROGUE_HLS_R_HALVED] = r->covariance_halved;
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
static inline drogue_status solve(drogue_decision *out, drogue_inner_evidence *inner, drogue_evidence *evidence,
                                  const drogue_hls_parameters *p, const int32_t outline[DROGUE_HLS_OUTLINE_WORDS],
                                  const int32_t words[DROGUE_HLS_EDGE_WORDS])
{
    const drogue_setup setup = {&p->camera, &p->model, &p->config};
    if (p->model.inner_radius_m_q16 > 0 && words[DROGUE_HLS_E_STATUS] == DROGUE_OK) {
        const drogue_region region = {p->x_px, p->y_px, 0, 0};
        const drogue_ellipse ellipse = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_ELLIPSE);
        drogue_inner_expected expected;
        drogue_inner_edge edge;
        memset(&expected, 0, sizeof expected);
        expected.disc[0] = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED);
        expected.disc[1] = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_EXPECTED + 5);
        drogue_hls_unpack_edge_words(&edge, words);
        drogue_inner_weigh(inner, &edge, &region, &expected, &ellipse, evidence->poses, &setup);
        drogue_inner_testify(evidence, inner);
    }
    return drogue_decide(out, evidence, &setup);
}

void drogue_hls_pose(const int32_t parameters[DROGUE_HLS_PARAMETERS], const int32_t outline[DROGUE_HLS_OUTLINE_WORDS],
                     const int32_t edge[DROGUE_HLS_EDGE_WORDS], int32_t result[DROGUE_HLS_RESULT_WORDS],
                     int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS], int64_t std[DROGUE_HLS_STD_WORDS])
{
#ifndef __BAMBU__ /* registers; the other arrays are memory ports, which is the default */
#pragma HLS interface mode = s_axilite port = parameters
#pragma HLS interface mode = s_axilite port = outline
#pragma HLS interface mode = s_axilite port = edge
#pragma HLS interface mode = s_axilite port = result
#pragma HLS interface mode = s_axilite port = covariance
#pragma HLS interface mode = s_axilite port = std
#pragma HLS interface mode = s_axilite port = return
#endif
    drogue_hls_parameters p;
    drogue_support support;
    drogue_evidence evidence;
    drogue_inner_evidence found;
    drogue_decision out;
    uint32_t bits = (uint32_t)outline[DROGUE_HLS_O_STATUS];
    drogue_hls_unpack_parameters(&p, parameters);
    memset(&out, 0, sizeof out);
    memset(&found, 0, sizeof found);
    memset(&evidence, 0, sizeof evidence);
    found.ambiguity_q16 = DROGUE_Q16_ONE;
    if ((bits & DROGUE_HLS_STATUS) == DROGUE_OK) {
        evidence.ideal = drogue_hls_unpack_ellipse(outline + DROGUE_HLS_O_IDEAL);
        drogue_hls_unpack_pose(&evidence.poses[0], outline + DROGUE_HLS_O_POSES);
        drogue_hls_unpack_pose(&evidence.poses[1], outline + DROGUE_HLS_O_POSES + 8);
        get_support(&support, outline);
        evidence.support = &support;
        bits |= (uint32_t)solve(&out, &found, &evidence, &p, outline, edge);
    }
    result[DROGUE_HLS_R_STATUS] = (int32_t)bits;
    put(result, covariance, std, &found, &out);
}
