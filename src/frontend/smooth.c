/* SPDX-License-Identifier: Apache-2.0 */
/* 5x5 binomial smoothing: the vertical sum of a row first, then the horizontal one. */
#include "drogue/smooth.h"

/* Smooth a row from rows y-2 .. y+2, border already reflected; 'column' is work area. Sums reach 256 * 255. */
static void smooth_row(uint8_t *out, uint16_t *column, const uint8_t *const rows[5], int32_t width_px)
{
    const uint8_t *r0 = rows[0];
    const uint8_t *r1 = rows[1];
    const uint8_t *r2 = rows[2];
    const uint8_t *r3 = rows[3];
    const uint8_t *r4 = rows[4];
    int32_t x;
    for (x = 0; x < width_px; x++) {
        column[x] = (uint16_t)drogue_binomial5(r0[x], r1[x], r2[x], r3[x], r4[x]);
        DROGUE_NOTE("smooth: column sum", column[x], 12);
    }
    for (x = 2; x < width_px - 2; x++) {
        out[x] = drogue_smooth_normalise(
            drogue_binomial5(column[x - 2], column[x - 1], column[x], column[x + 1], column[x + 2]));
    }
    for (x = 0; x < width_px; x = (x == 1 && width_px > 4) ? width_px - 2 : x + 1) { /* two columns each side */
        out[x] = drogue_smooth_normalise(drogue_binomial5(
            column[drogue_reflect_101(x - 2, width_px)], column[drogue_reflect_101(x - 1, width_px)], column[x],
            column[drogue_reflect_101(x + 1, width_px)], column[drogue_reflect_101(x + 2, width_px)]));
    }
}

drogue_status drogue_smooth_image(uint8_t *out, uint16_t *column, const drogue_image *image)
{
    int32_t y;
    int32_t k;
    if (!drogue_image_valid(image)) {
        return DROGUE_E_ARGUMENT;
    }
    for (y = 0; y < image->height_px; y++) {
        const uint8_t *rows[5];
        for (k = 0; k < 5; k++) {
            rows[k] = drogue_image_row(image, drogue_reflect_101(y + k - 2, image->height_px));
        }
        smooth_row(out + (size_t)y * (size_t)image->width_px, column, rows, image->width_px);
    }
    return DROGUE_OK;
}
