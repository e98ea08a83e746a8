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
    uint32_t blocks = 0;
    int32_t sum = 0;
    int32_t bend = 0;
    int32_t left = BLOCK;
    int32_t x;
    for (x = 0; x <= 2 * REACH; x++) { /* bound: 9 */
        bend += x / 3 == 1 ? -2 * column(row, x) : column(row, x);
    }
    for (x = REACH; x + REACH < width_px; x++) { /* bound: 2044 */
        sum += drogue_abs_s32(bend);
        if (--left == 0) {
            histogram[sum >> SHIFT < BINS ? sum >> SHIFT : BINS - 1]++;
            blocks++;
            sum = 0;
            left = BLOCK;
        }
        if (x + REACH + 1 < width_px) { /* the boxes move on by a column */
            bend += column(row, x + 5) - column(row, x - 4) + 3 * (column(row, x - 1) - column(row, x + 2));
        }
    }
    return blocks;
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
