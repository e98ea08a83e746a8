/* SPDX-License-Identifier: Apache-2.0 */
/* Edges along rays. */
#include "drogue/rays.h"

#include "light.h"
#include "vertex.h"

#define REACH 4    /* samples on either side that a slope is made of, and between the sums */
#define SAMPLES 65 /* most slopes along a ray */
#define HALF DROGUE_Q16(1, 2)
#define QUARTER DROGUE_Q16(1, 4)
#define NEAREST DROGUE_Q16(2, 1) /* px: reach */
#define FARTHEST DROGUE_Q16(512, 1)

static inline int32_t mixed_q8(int32_t upper_q8, int32_t lower_q8, int32_t part_q8)
{
    return upper_q8 + (((lower_q8 - upper_q8) * part_q8 + 128) >> 8);
}

static inline int32_t part_q8_of(int32_t px_q16) { return (px_q16 >> 8) & 255; }

/* Grey between a pixel and the one to the right, Q8. */
static inline int32_t row_q8(const uint8_t *at, int32_t right, int32_t part_q8)
{
    return at[0] * (256 - part_q8) + at[right] * part_q8;
}

/* Grey between a pixel, the one to the right and those below, Q8. */
static inline int32_t between_q8(const uint8_t *at, int32_t right, int32_t stride, int32_t x_px_q16, int32_t y_px_q16)
{
    const int32_t fx = part_q8_of(x_px_q16);
    return mixed_q8(row_q8(at, right, fx), row_q8(at + stride, right, fx), part_q8_of(y_px_q16));
}

/* The same of light, which the levels are encoded from. */
static inline int32_t light_row_q8(const uint8_t *at, int32_t right, int32_t part_q8)
{
    const uint16_t *light = drogue_srgb_light_q8;
    return (light[at[0]] * (256 - part_q8) + light[at[right]] * part_q8 + 128) >> 8;
}

static inline int32_t light_between_q8(const uint8_t *at, int32_t right, int32_t stride, int32_t x_px_q16,
                                       int32_t y_px_q16)
{
    const int32_t fx = part_q8_of(x_px_q16);
    return mixed_q8(light_row_q8(at, right, fx), light_row_q8(at + stride, right, fx), part_q8_of(y_px_q16));
}

static inline const uint8_t *pixel(const drogue_image *image, int32_t x_px_q16, int32_t y_px_q16)
{
    return drogue_image_row(image, y_px_q16 >> 16) + (x_px_q16 >> 16);
}

/* Grey or light at a place; beyond the image as at its border. */
static inline int32_t inside_q8(const drogue_image *image, drogue_q16 x_px_q16, drogue_q16 y_px_q16, int is_light)
{
    const int32_t x = drogue_clamp_s32(x_px_q16, 0, (image->width_px - 1) * DROGUE_Q16_ONE);
    const int32_t y = drogue_clamp_s32(y_px_q16, 0, (image->height_px - 1) * DROGUE_Q16_ONE);
    const uint8_t *at = pixel(image, x, y);
    const int32_t right = (x & 0xFFFF) > 255;
    const int32_t stride = (y & 0xFFFF) > 255 ? image->stride : 0;
    return is_light ? light_between_q8(at, right, stride, x, y) : between_q8(at, right, stride, x, y);
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

/* Along a ray: a sample's place, and the step to the next, px Q16. */
typedef struct ray_way {
    int32_t x;
    int32_t y;
    int32_t dx;
    int32_t dy;
} ray_way;

static ray_way way_along(const drogue_ray *r, drogue_q16 from_px_q16)
{
    ray_way way;
    way.x = r->x_px_q16 + drogue_ray_part(r->nx_q14, from_px_q16);
    way.y = r->y_px_q16 + drogue_ray_part(r->ny_q14, from_px_q16);
    way.dx = drogue_ray_part(r->nx_q14, r->step_px_q16);
    way.dy = drogue_ray_part(r->ny_q14, r->step_px_q16);
    return way;
}

static inline void step(ray_way *way)
{
    way->x += way->dx;
    way->y += way->dy;
}

void drogue_ray_read(int32_t *grey_q8_out, const drogue_ray *r, const drogue_image *image, drogue_q16 from_px_q16,
                     int32_t count)
{
    ray_way at = way_along(r, from_px_q16);
    const drogue_image own = *image; /* which what is written cannot alias */
    int32_t *const end = grey_q8_out + count;
    if (within(&own, at.x, at.y) && within(&own, at.x + (count - 1) * at.dx, at.y + (count - 1) * at.dy)) {
        for (; grey_q8_out < end; grey_q8_out++, step(&at)) { /* bound: SAMPLES + 2 REACH, 73 */
            *grey_q8_out = between_q8(pixel(&own, at.x, at.y), 1, own.stride, at.x, at.y);
        }
    } else {
        for (; grey_q8_out < end; grey_q8_out++, step(&at)) { /* bound: the same */
            *grey_q8_out = inside_q8(&own, at.x, at.y, 0);
        }
    }
}

void drogue_ray_read_light(int32_t *light_q8, const drogue_ray *r, const drogue_image *image, drogue_q16 from_px_q16,
                           int32_t count)
{
    ray_way at = way_along(r, from_px_q16);
    int32_t i;
    for (i = 0; i < count; i++, step(&at)) { /* bound: as above */
        light_q8[i] = inside_q8(image, at.x, at.y, 1);
    }
}

void drogue_ray_add(int32_t *sum_q8, int32_t *value_q8, const drogue_ray *ray, const drogue_image *image,
                    drogue_transfer transfer, drogue_q16 from_px_q16, int32_t count, int32_t sign)
{
    int32_t i;
    drogue_ray_read_as(value_q8, ray, image, transfer, from_px_q16, count);
    for (i = 0; i < count; i++) { /* bound: as above */
        sum_q8[i] += sign * value_q8[i];
    }
}

/* A sum of five samples. A derivative of Gaussian of two samples is the difference of two of them, REACH apart: its
 * taps are -2, -3, -4, -3, 0, 3, 4, 3, 2. */
static inline int32_t sum_of(const int32_t grey[5])
{
    return 2 * (grey[0] + grey[4]) + 3 * (grey[1] + grey[3]) + 4 * grey[2];
}

static inline int is_peak(int32_t before, int32_t at, int32_t after, int32_t least_q8)
{
    return at >= least_q8 && at > before && at >= after;
}

/* Keep the peak of three slopes, 'steps' from the ellipse. */
static void keep_peak(drogue_ray *r, int32_t steps, int32_t before, int32_t at, int32_t after, int32_t level_q8)
{
    const int64_t part_q16 = drogue_vertex(before, at, after, HALF);
    drogue_ray_edge e;
    e.at_px_q16 = steps * r->step_px_q16 + (int32_t)drogue_shr_round_s64(part_q16 * r->step_px_q16, 16);
    e.slope_q8 = at;
    e.level_q8 = level_q8;
    keep(r, &e);
}

/* Slopes along a ray, 'out' samples to either side, and their peaks. */
static void find_edges(drogue_ray *r, const drogue_image *image, int32_t out, int32_t least_q8, int either)
{
    int32_t grey[SAMPLES + 2 * REACH];
    int32_t sum[SAMPLES + REACH];
    const int32_t sums = 2 * out + 1 + REACH;
    int32_t before;
    int32_t at;
    int32_t after;
    int32_t pass;
    int32_t i;
    drogue_ray_read(grey, r, image, -(out + REACH) * r->step_px_q16, sums + REACH);
    for (i = 0; i < sums; i++) {
        sum[i] = sum_of(&grey[i]);
    }
    r->count = 0;
    for (pass = 0; pass <= either; pass++) { /* bound: 2 */
        if (pass > 0) {                      /* what falls rises */
            for (i = 0; i < sums; i++) {
                sum[i] = -sum[i];
            }
        }
        at = sum[REACH] - sum[0];
        after = sum[REACH + 1] - sum[1];
        for (i = 1; i < 2 * out; i++) { /* bound: SAMPLES */
            before = at;
            at = after;
            after = sum[i + 1 + REACH] - sum[i + 1];
            if (is_peak(before, at, after, least_q8)) {
                keep_peak(r, i - out, before, at, after, grey[i + REACH]);
            }
        }
    }
}

/* A ray at an offset from the centre of an ellipse and along a normal, or with both reversed; sign is 1 or -1. */
static inline void place(drogue_ray *r, const drogue_ellipse *e, const int64_t at_px_q16[2],
                         const int64_t normal_q14[2], int32_t sign)
{
    r->x_px_q16 = drogue_clamp_2_30(e->xc_px_q16 + sign * at_px_q16[0]); /* beyond 2^14 px every image has ended */
    r->y_px_q16 = drogue_clamp_2_30(e->yc_px_q16 + sign * at_px_q16[1]);
    r->nx_q14 = sign * (int32_t)normal_q14[0];
    r->ny_q14 = sign * (int32_t)normal_q14[1];
    r->step_px_q16 = HALF;
    r->count = 0;
}

static inline int32_t scaled(drogue_q16 length_px_q16, int32_t by_q30)
{
    return (int32_t)drogue_shr_round_s64(drogue_product(length_px_q16, by_q30), 30);
}

/* A ray and the one across, of an ellipse whose axis has this sine and cosine. */
static inline void aim_at(drogue_ray rays[DROGUE_RAYS], const drogue_ellipse *e, int32_t phase, int32_t k,
                          int32_t sin_q30, int32_t cos_q30)
{
    const int64_t turn_q29 = 52707179; /* 2 pi / 64 */
    int32_t s_q30;
    int32_t c_q30;
    int32_t u; /* offset from the centre along the axes, px Q16, then the normal along them */
    int32_t v;
    int64_t at_px_q16[2];
    int64_t normal_q14[2];
    uint32_t length;
    int shift;
    int32_t inverse;
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shr_round_s64((8 * k + phase) * turn_q29, 3));
    u = scaled(e->a_px_q16, c_q30);
    v = scaled(e->b_px_q16, s_q30);
    drogue_rotate_q30(at_px_q16, u, v, cos_q30, sin_q30);
    u = scaled(e->b_px_q16, c_q30);
    v = scaled(e->a_px_q16, s_q30);
    length = drogue_isqrt_u64(drogue_square_sum(u, v)) | 1u; /* below 2^31 */
    shift = drogue_clz_u32(length) - 1;
    inverse = (int32_t)(drogue_reciprocal_u32(length << shift) >> 1);                 /* 2^61 over it */
    u = (int32_t)drogue_shr_round_s64(drogue_product(u * (1 << shift), inverse), 47); /* no longer than the length */
    v = (int32_t)drogue_shr_round_s64(drogue_product(v * (1 << shift), inverse), 47);
    drogue_rotate_q30(normal_q14, u, v, cos_q30, sin_q30);
    place(&rays[k], e, at_px_q16, normal_q14, 1);
    place(&rays[k + DROGUE_RAYS / 2], e, at_px_q16, normal_q14, -1);
}

/* Every so many-th ray from one on to before another, with the one across. */
static void aim(drogue_ray rays[DROGUE_RAYS], const drogue_ellipse *e, int32_t phase, int32_t from, int32_t to,
                int32_t every)
{
    int32_t sin_q30;
    int32_t cos_q30;
    int32_t k;
    drogue_sincos_of_q16(&sin_q30, &cos_q30, e->angle_rad_q16);
    for (k = from; k < to; k += every) { /* bound: 32 */
        aim_at(rays, e, phase, k, sin_q30, cos_q30);
    }
}

void drogue_rays_aim(drogue_ray rays[DROGUE_RAYS], const drogue_ellipse *e, int32_t phase, int32_t from, int32_t to)
{
    aim(rays, e, phase, from, to, 1);
}

/* What is looked for along each of the rays that are cast. */
typedef struct ray_search {
    drogue_q16 step_px_q16;
    int32_t least_q8;
    int32_t out; /* steps to either side */
    int either;  /* what falls as well */
} ray_search;

static inline ray_search search_of(drogue_q16 reach_px_q16, int32_t least, drogue_ray_look look)
{
    const drogue_q16 reach = drogue_clamp_s32(reach_px_q16, NEAREST, FARTHEST);
    const drogue_q16 least_step = reach / (SAMPLES / 2);
    const drogue_q16 finest = look >= DROGUE_RAY_FINE_RISES ? QUARTER : HALF;
    const drogue_q16 step = finest < least_step ? least_step : finest;
    ray_search s;
    s.step_px_q16 = step;
    s.least_q8 = least * DROGUE_RAY_WEIGHT * ((step < HALF ? step : HALF) >> 8); /* blur may leave half */
    s.out = drogue_clamp_s32(reach / step + 1, 1, SAMPLES / 2);
    s.either = look == DROGUE_RAY_STEPS || look == DROGUE_RAY_LINES;
    return s;
}

void drogue_rays_cast(drogue_ray rays[DROGUE_RAYS], const drogue_image *image, const drogue_ellipse *e,
                      drogue_q16 reach_px_q16, int32_t phase, int32_t every, int32_t least, drogue_ray_look look)
{
    const ray_search s = search_of(reach_px_q16, least, look);
    int32_t k;
    aim(rays, e, phase, 0, DROGUE_RAYS / 2, every);
    for (k = 0; k < DROGUE_RAYS; k++) {
        rays[k].count = 0;
        if (k % every == 0) {
            rays[k].step_px_q16 = s.step_px_q16;
            find_edges(&rays[k], image, s.out, s.least_q8, s.either);
        }
    }
}
