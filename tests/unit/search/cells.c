/* SPDX-License-Identifier: Apache-2.0 */
/* Row loops of the search against a model, cell by cell: every scale, all lengths that vector loops split, shades from the
 * darkest to the brightest. */
#include "suite.h"

#include "cells.h"
#include "drogue/lanes.h"

enum { WIDTH = 150, ROWS = 2 * DROGUE_SEARCH_RING + 1 };

static int order(const void *a, const void *b) { return *(const uint8_t *)a - *(const uint8_t *)b; }

/* What is documented of a place, by sorting. */
static int model_contrast(uint8_t cells[ROWS][WIDTH], int x, int scale, int least)
{
    static const int q_of[DROGUE_SEARCH_SCALES] = {1, 1, 2, 2}, inner_of[DROGUE_SEARCH_SCALES] = {1, 1, 2, 2};
    const int y = DROGUE_SEARCH_RING, p = scale + 2, q = q_of[scale], i = inner_of[scale];
    uint8_t ring[8] = {cells[y - q][x - p], cells[y + q][x + p], cells[y - p][x + q], cells[y + p][x - q],
                       cells[y - p][x - q], cells[y - q][x + p], cells[y + q][x - p], cells[y + p][x + q]};
    const double mean = (2 * cells[y][x] + cells[y][x - i] + cells[y][x + i] + cells[y - i][x] + cells[y + i][x]) / 6.0;
    int dim = 0, n, contrast;
    for (n = 0; n < 4; n++) {
        dim += ring[n] <= cells[y][x] + least;
    }
    qsort(ring, 8, 1, order);
    contrast = ring[1] - (int)floor(mean + 0.5);
    return dim < 2 && contrast > least ? contrast : 0;
}

static void fill(uint8_t cells[ROWS][WIDTH], uint64_t *rng, int darkest, int brightest)
{
    int x, y;
    for (y = 0; y < ROWS; y++) {
        for (x = 0; x < WIDTH; x++) {
            cells[y][x] = (uint8_t)rng_range(rng, darkest, brightest);
        }
    }
}

START_TEST(contrasts_of_every_scale)
{
    static const int shades[][2] = {{0, 255}, {0, 3}, {240, 255}, {100, 130}, {0, 1}};
    static const int leasts[] = {0, 1, 6, 100, 254, 255};
    uint8_t cells[ROWS][WIDTH];
    const uint8_t *rows[ROWS];
    uint64_t rng = 7;
    int found = 0, n;
    for (n = 0; n < ROWS; n++) {
        rows[n] = cells[n];
    }
    for (n = 0; n < 4000; n++) {
        const int scale = n % DROGUE_SEARCH_SCALES, reach = scale + 2, least = leasts[n / 4 % 6];
        const int x = reach + (int)rng_range(&rng, 0, 20), count = (int)rng_range(&rng, 0, WIDTH - reach - x);
        uint8_t out[WIDTH + 1];
        int k;
        fill(cells, &rng, shades[n % 5][0], shades[n % 5][1]);
        if (n % 3 == 0) { /* a dark disc within bright cells, on either side of each limit */
            const int at = x + (count > 0 ? (int)rng_range(&rng, 0, count - 1) : 0);
            fill(cells, &rng, 250, 255);
            cells[DROGUE_SEARCH_RING][at] = (uint8_t)rng_range(&rng, 0, 255);
            for (k = 0; k < 2; k++) {
                cells[DROGUE_SEARCH_RING + (k > 0 ? reach : -reach)][at + (k > 0 ? 1 : -1) * (1 + scale / 2)] =
                    (uint8_t)(cells[DROGUE_SEARCH_RING][at] + least < 254 ? cells[DROGUE_SEARCH_RING][at] + least + k
                                                                          : 255);
            }
        }
        memset(out, 77, sizeof out);
        drogue_search_contrasts(out, rows, x, count, scale, least);
        for (k = 0; k < count; k++) {
            const int expected = model_contrast(cells, x + k, scale, least);
            MUST(out[k] == expected, "case %d: place %d of %d, scale %d, least %d: %d instead of %d", n, k, count,
                 scale, least, out[k], expected);
            found += expected > 0;
        }
        MUST(out[count] == 77, "case %d: written past the end", n);
    }
    MUST(found > 3000, "only %d contrasts", found);
}
END_TEST

START_TEST(halves_round_up)
{
    uint8_t cells[ROWS][WIDTH], out[WIDTH];
    uint64_t rng = 11;
    int n, x;
    for (n = 0; n <= WIDTH / 2; n++) {
        fill(cells, &rng, n % 2 == 0 ? 0 : 250, 255);
        memset(out, 77, sizeof out);
        drogue_search_halve(out, n, cells[0], cells[1]);
        for (x = 0; x < n; x++) {
            const double sum = cells[0][2 * x] + cells[0][2 * x + 1] + cells[1][2 * x] + cells[1][2 * x + 1];
            ck_assert_int_eq(out[x], (int)floor(sum / 4 + 0.5));
        }
        ck_assert_int_eq(out[n], 77);
    }
}
END_TEST

/* What is tested is the form that was asked for: on any machine one of them is not the usual. */
START_TEST(the_form_asked_for)
{
#ifdef EXPECTED_ROWS_PLAIN
    ck_assert_int_eq(DROGUE_ROWS_PLAIN, EXPECTED_ROWS_PLAIN);
#endif
}
END_TEST

SUITE_MAIN("cells", contrasts_of_every_scale, halves_round_up, the_form_asked_for)
