/* SPDX-License-Identifier: Apache-2.0 */
/* The lists at the end of a frame: roots of the labels, points counted by arc, arc table, points sorted. */
#include "stages.h"

void drogue_hls_append(drogue_hls_lists *list, uint64_t point, uint32_t arc, drogue_hls_writes *write)
{
    const uint32_t room = list->points < DROGUE_HLS_EDGES;
    write->points = drogue_hls_write_of(list->points, point, 1);
    write->point_arc = drogue_hls_write_of(list->points, arc, 1);
    list->points += (uint32_t)(arc != 0) & room;
    list->points_full |= (uint32_t)(arc != 0) & (room ^ 1u);
}

/* A component's root, and that it is strong when a label of it is. Its parent is a smaller label, met before, or its own. */
static void find_component(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                           drogue_hls_writes *write)
{
    const uint32_t root = (uint32_t)read->component_parent_2;
    write->component_parent = drogue_hls_write_of(l->at[1], root, l->here[1]);
    write->component_strong = drogue_hls_write_of(root, 1, l->here[1] & l->strong);
    places->component_parent_2 = (uint32_t)read->component_parent;
    l->strong = (uint32_t)read->component_strong;
}

static void find_arc(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                     drogue_hls_writes *write)
{
    const uint32_t strong = (uint32_t)read->component_strong;
    write->arc_root = drogue_hls_write_of(l->at[2], l->root & drogue_hls_when((int)strong), l->here[2]);
    l->root = (uint32_t)read->arc_parent_2;
    write->arc_parent = drogue_hls_write_of(l->at[1], l->root, l->here[1]);
    write->arc_points = drogue_hls_write_of(l->at[1], 0, l->here[1]);
    places->component_strong = (uint32_t)read->component_parent;
    places->arc_parent_2 = (uint32_t)read->arc_parent;
    places->component_parent = (uint32_t)read->arc_component;
}

/* Give a point the root of its arc, 0 when its component is weak; count those of each arc. */
static void count_point(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                        drogue_hls_writes *write)
{
    write->arc_points = drogue_hls_write_of(l->root, read->arc_points + 1u, l->here[2]); /* of 0: for nobody */
    l->root = (uint32_t)read->arc_root;
    l->left += l->here[1] & (uint32_t)(l->root != 0);
    write->point_arc = drogue_hls_write_of(l->at[1], l->root, l->here[1]);
    places->arc_points = l->root;
    places->arc_root = (uint32_t)read->point_arc;
}

/* Fill the arc table; every arc's place in the list + 1, or 0. */
static void place_arc(drogue_hls_lists *l, uint32_t here, uint32_t min_arc_px, const drogue_hls_words *read,
                      drogue_hls_writes *write)
{
    const uint32_t long_enough =
        here & (uint32_t)(l->at[0] != 0) & (uint32_t)(read->arc_points != 0) & (uint32_t)(read->arc_points >= min_arc_px);
    const uint32_t room = l->arcs < DROGUE_HLS_ARCS;
    const uint32_t listed = long_enough & room;
    drogue_arc arc;
    arc.first = l->first;
    arc.count = (uint32_t)read->arc_points;
    arc.direction = ((uint32_t)read->arc_key - 1u) & 3u;
    write->arcs = drogue_hls_write_of(l->arcs, drogue_hls_pack_arc(&arc), listed);
    write->arc_place = drogue_hls_write_of(l->at[0], (l->first + 1u) & drogue_hls_when((int)listed), here);
    l->first += arc.count & drogue_hls_when((int)listed);
    l->last = l->first;
    l->arcs += listed;
    l->arcs_full |= long_enough & (room ^ 1u);
}

/* Write a point of a strong component to its place, those of no arc in the table last. */
static void sort_point(drogue_hls_lists *l, const drogue_hls_words *read, drogue_hls_places *places,
                       drogue_hls_writes *write)
{
    const uint32_t next = (uint32_t)read->arc_place;
    const uint32_t kept = l->here[1] & (uint32_t)(l->root != 0);
    const uint32_t listed = kept & (uint32_t)(next != 0);
    write->edges = drogue_hls_write_of(listed ? next - 1u : l->last, l->point, kept);
    write->arc_place = drogue_hls_write_of(l->root, next + 1u, listed);
    l->last += kept & (listed ^ 1u);
    l->root = (uint32_t)read->point_arc;
    l->point = read->points;
    places->arc_place = l->root;
}

uint32_t drogue_hls_lists_step(drogue_hls_lists *list, const drogue_hls_labels *labels, uint32_t phase,
                               uint32_t min_arc_px, const drogue_hls_words *read, drogue_hls_places *places,
                               drogue_hls_writes *write)
{
    const uint32_t entries = phase == PHASE_COMPONENTS                      ? labels->component_count
                             : phase == PHASE_ARCS || phase == PHASE_PLACE ? labels->arc_count
                                                                            : list->points;
    const uint32_t here = list->at[0] < entries;
    switch (phase) {
    case PHASE_COMPONENTS: find_component(list, read, places, write); break;
    case PHASE_ARCS: find_arc(list, read, places, write); break;
    case PHASE_COUNT: count_point(list, read, places, write); break;
    case PHASE_PLACE: place_arc(list, here, min_arc_px, read, write); break;
    default: sort_point(list, read, places, write); break;
    }
    list->here[2] = list->here[1];
    list->here[1] = here;
    list->at[2] = list->at[1];
    list->at[1] = list->at[0];
    list->at[0] += here;
    return (list->here[1] | list->here[2]) ^ 1u;
}
