/* SPDX-License-Identifier: Apache-2.0 */
/* Noise of an image of which little is noise. */
#include "suite.h"

#include "drogue/frontend.h"

/* Where a quarter of the second differences is 0 the quartile is within half a level of it: no noise to speak of. */
START_TEST(an_image_of_little_noise)
{
    static uint8_t rows[3][1002];
    static const drogue_image strip = {&rows[0][0], 1002, 3, 1002};
    uint32_t histogram[256];
    int flat, x, y;
    for (flat = 10; flat <= 60; flat += 2) { /* percent */
        int32_t threshold;
        for (y = 0; y < 3; y++) {
            for (x = 0; x < 1002; x++) { /* of 100 pixels so many are alike, the rest go up and down */
                const int at = x % 100;
                rows[y][x] = (uint8_t)(100 + (at < flat ? 0 : at % 2 != 0 ? 3 : 0));
            }
        }
        threshold = drogue_noise_threshold(histogram, &strip);
        MUST((threshold == 0) == (4 * histogram[0] >= 2000), "%d %%: %u of 2000 are 0, threshold %d", flat,
             (unsigned)histogram[0], threshold);
    }
}
END_TEST

SUITE_MAIN("noise", an_image_of_little_noise)
