/* SPDX-License-Identifier: Apache-2.0 */
/* Firmware of the small system under the golden vectors: an order, its image, drogue_measure() with the front end in hardware. */
#include "machine.h"
#include "order.h"

int main(void);

int main(void)
{
    static const drogue_bank_of_registers bank = {BANK, FRAME, FRAME_BYTES, 1000000};
    drogue_block_use(&bank);
    for (;;) {
        drogue_result result;
        order o;
        capture(sizeof o);
        o = *(const order *)FRAME;
        capture((uint32_t)(o.width_px * o.height_px));
        order_measure(&result, &o, FRAME);
        RESULT = (uint32_t)drogue_block_last();
        send(&result, sizeof result);
    }
}
