/* SPDX-License-Identifier: Apache-2.0 */
/* The small system as its firmware sees it: system.v. */
#ifndef DROGUE_SYSTEM_MACHINE_H
#define DROGUE_SYSTEM_MACHINE_H

#include "driver/block.h"

#define FRAME ((const uint8_t *)0x40000000)
#define FRAME_BYTES 65536u
#define BANK ((volatile uint32_t *)0x80000000)
#define CAPTURE (*(volatile uint32_t *)0x90000000)
#define RESULT (*(volatile uint32_t *)0x90000004)

/* A frame of so many pixels from the camera is asked for. What the camera writes, the data cache does not see: all of its lines are
 * given up. Until the frame is there none is read. */
static inline void begin_capture(uint32_t pixels)
{
    CAPTURE = pixels;
    __asm__ volatile(".word 0x500F" : : : "memory");
}

static inline void end_capture(void)
{
    while (!CAPTURE) {}
    __asm__ volatile("" : : : "memory");
}

static inline void capture(uint32_t pixels)
{
    begin_capture(pixels);
    end_capture();
}

static inline void send(const void *words, size_t bytes)
{
    const uint32_t *word = (const uint32_t *)words;
    const uint32_t *const end = word + bytes / 4;
    for (; end - word >= 4; word += 4) {
        const uint32_t next[4] = {word[0], word[1], word[2], word[3]};
        RESULT = next[0];
        RESULT = next[1];
        RESULT = next[2];
        RESULT = next[3];
    }
    for (; word < end; word++) {
        RESULT = *word;
    }
}

#endif
