/* SPDX-License-Identifier: Apache-2.0 */
/* Hysteresis and arcs: two union-finds in the pass. Within a row the parents of labels given before are only read, those
 * of new labels only written; the merges of a row are resolved at its end, at most one every other pixel in each of the
 * five tables. */
#include "operators.h"
#include "stages.h"

enum { CANDIDATE = 1, STRONG = 2, KEY_SHIFT = 2, KEYS = 4, MERGES = DROGUE_HLS_WIDTH / 2 + 1 };

static uint32_t component_row[DROGUE_HLS_WIDTH]; /* labels of the row above, and arcs' with their key */
static uint32_t arc_row[DROGUE_HLS_WIDTH];
static uint8_t key_row[DROGUE_HLS_WIDTH];
static uint32_t component_parent[DROGUE_HLS_LABELS];
static uint8_t component_strong[DROGUE_HLS_LABELS];
static drogue_merge component_merges[MERGES];
static uint32_t arc_parent[KEYS][DROGUE_HLS_LABELS]; /* a label is used in the table of its key alone */
static uint32_t arc_component[DROGUE_HLS_LABELS];
static uint8_t arc_key[DROGUE_HLS_LABELS];
static drogue_merge arc_merges[KEYS][MERGES];

static const drogue_hls_labelled none = {0, 0, 0};

void drogue_hls_labels_begin(drogue_hls_labels *l)
{
    l->component_count = 1;
    l->arc_count = 1;
    l->components_full = 0;
    l->arcs_full = 0;
}

void drogue_hls_labels_row(drogue_hls_labels *l)
{
    int k;
    l->next = none;
    l->left = none;
    for (k = 0; k < 3; k++) {
        l->above[k] = none;
    }
    l->component_merges = 0;
    for (k = 0; k < KEYS; k++) {
        l->arc_merges[k] = 0;
    }
}

/* Let the window move one column to the right; x is the one it comes to. */
static void move_window(drogue_hls_labels *l, const drogue_hls_row *row, int32_t x)
{
    l->above[0] = l->above[1];
    l->above[1] = l->above[2];
    l->above[2] = none;
    if (l->next.component != 0) {
        l->above[2].component = component_parent[l->next.component];
    }
    if (l->next.key != 0) {
        l->above[2].key = l->next.key;
        l->above[2].arc = arc_parent[l->next.key - 1u][l->next.arc];
    }
    l->next = none;
    if (row->y > 4 && x + 2 >= 0 && x + 2 < row->width_px) {
        l->next.component = component_row[x + 2];
        l->next.arc = arc_row[x + 2];
        l->next.key = key_row[x + 2];
    }
}

/* Label of a candidate's component; 0 when the table is full. */
static uint32_t label_component(drogue_hls_labels *l, uint32_t code)
{
    const uint64_t chosen =
        drogue_hls_choose_label(l->above[1].component, l->left.component, l->above[0].component, l->above[2].component);
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    uint32_t label = (uint32_t)(chosen & 0xFFFFFFFFu);
    if (merge_with != 0) {
        component_merges[l->component_merges].a = label;
        component_merges[l->component_merges].b = merge_with;
        l->component_merges++;
    }
    if (label == 0) {
        if (l->component_count >= DROGUE_HLS_LABELS) {
            l->components_full = 1;
            return 0;
        }
        label = l->component_count++;
        component_parent[label] = label;
        component_strong[label] = (code & STRONG) != 0;
    } else if ((code & STRONG) != 0) {
        component_strong[label] = 1;
    }
    return label;
}

static uint32_t arc_of(const drogue_hls_labelled *pixel, uint32_t key) { return pixel->key == key ? pixel->arc : 0; }

/* Label of the arc of a point of the given key, in the component given; 0 when the table is full. */
static uint32_t label_arc(drogue_hls_labels *l, uint32_t key, uint32_t component)
{
    const uint64_t chosen = drogue_hls_choose_label(arc_of(&l->above[1], key), arc_of(&l->left, key),
                                                    arc_of(&l->above[0], key), arc_of(&l->above[2], key));
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    uint32_t label = (uint32_t)(chosen & 0xFFFFFFFFu);
    if (merge_with != 0) {
        drogue_merge *merge = &arc_merges[key - 1u][l->arc_merges[key - 1u]];
        merge->a = label;
        merge->b = merge_with;
        l->arc_merges[key - 1u]++;
    }
    if (label == 0) {
        if (l->arc_count >= DROGUE_HLS_LABELS) {
            l->arcs_full = 1;
            return 0;
        }
        label = l->arc_count++;
        arc_parent[key - 1u][label] = label;
        arc_key[label] = (uint8_t)key;
    }
    arc_component[label] = component; /* all points of an arc are in one component */
    return label;
}

uint32_t drogue_hls_label_stage(drogue_hls_labels *l, const drogue_hls_row *row, int32_t x, uint32_t code)
{
#pragma HLS array_partition variable = arc_parent complete dim = 1
#pragma HLS array_partition variable = arc_merges complete dim = 1
#pragma HLS bind_storage variable = component_parent type = ram_1wnr
#pragma HLS bind_storage variable = arc_parent type = ram_1wnr
/* Read: labels of the rows above. Written: new ones. */
#pragma HLS dependence variable = component_parent type = inter false
#pragma HLS dependence variable = arc_parent type = inter false
    drogue_hls_labelled pixel = none;
    move_window(l, row, x);
    if ((code & CANDIDATE) != 0) {
        const uint32_t key = code >> KEY_SHIFT & 7u;
        pixel.component = label_component(l, code);
        if (key != 0 && pixel.component != 0) {
            pixel.arc = label_arc(l, key, pixel.component);
            pixel.key = pixel.arc != 0 ? key : 0;
        }
    }
    if (x >= 0 && x < row->width_px) {
        component_row[x] = pixel.component;
        arc_row[x] = pixel.arc;
        key_row[x] = (uint8_t)pixel.key;
    }
    l->left = pixel;
    return pixel.arc;
}

void drogue_hls_labels_settle(const drogue_hls_labels *l)
{
    int k;
    drogue_labels_resolve(component_parent, component_merges, l->component_merges);
    for (k = 0; k < KEYS; k++) {
#pragma HLS unroll
        drogue_labels_resolve(arc_parent[k], arc_merges[k], l->arc_merges[k]);
    }
}

void drogue_hls_labels_flatten(const drogue_hls_labels *l)
{
    uint32_t i;
    for (i = 1; i < l->component_count; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        component_parent[i] = component_parent[component_parent[i]];
        if (component_strong[i]) { /* of a smaller label, met before */
            component_strong[component_parent[i]] = 1;
        }
    }
    for (i = 1; i < l->arc_count; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        uint32_t *parent = arc_parent[arc_key[i] - 1u];
        parent[i] = parent[parent[i]];
    }
}

uint32_t drogue_hls_arc_root(uint32_t arc) { return arc_parent[arc_key[arc] - 1u][arc]; }

uint32_t drogue_hls_arc_key(uint32_t arc) { return arc_key[arc]; }

uint32_t drogue_hls_arc_alive(uint32_t root) { return component_strong[component_parent[arc_component[root]]]; }
