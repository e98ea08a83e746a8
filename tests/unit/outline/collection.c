/* SPDX-License-Identifier: Apache-2.0 */
/* The unit of a collection, and the band for the next one. */
#include "suite.h"

#include "../../../src/outline/collection.h"

/* A unit that holds the reach, down to whole pixels; a band is as wide as what lies in it is scattered, and where nothing
 * does as narrow as it may be. */
START_TEST(units_and_bands)
{
    static const struct {
        int64_t reach;
        int bits;
    } cases[] = {{32768, 10},
                 {INT64_C(32) << 16, 9},
                 {INT64_C(2047) << 16, 4},
                 {INT64_C(32767) << 16, 0},
                 {INT64_C(40000) << 16, 0}};
    const drogue_ellipse e = {q16_of(40), q16_of(41), q16_of(20), q16_of(20), 0};
    drogue_config config;
    drogue_collection c;
    drogue_support s;
    drogue_band band;
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        drogue_collection_begin(&c, &e, cases[i].reach);
        MUST((int)c.frac_bits == cases[i].bits, "case %d: %d bits", (int)i, (int)c.frac_bits);
    }
    drogue_config_default(&config);
    memset(&s, 0, sizeof s);
    band = drogue_band_of(DROGUE_Q16(4, 1), config.refit_cos_q16);
    s.points = 100; /* 0.04 semi-axes of scatter each, 0.8 px: three of them */
    s.squares_q32 = (int64_t)(100 * 0.04 * 0.04 * 4294967296.0);
    drogue_band_narrow(&band, &s, &e, &config);
    ck_assert_int_lt(abs(band.half_width_px_q16 - DROGUE_Q16(24, 10)), 100);
    s.points = 0;
    s.squares_q32 = 0;
    drogue_band_narrow(&band, &s, &e, &config);
    ck_assert_int_eq(band.half_width_px_q16, config.refit_band_px_q16 / 3 + 1);
}
END_TEST

SUITE_MAIN("collection", units_and_bands)
