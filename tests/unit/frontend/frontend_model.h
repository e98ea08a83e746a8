/* SPDX-License-Identifier: Apache-2.0 */
/* The front end in two passes over a stored image, with flood fill: the model of its one pass. */
#ifndef DROGUE_TESTS_FRONTEND_MODEL_H
#define DROGUE_TESTS_FRONTEND_MODEL_H

#include "suite.h"

#include "drogue/frontend.h"

/* Verdict of suppression and thresholds. */
enum { VERDICT_NONE = 0, VERDICT_WEAK = 1, VERDICT_STRONG = 2 };

/* What two passes over a stored image give. */
typedef struct model {
    int32_t width, height;
    uint8_t *verdict;    /* of suppression, thresholds and ring, a pixel */
    uint8_t *alive;      /* connected to a strong candidate */
    uint8_t *key;        /* direction class + 1 of candidates, else 0 */
    uint32_t *arc;       /* component of equal key, 1 ... in raster order of the first pixel */
    drogue_edge *edge;   /* by pixel */
    uint32_t arcs;       /* components that are alive or not */
    uint32_t candidates; /* points with a key */
    drogue_edge *list;   /* as documented */
    uint32_t *list_arc;  /* arc of each listed point, or DROGUE_NO_ARC */
    uint32_t listed, long_arcs;
} model;

static inline void *pixels_of(const model *m, size_t each)
{
    return calloc((size_t)m->width * (size_t)m->height + 1u, each);
}

/* Flood fill from 'start' over equal nonzero codes; sets mark to 'value'. Returns the number of pixels. */
static inline uint32_t flood(const model *m, const uint8_t *code, uint32_t *mark, int32_t start, uint32_t value)
{
    int32_t *stack = malloc((size_t)m->width * (size_t)m->height * sizeof *stack), top = 0, k;
    uint32_t count = 0;
    mark[start] = value;
    stack[top++] = start;
    while (top > 0) {
        int32_t at = stack[--top];
        count++;
        for (k = 0; k < 9; k++) {
            int32_t x = at % m->width + k % 3 - 1, y = at / m->width + k / 3 - 1, to = y * m->width + x;
            if (x >= 0 && x < m->width && y >= 0 && y < m->height && mark[to] == 0 && code[to] == code[at]) {
                mark[to] = value;
                stack[top++] = to;
            }
        }
    }
    free(stack);
    return count;
}

static inline void model_verdicts(model *m, const uint8_t *pixels, const drogue_frontend_config *config)
{
    drogue_image image = {pixels, m->width, m->height, m->width};
    uint8_t *smooth = pixels_of(m, 1), *zero = pixels_of(m, 2);
    uint16_t *column = pixels_of(m, 2), *magnitude = pixels_of(m, 2);
    int16_t *gx = pixels_of(m, 2), *gy = pixels_of(m, 2);
    int32_t x, y;
    if (config->smooth) {
        ck_assert_int_eq(drogue_smooth_image(smooth, column, &image), DROGUE_OK);
        image.data = smooth;
    }
    ck_assert_int_eq(drogue_gradient_image(gx, gy, magnitude, &image), DROGUE_OK);
    for (y = 0; y < m->height; y++) {
        const uint16_t *rows[3];
        rows[0] = y > 0 ? magnitude + (y - 1) * m->width : (const uint16_t *)(const void *)zero;
        rows[1] = magnitude + y * m->width;
        rows[2] = y + 1 < m->height ? magnitude + (y + 1) * m->width : (const uint16_t *)(const void *)zero;
        for (x = 0; x < m->width; x++) {
            int32_t at = y * m->width + x, before, after, offset;
            drogue_sector sector = drogue_canny_sector(gx[at], gy[at]);
            drogue_canny_neighbours(&before, &after, sector, rows, x, m->width);
            if (rows[1][x] > config->canny_low && drogue_canny_is_maximum(sector, before, rows[1][x], after) &&
                (!config->use_ring || drogue_mask_in_ring(&config->ring, x, y))) {
                m->verdict[at] = rows[1][x] > config->canny_high ? VERDICT_STRONG : VERDICT_WEAK;
            }
            offset = drogue_canny_offset_q5(before, rows[1][x], after);
            m->edge[at].gx = gx[at];
            m->edge[at].gy = gy[at];
            if (m->verdict[at] != VERDICT_NONE) {
                m->edge[at].x_q5 = (uint16_t)(32 * x + drogue_canny_step_x(sector) * offset);
                m->edge[at].y_q5 = (uint16_t)(32 * y + drogue_canny_step_y(sector) * offset);
                m->key[at] = (uint8_t)(1u + drogue_direction_class(gx[at], gy[at]));
                m->candidates++;
            }
        }
    }
    free(smooth);
    free(zero);
    free(column);
    free(magnitude);
    free(gx);
    free(gy);
}

static inline void append_arc(model *m, uint32_t arc, uint32_t index)
{
    int32_t i;
    for (i = 0; i < m->width * m->height; i++) {
        if (m->arc[i] == arc && m->alive[i]) {
            m->list_arc[m->listed] = index;
            m->list[m->listed++] = m->edge[i];
        }
    }
}

static inline model model_of(const uint8_t *pixels, int32_t width, int32_t height, const drogue_frontend_config *config)
{
    model m;
    uint32_t *mark, *length, components = 0, k;
    uint8_t *candidate, *strong;
    int32_t i;
    memset(&m, 0, sizeof m);
    m.width = width;
    m.height = height;
    m.verdict = pixels_of(&m, 1);
    m.alive = pixels_of(&m, 1);
    m.key = pixels_of(&m, 1);
    m.arc = pixels_of(&m, sizeof(uint32_t));
    m.edge = pixels_of(&m, sizeof(drogue_edge));
    m.list = pixels_of(&m, sizeof(drogue_edge));
    m.list_arc = pixels_of(&m, sizeof(uint32_t));
    candidate = pixels_of(&m, 1);
    strong = pixels_of(&m, 1);
    mark = pixels_of(&m, sizeof *mark);
    length = pixels_of(&m, sizeof *length);
    model_verdicts(&m, pixels, config);
    for (i = 0; i < width * height; i++) {
        candidate[i] = m.verdict[i] != VERDICT_NONE;
    }
    for (i = 0; i < width * height; i++) {
        if (candidate[i] && mark[i] == 0) {
            flood(&m, candidate, mark, i, ++components);
        }
        if (m.key[i] != 0 && m.arc[i] == 0) {
            m.arcs++;
            length[m.arcs - 1u] = flood(&m, m.key, m.arc, i, m.arcs);
        }
    }
    for (i = 0; i < width * height; i++) {
        strong[mark[i]] |= m.verdict[i] == VERDICT_STRONG; /* components are fewer than pixels */
    }
    for (i = 0; i < width * height; i++) {
        m.alive[i] = candidate[i] && strong[mark[i]];
    }
    for (k = 1; k <= m.arcs; k++) {
        uint32_t before = m.listed;
        if (length[k - 1u] >= config->min_arc_px) {
            append_arc(&m, k, m.long_arcs);
        }
        m.long_arcs += m.listed > before;
    }
    for (i = 0; i < width * height; i++) { /* the rest */
        if (m.arc[i] != 0 && m.alive[i] && length[m.arc[i] - 1u] < config->min_arc_px) {
            m.list_arc[m.listed] = DROGUE_NO_ARC;
            m.list[m.listed++] = m.edge[i];
        }
    }
    free(candidate);
    free(strong);
    free(mark);
    free(length);
    return m;
}

static inline void model_free(model *m)
{
    free(m->verdict);
    free(m->alive);
    free(m->key);
    free(m->arc);
    free(m->edge);
    free(m->list);
    free(m->list_arc);
}

#endif
