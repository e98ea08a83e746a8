// SPDX-License-Identifier: Apache-2.0
// The register bank: its state, read every clock from START on, is busy until the lists are there, then done, nothing else between;
// the block is given the region's pixels, each once and in order, wherever the region lies; and by the driver the
// interrupt's line is high from the end of a frame that asked for it until acknowledged, or the next start, never else.
#include <cstdio>

#include "Vdrogue_bank.h"
#include "Vdrogue_bank___024root.h"
#include "verilated.h"

extern "C" {
#include "driver/block.h"
#include "driver/registers.h"
}

namespace {

enum { MEMORY_BYTES = 65536 };

struct Frame {
    uint32_t width, height, source, stride;
    unsigned reset_after; // clocks; 0: never
};

struct Driven {
    int32_t width; // 0 is refused: the frame ends at once
    bool interrupt, acknowledges;
};

Vdrogue_bank v;
uint8_t memory[MEMORY_BYTES];
const drogue_bank_of_registers bank = {nullptr, memory, sizeof memory, 200000};
bool was_high, started; // the interrupt's line; a frame by the driver
unsigned rises, early;  // of the line, early: before the frame was started

uint32_t word_about(uint32_t at)
{
    uint32_t word = 0;
    for (uint32_t k = 4; k-- > 0;) {
        word = word << 8 | memory[((at & ~3u) + k) % MEMORY_BYTES];
    }
    return word;
}

void tick()
{
    v.eval();
    const uint32_t word = word_about(v.frame_at);
    v.clock = 1;
    v.eval();
    v.clock = 0;
    v.frame_word = word;
    v.eval();
    rises += v.irq && !was_high;
    early += v.irq && !was_high && !started;
    was_high = v.irq;
}

void write(uint32_t at, uint32_t word)
{
    v.select = v.write = 1;
    v.at = at;
    v.word = word;
    tick();
    v.select = v.write = 0;
}

bool runs(const Frame &f)
{
    const bool refused = f.width < 1 || f.width > 256;
    uint32_t taken = 0;
    write(DROGUE_BANK_WIDTH_PX, f.width);
    write(DROGUE_BANK_HEIGHT_PX, f.height);
    write(DROGUE_BANK_CANNY_LOW, 1);
    write(DROGUE_BANK_CANNY_HIGH, 2);
    write(DROGUE_BANK_MIN_ARC_PX, 1);
    write(DROGUE_BANK_SOURCE, f.source);
    write(DROGUE_BANK_STRIDE, f.stride);
    write(DROGUE_BANK_CONTROL, DROGUE_BANK_START);
    v.at = DROGUE_BANK_STATE;
    for (unsigned clocks = 1; clocks < 200000; clocks++) {
        if (v.rootp->drogue_bank__DOT__pixel_ready) {
            const uint32_t at = f.source + taken / f.width * f.stride + taken % f.width;
            if (v.rootp->drogue_bank__DOT__waiting[0] != memory[at % MEMORY_BYTES]) {
                printf("bank: %u x %u at %u: pixel %u is not the region's\n", f.width, f.height, f.source, taken);
                return false;
            }
            taken++;
        }
        if (clocks == f.reset_after) {
            write(DROGUE_BANK_CONTROL, DROGUE_BANK_RESET);
            return true;
        }
        tick();
        if (v.read == DROGUE_BANK_DONE) {
            return taken == (refused ? 0 : f.width * f.height);
        }
        if (v.read != DROGUE_BANK_BUSY) {
            printf("bank: %u x %u: state is %u after %u clocks\n", f.width, f.height, v.read, clocks);
            return false;
        }
    }
    return false;
}

// A frame by the driver, which asks for an interrupt or does not.
bool drives(int32_t width, bool interrupt, bool acknowledges)
{
    drogue_block_frame f = {};
    f.config.canny_low = 20;
    f.config.canny_high = 60;
    f.config.min_arc_px = 1;
    f.width_px = width;
    f.height_px = 8;
    f.stride = 64;
    started = false;
    rises = early = 0;
    bool good =
        drogue_block_start(&bank, &f, interrupt) == DROGUE_BLOCK_OK && drogue_block_wait(&bank) == DROGUE_BLOCK_OK;
    for (int clocks = 0; clocks < 10; clocks++) {
        tick();
    }
    good = good && v.irq == interrupt && rises == interrupt && early == 0;
    if (acknowledges) {
        drogue_block_acknowledge(&bank);
        tick();
        good = good && !v.irq;
    }
    if (!good) {
        printf("bank: interrupt %d, width %d: line %d, rises %u, early %u\n", interrupt, width, v.irq, rises, early);
    }
    return good && drogue_block_poll(&bank) == DROGUE_BLOCK_OK;
}

} // namespace

uint32_t drogue_bank_read(const drogue_bank_of_registers *, uint32_t offset)
{
    v.select = 1;
    v.at = offset;
    tick();
    v.select = 0;
    return v.read;
}

void drogue_bank_write(const drogue_bank_of_registers *, uint32_t offset, uint32_t word)
{
    write(offset, word);
    started = started || offset == DROGUE_BANK_CONTROL;
}

int main()
{
    static const Frame frames[] = {
        {1, 1, 0, 1, 0},     {2, 2, 3, 2, 0},       {16, 16, 1000, 40, 0}, {33, 33, 4097, 256, 0},
        {0, 0, 0, 0, 0},     {257, 257, 0, 257, 0}, {5, 5, 17, 0, 0},      {1, 9, 65533, 3, 0},
        {9, 1, 65530, 9, 0}, {40, 3, 2, 40, 100},   {7, 5, 6001, 7, 0},    {256, 2, 1, 256, 300},
        {3, 4, 70, 64, 33},  {12, 11, 9, 12, 0},
    };
    static const Driven driven[] = {{64, false, false}, {64, true, true}, {64, true, false}, {64, true, false},
                                    {64, false, false}, {0, true, false}, {0, false, true},  {0, true, true}};
    unsigned failed = 0;
    uint32_t state = 1;
    for (uint8_t &pixel : memory) {
        state = state * 1664525u + 1013904223u;
        pixel = static_cast<uint8_t>(state >> 24);
    }
    v.reset = 1;
    tick();
    v.reset = 0;
    for (const Frame &f : frames) {
        failed += !runs(f);
    }
    for (const Driven &d : driven) {
        failed += !drives(d.width, d.interrupt, d.acknowledges);
    }
    printf("bank: frames=%zu failed=%u\n", sizeof frames / sizeof frames[0] + sizeof driven / sizeof driven[0], failed);
    return failed != 0;
}
