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

static const uint8_t ring_q4[SCALES] = {36, 51, 72, 86}; /* radius of the circle, 16ths of a cell */

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
        level->pending.count = 0;
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

static drogue_search_disc pending_disc(const drogue_search_pending *p, int32_t i)
{
    const drogue_search_disc disc = {p->x[i], p->y[i], p->ring_q4[i], p->contrast[i]};
    return disc;
}

static void put_pending(drogue_search_pending *p, int32_t i, const drogue_search_disc *disc)
{
    p->x[i] = disc->x;
    p->y[i] = disc->y;
    p->ring_q4[i] = disc->ring_q4;
    p->contrast[i] = disc->contrast;
}

/* Judge the pending discs above row y, and forget them. */
static void judge_above(drogue_search *search, int k, int32_t y)
{
    drogue_search_pending *p = &search->levels[k].pending;
    int32_t kept = 0;
    int32_t i;
    for (i = 0; i < p->count; i++) {
        const drogue_search_disc disc = pending_disc(p, i);
        if (disc.y < y) {
            judge_disc(search, k, &disc);
        } else {
            put_pending(p, kept++, &disc);
        }
    }
    p->count = kept;
}

/* The first of n places that is not 0, from one on; n where there is none. n is a multiple of four. */
static int32_t next_place(const uint8_t *places, int32_t from, int32_t n)
{
    int32_t i;
    for (i = from; i < n && places[i] == 0; i++) {
        uint32_t four;
        memcpy(&four, &places[i & ~3], sizeof four);
        if (four == 0) {
            i |= 3;
        }
    }
    return i;
}

/* Mark the pending discs of a scale that discs of it in row y, cells first to last, would lie beside. */
static void mark_beside(uint8_t marks[DROGUE_SEARCH_PENDING], const drogue_search_pending *p, int32_t radius_q4,
                        int32_t y, int32_t first, int32_t last)
{
    const int32_t near = radius_q4 >> 4;
    const int32_t lowest = y - near;
    const int32_t left = first - near;
    const int32_t right = last + near;
    int32_t i;
    for (i = 0; i < DROGUE_SEARCH_PENDING; i++) { /* of one length, for vector instructions */
        marks[i] = (i < p->count) & (p->ring_q4[i] == radius_q4) & (p->y[i] >= lowest) & (p->x[i] >= left) &
                   (p->x[i] <= right);
    }
}

static int32_t least_contrast(const drogue_search_pending *p)
{
    int32_t least = 255;
    int32_t i;
    for (i = 0; i < p->count; i++) {
        least = p->contrast[i] < least ? p->contrast[i] : least;
    }
    return least;
}

/* Add a dark disc of more contrast than the faintest of a full list; of those beside each other the one of most
 * contrast stays, and so when there are too many at once: what a row of texture costs is bounded. */
static void keep_disc(drogue_search_pending *p, const drogue_search_disc *disc)
{
    uint8_t marks[DROGUE_SEARCH_PENDING];
    int32_t i;
    mark_beside(marks, p, disc->ring_q4, disc->y, disc->x, disc->x);
    i = next_place(marks, 0, DROGUE_SEARCH_PENDING);
    if (i < DROGUE_SEARCH_PENDING) {
        if (disc->contrast <= p->contrast[i]) {
            return;
        }
    } else if (p->count < DROGUE_SEARCH_PENDING) {
        i = p->count++;
    } else {
        const int32_t faintest = least_contrast(p);
        i = 0;
        while (p->contrast[i] > faintest) { /* one is not */
            i++;
        }
    }
    put_pending(p, i, disc);
}

/* Mark the places from x on in row y whose disc would change the list: beside pending ones those of more contrast than
 * the least of theirs, elsewhere those of more than the faintest of a full list. */
static void mark_discs(uint8_t marks[PLACES], const uint8_t contrasts[PLACES], const drogue_search_pending *p,
                       int32_t x, int32_t y, int32_t radius_q4)
{
    const int32_t near = radius_q4 >> 4;
    const int32_t elsewhere = p->count < DROGUE_SEARCH_PENDING ? 0 : least_contrast(p);
    uint8_t limits[PLACES + 4 * RING]; /* from 2 RING places before x on; 255: none is near */
    uint8_t beside[DROGUE_SEARCH_PENDING];
    int32_t i;
    int32_t n;
    memset(limits, 255, sizeof limits);
    mark_beside(beside, p, radius_q4, y, x, x + PLACES - 1);
    for (i = 0; i < p->count; i++) {
        if (beside[i] > 0) {
            uint8_t *about = &limits[p->x[i] - near - x + 2 * RING];
            for (n = 0; n <= 2 * near; n++) {
                about[n] = p->contrast[i] < about[n] ? (uint8_t)p->contrast[i] : about[n];
            }
        }
    }
    for (n = 0; n < PLACES; n++) { /* as vector instructions have it: equal, larger of two, difference */
        const uint8_t limit = limits[n + 2 * RING] == 255 ? (uint8_t)elsewhere : limits[n + 2 * RING];
        marks[n] = (uint8_t)((contrasts[n] > limit ? contrasts[n] : limit) - limit);
    }
}

/* Add the dark discs among places from x on in row y. */
static void keep_discs(drogue_search_pending *p, const uint8_t contrasts[PLACES], int32_t x, int32_t y,
                       int32_t radius_q4)
{
    uint8_t marks[PLACES];
    int32_t n = 0;
    while (n < PLACES) {
        mark_discs(marks, contrasts, p, x, y, radius_q4);
        n = next_place(marks, n, PLACES);
        if (n < PLACES) {
            const drogue_search_disc disc = {x + n, y, radius_q4, contrasts[n]};
            keep_disc(p, &disc);
            n++;
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
            if (drogue_search_contrasts(contrasts, rows, x, left < PLACES ? left : PLACES, scale,
                                        search->min_contrast)) {
                keep_discs(&level->pending, contrasts, x, y, ring_q4[scale]);
            }
        }
    }
    judge_above(search, k, y - RING);
}

void drogue_search_row(drogue_search *search, const uint8_t *row)
{
    const uint8_t *above = search->memory;
    const uint8_t *below = row;
    int k;
    if (search->rows_in == DROGUE_SEARCH_MOST_ROWS) {
        return;
    }
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
