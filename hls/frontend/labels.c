/* SPDX-License-Identifier: Apache-2.0 */
/* Hysteresis and arcs: two union-finds in the pass. Within a row the parents of labels given before are only read, those
 * of new labels only written; the merges of a row are resolved at its end, at most one every other pixel in each of the
 * five tables. */
#include "../choose_label.h"
#include "stages.h"

enum { CANDIDATE = 1, STRONG = 2, KEY_SHIFT = 2 };

void drogue_hls_labels_begin(drogue_hls_labels *l)
{
    static const drogue_hls_labels empty;
    *l = empty;
    l->component_count = 1;
    l->arc_count = 1;
}

/* A merge in a word. */
static uint32_t pack_merge(uint32_t a, uint32_t b) { return a | b << 16; }

/* The merge that the pixel of the tick before found, from the labels that it met. */
static uint32_t find_merge(drogue_hls_write *write, uint32_t merges, const uint32_t met[4])
{
    const uint64_t chosen = drogue_hls_choose_label(met[0], met[1], met[2], met[3]);
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    const uint32_t found = merge_with != 0;
    *write = drogue_hls_write_of(merges, pack_merge((uint32_t)(chosen & 0xFFFFFFFFu), merge_with), found);
    return drogue_hls_narrow(merges + found, COLUMN_BITS);
}

/* Note them for the tick after. */
static void meet(uint32_t met[4], uint32_t above, uint32_t left, uint32_t above_left, uint32_t above_right,
                 uint32_t mask)
{
    met[0] = above & mask;
    met[1] = left & mask;
    met[2] = above_left & mask;
    met[3] = above_right & mask;
}

uint32_t drogue_hls_row_merges(uint32_t merges, const uint32_t met[4])
{
    return (uint32_t)(merges != 0) | (uint32_t)(met[3] != 0);
}

/* A pixel's component, 0 when it is no candidate or the table is full, and its key: for the arc. */
static void label_component(drogue_hls_labels *l, uint32_t x, const drogue_hls_words *read, drogue_hls_writes *write,
                            uint32_t code)
{
    const uint64_t chosen =
        drogue_hls_choose_label(l->component_above[1], l->component_left, l->component_above[0], l->component_above[2]);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t candidate = code & CANDIDATE;
    const uint32_t strong = code / STRONG & 1u;
    const uint32_t new = candidate &(near == 0);
    const uint32_t room = l->component_count < DROGUE_HLS_LABELS;
    const uint32_t label =
        drogue_hls_when((int)candidate) & (near | (l->component_count & drogue_hls_when((int)(new &room))));
    const uint32_t fresh = drogue_hls_when((int)new);
    l->component_merges = find_merge(&write->component_merges, l->component_merges, l->component_met);
    meet(l->component_met, l->component_above[1], l->component_left, l->component_above[0], l->component_above[2],
         drogue_hls_when((int)candidate));
    write->component_parent = drogue_hls_write_of(label & fresh, label & fresh, 1);
    write->component_strong = drogue_hls_write_of(label & (fresh | drogue_hls_when((int)strong)), strong, 1);
    write->component_row = drogue_hls_write_of(x, label, 1);
    l->component_count = drogue_hls_narrow(l->component_count + (new &room), LABEL_BITS);
    l->components_full |= new &(room ^ 1u);
    l->component_left = label;
    l->component_above[0] = l->component_above[1];
    l->component_above[1] = l->component_above[2];
    l->component_above[2] = (uint32_t)read->component_parent;
    l->component_next = (uint32_t)read->component_row;
    l->component = label;
    l->key = code >> KEY_SHIFT & 7u & drogue_hls_when((int)(candidate & ((uint32_t)(near != 0) | room)));
}

static uint32_t same(uint32_t arc, uint32_t its_key, uint32_t key) { return arc & drogue_hls_when(its_key == key); }

/* The arc of the pixel whose component is known; 0 when it is in none, or the table is full. */
static void label_arc(drogue_hls_labels *l, uint32_t x, const drogue_hls_words *read, drogue_hls_writes *write)
{
    const uint32_t key = l->key;
    const uint32_t above = same(l->arc_above[1], l->key_above[1], key);
    const uint32_t left = same(l->arc_left, l->key_left, key);
    const uint32_t above_left = same(l->arc_above[0], l->key_above[0], key);
    const uint32_t above_right = same(l->arc_above[2], l->key_above[2], key);
    const uint64_t chosen = drogue_hls_choose_label(above, left, above_left, above_right);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t keyed = key != 0;
    const uint32_t new = keyed &(near == 0);
    const uint32_t fresh = drogue_hls_when((int)new);
    const uint32_t room = l->arc_count < DROGUE_HLS_LABELS;
    const uint32_t label = drogue_hls_when((int)keyed) & (near | (l->arc_count & drogue_hls_when((int)(new &room))));
    l->arc_merges = find_merge(&write->arc_merges, l->arc_merges, l->arc_met);
    meet(l->arc_met, above, left, above_left, above_right, drogue_hls_when((int)keyed));
    write->arc_parent = drogue_hls_write_of(label & fresh, label & fresh, 1);
    write->arc_key = drogue_hls_write_of(label & fresh, key, 1);
    write->arc_component = drogue_hls_write_of(label, l->component, 1); /* all points of an arc are in one component */
    write->arc_row = drogue_hls_write_of(x, label << 3 | key, 1);
    l->arc_count = drogue_hls_narrow(l->arc_count + (new &room), LABEL_BITS);
    l->arcs_full |= new &(room ^ 1u);
    l->arc_left = label;
    l->key_left = key;
    l->arc_above[0] = l->arc_above[1];
    l->arc_above[1] = l->arc_above[2];
    l->arc_above[2] = (uint32_t)read->arc_parent;
    l->key_above[0] = l->key_above[1];
    l->key_above[1] = l->key_above[2];
    l->key_above[2] = l->key_next;
    l->arc_next = (uint32_t)read->arc_row >> 3;
    l->key_next = (uint32_t)read->arc_row & 7u;
    l->arc = label;
    l->arc_fresh = new &room;
}

void drogue_hls_labels_tick(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_words *read,
                            drogue_hls_writes *write, uint32_t code)
{
    label_arc(l, w->x[AT_LABEL + 1], read, write);
    label_component(l, w->x[AT_LABEL], read, write, code);
}

void drogue_hls_settle_begin(drogue_hls_settling *s, uint32_t any)
{
    static const drogue_hls_settling empty;
    *s = empty;
    s->done = any ^ 1u;
}

drogue_hls_settled drogue_hls_settle(drogue_hls_settling *s, uint32_t merges, uint32_t merge, uint32_t parent,
                                     uint32_t parent_2)
{
    const uint32_t going = s->done ^ 1u;
    const uint32_t back = s->back;
    const uint32_t first_less = parent < parent_2;
    const uint32_t low = first_less ? parent : parent_2;
    const uint32_t high = first_less ? parent_2 : parent;
    const uint32_t there = going & (uint32_t)(back ? s->at != 0 : s->at < merges); /* a merge comes in */
    drogue_hls_settled now;
    now.parent = drogue_hls_write_of(back ? s->label : high, back ? parent : low, going & s->pending);
    now.merge = drogue_hls_write_of(s->merge, pack_merge(low, high), going & s->pending & (back ^ 1u));
    now.place = merge & 0xFFFFu;
    now.place_2 = merge >> 16;
    s->label = merge >> 16;
    s->merge = s->at;
    s->pending = there;
    s->at = drogue_hls_narrow(back ? s->at - there : s->at + there, COLUMN_BITS);
    s->done |= back & (there ^ 1u);
    s->back |= going & (there ^ 1u);
    return now;
}

uint32_t drogue_hls_settle_place(const drogue_hls_settling *s) { return s->at - s->back; }
