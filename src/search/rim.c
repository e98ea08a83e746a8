/* SPDX-License-Identifier: Apache-2.0 */
/* Rays from a dark disc, and a circle through what they meet. */
#include "drogue/rim.h"

#include "drogue/real.h"

#define RAYS 16
#define FAR_Q4 1024      /* cells Q4: a centre farther away is none */
#define LEAST_RAYS 9     /* that must meet the circle */
#define DIFFERENT_RAYS 3 /* on fewer, another choice of steps is the same circle */

/* Directions of the rays, Q8. */
static const int32_t ray_x[RAYS] = {256, 237, 181, 98, 0, -98, -181, -237, -256, -237, -181, -98, 0, 98, 181, 237};
static const int32_t ray_y[RAYS] = {0, 98, 181, 237, 256, 237, 181, 98, 0, -98, -181, -237, -256, -237, -181, -98};

#define MOST_STEP 64 /* grey levels that count of an edge's contrast */
#define LEAST_STEP 3 /* grey levels: less is no edge */

/* Steps along the rays, bright beyond dark positive, 0 outside the level; and the place taken on each. */
typedef struct rays {
    int32_t first; /* cells from the disc's centre; what is nearer may belong to the disc */
    int32_t last;
    int16_t steps[RAYS][DROGUE_SEARCH_REACH];
    int32_t taken[RAYS]; /* cells; 0: none */
    int32_t x_q4[RAYS];
    int32_t y_q4[RAYS];
    int32_t step[RAYS]; /* of the sign looked for; 0: none */
    int32_t used[RAYS];
} rays;

/* num / den, rounded and saturated */
static int32_t quotient(int64_t num, int64_t den)
{
    drogue_real t;
    drogue_real d;
    drogue_real_set(&t, num, 0);
    drogue_real_set(&d, den, 0);
    drogue_real_quotient(&t, &t, &d);
    return drogue_real_to_s32(t, 0);
}

/* A circle by least squares (Kasa 1976): x^2 + y^2 = 2 a x + 2 b y + c. 0 when the points do not determine one.
 * Coordinates stay within 2^9, sums about the mean of second order within 2^26, of third within 2^37. */
static int fit_circle(drogue_rim *out, const rays *r)
{
    int32_t n = 0, sx = 0, sy = 0, sz = 0, sxx = 0, sxy = 0, syy = 0;
    int64_t sxz = 0, syz = 0;
    int64_t det;
    int32_t radius2;
    int32_t xz;
    int32_t yz;
    int i;
    for (i = 0; i < RAYS; i++) {
        if (r->used[i]) {
            const int32_t x = r->x_q4[i];
            const int32_t y = r->y_q4[i];
            const int32_t z = x * x + y * y;
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
    sxz = n * sxz - (int64_t)sx * sz;
    syz = n * syz - (int64_t)sy * sz;
    det = (int64_t)sxx * syy - (int64_t)sxy * sxy; /* < 2^54 */
    if (det < (INT64_C(1) << 24)) {
        return 0;
    }
    xz = (int32_t)(sxz >> 8);
    yz = (int32_t)(syz >> 8);
    det >>= 7; /* twice what the other is */
    out->x_q4 = quotient((int64_t)xz * syy - (int64_t)yz * sxy, det);
    out->y_q4 = quotient((int64_t)yz * sxx - (int64_t)xz * sxy, det);
    if (drogue_abs_u64(out->x_q4) > FAR_Q4 || drogue_abs_u64(out->y_q4) > FAR_Q4) {
        return 0;
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
    int i;
    r->first = ((disc->ring_q4 + 8) >> 4) + 1;
    r->last = far < DROGUE_SEARCH_REACH ? far : DROGUE_SEARCH_REACH - 1;
    for (i = 0; i < RAYS; i++) {
        int32_t before = 0;
        int32_t here = 0;
        int32_t t;
        for (t = r->first - 1; t <= r->last + 1; t++) {
            const int32_t x = disc->x + ((ray_x[i] * t + 128) >> 8);
            const int32_t y = disc->y + ((ray_y[i] * t + 128) >> 8);
            int32_t next;
            if (x < 0 || x >= level->width || y < 0 || y >= level->rows_in) {
                break;
            }
            next = drogue_search_level_row(level, y)[x];
            if (t == r->first - 1) {
                before = here = next;
                continue;
            }
            r->steps[i][t - 1] = (int16_t)(next - before);
            before = here;
            here = next;
        }
        for (t = t > r->first ? t - 1 : r->first - 1; t <= r->last; t++) {
            r->steps[i][t] = 0;
        }
    }
}

/* Which step of each ray is taken. */
typedef enum choice { LARGEST, OUTERMOST, INNERMOST } choice; /* the last two: of those half as large as the largest */

/* Take a step of the given sign on each ray; returns how many rays differ from what was taken before. */
static int32_t take_steps(rays *r, int32_t sign, choice which)
{
    int32_t differ = 0;
    int i;
    for (i = 0; i < RAYS; i++) {
        int32_t best = LEAST_STEP - 1;
        int32_t at = 0;
        int32_t t;
        for (t = r->first - 1; t <= r->last; t++) {
            if (sign * r->steps[i][t] > best) {
                best = sign * r->steps[i][t];
                at = t;
            }
        }
        if (at > 0 && which != LARGEST) {
            const int32_t half = (best + 1) / 2 > LEAST_STEP ? (best + 1) / 2 : LEAST_STEP;
            const int32_t way = which == OUTERMOST ? -1 : 1;
            t = which == OUTERMOST ? r->last : r->first - 1;
            while (sign * r->steps[i][t] < half) { /* ends at the largest */
                t += way;
            }
            while (t + way >= r->first - 1 && t + way <= r->last &&
                   sign * r->steps[i][t + way] > sign * r->steps[i][t]) {
                t += way; /* up to the top of its slope */
            }
            at = t;
            best = sign * r->steps[i][t];
        }
        differ += at != r->taken[i];
        r->taken[i] = at;
        r->step[i] = at > 0 ? best : 0;
        r->used[i] = at > 0;
        r->x_q4[i] = (ray_x[i] * at) >> 4;
        r->y_q4[i] = (ray_y[i] * at) >> 4;
    }
    return differ;
}

/* Keep the points within tolerance of the circle; returns their number. */
static int32_t keep_near(rays *r, const drogue_rim *c, int32_t tolerance_q8)
{
    const int32_t room = 16 + ((c->radius_q4 * tolerance_q8) >> 8);
    const int32_t most = c->radius_q4 + room;
    const int32_t least = c->radius_q4 > room ? c->radius_q4 - room : 0;
    int32_t count = 0;
    int i;
    for (i = 0; i < RAYS; i++) {
        const int32_t dx = r->x_q4[i] - c->x_q4;
        const int32_t dy = r->y_q4[i] - c->y_q4;
        const int32_t distance2 = dx * dx + dy * dy;
        r->used[i] = r->step[i] > 0 && distance2 >= least * least && distance2 <= most * most;
        count += r->used[i];
    }
    return count;
}

static uint32_t score_of(int32_t count, int32_t step, const drogue_search_disc *disc)
{
    return (uint32_t)(count * count * (step + (disc->contrast > MOST_STEP ? MOST_STEP : disc->contrast)));
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
        step += r->used[i] ? (r->step[i] > MOST_STEP ? MOST_STEP : r->step[i]) : 0;
    }
    return score_of(count, step / count, disc);
}

uint32_t drogue_rim_most(const drogue_search_disc *disc) { return score_of(RAYS, MOST_STEP, disc); }

int32_t drogue_rim_find(drogue_rim rims[DROGUE_RIMS], const drogue_search_level *level, const drogue_search_disc *disc)
{
    static const choice choices[DROGUE_RIMS / 2] = {LARGEST, OUTERMOST, INNERMOST};
    rays r;
    int32_t count = 0;
    int32_t sign;
    int k;
    read_rays(&r, level, disc);
    for (sign = 1; sign >= -1; sign -= 2) {
        for (k = 0; k < RAYS; k++) {
            r.taken[k] = 0;
        }
        for (k = 0; k < DROGUE_RIMS / 2; k++) {
            drogue_rim *rim = &rims[count];
            if (take_steps(&r, sign, choices[k]) < DIFFERENT_RAYS) {
                continue;
            }
            rim->score = find_circle(rim, &r, disc);
            count += rim->score > 0;
        }
    }
    return count;
}
