/* SPDX-License-Identifier: Apache-2.0 */
/* Inner inner part as a block: the region's pixels in, five times over, the part out. No frame store. */
#ifndef DROGUE_HLS_INNER_H
#define DROGUE_HLS_INNER_H

#include "../drogue_hls.h"

/* How often the region is sent: for the threshold of the disc; for its components; for the threshold of a window about
 * those chosen; to weigh their darkness; to weigh it about the place found. */
#define DROGUE_HLS_INNER_PASSES 5

#define DROGUE_HLS_DISCS 2 /* expected discs at most */

/* The part: words of drogue_inner_part, what drogue_inner_find() returns and its 'which'. */
enum drogue_hls_inner_word {
    DROGUE_HLS_D_STATUS, /* status register */
    DROGUE_HLS_D_X,      /* coordinates of the region */
    DROGUE_HLS_D_Y,
    DROGUE_HLS_D_AREA,
    DROGUE_HLS_D_SPREAD,
    DROGUE_HLS_D_THRESHOLD,
    DROGUE_HLS_D_CONTRAST,
    DROGUE_HLS_D_WHICH, /* of the expected discs, 0 or 1 */
    DROGUE_HLS_INNER_WORDS
};

/* One frame, as drogue_inner_find() with a workspace of DROGUE_HLS_WIDTH and _LABELS.
 *
 *  pixels      in, stream: width_px * height_px grey levels in raster order, DROGUE_HLS_INNER_PASSES times without a gap
 *              between. All are taken whatever the result is; none when the status is DROGUE_E_ARGUMENT or
 *              DROGUE_E_WORKSPACE
 *  expected    in: 'count' discs, coordinates of the region; angles are not looked at
 *  dark        out, all words in every case: the part. THRESHOLD is the disc's when there is no part or a table filled,
 *              the others are 0 then
 *  width_px    [1, DROGUE_HLS_WIDTH];  height_px  [1, DROGUE_HLS_HEIGHT]
 *  centre2_x, centre2_y, longest_px   drogue_mask: where to look, a disc of radius longest / 3
 *  min_area    least area of a component, px
 *  count       [0, DROGUE_HLS_DISCS]
 *  STATUS      DROGUE_OK, DROGUE_E_NO_INNER_PART, DROGUE_E_LABELS_FULL with DROGUE_HLS_INNER_FULL, DROGUE_E_ARGUMENT,
 *              DROGUE_E_WORKSPACE (a side larger than the block was made for)
 */
void drogue_hls_inner(const uint8_t pixels[DROGUE_HLS_INNER_PASSES * DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT],
                      const int32_t expected[DROGUE_HLS_DISCS * DROGUE_HLS_ELLIPSE_WORDS],
                      int32_t dark[DROGUE_HLS_INNER_WORDS], int32_t width_px, int32_t height_px, int32_t centre2_x,
                      int32_t centre2_y, int32_t longest_px, uint32_t min_area, uint32_t count);

#endif
