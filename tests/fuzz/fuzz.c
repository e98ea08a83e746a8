/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers and scenes from bytes, and the properties of a result. */
#include "fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "thresholds.h"

#if defined(__has_feature)
#if __has_feature(memory_sanitizer)
#include <sanitizer/msan_interface.h>
#define FORGET(memory, bytes) __msan_allocated_memory(memory, bytes) /* as if it had never been written */
#endif
#endif
#ifndef FORGET
#define FORGET(memory, bytes) ((void)0)
#endif

void fuzz_fail(const char *what, int line)
{
    printf("fuzz: line %d: %s\n", line, what);
    fflush(stdout);
    abort();
}

void *fuzz_alloc(size_t bytes)
{
    void *p = malloc(bytes > 0 ? bytes : 1);
    FUZZ_MUST(p != NULL);
    return p;
}

uint8_t fuzz_byte(fuzz_bytes *b)
{
    if (b->left == 0) {
        return 0;
    }
    b->left--;
    return *b->at++;
}

int32_t fuzz_any(fuzz_bytes *b)
{
    const uint8_t how = fuzz_byte(b);
    uint32_t v = 0;
    int k;
    if (how < 8) {
        static const int32_t edges[8] = {INT32_MIN, INT32_MAX, 0, -1, 1, INT32_MIN + 5000, 65536, -65536};
        return edges[how];
    }
    for (k = 0; k < 1 + how % 4; k++) {
        v = v << 8 | fuzz_byte(b);
    }
    return (int32_t)(how & 16 ? v : ~v);
}

int32_t fuzz_range(fuzz_bytes *b, int32_t low, int32_t high)
{
    const uint32_t span = (uint32_t)high - (uint32_t)low;
    uint32_t v = fuzz_byte(b);
    if (span > 255) {
        v = v << 8 | fuzz_byte(b);
    }
    if (span > 65535) {
        v = v << 16 | (uint32_t)fuzz_byte(b) << 8 | fuzz_byte(b);
    }
    return (int32_t)((uint32_t)low + (span == UINT32_MAX ? v : v % (span + 1)));
}

static int within(int32_t x, int32_t y, int32_t cx, int32_t cy, int32_t a, int32_t b)
{
    const int64_t u = (int64_t)(x - cx) * b, v = (int64_t)(y - cy) * a;
    return u * u + v * v < (int64_t)a * a * b * b;
}

void fuzz_scene_draw(fuzz_scene *s, fuzz_bytes *b)
{
    const int32_t w = s->image.width_px, h = s->image.height_px, noise = fuzz_range(b, 0, 40);
    const int32_t cx = fuzz_range(b, 0, w), cy = fuzz_range(b, 0, h), rx = fuzz_range(b, 3, 60);
    const int32_t ry = rx - rx * fuzz_range(b, 0, 150) / 255, ground = fuzz_byte(b), canopy = fuzz_byte(b),
                  dark = fuzz_byte(b);
    const int32_t ix = cx + fuzz_range(b, -4, 4), iy = cy + fuzz_range(b, -4, 4),
                  ir = 1 + rx * fuzz_range(b, 40, 180) / 256;
    uint32_t seed = (uint32_t)fuzz_range(b, 1, 65535);
    int32_t x, y;
    s->radius_px = rx;
    for (y = 0; y < h; y++) {
        for (x = 0; x < w; x++) {
            int32_t v = within(x, y, ix, iy, ir, ir)                ? dark
                        : within(x, y, cx, cy, rx, ry > 0 ? ry : 1) ? canopy
                                                                    : ground;
            seed = seed * 1664525u + 1013904223u;
            v += noise > 0 ? (int32_t)(seed >> 16) % (2 * noise + 1) - noise : 0;
            s->pixels[(size_t)y * (size_t)s->image.stride + (size_t)x] = (uint8_t)(v < 0 ? 0 : v > 255 ? 255 : v);
        }
    }
    s->region.x_px = cx - rx * 5 / 4;
    s->region.y_px = cy - rx * 5 / 4;
    s->region.width_px = s->region.height_px = rx * 5 / 2;
    if (fuzz_byte(b) % 4 == 0) {
        s->region.x_px += fuzz_range(b, -rx, rx);
        s->region.y_px += fuzz_range(b, -rx, rx);
    }
    if (fuzz_byte(b) % 8 == 7) {
        s->region.x_px = fuzz_any(b);
        s->region.y_px = fuzz_any(b);
        s->region.width_px = fuzz_any(b);
        s->region.height_px = fuzz_any(b);
    }
}

static int32_t *threshold_of(drogue_config *c, int which)
{
    return (int32_t *)(void *)((char *)c + thresholds[which].offset);
}

static void put_in_order(int32_t *least, int32_t *most)
{
    if (*least > *most) {
        const int32_t other = *least;
        *least = *most;
        *most = other;
    }
}

/* Some of the program's table of thresholds anywhere within their ranges; once in a while one beyond, which is refused. */
static void change_config(drogue_config *c, fuzz_bytes *b)
{
    int k;
    drogue_config_default(c);
    if (fuzz_byte(b) % 3 == 0) {
        return;
    }
    for (k = 0; k < threshold_count; k++) {
        const uint8_t how = fuzz_byte(b);
        const threshold *t = &thresholds[k];
        if (how % 4 == 3) {
            *threshold_of(c, k) = fuzz_range(b, t->least, t->most);
        } else if (how % 8 == 6) { /* near the default */
            const int64_t value = (int64_t)*threshold_of(c, k) * fuzz_range(b, 0, 255) / 64;
            *threshold_of(c, k) = (int32_t)(value < t->least ? t->least : value > t->most ? t->most : value);
        }
    }
    put_in_order(&c->canny_low, &c->canny_high);
    c->canny_least = c->canny_least < c->canny_high ? c->canny_least : c->canny_high;
    put_in_order(&c->min_size_q16, &c->max_size_q16);
    FUZZ_MUST(drogue_config_valid(c));
    if (fuzz_byte(b) % 16 == 15) {
        *threshold_of(c, fuzz_byte(b) % threshold_count) = fuzz_any(b);
    }
}

void fuzz_scene_make(fuzz_scene *s, fuzz_bytes *b, int32_t most_px)
{
    int32_t *const camera[9] = {&s->camera.fx_px_q16, &s->camera.fy_px_q16, &s->camera.cx_px_q16,
                                &s->camera.cy_px_q16, &s->camera.k1_q16,    &s->camera.k2_q16,
                                &s->camera.p1_q16,    &s->camera.p2_q16,    &s->camera.k3_q16};
    const uint8_t hostile = fuzz_byte(b);
    int k;
    memset(s, 0, sizeof *s);
    s->image.width_px = fuzz_range(b, 1, most_px);
    s->image.height_px = fuzz_range(b, 1, most_px);
    s->image.stride = s->image.width_px + fuzz_range(b, 0, 3);
    s->pixels = fuzz_alloc((size_t)s->image.stride * (size_t)(s->image.height_px - 1) + (size_t)s->image.width_px);
    s->image.data = s->pixels;
    s->camera.fx_px_q16 = s->camera.fy_px_q16 = 65536 * fuzz_range(b, 50, 2000);
    s->camera.cx_px_q16 = s->image.width_px * 32768;
    s->camera.cy_px_q16 = s->image.height_px * 32768;
    s->model.rim_radius_m_q16 = 22938;
    s->model.inner_radius_m_q16 = hostile & 1 ? 13107 : 0;
    s->model.inner_depth_m_q16 = 16384;
    for (k = 0; k < 9 && hostile & 2; k++) {
        *camera[k] = k > 3 || hostile & 4 ? fuzz_any(b) >> (hostile & 4 ? (k > 3 ? 7 : 0) : 14) : *camera[k];
    }
    if (hostile & 8) {
        s->model.rim_radius_m_q16 = fuzz_any(b);
        s->model.inner_radius_m_q16 = fuzz_any(b);
        s->model.inner_depth_m_q16 = fuzz_any(b);
        if (hostile & 16) { /* within their ranges; else most are refused */
            s->model.rim_radius_m_q16 &= INT32_MAX;
            s->model.inner_radius_m_q16 = s->model.rim_radius_m_q16 >> (s->model.inner_radius_m_q16 & 15);
            s->model.inner_depth_m_q16 &= INT32_MAX;
        }
    }
    change_config(&s->config, b);
    s->setup.camera = &s->camera;
    s->setup.model = &s->model;
    s->setup.config = &s->config;
    memset(s->pixels, 0, (size_t)s->image.stride * (size_t)(s->image.height_px - 1) + (size_t)s->image.width_px);
    fuzz_scene_draw(s, b);
}

void fuzz_scene_free(fuzz_scene *s) { free(s->pixels); }

drogue_capacity fuzz_capacity(fuzz_bytes *b, int32_t width_px)
{
    drogue_capacity c;
    c.width_px = (uint32_t)fuzz_range(b, 1, 2 * width_px);
    c.edges = (uint32_t)fuzz_range(b, 1, 6000);
    c.labels = (uint32_t)fuzz_range(b, 2, 6000);
    c.arcs = (uint32_t)fuzz_range(b, 1, 200);
    return c;
}

fuzz_workspace fuzz_workspace_make(const drogue_capacity *capacity, uint8_t fill)
{
    const size_t bytes = drogue_workspace_bytes(capacity);
    fuzz_workspace w;
    w.memory = fuzz_alloc(bytes);
    memset(w.memory, fill, bytes);
    FORGET(w.memory, bytes);
    memset(&w.workspace, fill, sizeof w.workspace);
    FUZZ_MUST(drogue_workspace_init(&w.workspace, w.memory, bytes, capacity) == DROGUE_OK);
    return w;
}

int fuzz_short_of_room(const drogue_result *r)
{
    return r->status == DROGUE_E_WORKSPACE || r->status == DROGUE_E_LABELS_FULL || r->status == DROGUE_E_EDGES_FULL ||
           r->status == DROGUE_E_ARCS_FULL || r->second_look >= DROGUE_SECOND_TOO_WIDE;
}

static void check_pose(const drogue_pose *p)
{
    double length = 0;
    int k;
    for (k = 0; k < 3; k++) {
        length += p->axis_q16[k] / 65536.0 * (p->axis_q16[k] / 65536.0);
    }
    FUZZ_MUST(fabs(sqrt(length) - 1) <= 1e-3);
    FUZZ_MUST(p->position_m_q16[2] > 0);
}

void fuzz_check_result(const drogue_result *r, const drogue_region *asked, const drogue_image *image)
{
    int i, j;
    (void)asked;
    FUZZ_MUST((int)r->status >= 0 && r->status < DROGUE_STATUS_COUNT);
    FUZZ_MUST((int)r->second_look >= 0 && r->second_look < DROGUE_SECOND_COUNT);
    FUZZ_MUST(r->quality.reliability_q16 >= 0 && r->quality.reliability_q16 <= 65536);
    FUZZ_MUST(r->ambiguity_q16 >= 0 && r->ambiguity_q16 <= 65536);
    FUZZ_MUST(r->doubt_q16 >= 0 && r->doubt_q16 < 65536);
    FUZZ_MUST(r->cover_q16 >= 0 && r->cover_q16 <= 65536);
    if (r->status != DROGUE_OK) {
        return;
    }
    FUZZ_MUST(r->region.x_px >= 0 && r->region.y_px >= 0 && r->region.width_px >= 1 && r->region.height_px >= 1);
    FUZZ_MUST(r->region.x_px + r->region.width_px <= image->width_px);
    FUZZ_MUST(r->region.y_px + r->region.height_px <= image->height_px);
    check_pose(&r->pose);
    FUZZ_MUST(r->covariance_halved >= 0 && r->covariance_halved < 48);
    for (i = 0; i < 3; i++) { /* within the covariance's last bit and the standard deviation's own */
        const double variance = ldexp((double)r->covariance_q48[i][i], r->covariance_halved - 48);
        const double std = (double)r->position_std_m_q32[i] / 0x1p32;
        FUZZ_MUST(fabs(sqrt(variance) - std) <= 1e-6 * std + ldexp(1, r->covariance_halved / 2 - 23));
    }
    for (i = 0; i < 5; i++) {
        FUZZ_MUST(r->covariance_q48[i][i] >= 0);
        for (j = 0; j < i; j++) {
            const double c = (double)r->covariance_q48[i][j];
            const double scale = sqrt((double)r->covariance_q48[i][i]) * sqrt((double)r->covariance_q48[j][j]);
            FUZZ_MUST(r->covariance_q48[i][j] == r->covariance_q48[j][i]);
            FUZZ_MUST(fabs(c) <= scale * (1 + 1e-6) + 4);
        }
    }
}
