/* SPDX-License-Identifier: Apache-2.0 */
/* drogue_hls_step() with registers in and registers out, for verilog.py: what becomes the block's combinational part. */
#include "../frontend/stages.h"

void drogue_hls_step_rtl(const drogue_hls_registers *restrict now, const drogue_hls_asked *restrict asked,
                         const drogue_hls_words *restrict read, drogue_hls_registers *restrict next,
                         drogue_hls_places *restrict places, drogue_hls_writes *restrict write);

void drogue_hls_step_rtl(const drogue_hls_registers *restrict now, const drogue_hls_asked *restrict asked,
                         const drogue_hls_words *restrict read, drogue_hls_registers *restrict next,
                         drogue_hls_places *restrict places, drogue_hls_writes *restrict write)
{
    drogue_hls_registers r = *now;
    drogue_hls_places p;
    drogue_hls_writes w;
    drogue_hls_step(&r, asked, read, &p, &w);
    *next = r;
    *places = p;
    *write = w;
}
