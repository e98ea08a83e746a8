/* SPDX-License-Identifier: Apache-2.0 */
/* Grey levels along rays of the frame memory, and the edges on them, by the unit beside the soft core, in the place of the
 * library's src/outline/rays.c; that one reads what lies elsewhere. */
#define drogue_ray_read ray_read_by_core
#define drogue_rays_cast rays_cast_by_core
#define drogue_ray_add ray_add_by_core
#include "drogue/rays.h"

#include "unit.h"

/* Called from two places: one of it, for size. */
static void keep_peak(drogue_ray *, int32_t, int32_t, int32_t, int32_t, int32_t) __attribute__((noinline));

/* Seldom: for size. */
void drogue_ray_read_light(int32_t *, const drogue_ray *, const drogue_image *, drogue_q16, int32_t)
    __attribute__((cold));
static void find_edges(drogue_ray *, const drogue_image *, int32_t, int32_t, int) __attribute__((cold));
void drogue_ray_read(int32_t *, const drogue_ray *, const drogue_image *, drogue_q16, int32_t) __attribute__((cold));
void drogue_rays_cast(drogue_ray *, const drogue_image *, const drogue_ellipse *, drogue_q16, int32_t, int32_t, int32_t,
                      drogue_ray_look) __attribute__((cold));
void drogue_ray_add(int32_t *, int32_t *, const drogue_ray *, const drogue_image *, drogue_transfer, drogue_q16,
                    int32_t, int32_t) __attribute__((cold));

/* Sines and cosines of rays in the phases that most are cast in, 2, 4 and 6, are worked out once. */
static void sincos_of_ray(int32_t *sin_q30, int32_t *cos_q30, int32_t angle_rad_q29, int32_t phase, int32_t k)
{
    static int32_t known_q30[3][DROGUE_RAYS / 2][2]; /* of a half turn */
    int32_t *known;
    if ((phase & 1) != 0 || phase == 0) {
        drogue_sincos_q30(sin_q30, cos_q30, angle_rad_q29);
        return;
    }
    known = known_q30[((uint32_t)phase >> 1) - 1][k]; /* no division, which -Os would make of another */
    if (known[0] == 0) {                              /* not yet: none of those rays lies along the axis */
        drogue_sincos_q30(&known[0], &known[1], angle_rad_q29);
    }
    *sin_q30 = known[0];
    *cos_q30 = known[1];
}

/* By the unit where they are called. */
static inline uint32_t root_of(uint64_t v)
{
    uint32_t root;
    UNIT(root, UNIT_ROOT, 0, (uint32_t)v, (uint32_t)(v >> 32));
    return root;
}

static inline int zeros_of(uint32_t v)
{
    int zeros;
    UNIT(zeros, UNIT_ZEROS, 0, v, 0);
    return zeros;
}

#define drogue_isqrt_u64 root_of
#define drogue_clz_u32 zeros_of
#define drogue_sincos_q30(sin_q30, cos_q30, angle_rad_q29) sincos_of_ray(sin_q30, cos_q30, angle_rad_q29, phase, k)
#include "../../src/outline/rays.c"
#undef drogue_sincos_q30
#undef drogue_isqrt_u64
#undef drogue_clz_u32
#undef drogue_ray_read
#undef drogue_rays_cast
#undef drogue_ray_add

#include "machine.h"
#include "ray_unit.h"

static inline uint32_t first_of(const drogue_image *image) { return (uint32_t)(image->data - FRAME); }

/* 'what' it begins for is a part of the instruction. */
#define BEGIN(what, r, image, from_px_q16)                                                   \
    do {                                                                                     \
        const drogue_q16 from = (from_px_q16);                                               \
        uint32_t none;                                                                       \
        UNIT(none, UNIT_RAY_IMAGE, 0, first_of(image), (image)->stride);                     \
        UNIT(none, UNIT_RAY_SIZE, 0, (image)->width_px, (image)->height_px);                 \
        UNIT(none, UNIT_RAY_STEP, 0, drogue_ray_part((r)->nx_q14, (r)->step_px_q16),         \
             drogue_ray_part((r)->ny_q14, (r)->step_px_q16));                                \
        UNIT(none, UNIT_RAY_BEGIN, what, (r)->x_px_q16 + drogue_ray_part((r)->nx_q14, from), \
             (r)->y_px_q16 + drogue_ray_part((r)->ny_q14, from));                            \
        (void)none;                                                                          \
    } while (0)

void drogue_ray_read(int32_t *grey_q8_out, const drogue_ray *r, const drogue_image *image, drogue_q16 from_px_q16,
                     int32_t count)
{
    int32_t *const end = grey_q8_out + count;
    if (first_of(image) >= FRAME_BYTES) {
        ray_read_by_core(grey_q8_out, r, image, from_px_q16, count);
        return;
    }
    BEGIN(RAY_GREY, r, image, from_px_q16);
    for (; end - grey_q8_out >= 4; grey_q8_out += 4) {
        int32_t grey_q8[4];
        UNIT(grey_q8[0], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[1], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[2], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[3], UNIT_RAY_GREY, 0, 0, 0);
        grey_q8_out[0] = grey_q8[0];
        grey_q8_out[1] = grey_q8[1];
        grey_q8_out[2] = grey_q8[2];
        grey_q8_out[3] = grey_q8[3];
    }
    for (; grey_q8_out < end; grey_q8_out++) {
        UNIT(*grey_q8_out, UNIT_RAY_GREY, 0, 0, 0);
    }
}

/* A sample, and what it makes of a sum: 'sign' is 0 or -1. */
#define ADD(i) sum_q8[i] += ((value_q8[i] = grey_q8[i]) ^ sign) - sign

void drogue_ray_add(int32_t *sum_q8, int32_t *value_q8, const drogue_ray *r, const drogue_image *image,
                    drogue_transfer transfer, drogue_q16 from_px_q16, int32_t count, int32_t times)
{
    int32_t *const end = sum_q8 + count;
    const int32_t sign = times >> 31;
    int32_t grey_q8[5];
    if (transfer == DROGUE_TRANSFER_SRGB || first_of(image) >= FRAME_BYTES) {
        ray_add_by_core(sum_q8, value_q8, r, image, transfer, from_px_q16, count, times);
        return;
    }
    BEGIN(RAY_GREY, r, image, from_px_q16);
    for (; end - sum_q8 >= 5; sum_q8 += 5, value_q8 += 5) {
        UNIT(grey_q8[0], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[1], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[2], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[3], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8[4], UNIT_RAY_GREY, 0, 0, 0);
        ADD(0);
        ADD(1);
        ADD(2);
        ADD(3);
        ADD(4);
    }
    for (; sum_q8 < end; sum_q8++, value_q8++) {
        UNIT(grey_q8[0], UNIT_RAY_GREY, 0, 0, 0);
        ADD(0);
    }
}

typedef struct ray_peak {
    int32_t at;
    int32_t before_q8;
    int32_t slope_q8;
    int32_t after_q8;
    int32_t level_q8;
} ray_peak;

/* The peaks along a ray: what rises, and what falls, which is kept after it. No two slopes beside one another are peaks of a kind. */
typedef struct ray_peaks {
    ray_peak peak[2][SAMPLES / 2];
    uint32_t count[2];
} ray_peaks;

static inline void begin_search(const drogue_ray *r, const drogue_image *image, const ray_search *s)
{
    if (s->either) {
        BEGIN(RAY_SEEK | RAY_EITHER, r, image, -(s->out + REACH) * r->step_px_q16);
    } else {
        BEGIN(RAY_SEEK, r, image, -(s->out + REACH) * r->step_px_q16);
    }
}

static inline void take_peaks(ray_peaks *p)
{
    p->count[0] = 0;
    p->count[1] = 0;
    for (;;) {
        int32_t at;
        ray_peak *peak;
        UNIT(at, UNIT_RAY_PEAK, RAY_PEAK_AT, 0, 0);
        if (at < 0) {
            return;
        }
        peak = &p->peak[at >= RAY_PEAK_FALLS][p->count[at >= RAY_PEAK_FALLS]++];
        peak->at = at & (RAY_PEAK_FALLS - 1);
        UNIT(peak->before_q8, UNIT_RAY_PEAK, RAY_PEAK_BEFORE, 0, 0);
        UNIT(peak->slope_q8, UNIT_RAY_PEAK, RAY_PEAK_SLOPE, 0, 0);
        UNIT(peak->after_q8, UNIT_RAY_PEAK, RAY_PEAK_AFTER, 0, 0);
        UNIT(peak->level_q8, UNIT_RAY_PEAK, RAY_PEAK_LEVEL, 0, 0);
    }
}

static inline void keep_peaks(drogue_ray *r, const ray_peaks *p, int32_t out)
{
    const ray_peak *k;
    for (k = p->peak[0]; k < p->peak[0] + p->count[0]; k++) {
        keep_peak(r, k->at - out, k->before_q8, k->slope_q8, k->after_q8, k->level_q8);
    }
    for (k = p->peak[1]; k < p->peak[1] + p->count[1]; k++) {
        keep_peak(r, k->at - out, -k->before_q8, -k->slope_q8, -k->after_q8, k->level_q8);
    }
}

/* While the unit looks along a ray, the edges of the one before are kept and the next ones are placed. */
void drogue_rays_cast(drogue_ray rays[DROGUE_RAYS], const drogue_image *image, const drogue_ellipse *e,
                      drogue_q16 reach_px_q16, int32_t phase, int32_t every, int32_t least, drogue_ray_look look)
{
    const ray_search s = search_of(reach_px_q16, least, look);
    int32_t sin_q30;
    int32_t cos_q30;
    drogue_ray *before = NULL; /* whose peaks are known */
    ray_peaks peaks;
    uint32_t none;
    int32_t k;
    int32_t across;
    if (first_of(image) >= FRAME_BYTES) {
        rays_cast_by_core(rays, image, e, reach_px_q16, phase, every, least, look);
        return;
    }
    UNIT(none, UNIT_RAY_LEAST, 0, s.least_q8, 2 * (s.out + REACH) + 1);
    (void)none;
    for (k = 1; k < DROGUE_RAYS && every > 1; k += 2) {
        rays[k].count = 0;
    }
    drogue_sincos_of_q16(&sin_q30, &cos_q30, e->angle_rad_q16);
    aim_at(rays, e, phase, 0, sin_q30, cos_q30);
    for (k = 0; k < DROGUE_RAYS / 2; k += every) {
        for (across = 0; across < 2; across++) {
            drogue_ray *const r = &rays[k + across * (DROGUE_RAYS / 2)];
            r->step_px_q16 = s.step_px_q16;
            begin_search(r, image, &s);
            if (before != NULL) {
                keep_peaks(before, &peaks, s.out);
            }
            if (across > 0 && k + every < DROGUE_RAYS / 2) {
                aim_at(rays, e, phase, k + every, sin_q30, cos_q30);
            }
            take_peaks(&peaks);
            before = r;
        }
    }
    keep_peaks(before, &peaks, s.out);
}
