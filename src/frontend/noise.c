/* SPDX-License-Identifier: Apache-2.0 */
/* Noise of an image. */
#include <string.h>

#include "drogue/frontend.h"

#define REACH 4      /* px to either side of a place that three boxes of three columns beside each other have */
#define BLOCK 9      /* places whose differences are summed: by blocks noise is nearly the same, and edges are in few */
#define SHIFT 3      /* of a block's sum, to the histogram's bins */
#define EVERY 3      /* so many-th row is looked at */
#define QUANTILE 10  /* one in so many blocks has less */
#define PER_MIL 3762 /* bins of that quantile over the deviation of white noise, by simulation */
#define DEVIATIONS 10
#define BINS 256

/* Sum of a column over three rows. */
static inline int32_t column(const uint8_t *above, int32_t stride, int32_t x)
{
    return above[x] + above[x + stride] + above[x + 2 * stride];
}

/* Count the second differences of boxes of 3 x 3 px along a row, by blocks. Returns the number of blocks. */
static uint32_t count_row(uint32_t histogram[BINS], const uint8_t *above, int32_t stride, int32_t width_px)
{
    uint32_t blocks = 0;
    int32_t sum = 0;
    int32_t bend = 0;
    int32_t left = BLOCK;
    int32_t x;
    for (x = 0; x <= 2 * REACH; x++) { /* bound: 9 */
        bend += x / 3 == 1 ? -2 * column(above, stride, x) : column(above, stride, x);
    }
    for (x = REACH; x + REACH < width_px; x++) { /* bound: 2044 */
        sum += bend < 0 ? -bend : bend;
        if (--left == 0) {
            histogram[sum >> SHIFT < BINS ? sum >> SHIFT : BINS - 1]++;
            blocks++;
            sum = 0;
            left = BLOCK;
        }
        if (x + REACH + 1 < width_px) { /* the boxes move on by a column */
            bend += column(above, stride, x + 5) - column(above, stride, x - 4) +
                    3 * (column(above, stride, x - 1) - column(above, stride, x + 2));
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
    int64_t twice; /* the quantile, times the count of its bin: a bin reaches half a level to either side */
    memset(histogram, 0, BINS * sizeof(uint32_t));
    for (y = 0; y + 2 < image->height_px && image->width_px > 2 * REACH; y += EVERY) { /* bound: 683 */
        count += count_row(histogram, drogue_image_row(image, y), image->stride, image->width_px);
    }
    if (QUANTILE * histogram[0] >= count) { /* it is within half a level of 0, or there is none */
        return 0;
    }
    while (level < BINS - 1 && QUANTILE * (below + histogram[level]) < count) { /* bound: 255 */
        below += histogram[level++];
    }
    twice = (2 * (int64_t)level - 1) * histogram[level] + 2 * ((int64_t)(count / QUANTILE) - (int64_t)below);
    return (int32_t)drogue_div_round_s64(DEVIATIONS * 1000 * twice, (int64_t)2 * PER_MIL * histogram[level]);
}
