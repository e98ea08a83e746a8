/* SPDX-License-Identifier: Apache-2.0 */
/* Noise of an image. */
#include <string.h>

#include "drogue/frontend.h"

int32_t drogue_noise_threshold(uint32_t *histogram, const drogue_image *image)
{
    uint32_t count = 0;
    uint32_t below = 0;
    int32_t level = 0;
    int32_t x;
    int32_t y;
    memset(histogram, 0, 256 * sizeof(uint32_t));
    for (y = 0; y < image->height_px; y += 2) {
        const uint8_t *row = drogue_image_row(image, y);
        for (x = 1; x + 1 < image->width_px; x++) {
            const int32_t bend = row[x - 1] - 2 * row[x] + row[x + 1];
            const int32_t size = bend < 0 ? -bend : bend;
            histogram[size > 255 ? 255 : size]++;
            count++;
        }
    }
    if (count == 0 || 4 * histogram[0] >= count) { /* the quartile is within half a level of 0 */
        return 0;
    }
    /* bound: 256. The lower quartile: edges are above it */
    while (level < 255 && 4 * (below + histogram[level]) < count) {
        below += histogram[level++];
    }
    /* of a normal distribution it is 0.3186 deviations, those of the differences root 6 of the noise's; a bin reaches half
     * a level to either side */
    return (int32_t)drogue_div_round_s64(
        12 * 1000 *
            (2 * (int64_t)level * histogram[level] + 2 * (int64_t)(count / 4 - below) - (int64_t)histogram[level]),
        (int64_t)2 * 780 * histogram[level]);
}
