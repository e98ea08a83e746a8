/* SPDX-License-Identifier: Apache-2.0 */
/* Firmware of the small system: frame after frame through drogue_track_frame(), with the front end in hardware. */
#include "follow.h"
#include "machine.h"

int main(void);

int main(void)
{
    static const drogue_bank_of_registers bank = {BANK, FRAME, FRAME_BYTES, 1000000};
    static follow f;
    drogue_block_use(&bank);
    RESULT = (uint32_t)follow_begin(&f);
    for (;;) {
        begin_capture(SIDE * SIDE); /* track.c waits for its end */
        follow_frame(&f, FRAME);
        RESULT = (uint32_t)drogue_block_last();
        send(&f.region, sizeof f.region);
        send(&f.result, sizeof f.result);
        send(&f.estimate, sizeof f.estimate);
        send(&f.track, sizeof f.track);
    }
}
