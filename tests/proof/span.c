/* SPDX-License-Identifier: Apache-2.0 */
/* Columns of a disc's row, and the bits of its binary image. The integer root stands for what scalars.c proves of it. */
#include "proof.h"
#define drogue_isqrt_u64 root_by_contract
#include "inner/disc.c"
#undef drogue_isqrt_u64
#include "inner/components.c"

uint32_t root_by_contract(uint64_t v)
{
    const uint64_t r = nondet_u32();
    ASSUME(r <= 1 << 14 && r * r <= v && v < (r + 1) * (r + 1));
    return (uint32_t)r;
}

int64_t drogue_floor_div_s64(int64_t num, int64_t den) { return num / den; } /* of numbers that are not negative */

enum { SIDE = 32, COLUMNS = 36 };

void disc_span(void)
{
    drogue_mask m;
    int32_t first = 0;
    int32_t last = -1;
    const int32_t width = any_within(1, SIDE);
    const int32_t x = any_within(0, width - 1);
    const int32_t y = any_within(0, SIDE - 1);
    int found;
    m.centre2_x = any_within(-SIDE, 2 * SIDE);
    m.centre2_y = any_within(-SIDE, 2 * SIDE);
    m.longest_px = any_within(1, SIDE);
    found = drogue_disc_span(&first, &last, &m, y, width);
    PROVE(!found || (first >= 0 && last < width));
    PROVE((found && x >= first && x <= last) == drogue_mask_in_disc(&m, x, y));
}

void disc_rows(void)
{
    drogue_mask m;
    int32_t first;
    int32_t last;
    const int32_t height = any_within(1, DROGUE_MAX_SIDE);
    const int32_t x = any_within(0, DROGUE_MAX_SIDE - 1);
    const int32_t y = any_within(0, height - 1);
    m.centre2_x = nondet_s32();
    m.centre2_y = nondet_s32();
    m.longest_px = nondet_s32();
    ASSUME(drogue_mask_valid(&m));
    drogue_disc_rows(&first, &last, &m, height);
    PROVE(first >= 0 && last < height);
    PROVE(!drogue_mask_in_disc(&m, x, y) || (y >= first && y <= last));
}

/* Pixel x is bit x % 32 of word x / 32. */
static int bit_of(const uint32_t *words, int32_t x) { return (int)(words[x / 32] >> (x % 32) & 1u); }

void binary(void)
{
    uint8_t row[COLUMNS];
    uint32_t out[2] = {0, 0};
    const int32_t first = any_within(0, COLUMNS - 1);
    const int32_t last = any_within(first, COLUMNS - 1);
    const int32_t x = any_within(0, COLUMNS - 1);
    const uint32_t threshold = nondet_u8();
    int32_t k;
    for (k = 0; k < COLUMNS; k++) {
        row[k] = nondet_u8();
    }
    ASSUME(threshold < 255);
    binary_row(out, row, first, last, threshold);
    PROVE(bit_of(out, x) == (x >= first && x <= last && row[x] <= threshold));
}

static int at(const uint32_t *row, int32_t x, int32_t width, int outside)
{
    return x < 0 || x >= width ? outside : bit_of(row, x);
}

/* Opening of rows up to two words (run with neither constants propagated nor terms simplified: ESBMC 6.7 takes ~0u >> 31 for
 * -1): beyond the border everything is set for the erosion, nothing for the dilation. */
void opening(void)
{
    uint32_t words[3][2];
    const uint32_t *rows[3];
    uint32_t eroded[2];
    uint32_t dilated[2];
    const int32_t width = any_within(1, COLUMNS);
    const int32_t x = any_within(0, width - 1);
    const int32_t count = (width + 31) / 32;
    const uint32_t valid = width % 32 != 0 ? (UINT32_C(1) << (width % 32)) - 1 : ~UINT32_C(0);
    int all = 1;
    int any = 0;
    int32_t k;
    int32_t dx;
    for (k = 0; k < 3; k++) {
        words[k][0] = nondet_u32() & (count == 1 ? valid : ~UINT32_C(0));
        words[k][1] = nondet_u32() & (count == 1 ? 0 : valid);
        rows[k] = words[k];
        for (dx = -1; dx <= 1; dx++) {
            all &= at(words[k], x + dx, width, 1);
            any |= at(words[k], x + dx, width, 0);
        }
    }
    erode_row(eroded, rows, count, valid);
    dilate_row(dilated, rows, count, valid);
    PROVE(bit_of(eroded, x) == all);
    PROVE(bit_of(dilated, x) == any);
}
