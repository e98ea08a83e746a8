/* SPDX-License-Identifier: Apache-2.0 */
/* Scalars of types.h: clipping, pixel addresses, coordinates of an edge point. */
#include "drogue/types.h"
#include "proof.h"

void clipping(void)
{
    const int32_t from = nondet_s32();
    const int32_t n = nondet_s32();
    const int32_t limit = nondet_s32();
    const int32_t pixel = nondet_s32(); /* any one */
    int32_t at = from;
    int32_t length = n;
    drogue_clip(&at, &length, limit);
    PROVE(at >= 0 && length >= 0);
    PROVE(limit < 0 || (int64_t)at + length <= limit);
    PROVE((pixel >= at && (int64_t)pixel < (int64_t)at + length) ==
          (pixel >= from && (int64_t)pixel < (int64_t)from + n && pixel >= 0 && pixel < limit));
}

void addresses(void)
{
    static uint8_t pixels[64];
    drogue_image image;
    image.data = pixels;
    image.width_px = nondet_s32();
    image.height_px = nondet_s32();
    image.stride = nondet_s32();
    ASSUME(drogue_image_valid(&image));
    ASSUME((int64_t)image.stride * (image.height_px - 1) + image.width_px <= 64); /* what the caller guarantees */
    {
        const int32_t y = any_within(0, image.height_px - 1);
        const int32_t x = any_within(0, image.width_px - 1);
        PROVE(drogue_image_row(&image, y)[x] == 0); /* and the access is within */
    }
}

void coordinates(void)
{
    drogue_edge e;
    e.x_q5 = (uint16_t)nondet_u32();
    e.y_q5 = (uint16_t)nondet_u32();
    PROVE(drogue_edge_x_q16(&e) == (int64_t)e.x_q5 * 65536 / 32);
    PROVE(drogue_edge_y_q16(&e) == (int64_t)e.y_q5 * 65536 / 32);
    PROVE(drogue_edge_x_px(&e) == (e.x_q5 + 16) / 32 && drogue_edge_y_px(&e) == (e.y_q5 + 16) / 32);
}
