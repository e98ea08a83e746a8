/* SPDX-License-Identifier: Apache-2.0 */
/* Brown-Conrady distortion and its inverse by damped Newton steps, in normalised coordinates Q29.
 *
 * What the lens adds is computed apart from the position, in block floating point: the point is scaled to a distance
 * near 1 from the axis, and the five coefficients, each times the power of the scale that goes with it, to a common
 * exponent at which the largest has 27 bits. So an error is some 2^-26 of the displacement, whatever the
 * coefficients. */
#include "drogue/undistort.h"

#include "drogue/real.h"

#define FRAC 29
#define DERIVATIVE_FRAC 24
#define TERM_BITS 27
#define MAX_STEPS 64

static const int64_t one_q24 = INT64_C(1) << DERIVATIVE_FRAC;
static const int64_t most_q29 = INT64_C(4) << FRAC; /* off the axis, in focal lengths */
static const int64_t noise_q29 = 128;               /* a miss that need not lessen */
static const int64_t still_q29 = 64;                /* a step this short, 2^-23, squares to nothing in the next */

/* a * b / 2^n, rounded. */
static int64_t mul(int32_t a, int32_t b, int n) { return drogue_shr_round_s64((int64_t)a * b, n); }

static int32_t mul_q30(int32_t a, int32_t b) { return (int32_t)mul(a, b, 30); }

static int64_t abs_s64(int64_t v) { return v < 0 ? -v : v; }

enum { K1, K2, K3, P1, P2, COEFFICIENTS };

/* Coefficients Q16 and their bits. */
typedef struct lens {
    int32_t q16[COEFFICIENTS];
    int bits[COEFFICIENTS];
} lens;

/* Powers of the distance from the axis, in the derivative, that go with them. */
static const int power[COEFFICIENTS] = {2, 4, 6, 1, 1};

static void lens_of(lens *l, const drogue_camera *c)
{
    int i;
    l->q16[K1] = c->k1_q16;
    l->q16[K2] = c->k2_q16;
    l->q16[K3] = c->k3_q16;
    l->q16[P1] = c->p1_q16;
    l->q16[P2] = c->p2_q16;
    for (i = 0; i < COEFFICIENTS; i++) {
        l->bits[i] = 32 - drogue_clz_u32((uint32_t)drogue_abs_u64(l->q16[i]));
    }
}

/* A point (x, y) 2^scale whose squared distance from the axis, in that scale, is in [1/2, 2); the lens's terms there,
 * times 2^exponent. */
typedef struct block {
    int scale;
    int exponent;
    int32_t x_q29;
    int32_t y_q29;
    int32_t r2_q30;
    int32_t term[COEFFICIENTS];
} block;

/* v * 2^n, rounded; the caller knows that it fits */
static int32_t shifted(int32_t v, int n)
{
    return n >= 0 ? (int32_t)((uint32_t)v << n) : n < -31 ? 0 : (v >> -n) + ((v >> (-n - 1)) & 1);
}

static void block_at(block *b, const lens *l, int32_t x_q29, int32_t y_q29)
{
    const uint64_t r2_q58 = drogue_square_sum(x_q29, y_q29);
    const int scale = (6 - drogue_clz_u64(r2_q58)) >> 1; /* [-29, 2] */
    int most = l->bits[0] + power[0] * scale;
    int i;
    for (i = 1; i < COEFFICIENTS; i++) {
        const int bits = l->bits[i] + power[i] * scale;
        most = bits > most ? bits : most;
    }
    for (i = 0; i < COEFFICIENTS; i++) {
        b->term[i] = shifted(l->q16[i], TERM_BITS - most + power[i] * scale);
        DROGUE_NOTE("undistort: term of the lens", b->term[i], TERM_BITS);
    }
    b->scale = scale;
    b->exponent = 16 + TERM_BITS - most; /* 6 or more */
    b->x_q29 = shifted(x_q29, -scale);
    b->y_q29 = shifted(y_q29, -scale);
    b->r2_q30 = (int32_t)(scale < -14 ? r2_q58 << (-28 - 2 * scale) : r2_q58 >> (28 + 2 * scale));
}

/* What the lens adds to a position, and the derivatives of the distorted position: the Jacobian is symmetric. */
typedef struct distorted {
    int64_t x_q29, y_q29;
    int64_t xx_q24, xy_q24, yy_q24;
} distorted;

/* From the terms' scale to Q24. */
static int64_t derivative(int64_t v, int exponent)
{
    const int n = exponent - DERIVATIVE_FRAC;
    return n < 0 ? drogue_shl_s64(v, -n) : drogue_shr_round_s64(v, n > 63 ? 63 : n);
}

static void distort(distorted *d, const lens *l, int32_t x_q29, int32_t y_q29)
{
    block b;
    int32_t radial;     /* less 1: terms are below 2^27, their sum below 14 * 2^27 */
    int32_t half_slope; /* of radial over r2 */
    int32_t xx_q29;
    int32_t xy_q29;
    int32_t yy_q29;
    int64_t p1_x;
    int64_t p1_y;
    int64_t p2_x;
    int64_t p2_y;
    int shift;
    block_at(&b, l, x_q29, y_q29);
    xx_q29 = (int32_t)mul(b.x_q29, b.x_q29, FRAC);
    xy_q29 = (int32_t)mul(b.x_q29, b.y_q29, FRAC);
    yy_q29 = (int32_t)mul(b.y_q29, b.y_q29, FRAC);
    radial = b.term[K1] + mul_q30(b.r2_q30, b.term[K2] + mul_q30(b.r2_q30, b.term[K3]));
    radial = mul_q30(b.r2_q30, radial);
    half_slope = (b.term[K1] >> 1) + mul_q30(b.r2_q30, b.term[K2] + mul_q30(b.r2_q30, 3 * (b.term[K3] >> 1)));
    p1_x = mul(b.term[P1], b.x_q29, FRAC);
    p1_y = mul(b.term[P1], b.y_q29, FRAC);
    p2_x = mul(b.term[P2], b.x_q29, FRAC);
    p2_y = mul(b.term[P2], b.y_q29, FRAC);
    shift = b.exponent - b.scale; /* 4 or more */
    shift = shift > 63 ? 63 : shift;
    d->x_q29 = drogue_shr_round_s64((int64_t)b.x_q29 * radial + 2 * ((int64_t)b.term[P1] * xy_q29) +
                                        (int64_t)b.term[P2] * yy_q29 + 3 * ((int64_t)b.term[P2] * xx_q29),
                                    shift);
    d->y_q29 = drogue_shr_round_s64((int64_t)b.y_q29 * radial + 2 * ((int64_t)b.term[P2] * xy_q29) +
                                        (int64_t)b.term[P1] * xx_q29 + 3 * ((int64_t)b.term[P1] * yy_q29),
                                    shift);
    d->xx_q24 = derivative(radial + 4 * mul(xx_q29, half_slope, FRAC) + 2 * p1_y + 6 * p2_x, b.exponent) + one_q24;
    d->xy_q24 = derivative(4 * mul(xy_q29, half_slope, FRAC) + 2 * (p1_x + p2_y), b.exponent);
    d->yy_q24 = derivative(radial + 4 * mul(yy_q29, half_slope, FRAC) + 6 * p1_y + 2 * p2_x, b.exponent) + one_q24;
    DROGUE_NOTE("undistort: displacement, Q29", d->x_q29, 58);
    DROGUE_NOTE("undistort: derivative, Q24", d->xx_q24, 52);
}

/* A coordinate within the domain; 4 itself is one unit less. */
static int64_t clamp(int64_t v) { return v > INT32_MAX ? INT32_MAX : v < -INT32_MAX ? -INT32_MAX : v; }

/* Pixel -> normalised; 0 when too far off the axis. */
static int normalise(int32_t *x_q29, drogue_q16 px_q16, drogue_q16 centre_q16, drogue_q16 focal_q16)
{
    drogue_real x;
    drogue_real_ratio(&x, (int64_t)px_q16 - centre_q16, focal_q16);
    *x_q29 = (int32_t)clamp(drogue_real_to_s64(x, FRAC));
    return abs_s64(drogue_real_to_s64(x, FRAC)) <= most_q29;
}

/* Both coordinates, and coefficients that the arithmetic holds. */
static int enter(lens *l, int32_t *x_q29, int32_t *y_q29, drogue_q16 x_px_q16, drogue_q16 y_px_q16,
                 const drogue_camera *c)
{
    lens_of(l, c);
    return drogue_camera_valid(c) && normalise(x_q29, x_px_q16, c->cx_px_q16, c->fx_px_q16) &&
           normalise(y_q29, y_px_q16, c->cy_px_q16, c->fy_px_q16);
}

/* Move a pixel by a normalised displacement; 0 when it leaves Q16. */
static int move_pixel(drogue_q16 *px_q16, int64_t by_q29, drogue_q16 focal_q16)
{
    drogue_real by;
    drogue_real focal;
    int64_t px;
    drogue_real_set(&by, by_q29, -FRAC);
    drogue_real_set(&focal, focal_q16, 0);
    drogue_real_product(&by, &by, &focal);
    px = drogue_real_to_s64(by, 0);
    if (px > UINT32_MAX || px < -(int64_t)UINT32_MAX) {
        return 0;
    }
    px += *px_q16;
    *px_q16 = (drogue_q16)px;
    return *px_q16 == px;
}

static drogue_status leave(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, int64_t x_q29, int64_t y_q29,
                           const drogue_camera *c)
{
    drogue_q16 x = *x_px_q16;
    drogue_q16 y = *y_px_q16;
    if (!move_pixel(&x, x_q29, c->fx_px_q16) || !move_pixel(&y, y_q29, c->fy_px_q16)) {
        return DROGUE_E_DOMAIN;
    }
    *x_px_q16 = x;
    *y_px_q16 = y;
    return DROGUE_OK;
}

drogue_status drogue_distort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera)
{
    int32_t x;
    int32_t y;
    lens l;
    distorted d;
    if (!enter(&l, &x, &y, *x_px_q16, *y_px_q16, camera)) {
        return DROGUE_E_DOMAIN;
    }
    distort(&d, &l, x, y);
    return leave(x_px_q16, y_px_q16, d.x_q29, d.y_q29, camera);
}

/* Determinant of the Jacobian, Q48. */
static int64_t determinant(const distorted *d)
{
    return (int64_t)(int32_t)d->xx_q24 * (int32_t)d->yy_q24 - (int64_t)(int32_t)d->xy_q24 * (int32_t)d->xy_q24;
}

/* Is the map locally one to one, and tame enough for the arithmetic of a step of what is missed? */
static int regular(const distorted *d, int64_t miss_x_q29, int64_t miss_y_q29)
{
    const int64_t steepest = 64 * one_q24;
    return d->xx_q24 > 0 && d->yy_q24 > 0 && d->xx_q24 < steepest && d->yy_q24 < steepest &&
           abs_s64(d->xy_q24) < steepest && abs_s64(miss_x_q29) <= INT32_MAX && abs_s64(miss_y_q29) <= INT32_MAX &&
           determinant(d) > INT64_C(1) << (2 * DERIVATIVE_FRAC - 16);
}

/* A quarter of what is below 0, rounded up. */
static int32_t loss_of(int32_t v) { return v < 0 ? ((-v) >> 2) + 1 : 0; }

/* Is the map regular all the way from the axis to (x, y)? Where the terms that could fold it cannot outweigh the 1 of
 * its derivative it is; else 16 places on the way are looked at. */
static int before_fold(const lens *l, int32_t x_q29, int32_t y_q29)
{
    block b;
    int64_t p;
    int64_t loss; /* d (r radial) / dr = 1 + 3 k1 q + 5 k2 q^2 + 7 k3 q^3, q = r^2; and p times 8 r <= 4 (1 + q) */
    int i;
    block_at(&b, l, x_q29, y_q29);
    loss = 5 * loss_of(b.term[K2]) + mul_q30(b.r2_q30, 7 * loss_of(b.term[K3]));
    loss = mul(b.r2_q30, 3 * loss_of(b.term[K1]) + mul_q30(b.r2_q30, (int32_t)loss), 30);
    p = 2 + (abs_s64(b.term[P1]) + abs_s64(b.term[P2])) / 4;
    loss += 4 * (p + mul(b.r2_q30, (int32_t)p, 30));
    if (b.exponent > 40 || loss < INT64_C(1) << (b.exponent - 2)) {
        return 1;
    }
    for (i = 1; i < 16; i++) {
        distorted d;
        distort(&d, l, (x_q29 >> 4) * i, (y_q29 >> 4) * i);
        if (!regular(&d, 0, 0)) {
            return 0;
        }
    }
    return 1;
}

/* (a b - c d) / det, Q29 */
static int64_t step_of(int64_t a_q24, int64_t b_q29, int64_t c_q24, int64_t d_q29, const drogue_real *det)
{
    drogue_real t;
    drogue_real_set(&t, (int64_t)(int32_t)a_q24 * (int32_t)b_q29 - (int64_t)(int32_t)c_q24 * (int32_t)d_q29,
                    -DERIVATIVE_FRAC - FRAC);
    drogue_real_quotient(&t, &t, det);
    return drogue_real_to_s64(t, FRAC);
}

drogue_status drogue_undistort_point(drogue_q16 *x_px_q16, drogue_q16 *y_px_q16, const drogue_camera *camera)
{
    int32_t u;
    int32_t v;
    int64_t x = 0;
    int64_t y = 0;
    int64_t dx;
    int64_t dy;
    int64_t nearest;
    int step;
    lens l;
    if (!enter(&l, &u, &v, *x_px_q16, *y_px_q16, camera)) {
        return DROGUE_E_DOMAIN;
    }
    dx = u;
    dy = v;
    nearest = abs_s64(dx) + abs_s64(dy);
    /* From the axis, where the map is the identity: what is seen without a fold can be followed from there. */
    for (step = 0; step < MAX_STEPS; step++) {
        distorted d;
        drogue_real det;
        int64_t miss_x;
        int64_t miss_y;
        int64_t miss;
        distort(&d, &l, (int32_t)(x + dx), (int32_t)(y + dy));
        miss_x = u - (x + dx) - d.x_q29;
        miss_y = v - (y + dy) - d.y_q29;
        miss = abs_s64(miss_x) + abs_s64(miss_y);
        if (!regular(&d, miss_x, miss_y) || (miss >= nearest && miss > noise_q29)) {
            dx >>= 1; /* across a fold or too far: half the step */
            dy >>= 1;
            continue;
        }
        nearest = miss;
        x += dx;
        y += dy;
        drogue_real_set(&det, determinant(&d), -2 * DERIVATIVE_FRAC);
        dx = step_of(d.yy_q24, miss_x, d.xy_q24, miss_y, &det);
        dy = step_of(d.xx_q24, miss_y, d.xy_q24, miss_x, &det);
        if (abs_s64(dx) + abs_s64(dy) <= still_q29) {
            nearest = 0;
            break;
        }
        dx = clamp(x + dx) - x;
        dy = clamp(y + dy) - y;
    }
    if (step == MAX_STEPS) { /* to and fro by what rounding makes of a miss: it lies between */
        dx /= 2;
        dy /= 2;
    }
    return nearest <= noise_q29 && before_fold(&l, (int32_t)x, (int32_t)y)
               ? leave(x_px_q16, y_px_q16, x + dx - u, y + dy - v, camera)
               : DROGUE_E_DOMAIN;
}
