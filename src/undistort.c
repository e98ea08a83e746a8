/* SPDX-License-Identifier: Apache-2.0 */
/* Brown-Conrady distortion and its inverse by Newton's method, in normalised coordinates Q28. */
#include "drogue/undistort.h"

#include "drogue/wide.h"

#define FRAC 28
#define MAX_STEPS 12

static const int64_t one_q28 = INT64_C(1) << FRAC;
static const int64_t most_q28 = INT64_C(4) << FRAC; /* off the axis, in focal lengths */

static int64_t mul_q28(int64_t a, int64_t b)
{
    return drogue_mul_shr_round_s64(a, b, FRAC);
}

static int64_t abs_s64(int64_t v)
{
    return v < 0 ? -v : v;
}

/* Distorted position and its derivatives. Beyond the model: xx, xy, yy of the Jacobian (it is symmetric). */
typedef struct distorted {
    int64_t x, y;
    int64_t dxx, dxy, dyy;
} distorted;

/* With |x|, |y| <= 4 and coefficients of Q16's range every sum stays below 2^62. */
static distorted distort_q28(const drogue_camera *c, int64_t x, int64_t y)
{
    int64_t k1 = (int64_t)c->k1_q16 * 4096;
    int64_t k2 = (int64_t)c->k2_q16 * 4096;
    int64_t k3 = (int64_t)c->k3_q16 * 4096;
    int64_t p1 = (int64_t)c->p1_q16 * 4096;
    int64_t p2 = (int64_t)c->p2_q16 * 4096;
    int64_t xx = mul_q28(x, x);
    int64_t xy = mul_q28(x, y);
    int64_t yy = mul_q28(y, y);
    int64_t r2 = xx + yy;
    int64_t radial = one_q28 + mul_q28(k1 + mul_q28(k2 + mul_q28(k3, r2), r2), r2);
    int64_t slope = k1 + mul_q28(2 * k2 + mul_q28(3 * k3, r2), r2); /* d radial / d r2 */
    distorted d;
    d.x = mul_q28(x, radial) + 2 * mul_q28(p1, xy) + mul_q28(p2, r2 + 2 * xx);
    d.y = mul_q28(y, radial) + mul_q28(p1, r2 + 2 * yy) + 2 * mul_q28(p2, xy);
    d.dxx = radial + 2 * mul_q28(xx, slope) + 2 * mul_q28(p1, y) + 6 * mul_q28(p2, x);
    d.dxy = 2 * mul_q28(xy, slope) + 2 * mul_q28(p1, x) + 2 * mul_q28(p2, y);
    d.dyy = radial + 2 * mul_q28(yy, slope) + 6 * mul_q28(p1, y) + 2 * mul_q28(p2, x);
    return d;
}

/* Pixel -> normalised; 0 when too far off the axis. */
static int normalise(int64_t *x_q28, drogue_q16 px_q16, drogue_q16 centre_q16, drogue_q16 focal_q16)
{
    if (focal_q16 <= 0) {
        return 0;
    }
    *x_q28 = drogue_div_round_s64(drogue_shl_s64((int64_t)px_q16 - centre_q16, FRAC), focal_q16);
    return abs_s64(*x_q28) <= most_q28;
}

/* Normalised -> pixel; 0 when it leaves Q16. */
static int to_pixel(drogue_q16 *px_q16, int64_t x_q28, drogue_q16 centre_q16, drogue_q16 focal_q16)
{
    int64_t px;
    if (abs_s64(x_q28) > (INT64_C(1) << 46)) {
        return 0;
    }
    px = drogue_mul_shr_round_s64(x_q28, focal_q16, FRAC) + centre_q16;
    *px_q16 = drogue_sat_s32(px);
    return *px_q16 == px;
}

drogue_status drogue_distort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera)
{
    int64_t x;
    int64_t y;
    distorted d;
    drogue_q16 u;
    drogue_q16 v;
    if (!normalise(&x, *x_px_q16, camera->cx_px_q16, camera->fx_px_q16) ||
        !normalise(&y, *y_px_q16, camera->cy_px_q16, camera->fy_px_q16)) {
        return DROGUE_E_DOMAIN;
    }
    d = distort_q28(camera, x, y);
    if (!to_pixel(&u, d.x, camera->cx_px_q16, camera->fx_px_q16) ||
        !to_pixel(&v, d.y, camera->cy_px_q16, camera->fy_px_q16)) {
        return DROGUE_E_DOMAIN;
    }
    *x_px_q16 = u;
    *y_px_q16 = v;
    return DROGUE_OK;
}

/* One Newton step towards the point whose distorted image is (u, v); 0 when the map folds or runs away. */
static int newton_step(int64_t *x, int64_t *y, int64_t *moved, const drogue_camera *camera, int64_t u, int64_t v)
{
    const int64_t most = INT64_C(16) << FRAC;
    distorted d = distort_q28(camera, *x, *y);
    int64_t ex = u - d.x;
    int64_t ey = v - d.y;
    int64_t det;
    int64_t nx;
    int64_t ny;
    if (abs_s64(d.dxx) > most || abs_s64(d.dxy) > most || abs_s64(d.dyy) > most || d.dxx <= 0 || d.dyy <= 0 ||
        abs_s64(ex) > most || abs_s64(ey) > most) {
        return 0;
    }
    det = mul_q28(d.dxx, d.dyy) - mul_q28(d.dxy, d.dxy);
    nx = mul_q28(d.dyy, ex) - mul_q28(d.dxy, ey);
    ny = mul_q28(d.dxx, ey) - mul_q28(d.dxy, ex);
    if (det <= 0 || abs_s64(nx) > 2 * most || abs_s64(ny) > 2 * most) {
        return 0;
    }
    nx = drogue_div_round_s64(nx * one_q28, det);
    ny = drogue_div_round_s64(ny * one_q28, det);
    *moved = abs_s64(nx) + abs_s64(ny);
    *x += nx;
    *y += ny;
    return abs_s64(*x) <= most_q28 && abs_s64(*y) <= most_q28;
}

drogue_status drogue_undistort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera)
{
    int64_t u;
    int64_t v;
    int64_t x;
    int64_t y;
    int64_t moved = most_q28;
    drogue_q16 px;
    drogue_q16 py;
    int step;
    if (!normalise(&u, *x_px_q16, camera->cx_px_q16, camera->fx_px_q16) ||
        !normalise(&v, *y_px_q16, camera->cy_px_q16, camera->fy_px_q16)) {
        return DROGUE_E_DOMAIN;
    }
    x = u;
    y = v;
    for (step = 0; step < MAX_STEPS && moved > 2; step++) {
        if (!newton_step(&x, &y, &moved, camera, u, v)) {
            return DROGUE_E_DOMAIN;
        }
    }
    if (moved > 2 || !to_pixel(&px, x, camera->cx_px_q16, camera->fx_px_q16) ||
        !to_pixel(&py, y, camera->cy_px_q16, camera->fy_px_q16)) {
        return DROGUE_E_DOMAIN;
    }
    *x_px_q16 = px;
    *y_px_q16 = py;
    return DROGUE_OK;
}
