/* SPDX-License-Identifier: Apache-2.0 */
/* Smallest bounding rectangle by trying the direction of every hull edge; C99 and C++17. */
#ifndef DROGUE_TESTS_RECTANGLE_H
#define DROGUE_TESTS_RECTANGLE_H

#include "common.h"

#include "drogue/constraints.h"

static inline int raster_order(const void *p, const void *q)
{
    const drogue_edge *e = (const drogue_edge *)p, *f = (const drogue_edge *)q;
    int32_t d = drogue_edge_y_px(e) - drogue_edge_y_px(f);
    return d != 0 ? d : drogue_edge_x_px(e) - drogue_edge_x_px(f);
}

static inline uint32_t sort_unique(drogue_edge *e, uint32_t count)
{
    uint32_t i, left = 0;
    qsort(e, count, sizeof *e, raster_order);
    for (i = 0; i < count; i++) {
        if (left == 0 || raster_order(&e[left - 1], &e[i]) != 0) {
            e[left++] = e[i];
        }
    }
    return left;
}

/* Is (dx, dy) from i the direction of a hull edge? Extents of all points along and across it. */
static inline int hull_edge(int64_t low[2], int64_t high[2], const drogue_edge *e, uint32_t count, uint32_t i,
                            int64_t dx, int64_t dy)
{
    int64_t own = -dy * drogue_edge_x_px(&e[i]) + dx * drogue_edge_y_px(&e[i]);
    uint32_t k;
    low[0] = low[1] = INT64_MAX;
    high[0] = high[1] = INT64_MIN;
    for (k = 0; k < count; k++) {
        int64_t x = drogue_edge_x_px(&e[k]), y = drogue_edge_y_px(&e[k]);
        int64_t p[2];
        int d;
        p[0] = dx * x + dy * y;
        p[1] = -dy * x + dx * y;
        if (p[1] < own) {
            return 0;
        }
        for (d = 0; d < 2; d++) {
            low[d] = p[d] < low[d] ? p[d] : low[d];
            high[d] = p[d] > high[d] ? p[d] : high[d];
        }
    }
    return 1;
}

/* Largest difference, LSB, from the nearest of the rectangles that share the least area. */
static inline double rect_error(const drogue_min_rect *r, const drogue_edge *e, uint32_t count)
{
    long double best = -1;
    double error = HUGE_VAL;
    uint32_t i, j;
    for (i = 0; i < count; i++) {
        for (j = 0; j < count; j++) {
            int64_t dx = drogue_edge_x_px(&e[j]) - drogue_edge_x_px(&e[i]);
            int64_t dy = drogue_edge_y_px(&e[j]) - drogue_edge_y_px(&e[i]), low[2], high[2];
            double length2 = (double)(dx * dx + dy * dy), length = sqrt(length2), along, across, x, y, d;
            long double area;
            if (i == j || !hull_edge(low, high, e, count, i, dx, dy)) {
                continue;
            }
            area = (long double)(high[0] - low[0]) * (long double)(high[1] - low[1]) / (long double)length2;
            if (best >= 0 && area > best * (1 + 1e-15L)) {
                continue;
            }
            along = (double)(high[0] - low[0]) / length;
            across = (double)(high[1] - low[1]) / length;
            x = ((double)dx * (double)(high[0] + low[0]) - (double)dy * (double)(high[1] + low[1])) / 2 / length2;
            y = ((double)dy * (double)(high[0] + low[0]) + (double)dx * (double)(high[1] + low[1])) / 2 / length2;
            d = fmax(fmax(fabs(r->xc_px_q16 - x * 65536), fabs(r->yc_px_q16 - y * 65536)),
                     fmax(fabs(r->short_px_q16 - fmin(along, across) * 65536),
                          fabs(r->long_px_q16 - fmax(along, across) * 65536)));
            error = best < 0 || area < best * (1 - 1e-15L) ? d : fmin(error, d);
            best = best < 0 || area < best ? area : best;
        }
    }
    return error;
}

#endif
