/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: what is tried, and what of that stands. */
#include "drogue/measure.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/inner.h"
#include "drogue/noise.h"
#include "look.h"

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *drogue_version(void)
{
    return VERSION_TEXT(DROGUE_VERSION_MAJOR, DROGUE_VERSION_MINOR, DROGUE_VERSION_PATCH);
}

/* Of what was measured only the region used stays. */
static void forget(drogue_result *out)
{
    const drogue_region used = out->region;
    drogue_result_clear(out);
    out->region = used;
}

#define RAISES 2 /* at most, of thresholds of the noise that fill a table */
#define LARGER 8 /* a rim whose semi-axis is longer by more than this part of it is another one */

#define SURE_Q16 DROGUE_Q16(1, 256)   /* of less doubt nothing else is tried */
#define LEAST_Q16 DROGUE_Q16(2, 100)  /* by less the disc is too large for no other outline along rays */
#define DISC_Q16 DROGUE_Q16(4, 100)   /* of more doubt the disc is looked for without an outline, and a wider region */
#define FOUND_Q16 DROGUE_Q16(10, 100) /* of less an outline that was found in a region of another size stands */
#define ALONE_Q16 DROGUE_Q16(7, 10)   /* least cover of an outline whose disc is not seen */
#define STILL_Q16 (11 * DROGUE_CONTRADICTION_Q16 / 10) /* hardly more than a contradiction: of its size */
#define CLEARLY_Q16 DROGUE_Q16(1, 256)                 /* a later try is better by more than this */

/* Is an edge of the frame's outline seen twice, by motion or by what looks like it? */
static int seems_smeared(const drogue_frame *f)
{
    return drogue_support_smear(&f->outline.support) > DROGUE_SMEARED_Q16;
}

static void keep(drogue_best_try *best, const drogue_frame *f, drogue_status status)
{
    best->least_q16 = f->doubt_q16;
    best->larger_q16 = f->larger_q16;
    best->smeared = seems_smeared(f);
    best->held = f->held;
    best->result = *f->out;
    best->result.status = status;
    best->result.second_look = f->second_look;
}

/* A try has ended. */
static void end_try(drogue_best_try *best, drogue_frame *f, drogue_status status, int is_best)
{
    drogue_note_room(&f->room, status, f->second_look);
    if (is_best) {
        keep(best, f, status);
    }
}

/* Is a try's doubt clearly less than the best one's? */
static int is_clearer(const drogue_best_try *best, const drogue_frame *f)
{
    return f->doubt_q16 < best->least_q16 - CLEARLY_Q16;
}

/* It is the best one where its doubt is clearly less, but never without a pose where that has one. */
static void consider(drogue_best_try *best, drogue_frame *f, drogue_status status)
{
    end_try(best, f, status, is_clearer(best, f) && (status == DROGUE_OK || best->result.status != DROGUE_OK));
}

/* Before anything is tried: nothing is known of the inner disc. */
static void begin_try(drogue_frame *f)
{
    forget(f->out);
    f->doubt_q16 = DROGUE_Q16_MAX;
    f->larger_q16 = 0;
}

/* From the outline that was tried to the pose. */
static drogue_status judge(drogue_frame *f, drogue_tried what)
{
    f->out->tried = what;
    return drogue_frame_judge(f);
}

/* The outline in a region, by the edges of an upper threshold. */
static drogue_status try_edges(drogue_frame *f, const drogue_region *region, int32_t high, drogue_tried what)
{
    drogue_status status;
    begin_try(f);
    f->canny_high = high;
    status = drogue_frame_outline(f, region);
    return status == DROGUE_OK ? judge(f, what) : status;
}

/* A larger outline about the one just found, by the same edges. */
static drogue_status try_larger(drogue_frame *f, drogue_tried what)
{
    begin_try(f);
    return drogue_outline_enlarge(&f->outline, f->workspace, &f->list, &f->mask, f->setup->config)
               ? judge(f, what)
               : DROGUE_E_NO_ELLIPSE;
}

/* Has the first try an outline, or may other thresholds find one? */
static int may_try_more(drogue_status status)
{
    return status == DROGUE_OK || status == DROGUE_E_NO_ELLIPSE || status == DROGUE_E_NO_EDGES ||
           status == DROGUE_E_NO_ARCS || drogue_status_full(status);
}

/* By half; there is no sense in more than the largest magnitude. */
static int32_t raised(int32_t high) { return high > DROGUE_L1_MAX ? INT32_MAX : high + high / 2 + 1; }

/* May it be tried? Lower thresholds than the configured ones, or where these filled a table higher ones. */
static int is_other(int32_t high, const drogue_frame *f, int full)
{
    const drogue_config *config = f->setup->config;
    return config->canny_least < config->canny_high && (full ? high <= DROGUE_L1_MAX : high < config->canny_high);
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

/* The outline by edges above the region's own noise, further above it where they fill a table; and a larger one. */
static void try_noise(drogue_best_try *best, drogue_frame *f, const drogue_region *region)
{
    const int full = drogue_status_full(best->result.status);
    int32_t high = own_threshold(f, full);
    int k;
    for (k = 0; k <= RAISES && is_other(high, f, full); k++) { /* bound: 3 */
        const drogue_status status = try_edges(f, region, high, DROGUE_TRIED_NOISE);
        consider(best, f, status);
        if (status == DROGUE_OK && best->least_q16 > SURE_Q16) {
            consider(best, f, try_larger(f, DROGUE_TRIED_NOISE_LARGER));
        }
        if (!drogue_status_full(status)) {
            return;
        }
        high = raised(high);
    }
}

/* Has no try an outline with a disc, for edges that are everywhere, which cover one by chance? */
static int is_lost(const drogue_best_try *best) { return best->least_q16 >= DROGUE_Q16_ONE && best->crowded; }

/* Is the disc to be looked for without an outline? Where the ring has no edge, too: it may not suit the drogue. */
static int asks_disc(const drogue_best_try *best, const drogue_frame *f)
{
    return best->least_q16 > DISC_Q16 && f->setup->model->inner_radius_m_q16 > 0 && !is_lost(best);
}

/* Most doubt of an outline about the disc: less than where they contradict each other; or, where the best outline has
 * no disc at all and this is no more thinly covered than that may be, than makes the disc be looked for. */
static drogue_q16 most_doubt(const drogue_best_try *best, const drogue_frame *f)
{
    return best->result.status == DROGUE_OK && best->least_q16 == DROGUE_Q16_ONE &&
                   f->out->cover_q16 >= f->setup->config->min_cover_q16
               ? DISC_Q16
               : DROGUE_CONTRADICTED_Q16;
}

/* The disc itself, and an outline about it. That stands, whatever the best one's doubt, where it has little itself. */
static void try_disc(drogue_best_try *best, drogue_frame *f, const drogue_region *region)
{
    drogue_status status;
    begin_try(f);
    status = drogue_frame_about_disc(f, region);
    if (status == DROGUE_OK) {
        status = judge(f, DROGUE_TRIED_DISC);
    }
    end_try(best, f, status, status == DROGUE_OK && f->out->has_inner && f->out->doubt_q16 < most_doubt(best, f));
}

/* Is the inner disc too large for the best outline? */
static int asks_beyond(const drogue_best_try *best)
{
    return best->result.status == DROGUE_OK && best->least_q16 > SURE_Q16 && best->larger_q16 > LEAST_Q16;
}

/* A larger outline about the best one, whose arcs it was found from. */
static drogue_status judge_rays(drogue_frame *f, const drogue_result *was, drogue_status status)
{
    if (status == DROGUE_OK) {
        f->outline.quality = was->quality;
        f->outline.cluster_members = was->cluster_members;
        status = judge(f, f->held.canny_high == DROGUE_BY_RAYS ? DROGUE_TRIED_RAYS : DROGUE_TRIED_LARGER);
    }
    return status;
}

/* The outline beyond the best one that the inner disc is of the size for. */
static void try_beyond(drogue_best_try *best, drogue_frame *f)
{
    const drogue_result *was = &best->result;
    begin_try(f);
    f->second_look = was->second_look;
    consider(best, f, judge_rays(f, was, drogue_frame_beyond(f, &best->held.region, &was->ellipse, best->larger_q16)));
}

/* Does another edge show outside the best outline, which is not one beyond another already, nor one that does not stand
 * alone? */
static int asks_outer(const drogue_best_try *best)
{
    const drogue_result *was = &best->result;
    return was->status == DROGUE_OK && was->tried != DROGUE_TRIED_RAYS && was->outside > 0 &&
           (best->least_q16 != DROGUE_Q16_ONE || was->cover_q16 >= ALONE_Q16);
}

/* The rim's outer edge where the best outline is an inner one. It stands unless the disc was seen and no longer is, or
 * was exactly of its size and is so no longer, or motion shows one edge as two. */
static void try_outer(drogue_best_try *best, drogue_frame *f)
{
    const drogue_result *was = &best->result;
    drogue_status status;
    begin_try(f);
    f->second_look = was->second_look;
    status = judge_rays(f, was, drogue_frame_outer(f, &best->held.region, &was->ellipse));
    end_try(best, f, status,
            status == DROGUE_OK && f->out->has_inner >= was->has_inner && !(best->smeared && seems_smeared(f)) &&
                (best->least_q16 > 0 || f->doubt_q16 <= STILL_Q16));
}

static int same_edges(const drogue_held *a, const drogue_held *b)
{
    return a->canny_high == b->canny_high && a->region.x_px == b->region.x_px && a->region.y_px == b->region.y_px &&
           a->region.width_px == b->region.width_px && a->region.height_px == b->region.height_px;
}

/* What was best stands, and its edges are in the workspace again. Where there is no outline at all they are those
 * looked for last. An outline without a pose has its arcs in the list, too. */
static void return_to(const drogue_best_try *best, drogue_frame *f)
{
    const drogue_held *wanted = best->result.ellipse.a_px_q16 > 0 ? &best->held : &f->held;
    if (!same_edges(wanted, &f->held)) {
        f->canny_high = wanted->canny_high;
        (void)drogue_frame_edges(f, &wanted->region);
    }
    *f->out = best->result;
    (void)drogue_frame_view(f, &wanted->region);
    f->second_look = best->result.second_look;
}

/* Is all of an ellipse in the image? What is cut off shows nowhere. */
static int lies_within(const drogue_ellipse *e, const drogue_image *image)
{
    return e->xc_px_q16 >= e->a_px_q16 && e->yc_px_q16 >= e->a_px_q16 &&
           (int64_t)e->xc_px_q16 + e->a_px_q16 <= (image->width_px - 1) * (int64_t)DROGUE_Q16_ONE &&
           (int64_t)e->yc_px_q16 + e->a_px_q16 <= (image->height_px - 1) * (int64_t)DROGUE_Q16_ONE;
}

/* Is the best outline without a disc, and another edge? It is where too little of it shows to stand alone. Or a disc
 * says so: one that is seen, but too large for it, which then is an edge within the drogue, the canopy's or its wall's;
 * or one that was sought, whose rim is larger. */
static int is_another_edge(const drogue_best_try *best, const drogue_frame *f)
{
    if (best->result.status != DROGUE_OK || best->least_q16 != DROGUE_Q16_ONE) {
        return 0;
    }
    return best->larger_q16 > 0 ||
           (best->result.cover_q16 < ALONE_Q16 && lies_within(&best->result.ellipse, f->image)) ||
           f->ring_px_q16 - best->result.ellipse.a_px_q16 > f->ring_px_q16 / LARGER;
}

/* Is the outline to be looked for in three or five quarters of the region, but not where edges are everywhere? Where
 * nothing was found that stands; in five where one does, too, whose disc is not of its size: the ring mask may leave
 * the rim out. */
static int asks_resized(const drogue_best_try *best, const drogue_frame *f, int32_t wider)
{
    return !is_lost(best) &&
           (best->result.status != DROGUE_OK || is_another_edge(best, f) || (wider > 0 && best->least_q16 > DISC_Q16));
}

/* The outline in three or five quarters of a region, which may be too wide or too narrow for its ring mask. It stands
 * where its disc is seen, about of its size, and nearer to that than the best one's, or where none is asked for. */
static void try_resized(drogue_best_try *best, drogue_frame *f, const drogue_region *region, int32_t wider)
{
    const int32_t x_px = wider * (region->width_px / 8);
    const int32_t y_px = wider * (region->height_px / 8);
    drogue_region other = *region;
    drogue_status status;
    other.x_px -= x_px;
    other.y_px -= y_px;
    other.width_px += 2 * x_px;
    other.height_px += 2 * y_px;
    if (drogue_workspace_spans(f->workspace, &other, f->image)) {
        status = try_edges(f, &other, f->setup->config->canny_high, DROGUE_TRIED_FOUND);
        end_try(best, f, status, status == DROGUE_OK && f->doubt_q16 < FOUND_Q16 && is_clearer(best, f));
    } else {
        drogue_note_room(&f->room, DROGUE_OK, DROGUE_SECOND_TOO_WIDE);
    }
}

/* Measure; while the inner disc is not seen or not of its size, try what else the outline may be. What has the disc
 * nearest to its size stands. */
static drogue_status measure(drogue_frame *f, const drogue_region *region)
{
    drogue_best_try *const best = f->workspace->best;
    int32_t wider;
    drogue_status status = try_edges(f, region, f->setup->config->canny_high, DROGUE_TRIED_FOUND);
    if (!may_try_more(status)) {
        return status;
    }
    best->crowded = f->crowded;
    keep(best, f, status);
    drogue_note_room(&f->room, status, f->second_look);
    if (status == DROGUE_OK && best->least_q16 > SURE_Q16) {
        consider(best, f, try_larger(f, DROGUE_TRIED_LARGER));
    }
    if (best->least_q16 > SURE_Q16) {
        try_noise(best, f, region);
    }
    if (asks_disc(best, f)) {
        try_disc(best, f, region);
    }
    for (wider = -1; wider <= 1; wider += 2) { /* bound: 2 */
        if (asks_resized(best, f, wider)) {
            try_resized(best, f, region, wider);
        }
    }
    if (asks_beyond(best)) {
        try_beyond(best, f);
    }
    if (asks_outer(best)) {
        return_to(best, f);
        try_outer(best, f);
    }
    return_to(best, f);
    status = best->result.status;
    if (is_another_edge(best, f)) {
        const drogue_tried tried = f->out->tried;
        forget(f->out);
        f->out->tried = tried;
        status = DROGUE_E_NO_ELLIPSE;
    }
    if (f->room != DROGUE_SECOND_NONE) {
        const int whole = status == DROGUE_OK && f->second_look <= DROGUE_SECOND_BETTER;
        f->second_look = whole ? DROGUE_SECOND_ROOM : f->room;
    }
    return status;
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
    out->list = f.list;
    return out->status;
}
