/* SPDX-License-Identifier: Apache-2.0 */
/* Region, workspace and call of the library for one frame. */
#include "frame.h"

#include <stdlib.h>

#include "cli.h"
#include "ranges.h"

/* Pixels of [start, start + size) inside [0, limit). */
static int32_t overlap(int32_t start, int32_t size, int32_t limit)
{
    drogue_clip(&start, &size, limit);
    return size;
}

int frame_workspace_fit(frame_workspace *w, const char *path, int32_t width_px, int32_t height_px, uint32_t min_arc_px)
{
    drogue_capacity capacity;
    size_t bytes;
    drogue_status status;
    drogue_capacity_for_any(&capacity, width_px, height_px, min_arc_px);
    bytes = drogue_workspace_bytes(&capacity);
    if (bytes > w->bytes) {
        free(w->memory);
        w->bytes = 0;
        w->memory = calloc(1, bytes);
        if (w->memory == NULL) {
            return complain(path, "out of memory");
        }
        w->bytes = bytes;
    }
    status = drogue_workspace_init(&w->workspace, w->memory, w->bytes, &capacity);
    return status == DROGUE_OK ? EXIT_MEASURED : complain(path, "workspace: %s", drogue_status_name(status));
}

void frame_workspace_free(frame_workspace *w)
{
    free(w->memory);
    w->memory = NULL;
    w->bytes = 0;
    free(w->search_memory);
    w->search_memory = NULL;
}

/* Room to search pictures of a width. */
static int fit_search(frame_workspace *w, const char *path, int32_t width_px)
{
    const size_t bytes = DROGUE_SEARCH_BYTES(width_px);
    if (width_px > w->search_width_px) {
        free(w->search_memory);
        w->search_width_px = 0;
        w->search_memory = malloc(bytes);
        if (w->search_memory == NULL) {
            return complain(path, "out of memory");
        }
        w->search_width_px = width_px;
        (void)drogue_search_init(&w->search, w->search_memory, bytes, width_px);
    }
    return EXIT_MEASURED;
}

/* Room to search a picture and to measure any part of it that the library takes. */
static int fit_whole(frame_workspace *w, const options *o, const char *path, const picture *grey)
{
    const int32_t width = grey->width_px < DROGUE_MAX_SIDE ? grey->width_px : DROGUE_MAX_SIDE;
    const int32_t height = grey->height_px < DROGUE_MAX_SIDE ? grey->height_px : DROGUE_MAX_SIDE;
    const int32_t widest = grey->width_px < INT16_MAX ? grey->width_px : INT16_MAX; /* wider ones are not searched */
    if (!o->region_given && (grey->width_px > INT16_MAX || grey->height_px > INT16_MAX)) {
        return complain(path, "%dx%d pixels are not searched, %d a side are the most: give a --roi", grey->width_px,
                        grey->height_px, INT16_MAX);
    }
    if (frame_workspace_fit(w, path, width, height, o->config.min_arc_px)) {
        return EXIT_BAD;
    }
    return fit_search(w, path, widest);
}

drogue_image frame_image(const picture *grey)
{
    drogue_image image;
    image.data = grey->data;
    image.width_px = grey->width_px;
    image.height_px = grey->height_px;
    image.stride = grey->width_px;
    return image;
}

int frame_check_camera(const options *o, const char *path, const picture *grey)
{
    const char *centre = ranges_centre(&o->camera, grey->width_px, grey->height_px);
    if (o->camera_width_px > 0 && o->camera_height_px > 0 &&
        (o->camera_width_px != grey->width_px || o->camera_height_px != grey->height_px)) {
        return complain(path, "%dx%d pixels, but the camera of %s has %dx%d", grey->width_px, grey->height_px,
                        o->camera_file, o->camera_width_px, o->camera_height_px);
    }
    return centre == NULL
               ? EXIT_MEASURED
               : complain("--camera", "%s: %s has %dx%d pixels", centre, path, grey->width_px, grey->height_px);
}

int frame_region(drogue_region *out, const options *o, const char *path, const picture *grey)
{
    const int32_t width = overlap(o->region.x_px, o->region.width_px, grey->width_px);
    const int32_t height = overlap(o->region.y_px, o->region.height_px, grey->height_px);
    *out = o->region;
    if (width > DROGUE_MAX_SIDE || height > DROGUE_MAX_SIDE) {
        return complain(path, "the region is %dx%d pixels, more than %d a side: give a smaller --roi", width, height,
                        DROGUE_MAX_SIDE);
    }
    return EXIT_MEASURED;
}

static drogue_setup setup_of(const options *o)
{
    drogue_setup setup;
    setup.camera = &o->camera;
    setup.model = &o->model;
    setup.config = &o->config;
    return setup;
}

/* Nothing of the size that the region stands for? */
static int is_worth_searching(drogue_status status)
{
    return status == DROGUE_E_NO_EDGES || status == DROGUE_E_NO_ARCS || status == DROGUE_E_NO_ELLIPSE;
}

/* Pixels of an image's side that a region and any second look at what it cuts reach: twice its longest side. A region
 * without pixels goes to the library, too, whose status says so. */
static int32_t room_for(const drogue_region *region, int32_t side_px)
{
    const int64_t longest = region->width_px > region->height_px ? region->width_px : region->height_px;
    const int64_t most = side_px < DROGUE_MAX_SIDE ? side_px : DROGUE_MAX_SIDE;
    return (int32_t)(2 * longest < 1 ? 1 : 2 * longest < most ? 2 * longest : most);
}

int frame_measure(drogue_result *out, int *searched, frame_workspace *w, const options *o, const char *path,
                  const picture *grey, const drogue_region *region)
{
    const drogue_setup setup = setup_of(o);
    drogue_image image = frame_image(grey);
    const int32_t width = overlap(region->x_px, region->width_px, grey->width_px);
    *searched = 0;
    if (frame_workspace_fit(w, path, room_for(region, grey->width_px), room_for(region, grey->height_px),
                            o->config.min_arc_px)) {
        return EXIT_BAD;
    }
    (void)drogue_measure(out, &w->workspace, &setup, &image, region);
    if (!is_worth_searching(out->status)) {
        return EXIT_MEASURED;
    }
    if (fit_search(w, path, width)) {
        return EXIT_BAD;
    }
    (void)drogue_acquire(out, &w->workspace, &w->search, &setup, &image, region);
    *searched = out->status == DROGUE_OK;
    if (!*searched) { /* again, so that the workspace holds its points */
        (void)drogue_measure(out, &w->workspace, &setup, &image, region);
    }
    return EXIT_MEASURED;
}

static drogue_region whole_image(const picture *grey)
{
    drogue_region whole = {0, 0, 0, 0};
    whole.width_px = grey->width_px;
    whole.height_px = grey->height_px;
    return whole;
}

int frame_acquire(drogue_result *out, drogue_region *region, frame_workspace *w, const options *o, const char *path,
                  const picture *grey)
{
    const drogue_setup setup = setup_of(o);
    drogue_image image = frame_image(grey);
    if (fit_whole(w, o, path, grey)) {
        return EXIT_BAD;
    }
    (void)drogue_acquire(out, &w->workspace, &w->search, &setup, &image, NULL);
    *region = out->status == DROGUE_OK ? out->region : whole_image(grey);
    return EXIT_MEASURED;
}

int frame_track(drogue_result *out, drogue_region *region, drogue_track *track, frame_workspace *w, const options *o,
                const char *path, const picture *grey, uint32_t dt_us)
{
    drogue_image image = frame_image(grey);
    if (fit_whole(w, o, path, grey)) {
        return EXIT_BAD;
    }
    (void)drogue_track_frame(out, region, track, &w->workspace, &w->search, &o->config, &image, dt_us);
    if (region->width_px == 0) {
        *region = out->status == DROGUE_OK ? out->region : whole_image(grey);
    }
    return EXIT_MEASURED;
}

int frame_unreliable(const options *o, const drogue_result *result)
{
    return result->status == DROGUE_OK && result->quality.reliability_q16 < o->min_reliability_q16;
}
