/* SPDX-License-Identifier: Apache-2.0 */
/* The front end in one pass over a stream of pixels, and the lists at its end. */
#include "frontend.h"

#include "stages.h"

static uint64_t
    points[DROGUE_HLS_EDGES + 1]; /* candidates in the ring, packed; the last word takes what does not fit */
static uint32_t point_arc[DROGUE_HLS_EDGES + 1]; /* and their arcs' labels */
static uint32_t arc_points[DROGUE_HLS_LABELS];
static uint32_t arc_place[DROGUE_HLS_LABELS];

/* Points listed so far. */
typedef struct point_list {
    uint32_t count;
    uint32_t full;
} point_list;

/* Append a point when it has an arc. */
static void append(point_list *list, uint64_t point, uint32_t arc)
{
    const uint32_t room = list->count < DROGUE_HLS_EDGES;
    points[list->count] = point;
    point_arc[list->count] = arc;
    list->count += (arc != 0) & room;
    list->full |= (arc != 0) & (room ^ 1u);
}

/* Give each point the root of its arc, 0 when its component is weak; count those of each arc. Returns the number of points
 * in strong components. */
static uint32_t count_points(uint32_t count, uint32_t arc_count)
{
    uint32_t left = 0;
    uint32_t i;
    for (i = 0; i < arc_count; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        arc_points[i] = 0;
    }
    for (i = 0; i < count; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
        const uint32_t root = drogue_hls_arc_root(point_arc[i]);
        point_arc[i] = root;
        arc_points[root]++; /* of 0: for nobody */
        left += root != 0;
    }
    return left;
}

/* Fill the arc table; every arc's place in the list, or DROGUE_NO_ARC. Returns the number of points in arcs. */
static uint32_t place_arcs(uint64_t arcs[DROGUE_HLS_ARCS], uint32_t *arc_count, uint32_t *full, uint32_t labels,
                           uint32_t min_arc_px)
{
    drogue_arc arc = {0, 0, 0};
    uint32_t n = 0;
    uint32_t i;
    *full = 0;
    arc_place[0] = DROGUE_NO_ARC;
    for (i = 1; i < labels; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        arc.count = arc_points[i];
        arc.direction = drogue_hls_arc_key(i) - 1u;
        arc_place[i] = DROGUE_NO_ARC;
        if (arc.count == 0 || arc.count < min_arc_px) {
            continue;
        }
        if (n >= DROGUE_HLS_ARCS) {
            *full = 1;
            continue;
        }
        arcs[n++] = drogue_hls_pack_arc(&arc);
        arc_place[i] = arc.first;
        arc.first += arc.count;
    }
    *arc_count = n;
    return arc.first;
}

/* Write the points of strong components sorted by arc, those of no arc in the table last. */
static void sort_points(uint64_t edges[DROGUE_HLS_EDGES], uint32_t count, uint32_t in_arcs)
{
    uint32_t last = in_arcs;
    uint32_t arc = point_arc[0];
    uint64_t point = points[0];
    uint32_t i;
    for (i = 0; i < count; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_EDGES
        const uint32_t following_arc = point_arc[i + 1u]; /* read ahead; the last word is no point */
        const uint64_t following = points[i + 1u];
        const uint32_t next = arc_place[arc];
        const uint32_t listed = next != DROGUE_NO_ARC;
        const uint32_t place = listed ? next : last;
        arc_place[arc] = next + listed;
        if (arc != 0) {
            last += listed ^ 1u;
            edges[place] = point;
        }
        arc = following_arc;
        point = following;
    }
}

/* What the library's drogue_frontend_begin() says of the arguments. */
static drogue_status check(int32_t width_px, int32_t height_px, int32_t canny_low, int32_t canny_high, int32_t use_ring,
                           const drogue_mask *ring)
{
    if (canny_low < 0 || canny_high < canny_low || (use_ring && !drogue_mask_valid(ring))) {
        return DROGUE_E_ARGUMENT;
    }
    if (width_px < 1 || width_px > DROGUE_MAX_SIDE || height_px < 1 || height_px > DROGUE_MAX_SIDE) {
        return DROGUE_E_REGION;
    }
    return width_px > DROGUE_HLS_WIDTH || height_px > DROGUE_HLS_HEIGHT ? DROGUE_E_WORKSPACE : DROGUE_OK;
}

static uint16_t threshold(int32_t magnitude) { return (uint16_t)(magnitude < 2040 ? magnitude : 2040); }

static uint32_t status_of(const drogue_hls_labels *labels, uint32_t edges_full, uint32_t arcs_full)
{
    const uint32_t which = (labels->components_full ? DROGUE_HLS_COMPONENTS_FULL : 0u) |
                           (labels->arcs_full ? DROGUE_HLS_ARC_LABELS_FULL : 0u) |
                           (edges_full ? DROGUE_HLS_EDGES_FULL : 0u) | (arcs_full ? DROGUE_HLS_ARCS_FULL : 0u);
    const drogue_status status = labels->components_full || labels->arcs_full ? DROGUE_E_LABELS_FULL
                                 : edges_full                                 ? DROGUE_E_EDGES_FULL
                                 : arcs_full                                  ? DROGUE_E_ARCS_FULL
                                                                              : DROGUE_OK;
    return which | (uint32_t)status;
}

/* A row of labels begins: the ring in it, from the column that comes to AT_LABEL in the second tick. */
static void begin_row(drogue_hls_windows *w, drogue_hls_frame *frame, const drogue_mask *ring, int32_t y)
{
    const int32_t dx = 2 * -2 - ring->centre2_x;
    frame->ring = drogue_mask_ring_row(ring, y);
    w->ring_dx = dx;
    w->ring_square = (int64_t)dx * dx;
}

void drogue_hls_frontend(const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], uint64_t edges[DROGUE_HLS_EDGES],
                         uint64_t arcs[DROGUE_HLS_ARCS], int32_t width_px, int32_t height_px, int32_t canny_low,
                         int32_t canny_high, int32_t smooth, uint32_t min_arc_px, int32_t use_ring, int32_t centre2_x,
                         int32_t centre2_y, int32_t longest_px, uint32_t results[DROGUE_HLS_FRONTEND_RESULTS])
{
#ifdef __BAMBU__
#pragma HLS interface port = pixels mode = fifo
#pragma HLS interface port = edges mode = m_axi offset = direct
#pragma HLS interface port = arcs mode = m_axi offset = direct
#else
#pragma HLS interface mode = axis port = pixels
#pragma HLS interface mode = m_axi port = edges bundle = lists
#pragma HLS interface mode = m_axi port = arcs bundle = lists
#pragma HLS interface mode = s_axilite port = width_px
#pragma HLS interface mode = s_axilite port = height_px
#pragma HLS interface mode = s_axilite port = canny_low
#pragma HLS interface mode = s_axilite port = canny_high
#pragma HLS interface mode = s_axilite port = smooth
#pragma HLS interface mode = s_axilite port = min_arc_px
#pragma HLS interface mode = s_axilite port = use_ring
#pragma HLS interface mode = s_axilite port = centre2_x
#pragma HLS interface mode = s_axilite port = centre2_y
#pragma HLS interface mode = s_axilite port = longest_px
#pragma HLS interface mode = s_axilite port = results
#pragma HLS interface mode = s_axilite port = return
#endif
    const drogue_mask ring = {use_ring ? centre2_x : 0, use_ring ? centre2_y : 0, use_ring ? longest_px : 1};
    const drogue_status refused = check(width_px, height_px, canny_low, canny_high, use_ring, &ring);
    drogue_hls_frame frame;
    drogue_hls_windows w;
    drogue_hls_labels labels;
    point_list list = {0, 0};
    uint32_t taken = 0;
    uint32_t arcs_full;
    uint32_t arcs_listed;
    uint32_t left;
    uint32_t in_arcs;
    int32_t period;
    int32_t x;
    int32_t y;
    if (refused != DROGUE_OK) {
        results[DROGUE_HLS_FRONTEND_EDGE_COUNT] = 0;
        results[DROGUE_HLS_FRONTEND_ARC_COUNT] = 0;
        results[DROGUE_HLS_FRONTEND_STATUS] = (uint32_t)refused;
        return;
    }
    period = width_px + IDLE_PX > LEAST_PERIOD ? width_px + IDLE_PX : LEAST_PERIOD;
    frame.width_px = width_px;
    frame.height_px = height_px;
    frame.period = period;
    frame.smooth = smooth;
    frame.low = threshold(canny_low);
    frame.high = threshold(canny_high);
    frame.use_ring = use_ring;
    drogue_hls_pixels_begin(&w);
    drogue_hls_labels_begin(&labels);
    for (y = 0; y < height_px + LAG_ROWS; y++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_HEIGHT + LAG_ROWS
        begin_row(&w, &frame, &ring, y - LAG_ROWS);
        drogue_hls_labels_row(&labels);
        for (x = 0; x < period; x++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_PERIOD
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#endif
            const drogue_hls_lines lines = drogue_hls_lines_read(&w);
            const drogue_hls_known known = drogue_hls_known_read(&labels, &w);
            const uint32_t code = w.code[AT_LABEL] & (w.in_ring ? 0x1Fu : 3u); /* no arc outside the ring */
            uint8_t pixel = 0;
            if (w.take) {
                pixel = pixels[taken++];
            }
            append(&list, w.point[AT_LIST], labels.arc);
            drogue_hls_labels_tick(&labels, &w, &known, code);
            drogue_hls_pixels_tick(&w, &frame, &lines);
            w.pixel = pixel;
        }
        drogue_hls_labels_settle(&labels);
    }
    drogue_hls_labels_flatten(&labels);
    left = count_points(list.count, labels.arc_count);
    in_arcs = place_arcs(arcs, &arcs_listed, &arcs_full, labels.arc_count, min_arc_px);
    sort_points(edges, list.count, in_arcs);
    results[DROGUE_HLS_FRONTEND_EDGE_COUNT] = left;
    results[DROGUE_HLS_FRONTEND_ARC_COUNT] = arcs_listed;
    results[DROGUE_HLS_FRONTEND_STATUS] = status_of(&labels, list.full, arcs_full);
}
