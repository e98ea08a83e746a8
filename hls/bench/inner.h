/* SPDX-License-Identifier: Apache-2.0 */
/* Test benches only: the words that the block of the inner inner part should give, from what the library says; 'status' is the
 * register. */
#ifndef DROGUE_HLS_BENCH_INNER_H
#define DROGUE_HLS_BENCH_INNER_H

#include "../inner/inner.h"
#include "drogue/inner.h"

static inline void bench_put_inner(int32_t dark[DROGUE_HLS_INNER_WORDS], uint32_t status, const drogue_inner_part *part,
                                   uint32_t which)
{
    dark[DROGUE_HLS_D_STATUS] = (int32_t)status;
    dark[DROGUE_HLS_D_X] = part->x_px_q16;
    dark[DROGUE_HLS_D_Y] = part->y_px_q16;
    dark[DROGUE_HLS_D_AREA] = (int32_t)part->area_px;
    dark[DROGUE_HLS_D_SPREAD] = part->spread_px_q16;
    dark[DROGUE_HLS_D_THRESHOLD] = part->threshold;
    dark[DROGUE_HLS_D_CONTRAST] = part->contrast;
    dark[DROGUE_HLS_D_WHICH] = (int32_t)which;
}

#endif
