/* SPDX-License-Identifier: Apache-2.0 */
/* The one-pass front end: line buffers, two union-finds, a bounded list of edge points. */
#include "drogue/frontend.h"

#include <string.h>

enum { CODE_CANDIDATE = 1, CODE_STRONG = 2, CODE_CLASS_SHIFT = 2, CODE_CLASS_MASK = 0x1C };

drogue_status drogue_frontend_begin(drogue_frontend *frontend, drogue_workspace *workspace,
                                    const drogue_frontend_config *config, int32_t width_px, int32_t height_px)
{
    size_t width;
    size_t fours;
    if (config->canny_low < 0 || config->canny_high < config->canny_low ||
        (config->use_ring && !drogue_mask_valid(&config->ring))) {
        return DROGUE_E_ARGUMENT;
    }
    if (width_px < 1 || width_px > DROGUE_MAX_SIDE || height_px < 1 || height_px > DROGUE_MAX_SIDE) {
        return DROGUE_E_REGION;
    }
    if ((uint32_t)width_px > workspace->capacity.width_px) {
        return DROGUE_E_WORKSPACE;
    }
    frontend->workspace = workspace;
    frontend->config = *config;
    if (!config->use_ring) {
        frontend->config.ring = drogue_mask_of_size(width_px, height_px); /* rows of it are prepared all the same */
    }
    frontend->width_px = width_px;
    frontend->height_px = height_px;
    frontend->rows_in = 0;
    frontend->edge_count = 0;
    frontend->edges_full = 0;
    drogue_labels_reset(&frontend->components, workspace->component_parent, workspace->capacity.labels);
    drogue_labels_reset(&frontend->arc_labels, workspace->arc_parent, workspace->capacity.labels);
    width = (size_t)width_px;
    fours = DROGUE_FOURS(width_px);
    memset(workspace->component_strong, 0, workspace->capacity.labels * sizeof(uint32_t));
    memset(workspace->raw_rows, 0, 5 * (fours + 1) * sizeof(uint32_t));
    memset(workspace->smooth_rows, 0, 3 * 2 * (fours + 2) * sizeof(uint32_t));
    memset(workspace->magnitude_rows + 3 * 4 * (fours + 1), 0, 4 * (fours + 1) * sizeof(uint16_t));
    memset(workspace->code_rows, 0, 2 * width);
    return DROGUE_OK;
}

/* Append a candidate of row y to the edge list. */
static void append_edge(drogue_frontend *f, const drogue_slope *point, int32_t y, uint32_t label)
{
    drogue_edge *e;
    if (f->edge_count >= f->workspace->capacity.edges) {
        f->edges_full = 1;
        return;
    }
    e = &f->workspace->edges[f->edge_count++];
    /* Magnitudes outside are 0, so at a border the offset points inward and the sums stay in [0, 65535]. */
    DROGUE_NOTE("frontend: edge x, Q5", 32 * point->x + point->dx_q5, 16);
    DROGUE_NOTE("frontend: edge y, Q5", 32 * y + point->dy_q5, 16);
    e->x_q5 = (uint16_t)(32 * point->x + point->dx_q5);
    e->y_q5 = (uint16_t)(32 * y + point->dy_q5);
    e->gx = point->gx;
    e->gy = point->gy;
    e->arc = label;
}

/* Keep of the slopes of row y the maxima across their edge, and note their codes; those in the ring get their offset.
 * Returns the number kept. */
static uint32_t suppress(drogue_frontend *f, uint8_t *code, drogue_slope *slopes, const uint16_t *const magnitude[3],
                         int32_t y)
{
    const drogue_ring_row ring = drogue_mask_ring_row(&f->config.ring, y);
    const drogue_slope *end = slopes + f->slope_count[y & 1];
    const drogue_slope *s;
    drogue_slope *kept = slopes;
    memset(code, 0, (size_t)f->width_px);
    for (s = slopes; s < end; s++) {
        drogue_sector sector = drogue_canny_sector(s->gx, s->gy);
        int32_t m = magnitude[1][s->x];
        int32_t before;
        int32_t after;
        uint32_t c;
        drogue_canny_padded_neighbours(&before, &after, sector, magnitude, s->x);
        if (!drogue_canny_is_maximum(sector, before, m, after)) {
            continue;
        }
        *kept = *s;
        c = m > f->config.canny_high ? CODE_CANDIDATE | CODE_STRONG : CODE_CANDIDATE;
        if (!f->config.use_ring || drogue_ring_row_holds(&ring, s->x)) {
            int32_t offset_q5 = drogue_canny_offset_q5(before, m, after);
            kept->dx_q5 = (int8_t)(drogue_canny_step_x(sector) * offset_q5);
            kept->dy_q5 = (int8_t)(drogue_canny_step_y(sector) * offset_q5);
            c |= (drogue_direction_class(s->gx, s->gy) + 1u) << CODE_CLASS_SHIFT;
        }
        code[s->x] = (uint8_t)c;
        kept++;
    }
    return (uint32_t)(kept - slopes);
}

/* Pixel 0 of a row in the ring buffers; row 3 of the magnitude stays 0. */
static uint8_t *raw_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->raw_rows + (size_t)(y % 5) * (DROGUE_FOURS(f->width_px) + 1) * 4 + 2;
}

static uint32_t *smooth_row(const drogue_frontend *f, int32_t y)
{
    uint32_t *rows = (uint32_t *)(void *)f->workspace->smooth_rows;
    return rows + (size_t)(y % 3) * (DROGUE_FOURS(f->width_px) + 2) * 2 + 2;
}

static uint16_t *magnitude_row(const drogue_frontend *f, int32_t y)
{
    size_t row = y >= 0 && y < f->height_px ? (size_t)(y % 3) : 3;
    return f->workspace->magnitude_rows + row * (DROGUE_FOURS(f->width_px) + 1) * 4 + 2;
}

static drogue_slope *slope_row(const drogue_frontend *f, int32_t y)
{
    return f->workspace->slope_rows + (size_t)(y & 1) * DROGUE_FOURS(f->width_px) * 4;
}

/* A point that was refused a component belongs to no arc, so that the points of an arc share one component. */
static void forget_refused(uint8_t *code, const drogue_slope *points, uint32_t count, const uint32_t *component)
{
    uint32_t i;
    for (i = 0; i < count; i++) {
        if (component[points[i].x] == 0) {
            code[points[i].x] &= (uint8_t)~CODE_CLASS_MASK;
        }
    }
}

/* Suppress, threshold, label and list row y, whose magnitude is complete above and below. */
static void canny_step(drogue_frontend *f, int32_t y)
{
    drogue_workspace *w = f->workspace;
    size_t width = (size_t)f->width_px;
    const uint16_t *magnitude[3];
    drogue_slope *points = slope_row(f, y);
    uint8_t *code = w->code_rows + (size_t)(y & 1) * width;
    const uint8_t *code_above = w->code_rows + (size_t)(~y & 1) * width;
    uint32_t *component = w->component_rows + (size_t)(y & 1) * width;
    uint32_t *arc = w->arc_rows + (size_t)(y & 1) * width;
    uint32_t count;
    uint32_t i;
    magnitude[0] = magnitude_row(f, y - 1);
    magnitude[1] = magnitude_row(f, y);
    magnitude[2] = magnitude_row(f, y + 1);
    count = suppress(f, code, points, magnitude, y);
    drogue_label_points(component, &f->components, w->merges, w->component_rows + (size_t)(~y & 1) * width, code,
                        code_above, CODE_CANDIDATE, f->width_px, points, count);
    if (f->components.full) {
        forget_refused(code, points, count, component);
    }
    drogue_label_points(arc, &f->arc_labels, w->merges, w->arc_rows + (size_t)(~y & 1) * width, code, code_above,
                        CODE_CLASS_MASK, f->width_px, points, count);
    for (i = 0; i < count; i++) {
        int32_t x = points[i].x;
        w->component_strong[component[x]] |= code[x] & CODE_STRONG;
        if (arc[x] != 0) {
            w->arc_component[arc[x]] = component[x];
            append_edge(f, &points[i], y, arc[x]);
        }
    }
}

/* Smoothed row y is there: the gradient of row y - 1 is complete above and below. */
static void gradient_step(drogue_frontend *f, int32_t y)
{
    const uint32_t *rows[3];
    uint16_t *magnitude = magnitude_row(f, y);
    int32_t below = y + 1 < f->height_px ? y + 1 : y;
    rows[0] = smooth_row(f, y > 0 ? y - 1 : 0);
    rows[1] = smooth_row(f, y);
    rows[2] = smooth_row(f, below);
    f->slope_count[y & 1] =
        drogue_gradient_lanes_row(slope_row(f, y), magnitude, rows, f->width_px, f->config.canny_low);
    magnitude[-1] = 0;
    magnitude[f->width_px] = 0;
    if (y > 0) {
        canny_step(f, y - 1);
    }
}

/* Smoothed row y is complete but for its border, which is replicated. */
static void smoothed(drogue_frontend *f, int32_t y)
{
    uint32_t *row = smooth_row(f, y);
    drogue_lanes_set(row, -1, drogue_lanes_get(row, 0));
    drogue_lanes_set(row, f->width_px, drogue_lanes_get(row, f->width_px - 1));
    if (y > 0) {
        gradient_step(f, y - 1);
    }
}

static void smooth_step(drogue_frontend *f, int32_t y)
{
    const uint32_t *rows[5];
    int32_t k;
    for (k = 0; k < 5; k++) {
        rows[k] = (const uint32_t *)(const void *)(raw_row(f, drogue_reflect_101(y + k - 2, f->height_px)) - 2);
    }
    drogue_smooth_lanes_row(smooth_row(f, y), rows, (f->width_px + 3) / 4);
    smoothed(f, y);
}

/* Put the border of a raw row in its place, reflected. */
static void reflect_border(uint8_t *row, int32_t width_px)
{
    int32_t k;
    for (k = 1; k <= 2; k++) {
        row[-k] = row[drogue_reflect_101(-k, width_px)];
        row[width_px - 1 + k] = row[drogue_reflect_101(width_px - 1 + k, width_px)];
    }
}

void drogue_frontend_row(drogue_frontend *frontend, const uint8_t *row)
{
    int32_t y = frontend->rows_in;
    if (y >= frontend->height_px) {
        return;
    }
    frontend->rows_in++;
    if (frontend->config.smooth) {
        uint8_t *raw = raw_row(frontend, y);
        memcpy(raw, row, (size_t)frontend->width_px);
        reflect_border(raw, frontend->width_px);
        if (y >= 2) {
            smooth_step(frontend, y - 2);
        }
    } else {
        uint8_t *raw = raw_row(frontend, 0) - 2;
        memcpy(raw, row, (size_t)frontend->width_px);
        drogue_lanes_row(smooth_row(frontend, y), (const uint32_t *)(const void *)raw, (frontend->width_px + 3) / 4);
        smoothed(frontend, y);
    }
}

/* Let the rows still in the line buffers through. */
static void drain(drogue_frontend *f)
{
    int32_t height = f->height_px;
    if (f->config.smooth) {
        int32_t y;
        for (y = height > 2 ? height - 2 : 0; y < height; y++) {
            smooth_step(f, y);
        }
    }
    gradient_step(f, height - 1);
    canny_step(f, height - 1);
}

/* Give every arc label its root, and mark the roots whose component is strong; returns in 'alive' by root. */
static uint32_t *resolve_hysteresis(drogue_frontend *f)
{
    drogue_workspace *w = f->workspace;
    uint32_t *alive = w->arc_component;
    uint32_t i;
    drogue_labels_flatten(w->component_parent, f->components.count);
    for (i = 1; i < f->components.count; i++) {
        w->component_strong[w->component_parent[i]] |= w->component_strong[i];
    }
    drogue_labels_flatten(w->arc_parent, f->arc_labels.count);
    for (i = 1; i < f->arc_labels.count; i++) {
        if (w->arc_parent[i] == i) { /* a label that lost its root in its first row has no component noted */
            alive[i] = w->component_strong[w->component_parent[w->arc_component[i]]];
        }
    }
    return alive;
}

/* Drop the points of weak components; count those of each arc. Returns the number left. */
static uint32_t drop_weak(drogue_frontend *f, uint32_t *count, const uint32_t *alive)
{
    drogue_workspace *w = f->workspace;
    uint32_t left = 0;
    uint32_t i;
    memset(count, 0, f->arc_labels.count * sizeof(uint32_t));
    for (i = 0; i < f->edge_count; i++) {
        uint32_t root = w->arc_parent[w->edges[i].arc];
        if (alive[root] != 0) {
            w->edges[left] = w->edges[i];
            w->edges[left].arc = root;
            left++;
            count[root]++;
        }
    }
    return left;
}

/* Move every point to the place its 'arc' member names: each swap puts one in its place. */
static void permute(drogue_edge *edges, uint32_t count)
{
    uint32_t i;
    for (i = 0; i < count; i++) {
        while (edges[i].arc != i) {
            uint32_t to = edges[i].arc;
            drogue_edge t = edges[to];
            edges[to] = edges[i];
            edges[i] = t;
        }
    }
}

/* Sort the points by arc, those of arcs too short for the table last; fill the arc table. */
static drogue_status sort_by_arc(drogue_edge_list *list, drogue_frontend *f, const uint32_t *count, uint32_t *place)
{
    drogue_workspace *w = f->workspace;
    drogue_status status = DROGUE_OK;
    uint32_t next = 0;
    uint32_t i;
    list->arc_count = 0;
    for (i = 1; i < f->arc_labels.count; i++) {
        place[i] = DROGUE_NO_ARC;
        if (w->arc_parent[i] != i || count[i] < f->config.min_arc_px || count[i] == 0) {
            continue;
        }
        if (list->arc_count >= w->capacity.arcs) {
            status = DROGUE_E_ARCS_FULL;
            continue;
        }
        w->arcs[list->arc_count].first = next;
        w->arcs[list->arc_count].count = count[i];
        list->arc_count++;
        place[i] = next;
        next += count[i];
    }
    for (i = 0; i < list->edge_count; i++) {
        uint32_t *p = &place[w->edges[i].arc];
        w->edges[i].arc = *p == DROGUE_NO_ARC ? next++ : (*p)++;
    }
    permute(w->edges, list->edge_count);
    next = 0;
    for (i = 0; i < list->arc_count; i++) {
        drogue_arc *arc = &w->arcs[i];
        arc->direction = drogue_direction_class(w->edges[arc->first].gx, w->edges[arc->first].gy);
        for (next = arc->first; next < arc->first + arc->count; next++) {
            w->edges[next].arc = i;
        }
    }
    for (; next < list->edge_count; next++) {
        w->edges[next].arc = DROGUE_NO_ARC;
    }
    return status;
}

drogue_status drogue_frontend_end(drogue_edge_list *list, drogue_frontend *frontend)
{
    drogue_workspace *w = frontend->workspace;
    drogue_status status;
    list->edge_count = 0;
    list->arc_count = 0;
    if (frontend->rows_in != frontend->height_px) {
        return DROGUE_E_ARGUMENT;
    }
    frontend->rows_in++; /* a frame ends once */
    drain(frontend);
    {
        const uint32_t *alive = resolve_hysteresis(frontend);
        uint32_t *count = w->component_parent; /* the components have served */
        list->edge_count = drop_weak(frontend, count, alive);
        status = sort_by_arc(list, frontend, count, w->component_strong);
    }
    if (frontend->components.full || frontend->arc_labels.full) {
        return DROGUE_E_LABELS_FULL;
    }
    return frontend->edges_full ? DROGUE_E_EDGES_FULL : status;
}
