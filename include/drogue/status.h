/* SPDX-License-Identifier: Apache-2.0 */
/* What a call can answer: one named status, the same set for every stage. */
#ifndef DROGUE_STATUS_H
#define DROGUE_STATUS_H

#ifdef __cplusplus
extern "C" {
#endif

/* Status of a call. */
typedef enum drogue_status {
    DROGUE_OK = 0,
    DROGUE_E_ARGUMENT,  /* an argument is outside its documented range */
    DROGUE_E_REGION,    /* the region does not meet the image, is larger than DROGUE_MAX_REGION or its part in the image
                             than DROGUE_MAX_SIDE, or ends beyond pixel 32766 */
    DROGUE_E_WORKSPACE, /* the workspace is too small for the region */
    DROGUE_E_LABELS_FULL,    /* more components or arcs than the workspace holds */
    DROGUE_E_EDGES_FULL,     /* more edge points than the workspace holds */
    DROGUE_E_ARCS_FULL,      /* more long arcs than the workspace holds */
    DROGUE_E_NO_EDGES,       /* no edge point in the ring mask */
    DROGUE_E_NO_ARCS,        /* no arc meets length, straightness and position */
    DROGUE_E_NO_ELLIPSE,     /* no combination of arcs gives an acceptable ellipse */
    DROGUE_E_TOO_FEW_POINTS, /* fewer than the six points a conic needs */
    DROGUE_E_DEGENERATE,     /* the points do not determine an ellipse */
    DROGUE_E_NO_INNER_PART,  /* no disc where one is expected: fewer than eight rays agree; or nothing sighted */
    DROGUE_E_DOMAIN,         /* a value outside the domain of the function */
    DROGUE_E_BEHIND_CAMERA,  /* the geometry puts the drogue behind the camera */
    DROGUE_E_UNSURE,         /* a search measured something, but not enough of a drogue is seen in it */
    DROGUE_STATUS_COUNT
} drogue_status;

/* Did a table of the workspace fill? */
static inline int drogue_status_full(drogue_status status)
{
    return status == DROGUE_E_LABELS_FULL || status == DROGUE_E_EDGES_FULL || status == DROGUE_E_ARCS_FULL;
}

/* Name of a status in lower case, such as "no_ellipse"; never NULL.
 *
 *  status  any value; one outside the enumeration gives "unknown"
 */
const char *drogue_status_name(drogue_status status);

/* What became of the second look at an outline that the region's ring mask cuts (measure.h). */
typedef enum drogue_second_look {
    DROGUE_SECOND_NONE = 0, /* none was called for: the outline suits its region, or there is too little of it */
    DROGUE_SECOND_BETTER,   /* it found the same outline and no less of it: the result is its */
    DROGUE_SECOND_NO_MORE,  /* it found nothing, another outline or less of it: what was found first stands */
    DROGUE_SECOND_REGION,   /* its region cannot be measured, see DROGUE_E_REGION: what was found first stands */
    DROGUE_SECOND_TOO_WIDE, /* the workspace is too narrow for its region: what was found first stands, maybe half an
                               outline */
    DROGUE_SECOND_FULL,     /* a table was full: what was found first stands, maybe half an outline */
    DROGUE_SECOND_ROOM, /* nothing cuts what stands, but there was too little room for something else that was tried:
                               a table was full, or the workspace too narrow, or it has less than
                               DROGUE_INNER_BEYOND_POINTS edges, as that of regions up to 50 px, for a larger outline */
    DROGUE_SECOND_COUNT
} drogue_second_look;

/* Name of it in lower case, such as "too_wide"; never NULL; any other value gives "unknown". */
const char *drogue_second_look_name(drogue_second_look look);

/* Note where an attempt had too little room, by its status or its second look: with more another result might stand.
 * What was first in want of it stays noted.
 *
 *  room  in and out: DROGUE_SECOND_NONE until there was too little
 */
void drogue_note_room(drogue_second_look *room, drogue_status status, drogue_second_look look);

#ifdef __cplusplus
}
#endif
#endif
