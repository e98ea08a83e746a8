/* SPDX-License-Identifier: Apache-2.0 */
/* Rows, columns and threshold of a disc in an image. */
#include <string.h>

#include "pass.h"

int drogue_disc_span(int32_t *first, int32_t *last, const drogue_mask *disc, int32_t y, int32_t width_px)
{
    const int64_t rest = drogue_mask_disc_row(disc, y);
    int64_t half; /* largest |2x - centre2_x| that drogue_disc_row_holds() */
    int64_t low;
    int64_t high;
    if (rest < 0) {
        return 0;
    }
    half = drogue_isqrt_u64((uint64_t)drogue_floor_div_s64(rest, 9));
    low = (disc->centre2_x - half + 1) >> 1;
    high = (disc->centre2_x + half) >> 1;
    *first = (int32_t)(low < 0 ? 0 : low);
    *last = (int32_t)(high > width_px - 1 ? width_px - 1 : high);
    return low <= high && *first <= *last;
}

void drogue_disc_rows(int32_t *first, int32_t *last, const drogue_mask *disc, int32_t height_px)
{
    const int64_t low = ((int64_t)disc->centre2_y - disc->longest_px) / 2;
    const int64_t high = ((int64_t)disc->centre2_y + disc->longest_px) / 2;
    *first = (int32_t)(low < 0 ? 0 : low);
    *last = (int32_t)(high > height_px - 1 ? height_px - 1 : high);
}

uint8_t drogue_disc_threshold(uint32_t *histogram, const drogue_image *image, const drogue_mask *disc)
{
    int32_t y;
    int32_t low;
    int32_t high;
    memset(histogram, 0, 256 * sizeof(uint32_t));
    drogue_disc_rows(&low, &high, disc, image->height_px);
    for (y = low; y <= high; y++) {
        const uint8_t *row = drogue_image_row(image, y);
        int32_t first;
        int32_t last;
        int32_t x;
        if (drogue_disc_span(&first, &last, disc, y, image->width_px)) {
            for (x = first; x <= last; x++) {
                histogram[row[x]]++;
            }
        }
    }
    return drogue_otsu(histogram);
}
