/* SPDX-License-Identifier: Apache-2.0 */
/* The top and the passes that sum: histogram of a disc, darkness in a disc. */
#include "centroid.h"

#include "components.h"
#include "operators.h"

enum { LEVELS = 256, RAMPS = 3, MIDDLE = 1 };

static uint32_t histogram[LEVELS];

/* The two bins counted last: a table of two cycles' latency serves a pixel a cycle, whatever the levels are. */
typedef struct recent_bins {
    uint32_t level[2]; /* LEVELS: none */
    uint32_t count[2];
} recent_bins;

static void count_level(recent_bins *recent, uint32_t level)
{
    const uint32_t stored = histogram[level];
    const uint32_t count = (level == recent->level[0]   ? recent->count[0]
                            : level == recent->level[1] ? recent->count[1]
                                                        : stored) +
                           1;
    recent->level[1] = recent->level[0];
    recent->count[1] = recent->count[0];
    recent->level[0] = level;
    recent->count[0] = count;
    histogram[level] = count;
}

/* Otsu's threshold of a disc, which leaves its histogram. */
static uint8_t take_threshold(const uint8_t *pixels, uint32_t at, const drogue_hls_region *region,
                              const drogue_mask *disc)
{
    const int32_t width = region->width_px;
    const int32_t height = region->height_px;
    recent_bins recent = {{LEVELS, LEVELS}, {0, 0}};
    int32_t level;
    int32_t x;
    int32_t y;
    for (level = 0; level < LEVELS; level++) {
        histogram[level] = 0;
    }
    for (y = 0; y < height; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT
        const int64_t most_x9 = drogue_mask_disc_row(disc, y);
        for (x = 0; x < width; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
/* What the last two ticks wrote comes from registers. */
#pragma HLS dependence variable = histogram type = inter direction = RAW distance = 3 true
#endif
            const uint8_t pixel = pixels[at++];
            if (drogue_hls_in_disc(x, disc->centre2_x, most_x9) != 0) {
                count_level(&recent, pixel);
            }
        }
    }
    return drogue_otsu(histogram);
}

/* Darkness in a window about the part, by the lower, the middle and the upper ramp. */
static void take_darkness(drogue_dark_sums sums[RAMPS], const uint8_t *pixels, uint32_t at,
                          const drogue_hls_region *region, const drogue_mask *window, const drogue_dark_ramp *ramp)
{
    const int32_t width = region->width_px;
    const int32_t height = region->height_px;
    const int32_t step = drogue_dark_ramp_step(ramp);
    int32_t x;
    int32_t y;
    int32_t k;
    for (k = 0; k < RAMPS; k++) {
        sums[k].sum = 0;
        sums[k].x = 0;
        sums[k].y = 0;
    }
    for (y = 0; y < height; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT
        const int64_t most_x9 = drogue_mask_disc_row(window, y);
        int32_t row_sum[RAMPS] = {0, 0, 0};
        int32_t row_x[RAMPS] = {0, 0, 0};
        for (x = 0; x < width; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#endif
            const uint8_t pixel = pixels[at++];
            const uint32_t within = drogue_hls_in_disc(x, window->centre2_x, most_x9);
            for (k = 0; k < RAMPS; k++) { /* the pipeline unrolls it */
                const int32_t full = ramp->full + (k - MIDDLE) * step;
                const int32_t darkness = (int32_t)drogue_hls_darkness(pixel, full, ramp->range, within);
                row_sum[k] += darkness;
                row_x[k] += darkness * x;
            }
        }
        for (k = 0; k < RAMPS; k++) {
            drogue_dark_add_row(&sums[k], row_sum[k], row_x[k], y);
        }
    }
}

/* The last three passes: as the library weighs a part, with the three ramps in one pass. */
static void weigh(drogue_dark_part *part, const uint8_t *pixels, uint32_t at, const drogue_hls_region *region,
                  const drogue_ellipse *expected)
{
    const uint32_t frame = (uint32_t)(region->width_px * region->height_px);
    drogue_dark_sums sums[RAMPS];
    drogue_mask window;
    drogue_dark_ramp ramp;
    drogue_dark_part lower;
    drogue_dark_part upper;
    drogue_dark_window(&window, part, expected, DROGUE_DARK_WIDE);
    part->threshold = take_threshold(pixels, at, region, &window);
    drogue_dark_ramp_of(&ramp, part, histogram);
    drogue_dark_window(&window, part, expected, DROGUE_DARK_NARROW);
    take_darkness(sums, pixels, at + frame, region, &window, &ramp);
    drogue_dark_place(part, &sums[MIDDLE], &ramp);
    drogue_dark_window(&window, part, expected, DROGUE_DARK_NARROW);
    take_darkness(sums, pixels, at + 2 * frame, region, &window, &ramp);
    drogue_dark_place(part, &sums[MIDDLE], &ramp);
    lower = *part;
    upper = *part;
    drogue_dark_place(&lower, &sums[0], &ramp);
    drogue_dark_place(&upper, &sums[RAMPS - 1], &ramp);
    part->spread_px_q16 = drogue_dark_distance(&lower, upper.x_px_q16, upper.y_px_q16);
}

/* All five passes; without a part the last three are taken all the same, for nothing. */
static uint32_t find(drogue_dark_part *out, uint32_t *which, const uint8_t *pixels, const drogue_hls_region *region,
                     const drogue_mask *disc, uint32_t min_area, const drogue_ellipse expected[DROGUE_HLS_DISCS],
                     uint32_t count)
{
    const uint32_t frame = (uint32_t)(region->width_px * region->height_px);
    drogue_dark_part part = {0, 0, 0, 0, 0, 0};
    drogue_status status;
    uint32_t full;
    part.threshold = take_threshold(pixels, 0, region, disc);
    *out = part;
    drogue_hls_take_components(pixels, frame, region, disc, part.threshold, &full);
    status = drogue_hls_choose_components(&part, which, min_area, expected, count);
    weigh(&part, pixels, 2 * frame, region, &expected[*which]);
    if (full != 0) {
        *which = 0;
        return DROGUE_E_LABELS_FULL | DROGUE_HLS_DARK_FULL;
    }
    if (status == DROGUE_OK) {
        *out = part;
    }
    return (uint32_t)status;
}

static drogue_status check(const drogue_hls_region *region, const drogue_mask *disc, uint32_t count)
{
    if (region->width_px < 1 || region->width_px > DROGUE_MAX_SIDE || region->height_px < 1 ||
        region->height_px > DROGUE_MAX_SIDE || !drogue_mask_valid(disc) || count > DROGUE_HLS_DISCS) {
        return DROGUE_E_ARGUMENT;
    }
    return region->width_px > DROGUE_HLS_WIDTH || region->height_px > DROGUE_HLS_HEIGHT ? DROGUE_E_WORKSPACE
                                                                                        : DROGUE_OK;
}

void drogue_hls_centroid(const uint8_t pixels[DROGUE_HLS_DARK_PASSES * DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT],
                         const int32_t expected[DROGUE_HLS_DISCS * DROGUE_HLS_ELLIPSE_WORDS],
                         int32_t dark[DROGUE_HLS_DARK_WORDS], int32_t width_px, int32_t height_px, int32_t centre2_x,
                         int32_t centre2_y, int32_t longest_px, uint32_t min_area, uint32_t count)
{
#ifdef __BAMBU__
#pragma HLS interface port = pixels mode = fifo
#pragma HLS interface port = expected mode = m_axi
#pragma HLS interface port = dark mode = m_axi
#else
#pragma HLS interface port = pixels mode = axis
#pragma HLS interface port = expected mode = s_axilite
#pragma HLS interface port = dark mode = s_axilite
#pragma HLS interface port = width_px mode = s_axilite
#pragma HLS interface port = height_px mode = s_axilite
#pragma HLS interface port = centre2_x mode = s_axilite
#pragma HLS interface port = centre2_y mode = s_axilite
#pragma HLS interface port = longest_px mode = s_axilite
#pragma HLS interface port = min_area mode = s_axilite
#pragma HLS interface port = count mode = s_axilite
#pragma HLS interface port = return mode = s_axilite
#endif
    drogue_dark_part part = {0, 0, 0, 0, 0, 0};
    drogue_ellipse discs[DROGUE_HLS_DISCS];
    drogue_hls_region region;
    drogue_mask disc;
    uint32_t which = 0;
    uint32_t status;
    int32_t k;
    for (k = 0; k < DROGUE_HLS_DISCS; k++) {
        const int32_t *words = &expected[k * DROGUE_HLS_ELLIPSE_WORDS];
        discs[k].xc_px_q16 = words[0];
        discs[k].yc_px_q16 = words[1];
        discs[k].a_px_q16 = words[2];
        discs[k].b_px_q16 = words[3];
        discs[k].angle_rad_q16 = words[4];
    }
    region.width_px = width_px;
    region.height_px = height_px;
    disc.centre2_x = centre2_x;
    disc.centre2_y = centre2_y;
    disc.longest_px = longest_px;
    status = (uint32_t)check(&region, &disc, count);
    if (status == DROGUE_OK) {
        status = find(&part, &which, pixels, &region, &disc, min_area, discs, count);
    }
    dark[DROGUE_HLS_D_STATUS] = (int32_t)status;
    dark[DROGUE_HLS_D_X] = part.x_px_q16;
    dark[DROGUE_HLS_D_Y] = part.y_px_q16;
    dark[DROGUE_HLS_D_AREA] = (int32_t)part.area_px;
    dark[DROGUE_HLS_D_SPREAD] = part.spread_px_q16;
    dark[DROGUE_HLS_D_THRESHOLD] = part.threshold;
    dark[DROGUE_HLS_D_CONTRAST] = part.contrast;
    dark[DROGUE_HLS_D_WHICH] = (int32_t)which;
}
