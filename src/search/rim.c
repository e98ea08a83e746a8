/* SPDX-License-Identifier: Apache-2.0 */
/* Rays from a dark disc, and a circle through what they meet. */
#include "drogue/rim.h"

#include <string.h>

#include "cells.h"
#include "drogue/real.h"

#define RAYS DROGUE_SEARCH_RAYS
#define FAR_Q4 1024      /* cells Q4: a centre farther away is none */
#define LEAST_RAYS 9     /* that must meet the circle */
#define DIFFERENT_RAYS 3 /* on fewer, another choice of steps is the same circle */

#define MOST_STEP 64 /* grey levels that count of an edge's contrast */
#define LEAST_STEP 3 /* grey levels: less is no edge */

/* Steps along the rays, bright beyond dark positive, 0 outside the level; and the place taken on each. Rays lie beside
 * each other, so that loops over them become vector instructions. */
typedef struct rays {
    int32_t first; /* cells from the disc's centre; what is nearer may belong to the disc */
    int32_t last;
    int16_t steps[DROGUE_SEARCH_REACH][RAYS];
    int16_t largest[RAYS]; /* step of the sign looked for; LEAST_STEP - 1: none */
    int16_t taken[RAYS];   /* cells; 0: none */
    int16_t x_q4[RAYS];    /* of the place taken */
    int16_t y_q4[RAYS];
    int16_t step[RAYS]; /* taken; 0: none */
    int16_t used[RAYS]; /* 1 or 0 */
} rays;

/* num / den, rounded and saturated */
static int32_t quotient(int64_t num, int64_t den)
{
    drogue_real t;
    drogue_real_ratio(&t, num, den);
    return drogue_real_to_s32(t, 0);
}

/* A circle by least squares (Kasa 1976): x^2 + y^2 = 2 a x + 2 b y + c. 0 when the points, at least LEAST_RAYS, do not
 * determine one.
 * Coordinates stay within 2^9, so sums within 2^31; about the mean, those of second order within 2^26, of third within
 * 2^37. */
static int fit_circle(drogue_rim *out, const rays *r)
{
    int32_t n = 0, sx = 0, sy = 0, sz = 0, sxx = 0, sxy = 0, syy = 0, txz = 0, tyz = 0;
    int64_t sxz;
    int64_t syz;
    int64_t det;
    int32_t radius2;
    int32_t xz;
    int32_t yz;
    int i;
    for (i = 0; i < RAYS; i++) {
        const int16_t x = r->used[i] > 0 ? r->x_q4[i] : 0;
        const int16_t y = r->used[i] > 0 ? r->y_q4[i] : 0;
        const int32_t z = x * x + y * y;
        n += r->used[i];
        sx += x;
        sy += y;
        sz += z;
        sxx += x * x;
        sxy += x * y;
        syy += y * y;
        txz += x * z;
        tyz += y * z;
    }
    /* moments about the mean, times n */
    sxx = n * sxx - sx * sx;
    sxy = n * sxy - sx * sy;
    syy = n * syy - sy * sy;
    sxz = n * (int64_t)txz - (int64_t)sx * sz;
    syz = n * (int64_t)tyz - (int64_t)sy * sz;
    det = (int64_t)sxx * syy - (int64_t)sxy * sxy; /* < 2^54 */
    if (det < (INT64_C(1) << 24)) {
        return 0; /* GCOVR_EXCL_LINE: nine of sixteen rays do not end on one line, but nothing here says so */
    }
    xz = (int32_t)(sxz >> 8);
    yz = (int32_t)(syz >> 8);
    det >>= 7; /* twice what the other is */
    out->x_q4 = quotient((int64_t)xz * syy - (int64_t)yz * sxy, det);
    out->y_q4 = quotient((int64_t)yz * sxx - (int64_t)xz * sxy, det);
    if (drogue_abs_u64(out->x_q4) > FAR_Q4 || drogue_abs_u64(out->y_q4) > FAR_Q4) {
        return 0; /* GCOVR_EXCL_LINE: as above; the squares below stay in range */
    }
    radius2 = quotient(sz - 2 * ((int64_t)out->x_q4 * sx + (int64_t)out->y_q4 * sy), n) + out->x_q4 * out->x_q4 +
              out->y_q4 * out->y_q4;
    out->radius_q4 = radius2 > 0 ? (int32_t)drogue_isqrt_u64((uint64_t)radius2) : 0;
    return out->radius_q4 > 0;
}

/* Read the steps: at t, across the cells t - 1 and t + 1. */
static void read_rays(rays *r, const drogue_search_level *level, const drogue_search_disc *disc)
{
    const int32_t far = (7 * disc->ring_q4 + 16) >> 5; /* 1.7 radii of the rim: the inner part may lie aside */
    const int32_t highest = -disc->y;                  /* rows of the level from the disc */
    const int32_t lowest = level->rows_in - 1 - disc->y;
    const uint8_t *rows[2 * DROGUE_SEARCH_REACH + 1];
    int32_t t;
    int i;
    r->first = ((disc->ring_q4 + 8) >> 4) + 1;
    r->last = far < DROGUE_SEARCH_REACH ? far : DROGUE_SEARCH_REACH - 1;
    for (t = -r->last - 1; t <= r->last + 1; t++) {
        rows[DROGUE_SEARCH_REACH + t] = drogue_search_level_row(level, disc->y + (t >= highest && t <= lowest ? t : 0));
    }
    for (i = 0; i < RAYS; i++) {
        int32_t x_q8 = 256 * disc->x + 128 + drogue_search_ray_x_q8[i] * (r->first - 1);
        int32_t down_q8 = 128 + drogue_search_ray_y_q8[i] * (r->first - 1);
        int32_t before = 0;
        int32_t here = 0;
        for (t = r->first - 1; t <= r->last + 1; t++) {
            const int32_t x = x_q8 >> 8;
            const int32_t down = down_q8 >> 8;
            int32_t next;
            if (x < 0 || x >= level->width || down < highest || down > lowest) {
                break;
            }
            next = rows[DROGUE_SEARCH_REACH + down][x];
            if (t >= r->first) {
                r->steps[t - 1][i] = (int16_t)(next - before);
            }
            before = t >= r->first ? here : next;
            here = next;
            x_q8 += drogue_search_ray_x_q8[i];
            down_q8 += drogue_search_ray_y_q8[i];
        }
        for (t = t > r->first ? t - 1 : r->first - 1; t <= r->last; t++) {
            r->steps[t][i] = 0;
        }
    }
}

/* Now steps to darker are positive. */
static void turn_steps(rays *r)
{
    int32_t t;
    int i;
    for (t = r->first - 1; t <= r->last; t++) {
        for (i = 0; i < RAYS; i++) {
            r->steps[t][i] = (int16_t)-r->steps[t][i];
        }
    }
}

/* The largest step of each ray, the first of equal ones. */
static void find_largest(rays *r, int16_t at[RAYS])
{
    int32_t t;
    int i;
    for (i = 0; i < RAYS; i++) {
        r->largest[i] = LEAST_STEP - 1;
        at[i] = 0;
    }
    for (t = r->first - 1; t <= r->last; t++) {
        const int16_t *steps = r->steps[t];
        for (i = 0; i < RAYS; i++) {
            at[i] = steps[i] > r->largest[i] ? (int16_t)t : at[i];
            r->largest[i] = steps[i] > r->largest[i] ? steps[i] : r->largest[i];
        }
    }
    for (i = 0; i < RAYS; i++) { /* a step in the centre is none */
        r->largest[i] = at[i] > 0 ? r->largest[i] : LEAST_STEP - 1;
    }
}

/* The first step on the way along each ray that is half as large as the largest, up to the top of its slope. */
static void find_first(const rays *r, int16_t *restrict at, int16_t *restrict step, int32_t from, int32_t way)
{
    int16_t open[RAYS]; /* all ones until the top is passed */
    int32_t t;
    int i;
    for (i = 0; i < RAYS; i++) {
        const int16_t half = (int16_t)((r->largest[i] + 1) >> 1);
        step[i] = (int16_t)((half > LEAST_STEP ? half : LEAST_STEP) - 1); /* what the next must exceed */
        at[i] = 0;
        open[i] = r->largest[i] >= LEAST_STEP ? -1 : 0;
    }
    for (t = from; t >= r->first - 1 && t <= r->last; t += way) {
        const int16_t *steps = r->steps[t];
        const int16_t next = (int16_t)(t + 1);
        for (i = 0; i < RAYS; i++) {
            const int16_t higher = (int16_t)(-(steps[i] > step[i]) & open[i]);
            at[i] = (int16_t)((next & higher) | (at[i] & ~higher));
            step[i] = (int16_t)((steps[i] & higher) | (step[i] & ~higher));
            open[i] = (int16_t)(open[i] & (higher | -(at[i] == 0)));
        }
    }
    for (i = 0; i < RAYS; i++) {
        at[i] = at[i] > 0 ? (int16_t)(at[i] - 1) : at[i];
    }
}

/* Which step of each ray is taken. */
typedef enum choice { LARGEST, OUTERMOST, INNERMOST } choice; /* the last two: of those half as large as the largest */

/* Take a step on each ray; returns how many rays differ from what was taken before. */
static int32_t take_steps(rays *r, choice which)
{
    int16_t at[RAYS];
    int16_t step[RAYS];
    int32_t differ = 0;
    int i;
    switch (which) {
    case LARGEST:
        find_largest(r, at);
        memcpy(step, r->largest, sizeof step);
        break;
    case OUTERMOST: find_first(r, at, step, r->last, -1); break;
    default: find_first(r, at, step, r->first - 1, 1); break;
    }
    for (i = 0; i < RAYS; i++) {
        differ += at[i] != r->taken[i];
        r->taken[i] = at[i];
        r->step[i] = at[i] > 0 ? step[i] : 0;
        r->used[i] = at[i] > 0;
        r->x_q4[i] = (int16_t)((drogue_search_ray_x_q8[i] * at[i]) >> 4);
        r->y_q4[i] = (int16_t)((drogue_search_ray_y_q8[i] * at[i]) >> 4);
    }
    return differ;
}

/* Keep the points within tolerance of the circle; returns their number. */
static int32_t keep_near(rays *r, const drogue_rim *c, int32_t tolerance_q8)
{
    const int32_t room = 16 + ((c->radius_q4 * tolerance_q8) >> 8);
    const int32_t most = c->radius_q4 + room;
    const int32_t least = c->radius_q4 > room ? c->radius_q4 - room : 0;
    const int32_t most2 = most * most;
    const int32_t least2 = least * least;
    int32_t count = 0;
    int i;
    for (i = 0; i < RAYS; i++) {
        const int16_t dx = (int16_t)(r->x_q4[i] - c->x_q4);
        const int16_t dy = (int16_t)(r->y_q4[i] - c->y_q4);
        const int32_t distance2 = dx * dx + dy * dy;
        r->used[i] = (int16_t)((r->step[i] > 0) & (distance2 >= least2) & (distance2 <= most2));
        count += r->used[i];
    }
    return count;
}

static inline int32_t counted(int32_t step) { return step > MOST_STEP ? MOST_STEP : step; }

static uint32_t score_of(int32_t count, int32_t step, const drogue_search_disc *disc)
{
    return (uint32_t)(count * count * (step + counted(disc->contrast)));
}

/* Circle through the steps taken: its score, 0 when there is none. */
static uint32_t find_circle(drogue_rim *rim, rays *r, const drogue_search_disc *disc)
{
    static const int32_t tolerances_q8[3] = {90, 56, 40};
    const int32_t ring = disc->ring_q4;
    int32_t count = 0;
    int32_t step = 0;
    int i;
    for (i = 0; i < RAYS; i++) {
        count += r->used[i];
    }
    for (i = 0; i < 3; i++) {
        if (count < LEAST_RAYS || !fit_circle(rim, r)) {
            return 0;
        }
        count = keep_near(r, rim, tolerances_q8[i]);
    }
    if (count < LEAST_RAYS || 10 * rim->radius_q4 < 13 * ring || 10 * rim->radius_q4 > 29 * ring ||
        4 * (rim->x_q4 * rim->x_q4 + rim->y_q4 * rim->y_q4) > rim->radius_q4 * rim->radius_q4 * 2) {
        return 0;
    }
    for (i = 0; i < RAYS; i++) {
        step += r->used[i] * counted(r->step[i]);
    }
    return score_of(count, step / count, disc);
}

uint32_t drogue_rim_most(const drogue_search_disc *disc) { return score_of(RAYS, MOST_STEP, disc); }

/* What no circle through steps of this sign can exceed: all rays with their largest steps, which are those taken. */
static uint32_t most_of(const rays *r, const drogue_search_disc *disc)
{
    int32_t count = 0;
    int32_t steps = 0;
    int i;
    for (i = 0; i < RAYS; i++) {
        count += r->used[i];
        steps += counted(r->step[i]);
    }
    return count < LEAST_RAYS ? 0 : (uint32_t)(count * (steps + count * counted(disc->contrast)));
}

int32_t drogue_rim_find(drogue_rim rims[DROGUE_RIMS], const drogue_search_level *level, const drogue_search_disc *disc,
                        uint32_t least)
{
    static const choice choices[DROGUE_RIMS / 2] = {LARGEST, OUTERMOST, INNERMOST};
    rays r;
    int32_t count = 0;
    int32_t sign;
    int k;
    read_rays(&r, level, disc);
    for (sign = 1; sign >= -1; sign -= 2) {
        memset(r.taken, 0, sizeof r.taken);
        if (sign < 0) {
            turn_steps(&r);
        }
        for (k = 0; k < DROGUE_RIMS / 2; k++) {
            drogue_rim *rim = &rims[count];
            const int32_t differ = take_steps(&r, choices[k]);
            if (k == 0 && most_of(&r, disc) <= least) {
                break;
            }
            if (differ < DIFFERENT_RAYS) {
                continue;
            }
            rim->score = find_circle(rim, &r, disc);
            count += rim->score > least;
        }
    }
    return count;
}
