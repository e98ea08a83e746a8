/* SPDX-License-Identifier: Apache-2.0 */
/* Names of statuses: each has its own, every other value is "unknown". */
#include "suite.h"

#include "drogue/status.h"

START_TEST(names_are_the_documented_ones)
{
    static const char *const names[DROGUE_STATUS_COUNT] = {"ok",
                                                           "argument",
                                                           "region",
                                                           "workspace",
                                                           "labels_full",
                                                           "edges_full",
                                                           "arcs_full",
                                                           "no_edges",
                                                           "no_arcs",
                                                           "no_ellipse",
                                                           "too_few_points",
                                                           "degenerate",
                                                           "no_inner_part",
                                                           "domain",
                                                           "behind_camera",
                                                           "unsure"};
    int i;
    for (i = 0; i < (int)DROGUE_STATUS_COUNT; i++) {
        ck_assert_str_eq(drogue_status_name((drogue_status)i), names[i]);
    }
}
END_TEST

START_TEST(other_values_are_unknown)
{
    ck_assert_str_eq(drogue_status_name(DROGUE_STATUS_COUNT), "unknown");
    ck_assert_str_eq(drogue_status_name((drogue_status)((int)DROGUE_STATUS_COUNT + 1)), "unknown");
    ck_assert_str_eq(drogue_status_name((drogue_status)INT32_MAX), "unknown");
}
END_TEST

START_TEST(second_looks)
{
    static const char *const names[DROGUE_SECOND_COUNT] = {"none",     "better", "no_more", "region",
                                                           "too_wide", "full",   "room"};
    int i;
    for (i = 0; i < (int)DROGUE_SECOND_COUNT; i++) {
        ck_assert_str_eq(drogue_second_look_name((drogue_second_look)i), names[i]);
    }
    ck_assert_str_eq(drogue_second_look_name(DROGUE_SECOND_COUNT), "unknown");
    ck_assert_str_eq(drogue_second_look_name((drogue_second_look)INT32_MAX), "unknown");
}
END_TEST

SUITE_MAIN("status", names_are_the_documented_ones, other_values_are_unknown, second_looks)
