/* SPDX-License-Identifier: Apache-2.0 */
/* The library's src/inner/shade.c with its sums by the unit beside the soft core: a ray is an edge there, all of them within its
 * tolerance, and what has been summed up comes when it is solved for. */
#include "fit_sums.h"

static inline void add_by_unit(drogue_ray_sums *s, const drogue_ray *r, int32_t off_q16)
{
    uint32_t none;
    if (s->rays == 0) {
        UNIT(none, UNIT_FIT_PLACE, 0, 0, 0);
        UNIT(none, UNIT_FIT_BEGIN, 0, 0, INT32_MAX);
    }
    UNIT(none, UNIT_FIT_EDGE, 0, off_q16, 1);
    UNIT(none, UNIT_FIT_RAY, 0, r->nx_q14, r->ny_q14);
    (void)none;
    s->rays++;
}

static int solve_by_unit(drogue_q16 v[3], drogue_real normal[6], drogue_ray_sums *s, int size)
{
    if (s->rays > 0) {
        s->rays = 0;
        add_sums_of_unit(s);
    }
    return drogue_ray_sums_solve(v, normal, s, size);
}

/* As drogue_ray_along(), where it is called. */
static inline drogue_q16 along(const drogue_ray *r, const drogue_q16 v_px_q16[3])
{
    const int64_t shift = drogue_product(r->nx_q14, v_px_q16[0]) + drogue_product(r->ny_q14, v_px_q16[1]);
    return drogue_clamp_2_30(v_px_q16[2] + drogue_shr_round_s64(shift, 14));
}

#define drogue_ray_along along
#define drogue_ray_sums_add(s, r, weight, off_q16) add_by_unit(s, r, off_q16) /* they weigh 1 */
#define drogue_ray_sums_solve solve_by_unit
#include "../../src/inner/shade.c"
