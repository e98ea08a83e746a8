/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for edge points: the library's own functions, of which unit.sh makes Verilog. */
#include "points_unit.h"

static inline int32_t x_q5_of(uint32_t place) { return (int32_t)(place & 0xFFFFu); }
static inline int32_t y_q5_of(uint32_t place) { return (int32_t)(place >> 16); }

void points_unit_place(const points_asked *restrict asked, points_said *restrict out)
{
    const points_asked a = *asked;
    const drogue_q16 x_px_q16 = x_q5_of(a.place) * 2048;
    const drogue_q16 y_px_q16 = y_q5_of(a.place) * 2048;
    const band_place p = place_of(&a.frame, x_px_q16, y_px_q16);
    const uint32_t near =
        (uint32_t)(!far_off(p.nx_q46) & !far_off(p.ny_q46) &
                   (int)near_form(&a.frame, size_q38_of(&p, q22_of_q46(p.nx_q46), q22_of_q46(p.ny_q46)),
                                  a.most_px_q16));
    uint32_t word = near << POINT_NEAR;
    band_point q;
    if (band_holds(&q, &a.frame, &a.band, &a.reach, x_px_q16, y_px_q16, (int16_t)a.gradient,
                   (int16_t)(a.gradient >> 16))) {
        word |= 1u << POINT_HELD | (uint32_t)q.polarity << POINT_POLARITY | bin_of(q.u_q14, q.v_q14) << POINT_BIN |
                ((uint32_t)q.offset_q16 & ((1u << POINT_BIN) - 1));
    }
    out->word = word;
    out->place = a.place;
    out->gradient = a.gradient;
}

void points_unit_count(const count_asked *restrict asked, count_said *restrict out)
{
    const count_asked a = *asked;
    const uint32_t polarity = a.word >> POINT_POLARITY & 1u;
    const uint32_t bright_bin = a.bright_bins >> (a.word >> POINT_BIN & (DROGUE_SUPPORT_BINS - 1)) & 1u;
    const int32_t offset_q16 = (int32_t)(a.word << (32 - POINT_BIN)) >> (32 - POINT_BIN);
    drogue_support_bin bin = {{a.count, 0}, a.sum_q16}; /* the first count is that of the point's polarity */
    support_sums sums = {a.squares_q32, a.gradient, a.points};
    out->own = add_to_support(&bin, &sums, 1, bright_bin ^ polarity, offset_q16, (drogue_polarity)0,
                              (int16_t)a.point_gradient, (int16_t)(a.point_gradient >> 16));
    out->squares_q32 = sums.squares_q32;
    out->gradient = sums.gradient;
    out->points = sums.points;
    out->count = bin.count[0];
    out->sum_q16 = bin.sum_q16;
}

void points_unit_moments(const moments_asked *restrict asked, drogue_moments *restrict out)
{
    const moments_asked a = *asked;
    drogue_moments m = a.moments;
    drogue_moments_count_point(&m, (int16_t)(x_q5_of(a.place) - DROGUE_MIDDLE_Q5), /* they have 16 bits */
                               (int16_t)(y_q5_of(a.place) - DROGUE_MIDDLE_Q5), a.out_of ? -1 : 1);
    *out = m;
}
