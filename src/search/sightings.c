/* SPDX-License-Identifier: Apache-2.0 */
/* The best few sightings. */
#include "sightings.h"

/* Are these about the same outline? Radii are whole pixels. */
static int same_outline(const drogue_sighting *b, const drogue_sighting *c)
{
    const int32_t larger = b->radius_px > c->radius_px ? b->radius_px : c->radius_px;
    const int32_t smaller = b->radius_px > c->radius_px ? c->radius_px : b->radius_px;
    const int32_t dx = b->x_px - c->x_px;
    const int32_t dy = b->y_px - c->y_px;
    return 5 * larger <= 6 * smaller + 5 && 2 * dx < larger && -2 * dx < larger && 2 * dy < larger && -2 * dy < larger;
}

void drogue_sightings_keep(drogue_sighting *best, int32_t *count, int32_t most, const drogue_sighting *c)
{
    uint32_t same = 0; /* a bit for each that is about the same outline */
    int32_t lowest = 0;
    int32_t i;
    for (i = 0; i < *count; i++) {
        if (same_outline(&best[i], c)) {
            if (best[i].score >= c->score) {
                return;
            }
            same |= 1u << i;
        }
    }
    for (i = *count - 1; i >= 0; i--) {
        if ((same >> i & 1u) != 0) {
            (*count)--;
            best[i] = best[*count];
        }
    }
    if (*count < most) {
        best[(*count)++] = *c;
        return;
    }
    for (i = 1; i < most; i++) {
        if (best[i].score < best[lowest].score) {
            lowest = i;
        }
    }
    if (c->score > best[lowest].score) {
        best[lowest] = *c;
    }
}

void drogue_sightings_sort(drogue_sighting *best, int32_t count)
{
    int32_t i;
    int32_t k;
    for (i = 0; i < count; i++) {
        for (k = i + 1; k < count; k++) {
            if (best[k].score > best[i].score) {
                const drogue_sighting t = best[i];
                best[i] = best[k];
                best[k] = t;
            }
        }
    }
}

uint32_t drogue_sightings_least(const drogue_sighting *best, int32_t count, int32_t most)
{
    uint32_t lowest = UINT32_MAX;
    int32_t i;
    for (i = 0; i < count; i++) {
        lowest = best[i].score < lowest ? best[i].score : lowest;
    }
    return count == most ? lowest : 0;
}

void drogue_sighting_frame(drogue_sighting *s)
{
    int32_t side = s->radius_px + (s->radius_px < 10 ? 1 : 0); /* a small radius may be half a cell too small */
    side = (side * 21) >> 3;
    side = side < DROGUE_MAX_SIDE ? side : DROGUE_MAX_SIDE;
    s->region.x_px = s->x_px - side / 2;
    s->region.y_px = s->y_px - side / 2;
    s->region.width_px = side;
    s->region.height_px = side;
}
