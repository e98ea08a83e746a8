/* SPDX-License-Identifier: Apache-2.0 */
/* The ring mask: what a row leaves to its columns is the inequality of both coordinates, without overflow in the range stated. */
#include "drogue/mask.h"
#include "proof.h"

/* Bits of twice a centre, and of twice a pixel less that: regions up to 32 px and as far beside them. Products
 * of more bits are too much for the model checker; ends() looks at the whole range. */
enum { CENTRE_BITS = 7, PIXEL_BITS = 6 };

static drogue_mask any_mask(void)
{
    drogue_mask m;
    m.centre2_x = any_signed(CENTRE_BITS);
    m.centre2_y = any_signed(CENTRE_BITS);
    m.longest_px = any_within(1, 1 << (CENTRE_BITS - 2));
    ASSUME(drogue_mask_valid(&m));
    return m;
}

void ring(void)
{
    const drogue_mask m = any_mask();
    const int32_t x = any_signed(PIXEL_BITS);
    const int32_t y = any_signed(PIXEL_BITS);
    const int32_t dx = 2 * x - m.centre2_x;
    const int32_t dy = 2 * y - m.centre2_y;
    const int32_t side = m.longest_px;
    PROVE((drogue_mask_in_ring(&m, x, y) != 0) ==
          (9 * (dx * dx + dy * dy) >= 4 * side * side && dx * dx + dy * dy <= side * side));
}

/* The products grow with every operand's magnitude: where the ends of the stated ranges do not overflow, nothing does. */
void ends(void)
{
    static const int32_t pixel[4] = {-(1 << 28), 0, 7 << 16, 1 << 28}; /* the third is in the large ring */
    static const int32_t centre[2] = {-(1 << 15), 1 << 15};
    drogue_mask m;
    int i;
    int k;
    int n = 0;
    for (i = 0; i < 8; i++) {
        m.centre2_x = centre[i & 1];
        m.centre2_y = centre[i >> 1 & 1];
        m.longest_px = (i & 4) != 0 ? 1 << 20 : 1;
        PROVE(drogue_mask_valid(&m));
        for (k = 0; k < 16; k++) {
            n += drogue_mask_in_ring(&m, pixel[k & 3], pixel[k >> 2]);
        }
    }
    PROVE(n > 0);
}

void mask_of_size(void)
{
    const int32_t width = any_within(1, DROGUE_MAX_SIDE);
    const int32_t height = any_within(1, DROGUE_MAX_SIDE);
    const drogue_mask m = drogue_mask_of_size(width, height);
    PROVE(drogue_mask_valid(&m) && m.longest_px >= width && m.longest_px >= height);
    PROVE(!drogue_mask_in_ring(&m, (width - 1) / 2, (height - 1) / 2) || m.longest_px < 3);
}
