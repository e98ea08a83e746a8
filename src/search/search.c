/* SPDX-License-Identifier: Apache-2.0 */
/* Dark discs in block means, and the ring about each. */
#include "drogue/search.h"

#include <string.h>

#include "cells.h"
#include "dark.h"
#include "sightings.h"

#define SCALES DROGUE_SEARCH_SCALES
#define REACH DROGUE_SEARCH_REACH
#define RING DROGUE_SEARCH_RING
#define PLACES 128 /* looked at together */

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
    const drogue_status status = width_px < 1 || search->min_contrast < 0 || search->min_contrast > 255
                                     ? DROGUE_E_ARGUMENT
                                 : width_px > search->capacity_px ? DROGUE_E_WORKSPACE
                                                                  : DROGUE_OK;
    const int32_t width = status == DROGUE_OK ? width_px : 0; /* refused it is in an empty frame */
    uint8_t *next;
    int k;
    if (search->memory == NULL) {
        return DROGUE_E_ARGUMENT; /* it was not set up */
    }
    next = search->memory + width; /* a row of pixels waits before it */
    search->width_px = width;
    search->rows_in = 0;
    search->count = 0;
    search->dark_count = 0;
    for (k = 0; k < DROGUE_SEARCH_LEVELS; k++) {
        drogue_search_level *level = &search->levels[k];
        level->rows = next;
        level->width = width >> (k + 1);
        level->rows_in = 0;
        level->pending_count = 0;
        next += DROGUE_SEARCH_ROWS * level->width;
    }
    return status;
}

/* A circle about a disc, in pixels. */
static void put_sighting(drogue_sighting *out, const drogue_rim *rim, const drogue_search_disc *disc, int k)
{
    const int32_t cell_px = 2 << k;
    out->score = rim->score;
    out->x_px = (int32_t)(((16 * disc->x + 8 + rim->x_q4) * cell_px) >> 4);
    out->y_px = (int32_t)(((16 * disc->y + 8 + rim->y_q4) * cell_px) >> 4);
    out->radius_px = (int32_t)((rim->radius_q4 * cell_px) >> 4);
    drogue_sighting_frame(out);
}

static void judge_disc(drogue_search *search, int k, const drogue_search_disc *disc)
{
    const drogue_search_level *level = &search->levels[k];
    const uint32_t least = drogue_sightings_least(search->best, search->count, DROGUE_SEARCH_MAX);
    drogue_rim rims[DROGUE_RIMS];
    drogue_sighting c;
    int32_t count;
    int32_t i;
    if (drogue_dark_find(rims, level, disc,
                         drogue_sightings_least(search->dark, search->dark_count, DROGUE_SEARCH_DARK))) {
        put_sighting(&c, rims, disc, k);
        drogue_sightings_keep(search->dark, &search->dark_count, DROGUE_SEARCH_DARK, &c);
    }
    if (drogue_rim_most(disc) <= least) {
        return;
    }
    count = drogue_rim_find(rims, level, disc, least);
    for (i = 0; i < count; i++) {
        put_sighting(&c, &rims[i], disc, k);
        drogue_sightings_keep(search->best, &search->count, DROGUE_SEARCH_MAX, &c);
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

/* Add a dark disc of more contrast than the faintest of a full list; of those beside each other the one of most
 * contrast stays, and so when there are too many at once: what a row of texture costs is bounded. */
static void keep_disc(drogue_search_level *level, const drogue_search_disc *disc)
{
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
    } else {
        level->pending[faintest] = *disc;
    }
}

/* Up to which contrast a disc in row y changes nothing of the list: beside pending ones the least of theirs, elsewhere
 * the faintest's of a full list. 255, while it is sought, is also where none is near. */
static void limit_contrasts(uint8_t limits[PLACES], const drogue_search_level *level, int32_t x, int32_t y,
                            int32_t radius_q4)
{
    const int32_t near = radius_q4 >> 4;
    int32_t faintest = level->pending_count < DROGUE_SEARCH_PENDING ? 0 : 255;
    int32_t i;
    int32_t n;
    for (i = 0; i < level->pending_count && faintest > 0; i++) {
        faintest = level->pending[i].contrast < faintest ? level->pending[i].contrast : faintest;
    }
    memset(limits, 255, PLACES);
    for (i = 0; i < level->pending_count; i++) {
        const drogue_search_disc *p = &level->pending[i];
        if (p->ring_q4 == radius_q4 && y - p->y <= near) {
            const int32_t end = p->x + near + 1 - x < PLACES ? p->x + near + 1 - x : PLACES;
            for (n = p->x - near > x ? p->x - near - x : 0; n < end; n++) {
                limits[n] = p->contrast < limits[n] ? (uint8_t)p->contrast : limits[n];
            }
        }
    }
    for (n = 0; n < PLACES; n++) {
        limits[n] = limits[n] < 255 ? limits[n] : (uint8_t)faintest;
    }
}

/* Add the dark discs among places from x on in row y. */
static void keep_discs(drogue_search *search, int k, const uint8_t contrasts[PLACES], int32_t x, int32_t y, int scale)
{
    uint8_t limits[PLACES];
    int known = 0;
    int32_t n;
    for (n = 0; n < PLACES; n++) {
        uint64_t eight;
        memcpy(&eight, &contrasts[n & ~7], sizeof eight);
        if (eight == 0) {
            n |= 7;
            continue;
        }
        if (contrasts[n] > 0 && !known) {
            limit_contrasts(limits, &search->levels[k], x, y, ring_q4[scale]);
            known = 1;
        }
        if (contrasts[n] > 0 && contrasts[n] > limits[n]) {
            drogue_search_disc disc;
            disc.x = x + n;
            disc.y = y;
            disc.ring_q4 = ring_q4[scale];
            disc.contrast = contrasts[n];
            keep_disc(&search->levels[k], &disc);
            known = 0; /* the list may be another */
        }
    }
}

/* Look for dark discs centred in row y of a level. */
static void scan_row(drogue_search *search, int k, int32_t y)
{
    drogue_search_level *level = &search->levels[k];
    const uint8_t *rows[2 * RING + 1];
    int32_t i;
    int scale;
    for (i = -RING; i <= RING; i++) {
        const int32_t at = y + i;
        rows[RING + i] = drogue_search_level_row(level, at < 0 ? 0 : at >= level->rows_in ? level->rows_in - 1 : at);
    }
    for (scale = k == 0 ? 0 : 1; scale < SCALES; scale++) {
        const int32_t margin = drogue_ring_p[scale];
        int32_t x;
        if (y < margin || y + margin >= level->rows_in) {
            continue;
        }
        for (x = margin; x + margin < level->width; x += PLACES) {
            const int32_t left = level->width - margin - x;
            uint8_t contrasts[PLACES] = {0};
            drogue_search_contrasts(contrasts, rows, x, left < PLACES ? left : PLACES, scale, search->min_contrast);
            keep_discs(search, k, contrasts, x, y, scale);
        }
    }
    judge_above(search, k, y - RING);
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
        drogue_search_halve(level->rows + (y % DROGUE_SEARCH_ROWS) * level->width, level->width, above, below);
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
    drogue_sightings_sort(search->best, search->count);
    drogue_sightings_sort(search->dark, search->dark_count);
    return search->count;
}
