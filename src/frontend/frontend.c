/* SPDX-License-Identifier: Apache-2.0 */
/* The one-pass front end: line buffers, two union-finds, a bounded list of edge points. */
#include "drogue/frontend.h"

#include <string.h>

#include "label_pass.h"
#include "rows.h"

static const drogue_stretch no_stretch = {UINT16_MAX, 0};

drogue_status drogue_frontend_begin(drogue_frontend *frontend, drogue_workspace *workspace,
                                    const drogue_frontend_config *config, int32_t width_px, int32_t height_px)
{
    const drogue_status status = drogue_frontend_check(workspace, config, width_px, height_px);
    uint32_t k;
    frontend->workspace = workspace;
    frontend->rows_in = 0;
    frontend->height_px = -1; /* no number of rows makes a frame of what is refused */
    if (status != DROGUE_OK) {
        return status;
    }
    frontend->config = *config;
    frontend->width_px = width_px;
    frontend->height_px = height_px;
    if (config->use_ring) {
        drogue_ring_chords_of(&frontend->chords, &config->ring);
    }
    for (k = 0; k < 8; k++) {
        frontend->stretch[k] = no_stretch;
    }
    frontend->edge_count = 0;
    frontend->edges_full = 0;
    frontend->slope_count[0] = 0;
    frontend->slope_count[1] = 0;
    drogue_labels_reset(&frontend->components, workspace->component_parent, workspace->capacity.labels);
    drogue_labels_reset(&frontend->arc_labels, workspace->arc_parent, workspace->capacity.labels);
    workspace->component_strong[0] = 0; /* of what is refused; the others as they are given */
    memset(workspace->code_rows, 0, 4 * (size_t)drogue_row_half(frontend));
    drogue_rows_begin(frontend);
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

/* Resolve the merges from 'last' back to 'first'. A row's merges of components lie at the list's begin, those of arcs
 * from its end backward: where a component's merge is, no candidate is above, so that the column before has no arc's; a
 * list as long as the row holds both. */
static void resolve_backward(uint32_t *parent, drogue_merge *first, drogue_merge *last)
{
    const uint32_t count = (uint32_t)(last + 1 - first);
    drogue_merge *a;
    for (a = first; a < last; a++, last--) { /* into the order of the row */
        const drogue_merge t = *a;
        *a = *last;
        *last = t;
    }
    drogue_labels_resolve(parent, first, count);
}

/* What holds both. */
static inline drogue_stretch joined(drogue_stretch a, drogue_stretch b)
{
    drogue_stretch all;
    all.begin = a.begin < b.begin ? a.begin : b.begin;
    all.end = a.end > b.end ? a.end : b.end;
    return all;
}

/* What holds the candidates of row y, and with it those of the rows about the one before. */
static void note_stretch(drogue_frontend *f, int32_t y, drogue_stretch stretch)
{
    const uint32_t row = (uint32_t)y & 7u;
    const uint32_t before = (row + 7u) & 7u;
    f->stretch[row] = stretch;
    f->about[before] = joined(joined(f->stretch[(row + 6u) & 7u], f->stretch[before]), stretch);
}

/* The same with so much beside it, within the row. */
static drogue_stretch widened(const drogue_frontend *f, drogue_stretch stretch, int32_t reach)
{
    const int32_t limit = drogue_rows_end(f);
    drogue_stretch all;
    all.begin = (uint16_t)(stretch.begin > reach ? stretch.begin - reach : 0);
    all.end = (uint16_t)(stretch.end + reach < limit ? stretch.end + reach : limit);
    return all; /* where no row has any it begins far off and remains empty */
}

/* Suppress, threshold, label and list row y, whose magnitude is complete above and below. */
static void canny_step(drogue_frontend *f, int32_t y)
{
    drogue_workspace *w = f->workspace;
    const size_t width = (size_t)f->width_px;
    const size_t row = (size_t)(y & 1) * width;
    const size_t above = width - row;
    drogue_merge *last_merge = w->merges + width - 1;
    drogue_label_pass components =
        drogue_label_pass_of(&f->components, w->component_rows + row, w->component_rows + above, w->merges, 1,
                             f->width_px, DROGUE_CODE_CANDIDATE);
    drogue_label_pass arcs = drogue_label_pass_of(&f->arc_labels, w->arc_rows + row, w->arc_rows + above, last_merge,
                                                  -1, f->width_px, DROGUE_CODE_CLASS_MASK);
    uint8_t *code = drogue_code_row(f, y);
    const uint8_t *code_above = drogue_code_row(f, y + 1);
    uint32_t *strong = w->component_strong;
    int32_t part;
    for (part = 0; part < DROGUE_ROW_PARTS; part++) {
        const drogue_slope *point = drogue_rows_points(f);
        const drogue_slope *end = point + drogue_rows_maxima(f, y, part);
        for (; point < end; point++) {
            const int32_t x = point->x;
            const uint32_t next = f->components.count;
            const uint32_t component = drogue_label_pixel(&components, &f->components, code, code_above, x);
            uint32_t arc;
            strong[component] = (component == next ? 0 : strong[component]) | (code[x] & DROGUE_CODE_STRONG);
            if (component == 0) { /* refused: it belongs to no arc, so that an arc's points share one component */
                code[x] &= (uint8_t)~DROGUE_CODE_CLASS_MASK;
                continue;
            }
            arc = drogue_label_pixel(&arcs, &f->arc_labels, code, code_above, x);
            if (arc != 0) {
                w->arc_component[arc] = component;
                append_edge(f, point, y, arc);
            }
        }
    }
    drogue_labels_resolve(f->components.parent, w->merges, (uint32_t)(components.merge - w->merges));
    resolve_backward(f->arc_labels.parent, arcs.merge + 1, last_merge);
}

/* Smoothed row y is there: the gradient of row y - 1 is complete above and below. */
static void gradient_step(drogue_frontend *f, int32_t y)
{
    const drogue_stretch stretch = widened(f, f->about[y & 7], 1);
    if (stretch.begin < stretch.end) {
        drogue_rows_gradient(f, y, stretch);
    }
    if (y > 0) {
        canny_step(f, y - 1);
    }
}

static void smooth_step(drogue_frontend *f, int32_t y)
{
    const drogue_stretch stretch = widened(f, joined(f->about[(y + 7) & 7], f->about[(y + 1) & 7]), 2);
    if (stretch.begin < stretch.end) {
        drogue_rows_smooth(f, y, stretch);
    }
    if (y > 0) {
        gradient_step(f, y - 1);
    }
}

/* Row y comes in: where its candidates will be. */
static void begin_row(drogue_frontend *f, int32_t y)
{
    drogue_columns *columns = &f->columns[y & 7];
    if (f->config.use_ring) {
        drogue_mask_columns(columns, &f->chords, &f->config.ring, y, f->width_px);
    } else {
        columns->begin[0] = 0;
        columns->begin[1] = (uint16_t)f->width_px;
        columns->end[0] = (uint16_t)f->width_px;
        columns->end[1] = (uint16_t)f->width_px;
    }
    note_stretch(f, y, drogue_rows_stretch(f, columns));
}

/* Row y of pixels comes in, kept for smoothing, its border reflected: pixels -2, -1, width_px, width_px + 1. */
static void take_row(const drogue_frontend *f, int32_t y, const uint8_t *pixels)
{
    const int32_t width_px = f->width_px;
    uint8_t *row = drogue_raw_row(f, y) + 2 + drogue_row_left(f);
    uint8_t *last = row + width_px - 1;
    int32_t k;
    memcpy(row, pixels, (size_t)width_px);
    for (k = 1; k <= 2; k++) {
        const int32_t mirror = k < width_px ? k : 0; /* what drogue_reflect_101() comes to */
        row[-k] = row[mirror];
        last[k] = last[-mirror];
    }
}

void drogue_frontend_row(drogue_frontend *frontend, const uint8_t *row)
{
    int32_t y = frontend->rows_in;
    if (y >= frontend->height_px) {
        frontend->rows_in = frontend->height_px + 1; /* not a frame any more */
        return;
    }
    frontend->rows_in++;
    begin_row(frontend, y);
    if (frontend->config.smooth) {
        take_row(frontend, y, row);
        if (y >= 2) {
            smooth_step(frontend, y - 2);
        }
    } else {
        drogue_rows_take_smoothed(frontend, y, row);
        if (y > 0) {
            gradient_step(frontend, y - 1);
        }
    }
}

/* Let the rows still in the line buffers through. */
static void drain(drogue_frontend *f)
{
    int32_t height = f->height_px;
    note_stretch(f, height, no_stretch);
    note_stretch(f, height + 1, no_stretch);
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

/* Move every point to the place its 'arc' member names, round by round: each is read and written once. */
static void permute(drogue_edge *edges, uint32_t count)
{
    uint32_t i;
    for (i = 0; i < count; i++) {
        drogue_edge moving = edges[i];
        while (moving.arc != i) {
            const uint32_t to = moving.arc;
            const drogue_edge next = edges[to];
            edges[to] = moving;
            edges[to].arc = to;
            moving = next;
        }
        edges[i] = moving;
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
