/* SPDX-License-Identifier: Apache-2.0 */
/* Noise of an image. */
#include <string.h>

#include "drogue/noise.h"

#define REACH 4 /* px to either side of a place that three boxes of three columns beside each other have */
#define BOX 3   /* px across */
#define BLOCK 9 /* places whose differences are summed: by blocks noise is nearly the same, and edges are in few */
#define TOGETHER (8 * BLOCK)     /* places of a row at a time */
#define SHIFT 3                  /* of a block's sum, to the histogram's bins */
#define EVERY 3                  /* so many-th row is looked at */
#define QUANTILE 10              /* one in so many blocks has less */
#define MILLIBINS_PER_LEVEL 3830 /* where that quantile of white noise lies, over its deviation, by simulation */
#define DEVIATIONS 10            /* of noise, which hardly any edge of noise alone exceeds */
#define BINS 256

/* Second differences of boxes of 3 x 3 px, without their sign, from a row's pixel on: in loops of one row each, which
 * compilers vectorise. */
static void bend(int32_t out[TOGETHER + 2 * REACH], const uint8_t *row, int32_t stride, int32_t count)
{
    const uint8_t *middle = row + stride;
    const uint8_t *below = middle + stride;
    int32_t k;
    for (k = 0; k < count + 2 * REACH; k++) {
        out[k] = row[k] + middle[k] + below[k];
    }
    for (k = 0; k < count + 2 * BOX; k++) {
        out[k] = out[k] + out[k + 1] + out[k + 2];
    }
    for (k = 0; k < count; k++) {
        out[k] = drogue_abs_s32(out[k] - 2 * out[k + BOX] + out[k + 2 * BOX]);
    }
}

/* Count them by blocks. Returns the number of blocks. */
static uint32_t count_row(uint32_t histogram[BINS], const uint8_t *row, int32_t stride, int32_t width_px)
{
    const int32_t places = (width_px - 2 * REACH) / BLOCK * BLOCK;
    int32_t bends[TOGETHER + 2 * REACH];
    int32_t x;
    for (x = 0; x < places; x += TOGETHER) { /* bound: 29 */
        const int32_t count = places - x < TOGETHER ? places - x : TOGETHER;
        const int32_t *next = bends;
        bend(bends, row + x, stride, count);
        while (next < bends + count) { /* bound: 8 */
            int32_t sum = 0;
            int32_t k;
            for (k = 0; k < BLOCK; k++) {
                sum += *next++;
            }
            histogram[sum >> SHIFT < BINS ? sum >> SHIFT : BINS - 1]++;
        }
    }
    return (uint32_t)(places / BLOCK);
}

int32_t drogue_noise_threshold(uint32_t *histogram, const drogue_image *image)
{
    uint32_t count = 0;
    uint32_t below = 0;
    int32_t level = 0;
    int32_t y;
    int64_t quantile; /* times the count of its bin */
    memset(histogram, 0, BINS * sizeof(uint32_t));
    for (y = 0; y + 2 < image->height_px; y += EVERY) { /* bound: 683 */
        count += count_row(histogram, drogue_image_row(image, y), image->stride, image->width_px);
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
