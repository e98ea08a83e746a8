/* SPDX-License-Identifier: Apache-2.0 */
/* Dark discs in block means, and the ring about each. */
#include "drogue/search.h"

#include <string.h>

#define SCALES 4
#define REACH DROGUE_SEARCH_REACH

/* The circle of eight cells (+-p, +-q), (+-q, +-p) lies between inner part and rim: about half the rim's radius. The
 * first serves the smallest drogues, in the first level alone. */
static const int32_t ring_p[SCALES] = {2, 3, 4, 5};
static const int32_t ring_q[SCALES] = {1, 1, 2, 2};
static const int32_t inner_at[SCALES] = {1, 1, 2, 2};    /* samples of the disc beside its centre */
static const int32_t ring_q4[SCALES] = {36, 51, 72, 86}; /* radius of the circle, 16ths of a cell */

drogue_status drogue_search_init(drogue_search *search, void *memory, size_t bytes, int32_t width_px)
{
    memset(search, 0, sizeof *search);
    if (memory == NULL || width_px < 1 || width_px > INT16_MAX) {
        return DROGUE_E_ARGUMENT;
    }
    if (bytes < DROGUE_SEARCH_BYTES(width_px)) {
        return DROGUE_E_WORKSPACE;
    }
    search->memory = (uint8_t *)memory;
    search->capacity_px = width_px;
    search->min_contrast = 6;
    return DROGUE_OK;
}

drogue_status drogue_search_begin(drogue_search *search, int32_t width_px)
{
    uint8_t *next;
    int k;
    if (width_px < 1 || search->memory == NULL || search->min_contrast < 0 || search->min_contrast > 255) {
        return DROGUE_E_ARGUMENT;
    }
    if (width_px > search->capacity_px) {
        return DROGUE_E_WORKSPACE;
    }
    next = search->memory + width_px; /* a row of pixels waits before it */
    search->width_px = width_px;
    search->rows_in = 0;
    search->count = 0;
    for (k = 0; k < DROGUE_SEARCH_LEVELS; k++) {
        drogue_search_level *level = &search->levels[k];
        level->rows = next;
        level->width = width_px >> (k + 1);
        level->rows_in = 0;
        level->pending_count = 0;
        next += DROGUE_SEARCH_ROWS * level->width;
    }
    return DROGUE_OK;
}

/* Are these about the same outline? */
static int same_outline(const drogue_sighting *b, const drogue_sighting *c)
{
    const int32_t larger = b->radius_px > c->radius_px ? b->radius_px : c->radius_px;
    const int32_t smaller = b->radius_px > c->radius_px ? c->radius_px : b->radius_px;
    const int32_t dx = b->x_px - c->x_px;
    const int32_t dy = b->y_px - c->y_px;
    return 5 * larger <= 6 * smaller && 2 * dx < larger && -2 * dx < larger && 2 * dy < larger && -2 * dy < larger;
}

/* Keep a sighting if it is among the best; of two of the same outline the better. They are sorted at the end. */
static void keep_sighting(drogue_search *search, const drogue_sighting *c)
{
    int32_t lowest = 0;
    int32_t i;
    for (i = search->count - 1; i >= 0; i--) {
        if (same_outline(&search->best[i], c)) {
            if (search->best[i].score >= c->score) {
                return;
            }
            search->count--;
            search->best[i] = search->best[search->count];
        }
    }
    if (search->count < DROGUE_SEARCH_MAX) {
        search->best[search->count++] = *c;
        return;
    }
    for (i = 1; i < search->count; i++) {
        if (search->best[i].score < search->best[lowest].score) {
            lowest = i;
        }
    }
    if (c->score > search->best[lowest].score) {
        search->best[lowest] = *c;
    }
}

static void sort_sightings(drogue_search *search)
{
    int32_t i;
    int32_t k;
    for (i = 0; i < search->count; i++) {
        for (k = i + 1; k < search->count; k++) {
            if (search->best[k].score > search->best[i].score) {
                const drogue_sighting t = search->best[i];
                search->best[i] = search->best[k];
                search->best[k] = t;
            }
        }
    }
}

/* Can a disc not be among the best, whatever its circles are? */
static int beaten(const drogue_search *search, const drogue_search_disc *disc)
{
    const uint32_t most = drogue_rim_most(disc);
    int32_t i;
    for (i = 0; i < search->count; i++) {
        if (search->best[i].score < most) {
            return 0;
        }
    }
    return search->count == DROGUE_SEARCH_MAX;
}

static void judge_disc(drogue_search *search, int k, const drogue_search_disc *disc)
{
    const int32_t cell_px = 2 << k;
    drogue_rim rims[DROGUE_RIMS];
    int32_t count;
    int32_t i;
    if (beaten(search, disc)) {
        return;
    }
    count = drogue_rim_find(rims, &search->levels[k], disc);
    for (i = 0; i < count; i++) {
        const drogue_rim *rim = &rims[i];
        drogue_sighting c;
        int32_t side;
        c.score = rim->score;
        c.x_px = (int32_t)(((16 * disc->x + 8 + rim->x_q4) * cell_px) >> 4);
        c.y_px = (int32_t)(((16 * disc->y + 8 + rim->y_q4) * cell_px) >> 4);
        c.radius_px = (int32_t)((rim->radius_q4 * cell_px) >> 4);
        side = (c.radius_px * 21) >> 3; /* 2.5 major semi-axes */
        side = side < DROGUE_MAX_SIDE ? side : DROGUE_MAX_SIDE;
        c.region.x_px = c.x_px - side / 2;
        c.region.y_px = c.y_px - side / 2;
        c.region.width_px = side;
        c.region.height_px = side;
        keep_sighting(search, &c);
    }
}

/* Judge the pending discs above row y, and forget them. */
static void judge_above(drogue_search *search, int k, int32_t y)
{
    drogue_search_level *level = &search->levels[k];
    int32_t kept = 0;
    int32_t i;
    for (i = 0; i < level->pending_count; i++) {
        if (level->pending[i].y < y) {
            judge_disc(search, k, &level->pending[i]);
        } else {
            level->pending[kept++] = level->pending[i];
        }
    }
    level->pending_count = kept;
}

/* Add a dark disc; of those beside each other the one of most contrast stays, and so when there are too many at once: what
 * a row of texture costs is bounded. */
static void keep_disc(drogue_search *search, int k, const drogue_search_disc *disc)
{
    drogue_search_level *level = &search->levels[k];
    const int32_t near = disc->ring_q4 >> 4;
    int32_t faintest = 0;
    int32_t i;
    for (i = 0; i < level->pending_count; i++) {
        drogue_search_disc *p = &level->pending[i];
        if (p->ring_q4 == disc->ring_q4 && disc->y - p->y <= near && disc->x - p->x <= near && p->x - disc->x <= near) {
            if (disc->contrast > p->contrast) {
                *p = *disc;
            }
            return;
        }
        if (p->contrast < level->pending[faintest].contrast) {
            faintest = i;
        }
    }
    if (level->pending_count < DROGUE_SEARCH_PENDING) {
        level->pending[level->pending_count++] = *disc;
    } else if (disc->contrast > level->pending[faintest].contrast) {
        level->pending[faintest] = *disc;
    }
}

/* Contrast of a dark disc at x: the second darkest of the eight cells about it less its mean; at most 'least' when
 * two of them are no brighter than the centre by more than that. */
static int32_t disc_contrast(const uint8_t *const rows[2 * REACH + 1], int32_t x, int scale, int32_t least)
{
    const int32_t p = ring_p[scale];
    const int32_t q = ring_q[scale];
    const int32_t i = inner_at[scale];
    const uint8_t *middle = rows[REACH] + x;
    const int32_t dim = *middle + least;
    int32_t lowest = 255;
    int32_t second = 255;
    int32_t v[8];
    int n;
    v[0] = rows[REACH - q][x - p];
    v[1] = rows[REACH + q][x + p];
    if (v[0] <= dim && v[1] <= dim) {
        return 0;
    }
    v[2] = rows[REACH - p][x + q];
    v[3] = rows[REACH + p][x - q];
    if ((v[0] <= dim) + (v[1] <= dim) + (v[2] <= dim) + (v[3] <= dim) > 1) {
        return 0;
    }
    v[4] = rows[REACH - p][x - q];
    v[5] = rows[REACH - q][x + p];
    v[6] = rows[REACH + q][x - p];
    v[7] = rows[REACH + p][x + q];
    for (n = 0; n < 8; n++) {
        if (v[n] < lowest) {
            second = lowest;
            lowest = v[n];
        } else if (v[n] < second) {
            second = v[n];
        }
    }
    return second - ((2 * *middle + middle[-i] + middle[i] + rows[REACH - i][x] + rows[REACH + i][x] + 3) / 6);
}

/* Look for dark discs centred in row y of a level. */
static void scan_row(drogue_search *search, int k, int32_t y)
{
    drogue_search_level *level = &search->levels[k];
    const uint8_t *rows[2 * REACH + 1];
    int32_t i;
    int scale;
    for (i = -REACH; i <= REACH; i++) {
        const int32_t at = y + i;
        rows[REACH + i] = drogue_search_level_row(level, at < 0 ? 0 : at >= level->rows_in ? level->rows_in - 1 : at);
    }
    for (scale = k == 0 ? 0 : 1; scale < SCALES; scale++) {
        const int32_t margin = ring_p[scale];
        int32_t x;
        if (y < margin || y + margin >= level->rows_in) {
            continue;
        }
        for (x = margin; x + margin < level->width; x++) {
            drogue_search_disc disc;
            disc.contrast = disc_contrast(rows, x, scale, search->min_contrast);
            if (disc.contrast > search->min_contrast) {
                disc.x = x;
                disc.y = y;
                disc.ring_q4 = ring_q4[scale];
                keep_disc(search, k, &disc);
            }
        }
    }
    judge_above(search, k, y - ring_p[SCALES - 1]);
}

/* out[x] = mean of two cells of each of two rows. */
static void halve(uint8_t *out, int32_t width, const uint8_t *above, const uint8_t *below)
{
    int32_t x;
    for (x = 0; x < width; x++) {
        out[x] = (uint8_t)((above[2 * x] + above[2 * x + 1] + below[2 * x] + below[2 * x + 1] + 2) >> 2);
    }
}

void drogue_search_row(drogue_search *search, const uint8_t *row)
{
    const uint8_t *above = search->memory;
    const uint8_t *below = row;
    int k;
    search->rows_in++;
    if (search->rows_in % 2 != 0) {
        memcpy(search->memory, row, (size_t)search->width_px);
        return;
    }
    for (k = 0; k < DROGUE_SEARCH_LEVELS; k++) {
        drogue_search_level *level = &search->levels[k];
        const int32_t y = level->rows_in;
        halve(level->rows + (y % DROGUE_SEARCH_ROWS) * level->width, level->width, above, below);
        level->rows_in++;
        if (y >= REACH) {
            scan_row(search, k, y - REACH);
        }
        if (level->rows_in % 2 != 0) {
            return;
        }
        above = drogue_search_level_row(level, y - 1);
        below = drogue_search_level_row(level, y);
    }
}

int32_t drogue_search_end(drogue_search *search)
{
    int k;
    for (k = 0; k < DROGUE_SEARCH_LEVELS; k++) {
        drogue_search_level *level = &search->levels[k];
        int32_t y;
        for (y = level->rows_in > REACH ? level->rows_in - REACH : 0; y < level->rows_in; y++) {
            scan_row(search, k, y);
        }
        judge_above(search, k, INT32_MAX);
    }
    sort_sightings(search);
    return search->count;
}
