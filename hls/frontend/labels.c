/* SPDX-License-Identifier: Apache-2.0 */
/* Hysteresis and arcs: two union-finds in the pass. Within a row the parents of labels given before are only read, those
 * of new labels only written; the merges of a row are resolved at its end, at most one every other pixel in each of the
 * five tables. */
#include "../choose_label.h"
#include "stages.h"

enum { CANDIDATE = 1, STRONG = 2, KEY_SHIFT = 2, MERGES = DROGUE_HLS_WIDTH / 2 + 1 };

/* n rounded up to a power of 2: the place of an entry in one of several tables is found without an addition. */
#define SMEAR(n, by) ((n) | (n) >> (by))
#define POWER_OF_2(n) (SMEAR(SMEAR(SMEAR(SMEAR(SMEAR((n)-1, 1), 2), 4), 8), 16) + 1)
enum { TABLE = POWER_OF_2(DROGUE_HLS_LABELS), LIST = POWER_OF_2(MERGES) };

static uint32_t component_row[DROGUE_HLS_PERIOD]; /* labels of the row above, and arcs' with their key */
static uint32_t arc_row[DROGUE_HLS_PERIOD];
static uint8_t key_row[DROGUE_HLS_PERIOD];
static uint32_t
    component_parent[DROGUE_HLS_LABELS]; /* entry 0 takes what is not to be kept: writes need no condition */
static uint8_t component_strong[DROGUE_HLS_LABELS];
static drogue_merge component_merges[MERGES];
static uint32_t arc_parent[DROGUE_HLS_KEYS][TABLE]; /* a label is used in the table of its key alone */
static uint32_t arc_component[DROGUE_HLS_LABELS];
static uint8_t arc_key[DROGUE_HLS_LABELS];
static uint32_t arc_root[DROGUE_HLS_LABELS]; /* when the frame is complete; 0 in a component without a strong point */
static drogue_merge arc_merges[DROGUE_HLS_KEYS][LIST];

void drogue_hls_labels_begin(drogue_hls_labels *l)
{
    static const drogue_hls_labels empty;
    int k;
    *l = empty;
    l->component_count = 1;
    l->arc_count = 1;
    component_parent[0] = 0;
    for (k = 0; k < DROGUE_HLS_KEYS; k++) {
        arc_parent[k][0] = 0;
    }
}

void drogue_hls_labels_row(drogue_hls_labels *l)
{
    int k;
    l->component_merges = 0;
    for (k = 0; k < DROGUE_HLS_KEYS; k++) {
        l->arc_merges[k] = 0;
    }
}

/* Table of a key; that of key 0 is any, its label is 0. */
static uint32_t table(uint32_t key) { return (key + DROGUE_HLS_KEYS - 1u) % DROGUE_HLS_KEYS; }

drogue_hls_known drogue_hls_known_read(const drogue_hls_labels *l, const drogue_hls_windows *w)
{
    drogue_hls_known known;
    known.component = component_row[w->x[AT_LABEL - 3]];
    known.arc = arc_row[w->x[AT_LABEL + 1 - 3]];
    known.key = key_row[w->x[AT_LABEL + 1 - 3]];
    known.component_root = component_parent[l->component_next];
    known.arc_root = arc_parent[l->table_next][l->arc_next];
    return known;
}

/* A pixel's component, 0 when it is no candidate or the table is full, and its code: for the arc. */
static void label_component(drogue_hls_labels *l, uint32_t x, const drogue_hls_known *known, uint32_t code)
{
    const uint64_t chosen =
        drogue_hls_choose_label(l->component_above[1], l->component_left, l->component_above[0], l->component_above[2]);
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t candidate = code & CANDIDATE;
    const uint32_t strong = code / STRONG & 1u;
    const uint32_t new = candidate &(near == 0);
    const uint32_t room = l->component_count < DROGUE_HLS_LABELS;
    const uint32_t label =
        drogue_hls_when((int)candidate) & (near | (l->component_count & drogue_hls_when((int)(new &room))));
    const uint32_t fresh = drogue_hls_when((int)new);
    drogue_merge *merge = &component_merges[l->component_merges];
    merge->a = near;
    merge->b = merge_with;
    l->component_merges += candidate & (merge_with != 0);
    component_parent[label & fresh] = label & fresh;
    component_strong[label & (fresh | drogue_hls_when((int)strong))] = (uint8_t)strong;
    component_row[x] = label;
    l->component_count += new &room;
    l->components_full |= new &(room ^ 1u);
    l->component_left = label;
    l->component_above[0] = l->component_above[1];
    l->component_above[1] = l->component_above[2];
    l->component_above[2] = known->component_root;
    l->component_next = known->component;
    l->component = label;
    l->code = code;
}

/* Merges of the row in a table of arcs. */
static uint32_t merges_of(const drogue_hls_labels *l, uint32_t in)
{
    return (l->arc_merges[0] & drogue_hls_when(in == 0)) | (l->arc_merges[1] & drogue_hls_when(in == 1)) |
           (l->arc_merges[2] & drogue_hls_when(in == 2)) | (l->arc_merges[3] & drogue_hls_when(in == 3));
}

static uint32_t same(uint32_t arc, uint32_t its_key, uint32_t key) { return arc & drogue_hls_when(its_key == key); }

/* The arc of the pixel whose component is known; 0 when it is in none, or the table is full. */
static void label_arc(drogue_hls_labels *l, uint32_t x, const drogue_hls_known *known)
{
    const uint32_t key = l->code >> KEY_SHIFT & 7u & drogue_hls_when(l->component != 0);
    const uint64_t chosen = drogue_hls_choose_label(
        same(l->arc_above[1], l->key_above[1], key), same(l->arc_left, l->key_left, key),
        same(l->arc_above[0], l->key_above[0], key), same(l->arc_above[2], l->key_above[2], key));
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t in = table(key);
    const uint32_t keyed = key != 0;
    const uint32_t new = keyed &(near == 0);
    const uint32_t fresh = drogue_hls_when((int)new);
    const uint32_t room = l->arc_count < DROGUE_HLS_LABELS;
    const uint32_t label = drogue_hls_when((int)keyed) & (near | (l->arc_count & drogue_hls_when((int)(new &room))));
    const uint32_t merges = keyed & (merge_with != 0);
    drogue_merge *merge = &arc_merges[in][merges_of(l, in)];
    l->arc_merges[0] += merges & (in == 0);
    l->arc_merges[1] += merges & (in == 1);
    l->arc_merges[2] += merges & (in == 2);
    l->arc_merges[3] += merges & (in == 3);
    merge->a = near;
    merge->b = merge_with;
    arc_parent[in][label & fresh] = label & fresh;
    arc_key[label & fresh] = (uint8_t)key;
    arc_component[label] = l->component; /* all points of an arc are in one component */
    arc_row[x] = label;
    key_row[x] = (uint8_t)key;
    l->arc_count += new &room;
    l->arcs_full |= new &(room ^ 1u);
    l->arc_left = label;
    l->key_left = key;
    l->arc_above[0] = l->arc_above[1];
    l->arc_above[1] = l->arc_above[2];
    l->arc_above[2] = known->arc_root;
    l->key_above[0] = l->key_above[1];
    l->key_above[1] = l->key_above[2];
    l->key_above[2] = l->key_next;
    l->arc_next = known->arc;
    l->key_next = known->key;
    l->table_next = table(known->key);
    l->arc = label;
}

void drogue_hls_labels_tick(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_known *known,
                            uint32_t code)
{
#pragma HLS array_partition variable = arc_parent complete dim = 1
#pragma HLS array_partition variable = arc_merges complete dim = 1
#pragma HLS bind_storage variable = component_parent type = ram_1wnr
#pragma HLS bind_storage variable = arc_parent type = ram_1wnr
/* Read: labels of the rows above. Written: new ones. */
#pragma HLS dependence variable = component_parent type = inter false
#pragma HLS dependence variable = arc_parent type = inter false
#ifndef __BAMBU__ /* LEAST_PERIOD less the three columns that a row is read ahead */
#pragma HLS dependence variable = component_row type = inter direction = RAW distance = 22 dependent = true
#pragma HLS dependence variable = arc_row type = inter direction = RAW distance = 22 dependent = true
#pragma HLS dependence variable = key_row type = inter direction = RAW distance = 22 dependent = true
#endif
    label_arc(l, w->x[AT_LABEL + 1], known);
    label_component(l, w->x[AT_LABEL], known, code);
}

void drogue_hls_labels_settle(const drogue_hls_labels *l)
{
    uint32_t k;
    drogue_labels_resolve(component_parent, component_merges, l->component_merges);
    for (k = 0; k < DROGUE_HLS_KEYS; k++) {
#ifndef __BAMBU__
#pragma HLS unroll
#endif
        drogue_labels_resolve(arc_parent[k], arc_merges[k], merges_of(l, k));
    }
}

void drogue_hls_labels_flatten(const drogue_hls_labels *l)
{
    const uint32_t components = l->component_count;
    const uint32_t arcs = l->arc_count;
    uint32_t i;
    for (i = 1; i < components; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        const uint32_t root = component_parent[component_parent[i]]; /* a smaller label, met before, or its own */
        const uint32_t strong = component_strong[i];
        component_parent[i] = root;
        component_strong[root] = (uint8_t)(component_strong[root] | strong);
    }
    arc_root[0] = 0;
    for (i = 1; i < arcs; i++) {
#pragma HLS loop_tripcount max = DROGUE_HLS_LABELS
        const uint32_t in = table(arc_key[i]);
        const uint32_t root = arc_parent[in][arc_parent[in][i]];
        const uint32_t strong = component_strong[component_parent[arc_component[i]]];
        arc_parent[in][i] = root;
        arc_root[i] = root & drogue_hls_when((int)strong);
    }
}

uint32_t drogue_hls_arc_root(uint32_t arc) { return arc_root[arc]; }

uint32_t drogue_hls_arc_key(uint32_t arc) { return arc_key[arc]; }
