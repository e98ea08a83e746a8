/* SPDX-License-Identifier: Apache-2.0 */
/* Least squares over rays by the unit beside the soft core, in the place of the library's function; that one does those
 * that are weighted. */
#define REAL_WHERE_CALLED
#include "real.c"

#define drogue_ray_sums_add_edges add_edges_by_core
#define drogue_ray_sums_settle settle_by_core /* left out by the linker */
#include "../../src/inner/fit.c"
#undef drogue_ray_sums_add_edges

#include "fit_sums.h"

/* Add the edge that the unit chose on the ray that it was told last. */
static inline void take(int32_t *slopes_q8, int32_t *levels_q8, const drogue_ray *r)
{
    int32_t which;
    UNIT(which, UNIT_FIT_WHICH, 0, 0, 0);
    if (which >= 0) {
        *slopes_q8 += r->edges[which].slope_q8;
        *levels_q8 += r->edges[which].level_q8;
    }
}

void drogue_ray_sums_add_edges(drogue_ray_sums *s, drogue_ray_bins *bins, const drogue_ray rays[RAYS],
                               const drogue_q16 v_px_q16[3], drogue_q16 within_px_q16)
{
    const drogue_ray *told = NULL; /* whose choice is to come */
    const drogue_ray *r;
    int32_t slopes_q8 = s->slopes_q8;
    int32_t levels_q8 = s->levels_q8;
    uint32_t none;
    if (bins != NULL) {
        add_edges_by_core(s, bins, rays, v_px_q16, within_px_q16);
        return;
    }
    UNIT(none, UNIT_FIT_PLACE, 0, v_px_q16[0], v_px_q16[1]);
    UNIT(none, UNIT_FIT_BEGIN, 0, v_px_q16[2], within_px_q16);
    for (r = rays; r < rays + RAYS; r++) {
        const uint32_t count = r->count;
        const int32_t at_px_q16 = r->edges[0].at_px_q16; /* loaded before it is known whether there is one */
        const int32_t slope_q8 = r->edges[0].slope_q8;
        const int32_t nx_q14 = r->nx_q14;
        const int32_t ny_q14 = r->ny_q14;
        if (count > 0) {
            uint32_t i;
            UNIT(none, UNIT_FIT_EDGE, 0, at_px_q16, slope_q8);
            for (i = 1; i < count; i++) { /* bound: DROGUE_RAY_EDGES */
                UNIT(none, UNIT_FIT_EDGE, 0, r->edges[i].at_px_q16, r->edges[i].slope_q8);
            }
            if (told != NULL) {
                take(&slopes_q8, &levels_q8, told);
            }
            UNIT(none, UNIT_FIT_RAY, 0, nx_q14, ny_q14);
            told = r;
        }
    }
    (void)none;
    if (told != NULL) {
        take(&slopes_q8, &levels_q8, told);
    }
    s->slopes_q8 = slopes_q8;
    s->levels_q8 = levels_q8;
    add_sums_of_unit(s);
}
