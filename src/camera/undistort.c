/* SPDX-License-Identifier: Apache-2.0 */
/* Brown-Conrady distortion and its inverse by damped Newton steps, in normalised coordinates Q36. */
#include "drogue/undistort.h"

#include "drogue/wide.h"

#define FRAC 36
#define MAX_STEPS 64

static const int64_t one_q36 = INT64_C(1) << FRAC;
static const int64_t most_q36 = INT64_C(4) << FRAC; /* off the axis, in focal lengths */
static const int64_t still_q36 = INT64_C(1) << 10;  /* a step this short squares to nothing in the next */

static int64_t mul_q36(int64_t a, int64_t b) { return drogue_s128_shr_round(drogue_s128_mul(a, b), FRAC); }

static int64_t abs_s64(int64_t v) { return v < 0 ? -v : v; }

/* Coefficient Q16 -> Q36. */
static int64_t widen(drogue_q16 k) { return (int64_t)k * (INT64_C(1) << (FRAC - 16)); }

static int small(drogue_q16 k) { return k >= -DROGUE_MAX_DISTORTION_Q16 && k <= DROGUE_MAX_DISTORTION_Q16; }

/* Distorted position and its derivatives: the Jacobian is symmetric. */
typedef struct distorted {
    int64_t x, y;
    int64_t dxx, dxy, dyy;
} distorted;

/* With |x|, |y| <= 4 and coefficients up to 256 every sum stays below 2^62. */
static distorted distort_q36(const drogue_camera *c, int64_t x, int64_t y)
{
    int64_t k1 = widen(c->k1_q16);
    int64_t k2 = widen(c->k2_q16);
    int64_t k3 = widen(c->k3_q16);
    int64_t p1 = widen(c->p1_q16);
    int64_t p2 = widen(c->p2_q16);
    int64_t xx = mul_q36(x, x);
    int64_t xy = mul_q36(x, y);
    int64_t yy = mul_q36(y, y);
    int64_t r2 = xx + yy;
    int64_t radial = one_q36 + mul_q36(k1 + mul_q36(k2 + mul_q36(k3, r2), r2), r2);
    int64_t slope = k1 + mul_q36(2 * k2 + mul_q36(3 * k3, r2), r2); /* d radial / d r2 */
    distorted d;
    d.x = mul_q36(x, radial) + 2 * mul_q36(p1, xy) + mul_q36(p2, r2 + 2 * xx);
    d.y = mul_q36(y, radial) + mul_q36(p1, r2 + 2 * yy) + 2 * mul_q36(p2, xy);
    d.dxx = radial + 2 * mul_q36(xx, slope) + 2 * mul_q36(p1, y) + 6 * mul_q36(p2, x);
    d.dxy = 2 * mul_q36(xy, slope) + 2 * mul_q36(p1, x) + 2 * mul_q36(p2, y);
    d.dyy = radial + 2 * mul_q36(yy, slope) + 6 * mul_q36(p1, y) + 2 * mul_q36(p2, x);
    DROGUE_NOTE("undistort: normalised position, Q36", x, 39);
    DROGUE_NOTE("undistort: distorted position, Q36", d.x, 62);
    DROGUE_NOTE("undistort: derivative, Q36", d.dxx, 62);
    return d;
}

/* Pixel -> normalised; 0 when too far off the axis. */
static int normalise(int64_t *x_q36, drogue_q16 px_q16, drogue_q16 centre_q16, drogue_q16 focal_q16)
{
    if (focal_q16 <= 0) {
        return 0;
    }
    *x_q36 = drogue_wide_to_s64(
        drogue_wide_div(drogue_wide_from_s64((int64_t)px_q16 - centre_q16, 0), drogue_wide_from_s64(focal_q16, 0)),
        FRAC);
    return *x_q36 >= -most_q36 && *x_q36 <= most_q36;
}

/* Both coordinates, and coefficients that the arithmetic holds. */
static int enter(int64_t *x_q36, int64_t *y_q36, drogue_q16 x_px_q16, drogue_q16 y_px_q16, const drogue_camera *c)
{
    return small(c->k1_q16) && small(c->k2_q16) && small(c->p1_q16) && small(c->p2_q16) && small(c->k3_q16) &&
           normalise(x_q36, x_px_q16, c->cx_px_q16, c->fx_px_q16) &&
           normalise(y_q36, y_px_q16, c->cy_px_q16, c->fy_px_q16);
}

/* Normalised -> pixel; 0 when it leaves Q16. */
static int to_pixel(drogue_q16 *px_q16, int64_t x_q36, drogue_q16 centre_q16, drogue_q16 focal_q16)
{
    int64_t px;
    if (abs_s64(x_q36) > (INT64_C(1) << 54)) {
        return 0;
    }
    px = drogue_mul_shr_round_s64(x_q36, focal_q16, FRAC) + centre_q16;
    *px_q16 = (drogue_q16)px;
    return *px_q16 == px;
}

static drogue_status leave(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, int64_t x_q36, int64_t y_q36,
                           const drogue_camera *c)
{
    drogue_q16 x;
    drogue_q16 y;
    if (!to_pixel(&x, x_q36, c->cx_px_q16, c->fx_px_q16) || !to_pixel(&y, y_q36, c->cy_px_q16, c->fy_px_q16)) {
        return DROGUE_E_DOMAIN;
    }
    *x_px_q16 = x;
    *y_px_q16 = y;
    return DROGUE_OK;
}

drogue_status drogue_distort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera)
{
    int64_t x;
    int64_t y;
    distorted d;
    if (!enter(&x, &y, *x_px_q16, *y_px_q16, camera)) {
        return DROGUE_E_DOMAIN;
    }
    d = distort_q36(camera, x, y);
    return leave(x_px_q16, y_px_q16, d.x, d.y, camera);
}

/* Is the map locally one to one, and tame enough for the arithmetic of a step? */
static int regular(const distorted *d, int64_t u, int64_t v)
{
    const int64_t steepest = INT64_C(64) << FRAC;
    const int64_t farthest = INT64_C(16) << FRAC;
    return d->dxx > 0 && d->dyy > 0 && d->dxx < steepest && d->dyy < steepest && abs_s64(d->dxy) < steepest &&
           abs_s64(u - d->x) < farthest && abs_s64(v - d->y) < farthest &&
           mul_q36(d->dxx, d->dyy) - mul_q36(d->dxy, d->dxy) > (one_q36 >> 16);
}

/* Is the map regular all the way from the axis to (x, y)? Where the terms that could fold it cannot outweigh the 1 of
 * its derivative it is; else 16 places on the way are looked at. */
static int before_fold(const drogue_camera *c, int64_t x, int64_t y)
{
    int64_t q = mul_q36(x, x) + mul_q36(y, y);
    int64_t k1 = c->k1_q16 < 0 ? 3 * widen(c->k1_q16) : 0; /* d (r radial) / dr = 1 + 3 k1 q + 5 k2 q^2 + 7 k3 q^3 */
    int64_t k2 = c->k2_q16 < 0 ? 5 * widen(c->k2_q16) : 0;
    int64_t k3 = c->k3_q16 < 0 ? 7 * widen(c->k3_q16) : 0;
    int64_t p = 4 * (abs_s64(widen(c->p1_q16)) + abs_s64(widen(c->p2_q16))); /* times 1 + q >= 2 r */
    int i;
    if (one_q36 + mul_q36(k1 + mul_q36(k2 + mul_q36(k3, q), q), q) - mul_q36(p, one_q36 + q) > 0) {
        return 1;
    }
    for (i = 1; i < 16; i++) {
        distorted d = distort_q36(c, (x >> 4) * i, (y >> 4) * i);
        if (!regular(&d, d.x, d.y)) {
            return 0;
        }
    }
    return 1;
}

/* Quotient of two Q36 numbers, den > 2^-16: 20 bits of the divisor are enough for a step. */
static int64_t divide(int64_t num_q36, int64_t den_q36)
{
    int excess = 23 - drogue_clz_u64(drogue_abs_u64(num_q36)); /* bits beyond 41 */
    if (excess > 0) {
        num_q36 >>= excess;
        den_q36 >>= excess;
    }
    DROGUE_NOTE("undistort: step numerator, Q36", num_q36, 42);
    return drogue_div_round_s64(num_q36 * (INT64_C(1) << 19), (den_q36 >> 17) + 1);
}

drogue_status drogue_undistort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera)
{
    int64_t u;
    int64_t v;
    int64_t x;
    int64_t y;
    int64_t dx = 0;
    int64_t dy = 0;
    int64_t nearest = INT64_MAX;
    int step;
    if (!enter(&u, &v, *x_px_q16, *y_px_q16, camera)) {
        return DROGUE_E_DOMAIN;
    }
    x = 0; /* from the axis: what is seen without a fold can be followed from there */
    y = 0;
    for (step = 0; step < MAX_STEPS; step++) {
        distorted d = distort_q36(camera, x + dx, y + dy);
        int64_t miss = abs_s64(u - d.x) + abs_s64(v - d.y);
        int64_t det;
        if (!regular(&d, u, v) || (miss >= nearest && miss > still_q36)) { /* across a fold or too far: half the step */
            dx >>= 1;
            dy >>= 1;
            continue;
        }
        nearest = miss;
        x += dx;
        y += dy;
        det = mul_q36(d.dxx, d.dyy) - mul_q36(d.dxy, d.dxy);
        dx = divide(mul_q36(d.dyy, u - d.x) - mul_q36(d.dxy, v - d.y), det);
        dy = divide(mul_q36(d.dxx, v - d.y) - mul_q36(d.dxy, u - d.x), det);
        if (abs_s64(dx) + abs_s64(dy) <= still_q36) {
            return !before_fold(camera, x, y) ? DROGUE_E_DOMAIN : leave(x_px_q16, y_px_q16, x + dx, y + dy, camera);
        }
        dx = x + dx > most_q36 ? most_q36 - x : x + dx < -most_q36 ? -most_q36 - x : dx;
        dy = y + dy > most_q36 ? most_q36 - y : y + dy < -most_q36 ? -most_q36 - y : dy;
    }
    return DROGUE_E_DOMAIN;
}
