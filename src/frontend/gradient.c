/* SPDX-License-Identifier: Apache-2.0 */
/* 3x3 Sobel gradient and its L1 magnitude. */
#include "drogue/gradient.h"

/* One pixel, whose neighbours left and right are columns l and r. */
static void gradient_pixel(int16_t *gx, int16_t *gy, uint16_t *magnitude, const uint8_t *const rows[3], int32_t l,
                           int32_t x, int32_t r)
{
    const uint8_t *t = rows[0];
    const uint8_t *c = rows[1];
    const uint8_t *b = rows[2];
    gx[x] = drogue_sobel_gx(t[l], c[l], b[l], t[r], c[r], b[r]);
    gy[x] = drogue_sobel_gy(t[l], t[x], t[r], b[l], b[x], b[r]);
    magnitude[x] = drogue_magnitude_l1(gx[x], gy[x]);
    DROGUE_NOTE("gradient: gx", gx[x], 10);
    DROGUE_NOTE("gradient: gy", gy[x], 10);
    DROGUE_NOTE("gradient: L1 magnitude", magnitude[x], 11);
}

/* Gradient of a row from rows y-1, y, y+1, border already replicated. */
static void gradient_row(int16_t *gx, int16_t *gy, uint16_t *magnitude, const uint8_t *const rows[3], int32_t width_px)
{
    int32_t last = width_px - 1;
    int32_t x;
    gradient_pixel(gx, gy, magnitude, rows, 0, 0, last > 0 ? 1 : 0);
    for (x = 1; x < last; x++) {
        gradient_pixel(gx, gy, magnitude, rows, x - 1, x, x + 1);
    }
    if (last > 0) {
        gradient_pixel(gx, gy, magnitude, rows, last - 1, last, last);
    }
}

drogue_status drogue_gradient_image(int16_t *gx, int16_t *gy, uint16_t *magnitude, const drogue_image *image)
{
    int32_t y;
    if (!drogue_image_valid(image)) {
        return DROGUE_E_ARGUMENT;
    }
    for (y = 0; y < image->height_px; y++) {
        size_t at = (size_t)y * (size_t)image->width_px;
        const uint8_t *rows[3];
        rows[0] = drogue_image_row(image, y > 0 ? y - 1 : 0);
        rows[1] = drogue_image_row(image, y);
        rows[2] = drogue_image_row(image, y < image->height_px - 1 ? y + 1 : y);
        gradient_row(gx + at, gy + at, magnitude + at, rows, image->width_px);
    }
    return DROGUE_OK;
}
