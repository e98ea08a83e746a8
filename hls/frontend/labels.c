/* SPDX-License-Identifier: Apache-2.0 */
/* Hysteresis and arcs: two union-finds in the pass. Within a row the parents of labels given before are only read, those
 * of new labels only written; the merges of a row are resolved at its end, at most one every other pixel in each of the
 * five tables. */
#include "../choose_label.h"
#include "stages.h"

enum { CANDIDATE = 1, STRONG = 2, KEY_SHIFT = 2, KEYS = 4, MERGES = DROGUE_HLS_WIDTH / 2 + 1 };

/* A word more in each row and list, and entry 0 of each table, take what is not to be kept: writes need no condition. */
enum { OUTSIDE = DROGUE_HLS_WIDTH, WORDS = DROGUE_HLS_WIDTH + 1 };

static uint32_t component_row[WORDS]; /* labels of the row above, and arcs' with their key */
static uint32_t arc_row[WORDS];
static uint8_t key_row[WORDS];
static uint32_t component_parent[DROGUE_HLS_LABELS];
static uint8_t component_strong[DROGUE_HLS_LABELS];
static drogue_merge component_merges[MERGES];
static uint32_t arc_parent[KEYS][DROGUE_HLS_LABELS]; /* a label is used in the table of its key alone */
static uint32_t arc_component[DROGUE_HLS_LABELS];
static uint8_t arc_key[DROGUE_HLS_LABELS];
static drogue_merge arc_merges[KEYS][MERGES];

/* Merges of the row in each. */
static uint32_t component_merge_count;
static uint32_t arc_merge_count[KEYS];

static const drogue_hls_labelled none = {0, 0, 0};

void drogue_hls_labels_begin(drogue_hls_labels *l)
{
    int k;
    l->component_count = 1;
    l->arc_count = 1;
    l->components_full = 0;
    l->arcs_full = 0;
    component_parent[0] = 0;
    for (k = 0; k < KEYS; k++) {
        arc_parent[k][0] = 0;
    }
}

void drogue_hls_labels_row(drogue_hls_labels *l)
{
    int k;
    l->next = none;
    l->left = none;
    l->above[0] = none;
    l->above[1] = none;
    l->above[2] = none;
    component_merge_count = 0;
    for (k = 0; k < KEYS; k++) {
        arc_merge_count[k] = 0;
    }
}

/* Table of a key; that of key 0 is any, its label is 0. */
static uint32_t table(uint32_t key) { return (key + KEYS - 1u) % KEYS; }

/* The pixel that enters the window next, with its roots; the one after it is read. */
static drogue_hls_labelled fetch(drogue_hls_labels *l, const drogue_hls_row *row, int32_t x)
{
    const int inside = (row->y > 4) & (x >= 0) & (x < row->width_px);
    const uint32_t known = drogue_hls_when(inside);
    const int32_t word = inside ? x : OUTSIDE;
    drogue_hls_labelled next;
    next.component = component_parent[l->next.component];
    next.arc = arc_parent[table(l->next.key)][l->next.arc];
    next.key = l->next.key;
    l->next.component = component_row[word] & known;
    l->next.arc = arc_row[word] & known;
    l->next.key = key_row[word] & known;
    return next;
}

/* Label of a pixel's component; 0 when it is no candidate, or the table is full. */
static uint32_t label_component(drogue_hls_labels *l, uint32_t code)
{
    const uint64_t chosen =
        drogue_hls_choose_label(l->above[1].component, l->left.component, l->above[0].component, l->above[2].component);
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t candidate = code & CANDIDATE;
    const uint32_t strong = code / STRONG & 1u;
    const uint32_t new = candidate &&near == 0;
    const uint32_t room = l->component_count < DROGUE_HLS_LABELS;
    const uint32_t label =
        drogue_hls_when((int)candidate) & (near | (l->component_count & drogue_hls_when((int)(new &room))));
    const uint32_t fresh = drogue_hls_when((int)new);
    drogue_merge *merge = &component_merges[component_merge_count];
    merge->a = near;
    merge->b = merge_with;
    component_merge_count += candidate & (merge_with != 0);
    component_parent[label & fresh] = label & fresh;
    component_strong[label & (fresh | drogue_hls_when((int)strong))] = (uint8_t)strong;
    l->component_count += new &&room;
    l->components_full |= new &(room ^ 1u);
    return label;
}

static uint32_t arc_of(const drogue_hls_labelled *pixel, uint32_t key)
{
    return pixel->arc & drogue_hls_when(pixel->key == key);
}

/* Label of the arc of a point of the given key, in the component given; 0 when the key is, or the table is full. */
static uint32_t label_arc(drogue_hls_labels *l, uint32_t key, uint32_t component)
{
    const uint64_t chosen = drogue_hls_choose_label(arc_of(&l->above[1], key), arc_of(&l->left, key),
                                                    arc_of(&l->above[0], key), arc_of(&l->above[2], key));
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t in = table(key);
    const uint32_t keyed = key != 0;
    const uint32_t new = keyed &(near == 0);
    const uint32_t fresh = drogue_hls_when((int)new);
    const uint32_t room = l->arc_count < DROGUE_HLS_LABELS;
    const uint32_t label = drogue_hls_when((int)keyed) & (near | (l->arc_count & drogue_hls_when((int)(new &room))));
    const uint32_t merges = arc_merge_count[in];
    drogue_merge *merge = &arc_merges[in][merges];
    merge->a = near;
    merge->b = merge_with;
    arc_merge_count[in] = merges + (keyed & (merge_with != 0));
    arc_parent[in][label & fresh] = label & fresh;
    arc_key[label & fresh] = (uint8_t)key;
    arc_component[label] = component; /* all points of an arc are in one component */
    l->arc_count += new &&room;
    l->arcs_full |= new &(room ^ 1u);
    return label;
}

uint32_t drogue_hls_label_stage(drogue_hls_labels *l, const drogue_hls_row *row, int32_t x, uint32_t code)
{
#pragma HLS array_partition variable = arc_parent complete dim = 1
#pragma HLS array_partition variable = arc_merges complete dim = 1
#pragma HLS array_partition variable = arc_merge_count complete
#pragma HLS bind_storage variable = component_parent type = ram_1wnr
#pragma HLS bind_storage variable = arc_parent type = ram_1wnr
/* Read: labels of the rows above. Written: new ones. */
#pragma HLS dependence variable = component_parent type = inter false
#pragma HLS dependence variable = arc_parent type = inter false
    const int32_t word = ((x >= 0) & (x < row->width_px)) ? x : OUTSIDE;
    const drogue_hls_labelled next = fetch(l, row, x + 3);
    drogue_hls_labelled pixel;
    uint32_t key;
    pixel.component = label_component(l, code);
    key = code >> KEY_SHIFT & 7u & drogue_hls_when(pixel.component != 0);
    pixel.arc = label_arc(l, key, pixel.component);
    pixel.key = key & drogue_hls_when(pixel.arc != 0);
    component_row[word] = pixel.component;
    arc_row[word] = pixel.arc;
    key_row[word] = (uint8_t)pixel.key;
    l->left = pixel;
    l->above[0] = l->above[1];
    l->above[1] = l->above[2];
    l->above[2] = next;
    return pixel.arc;
}

void drogue_hls_labels_settle(void)
{
    int k;
    drogue_labels_resolve(component_parent, component_merges, component_merge_count);
    for (k = 0; k < KEYS; k++) {
#ifndef __BAMBU__
#pragma HLS unroll
#endif
        drogue_labels_resolve(arc_parent[k], arc_merges[k], arc_merge_count[k]);
    }
}

void drogue_hls_labels_flatten(const drogue_hls_labels *l)
{
    const uint32_t components = l->component_count;
    const uint32_t arcs = l->arc_count;
    uint32_t i;
    for (i = 1; i < components; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        component_parent[i] = component_parent[component_parent[i]];
        if (component_strong[i]) { /* of a smaller label, met before */
            component_strong[component_parent[i]] = 1;
        }
    }
    for (i = 1; i < arcs; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        uint32_t *parent = arc_parent[arc_key[i] - 1u];
        parent[i] = parent[parent[i]];
    }
}

uint32_t drogue_hls_arc_root(uint32_t arc) { return arc_parent[arc_key[arc] - 1u][arc]; }

uint32_t drogue_hls_arc_key(uint32_t arc) { return arc_key[arc]; }

uint32_t drogue_hls_arc_alive(uint32_t root) { return component_strong[component_parent[arc_component[root]]]; }
