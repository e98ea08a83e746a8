/* SPDX-License-Identifier: Apache-2.0 */
/* Rays from a dark disc, and a circle through what they meet. */
#include "drogue/rim.h"

#include "drogue/real.h"

#define RAYS 16
#define FAR_Q4 1024  /* cells Q4: a centre farther away is none */
#define LEAST_RAYS 9 /* that must meet the circle */

/* Directions of the rays, Q8. */
static const int32_t ray_x[RAYS] = {256, 237, 181, 98, 0, -98, -181, -237, -256, -237, -181, -98, 0, 98, 181, 237};
static const int32_t ray_y[RAYS] = {0, 98, 181, 237, 256, 237, 181, 98, 0, -98, -181, -237, -256, -237, -181, -98};

typedef struct rays {
    int32_t x_q4[RAYS];
    int32_t y_q4[RAYS];
    int32_t step[RAYS]; /* grey levels at the edge; 0: none */
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

/* Follow each ray to its largest step of the given sign: 1 from dark to bright, -1 from bright to dark. */
static void follow_rays(rays *r, const drogue_search_level *level, const drogue_search_disc *disc, int32_t sign)
{
    const int32_t first = (disc->ring_q4 + 8) >> 4;
    const int32_t far = (7 * disc->ring_q4 + 16) >> 5; /* 1.7 radii of the rim: the inner part may lie aside */
    const int32_t last = far < DROGUE_SEARCH_REACH ? far : DROGUE_SEARCH_REACH - 1;
    int i;
    for (i = 0; i < RAYS; i++) {
        int32_t before = 0;
        int32_t here = 0;
        int32_t best = 0;
        int32_t t;
        r->used[i] = 0;
        r->x_q4[i] = 0;
        r->y_q4[i] = 0;
        for (t = first; t <= last + 1; t++) {
            const int32_t x = disc->x + ((ray_x[i] * t + 128) >> 8);
            const int32_t y = disc->y + ((ray_y[i] * t + 128) >> 8);
            int32_t next;
            if (x < 0 || x >= level->width || y < 0 || y >= level->rows_in) {
                break;
            }
            next = drogue_search_level_row(level, y)[x];
            if (t == first) { /* what is nearer may belong to the disc */
                before = here = next;
                continue;
            }
            if (sign * (next - before) > best) { /* across the step at t - 1 */
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

/* Rim about a dark disc by steps of one sign: its score, 0 when there is none. */
static uint32_t find_by_sign(drogue_rim *rim, const drogue_search_level *level, const drogue_search_disc *disc,
                             int32_t sign)
{
    static const int32_t tolerances_q8[3] = {90, 56, 40};
    const int32_t ring = disc->ring_q4;
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

uint32_t drogue_rim_find(drogue_rim *out, const drogue_search_level *level, const drogue_search_disc *disc)
{
    drogue_rim falling;
    const uint32_t rises = find_by_sign(out, level, disc, 1);
    const uint32_t falls = find_by_sign(&falling, level, disc, -1);
    if (falls > rises) {
        *out = falling;
        return falls;
    }
    return rises;
}
