/* SPDX-License-Identifier: Apache-2.0 */
/* Coarse search of a whole frame for the drogue: a dark disc inside a ring, over scales.
 *
 * Rows of pixels go in; block means of 2, 4, 8 ... 64 px a side come about in line buffers, one level for each octave
 * of the drogue's size. In each level a cell that is darker than a circle of eight cells about it, for one of three
 * radii, is a dark disc; rays from it look for the rim, and a circle through what they meet gives centre and size.
 * The inner part is darker than the canopy on every background, so neither the canopy's own grey nor the
 * background's matters. The best few are regions for drogue_measure(). */
#ifndef DROGUE_SEARCH_H
#define DROGUE_SEARCH_H

#include "drogue/drogue.h"
#include "drogue/rim.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DROGUE_SEARCH_MAX 12   /* candidates */
#define DROGUE_SEARCH_LEVELS 6 /* block means of 2 to 64 px a side: semi-axes from 12 to 800 px */

/* Bytes of memory for frames up to the given width: 100352 for 2048 px. Usable in a static array's size. */
#define DROGUE_SEARCH_BYTES(width_px) ((size_t)(width_px) * (DROGUE_SEARCH_ROWS + 1u))

/* A place where the drogue may be. */
typedef struct drogue_sighting {
    drogue_region region; /* for drogue_measure() */
    int32_t x_px;         /* middle of the outline, about */
    int32_t y_px;         /* downward */
    int32_t radius_px;    /* of the outline, about */
    uint32_t score;       /* by evenness and contrast of disc and rim; compares sightings of one frame */
} drogue_sighting;

/* A search in progress; set by drogue_search_init(). */
typedef struct drogue_search {
    uint8_t *memory;     /* the caller's */
    int32_t capacity_px; /* widest frame */
    int32_t
        min_contrast; /* 6 grey levels: least contrast of inner part and canopy, [0, 255]; the caller may change it */
    int32_t width_px; /* of the frame in progress */
    int32_t rows_in;  /* fed so far */
    int32_t count;    /* of sightings */
    drogue_search_level levels[DROGUE_SEARCH_LEVELS]; /* from 2 to 64 px a cell */
    drogue_sighting best[DROGUE_SEARCH_MAX];          /* by falling score */
    drogue_result found; /* drogue_track_frame()'s work area: what it acquired beside what it measured */
} drogue_search;

/* Lay a search out in the caller's memory, which must live as long as the search.
 *
 *  memory    at least DROGUE_SEARCH_BYTES(width_px) bytes of any alignment
 *  width_px  of the widest frame, [1, 32767]
 *  return    DROGUE_OK, DROGUE_E_WORKSPACE (too few bytes), DROGUE_E_ARGUMENT
 */
drogue_status drogue_search_init(drogue_search *search, void *memory, size_t bytes, int32_t width_px);

/* Begin a frame; DROGUE_E_WORKSPACE when it is wider than the memory, DROGUE_E_ARGUMENT when width_px < 1 or
 * min_contrast is out of range. */
drogue_status drogue_search_begin(drogue_search *search, int32_t width_px);

/* Feed the next row, width_px grey levels; the row is copied. */
void drogue_search_row(drogue_search *search, const uint8_t *row);

/* End the frame: search->best[0 .. count - 1] are its sightings. Returns the count. */
int32_t drogue_search_end(drogue_search *search);

/* Is enough of a drogue seen in a measurement to begin with it? For a model with an inner part one that is dark (a
 * contrast of at least a quarter of the grey at its edge), sharp (a spread of at most 0.3 px) and near to the model's
 * size (its radius to 0.6 px and a tenth), within an outline covered to 0.75; where it decides the orientation and has
 * its size (to 0.3 px and a twenty-fifth) a cover of 0.6 will do, or, where it is not sharp, one of 0.9; where it is
 * sharp, decides and has 5 px and more, and its size to 0.2 px and a 64th, one of 0.5; one of 5 px and more which
 * decides need not be sharp within an outline of a cover of 31/32 and a reliability of 0.99. For a model without one a
 * cover of 0.75 and a reliability of 0.9.
 *
 *  r  of status DROGUE_OK
 */
int drogue_result_sure(const drogue_result *r, const drogue_model *model);

/* Search a part of an image, and measure what was sighted in order of score, until an inner part decides the
 * orientation within an outline covered to four fifths; after that only what was sighted about the same middle with
 * 9/8 to 2 times the radius. Of two sure outlines whose inner parts are within 1 px of each other and whose semi-axes
 * differ by more than an eighth the larger one is preferred, unless it has less cover, or an inner part less of its
 * size, by an eighth. What lies about the inner part of a sure outline that decides, to half its radius, and has less
 * than twice its radius and four fifths of that outline's semi-axis, is a part of that, whatever it is worth. Else the
 * result is the one of most cover among those that are sure and whose inner part decides; or else that are sure; or
 * else of all, an inner part counting as a quarter of cover, and one that decides as another. Where nothing is sure
 * and the model has an inner part, the first two sightings are measured once more in regions a quarter larger that the
 * workspace is wide enough for: what was sighted may be an edge within the drogue. The part itself is measured last,
 * with the drogue about its middle, where nothing is sure and the part is small, at most 512 px a side, or the model
 * has no inner part.
 *
 *  out     as of drogue_measure(); with DROGUE_E_UNSURE, too, it is what was measured
 *  region  where to search; NULL: the whole image. A part of more than DROGUE_MAX_SIDE a side is searched, but not
 *          measured itself
 *  return  DROGUE_OK when drogue_result_sure() of what was measured; DROGUE_E_UNSURE: something was measured, but less
 *          than that; DROGUE_E_ARGUMENT (the image), DROGUE_E_REGION, DROGUE_E_WORKSPACE (the search's width); else the
 *          status of the last, DROGUE_E_REGION where the part itself is too large, DROGUE_E_NO_INNER_PART where nothing
 *          was sighted
 */
drogue_status drogue_acquire(drogue_result *out, drogue_search *search, drogue_workspace *workspace,
                             const drogue_setup *setup, const drogue_image *image, const drogue_region *region);

#ifdef __cplusplus
}
#endif
#endif
