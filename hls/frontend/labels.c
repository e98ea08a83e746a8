/* SPDX-License-Identifier: Apache-2.0 */
/* Hysteresis and arcs: two union-finds in the pass. Within a row the parents of labels given before are only read, those
 * of new labels only written; the merges of a row are resolved at its end, at most one every other pixel in each of the
 * five tables. The label chosen is drogue_label_choose()'s; what does not hang on the label on the left is found out in the
 * ticks before. */
#include "stages.h"

enum { STRONG = 2, KEY_SHIFT = 2 };

void drogue_hls_labels_begin(drogue_hls_labels *l)
{
    static const drogue_hls_labels empty;
    *l = empty;
    l->component.count = 1;
    l->component.room = 1;
    l->arc.count = 1;
    l->arc.room = 1;
}

/* A merge in a word. */
static uint32_t pack_merge(uint32_t a, uint32_t b) { return a | b << 16; }

static uint32_t merge_a(uint32_t merge) { return drogue_hls_narrow(merge, LABEL_BITS); }

static uint32_t merge_b(uint32_t merge) { return drogue_hls_narrow(merge >> 16, LABEL_BITS); }

/* The merge that the pixel of the tick before found, from the labels that it met. */
static drogue_hls_write note_merge(drogue_hls_near *n)
{
    const uint32_t found = n->meets & (uint32_t)(n->met[0] != n->met[1]);
    const drogue_hls_write write = drogue_hls_write_of(n->merges, pack_merge(n->met[0], n->met[1]), found);
    n->merges = drogue_hls_narrow(n->merges + found, COLUMN_BITS);
    return write;
}

/* Label a pixel, 'candidate' 1 when it takes a label; a new one's parent is written, itself. */
static drogue_hls_write give(drogue_hls_near *n, uint32_t candidate)
{
    const uint32_t left = n->may_left & n->labelled;
    const uint32_t by_left = left & (n->fixed ^ 1u);
    const uint32_t none = candidate & ((left | n->is_near) ^ 1u);
    const uint32_t new = none &(n->may_right ^ 1u);
    const uint32_t given = new & n->room;
    const uint32_t label = (n->label & drogue_hls_when((int)(candidate & by_left))) |
                           (n->nearest & drogue_hls_when((int)(candidate & n->is_near & (by_left ^ 1u)))) |
                           (n->right & drogue_hls_when((int)(none & n->may_right))) |
                           (n->count & drogue_hls_when((int)given));
    const drogue_hls_write parent = drogue_hls_write_of(n->count, n->count, given);
    n->meets = candidate & n->may_right & (n->fixed ^ 1u) & (left | n->is_near);
    n->met[0] = left ? n->label : n->nearest;
    n->met[1] = n->right;
    n->label = label;
    n->labelled = candidate & (left | n->is_near | n->may_right | n->room);
    n->given = given;
    n->full |= new &(n->room ^ 1u);
    n->room &= (given & (uint32_t)(n->count == DROGUE_HLS_LABELS - 1u)) ^ 1u;
    n->count = drogue_hls_narrow(n->count + given, LABEL_BITS);
    return parent;
}

/* On to the next pixel: which labels can be its own. A root comes, and a label as stored. */
static void move_on(drogue_hls_near *n, uint32_t may_left, uint32_t may_above, uint32_t may_above_left,
                    uint32_t may_above_right, uint32_t root, uint32_t stored)
{
    n->may_left = may_left;
    n->fixed = n->has_right & may_above;
    n->is_near = n->fixed | (n->has_above & may_above_left);
    n->nearest = n->fixed ? n->right : n->above;
    n->may_right = n->coming & may_above_right;
    n->above = n->right;
    n->has_above = n->has_right;
    n->right = drogue_hls_narrow(root, LABEL_BITS);
    n->has_right = n->coming;
    n->coming = (uint32_t)(n->next != 0);
    n->next = drogue_hls_narrow(stored, LABEL_BITS);
}

/* A pixel's component, 0 when it is no candidate or the table is full. What the pixel before has is written. */
static void label_component(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_words *read,
                            drogue_hls_places *places, drogue_hls_writes *write)
{
    drogue_hls_near *n = &l->component;
    const uint32_t code = w->code[AT_LABEL];
    write->component_row = drogue_hls_write_of(w->x[AT_LABEL + 1], n->label, 1);
    write->component_strong = drogue_hls_write_of(n->label, l->strong, n->labelled & (n->given | l->strong));
    write->component_merges = note_merge(n);
    places->component_parent = n->next;
    write->component_parent = give(n, code & 1u);
    move_on(n, 1, 1, 1, 1, (uint32_t)read->component_parent, (uint32_t)read->component_row);
    l->strong = code / STRONG & 1u;
}

/* The arc of the pixel whose component is known; 0 when it has none, or the table is full. Every candidate has a key, and
 * that of a pixel without arc does not matter. */
static void label_arc(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_words *read,
                      drogue_hls_places *places, drogue_hls_writes *write)
{
    drogue_hls_near *n = &l->arc;
    const uint32_t key = w->code[AT_LABEL] >> KEY_SHIFT & 7u; /* of the pixel after */
    write->arc_row = drogue_hls_write_of(w->x[AT_LABEL + 2], n->label << 3 | l->key_of, 1);
    write->arc_component = drogue_hls_write_of(n->label, l->component_of, n->labelled); /* the same of all its points */
    write->arc_merges = note_merge(n);
    places->arc_parent = n->next;
    write->arc_parent = give(n, l->component.labelled);
    write->arc_key = drogue_hls_write_of(write->arc_parent.address, l->key, write->arc_parent.enable);
    move_on(n, (uint32_t)(l->key == key), (uint32_t)(l->key_right == key), (uint32_t)(l->key_above == key),
            (uint32_t)(l->key_coming == key), (uint32_t)read->arc_parent, (uint32_t)read->arc_row >> 3);
    l->key_above = l->key_right;
    l->key_right = l->key_coming;
    l->key_coming = l->key_next;
    l->key_next = (uint32_t)read->arc_row & 7u;
    l->component_of = l->component.label;
    l->key_of = l->key;
    l->key = key;
}

void drogue_hls_labels_tick(drogue_hls_labels *l, const drogue_hls_windows *w, const drogue_hls_words *read,
                            drogue_hls_places *places, drogue_hls_writes *write)
{
    label_arc(l, w, read, places, write);
    label_component(l, w, read, places, write);
}

void drogue_hls_settle_begin(drogue_hls_settling *s, uint32_t merges, uint32_t merge)
{
    static const drogue_hls_settling empty;
    *s = empty;
    s->at = 1;
    s->coming = (uint32_t)(merges > 1);
    s->here[0] = (uint32_t)(merges != 0);
    s->label[0] = merge_a(merge);
    s->label_2[0] = merge_b(merge);
    s->done = s->here[0] ^ 1u;
}

drogue_hls_settled drogue_hls_settle(drogue_hls_settling *s, uint32_t merges, uint32_t merge, uint32_t parent,
                                     uint32_t parent_2)
{
    const uint32_t back = s->back;
    /* A parent is what the merge before wrote, where it wrote that: too late for the look. All is compared at once. */
    const uint32_t late = (uint32_t)(s->label[2] == s->written_at);
    const uint32_t late_2 = (uint32_t)(s->label_2[2] == s->written_at);
    const uint32_t a = late ? s->written : s->parent;
    const uint32_t b = late_2 ? s->written : s->parent_2;
    const uint32_t less = s->parent < s->parent_2;
    const uint32_t less_late = s->written < s->parent_2;
    const uint32_t less_late_2 = s->parent < s->written;
    const uint32_t first_less = late ? less_late & (late_2 ^ 1u) : late_2 ? less_late_2 : less;
    const uint32_t low = first_less ? a : b;
    const uint32_t high = first_less ? b : a;
    const uint32_t written_at = back ? s->label_2[2] : high;
    const uint32_t written = back ? a : low;
    const uint32_t follow = s->here[0] | s->coming; /* others come after the merge that is in the second stage */
    const uint32_t turn = s->here[2] & ((s->here[1] | follow | back) ^ 1u); /* the last one's way forward ends */
    drogue_hls_settled now;
    now.parent = drogue_hls_write_of(written_at, written, s->here[2]);
    now.merge = drogue_hls_write_of(s->place[2], pack_merge(low, high), s->here[2] & (back ^ 1u));
    now.place = s->label[0] & drogue_hls_when((int)s->here[0]); /* 0 in the end: nothing is left of a row */
    now.place_2 = s->label_2[0];
    if (s->here[2]) {
        s->written_at = written_at;
        s->written = written;
    }
    s->done |= back & s->here[1] & (follow ^ 1u);
    s->here[2] = s->here[1];
    s->place[2] = s->place[1];
    s->label[2] = s->label[1];
    s->label_2[2] = s->label_2[1];
    s->parent = drogue_hls_narrow(parent, LABEL_BITS);
    s->parent_2 = drogue_hls_narrow(parent_2, LABEL_BITS);
    s->here[1] = s->here[0];
    s->place[1] = s->place[0];
    s->label[1] = s->label[0];
    s->label_2[1] = s->label_2[0];
    s->here[0] = s->coming;
    s->place[0] = s->at;
    s->label[0] = merge_a(merge);
    s->label_2[0] = merge_b(merge);
    s->coming = turn | (s->coming & (uint32_t)(back ? s->at != 0 : s->at + 1u < merges));
    s->at = drogue_hls_narrow(turn ? merges - 1u : back ? s->at - 1u : s->at + 1u, COLUMN_BITS);
    s->back |= turn;
    return now;
}
