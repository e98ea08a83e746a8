/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for least squares over rays: the library's own functions, of which unit.sh makes Verilog. */
#include "fit_unit.h"

#include "../../src/inner/fit.c"

void fit_unit_ray(const fit_asked *restrict asked, fit_sums *restrict out)
{
    const fit_asked a = *asked;
    drogue_ray_sums s;
    drogue_ray r;
    drogue_q16 expected;
    int32_t off_q16 = 0;
    int64_t most = 0;
    int32_t which = -1;
    int i;
    r.nx_q14 = (int16_t)a.nx_q14; /* they have 16 bits */
    r.ny_q14 = (int16_t)a.ny_q14;
    expected = drogue_ray_along(&r, a.v_px_q16);
    for (i = 0; i < DROGUE_RAY_EDGES; i++) {
        const int32_t own = i + (int32_t)a.count - DROGUE_RAY_EDGES;
        const drogue_ray_edge e = {a.edges[i][0], a.edges[i][1], 0};
        const int64_t merit = merit_of(&e, expected, a.within_px_q16);
        if (own >= 0 && merit > most) {
            most = merit;
            which = own;
            off_q16 = e.at_px_q16 - expected;
        }
    }
    for (i = 0; i < 5; i++) {
        s.normal[i] = a.sums.normal[i];
    }
    for (i = 0; i < 3; i++) {
        s.right[i] = a.sums.right[i];
    }
    s.normal[5] = 0;
    s.squares_q16 = a.sums.squares_q16;
    s.rays = a.sums.rays;
    if (which >= 0) {
        drogue_ray_sums_add(&s, &r, 1, off_q16);
    }
    for (i = 0; i < 5; i++) {
        out->normal[i] = s.normal[i];
    }
    for (i = 0; i < 3; i++) {
        out->right[i] = s.right[i];
    }
    out->squares_q16 = s.squares_q16;
    out->rays = s.rays;
    out->which = which;
}
