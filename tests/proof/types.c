/* SPDX-License-Identifier: Apache-2.0 */
/* Scalars of types.h: pixel addresses, coordinates of an edge point. */
#include "drogue/types.h"
#include "proof.h"

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
