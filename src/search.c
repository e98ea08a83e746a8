/* SPDX-License-Identifier: Apache-2.0 */
/* Dark discs in block means, and the ring about each. */
#include "drogue/search.h"

#include <string.h>

#define SCALES 3
#define RAYS 16
#define REACH 18     /* cells that a ray goes at most */
#define FAR_Q4 1024  /* cells Q4: a centre farther away is none */
#define LEAST_RAYS 9 /* that must meet the circle */

/* The circle of eight cells (+-p, +-q), (+-q, +-p) lies between inner part and rim: about half the rim's radius. */
static const int32_t ring_p[SCALES] = {3, 4, 5};
static const int32_t ring_q[SCALES] = {1, 2, 2};
static const int32_t inner_at[SCALES] = {1, 2, 2};   /* samples of the disc beside its centre */
static const int32_t ring_q4[SCALES] = {51, 72, 86}; /* radius of the circle, 16ths of a cell */

/* Directions of the rays, Q8. */
static const int32_t ray_x[RAYS] = {256, 237, 181, 98, 0, -98, -181, -237, -256, -237, -181, -98, 0, 98, 181, 237};
static const int32_t ray_y[RAYS] = {0, 98, 181, 237, 256, 237, 181, 98, 0, -98, -181, -237, -256, -237, -181, -98};

static const uint8_t *level_row(const drogue_search_level *level, int32_t y)
{
    return level->rows + (y % DROGUE_SEARCH_ROWS) * level->width;
}

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
    uint8_t *next = search->memory + width_px; /* a row of pixels waits before it */
    int k;
    if (width_px < 1 || search->memory == NULL) {
        return DROGUE_E_ARGUMENT;
    }
    if (width_px > search->capacity_px) {
        return DROGUE_E_WORKSPACE;
    }
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

/* A circle by least squares (Kasa 1976): x^2 + y^2 = 2 a x + 2 b y + c. Cells relative to the disc, Q4. */
typedef struct circle {
    int64_t x_q4;
    int64_t y_q4;
    int64_t radius_q4;
} circle;

typedef struct rays {
    int32_t x_q4[RAYS];
    int32_t y_q4[RAYS];
    int32_t step[RAYS]; /* grey levels at the edge; 0: none */
    int32_t used[RAYS];
} rays;

/* 0 when the points do not determine a circle. Coordinates stay within 2^9, sums of fourth order within 2^40. */
static int fit_circle(circle *out, const rays *r)
{
    int64_t n = 0, sx = 0, sy = 0, sz = 0, sxx = 0, sxy = 0, syy = 0, sxz = 0, syz = 0;
    int64_t det;
    int64_t radius2;
    int i;
    for (i = 0; i < RAYS; i++) {
        if (r->used[i]) {
            const int64_t x = r->x_q4[i];
            const int64_t y = r->y_q4[i];
            const int64_t z = x * x + y * y;
            n++;
            sx += x;
            sy += y;
            sz += z;
            sxx += x * x;
            sxy += x * y;
            syy += y * y;
            sxz += x * z;
            syz += y * z;
        }
    }
    if (n < 5) {
        return 0;
    }
    /* moments about the mean, times n */
    sxx = n * sxx - sx * sx;
    sxy = n * sxy - sx * sy;
    syy = n * syy - sy * sy;
    sxz = n * sxz - sx * sz;
    syz = n * syz - sy * sz;
    det = sxx * syy - sxy * sxy; /* < 2^54 */
    if (det < (INT64_C(1) << 24)) {
        return 0;
    }
    out->x_q4 = drogue_div_round_s64(((sxz >> 8) * syy - (syz >> 8) * sxy) / 2, det >> 8);
    out->y_q4 = drogue_div_round_s64(((syz >> 8) * sxx - (sxz >> 8) * sxy) / 2, det >> 8);
    if (drogue_abs_u64(out->x_q4) > FAR_Q4 || drogue_abs_u64(out->y_q4) > FAR_Q4) {
        return 0;
    }
    radius2 = drogue_div_round_s64(sz - 2 * out->x_q4 * sx - 2 * out->y_q4 * sy, n) + out->x_q4 * out->x_q4 +
              out->y_q4 * out->y_q4;
    out->radius_q4 = radius2 > 0 ? (int64_t)drogue_isqrt_u64((uint64_t)radius2) : 0;
    return out->radius_q4 > 0;
}

/* Follow each ray to its largest step of the given sign: 1 from dark to bright, -1 from bright to dark. */
static void follow_rays(rays *r, const drogue_search_level *level, const drogue_dark_disc *disc, int32_t sign)
{
    const int32_t first = (ring_q4[disc->scale] + 8) >> 4;
    const int32_t last = disc->scale == 0 ? 11 : disc->scale == 1 ? 15 : REACH - 1;
    int i;
    for (i = 0; i < RAYS; i++) {
        int32_t before = 0;
        int32_t here = 0;
        int32_t best = 0;
        int32_t t;
        r->used[i] = 0;
        for (t = first - 1; t <= last + 1; t++) {
            const int32_t x = disc->x + ((ray_x[i] * t + 128) >> 8);
            const int32_t y = disc->y + ((ray_y[i] * t + 128) >> 8);
            int32_t next;
            if (x < 0 || x >= level->width || y < 0 || y >= level->rows_in) {
                break;
            }
            next = level_row(level, y)[x];
            if (t > first && sign * (next - before) > best) { /* across the step at t - 1 */
                best = sign * (next - before);
                r->x_q4[i] = (ray_x[i] * (t - 1)) >> 4;
                r->y_q4[i] = (ray_y[i] * (t - 1)) >> 4;
            }
            before = here;
            here = next;
        }
        r->step[i] = best;
        r->used[i] = best > 0;
    }
}

/* Keep the points within tolerance of the circle; returns their number. */
static int32_t keep_near(rays *r, const circle *c, int64_t tolerance_q8)
{
    int32_t count = 0;
    int i;
    for (i = 0; i < RAYS; i++) {
        const int64_t dx = r->x_q4[i] - c->x_q4;
        const int64_t dy = r->y_q4[i] - c->y_q4;
        const int64_t off = (int64_t)drogue_isqrt_u64((uint64_t)(dx * dx + dy * dy)) - c->radius_q4;
        const int64_t most = 16 + ((c->radius_q4 * tolerance_q8) >> 8);
        r->used[i] = r->step[i] > 0 && off <= most && off >= -most;
        count += r->used[i];
    }
    return count;
}

/* Rim about a dark disc by steps of one sign: its score, 0 when there is none. */
static uint32_t find_rim(circle *rim, const drogue_search_level *level, const drogue_dark_disc *disc, int32_t sign)
{
    static const int32_t tolerances_q8[3] = {90, 56, 40};
    const int64_t ring = ring_q4[disc->scale];
    int32_t count = 0;
    int32_t step = 0;
    rays r;
    int i;
    follow_rays(&r, level, disc, sign);
    for (i = 0; i < 3; i++) {
        if (!fit_circle(rim, &r)) {
            return 0;
        }
        count = keep_near(&r, rim, tolerances_q8[i]);
    }
    if (count < LEAST_RAYS || 10 * rim->radius_q4 < 13 * ring || 10 * rim->radius_q4 > 29 * ring ||
        4 * (rim->x_q4 * rim->x_q4 + rim->y_q4 * rim->y_q4) > rim->radius_q4 * rim->radius_q4 * 2) {
        return 0;
    }
    for (i = 0; i < RAYS; i++) {
        step += r.used[i] ? (r.step[i] > 64 ? 64 : r.step[i]) : 0;
    }
    return (uint32_t)(count * count * (step / count + (disc->contrast > 64 ? 64 : disc->contrast)));
}

/* Put a candidate in its place; of two about the same outline the better stays. */
static void keep_candidate(drogue_search *search, const drogue_sighting *c)
{
    int32_t at = 0;
    int32_t i;
    for (i = 0; i < search->count; i++) {
        const drogue_sighting *b = &search->best[i];
        const int32_t larger = b->radius_px > c->radius_px ? b->radius_px : c->radius_px;
        const int32_t smaller = b->radius_px > c->radius_px ? c->radius_px : b->radius_px;
        const int32_t dx = b->x_px - c->x_px;
        const int32_t dy = b->y_px - c->y_px;
        if (2 * larger < 3 * smaller && 2 * dx < larger && -2 * dx < larger && 2 * dy < larger && -2 * dy < larger) {
            if (b->score >= c->score) {
                return;
            }
            search->count--;
            memmove(&search->best[i], &search->best[i + 1], (size_t)(search->count - i) * sizeof *c);
            i--;
        }
    }
    while (at < search->count && search->best[at].score >= c->score) {
        at++;
    }
    if (at == DROGUE_SEARCH_MAX) {
        return;
    }
    if (search->count < DROGUE_SEARCH_MAX) {
        search->count++;
    }
    memmove(&search->best[at + 1], &search->best[at], (size_t)(search->count - 1 - at) * sizeof *c);
    search->best[at] = *c;
}

static void judge_disc(drogue_search *search, int k, const drogue_dark_disc *disc)
{
    const int32_t cell_px = 2 << k;
    drogue_sighting c;
    circle rim;
    circle other;
    int32_t side;
    c.score = find_rim(&rim, &search->levels[k], disc, 1);
    {
        const uint32_t score = find_rim(&other, &search->levels[k], disc, -1);
        if (score > c.score) {
            c.score = score;
            rim = other;
        }
    }
    if (c.score == 0) {
        return;
    }
    c.x_px = (int32_t)(((16 * disc->x + 8 + rim.x_q4) * cell_px) >> 4);
    c.y_px = (int32_t)(((16 * disc->y + 8 + rim.y_q4) * cell_px) >> 4);
    c.radius_px = (int32_t)((rim.radius_q4 * cell_px) >> 4);
    side = (c.radius_px * 21) >> 3; /* 2.5 major semi-axes */
    c.region.x_px = c.x_px - side / 2;
    c.region.y_px = c.y_px - side / 2;
    c.region.width_px = side;
    c.region.height_px = side;
    keep_candidate(search, &c);
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

/* Add a dark disc; of those beside each other the one of most contrast stays. */
static void keep_disc(drogue_search *search, int k, const drogue_dark_disc *disc)
{
    drogue_search_level *level = &search->levels[k];
    const int32_t near = ring_p[disc->scale];
    int32_t i;
    for (i = 0; i < level->pending_count; i++) {
        drogue_dark_disc *p = &level->pending[i];
        if (p->scale == disc->scale && disc->y - p->y <= near && disc->x - p->x <= near && p->x - disc->x <= near) {
            if (disc->contrast > p->contrast) {
                *p = *disc;
            }
            return;
        }
    }
    if (level->pending_count == DROGUE_SEARCH_PENDING) {
        judge_above(search, k, INT32_MAX);
    }
    level->pending[level->pending_count++] = *disc;
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
        rows[REACH + i] = level_row(level, at < 0 ? 0 : at >= level->rows_in ? level->rows_in - 1 : at);
    }
    for (scale = 0; scale < SCALES; scale++) {
        const int32_t margin = ring_p[scale];
        int32_t x;
        if (y < margin || y + margin >= level->rows_in) {
            continue;
        }
        for (x = margin; x + margin < level->width; x++) {
            drogue_dark_disc disc;
            disc.contrast = disc_contrast(rows, x, scale, search->min_contrast);
            if (disc.contrast > search->min_contrast) {
                disc.x = x;
                disc.y = y;
                disc.scale = scale;
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
        above = level_row(level, y - 1);
        below = level_row(level, y);
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
    return search->count;
}
