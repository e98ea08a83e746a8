/* SPDX-License-Identifier: Apache-2.0 */
/* Smallest bounding rectangle by rotating calipers (Toussaint 1983) and the choice of the farthest arcs. */
#include "drogue/constraints.h"

#include "drogue/real.h"

static inline drogue_point pixel_of(const drogue_edge *e)
{
    drogue_point p;
    p.x = drogue_edge_x_px(e);
    p.y = drogue_edge_y_px(e);
    return p;
}

static inline int32_t cross(drogue_point o, drogue_point a, drogue_point b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/* A chain of hull vertices; its last two apart, so that hardware keeps them in registers. */
typedef struct chain {
    drogue_point *points;
    uint32_t size;
    uint32_t base;       /* the chain stands on points[base] */
    drogue_point last;   /* points[size - 1] */
    drogue_point before; /* points[size - 2], where size >= base + 2 */
} chain;

/* Drop points of the chain above its base that p makes concave or straight, then push p. */
static inline void chain_push(chain *c, drogue_point p)
{
    if (c->size > 0 && c->last.x == p.x && c->last.y == p.y) {
        return;
    }
    /* bound: size; over a hull no more rounds than points, each was pushed once */
    while (c->size >= c->base + 2 && cross(c->before, c->last, p) <= 0) {
        c->size--;
        c->last = c->before;
        c->before = c->points[c->size > 1 ? c->size - 2 : 0];
    }
    c->points[c->size] = p;
    c->size++;
    c->before = c->last;
    c->last = p;
}

/* Strictly convex hull by monotone chains over points in raster order; returns its size. */
static uint32_t convex_hull(drogue_point *hull, const drogue_edge *edges, uint32_t count)
{
    chain c = {hull, 0, 0, {0, 0}, {0, 0}};
    uint32_t i;
    for (i = 0; i < count; i++) {
        chain_push(&c, pixel_of(&edges[i]));
    }
    c.base = c.size - 1;
    for (i = count; i-- > 0;) {
        chain_push(&c, pixel_of(&edges[i]));
    }
    DROGUE_NOTE("constraints: hull points", c.size, 10);
    return c.size > 1 ? c.size - 1 : c.size; /* the last point is the first again */
}

/* Below 2^23: coordinates and their differences are below 2^11. */
static inline int32_t dot(int32_t dx, int32_t dy, drogue_point p) { return dx * p.x + dy * p.y; }

/* Advance a caliper from hull[at] to the farthest vertex along (dx, dy). */
static uint32_t caliper(const drogue_point *hull, uint32_t size, uint32_t at, int32_t dx, int32_t dy)
{
    uint32_t step;
    for (step = 0; step < size; step++) {
        uint32_t next = at + 1 < size ? at + 1 : 0;
        if (dot(dx, dy, hull[next]) < dot(dx, dy, hull[at])) {
            break;
        }
        at = next;
    }
    return at;
}

/* Rectangle with a side along (dx, dy): extents and twice the centre, all times |(dx, dy)|. */
typedef struct box {
    int32_t dx;
    int32_t dy;
    int32_t length2;
    int32_t along;
    int32_t across;
    int32_t centre2_along;
    int32_t centre2_across;
} box;

/* Is the area of p smaller than that of q? Areas are along * across / length2; compared exactly, the products of 69
 * bits in two parts. */
static inline int smaller(const box *p, const box *q)
{
    const uint64_t area_p = (uint64_t)(uint32_t)p->along * (uint32_t)p->across;
    const uint64_t area_q = (uint64_t)(uint32_t)q->along * (uint32_t)q->across;
    const uint64_t low_p = (uint64_t)(uint32_t)area_p * (uint32_t)q->length2;
    const uint64_t low_q = (uint64_t)(uint32_t)area_q * (uint32_t)p->length2;
    const uint64_t high_p = (uint64_t)(uint32_t)(area_p >> 32) * (uint32_t)q->length2 + (low_p >> 32);
    const uint64_t high_q = (uint64_t)(uint32_t)(area_q >> 32) * (uint32_t)p->length2 + (low_q >> 32);
    return high_p != high_q ? high_p < high_q : (uint32_t)low_p < (uint32_t)low_q;
}

static box smallest_box(const drogue_point *hull, uint32_t size)
{
    box best = {1, 0, 1, 0, 0, 0, 0};
    uint32_t right = 0; /* farthest along the edge, across it, and back */
    uint32_t top = 0;
    uint32_t left = 0;
    uint32_t i;
    for (i = 0; i < size; i++) {
        drogue_point a = hull[i];
        drogue_point b = hull[i + 1 < size ? i + 1 : 0];
        int32_t low;
        box p;
        p.dx = b.x - a.x;
        p.dy = b.y - a.y;
        right = caliper(hull, size, i == 0 ? 0 : right, p.dx, p.dy);
        top = caliper(hull, size, i == 0 ? right : top, -p.dy, p.dx);
        left = caliper(hull, size, i == 0 ? top : left, -p.dx, -p.dy);
        low = dot(-p.dy, p.dx, a);
        p.length2 = p.dx * p.dx + p.dy * p.dy;
        p.along = dot(p.dx, p.dy, hull[right]) - dot(p.dx, p.dy, hull[left]);
        p.across = dot(-p.dy, p.dx, hull[top]) - low;
        p.centre2_along = dot(p.dx, p.dy, hull[right]) + dot(p.dx, p.dy, hull[left]);
        p.centre2_across = dot(-p.dy, p.dx, hull[top]) + low;
        DROGUE_NOTE("constraints: extent times edge length", p.along > p.across ? p.along : p.across, 23);
        DROGUE_NOTE("constraints: area times squared length", (int64_t)p.along * p.across, 46);
        if (i == 0 || smaller(&p, &best)) {
            best = p;
        }
    }
    return best;
}

static drogue_q16 over(int64_t v, const drogue_real *length)
{
    drogue_real t;
    drogue_real_set(&t, v, 0);
    drogue_real_quotient(&t, &t, length);
    return drogue_real_to_q16(t);
}

drogue_status drogue_min_area_rect(drogue_min_rect *out, drogue_point *hull, const drogue_edge *edges, uint32_t count)
{
    uint32_t size;
    box b;
    drogue_real length;
    drogue_real length2;
    if (count == 0) {
        out->xc_px_q16 = out->yc_px_q16 = out->short_px_q16 = out->long_px_q16 = 0;
        return DROGUE_E_ARGUMENT;
    }
    size = convex_hull(hull, edges, count);
    if (size == 1) {
        out->xc_px_q16 = drogue_q16_from_int(hull[0].x);
        out->yc_px_q16 = drogue_q16_from_int(hull[0].y);
        out->short_px_q16 = out->long_px_q16 = 0;
        return DROGUE_OK;
    }
    b = smallest_box(hull, size);
    drogue_real_set(&length2, b.length2, 0);
    drogue_real_root(&length, &length2);
    drogue_real_shift(&length2, 1);
    out->short_px_q16 = over(b.along < b.across ? b.along : b.across, &length);
    out->long_px_q16 = over(b.along < b.across ? b.across : b.along, &length);
    out->xc_px_q16 = over((int64_t)b.dx * b.centre2_along - (int64_t)b.dy * b.centre2_across, &length2);
    out->yc_px_q16 = over((int64_t)b.dy * b.centre2_along + (int64_t)b.dx * b.centre2_across, &length2);
    return DROGUE_OK;
}

int drogue_quadrant(drogue_q16 dx_px_q16, drogue_q16 dy_px_q16)
{
    if (dx_px_q16 == 0 || dy_px_q16 == 0) {
        return -1;
    }
    if (dy_px_q16 < 0) {
        return dx_px_q16 > 0 ? 0 : 1;
    }
    return dx_px_q16 < 0 ? 2 : 3;
}

void drogue_judge_arc(drogue_arc_verdict *out, drogue_point *hull, const drogue_edge *edges, const drogue_arc *arc,
                      const drogue_mask *mask, drogue_q16 min_short_px_q16)
{
    int64_t dx;
    int64_t dy;
    int quadrant;
    int32_t turn;
    (void)drogue_min_area_rect(&out->rect, hull, edges + arc->first, arc->count);
    dx = out->rect.xc_px_q16 - (int64_t)mask->centre2_x * (DROGUE_Q16_ONE / 2);
    dy = out->rect.yc_px_q16 - (int64_t)mask->centre2_y * (DROGUE_Q16_ONE / 2);
    out->distance2_q32 = dx * dx + dy * dy;
    DROGUE_NOTE("constraints: squared distance, Q32", out->distance2_q32, 62);
    out->polarity = DROGUE_POLARITY_BOTH;
    out->quadrant = -1;
    quadrant = drogue_quadrant(drogue_sat_s32(dx), drogue_sat_s32(dy));
    if (quadrant < 0 || out->rect.short_px_q16 < min_short_px_q16) {
        return;
    }
    turn = (quadrant - (int32_t)arc->direction) & 3;
    if (turn == 0 || turn == 2) {
        out->quadrant = quadrant;
        out->polarity = turn == 0 ? DROGUE_POLARITY_DARK : DROGUE_POLARITY_BRIGHT;
    }
}

#define LONGEST 4 /* arcs of a quadrant that are compared by distance */

/* The longest arcs of one quadrant so far, longest first; of equals the first. */
typedef struct leaders {
    uint32_t arc[LONGEST];
    uint32_t points[LONGEST]; /* 0: none */
    int64_t distance2_q32[LONGEST];
} leaders;

static void keep_longest(leaders *l, uint32_t arc, uint32_t points, int64_t distance2_q32)
{
    int i;
    for (i = LONGEST - 1; i >= 0 && points > l->points[i]; i--) {
        if (i + 1 < LONGEST) {
            l->arc[i + 1] = l->arc[i];
            l->points[i + 1] = l->points[i];
            l->distance2_q32[i + 1] = l->distance2_q32[i];
        }
        l->arc[i] = arc;
        l->points[i] = points;
        l->distance2_q32[i] = distance2_q32;
    }
}

/* Is an arc no longer than those that all quadrants have? */
static int too_short(const leaders lead[4], uint32_t points)
{
    int k = 0;
    while (k < 4 && points <= lead[k].points[LONGEST - 1]) {
        k++;
    }
    return k == 4;
}

/* The farthest of those with at least half the longest's points, then the longest of the others. */
static void choose_arcs(uint32_t chosen[DROGUE_ARC_CHOICES], const leaders *l)
{
    int far = 0;
    int i;
    for (i = 1; i < LONGEST; i++) {
        if (2 * l->points[i] >= l->points[0] && l->distance2_q32[i] > l->distance2_q32[far]) {
            far = i;
        }
    }
    chosen[0] = l->arc[far];
    chosen[1] = l->arc[far == 0 ? 1 : 0];
}

drogue_status drogue_select_arcs(drogue_arc_choices *out, drogue_point *hull, const drogue_edge *edges,
                                 const drogue_arc *arcs, uint32_t arc_count, const drogue_mask *mask,
                                 drogue_q16 min_short_px_q16, drogue_polarity polarity)
{
    leaders lead[4];
    drogue_status status = DROGUE_E_NO_ARCS;
    uint32_t i;
    int k;
    for (k = 0; k < 4; k++) {
        for (i = 0; i < LONGEST; i++) {
            lead[k].arc[i] = DROGUE_NO_ARC;
            lead[k].points[i] = 0;
            lead[k].distance2_q32[i] = -1;
        }
    }
    for (i = 0; i < arc_count; i++) {
        drogue_arc_verdict v;
        if (too_short(lead, arcs[i].count)) {
            continue;
        }
        drogue_judge_arc(&v, hull, edges, &arcs[i], mask, min_short_px_q16);
        if (v.quadrant >= 0 && (polarity == DROGUE_POLARITY_BOTH || v.polarity == polarity)) {
            keep_longest(&lead[v.quadrant], i, arcs[i].count, v.distance2_q32);
            status = DROGUE_OK;
        }
    }
    for (k = 0; k < 4; k++) {
        choose_arcs(out->arc[k], &lead[k]);
    }
    return status;
}
