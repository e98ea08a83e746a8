/* SPDX-License-Identifier: Apache-2.0 */
/* Edges along rays. */
#include "drogue/rays.h"

#include "drogue/fixed.h"

#define REACH 4    /* samples on either side that a slope is made of */
#define SAMPLES 65 /* most slopes along a ray */
#define HALF DROGUE_Q16(1, 2)
#define NEAREST DROGUE_Q16(2, 1) /* px: reach */
#define FARTHEST DROGUE_Q16(512, 1)

/* A place as far out as 2^14 px, where every image has ended. */
static int32_t placed(int64_t v_px_q16)
{
    const int64_t most = 1 << 30;
    return (int32_t)(v_px_q16 > most ? most : v_px_q16 < -most ? -most : v_px_q16);
}

/* Grey between a pixel, the one to the right and those below, Q8. */
static inline int32_t between_q8(const uint8_t *at, int32_t right, int32_t stride, int32_t x_px_q16, int32_t y_px_q16)
{
    const int32_t fx = (x_px_q16 >> 8) & 255;
    const int32_t fy = (y_px_q16 >> 8) & 255;
    const uint8_t *below = at + stride;
    const int32_t upper = at[0] * 256 + (at[right] - at[0]) * fx;
    const int32_t lower = below[0] * 256 + (below[right] - below[0]) * fx;
    return (upper * 256 + (lower - upper) * fy + 128) >> 8;
}

static inline const uint8_t *pixel(const drogue_image *image, int32_t x_px_q16, int32_t y_px_q16)
{
    return drogue_image_row(image, y_px_q16 >> 16) + (x_px_q16 >> 16);
}

/* Grey at a place; beyond the image as at its border. */
static int32_t grey_q8(const drogue_image *image, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    const int32_t x = drogue_clamp_s32(x_px_q16, 0, (image->width_px - 1) * DROGUE_Q16_ONE);
    const int32_t y = drogue_clamp_s32(y_px_q16, 0, (image->height_px - 1) * DROGUE_Q16_ONE);
    return between_q8(pixel(image, x, y), (x & 0xFFFF) > 255, (y & 0xFFFF) > 255 ? image->stride : 0, x, y);
}

/* Keep an edge among the steepest. */
static void keep(drogue_ray *r, const drogue_ray_edge *e)
{
    uint32_t at = r->count;
    uint32_t i;
    if (r->count < DROGUE_RAY_EDGES) {
        r->count++;
    } else {
        for (at = 0, i = 1; i < DROGUE_RAY_EDGES; i++) {
            at = r->edges[i].slope_q8 < r->edges[at].slope_q8 ? i : at;
        }
        if (r->edges[at].slope_q8 >= e->slope_q8) {
            return;
        }
    }
    r->edges[at] = *e;
}

/* Are all four pixels about a place in the image? */
static int within(const drogue_image *image, int32_t x_px_q16, int32_t y_px_q16)
{
    return x_px_q16 >= 0 && y_px_q16 >= 0 && x_px_q16 >> 16 < image->width_px - 1 &&
           y_px_q16 >> 16 < image->height_px - 1;
}

void drogue_ray_read(int32_t *grey_q8_out, const drogue_ray *r, const drogue_image *image, drogue_q16 from_px_q16,
                     int32_t count)
{
    const int32_t dx = (int32_t)drogue_shr_round_s64((int64_t)r->nx_q14 * r->step_px_q16, 14);
    const int32_t dy = (int32_t)drogue_shr_round_s64((int64_t)r->ny_q14 * r->step_px_q16, 14);
    int32_t x = r->x_px_q16 + (int32_t)drogue_shr_round_s64((int64_t)r->nx_q14 * from_px_q16, 14);
    int32_t y = r->y_px_q16 + (int32_t)drogue_shr_round_s64((int64_t)r->ny_q14 * from_px_q16, 14);
    const int inner = within(image, x, y) && within(image, x + (count - 1) * dx, y + (count - 1) * dy);
    int32_t i;
    for (i = 0; i < count; i++) {
        grey_q8_out[i] = inner ? between_q8(pixel(image, x, y), 1, image->stride, x, y) : grey_q8(image, x, y);
        x += dx;
        y += dy;
    }
}

int32_t drogue_ray_peak_q16(int32_t before, int32_t at, int32_t after)
{
    const int64_t bend = 2 * (int64_t)at - before - after; /* > 0 */
    return (int32_t)drogue_div_round_s64(((int64_t)after - before) * HALF, bend);
}

/* Slopes along a ray by a derivative of Gaussian of two samples, and their peaks to a share of a sample: 'out' samples to
 * either side. */
static void find_edges(drogue_ray *r, const drogue_image *image, int32_t out, int32_t least_q8)
{
    static const int32_t taps[REACH] = {3, 4, 3, 2};
    int32_t grey[SAMPLES + 2 * REACH];
    int32_t slope[SAMPLES];
    const int32_t slopes = 2 * out + 1;
    int32_t i;
    int32_t k;
    drogue_ray_read(grey, r, image, -(out + REACH) * r->step_px_q16, slopes + 2 * REACH);
    for (i = 0; i < slopes; i++) {
        slope[i] = 0;
        for (k = 0; k < REACH; k++) {
            slope[i] += taps[k] * (grey[i + REACH + 1 + k] - grey[i + REACH - 1 - k]);
        }
    }
    r->count = 0;
    for (i = 1; i + 1 < slopes; i++) {
        if (slope[i] >= least_q8 && slope[i] > slope[i - 1] && slope[i] >= slope[i + 1]) {
            const int64_t part_q16 = drogue_ray_peak_q16(slope[i - 1], slope[i], slope[i + 1]);
            drogue_ray_edge e;
            e.at_px_q16 = (i - out) * r->step_px_q16 + (int32_t)drogue_shr_round_s64(part_q16 * r->step_px_q16, 16);
            e.slope_q8 = slope[i];
            e.level_q8 = grey[i + REACH];
            keep(r, &e);
        }
    }
}

/* A ray at an offset from the centre of an ellipse, px Q16, and along a normal. */
static void place(drogue_ray *r, const drogue_ellipse *e, int64_t x_px_q16, int64_t y_px_q16, int32_t nx_q14,
                  int32_t ny_q14)
{
    r->x_px_q16 = placed(e->xc_px_q16 + x_px_q16);
    r->y_px_q16 = placed(e->yc_px_q16 + y_px_q16);
    r->nx_q14 = nx_q14;
    r->ny_q14 = ny_q14;
    r->step_px_q16 = HALF;
    r->count = 0;
}

void drogue_rays_aim(drogue_ray rays[DROGUE_RAYS], const drogue_ellipse *e, int32_t phase)
{
    const int64_t turn_q29 = 52707179; /* 2 pi / 64 */
    int32_t sin_q30;
    int32_t cos_q30;
    int32_t k;
    drogue_sincos_q30(&sin_q30, &cos_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 13));
    for (k = 0; k < DROGUE_RAYS / 2; k++) { /* and the one across */
        int32_t s_q30;
        int32_t c_q30;
        int64_t u; /* offset from the centre along the axes, px Q16, then the normal along them */
        int64_t v;
        int64_t x;
        int64_t y;
        int64_t length;
        int32_t nx_q14;
        int32_t ny_q14;
        drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shr_round_s64((8 * k + phase) * turn_q29, 3));
        u = drogue_shr_round_s64((int64_t)e->a_px_q16 * c_q30, 30);
        v = drogue_shr_round_s64((int64_t)e->b_px_q16 * s_q30, 30);
        x = drogue_shr_round_s64(u * cos_q30 - v * sin_q30, 30);
        y = drogue_shr_round_s64(u * sin_q30 + v * cos_q30, 30);
        u = drogue_shr_round_s64((int64_t)e->b_px_q16 * c_q30, 30);
        v = drogue_shr_round_s64((int64_t)e->a_px_q16 * s_q30, 30);
        length = (int64_t)drogue_isqrt_u64((uint64_t)(u * u) + (uint64_t)(v * v)) + 1;
        u = drogue_div_round_s64(u * (1 << 14), length);
        v = drogue_div_round_s64(v * (1 << 14), length);
        nx_q14 = (int32_t)drogue_shr_round_s64(u * cos_q30 - v * sin_q30, 30);
        ny_q14 = (int32_t)drogue_shr_round_s64(u * sin_q30 + v * cos_q30, 30);
        place(&rays[k], e, x, y, nx_q14, ny_q14);
        place(&rays[k + DROGUE_RAYS / 2], e, -x, -y, -nx_q14, -ny_q14);
    }
}

void drogue_rays_cast(drogue_ray rays[DROGUE_RAYS], const drogue_image *image, const drogue_ellipse *e,
                      drogue_q16 reach_px_q16, int32_t phase, int32_t least)
{
    const drogue_q16 reach = drogue_clamp_s32(reach_px_q16, NEAREST, FARTHEST);
    const drogue_q16 least_step = reach / (SAMPLES / 2);
    const drogue_q16 step = HALF < least_step ? least_step : HALF;
    const int32_t out = drogue_clamp_s32(reach / step + 1, 1, SAMPLES / 2);
    int32_t k;
    drogue_rays_aim(rays, e, phase);
    for (k = 0; k < DROGUE_RAYS; k++) {
        rays[k].step_px_q16 = step;
        find_edges(&rays[k], image, out, least * DROGUE_RAY_WEIGHT * 128); /* blur may halve a slope */
    }
}
