/* SPDX-License-Identifier: Apache-2.0 */
/* The lists at the end of a frame: roots of the labels, the arcs' points, arc table, points sorted. */
#include "stages.h"

void drogue_hls_append(drogue_hls_lists *list, uint64_t point, const drogue_hls_labels *labels,
                       const drogue_hls_words *read, drogue_hls_writes *write)
{
    const uint32_t arc = labels->arc;
    const uint32_t room = list->points < DROGUE_HLS_EDGES;
    const uint32_t listed = (uint32_t)(arc != 0) & room;
    const uint32_t before = (uint32_t)read->arc_points & drogue_hls_when(labels->arc_fresh == 0);
    write->points = drogue_hls_write_of(list->points, point, 1);
    write->point_arc = drogue_hls_write_of(list->points, arc, 1);
    write->arc_points = drogue_hls_write_of(arc, before + listed, 1);
    list->points = drogue_hls_narrow(list->points + listed, POINT_BITS);
    list->points_full |= (uint32_t)(arc != 0) & (room ^ 1u);
}

/* A component's root, and that it is strong when a label of it is. Its parent is a smaller label, met before, or its own. */
static void find_component(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                           drogue_hls_writes *write)
{
    const uint32_t root = (uint32_t)read->component_parent_2;
    write->component_parent = drogue_hls_write_of(l->at[2], root, l->here[2]);
    write->component_strong = drogue_hls_write_of(root, 1, l->here[2] & l->strong);
    places->component_parent_2 = (uint32_t)read->component_parent;
    l->strong = (uint32_t)read->component_strong;
}

/* An arc's root, 0 when its component is weak; its points are the root's. */
static void find_arc(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                     drogue_hls_writes *write)
{
    const uint32_t strong = drogue_hls_when((int)(read->component_strong != 0 && l->here[3]));
    write->arc_root = drogue_hls_write_of(l->at[3], l->root & strong, l->here[3]);
    write->arc_points =
        drogue_hls_write_of(l->root, read->arc_points_2 + l->count[1], l->here[3] & (uint32_t)(l->root != l->at[3]));
    l->left = drogue_hls_narrow(l->left + (l->count[1] & strong), POINT_BITS);
    l->count[1] = l->count[0];
    l->count[0] = (uint32_t)read->arc_points;
    l->root = (uint32_t)read->arc_parent_2;
    write->arc_parent = drogue_hls_write_of(l->at[2], l->root, l->here[2]);
    places->arc_points_2 = l->root;
    places->component_strong = (uint32_t)read->component_parent;
    places->arc_parent_2 = (uint32_t)read->arc_parent;
    places->component_parent = (uint32_t)read->arc_component;
}

/* Fill the arc table; every arc's place in the list + 1, or 0. */
static void place_arc(drogue_hls_lists *l, uint32_t min_arc_px, const drogue_hls_words *read, drogue_hls_writes *write)
{
    const uint32_t long_enough = l->here[2] & (uint32_t)(l->at[2] != 0) & l->is_root & l->strong;
    const uint32_t room = l->arcs < DROGUE_HLS_ARCS;
    const uint32_t listed = long_enough & room;
    drogue_arc arc;
    arc.first = l->first;
    arc.count = l->count[0];
    arc.direction = (l->key - 1u) & 3u;
    write->arcs = drogue_hls_write_of(l->arcs, drogue_hls_pack_arc(&arc), listed);
    write->arc_place = drogue_hls_write_of(l->at[2], (l->first + 1u) & drogue_hls_when((int)listed), l->here[2]);
    l->first = drogue_hls_narrow(l->first + (arc.count & drogue_hls_when((int)listed)), POINT_BITS);
    l->last = l->first;
    l->arcs = drogue_hls_narrow(l->arcs + listed, ARC_BITS);
    l->arcs_full |= long_enough & (room ^ 1u);
    l->is_root = (uint32_t)read->arc_root == l->at[1];
    l->count[0] = (uint32_t)read->arc_points;
    l->strong = (uint32_t)(l->count[0] != 0) & (uint32_t)(l->count[0] >= min_arc_px);
    l->key = (uint32_t)read->arc_key;
}

/* Write a point of a strong component to its place, those of no arc in the table last. */
static void sort_point(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                       drogue_hls_writes *write)
{
    const uint32_t listed = (uint32_t)(l->next != 0);
    write->edges = drogue_hls_write_of(listed ? l->next - 1u : l->last, l->point[2], l->here[4] & l->kept);
    l->last = drogue_hls_narrow(l->last + (l->here[4] & l->kept & (listed ^ 1u)), POINT_BITS);
    l->point[2] = l->point[1];
    l->next = (uint32_t)read->arc_place;
    l->kept = l->root != 0;
    write->arc_place = drogue_hls_write_of(l->root, l->next + 1u, l->here[3] & l->kept & (uint32_t)(l->next != 0));
    l->point[1] = l->point[0];
    l->point[0] = read->points;
    l->root = (uint32_t)read->arc_root;
    places->arc_place = l->root;
    places->arc_root = (uint32_t)read->point_arc;
}

uint32_t drogue_hls_lists_step(drogue_hls_lists *list, const drogue_hls_labels *labels, uint32_t phase,
                               uint32_t min_arc_px, const drogue_hls_words *read, drogue_hls_places *places,
                               drogue_hls_writes *write)
{
    const uint32_t entries = phase == PHASE_COMPONENTS                     ? labels->component_count
                             : phase == PHASE_ARCS || phase == PHASE_PLACE ? labels->arc_count
                                                                           : list->points;
    const uint32_t here = list->at[0] < entries;
    switch (phase) {
    case PHASE_COMPONENTS: find_component(list, read, places, write); break;
    case PHASE_ARCS: find_arc(list, read, places, write); break;
    case PHASE_PLACE: place_arc(list, min_arc_px, read, write); break;
    default: sort_point(list, read, places, write); break;
    }
    list->here[4] = list->here[3];
    list->here[3] = list->here[2];
    list->here[2] = list->here[1];
    list->here[1] = here;
    list->at[3] = list->at[2];
    list->at[2] = list->at[1];
    list->at[1] = list->at[0];
    list->at[0] = drogue_hls_narrow(list->at[0] + here, ENTRY_BITS);
    return (list->here[1] | list->here[2] | list->here[3] | list->here[4]) ^ 1u;
}
