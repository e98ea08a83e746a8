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

void drogue_gradient_row(int16_t *gx, int16_t *gy, uint16_t *magnitude, const uint8_t *const rows[3], int32_t width_px)
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

static inline drogue_slope *note_slope(drogue_slope *next, uint32_t x, uint32_t dx, uint32_t dy)
{
    next->x = (uint16_t)x;
    next->gx = drogue_sobel_unbias(dx);
    next->gy = drogue_sobel_unbias(dy);
    next->dx_q5 = 0;
    next->dy_q5 = 0;
    return next + 1;
}

uint32_t drogue_gradient_lanes_row(drogue_slope *slopes, uint16_t *magnitude, const uint32_t *const rows[3],
                                   int32_t width_px, int32_t low)
{
    const uint32_t *t = rows[0];
    const uint32_t *c = rows[1];
    const uint32_t *b = rows[2];
    const uint32_t excess = DROGUE_LANES(0x7FFFu - (uint32_t)(low < 2040 ? low : 2040)); /* sets a lane's top bit */
    const uint32_t width = (uint32_t)width_px;
    drogue_slope *next = slopes;
    uint32_t odd_sum = drogue_sobel_121(t[-1], c[-1], b[-1]); /* pixels x - 3, x - 1 */
    uint32_t odd_step = drogue_sobel_step(t[-1], b[-1]);
    uint32_t even_sum = drogue_sobel_121(t[0], c[0], b[0]); /* x, x + 2 */
    uint32_t even_step = drogue_sobel_step(t[0], b[0]);
    uint32_t x;
    for (x = 0; x < width; x += 4) {
        uint32_t sum = drogue_sobel_121(t[1], c[1], b[1]); /* x + 1, x + 3 */
        uint32_t step = drogue_sobel_step(t[1], b[1]);
        uint32_t dx_even = drogue_sobel_dx(drogue_lanes_between(odd_sum, sum), sum);
        uint32_t dy_even = drogue_sobel_121(drogue_lanes_between(odd_step, step), even_step, step);
        uint32_t m_even = drogue_sobel_l1(dx_even, drogue_sobel_mask(dx_even), dy_even, drogue_sobel_mask(dy_even));
        uint32_t dx_odd;
        uint32_t dy_odd;
        uint32_t m_odd;
        odd_sum = sum;
        odd_step = step;
        sum = drogue_sobel_121(t[2], c[2], b[2]); /* x + 4, x + 6 */
        step = drogue_sobel_step(t[2], b[2]);
        dx_odd = drogue_sobel_dx(even_sum, drogue_lanes_between(even_sum, sum));
        dy_odd = drogue_sobel_121(even_step, odd_step, drogue_lanes_between(even_step, step));
        m_odd = drogue_sobel_l1(dx_odd, drogue_sobel_mask(dx_odd), dy_odd, drogue_sobel_mask(dy_odd));
        even_sum = sum;
        even_step = step;
        t += 2;
        c += 2;
        b += 2;
        magnitude[x] = (uint16_t)m_even;
        magnitude[x + 1] = (uint16_t)m_odd;
        magnitude[x + 2] = (uint16_t)(m_even >> 16);
        magnitude[x + 3] = (uint16_t)(m_odd >> 16);
        m_even += excess;
        m_odd += excess;
        if (((m_even | m_odd) & DROGUE_LANES(0x8000u)) != 0) {
            if ((m_even & 0x8000u) != 0) {
                next = note_slope(next, x, dx_even, dy_even);
            }
            if ((m_odd & 0x8000u) != 0) {
                next = note_slope(next, x + 1, dx_odd, dy_odd);
            }
            if ((m_even >> 31) != 0) {
                next = note_slope(next, x + 2, dx_even >> 16, dy_even >> 16);
            }
            if ((m_odd >> 31) != 0) {
                next = note_slope(next, x + 3, dx_odd >> 16, dy_odd >> 16);
            }
        }
    }
    while (next > slopes && next[-1].x >= width) { /* at most three */
        next--;
    }
    return (uint32_t)(next - slopes);
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
        drogue_gradient_row(gx + at, gy + at, magnitude + at, rows, image->width_px);
    }
    return DROGUE_OK;
}
