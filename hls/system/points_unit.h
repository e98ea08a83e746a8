/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for edge points beside the soft core: what it is told of an ellipse, of a point, and what it says. */
#ifndef DROGUE_SYSTEM_POINTS_UNIT_H
#define DROGUE_SYSTEM_POINTS_UNIT_H

#include "../../src/outline/band.h"
#include "../../src/outline/near.h"

/* The words that the soft core tells, then the point, two words as they lie in a drogue_edge. */
typedef struct points_asked {
    drogue_ellipse_frame frame;
    drogue_band band;
    band_reach reach;
    drogue_q16 most_px_q16; /* |F| b of what is near */
    uint32_t place;
    uint32_t gradient;
} points_asked;

enum { POINTS_WORDS = sizeof(points_asked) / 4 - 2 };

/* Bits of what is said of a point. */
enum {
    POINT_HELD = 31, /* band_holds(): then its polarity, bin and offset */
    POINT_NEAR = 30,
    POINT_POLARITY = 29,
    POINT_BIN = 24 /* five; below lies the offset */
};

/* And the point itself: the next ones were told meanwhile. */
typedef struct points_said {
    uint32_t word;
    uint32_t place;
    uint32_t gradient;
} points_said;

void points_unit_place(const points_asked *restrict asked, points_said *restrict out);

/* A support's sums, of a held point's bin the count of its polarity and the sum, and the point. */
typedef struct count_asked {
    int64_t squares_q32;
    uint64_t gradient;
    uint32_t points;
    uint32_t count;
    int32_t sum_q16;
    uint32_t word; /* as it was said */
    uint32_t point_gradient;
    uint32_t bright_bins;
} count_asked;

typedef struct count_said {
    int64_t squares_q32;
    uint64_t gradient;
    uint32_t points;
    uint32_t count;
    int32_t sum_q16;
    uint32_t own; /* the bin's polarity is the point's */
} count_said;

void points_unit_count(const count_asked *restrict asked, count_said *restrict out);

/* What is counted is read by a part of the instruction. */
enum {
    COUNTED_BINS,    /* bit k: the bin k has points */
    COUNTED_SUMS,    /* squares, gradient, points, word after word */
    COUNTED_COUNTS,  /* of the bin told, the second's in the upper half */
    COUNTED_OFFSETS, /* sum of the bin told */
    COUNTED_MOMENTS, /* 1: they changed */
    COUNTED_NEAR     /* points that are near, of all that were placed */
};

/* Moments, and a point that they are to have once more, or, with 'out_of' 1, once less. */
typedef struct moments_asked {
    drogue_moments moments;
    uint32_t place;
    uint32_t out_of;
} moments_asked;

void points_unit_moments(const moments_asked *restrict asked, drogue_moments *restrict out);

#endif
