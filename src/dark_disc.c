/* SPDX-License-Identifier: Apache-2.0 */
/* The inner part where it is expected: components within a disc, weighed by their grey. */
#include "dark_pass.h"
#include "drogue/wide.h"

static uint64_t distance2_q32(const drogue_dark_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    return drogue_square_sum(drogue_q16_sub(part->x_px_q16, x_px_q16), drogue_q16_sub(part->y_px_q16, y_px_q16));
}

static drogue_q16 distance_q16(const drogue_dark_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    return drogue_sat_s32((int64_t)drogue_isqrt_u64(distance2_q32(part, x_px_q16, y_px_q16)));
}

/* Components whose centroids lie within an expected disc, together; area 0 when there are none. */
static void components_within(drogue_dark_part *out, const drogue_dark_pass *p, const drogue_ellipse *expected,
                              uint32_t min_area)
{
    const drogue_workspace *w = p->workspace;
    const uint64_t reach2_q32 = drogue_square_sum(expected->a_px_q16, 0);
    int64_t x = 0;
    int64_t y = 0;
    uint32_t i;
    out->area_px = 0;
    for (i = 1; i < p->labels.count; i++) {
        const uint32_t area = w->component_strong[i];
        drogue_dark_part one;
        if (area < min_area || area == 0) {
            continue;
        }
        one.x_px_q16 = drogue_dark_mean_q16(w->arc_parent[i], area);
        one.y_px_q16 = drogue_dark_mean_q16(w->arc_component[i], area);
        if (distance2_q32(&one, expected->xc_px_q16, expected->yc_px_q16) <= reach2_q32) {
            out->area_px += area;
            x += w->arc_parent[i];
            y += w->arc_component[i];
        }
    }
    DROGUE_NOTE("centroid: coordinate sum of components", x > y ? x : y, 33);
    if (out->area_px > 0) {
        out->x_px_q16 = drogue_dark_mean_q16(x, out->area_px);
        out->y_px_q16 = drogue_dark_mean_q16(y, out->area_px);
    }
}

drogue_q16 drogue_dark_fill(const drogue_dark_part *part, const drogue_ellipse *expected)
{
    const drogue_wide box =
        drogue_wide_mul(drogue_wide_from_q16(expected->a_px_q16), drogue_wide_from_q16(expected->b_px_q16));
    return drogue_wide_to_q16(drogue_wide_div(drogue_wide_from_s64(part->area_px, 0),
                                              drogue_wide_mul(box, drogue_wide_from_q16(DROGUE_Q16_PI))));
}

/* How badly a part fits an expected disc: distance in its semi-axes plus the share by which the areas differ, Q16. */
static drogue_q16 misfit(const drogue_dark_part *part, const drogue_ellipse *expected)
{
    const drogue_q16 away =
        drogue_q16_div(distance_q16(part, expected->xc_px_q16, expected->yc_px_q16), expected->a_px_q16);
    const int64_t fill = (int64_t)drogue_dark_fill(part, expected) - DROGUE_Q16_ONE;
    return drogue_sat_s32(away + (fill < 0 ? -fill : fill));
}

/* Mean grey of levels first .. last, rounded down; 0 when there are none. */
static int32_t mean_level(const uint32_t *histogram, uint32_t first, uint32_t last)
{
    uint64_t count = 0;
    uint64_t sum = 0;
    uint32_t level;
    for (level = first; level <= last; level++) {
        count += histogram[level];
        sum += (uint64_t)histogram[level] * level;
    }
    return count > 0 ? (int32_t)(sum / count) : 0;
}

/* Disc about the part of a multiple of the expected semi-axis, and a pixel. */
static drogue_mask window_about(const drogue_dark_part *part, const drogue_ellipse *expected, drogue_q16 factor_q16)
{
    drogue_mask window; /* radius longest / 3 */
    window.centre2_x = (int32_t)drogue_shr_round_s64(part->x_px_q16, 15);
    window.centre2_y = (int32_t)drogue_shr_round_s64(part->y_px_q16, 15);
    window.longest_px = (int32_t)drogue_shr_round_s64(3 * (int64_t)expected->a_px_q16 * factor_q16, 32) + 3;
    return window;
}

/* Darkness falls from 1 to 0 between two grey levels: a pixel at the edge counts by its grey, one of the surround not at
 * all. */
typedef struct ramp {
    int32_t full;  /* level of darkness 'range' and more */
    int32_t range; /* levels to darkness 0 */
} ramp;

/* Centroid of darkness in a window; the part's place and area. */
static void weigh(drogue_dark_part *part, const drogue_image *image, const drogue_mask *window, const ramp *r)
{
    int64_t sum = 0;
    int64_t x_sum = 0;
    int64_t y_sum = 0;
    int32_t y;
    int32_t low;
    int32_t high;
    drogue_disc_rows(&low, &high, window, image->height_px);
    for (y = low; y <= high; y++) {
        const uint8_t *row = drogue_image_row(image, y);
        int32_t row_sum = 0;
        int32_t first;
        int32_t last;
        int32_t x;
        if (!drogue_disc_span(&first, &last, window, y, image->width_px)) {
            continue;
        }
        for (x = first; x <= last; x++) {
            const int32_t level = row[x] - r->full;
            const int32_t darkness = level < 0 ? r->range : level > r->range ? 0 : r->range - level;
            row_sum += darkness;
            x_sum += darkness * x;
        }
        sum += row_sum;
        y_sum += (int64_t)row_sum * y;
    }
    /* The range is at most 171 levels (2 / 3 of 255, and 1), over 2^22 pixels with coordinates below 2^11. */
    DROGUE_NOTE("centroid: sum of darkness", sum, 30);
    DROGUE_NOTE("centroid: x weighted by darkness", x_sum, 41);
    DROGUE_NOTE("centroid: y weighted by darkness", y_sum, 41);
    if (sum > 0) {
        part->x_px_q16 = drogue_dark_mean_q16(x_sum, sum);
        part->y_px_q16 = drogue_dark_mean_q16(y_sum, sum);
        part->area_px = (uint32_t)drogue_div_round_s64(sum, r->range);
    }
}

/* Weigh the part about its own threshold, that of a window about it, then at a third of the way to the dark level below
 * and above: the middle of the two, and how far apart they are. */
static void weigh_about(drogue_dark_part *part, uint32_t *histogram, const drogue_image *image,
                        const drogue_ellipse *expected)
{
    const drogue_mask around = window_about(part, expected, DROGUE_Q16(16, 10));
    drogue_mask window = window_about(part, expected, DROGUE_Q16(12, 10));
    drogue_dark_part lower;
    drogue_dark_part upper;
    ramp r;
    int32_t dark;
    int32_t bright;
    int32_t half;
    part->threshold = drogue_disc_threshold(histogram, image, &around);
    dark = mean_level(histogram, 0, part->threshold);
    bright = mean_level(histogram, part->threshold + 1u, 255);
    part->contrast = (uint8_t)(bright > dark ? bright - dark : 0);
    half = (part->threshold - dark) / 3;
    r.range = 2 * half + 1;
    r.full = part->threshold - half;
    weigh(part, image, &window, &r);
    window = window_about(part, expected, DROGUE_Q16(12, 10));
    weigh(part, image, &window, &r);
    lower = *part;
    upper = *part;
    r.full -= half;
    weigh(&lower, image, &window, &r);
    r.full += 2 * half;
    weigh(&upper, image, &window, &r);
    part->spread_px_q16 = distance_q16(&lower, upper.x_px_q16, upper.y_px_q16);
}

drogue_status drogue_dark_disc_find(drogue_dark_part *out, uint32_t *which, drogue_workspace *workspace,
                                    const drogue_image *image, const drogue_mask *disc, uint32_t min_area,
                                    const drogue_ellipse *expected, uint32_t count)
{
    drogue_dark_part part;
    drogue_dark_pass pass;
    drogue_q16 least = DROGUE_Q16_MAX;
    uint32_t i;
    drogue_status status = drogue_dark_components(&pass, out, workspace, image, disc);
    *which = 0;
    if (status != DROGUE_OK) {
        return status;
    }
    part = *out;
    for (i = 0; i < count; i++) {
        components_within(&part, &pass, &expected[i], min_area);
        if (part.area_px > 0 && misfit(&part, &expected[i]) < least) {
            least = misfit(&part, &expected[i]);
            *out = part;
            *which = i;
        }
    }
    if (least == DROGUE_Q16_MAX) {
        return DROGUE_E_NO_DARK_PART;
    }
    weigh_about(out, workspace->histogram, image, &expected[*which]);
    return DROGUE_OK;
}
