/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of the stages from points to the chosen ellipse: constraints, select, ellipse, quality, cluster, eigen. */
#include "stage_run.h"

#include <string.h>

#include "drogue/eigen.h"
#include "drogue/ellipse.h"

/* Points as an arc of edge points; 0 when they leave the region or raster order. */
static int edges_of_points(drogue_edge *edges, const int16_t *points, size_t count)
{
    size_t i;
    int64_t last = -1;
    for (i = 0; i < count; i++) {
        int32_t x = points[2 * i];
        int32_t y = points[2 * i + 1];
        int64_t place = (int64_t)y * DROGUE_MAX_SIDE + x;
        if (x < 0 || x >= DROGUE_MAX_SIDE || y < 0 || y >= DROGUE_MAX_SIDE || place <= last) {
            return 0;
        }
        last = place;
        memset(&edges[i], 0, sizeof edges[i]);
        edges[i].x_q5 = (uint16_t)(32 * x);
        edges[i].y_q5 = (uint16_t)(32 * y);
    }
    return 1;
}

int stage_constraints(stage_run *r)
{
    size_t count = r->in[0].count / 2;
    const int32_t *p = stage_input32(r, 1);
    int32_t *out = stage_output32(r, "verdict", 6);
    int64_t *distance2 = (int64_t *)stage_output(r, "distance2", 64, 1);
    drogue_edge *edges = (drogue_edge *)stage_take(r, count * sizeof *edges);
    drogue_point *hull = (drogue_point *)stage_take(r, DROGUE_HULL_MAX * sizeof *hull);
    drogue_arc arc = {0, 0, 0};
    drogue_arc_verdict verdict;
    drogue_mask mask;
    if (out == NULL || distance2 == NULL || edges == NULL || hull == NULL) {
        return CONF_E_MEMORY;
    }
    if (count == 0 || !(stage_mask(&mask, p) && drogue_mask_valid(&mask)) || p[3] < 0 || p[3] > 3 ||
        !edges_of_points(edges, (const int16_t *)r->in[0].data, count)) {
        return CONF_E_MALFORMED;
    }
    arc.count = (uint32_t)count;
    arc.direction = (uint32_t)p[3];
    drogue_judge_arc(&verdict, hull, edges, &arc, &mask, p[4]);
    out[0] = verdict.rect.xc_px_q16;
    out[1] = verdict.rect.yc_px_q16;
    out[2] = verdict.rect.short_px_q16;
    out[3] = verdict.rect.long_px_q16;
    out[4] = verdict.quadrant;
    out[5] = (int32_t)verdict.polarity;
    distance2[0] = verdict.distance2_q32;
    return 0;
}

/* Edge points and table of arcs from their points, one arc after the other, and 'count class' of each. */
static int arcs_of_words(drogue_arc *arcs, drogue_edge *edges, const int16_t *points, size_t point_count,
                         const int32_t *words, size_t arc_count)
{
    size_t first = 0;
    size_t i;
    for (i = 0; i < arc_count; i++) {
        const size_t count = words[2 * i] > 0 ? (size_t)words[2 * i] : 0;
        if (count == 0 || count > point_count - first || words[2 * i + 1] < 0 || words[2 * i + 1] > 3 ||
            !edges_of_points(edges + first, points + 2 * first, count)) {
            return 0;
        }
        arcs[i].first = (uint32_t)first;
        arcs[i].count = (uint32_t)count;
        arcs[i].direction = (uint32_t)words[2 * i + 1];
        first += count;
    }
    return first == point_count;
}

int stage_select(stage_run *r)
{
    const size_t points = r->in[0].count / 2;
    const size_t count = r->in[1].count / 2;
    const int32_t *p = stage_input32(r, 2);
    int32_t *out = stage_output32(r, "choices", 1 + 4 * DROGUE_ARC_CHOICES);
    drogue_edge *edges = (drogue_edge *)stage_take(r, points * sizeof *edges);
    drogue_arc *arcs = (drogue_arc *)stage_take(r, count * sizeof *arcs);
    drogue_point *hull = (drogue_point *)stage_take(r, DROGUE_HULL_MAX * sizeof *hull);
    drogue_arc_choices choices;
    drogue_mask mask;
    int k;
    if (out == NULL || edges == NULL || arcs == NULL || hull == NULL) {
        return CONF_E_MEMORY;
    }
    if (!(stage_mask(&mask, p) && drogue_mask_valid(&mask)) || p[4] < 0 || p[4] > 2 ||
        !arcs_of_words(arcs, edges, (const int16_t *)r->in[0].data, points, stage_input32(r, 1), count)) {
        return CONF_E_MALFORMED;
    }
    *out++ =
        (int32_t)drogue_select_arcs(&choices, hull, edges, arcs, (uint32_t)count, &mask, p[3], (drogue_polarity)p[4]);
    for (k = 0; k < 4 * DROGUE_ARC_CHOICES; k++) {
        const uint32_t arc = choices.arc[k / DROGUE_ARC_CHOICES][k % DROGUE_ARC_CHOICES];
        *out++ = arc == DROGUE_NO_ARC ? -1 : (int32_t)arc;
    }
    return 0;
}

int stage_ellipse_fit(stage_run *r)
{
    const int16_t *points = (const int16_t *)r->in[0].data;
    size_t count = r->in[0].count / 2;
    int32_t *out = stage_output32(r, "ellipse", 6);
    drogue_moments moments;
    drogue_ellipse ellipse;
    size_t i;
    if (out == NULL) {
        return CONF_E_MEMORY;
    }
    if (count > (size_t)DROGUE_MAX_FIT_POINTS + 1) { /* one too many is refused by the library, sums hold it */
        return CONF_E_MALFORMED;
    }
    drogue_moments_clear(&moments);
    for (i = 0; i < count; i++) {
        drogue_moments_add_point(&moments, points[2 * i], points[2 * i + 1]);
    }
    out[0] = (int32_t)drogue_ellipse_fit(&ellipse, &moments, stage_input32(r, 1)[0]);
    if (out[0] == DROGUE_OK) {
        (void)stage_put_ellipse(out + 1, &ellipse);
    }
    return 0;
}

int stage_quality(stage_run *r)
{
    const drogue_ellipse ellipse = stage_ellipse(stage_input32(r, 0));
    const int32_t *points = stage_input32(r, 1);
    const int32_t *p = stage_input32(r, 2);
    size_t count = r->in[1].count / 2;
    int32_t *out = stage_output32(r, "quality", count + 7);
    int32_t *status = stage_output32(r, "status", 1);
    drogue_quality_config config;
    drogue_ellipse_frame frame;
    drogue_quality quality;
    drogue_q16 threshold;
    uint32_t near_count = 0;
    size_t i;
    if (out == NULL || status == NULL) {
        return CONF_E_MEMORY;
    }
    config.fit_error_px_q16 = p[0];
    config.k1_q16 = p[1];
    config.k2_q16 = p[2];
    if (count == 0 || p[0] < 0 || p[1] < 0 || p[1] > 64 * DROGUE_Q16_ONE || p[2] < 0 || p[2] >= DROGUE_Q16_ONE ||
        ellipse.a_px_q16 < 0 || ellipse.b_px_q16 < 0 || !stage_angle_valid(&ellipse)) {
        return CONF_E_MALFORMED;
    }
    *status = (int32_t)drogue_ellipse_frame_of(&frame, &ellipse);
    threshold = drogue_quality_threshold(&ellipse, config.fit_error_px_q16);
    *out++ = threshold;
    *out++ = drogue_ellipse_circumference(&ellipse);
    for (i = 0; i < count && *status == DROGUE_OK; i++) {
        out[i] = drogue_ellipse_deviation(&frame, points[2 * i], points[2 * i + 1]);
        near_count += out[i] < threshold;
    }
    out += count;
    drogue_quality_score(&quality, &ellipse, near_count, (uint32_t)count, &config);
    out[0] = quality.fit_ratio_q16;
    out[1] = quality.length_ratio_q16;
    out[2] = quality.axis_ratio_q16;
    out[3] = quality.score_q16;
    out[4] = quality.reliability_q16;
    return 0;
}

int stage_cluster(stage_run *r)
{
    const int32_t *w = stage_input32(r, 0);
    const int32_t *p = stage_input32(r, 1);
    size_t count = r->in[0].count / 7;
    int32_t *out = stage_output32(r, "winner", 2);
    drogue_candidate candidates[CONF_MAX_CANDIDATES];
    drogue_cluster_config config;
    uint32_t members;
    size_t i;
    if (out == NULL || count > CONF_MAX_CANDIDATES) {
        return CONF_E_MEMORY;
    }
    for (i = 0; i < count; i++, w += 7) {
        candidates[i].ellipse = stage_ellipse(w);
        candidates[i].reliability_q16 = w[5];
        candidates[i].polarity = (uint32_t)w[6];
        candidates[i].arcs = 0;
    }
    config.centre_px_q16 = p[0];
    config.a_px_q16 = p[1];
    config.b_px_q16 = p[2];
    config.angle_rad_q16 = p[3];
    config.round_q16 = p[4];
    out[0] = drogue_cluster_best(&members, candidates, (uint32_t)count, &config);
    out[1] = (int32_t)members;
    return 0;
}

int stage_eigen(stage_run *r)
{
    const int64_t *w = (const int64_t *)r->in[0].data;
    int32_t *values = stage_output32(r, "values", 3);
    int32_t *vectors = stage_output32(r, "vectors", 9);
    int32_t *full = stage_output32(r, "full", 6);
    const int64_t most = INT64_C(1) << 59;
    drogue_real matrix[6];
    drogue_eigen3 eigen;
    int i;
    if (values == NULL || vectors == NULL || full == NULL) {
        return CONF_E_MEMORY;
    }
    for (i = 0; i < 6; i++) {
        drogue_real_set(&matrix[i], w[i], -60);
        if (w[i] < -most || w[i] > most) {
            return CONF_E_MALFORMED;
        }
    }
    (void)drogue_eigen_sym3(&eigen, matrix);
    for (i = 0; i < 3; i++) {
        full[2 * i] = eigen.value[i].mantissa;
        full[2 * i + 1] = eigen.value[i].exponent;
        values[i] = drogue_real_to_s32(eigen.value[i], 30);
    }
    for (i = 0; i < 9; i++) {
        vectors[i] = eigen.vector_q30[i / 3][i % 3];
    }
    return 0;
}
