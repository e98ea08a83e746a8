/* SPDX-License-Identifier: Apache-2.0 */
/* Edge points near an ellipse by the unit beside the soft core, in the place of the library's src/outline/near.c; the same sums. */
#include "points_unit.h"

#include <string.h>

#include "unit.h"

/* The words of points_asked up to the point. */
static inline void tell(const drogue_ellipse_frame *frame, const drogue_band *band, band_reach reach,
                        drogue_q16 most_px_q16)
{
    const int32_t *word = (const int32_t *)frame;
    uint32_t none;
    int i;
    for (i = 0; i + 1 < (int)(sizeof *frame / sizeof *word); i += 2) {
        UNIT(none, UNIT_TELL, 0, word[i], word[i + 1]);
    }
    UNIT(none, UNIT_TELL, 0, word[i], band->half_width_px_q16);
    UNIT(none, UNIT_TELL, 0, band->width2_px2_q24, band->cos2_q10);
    UNIT(none, UNIT_TELL, 0, reach.least_px_q16, reach.range_px_q16);
    UNIT(none, UNIT_TELL, 0, most_px_q16, 0);
    (void)none;
}

/* Its place, then its gradient. */
static inline void words_of(uint32_t word[2], const drogue_edge *e)
{
    memcpy(word, __builtin_assume_aligned(&e->x_q5, 4), 8); /* two loads */
}

/* Points, as UNIT_PLACE has them; 'what' is a part of the instruction. Two a turn: the unit takes one in eight clocks. */
static inline __attribute__((always_inline)) void place(const drogue_edge *edges, uint32_t count, uint32_t stride,
                                                        const int what)
{
    int32_t left = (int32_t)count;
    uint32_t none;
    for (; left > (int32_t)stride; left -= 2 * (int32_t)stride) {
        uint32_t word[2];
        uint32_t next[2];
        words_of(word, edges);
        words_of(next, edges + stride);
        edges += 2 * stride;
        UNIT(none, UNIT_PLACE, what, word[0], word[1]);
        UNIT(none, UNIT_PLACE, what, next[0], next[1]);
    }
    if (left > 0) {
        uint32_t word[2];
        words_of(word, edges);
        UNIT(none, UNIT_PLACE, what, word[0], word[1]);
    }
    (void)none;
}

static inline void add(const drogue_edge *e, uint32_t out_of)
{
    uint32_t none;
    uint32_t word[2];
    words_of(word, e);
    UNIT(none, UNIT_ADD, 0, word[0], out_of);
    (void)none;
}

static void clear(void)
{
    uint32_t none;
    UNIT(none, UNIT_CLEAR, 0, 0, 0);
    (void)none;
}

/* Add the unit's moments. */
static void add_moments(drogue_moments *m)
{
    int64_t *sum = (int64_t *)(void *)m;
    size_t i;
    for (i = 0; i < sizeof *m / sizeof *sum; i += 2) { /* an even number of them */
        uint32_t low;
        uint32_t high;
        uint32_t next_low;
        uint32_t next_high;
        UNIT(low, UNIT_MOMENTS, 0, 0, 0);
        UNIT(high, UNIT_MOMENTS, 0, 0, 0);
        UNIT(next_low, UNIT_MOMENTS, 0, 0, 0);
        UNIT(next_high, UNIT_MOMENTS, 0, 0, 0);
        sum[i] = (int64_t)((uint64_t)sum[i] + ((uint64_t)high << 32 | low));
        sum[i + 1] = (int64_t)((uint64_t)sum[i + 1] + ((uint64_t)next_high << 32 | next_low));
    }
}

uint32_t drogue_near_count(const drogue_ellipse_frame *frame, drogue_q16 threshold, const drogue_edge *edges,
                           uint32_t count)
{
    static const drogue_band no_band = {0, 0, 0};
    static const band_reach no_reach = {0, 0};
    uint32_t said;
    tell(frame, &no_band, no_reach, drogue_q16_mul(threshold, frame->b_px_q16));
    UNIT(said, UNIT_COUNT, 0, 0, 0);
    place(edges, count, 1, 0);
    UNIT(said, UNIT_COUNTED, COUNTED_NEAR, 0, 0);
    return said;
}

void drogue_collect_arc(drogue_moments *moments, const drogue_edge *edges, uint32_t count)
{
    uint32_t i;
    clear();
    for (i = 0; i < count; i++) {
        add(&edges[i], 0);
    }
    add_moments(moments);
}

/* Add the unit's counts and sums. */
static void add_counted(drogue_support *support)
{
    uint32_t word[5];
    uint32_t bins;
    uint32_t k;
    UNIT(bins, UNIT_COUNTED, COUNTED_BINS, 0, 0);
    for (k = 0; k < 5; k++) {
        UNIT(word[k], UNIT_COUNTED, COUNTED_SUMS, 0, 0);
    }
    support->squares_q32 = (int64_t)((uint64_t)support->squares_q32 + ((uint64_t)word[1] << 32 | word[0]));
    support->gradient += (uint64_t)word[3] << 32 | word[2];
    support->points += word[4];
    while (bins != 0) {
        drogue_support_bin *bin;
        uint32_t zeros;
        uint32_t counts;
        int32_t offsets_q16;
        UNIT(zeros, UNIT_ZEROS, 0, bins, 0);
        k = 31 - zeros;
        bins ^= 1u << k;
        bin = &support->bin[k];
        UNIT(counts, UNIT_COUNTED, COUNTED_COUNTS, k, 0);
        UNIT(offsets_q16, UNIT_COUNTED, COUNTED_OFFSETS, k, 0);
        bin->count[0] += counts & 0xFFFFu;
        bin->count[1] += counts >> 16;
        bin->sum_q16 += offsets_q16;
    }
}

void drogue_collect_edges(drogue_moments *moments, drogue_support *support, const drogue_ellipse_frame *frame,
                          const drogue_band *band, const drogue_edge *edges, uint32_t count, uint32_t stride,
                          uint32_t counted)
{
    uint32_t none;
    uint32_t changed;
    if (count == 0) {
        return;
    }
    tell(frame, band, reach_of(frame, band), 0);
    clear();
    UNIT(none, UNIT_COUNT, 0, support->bright_bins, (uint32_t)moments->n | (counted ? COUNT_OUT : 0));
    place(edges, count, stride, 1);
    (void)none;
    add_counted(support);
    UNIT(changed, UNIT_COUNTED, COUNTED_MOMENTS, 0, 0);
    if (changed) {
        add_moments(moments);
    }
}
