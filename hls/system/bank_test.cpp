// SPDX-License-Identifier: Apache-2.0
// The register bank's state, read every clock from START on: busy until the lists are there, then done, nothing else between.
#include <cstdio>

#include "Vdrogue_bank.h"
#include "verilated.h"

extern "C" {
#include "driver/registers.h"
}

namespace {

Vdrogue_bank v;

void tick()
{
    v.eval();
    v.clock = 1;
    v.eval();
    v.clock = 0;
    v.eval();
}

void write(uint32_t at, uint32_t word)
{
    v.select = v.write = 1;
    v.at = at;
    v.word = word;
    tick();
    v.select = v.write = 0;
}

// Clocks of a frame of so many columns; 0 when the state was ever neither busy nor done, or stays busy.
unsigned run(uint32_t side)
{
    write(DROGUE_BANK_WIDTH_PX, side);
    write(DROGUE_BANK_HEIGHT_PX, side);
    write(DROGUE_BANK_CANNY_LOW, 1);
    write(DROGUE_BANK_CANNY_HIGH, 2);
    write(DROGUE_BANK_MIN_ARC_PX, 1);
    write(DROGUE_BANK_STRIDE, side);
    write(DROGUE_BANK_CONTROL, DROGUE_BANK_START);
    v.at = DROGUE_BANK_STATE;
    for (unsigned clocks = 1; clocks < 100000; clocks++) {
        v.frame_word = clocks * 0x2545F491u >> 2;
        tick();
        if (v.read == DROGUE_BANK_DONE) {
            return clocks;
        }
        if (v.read != DROGUE_BANK_BUSY) {
            printf("bank: side %u: state is %u after %u clocks\n", side, v.read, clocks);
            return 0;
        }
    }
    return 0;
}

} // namespace

int main()
{
    static const uint32_t sides[] = {1, 2, 16, 33, 0 /* refused */, 257 /* too wide */, 5};
    int failed = 0;
    v.reset = 1;
    tick();
    v.reset = 0;
    for (const uint32_t side : sides) {
        failed += run(side) == 0;
    }
    printf("bank: frames=%zu failed=%d\n", sizeof sides / sizeof sides[0], failed);
    return failed != 0;
}
