/* SPDX-License-Identifier: Apache-2.0 */
/* What the stage adapters refuse, that their guards work, and that the runner cannot pass with nothing run. */
#include "suite.h"

#include "drogue/smooth.h"

#include "conformance.h"

/* The build renames the library's smoothing in the adapters to this: it writes 'overrun' bytes too many. */
static size_t overrun_out;
static size_t overrun_column;

drogue_status drogue_smooth_image(uint8_t *out, uint16_t *column, const drogue_image *image)
{
    size_t count = (size_t)image->width_px * (size_t)image->height_px;
    memset(out, 7, count + overrun_out);
    memset(column, 7, (size_t)image->width_px * sizeof *column + overrun_column);
    return DROGUE_OK;
}

static conf_array words(const char *name, int bits, size_t count, const void *data)
{
    conf_array a = {name, bits, count, data, 0, 0};
    return a;
}

static conf_array image_of(const uint8_t *pixels, int32_t width_px, int32_t height_px)
{
    conf_array a = words("image", 8, (size_t)width_px * (size_t)height_px, pixels);
    a.width_px = width_px;
    a.height_px = height_px;
    return a;
}

static conf_array outputs[CONF_MAX_OUTPUTS];

static int run_stage(const char *stage, const conf_array *inputs, int count)
{
    return conf_run_stage(stage, inputs, count, outputs, CONF_MAX_OUTPUTS);
}

static uint8_t pixels[512 * 512];

START_TEST(guards_notice_one_byte)
{
    const int sides[] = {1, 7, 8, 16, 255};
    size_t i;
    for (i = 0; i < sizeof sides / sizeof sides[0]; i++) {
        conf_array in = image_of(pixels, sides[i], 3);
        overrun_out = overrun_column = 0;
        ck_assert_int_eq(run_stage("smooth", &in, 1), 1);
        ck_assert_int_eq(conf_word(&outputs[0], 0), 7);
        overrun_out = 1;
        ck_assert_int_eq(run_stage("smooth", &in, 1), CONF_E_GUARD);
        overrun_out = 0;
        overrun_column = 1;
        ck_assert_int_eq(run_stage("smooth", &in, 1), CONF_E_GUARD);
        overrun_column = 0;
    }
}
END_TEST

START_TEST(stages_refuse_no_inputs)
{
    conf_array in = words("nothing", 32, 0, pixels);
    int i;
    ck_assert_int_eq(conf_stage_count(), CONF_MAX_STAGES);
    for (i = 0; i < conf_stage_count(); i++) {
        ck_assert_int_eq(run_stage(conf_stage_name(i), &in, 0), CONF_E_MALFORMED);
        ck_assert_int_eq(run_stage(conf_stage_name(i), &in, 1), CONF_E_MALFORMED);
    }
    ck_assert_ptr_null(conf_stage_name(i));
    ck_assert_int_eq(run_stage("smoothe", &in, 1), CONF_E_MALFORMED);
}
END_TEST

START_TEST(stages_refuse_other_inputs)
{
    static const int32_t params[] = {40, 100, 1, 0};
    conf_array in[3];
    in[0] = image_of(pixels, 16, 16);
    in[1] = words("params", 32, 3, params);
    in[2] = in[1];
    ck_assert_int_eq(run_stage("canny", in, 2), 1);
    ck_assert_int_eq(run_stage("canny", in, 3), CONF_E_MALFORMED);
    ck_assert_int_eq(run_stage("canny", in, 1), CONF_E_MALFORMED);
    in[1].count = 4;
    ck_assert_int_eq(run_stage("canny", in, 2), CONF_E_MALFORMED);
    in[1] = words("param", 32, 3, params);
    ck_assert_int_eq(run_stage("canny", in, 2), CONF_E_MALFORMED);
    in[1] = words("params", 16, 3, params);
    ck_assert_int_eq(run_stage("canny", in, 2), CONF_E_MALFORMED);
    in[1] = words("params", 32, 3, params);
    in[0].count--;
    ck_assert_int_eq(run_stage("canny", in, 2), CONF_E_MALFORMED);
    in[0] = words("image", 8, 256, pixels);
    ck_assert_int_eq(run_stage("canny", in, 2), CONF_E_MALFORMED);
}
END_TEST

START_TEST(stages_refuse_words_out_of_range)
{
    static const int32_t thresholds[] = {100, 40, 1};
    static const int32_t far_mask[] = {8, 8, 0, 1 << 23, 8};
    static const int32_t no_mask[] = {0, 8, 0, 0, 8};
    static const int16_t points[] = {5, 4, 4, 4, 9, 5};
    static const int32_t arc[] = {9, 9, 9, 0, 0};
    static const int32_t no_class[] = {9, 9, 9, 4, 0};
    static const int64_t matrix[] = {0, 0, 0, 0, 0, (INT64_C(1) << 59) + 1};
    static const int32_t ellipse[] = {0, 0, 65536, 65536, 102945};
    static const int32_t quality[] = {65536, 65536, 0};
    static const int32_t camera[9] = {65536};
    conf_array in[3];
    in[0] = image_of(pixels, 8, 8);
    in[1] = words("params", 32, 3, thresholds);
    ck_assert_int_eq(run_stage("canny", in, 2), CONF_E_MALFORMED);
    in[0] = words("params", 32, 5, far_mask);
    ck_assert_int_eq(run_stage("mask", in, 1), CONF_E_MALFORMED);
    in[0] = words("params", 32, 5, no_mask);
    ck_assert_int_eq(run_stage("mask", in, 1), CONF_E_MALFORMED);
    in[0] = words("points", 16, 6, points); /* not in raster order */
    in[1] = words("params", 32, 5, arc);
    ck_assert_int_eq(run_stage("constraints", in, 2), CONF_E_MALFORMED);
    in[0] = words("points", 16, 4, points + 2);
    ck_assert_int_eq(run_stage("constraints", in, 2), 2);
    in[1] = words("params", 32, 5, no_class);
    ck_assert_int_eq(run_stage("constraints", in, 2), CONF_E_MALFORMED);
    in[0] = words("matrix", 64, 6, matrix);
    ck_assert_int_eq(run_stage("eigen", in, 1), CONF_E_MALFORMED);
    in[0] = words("ellipse", 32, 5, ellipse);
    in[1] = words("points", 32, 2, ellipse);
    in[2] = words("params", 32, 3, quality);
    ck_assert_int_eq(run_stage("quality", in, 3), CONF_E_MALFORMED);
    in[0] = words("camera", 32, 9, camera);
    ck_assert_int_eq(run_stage("undistort", in, 2), CONF_E_MALFORMED);
}
END_TEST

START_TEST(memory_holds_what_it_must)
{
    static const int32_t arcs[] = {0, 0, 0, 0, 0, 0, 0, 1};
    static const int32_t sizes[][2] = {{256, 256}, {2048, 3}, {3, 2048}, {1, 200}, {1, 1}};
    conf_array in[2];
    size_t i;
    uint64_t rng = 1;
    for (i = 0; i < sizeof pixels; i++) {
        pixels[i] = (uint8_t)rng_range(&rng, 0, 255);
    }
    in[1] = words("params", 32, 8, arcs);
    for (i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        in[0] = image_of(pixels, sizes[i][0], sizes[i][1]);
        ck_assert_int_eq(run_stage("smooth", in, 1), 1);
        ck_assert_int_eq(run_stage("gradient", in, 1), 2);
        ck_assert_int_eq(run_stage("arcs", in, 2), 2); /* noise without thresholds: tables full, or not */
    }
    in[0] = image_of(pixels, 512, 512);
    ck_assert_int_eq(run_stage("gradient", in, 1), CONF_E_MEMORY);
    ck_assert_int_eq(conf_run_stage("gradient", in, 1, outputs, 1), CONF_E_MEMORY);
}
END_TEST

START_TEST(words_are_extended)
{
    static const uint8_t bytes[] = {255};
    static const int16_t halves[] = {-2};
    static const int32_t singles[] = {INT32_MIN};
    static const int64_t doubles[] = {INT64_MIN};
    const conf_array grey = image_of(bytes, 1, 1);
    const conf_array a8 = words("a", 8, 1, bytes);
    const conf_array a16 = words("a", 16, 1, halves);
    const conf_array a32 = words("a", 32, 1, singles);
    const conf_array a64 = words("a", 64, 1, doubles);
    ck_assert_int_eq(conf_word(&grey, 0), 255);
    ck_assert_int_eq(conf_word(&a8, 0), -1);
    ck_assert_int_eq(conf_word(&a16, 0), -2);
    ck_assert_int_eq(conf_word(&a32, 0), INT32_MIN);
    ck_assert_int_eq(conf_word(&a64, 0), INT64_MIN);
}
END_TEST

static char report[4096];

static void put(const char *text) { strncat(report, text, sizeof report - strlen(report) - 1); }

START_TEST(nothing_run_is_a_failure)
{
    static conf_run run;
    conf_begin(&run, put);
    ck_assert_int_eq(conf_end(&run), 1);
    ck_assert_ptr_nonnull(strstr(report, "conformance: cases=0 exact=0 failed=0 digest=e3b0c442"));
}
END_TEST

/* The widest differences there are neither overflow nor pass. */
START_TEST(widest_difference_fails)
{
    static conf_run run;
    static const int16_t points[12] = {10, 10, 11, 10, 12, 11, 13, 12, 13, 13, 14, 14};
    static const int32_t params[5] = {40, 40, 64, 0, 1};
    static const int64_t low[1] = {INT64_MIN};
    static const uint64_t bound[] = {UINT32_MAX};
    const conf_array in[2] = {words("points", 16, 12, points), words("params", 32, 5, params)};
    const conf_expected expected = {{"distance2", 64, 1, low, 0, 0}, bound, 1};
    const conf_case c = {"constraints/a", "constraints", "ordinary", in, 2, &expected, 1, &expected, 0};
    report[0] = '\0';
    conf_begin(&run, put);
    conf_run_case(&run, &c);
    ck_assert_int_eq(conf_end(&run), 1);
    ck_assert_ptr_nonnull(strstr(report, "FAIL constraints/a: reference distance2 word 0: expected 8000000000000000 "
                                         "(-9223372036854775808), found 000000"));
    ck_assert_ptr_nonnull(strstr(report, "bound 4294967295, 1 of 1 words off"));
    ck_assert_ptr_nonnull(strstr(report, "FAIL constraints/a: exact verdict: not among the expected outputs"));
    ck_assert_ptr_nonnull(strstr(report, "cases=1 exact=0 failed=1"));
}
END_TEST

/* Every row has a unit, a base within what it grants, and a reason if it is open; no absolute one grants a quarter unit. */
START_TEST(no_measure_is_vacuous)
{
    int k;
    for (k = 0; k < CONF_MEASURES; k++) {
        const conf_measure *m = &conf_measures[k];
        if (m->kind == CONF_LSB) {
            ck_assert_uint_le(m->base_lsb, m->most);
            ck_assert_uint_lt(m->most, ((uint64_t)1 << m->q) / 4);
            ck_assert_uint_gt(strlen(m->unit), 0);
        } else if (m->kind == CONF_OF_ITSELF || m->kind == CONF_OF_SCALE) {
            ck_assert_uint_gt(m->most, 0);
            ck_assert_uint_lt(m->most, 50000); /* 5 % */
        } else {
            ck_assert_uint_eq(m->most + m->base_lsb, 0);
        }
        ck_assert(m->kind != CONF_UNREFERENCED || m->undefined != NULL);
    }
}
END_TEST

START_TEST(measures_follow_the_layout)
{
    static const int64_t matrix[15] = {100, 0, 400, 0, 0, 900, 0, 0, 0, 1600, 0, 0, 0, 0, INT64_MAX};
    const conf_array packed = words("covariance", 64, 15, matrix);
    const conf_measure *m = conf_measure_of("frame", "covariance", 14);
    size_t before = 0;
    ck_assert_uint_eq(conf_measure_period(&before, "quality", "quality"), 1);
    ck_assert_uint_eq(before, 2);
    ck_assert_int_eq(conf_measure_of("quality", "quality", 1)->letter, 'c');
    ck_assert_int_eq(conf_measure_of("quality", "quality", 11)->letter, 'r');
    ck_assert_int_eq(conf_measure_of("undistort", "distorted", 3 * 70)->kind, CONF_EXACT);
    ck_assert_int_eq(conf_measure_of("undistort", "distorted", 3 * 70 + 2)->letter, 'p');
    ck_assert_ptr_null(conf_measure_of("ellipse", "ellipse", 6)); /* it has six words */
    ck_assert_ptr_null(conf_measure_of("ellipse", "circle", 0));
    ck_assert_ptr_null(conf_measure_of("ellipses", "ellipse", 0));
    ck_assert_uint_eq(conf_measure_whole(m, &packed, 3), 10 * 30); /* row 2, column 0 */
    ck_assert_uint_eq(conf_measure_whole(m, &packed, 8), 40 * 30);
    ck_assert_uint_eq(conf_measure_whole(m, &packed, 14), 3037000499u * UINT64_C(3037000499)); /* root of 2^63 */
    ck_assert_uint_eq(conf_measure_widest(m, &packed, 3), m->base_lsb + (300 * (uint64_t)m->most + 999999) / 1000000);
}
END_TEST

SUITE_MAIN("runner", guards_notice_one_byte, stages_refuse_no_inputs, stages_refuse_other_inputs,
           stages_refuse_words_out_of_range, memory_holds_what_it_must, words_are_extended, nothing_run_is_a_failure,
           widest_difference_fails, no_measure_is_vacuous, measures_follow_the_layout)
