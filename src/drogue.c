/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: what is tried, and what of that stands. */
#include "drogue/drogue.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/inner.h"
#include "look.h"

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *drogue_version(void)
{
    return VERSION_TEXT(DROGUE_VERSION_MAJOR, DROGUE_VERSION_MINOR, DROGUE_VERSION_PATCH);
}

/* What may be tried: the configured thresholds of Canny or those of the region's own noise, and of either the outline
 * found or a larger one about it; then, where the disc is far off its size or there is none, DISC, one about a disc
 * that is seen without an outline; at last, where the disc is too large for the best of them, BEYOND, one along rays.
 */
enum { FIRST, FIRST_LARGER, OWN, OWN_LARGER, BEYOND, DISC };

#define RAISES 2     /* at most, of thresholds of the noise that fill a table */
#define LARGEST 1530 /* L1 Sobel magnitude that there is: a corner's */

static void begin_try(drogue_frame *f)
{
    f->doubt_q16 = DROGUE_Q16_MAX;
    f->larger_q16 = 0;
}

/* What was tried is in the result from here on. */
static drogue_status judge(drogue_frame *f, int what)
{
    f->out->tried = what;
    return drogue_frame_judge(f);
}

/* Both thresholds, as far apart as the configured ones. */
static void set_thresholds(drogue_frame *f, int32_t high)
{
    const drogue_config *config = f->setup->config;
    f->canny_low = config->canny_high > 0 ? (int32_t)((int64_t)high * config->canny_low / config->canny_high) : 0;
    f->canny_high = high;
}

static drogue_status try_out(drogue_frame *f, const drogue_region *region, int what, int looked)
{
    drogue_status status = DROGUE_OK;
    begin_try(f);
    if (!looked) {
        drogue_result_clear(f->out);
        status = drogue_frame_outline(f, region);
    }
    if (status == DROGUE_OK && (what == FIRST_LARGER || what == OWN_LARGER)) {
        const drogue_region used = f->out->region;
        const drogue_edge_list list = f->out->list;
        drogue_result_clear(f->out);
        f->out->region = used;
        f->out->list = list;
        if (!drogue_outline_enlarge(&f->outline, f->workspace, &f->out->list, &f->mask, f->setup->config)) {
            return DROGUE_E_NO_ELLIPSE;
        }
    }
    return status == DROGUE_OK ? judge(f, what) : status;
}

static int is_full(drogue_status status)
{
    return status == DROGUE_E_LABELS_FULL || status == DROGUE_E_EDGES_FULL || status == DROGUE_E_ARCS_FULL;
}

/* By half; there is no sense in more than the largest magnitude. */
static int32_t raised(int32_t high) { return high > LARGEST ? INT32_MAX : high + high / 2 + 1; }

/* May it be tried? Lower thresholds than the configured ones, or where these filled a table higher ones. */
static int is_other(int32_t high, const drogue_frame *f, int full)
{
    const drogue_config *config = f->setup->config;
    return config->canny_least < config->canny_high && (full ? high <= LARGEST : high < config->canny_high);
}

/* Upper threshold of the region's own noise. */
static int32_t own_threshold(const drogue_frame *f, int full)
{
    const drogue_config *config = f->setup->config;
    int32_t high = drogue_noise_threshold(f->workspace->histogram, &f->view);
    high = high < config->canny_least ? config->canny_least : high;
    if (full && high <= config->canny_high) {
        high = raised(config->canny_high);
    }
    return high;
}

/* Look with other thresholds, raised where they fill a table, which 'room' then says. */
static drogue_status try_own(drogue_second_look *room, drogue_frame *f, const drogue_region *region, int32_t high,
                             int full)
{
    drogue_status status = DROGUE_OK;
    int k;
    for (k = 0; k <= RAISES && is_other(high, f, full); k++) { /* bound: 3 */
        set_thresholds(f, high);
        status = try_out(f, region, OWN, 0);
        if (!is_full(status)) {
            return status;
        }
        *room = *room == DROGUE_SECOND_NONE ? DROGUE_SECOND_FULL : *room;
        high = raised(high);
    }
    return status;
}

#define SURE_Q16 DROGUE_Q16(1, 256)    /* of less doubt nothing else is tried */
#define LEAST_Q16 DROGUE_Q16(2, 100)   /* by less the disc is too large for no other outline along rays */
#define BEYOND_Q16 DROGUE_Q16(15, 100) /* by more than this it is too large for anything beyond the outline */
#define DISC_Q16 DROGUE_Q16(4, 100)    /* of more doubt the disc is looked for without an outline */
#define CLEARLY_Q16 DROGUE_Q16(1, 256) /* a later try is better by more than this */

/* Take back what was measured. */
static void refuse(drogue_result *out)
{
    const drogue_region used = out->region;
    const drogue_edge_list list = out->list;
    const int32_t tried = out->tried;
    drogue_result_clear(out);
    out->region = used;
    out->list = list;
    out->tried = tried;
}

/* What the best try so far gave. */
typedef struct best_try {
    int what;
    drogue_q16 least_q16; /* its doubt; DROGUE_Q16_MAX: it has no outline */
    drogue_q16 larger_q16;
    drogue_region region;  /* where its edges were looked for */
    drogue_result *result; /* the workspace's, which leaves the stack free */
} best_try;

static void keep_try(best_try *best, const drogue_frame *f, int what, drogue_status status)
{
    best->what = what;
    best->least_q16 = f->doubt_q16;
    best->larger_q16 = f->larger_q16;
    best->region = f->asked;
    *best->result = *f->out;
    best->result->status = status;
    best->result->second_look = f->second_look;
}

/* What was best stands, and its edges are in the workspace again; where nothing was found they are those of the last
 * try. */
static void return_to(const best_try *best, drogue_frame *f, const drogue_region *region, int last)
{
    const int found = best->result->ellipse.a_px_q16 > 0; /* its arcs are in the list of that outline, pose or not */
    drogue_edge_list list;
    if (found && best->what != last && (last >= BEYOND || (best->what < OWN && last >= OWN))) {
        if (best->what < OWN) {
            set_thresholds(f, f->setup->config->canny_high);
        }
        (void)drogue_frame_edges(f, &best->region);
    } else if (!found && (f->others || last == DISC)) {
        (void)drogue_frame_edges(f, region);
    }
    list = f->out->list;
    *f->out = *best->result;
    f->out->list = list;
    f->second_look = best->result->second_look;
}

/* TOO_WIDE or FULL when a try had too little room: with more another might stand. */
static drogue_second_look short_of_room(const drogue_frame *f, drogue_status status)
{
    return is_full(status)                            ? DROGUE_SECOND_FULL
           : f->second_look >= DROGUE_SECOND_TOO_WIDE ? f->second_look
                                                      : DROGUE_SECOND_NONE;
}

/* Is the inner disc too large for the best outline, by no more than one about it explains? */
static int asks_beyond(const best_try *best)
{
    return best->result->status == DROGUE_OK && best->least_q16 > SURE_Q16 && best->larger_q16 > LEAST_Q16 &&
           best->larger_q16 <= BEYOND_Q16;
}

/* Is the disc to be looked for without an outline? Where the ring has no edge, too: it may not suit the drogue. */
static int asks_disc(const best_try *best, const drogue_frame *f)
{
    return best->least_q16 > DISC_Q16 && f->setup->model->inner_radius_m_q16 > 0;
}

/* Does a semi-axis differ by no more than a part of it? */
static int about_one_size(drogue_q16 a_px_q16, drogue_q16 of_px_q16, int32_t part)
{
    const drogue_q16 off = a_px_q16 > of_px_q16 ? a_px_q16 - of_px_q16 : of_px_q16 - a_px_q16;
    return off <= of_px_q16 / part;
}

/* Is the best outline without a disc, and does one say that it is another edge? One that is seen, but too large for it:
 * then it is an edge within the drogue, the canopy's or its wall's. Or one that was sought, whose rim is of quite
 * another size. */
static int is_another_edge(const best_try *best, const drogue_frame *f)
{
    if (best->result->status != DROGUE_OK || best->least_q16 != DROGUE_Q16_ONE) {
        return 0;
    }
    return best->larger_q16 > 0 ||
           (f->ring_px_q16 > 0 && !about_one_size(best->result->ellipse.a_px_q16, f->ring_px_q16, 8));
}

/* Does less show of an outline about the disc than of the best one, about as large? Both are edges of one rim then, and
 * the disc, which is not too large for it, may be a little off its place. */
static int shows_less(const drogue_result *about_disc, const best_try *best)
{
    return best->result->status == DROGUE_OK && best->larger_q16 == 0 &&
           about_one_size(about_disc->ellipse.a_px_q16, best->result->ellipse.a_px_q16, 16) &&
           about_disc->cover_q16 < best->result->cover_q16 / 8 * 7;
}

/* Look for the outline that the inner disc is of the size for. */
static void try_beyond(best_try *best, drogue_frame *f)
{
    const drogue_ellipse was = best->result->ellipse;
    const drogue_region region = best->region;
    drogue_status status;
    begin_try(f);
    drogue_result_clear(f->out);
    f->second_look = best->result->second_look;
    status = drogue_frame_beyond(f, &region, &was, best->larger_q16);
    if (status == DROGUE_OK) {
        f->outline.quality = best->result->quality; /* of the arcs that it was found from */
        f->outline.cluster_members = best->result->cluster_members;
        status = judge(f, BEYOND);
    }
    if (status == DROGUE_OK && f->doubt_q16 < best->least_q16 - CLEARLY_Q16) {
        keep_try(best, f, BEYOND, status);
    }
}

/* Look for the disc itself, and for an outline about it. DROGUE_E_NO_INNER_PART: there is none, the edges are as they
 * were. */
static drogue_status try_disc(best_try *best, drogue_frame *f, const drogue_region *region)
{
    drogue_status status;
    begin_try(f);
    drogue_result_clear(f->out);
    status = drogue_frame_about_disc(f, region);
    if (status == DROGUE_OK) {
        status = judge(f, DISC);
        if (status == DROGUE_OK && f->out->has_inner && f->out->doubt_q16 < DROGUE_CONTRADICTED_Q16 &&
            !shows_less(f->out, best)) {
            keep_try(best, f, DISC, status);
        }
    }
    return status;
}

/* Measure; while the inner disc is not seen or not of its size, try what else the outline may be. What has the disc
 * nearest to its size stands. */
static drogue_status measure(drogue_frame *f, const drogue_region *region)
{
    drogue_status status = DROGUE_OK;
    drogue_second_look room = DROGUE_SECOND_NONE;
    best_try best;
    int last = -1;
    int what;
    best.least_q16 = DROGUE_Q16_MAX;
    best.result = f->workspace->kept;
    set_thresholds(f, f->setup->config->canny_high);
    for (what = FIRST; what < BEYOND && best.least_q16 > SURE_Q16; what++) {
        const int larger = what == FIRST_LARGER || what == OWN_LARGER;
        if (larger && status != DROGUE_OK) {
            continue;
        }
        if (what == OWN) {
            const int full = is_full(best.result->status);
            const int32_t high = own_threshold(f, full);
            if (!is_other(high, f, full)) {
                break;
            }
            status = try_own(&room, f, region, high, full);
        } else {
            status = try_out(f, region, what, larger);
        }
        last = what;
        if (what == FIRST && status != DROGUE_OK && status != DROGUE_E_NO_ELLIPSE && status != DROGUE_E_NO_EDGES &&
            status != DROGUE_E_NO_ARCS && !is_full(status)) {
            return status;
        }
        if (what == FIRST || (f->doubt_q16 < best.least_q16 - CLEARLY_Q16 &&
                              (status == DROGUE_OK || best.result->status != DROGUE_OK))) {
            keep_try(&best, f, what, status);
        }
        if (room == DROGUE_SECOND_NONE) {
            room = short_of_room(f, status);
        }
    }
    if (asks_disc(&best, f)) {
        const drogue_edge_list list = f->out->list;
        status = try_disc(&best, f, region);
        if (status == DROGUE_E_NO_INNER_PART) {
            f->out->list = list;
        } else {
            last = DISC;
            room = room == DROGUE_SECOND_NONE ? short_of_room(f, status) : room;
        }
    }
    if (asks_beyond(&best) && f->workspace->capacity.edges >= DROGUE_INNER_BEYOND_POINTS) {
        try_beyond(&best, f);
        last = BEYOND;
    } else if (asks_beyond(&best) && room == DROGUE_SECOND_NONE) {
        room = DROGUE_SECOND_FULL;
    }
    return_to(&best, f, region, last);
    if (is_another_edge(&best, f)) {
        refuse(f->out);
        best.result->status = DROGUE_E_NO_ELLIPSE;
    }
    if (room != DROGUE_SECOND_NONE) {
        const int whole = best.result->status == DROGUE_OK && f->second_look <= DROGUE_SECOND_BETTER;
        f->second_look = whole ? DROGUE_SECOND_ROOM : room;
    }
    return best.result->status;
}

drogue_status drogue_measure(drogue_result *out, drogue_workspace *workspace, const drogue_setup *setup,
                             const drogue_image *image, const drogue_region *region)
{
    drogue_frame f;
    drogue_result_clear(out);
    memset(&f, 0, sizeof f);
    f.out = out;
    f.workspace = workspace;
    f.setup = setup;
    f.image = image;
    out->status = drogue_input_valid(image, setup) ? measure(&f, region) : DROGUE_E_ARGUMENT;
    out->second_look = f.second_look;
    return out->status;
}
