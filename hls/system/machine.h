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

/* A frame of so many pixels from the camera. What the camera writes, the data cache does not see: all of its lines are given up. */
static inline void capture(uint32_t pixels)
{
    CAPTURE = pixels;
    while (!CAPTURE) {}
    __asm__ volatile(".word 0x500F" : : : "memory");
}

static inline void send(const void *words, size_t bytes)
{
    const uint32_t *word = (const uint32_t *)words;
    size_t i;
    for (i = 0; i < bytes / 4; i++) {
        RESULT = word[i];
    }
}

#endif
