/* SPDX-License-Identifier: Apache-2.0 */
/* Points and their number in each arc; the lists at the end of a frame: roots of the labels, the arcs' points, arc table,
 * points sorted. */
#include "stages.h"

void drogue_hls_lists_begin(drogue_hls_lists *list)
{
    list->points = 0;
    list->points_full = 0;
    list->arcs = 0;
    list->arcs_full = 0;
    list->first = 0;
    list->last = 0;
    list->left = 0;
}

uint32_t drogue_hls_append(drogue_hls_lists *list, uint64_t point, const drogue_hls_near *arc, drogue_hls_writes *write)
{
    const uint32_t room = list->points < DROGUE_HLS_EDGES;
    const uint32_t listed = arc->labelled & room;
    write->points = drogue_hls_write_of(list->points, point, 1);
    write->point_arc = drogue_hls_write_of(list->points, arc->label, 1);
    list->points = drogue_hls_narrow(list->points + listed, POINT_BITS);
    list->points_full |= arc->labelled & (room ^ 1u);
    return listed;
}

void drogue_hls_count(drogue_hls_lists *list, uint32_t arc, uint32_t listed, uint32_t anew,
                      const drogue_hls_words *read, drogue_hls_places *places, drogue_hls_writes *write)
{
    list->sum = drogue_hls_narrow((list->again ? list->sum : list->before) + list->counts[1], POINT_BITS);
    write->arc_points = drogue_hls_write_of(list->counted[1], list->sum, 1);
    list->before = drogue_hls_narrow((uint32_t)read->arc_points, POINT_BITS) & drogue_hls_when(list->anew == 0);
    list->again = (uint32_t)(list->counted[0] == list->counted[1]);
    list->counted[1] = list->counted[0];
    list->counts[1] = list->counts[0];
    list->counted[0] = arc;
    list->counts[0] = listed;
    list->anew = anew;
    places->arc_points = list->counted[0];
}

/* The root of an entry in the fourth stage: its parent's parent, which is what the entry before has found where that is the
 * parent; it came too late for the look. A parent is a smaller label, met before, or its own. */
static uint32_t find_root(drogue_hls_lists *l, uint32_t parent, uint32_t grandparent)
{
    const uint32_t root = l->follows[1] ? l->root[0] : l->grandparent;
    l->root[0] = root;
    l->grandparent = drogue_hls_narrow(grandparent, LABEL_BITS);
    l->follows[1] = l->follows[0];
    l->follows[0] = (uint32_t)(l->parent == l->at[3]) & l->here[3];
    l->parent = drogue_hls_narrow(parent, LABEL_BITS);
    return root;
}

/* A component's root, and that it is strong when a label of it is. */
static void find_component(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                           drogue_hls_writes *write)
{
    uint32_t root;
    places->component_parent = l->at[0];
    places->component_strong = l->at[0];
    places->component_parent_2 = l->parent;
    root = find_root(l, (uint32_t)read->component_parent, (uint32_t)read->component_parent_2);
    write->component_parent = drogue_hls_write_of(l->at[4], root, l->here[4]);
    write->component_strong = drogue_hls_write_of(root, 1, l->here[4] & l->strong[2]);
    l->strong[2] = l->strong[1];
    l->strong[1] = l->strong[0];
    l->strong[0] = (uint32_t)read->component_strong & 1u;
}

/* An arc's root, 0 when its component is weak; its points are the root's. */
static void find_arc(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                     drogue_hls_writes *write)
{
    const uint32_t strong = drogue_hls_when((int)(l->strong[0] & l->here[6]));
    uint32_t k;
    places->arc_parent = l->at[0];
    places->arc_points = l->at[0];
    places->arc_parent_2 = l->parent;
    places->component_parent = l->component[0];
    places->component_strong = l->component[1];
    places->arc_points_2 = l->root[0];
    l->sum = drogue_hls_narrow((l->again ? l->sum : l->before) + l->count[5], POINT_BITS);
    write->arc_points = drogue_hls_write_of(l->root[2], l->sum, l->here[7] & (l->is_root ^ 1u));
    write->arc_root = drogue_hls_write_of(l->at[6], l->root[1] & strong, l->here[6]);
    l->left = drogue_hls_narrow(l->left + (l->count[4] & strong), POINT_BITS);
    /* What the root's points are by the entry before, which came too late for the look; a root adds nothing to itself. */
    l->again = (uint32_t)(l->root[1] == l->root[2]) & (l->is_root ^ 1u) & l->here[7];
    l->is_root = (uint32_t)(l->root[1] == l->at[6]);
    l->before = drogue_hls_narrow((uint32_t)read->arc_points_2, POINT_BITS);
    l->root[2] = l->root[1];
    l->root[1] = l->root[0];
    l->strong[0] = (uint32_t)read->component_strong & 1u;
    write->arc_parent = drogue_hls_write_of(
        l->at[4], find_root(l, (uint32_t)read->arc_parent, (uint32_t)read->arc_parent_2), l->here[4]);
    l->component[1] = drogue_hls_narrow((uint32_t)read->component_parent, LABEL_BITS);
    l->component[0] = drogue_hls_narrow((uint32_t)read->arc_component, LABEL_BITS);
    for (k = 5; k > 0; k--) {
        l->count[k] = l->count[k - 1];
    }
    l->count[0] = drogue_hls_narrow((uint32_t)read->arc_points, POINT_BITS);
}

/* Fill the arc table; every arc's place in the list + 1, or 0. */
static void place_arc(drogue_hls_lists *l, uint32_t min_arc_px, const drogue_hls_words *read, drogue_hls_places *places,
                      drogue_hls_writes *write)
{
    const uint32_t long_enough = l->here[3] & l->is_root & l->strong[0];
    const uint32_t room = l->arcs < DROGUE_HLS_ARCS;
    const uint32_t listed = long_enough & room;
    drogue_arc arc;
    arc.first = l->first;
    arc.count = l->count[1];
    arc.direction = (l->key[1] - 1u) & 3u;
    places->arc_points = l->at[0];
    places->arc_root = l->at[0];
    places->arc_key = l->at[0];
    write->arcs = drogue_hls_write_of(l->arcs, drogue_hls_pack_arc(&arc), listed);
    write->arc_place = drogue_hls_write_of(l->at[3], (l->first + 1u) & drogue_hls_when((int)listed), l->here[3]);
    l->first = drogue_hls_narrow(l->first + (arc.count & drogue_hls_when((int)listed)), POINT_BITS);
    l->last = l->first;
    l->arcs = drogue_hls_narrow(l->arcs + listed, ARC_BITS);
    l->arcs_full |= long_enough & (room ^ 1u);
    l->is_root = (uint32_t)(l->label == l->at[2]) & (uint32_t)(l->at[2] != 0);
    l->strong[0] = (uint32_t)(l->count[0] != 0) & (uint32_t)(l->count[0] >= min_arc_px);
    l->count[1] = l->count[0];
    l->key[1] = l->key[0];
    l->label = drogue_hls_narrow((uint32_t)read->arc_root, LABEL_BITS);
    l->count[0] = drogue_hls_narrow((uint32_t)read->arc_points, POINT_BITS);
    l->key[0] = (uint32_t)read->arc_key & 7u;
}

/* Write a point of a strong component to its place, those of no arc in the table last. */
static void sort_point(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                       drogue_hls_writes *write)
{
    const uint32_t next = l->again ? l->sum : l->next[0];
    const uint32_t has_next = l->again ? l->has_next : (uint32_t)(l->next[0] != 0);
    const uint32_t kept = (uint32_t)(l->root[2] != 0) & l->here[6];
    places->point_arc = l->at[0];
    places->arc_root = l->label;
    places->arc_place = l->root[0];
    places->points = l->at[4];
    write->edges = drogue_hls_write_of(l->has_next ? l->next[1] - 1u : l->last, l->point[1], l->kept);
    l->last = drogue_hls_narrow(l->last + (l->kept & (l->has_next ^ 1u)), POINT_BITS);
    write->arc_place = drogue_hls_write_of(l->root[2], next + 1u, kept & has_next);
    /* The arc's next place by the point before, which came too late for the look. */
    l->sum = drogue_hls_narrow(next + 1u, POINT_BITS);
    l->again = (uint32_t)(l->root[1] == l->root[2]) & l->here[6];
    l->next[1] = next;
    l->has_next = has_next;
    l->kept = kept;
    l->point[1] = l->point[0];
    l->next[0] = drogue_hls_narrow((uint32_t)read->arc_place, POINT_BITS);
    l->point[0] = read->points;
    l->root[2] = l->root[1];
    l->root[1] = l->root[0];
    l->root[0] = drogue_hls_narrow((uint32_t)read->arc_root, LABEL_BITS);
    l->label = drogue_hls_narrow((uint32_t)read->point_arc, LABEL_BITS);
}

uint32_t drogue_hls_lists_step(drogue_hls_lists *list, uint32_t phase, uint32_t min_arc_px,
                               const drogue_hls_words *read, drogue_hls_places *places, drogue_hls_writes *write)
{
    const uint32_t here = list->at[0] < list->entries;
    uint32_t busy = here;
    int k;
    if (phase & PHASE_COMPONENTS) {
        drogue_hls_count(list, 0, 0, 0, read, places, write);
        find_component(list, read, places, write);
    } else if (phase & PHASE_ARCS) {
        find_arc(list, read, places, write);
    } else if (phase & PHASE_PLACE) {
        place_arc(list, min_arc_px, read, places, write);
    } else {
        sort_point(list, read, places, write);
    }
    for (k = LIST_STAGES; k > 0; k--) {
        list->here[k] = k == 1 ? here : list->here[k - 1];
        list->at[k] = list->at[k - 1];
        busy |= list->here[k];
    }
    list->at[0] = drogue_hls_narrow(list->at[0] + here, ENTRY_BITS);
    return busy ^ 1u;
}
