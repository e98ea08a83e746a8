/* SPDX-License-Identifier: Apache-2.0 */
/* Noise of an image. */
#include <string.h>

#include "drogue/noise.h"

#define REACH 4     /* px to either side of a place that three boxes of three columns beside each other have */
#define BLOCK 9     /* places whose differences are summed: by blocks noise is nearly the same, and edges are in few */
#define SHIFT 3     /* of a block's sum, to the histogram's bins */
#define EVERY 3     /* so many-th row is looked at */
#define QUANTILE 10 /* one in so many blocks has less */
#define MILLIBINS_PER_LEVEL 3830 /* where that quantile of white noise lies, over its deviation, by simulation */
#define DEVIATIONS 10            /* of noise, which hardly any edge of noise alone exceeds */
#define BINS 256

/* Sum of a column over three rows. */
static inline int32_t column(const uint8_t *const row[3], int32_t x) { return row[0][x] + row[1][x] + row[2][x]; }

/* Count the second differences of boxes of 3 x 3 px along a row, by blocks. Returns the number of blocks. */
static uint32_t count_row(uint32_t histogram[BINS], const uint8_t *const row[3], int32_t width_px)
{
    const int32_t blocks = (width_px - 2 * REACH) / BLOCK;
    int32_t at[2 * REACH + BLOCK]; /* columns from the left of a block's first boxes to the right of its last */
    int32_t block;
    int32_t k;
    for (k = 0; k < 2 * REACH; k++) {
        at[BLOCK + k] = column(row, k);
    }
    for (block = 0; block < blocks; block++) { /* bound: 226 */
        const int32_t next = block * BLOCK + 2 * REACH;
        int32_t sum = 0;
        for (k = 0; k < 2 * REACH; k++) {
            at[k] = at[BLOCK + k];
        }
        for (k = 0; k < BLOCK; k++) {
            at[2 * REACH + k] = column(row, next + k);
        }
        for (k = 0; k < BLOCK; k++) {
            const int32_t *c = &at[k];
            sum += drogue_abs_s32(c[0] + c[1] + c[2] - 2 * (c[3] + c[4] + c[5]) + c[6] + c[7] + c[8]);
        }
        histogram[sum >> SHIFT < BINS ? sum >> SHIFT : BINS - 1]++;
    }
    return (uint32_t)blocks;
}

int32_t drogue_noise_threshold(uint32_t *histogram, const drogue_image *image)
{
    uint32_t count = 0;
    uint32_t below = 0;
    int32_t level = 0;
    int32_t y;
    int64_t quantile; /* times the count of its bin */
    memset(histogram, 0, BINS * sizeof(uint32_t));
    for (y = 0; y + 2 < image->height_px && image->width_px > 2 * REACH; y += EVERY) { /* bound: 683 */
        const uint8_t *const row[3] = {drogue_image_row(image, y), drogue_image_row(image, y + 1),
                                       drogue_image_row(image, y + 2)};
        count += count_row(histogram, row, image->width_px);
    }
    if (QUANTILE * histogram[0] >= count) { /* it is in the first bin, or there is none */
        return 0;
    }
    while (level < BINS - 1 && QUANTILE * (below + histogram[level]) < count) { /* bound: 255 */
        below += histogram[level++];
    }
    quantile = (int64_t)level * histogram[level] + (int64_t)(count / QUANTILE) - (int64_t)below;
    return (int32_t)drogue_div_round_s64(DEVIATIONS * 1000 * quantile, (int64_t)MILLIBINS_PER_LEVEL * histogram[level]);
}
