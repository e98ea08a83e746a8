/* SPDX-License-Identifier: Apache-2.0 */
/* The inner part where it is expected: components within a disc, weighed by their grey. */
#include "pass.h"

/* Centroid of darkness in a window. */
static void weigh(drogue_inner_part *part, const drogue_image *image, const drogue_mask *window,
                  const drogue_inner_ramp *ramp)
{
    drogue_inner_sums sums = {0, 0, 0};
    int32_t y;
    int32_t low;
    int32_t high;
    drogue_disc_rows(&low, &high, window, image->height_px);
    for (y = low; y <= high; y++) {
        const uint8_t *row = drogue_image_row(image, y);
        int32_t sum = 0;
        int32_t x_sum = 0;
        int32_t first;
        int32_t last;
        int32_t x;
        if (!drogue_disc_span(&first, &last, window, y, image->width_px)) {
            continue;
        }
        for (x = first; x <= last; x++) {
            const int32_t darkness = drogue_inner_darkness(row[x], ramp);
            sum += darkness;
            x_sum += darkness * x;
        }
        drogue_inner_add_row(&sums, sum, x_sum, y);
    }
    drogue_inner_place(part, &sums, ramp);
}

/* Weigh the part about its own threshold, that of a window about it, then at the lower and the upper ramp: the middle
 * of the two, and how far apart they are. */
static void weigh_about(drogue_inner_part *part, uint32_t *histogram, const drogue_image *image, drogue_q16 a_px_q16)
{
    drogue_mask window;
    drogue_inner_part lower;
    drogue_inner_part upper;
    drogue_inner_ramp ramp;
    drogue_inner_window(&window, part, a_px_q16, DROGUE_INNER_WIDE);
    part->threshold = drogue_disc_threshold(histogram, image, &window);
    drogue_inner_ramp_of(&ramp, part, histogram);
    drogue_inner_window(&window, part, a_px_q16, DROGUE_INNER_NARROW);
    weigh(part, image, &window, &ramp);
    drogue_inner_window(&window, part, a_px_q16, DROGUE_INNER_NARROW);
    weigh(part, image, &window, &ramp);
    lower = *part;
    upper = *part;
    ramp.full -= drogue_inner_ramp_step(&ramp);
    weigh(&lower, image, &window, &ramp);
    ramp.full += 2 * drogue_inner_ramp_step(&ramp);
    weigh(&upper, image, &window, &ramp);
    part->spread_px_q16 = drogue_inner_distance(&lower, upper.x_px_q16, upper.y_px_q16);
}

drogue_status drogue_inner_find(drogue_inner_part *out, uint32_t *which, drogue_workspace *workspace,
                                const drogue_image *image, const drogue_mask *disc,
                                const drogue_inner_expected *expected)
{
    drogue_inner_pass pass;
    drogue_status status = drogue_inner_components(&pass, out, workspace, image, disc);
    *which = 0;
    if (status == DROGUE_OK) {
        status = drogue_inner_choose(out, which, workspace->component_strong, workspace->arc_parent,
                                     workspace->arc_component, pass.labels.count, expected);
    }
    if (status == DROGUE_OK) {
        weigh_about(out, workspace->histogram, image, expected->disc[*which].a_px_q16);
    }
    return status;
}
