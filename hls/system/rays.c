/* SPDX-License-Identifier: Apache-2.0 */
/* Grey levels along rays of the frame memory, and the edges on them, by the unit beside the soft core, in the place of the
 * library's src/outline/rays.c; that one reads what lies elsewhere. */
#define drogue_ray_read ray_read_by_core
#define drogue_rays_cast rays_cast_by_core
#include "drogue/rays.h"

/* Called from two places: one of it, for size. */
static void keep_peak(drogue_ray *, int32_t, int32_t, int32_t, int32_t, int32_t) __attribute__((noinline));

/* Seldom: for size. */
void drogue_ray_read_light(int32_t *, const drogue_ray *, const drogue_image *, drogue_q16, int32_t)
    __attribute__((cold));
static void find_edges(drogue_ray *, const drogue_image *, int32_t, int32_t, int) __attribute__((cold));
void drogue_ray_read(int32_t *, const drogue_ray *, const drogue_image *, drogue_q16, int32_t) __attribute__((cold));
void drogue_rays_cast(drogue_ray *, const drogue_image *, const drogue_ellipse *, drogue_q16, int32_t, int32_t, int32_t,
                      drogue_ray_look) __attribute__((cold));

#include "../../src/outline/rays.c"
#undef drogue_ray_read
#undef drogue_rays_cast

#include "machine.h"
#include "ray_unit.h"
#include "unit.h"

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
        UNIT(grey_q8_out[0], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8_out[1], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8_out[2], UNIT_RAY_GREY, 0, 0, 0);
        UNIT(grey_q8_out[3], UNIT_RAY_GREY, 0, 0, 0);
    }
    for (; grey_q8_out < end; grey_q8_out++) {
        UNIT(*grey_q8_out, UNIT_RAY_GREY, 0, 0, 0);
    }
}

typedef struct ray_peak {
    int32_t at;
    int32_t before_q8;
    int32_t slope_q8;
    int32_t after_q8;
    int32_t level_q8;
} ray_peak;

/* As find_edges(); what falls comes among what rises, and is kept after it. */
static void find_edges_by_unit(drogue_ray *r, const drogue_image *image, const ray_search *s)
{
    ray_peak falls[SAMPLES / 2]; /* no two slopes beside one another are peaks of a kind */
    uint32_t fall_count = 0;
    uint32_t none;
    uint32_t i;
    UNIT(none, UNIT_RAY_LEAST, 0, s->least_q8, 2 * (s->out + REACH) + 1);
    (void)none;
    if (s->either) {
        BEGIN(RAY_SEEK | RAY_EITHER, r, image, -(s->out + REACH) * r->step_px_q16);
    } else {
        BEGIN(RAY_SEEK, r, image, -(s->out + REACH) * r->step_px_q16);
    }
    r->count = 0;
    for (;;) {
        ray_peak p;
        UNIT(p.at, UNIT_RAY_PEAK, RAY_PEAK_AT, 0, 0);
        if (p.at < 0) {
            break;
        }
        UNIT(p.before_q8, UNIT_RAY_PEAK, RAY_PEAK_BEFORE, 0, 0);
        UNIT(p.slope_q8, UNIT_RAY_PEAK, RAY_PEAK_SLOPE, 0, 0);
        UNIT(p.after_q8, UNIT_RAY_PEAK, RAY_PEAK_AFTER, 0, 0);
        UNIT(p.level_q8, UNIT_RAY_PEAK, RAY_PEAK_LEVEL, 0, 0);
        if (p.at < RAY_PEAK_FALLS) {
            keep_peak(r, p.at - s->out, p.before_q8, p.slope_q8, p.after_q8, p.level_q8);
        } else {
            falls[fall_count++] = p;
        }
    }
    for (i = 0; i < fall_count; i++) {
        const ray_peak *p = &falls[i];
        keep_peak(r, p->at - RAY_PEAK_FALLS - s->out, -p->before_q8, -p->slope_q8, -p->after_q8, p->level_q8);
    }
}

void drogue_rays_cast(drogue_ray rays[DROGUE_RAYS], const drogue_image *image, const drogue_ellipse *e,
                      drogue_q16 reach_px_q16, int32_t phase, int32_t every, int32_t least, drogue_ray_look look)
{
    const ray_search s = search_of(reach_px_q16, least, look);
    int32_t k;
    if (first_of(image) >= FRAME_BYTES) {
        rays_cast_by_core(rays, image, e, reach_px_q16, phase, every, least, look);
        return;
    }
    aim(rays, e, phase, 0, DROGUE_RAYS / 2, every);
    for (k = 0; k < DROGUE_RAYS; k++) {
        rays[k].count = 0;
        if (k % every == 0) {
            rays[k].step_px_q16 = s.step_px_q16;
            find_edges_by_unit(&rays[k], image, &s);
        }
    }
}
