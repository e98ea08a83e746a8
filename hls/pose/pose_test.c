/* SPDX-License-Identifier: Apache-2.0 */
/* Test bench of drogue_hls_pose(): front end, outline and inner disc of every frame vector by the library; each word that
 * the top gives is compared with the library's functions, and the whole with the vector's where that is what the library
 * found at its first look. */
#include "frame.h"
#include "sim.h"

#include <stdio.h>

static int32_t parameters[DROGUE_HLS_PARAMETERS];
static int32_t dark[DROGUE_HLS_EDGE_WORDS];
static int32_t too_large; /* what drogue_inner_weigh() says */
static int32_t result[DROGUE_HLS_RESULT_WORDS];
static int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS];
static int64_t std_q32[DROGUE_HLS_STD_WORDS];

/* The library's second half. */
static void find_pose(frame *f)
{
    const drogue_setup setup = {&f->p.camera, &f->p.model, &f->p.config};
    drogue_inner_evidence inner;
    drogue_evidence evidence;
    drogue_decision decision;
    drogue_result *r = &f->result;
    drogue_status status;
    too_large = 0;
    if (r->status != DROGUE_OK) {
        return;
    }
    memset(&evidence, 0, sizeof evidence);
    evidence.ideal = r->ideal;
    evidence.support = &f->outline.support;
    drogue_hls_unpack_pose(&evidence.poses[0], f->words + DROGUE_HLS_O_POSES);
    drogue_hls_unpack_pose(&evidence.poses[1], f->words + DROGUE_HLS_O_POSES + 8);
    memset(&inner, 0, sizeof inner);
    status = f->p.model.inner_radius_m_q16 > 0 ? (drogue_status)dark[DROGUE_HLS_E_STATUS] : DROGUE_E_NO_INNER_PART;
    if (status == DROGUE_OK) {
        drogue_inner_expected expected;
        drogue_inner_edge edge;
        memset(&expected, 0, sizeof expected);
        expected.disc[0] = drogue_hls_unpack_ellipse(f->words + DROGUE_HLS_O_EXPECTED);
        expected.disc[1] = drogue_hls_unpack_ellipse(f->words + DROGUE_HLS_O_EXPECTED + 5);
        drogue_hls_unpack_edge_words(&edge, dark);
        drogue_inner_weigh(&inner, &edge, &f->region, &expected, &f->outline.ellipse, evidence.poses, &setup);
        drogue_inner_testify(&evidence, &inner);
        r->inner = inner.part;
        r->has_inner = inner.weighed.std_px_q16 > 0;
        r->ambiguity_q16 = inner.ambiguity_q16;
        too_large = inner.too_large;
    }
    r->status = status == DROGUE_E_NO_INNER_PART ? DROGUE_OK : status;
    if (r->status == DROGUE_OK) {
        r->status = drogue_decide(&decision, &evidence, &setup);
    }
    if (r->status == DROGUE_OK) {
        r->pose = decision.pose;
        r->alternative = decision.alternative;
        r->orientation_resolved = decision.orientation_resolved;
        memcpy(r->covariance_q48, decision.covariance_q48, sizeof r->covariance_q48);
        r->covariance_halved = decision.covariance_halved;
        memcpy(r->position_std_m_q32, decision.position_std_m_q32, sizeof r->position_std_m_q32);
        r->axis_std_rad_q32 = decision.axis_std_rad_q32;
        r->doubt_q16 = decision.doubt_q16;
    }
}

static void compare(bench *b, const drogue_result *r)
{
    int32_t expected[DROGUE_HLS_RESULT_WORDS];
    int i;
    int j;
    memset(expected, 0, sizeof expected);
    expected[DROGUE_HLS_R_STATUS] = (int32_t)r->status;
    expected[DROGUE_HLS_R_HAS_INNER] = r->has_inner;
    expected[DROGUE_HLS_R_INNER] = r->inner.x_px_q16;
    expected[DROGUE_HLS_R_INNER + 1] = r->inner.y_px_q16;
    expected[DROGUE_HLS_R_INNER + 2] = (int32_t)r->inner.area_px;
    expected[DROGUE_HLS_R_INNER + 3] = r->inner.spread_px_q16;
    expected[DROGUE_HLS_R_INNER + 4] = r->inner.threshold;
    expected[DROGUE_HLS_R_INNER + 5] = r->inner.contrast;
    expected[DROGUE_HLS_R_INNER + 6] = r->inner.rays;
    drogue_hls_pack_pose(expected + DROGUE_HLS_R_POSE, &r->pose);
    drogue_hls_pack_pose(expected + DROGUE_HLS_R_ALTERNATIVE, &r->alternative);
    expected[DROGUE_HLS_R_RESOLVED] = r->orientation_resolved;
    expected[DROGUE_HLS_R_AMBIGUITY] = r->ambiguity_q16;
    expected[DROGUE_HLS_R_TOO_LARGE] = too_large;
    expected[DROGUE_HLS_R_DOUBT] = r->doubt_q16;
    expected[DROGUE_HLS_R_HALVED] = r->covariance_halved;
    for (i = 0; i < DROGUE_HLS_RESULT_WORDS; i++) {
        (void)bench_word(b, "result", result[i], expected[i]);
    }
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            (void)bench_word(b, "covariance", covariance[i * (i + 1) / 2 + j], r->covariance_q48[i][j]);
        }
    }
    for (i = 0; i < 3; i++) {
        (void)bench_word(b, "std", std_q32[i], r->position_std_m_q32[i]);
    }
    (void)bench_word(b, "std", std_q32[3], r->axis_std_rad_q32);
}

/* The words of a frame vector from those of the tops. */
static void frame_words(int32_t words[38], const frame *f)
{
    const int32_t *o = f->words;
    drogue_ellipse e = drogue_hls_unpack_ellipse(o + DROGUE_HLS_O_ELLIPSE);
    int k;
    memset(words, 0, 38 * sizeof *words);
    words[0] = result[DROGUE_HLS_R_STATUS];
    if (o[DROGUE_HLS_O_FOUND] == DROGUE_OK) {
        e.xc_px_q16 += f->p.x_px * DROGUE_Q16_ONE;
        e.yc_px_q16 += f->p.y_px * DROGUE_Q16_ONE;
        drogue_hls_pack_ellipse(words + 1, &e);
        memcpy(words + 6, o + DROGUE_HLS_O_IDEAL, 5 * sizeof *words);
        words[11] = o[DROGUE_HLS_O_POLARITY];
        for (k = 0; k < 4; k++) {
            words[12] |= o[DROGUE_HLS_O_ARCS + k] >= 0 ? 1 << k : 0;
        }
        words[13] = o[DROGUE_HLS_O_REFIT_POINTS];
    }
    words[14] = result[DROGUE_HLS_R_HAS_INNER];
    memcpy(words + 15, result + DROGUE_HLS_R_INNER, 3 * sizeof *words);
    words[18] = result[DROGUE_HLS_R_INNER + 4];
    words[19] = result[DROGUE_HLS_R_INNER + 3];
    memcpy(words + 20, result + DROGUE_HLS_R_POSE, 18 * sizeof *words);
}

static void detail_words(int32_t words[20], const frame *f)
{
    const int32_t *o = f->words;
    const int found = o[DROGUE_HLS_O_FOUND] == DROGUE_OK;
    memset(words, 0, 20 * sizeof *words);
    memset(words + 6, 0xFF, 4 * sizeof *words);
    words[0] = f->region.x_px;
    words[1] = f->region.y_px;
    words[2] = f->region.width_px;
    words[3] = f->region.height_px;
    words[4] = (int32_t)f->list.edge_count;
    words[5] = (int32_t)f->list.arc_count;
    if (found) {
        memcpy(words + 6, o + DROGUE_HLS_O_ARCS, 4 * sizeof *words);
        memcpy(words + 10, o + DROGUE_HLS_O_QUALITY, 5 * sizeof *words);
        words[15] = o[DROGUE_HLS_O_CLUSTER_MEMBERS];
        words[16] = o[DROGUE_HLS_O_COVER];
        words[17] = result[DROGUE_HLS_R_DOUBT];
        words[18] = o[DROGUE_HLS_O_OUTSIDE];
        words[19] = result[DROGUE_HLS_R_INNER + 6];
    }
}

/* Is what the vector expects that of the region asked for, not of another one that the library looked at after it? */
static int first_look(const frame *f, const conf_case *c)
{
    const int32_t *region = bench_words32(bench_expected(c, "detail"));
    return frame_tried(f) <= DROGUE_TRIED_FOUND && region[0] == f->region.x_px && region[1] == f->region.y_px &&
           region[2] == f->region.width_px && region[3] == f->region.height_px;
}

/* An outline without an inner part may be refused for a disc elsewhere, after the pose: by the library alone. */
static int refused_after(const frame *f, const conf_case *c)
{
    return bench_words32(bench_expected(c, "frame"))[0] == DROGUE_E_NO_ELLIPSE && f->result.status == DROGUE_OK &&
           !f->result.has_inner;
}

/* Against the vector; 0 where it says nothing about the first look. */
static int judge(bench *b, const frame *f, const conf_case *c)
{
    int32_t words[38];
    int32_t detail[20];
    const int refused = f->result.status == DROGUE_E_ARGUMENT;
    if (drogue_status_full(f->front) || (!refused && !first_look(f, c)) || refused_after(f, c)) {
        return 0;
    }
    frame_words(words, f);
    detail_words(detail, f);
    (void)bench_words(b, "frame", words, bench_expected(c, "frame"));
    if (!refused) { /* drogue_measure() refuses before the front end has counted anything */
        if (f->words[DROGUE_HLS_O_FOUND] != DROGUE_OK) { /* the edges and arcs are those of the library's last try */
            memcpy(detail + 4, bench_words32(bench_expected(c, "detail")) + 4, 2 * sizeof *detail);
        }
        (void)bench_words(b, "detail", detail, bench_expected(c, "detail"));
    }
    (void)bench_words(b, "covariance", covariance, bench_expected(c, "covariance"));
    (void)bench_words(b, "std", std_q32, bench_expected(c, "std"));
    return 1;
}

static void call(frame *f)
{
    int32_t *outline = f->words;
    memset(result, 0x55, sizeof result);
    memset(covariance, 0x55, sizeof covariance);
    memset(std_q32, 0x55, sizeof std_q32);
    drogue_hls_pack_parameters(parameters, &f->p);
    SIM_ARRAY(0, parameters);
    SIM_ARRAY(1, f->words);
    SIM_ARRAY(2, dark);
    SIM_ARRAY(3, result);
    SIM_ARRAY(4, covariance);
    SIM_ARRAY(5, std_q32);
    drogue_hls_pose(parameters, outline, dark, result, covariance, std_q32);
}

int main(void)
{
    static frame f;
    const conf_case *c;
    int judged = 0;
    bench b;
    bench_begin(&b, "pose");
    while ((c = bench_next(&b, "frame")) != NULL) {
        if (!frame_read(&f, c)) {
            bench_skip(&b, "no region within the image and the blocks");
            continue;
        }
        frame_run_frontend(&f);
        frame_find_outline(&f);
        f.result.ambiguity_q16 = DROGUE_Q16_ONE;
        f.result.region = f.region;
        frame_find_inner(dark, &f);
        call(&f);
        find_pose(&f);
        compare(&b, &f.result);
        judged += judge(&b, &f, c);
    }
    printf("pose: %d frames compared with the vectors' words too\n", judged);
    (void)bench_check(&b, "frames compared with the vectors", judged > 0);
    return bench_end(&b);
}
