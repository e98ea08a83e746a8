/* SPDX-License-Identifier: Apache-2.0 */
/* Firmware of the small system: frame after frame through drogue_track_frame(), with the front end in hardware. */
#include "driver/block.h"
#include "follow.h"

#define FRAME ((const uint8_t *)0x40000000)
#define BANK ((volatile uint32_t *)0x80000000)
#define CAPTURE (*(volatile uint32_t *)0x90000000)
#define RESULT (*(volatile uint32_t *)0x90000004)

int main(void);

/* What the camera writes, the data cache does not see: all of its lines are given up. */
static void forget_frame(void) { __asm__ volatile(".word 0x500F" : : : "memory"); }

static void send(const void *words, size_t bytes)
{
    const uint32_t *word = (const uint32_t *)words;
    size_t i;
    for (i = 0; i < bytes / 4; i++) {
        RESULT = word[i];
    }
}

int main(void)
{
    static const drogue_bank_of_registers bank = {BANK, FRAME, SIDE * SIDE, 1000000};
    static follow f;
    drogue_block_use(&bank);
    RESULT = (uint32_t)follow_begin(&f);
    for (;;) {
        CAPTURE = SIDE * SIDE;
        while (!CAPTURE) {}
        forget_frame();
        follow_frame(&f, FRAME);
        RESULT = (uint32_t)drogue_block_last();
        send(&f.region, sizeof f.region);
        send(&f.result, sizeof f.result);
        send(&f.estimate, sizeof f.estimate);
        send(&f.track, sizeof f.track);
    }
}
