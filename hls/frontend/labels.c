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

/* A pixel's component, 0 when it is no candidate or the table is full, and its code: for the arc. */
static void label_component(drogue_hls_labels *l, uint32_t x, const drogue_hls_words *read, drogue_hls_writes *write,
                            uint32_t code)
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
    const uint32_t merges = candidate & (merge_with != 0);
    write->component_merges = drogue_hls_write_of(l->component_merges, pack_merge(near, merge_with), merges);
    l->component_merges += merges;
    write->component_parent = drogue_hls_write_of(label & fresh, label & fresh, 1);
    write->component_strong = drogue_hls_write_of(label & (fresh | drogue_hls_when((int)strong)), strong, 1);
    write->component_row = drogue_hls_write_of(x, label, 1);
    l->component_count += new &room;
    l->components_full |= new &(room ^ 1u);
    l->component_left = label;
    l->component_above[0] = l->component_above[1];
    l->component_above[1] = l->component_above[2];
    l->component_above[2] = (uint32_t)read->component_parent;
    l->component_next = (uint32_t)read->component_row;
    l->component = label;
    l->code = code;
}

static uint32_t same(uint32_t arc, uint32_t its_key, uint32_t key) { return arc & drogue_hls_when(its_key == key); }

/* The arc of the pixel whose component is known; 0 when it is in none, or the table is full. */
static void label_arc(drogue_hls_labels *l, uint32_t x, const drogue_hls_words *read, drogue_hls_writes *write)
{
    const uint32_t key = l->code >> KEY_SHIFT & 7u & drogue_hls_when(l->component != 0);
    const uint64_t chosen = drogue_hls_choose_label(
        same(l->arc_above[1], l->key_above[1], key), same(l->arc_left, l->key_left, key),
        same(l->arc_above[0], l->key_above[0], key), same(l->arc_above[2], l->key_above[2], key));
    const uint32_t merge_with = (uint32_t)(chosen >> 32);
    const uint32_t near = (uint32_t)(chosen & 0xFFFFFFFFu);
    const uint32_t keyed = key != 0;
    const uint32_t new = keyed &(near == 0);
    const uint32_t fresh = drogue_hls_when((int)new);
    const uint32_t room = l->arc_count < DROGUE_HLS_LABELS;
    const uint32_t label = drogue_hls_when((int)keyed) & (near | (l->arc_count & drogue_hls_when((int)(new &room))));
    const uint32_t merges = keyed & (merge_with != 0);
    write->arc_merges = drogue_hls_write_of(l->arc_merges, pack_merge(near, merge_with), merges);
    l->arc_merges += merges;
    write->arc_parent = drogue_hls_write_of(label & fresh, label & fresh, 1);
    write->arc_key = drogue_hls_write_of(label & fresh, key, 1);
    write->arc_component = drogue_hls_write_of(label, l->component, 1); /* all points of an arc are in one component */
    write->arc_row = drogue_hls_write_of(x, label << 3 | key, 1);
    l->arc_count += new &room;
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

void drogue_hls_settle_begin(drogue_hls_settling *s, uint32_t merges)
{
    static const drogue_hls_settling empty;
    *s = empty;
    s->done = merges == 0;
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
    s->at = back ? s->at - there : s->at + there;
    s->done |= back & (there ^ 1u);
    s->back |= going & (there ^ 1u);
    return now;
}

uint32_t drogue_hls_settle_place(const drogue_hls_settling *s) { return s->at - s->back; }
