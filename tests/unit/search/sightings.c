/* SPDX-License-Identifier: Apache-2.0 */
/* The list of the best sightings. */
#include "sightings.h"

#include "suite.h"

static drogue_sighting about(int32_t radius_px, uint32_t score)
{
    drogue_sighting s;
    memset(&s, 0, sizeof s);
    s.radius_px = radius_px;
    s.score = score;
    return s;
}

/* 100 and 120 px are of one outline, 120 and 144 px are, 100 and 144 px are not: what is not kept for a better one puts
 * out none of the others. */
START_TEST(what_is_not_kept_puts_out_nothing)
{
    static const struct {
        int order[3];
        int32_t kept;
    } cases[6] = {{{0, 1, 2}, 2}, {{0, 2, 1}, 1}, {{1, 0, 2}, 2}, {{1, 2, 0}, 2}, {{2, 0, 1}, 1}, {{2, 1, 0}, 2}};
    const drogue_sighting s[3] = {about(100, 500), about(144, 900), about(120, 700)};
    int k;
    for (k = 0; k < 6; k++) {
        drogue_sighting best[4];
        int32_t count = 0;
        int i;
        for (i = 0; i < 3; i++) {
            drogue_sightings_keep(best, &count, 4, &s[cases[k].order[i]]);
        }
        drogue_sightings_sort(best, count);
        MUST(count == cases[k].kept && best[0].radius_px == 144 && (count == 1 || best[1].radius_px == 100),
             "order %d: %d", k, (int)count);
    }
}
END_TEST

START_TEST(the_least_gives_way)
{
    drogue_sighting best[2];
    int32_t count = 0;
    const drogue_sighting s[4] = {about(100, 5), about(200, 7), about(400, 5), about(400, 6)};
    drogue_sightings_keep(best, &count, 2, &s[0]);
    ck_assert_uint_eq(drogue_sightings_least(best, count, 2), 0);
    drogue_sightings_keep(best, &count, 2, &s[1]);
    ck_assert_uint_eq(drogue_sightings_least(best, count, 2), 5);
    drogue_sightings_keep(best, &count, 2, &s[2]); /* no more than the least */
    drogue_sightings_sort(best, count);
    ck_assert_int_eq(best[1].radius_px, 100);
    drogue_sightings_keep(best, &count, 2, &s[3]);
    drogue_sightings_sort(best, count);
    ck_assert_int_eq(best[1].radius_px, 400);
    ck_assert_int_eq(count, 2);
}
END_TEST

SUITE_MAIN("sightings", what_is_not_kept_puts_out_nothing, the_least_gives_way)
