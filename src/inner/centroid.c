/* SPDX-License-Identifier: Apache-2.0 */
/* The inner part from sums over pixels: components chosen, threshold's ramp, place. Whoever passes over the image. */
#include "drogue/real.h"
#include "pass.h"

void drogue_inner_join(uint32_t *parent, uint32_t *area, uint32_t *x_sum, uint32_t *y_sum, uint32_t count)
{
    uint32_t i;
    drogue_labels_flatten(parent, count);
    for (i = 1; i < count; i++) {
        const uint32_t root = parent[i];
        if (root != i) {
            area[root] += area[i];
            x_sum[root] += x_sum[i];
            y_sum[root] += y_sum[i];
            area[i] = 0;
        }
    }
}

drogue_q16 drogue_inner_mean_q16(int64_t sum, int64_t count)
{
    drogue_real mean;
    drogue_real t;
    drogue_real_set(&mean, sum, 0);
    drogue_real_set(&t, count, 0);
    drogue_real_quotient(&mean, &mean, &t);
    return drogue_real_to_q16(mean);
}

static uint64_t distance2_q32(const drogue_inner_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    return drogue_square_sum(drogue_q16_sub(part->x_px_q16, x_px_q16), drogue_q16_sub(part->y_px_q16, y_px_q16));
}

drogue_q16 drogue_inner_distance(const drogue_inner_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    return drogue_sat_s32((int64_t)drogue_isqrt_u64(distance2_q32(part, x_px_q16, y_px_q16)));
}

/* Components whose centroids lie within an expected disc, together; area 0 when there are none. */
static void components_within(drogue_inner_part *out, const uint32_t *area, const uint32_t *x_sum,
                              const uint32_t *y_sum, uint32_t labels, uint32_t min_area, const drogue_ellipse *expected)
{
    const uint64_t reach2_q32 = drogue_square_sum(expected->a_px_q16, 0);
    int64_t x = 0;
    int64_t y = 0;
    uint32_t i;
    out->area_px = 0;
    for (i = 1; i < labels; i++) {
        drogue_inner_part one;
        if (area[i] < min_area || area[i] == 0) {
            continue;
        }
        one.x_px_q16 = drogue_inner_mean_q16(x_sum[i], area[i]);
        one.y_px_q16 = drogue_inner_mean_q16(y_sum[i], area[i]);
        if (distance2_q32(&one, expected->xc_px_q16, expected->yc_px_q16) <= reach2_q32) {
            out->area_px += area[i];
            x += x_sum[i];
            y += y_sum[i];
        }
    }
    DROGUE_NOTE("centroid: coordinate sum of components", x > y ? x : y, 33);
    if (out->area_px > 0) {
        out->x_px_q16 = drogue_inner_mean_q16(x, out->area_px);
        out->y_px_q16 = drogue_inner_mean_q16(y, out->area_px);
    }
}

drogue_q16 drogue_inner_fill(const drogue_inner_part *part, const drogue_ellipse *expected)
{
    drogue_real box;
    drogue_real t;
    drogue_real_set(&box, (int64_t)expected->a_px_q16 * expected->b_px_q16, -32);
    drogue_real_set_q16(&t, DROGUE_Q16_PI);
    drogue_real_product(&box, &box, &t);
    drogue_real_set(&t, part->area_px, 0);
    drogue_real_quotient(&t, &t, &box);
    return drogue_real_to_q16(t);
}

/* How badly a part fits an expected disc: distance in its semi-axes plus the share by which the areas differ, Q16. */
static drogue_q16 misfit(const drogue_inner_part *part, const drogue_ellipse *expected)
{
    const drogue_q16 away =
        drogue_q16_div(drogue_inner_distance(part, expected->xc_px_q16, expected->yc_px_q16), expected->a_px_q16);
    const int64_t fill = (int64_t)drogue_inner_fill(part, expected) - DROGUE_Q16_ONE;
    return drogue_sat_s32(away + (fill < 0 ? -fill : fill));
}

/* Mean grey of levels first .. end - 1, rounded down; 0 when there are none. 32 bits hold 2^22 pixels' levels. */
static int32_t mean_level(const uint32_t *histogram, uint32_t first, uint32_t end)
{
    uint32_t count = 0;
    uint32_t sum = 0;
    uint32_t level;
    for (level = first; level < end; level++) {
        count += histogram[level];
        sum += histogram[level] * level;
    }
    return count > 0 ? (int32_t)(sum / count) : 0;
}

drogue_status drogue_inner_choose(drogue_inner_part *out, uint32_t *which, const uint32_t *area, const uint32_t *x_sum,
                                  const uint32_t *y_sum, uint32_t labels, const drogue_inner_expected *expected)
{
    drogue_inner_part part = *out;
    drogue_q16 least = DROGUE_Q16_MAX;
    uint32_t i;
    *which = 0;
    for (i = 0; i < expected->count; i++) { /* bound: 2 */
        drogue_q16 off;
        components_within(&part, area, x_sum, y_sum, labels, expected->min_area_px, &expected->disc[i]);
        off = misfit(&part, &expected->disc[i]);
        if (part.area_px > 0 && off < least) {
            least = off;
            *out = part;
            *which = i;
        }
    }
    return least == DROGUE_Q16_MAX ? DROGUE_E_NO_INNER_PART : DROGUE_OK;
}

void drogue_inner_window(drogue_mask *window, const drogue_inner_part *part, drogue_q16 a_px_q16, drogue_q16 factor_q16)
{
    window->centre2_x = (int32_t)drogue_shr_round_s64(part->x_px_q16, 15);
    window->centre2_y = (int32_t)drogue_shr_round_s64(part->y_px_q16, 15);
    window->longest_px = (int32_t)drogue_shr_round_s64(3 * (int64_t)a_px_q16 * factor_q16, 32) + 3;
}

void drogue_inner_ramp_of(drogue_inner_ramp *ramp, drogue_inner_part *part, const uint32_t *histogram)
{
    const int32_t dark = mean_level(histogram, 0, part->threshold + 1u);
    const int32_t bright = mean_level(histogram, part->threshold + 1u, 256);
    const int32_t half = (part->threshold - dark) / 3;
    part->contrast = (uint8_t)(bright > dark ? bright - dark : 0);
    ramp->range = 2 * half + 1;
    ramp->full = part->threshold - half;
}

void drogue_inner_place(drogue_inner_part *part, const drogue_inner_sums *sums, const drogue_inner_ramp *ramp)
{
    DROGUE_NOTE("centroid: sum of darkness", sums->sum, 30);
    DROGUE_NOTE("centroid: x weighted by darkness", sums->x, 41);
    DROGUE_NOTE("centroid: y weighted by darkness", sums->y, 41);
    if (sums->sum > 0) {
        part->x_px_q16 = drogue_inner_mean_q16(sums->x, sums->sum);
        part->y_px_q16 = drogue_inner_mean_q16(sums->y, sums->sum);
        part->area_px = (uint32_t)drogue_div_round_s64(sums->sum, ramp->range);
    }
}
