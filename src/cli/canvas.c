/* SPDX-License-Identifier: Apache-2.0 */
/* Pixels, rectangles, lines and letters. */
#include "canvas.h"

#include <stddef.h>

#include "drogue/fixed.h"
#include "font.h"

static uint8_t mix(uint8_t below, uint8_t above, int32_t alpha)
{
    return (uint8_t)((below * (256 - alpha) + above * alpha + 128) >> 8);
}

void canvas_blend(picture *canvas, int32_t x, int32_t y, colour c, int32_t alpha)
{
    uint8_t *p;
    if (x < 0 || y < 0 || x >= canvas->width_px || y >= canvas->height_px) {
        return;
    }
    p = canvas->data + ((size_t)y * (size_t)canvas->width_px + (size_t)x) * 3;
    p[0] = mix(p[0], c.r, alpha);
    p[1] = mix(p[1], c.g, alpha);
    p[2] = mix(p[2], c.b, alpha);
}

void canvas_fill(picture *canvas, int32_t x, int32_t y, int32_t width, int32_t height, colour c, int32_t alpha)
{
    int32_t i, j;
    for (j = y; j < y + height; j++) {
        for (i = x; i < x + width; i++) {
            canvas_blend(canvas, i, j, c, alpha);
        }
    }
}

static int64_t clamp(int64_t v, int64_t low, int64_t high) { return v < low ? low : v > high ? high : v; }

void canvas_line(picture *canvas, int64_t x0_q8, int64_t y0_q8, int64_t x1_q8, int64_t y1_q8, int32_t width, colour c)
{
    int64_t dx = x1_q8 - x0_q8, dy = y1_q8 - y0_q8;
    int steep = drogue_abs_u64(dy) > drogue_abs_u64(dx);
    /* u runs along the longer side, v across it. */
    int64_t u0 = steep ? y0_q8 : x0_q8, v0 = steep ? x0_q8 : y0_q8;
    int64_t du = steep ? dy : dx, dv = steep ? dx : dy;
    int64_t limit = steep ? canvas->height_px : canvas->width_px;
    int64_t u, last, half_q8;
    if (du == 0) {
        return;
    }
    if (du < 0) {
        u0 += du;
        v0 += dv;
        du = -du;
        dv = -dv;
    }
    /* Half the width measured along v: longer by the hypotenuse over the longer side. */
    half_q8 = (int64_t)drogue_isqrt_u64((uint64_t)(du * du + dv * dv)) * width * 128 / du;
    last = clamp((u0 + du + 255) >> 8, 0, limit);
    for (u = clamp((u0 + 255) >> 8, 0, limit); u < last; u++) {
        int64_t v_q8 = v0 + dv * (u * 256 - u0) / du;
        int64_t v;
        if (v_q8 < -1024 || v_q8 > INT64_C(1) << 24) {
            continue;
        }
        for (v = (v_q8 >> 8) - 2; v <= (v_q8 >> 8) + 3; v++) {
            int64_t distance_q8 = (int64_t)drogue_abs_u64(v * 256 - v_q8);
            int32_t alpha = (int32_t)clamp(half_q8 + 128 - distance_q8, 0, 256);
            canvas_blend(canvas, (int32_t)(steep ? v : u), (int32_t)(steep ? u : v), c, alpha);
        }
    }
}

int32_t canvas_text(picture *canvas, int32_t x, int32_t y, int32_t scale, colour c, const char *text)
{
    for (; *text != '\0'; text++) {
        const uint8_t *rows = font_rows(*text);
        int32_t row, column;
        for (row = 0; row < FONT_HEIGHT; row++) {
            for (column = 0; column < FONT_WIDTH; column++) {
                if ((rows[row] >> (FONT_WIDTH - 1 - column) & 1) != 0) {
                    canvas_fill(canvas, x + column * scale, y + row * scale, scale, scale, c, 256);
                }
            }
        }
        x += FONT_ADVANCE * scale;
    }
    return x;
}
