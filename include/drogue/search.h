/* SPDX-License-Identifier: Apache-2.0 */
/* Coarse search of a whole frame for the drogue: a dark disc inside a ring, over scales.
 *
 * Rows of pixels go in; block means of 2, 4, 8 ... 64 px a side come about in line buffers, one level for each octave
 * of the drogue's size. In each level a cell that is darker than a circle of eight cells about it, for one of three
 * radii (four in the first level), is a dark disc; rays from it look for the rim, and a circle through what they meet
 * gives centre and size.
 * The inner part is darker than the canopy on every background, so neither the canopy's own grey nor the
 * background's matters. The best few are regions for drogue_measure(). Where the rim is half lit or as grey as what is
 * behind it, the inner part is still a round disc that is darker than all about it by most of its grey: the best few
 * of these are kept by themselves. */
#ifndef DROGUE_SEARCH_H
#define DROGUE_SEARCH_H

#include "drogue/measure.h"
#include "drogue/rim.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_SEARCH_MAX 12   /* candidates */
#define DROGUE_SEARCH_DARK 4   /* and discs by themselves */
#define DROGUE_SEARCH_LEVELS 6 /* block means of 2 to 64 px a side: semi-axes from 12 to 800 px, to 780 in a region */

/* Bytes of memory for frames up to the given width: 100352 for 2048 px. Usable in a static array's size. */
#define DROGUE_SEARCH_BYTES(width_px) ((size_t)(width_px) * (DROGUE_SEARCH_ROWS + 1u))

/* A place where the drogue may be. */
typedef struct drogue_sighting {
    drogue_region region; /* for drogue_measure() */
    int32_t x_px;         /* middle of the outline, about */
    int32_t y_px;         /* downward */
    int32_t radius_px;    /* of the outline, about */
    uint32_t score;       /* by evenness and contrast of disc and rim; compares those of one list of one frame */
} drogue_sighting;

/* A search in progress; set by drogue_search_init(). */
typedef struct drogue_search {
    uint8_t *memory;     /* the caller's */
    int32_t capacity_px; /* widest frame */
    int32_t
        min_contrast;   /* 6 grey levels: least contrast of inner part and canopy, [0, 255]; the caller may change it */
    int32_t width_px;   /* of the frame in progress */
    int32_t rows_in;    /* fed so far, DROGUE_SEARCH_MOST_ROWS at most */
    int32_t count;      /* of sightings */
    int32_t dark_count; /* of dark discs */
    drogue_search_level levels[DROGUE_SEARCH_LEVELS]; /* from 2 to 64 px a cell */
    drogue_sighting best[DROGUE_SEARCH_MAX];          /* by falling score */
    /* Dark discs, by falling score; radius and region are the disc's until drogue_acquire() makes them the rim's. Of a
     * model without an inner part it keeps none. */
    drogue_sighting dark[DROGUE_SEARCH_DARK];
    drogue_region asked; /* drogue_acquire()'s work area: what is to be measured, */
    int32_t worth;       /* of the best result so far: orders results; 0: there is none with a pose */
    int32_t where;       /* it was measured: a number that drogue_acquire() gives the place */
    drogue_result found; /* drogue_track_frame()'s work area: what it acquired beside what it measured */
} drogue_search;

/* Lay a search out in the caller's memory, which must live as long as the search.
 *
 *  memory    at least DROGUE_SEARCH_BYTES(width_px) bytes of any alignment
 *  width_px  of the widest frame, [1, 32767]
 *  return    DROGUE_OK; DROGUE_E_WORKSPACE: too few bytes; DROGUE_E_ARGUMENT: memory NULL, width out of range
 */
drogue_status drogue_search_init(drogue_search *search, void *memory, size_t bytes, int32_t width_px);

/* Begin a frame; DROGUE_E_WORKSPACE when it is wider than the memory, DROGUE_E_ARGUMENT when width_px < 1,
 * min_contrast is out of range or the search was not set up. Refused, the search has no sightings: feed no rows. */
drogue_status drogue_search_begin(drogue_search *search, int32_t width_px);

#define DROGUE_SEARCH_MOST_ROWS 32767 /* of an image: what lies below could not be measured, and is not looked at */

/* Feed the next row, width_px grey levels; the row is copied. */
void drogue_search_row(drogue_search *search, const uint8_t *row);

/* End the frame: search->best[0 .. count - 1] are its sightings. Returns the count. */
int32_t drogue_search_end(drogue_search *search);

/* Log odds that a result is the drogue's pose: of many with as much the share 1 / (1 + exp(-L)) is right, to 3 % of its
 * distance and 10 degrees. Where an inner part is believed
 *
 *   L = (5 log2(r) + 9 cover - 2 outside + 10 seen - 14 spread - 7 ambiguity + 3 decided) / 4 - 5
 *
 * by what the result says: r is the radius of the inner part that the model expects in this outline, px, at least 1;
 * seen the share of rays that see its edge, spread how they scatter, px; decided 1 where the orientation is resolved
 * and the doubt below 1/64. Where none is believed -3 and the cover. Source: logistic regression, docs/accuracy.md.
 *
 *  r       of status DROGUE_OK
 *  return  Q16, within [-64, 64]; error 2 LSB and what 2^-14 px are of sqrt(a b), in log2(r), of which straight lines
 *          from one power to the next are taken, up to 0.086 below
 */
int32_t drogue_result_log_odds_q16(const drogue_result *r, const drogue_model *model);

#define DROGUE_SURE_Q16 DROGUE_Q16(5, 8) /* log odds of what is sure */

/* Is enough of a drogue seen in a measurement to begin with it? Log odds of 5/8; for a model without an inner part a
 * cover of 3/4 and a reliability of 0.9.
 *
 *  r  of status DROGUE_OK
 */
int drogue_result_sure(const drogue_result *r, const drogue_model *model);

/* Search a part of an image, and measure what was sighted:
 *
 *  - the sightings in order of score, until one is sure whose inner part decides the orientation and agrees with the
 *    outline; after that only what has 9/8 of the radius and more, and that in its middle half;
 *  - where nothing is sure yet, one after another until something is: the drogue that the model puts about each dark
 *    disc; the part itself where it has at most 512 px a side.
 *    Without an inner part in the model only the last, of DROGUE_MAX_SIDE a side at most.
 *
 * The result is the one of the largest log odds; for a model without an inner part that of most cover among those that
 * are sure, or else of all. Of equals the first stands.
 *
 *  out     as of drogue_measure(); with DROGUE_E_UNSURE, too, it is what was measured. Where nothing is measured or
 *          sure, second_look says of any place tried, or too large to be, that there was too little room for it
 *  region  where to search; NULL: the whole image. What is sighted there is measured with what lies about it
 *  return  DROGUE_OK when what was measured is sure; DROGUE_E_UNSURE: something was measured, but less than that;
 *          DROGUE_E_ARGUMENT, DROGUE_E_REGION, DROGUE_E_WORKSPACE (the search's width); else, of what was measured, the
 *          status that comes last in drogue_status: how far the best attempt got; and DROGUE_E_NO_INNER_PART where
 *          nothing was sighted
 */
drogue_status drogue_acquire(drogue_result *out, drogue_workspace *workspace, drogue_search *search,
                             const drogue_setup *setup, const drogue_image *image, const drogue_region *region);

#ifdef __cplusplus
}
#endif
#endif
