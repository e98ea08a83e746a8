/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of what finds a drogue in images: rim, search, look, acquire, follow. */
#include "stage_run.h"

#include <string.h>

#include "drogue/track.h"

int stage_rim(stage_run *r)
{
    const drogue_image image = r->image;
    const int32_t *p = stage_input32(r, 1);
    int32_t *out = stage_output32(r, "rims", 1 + 4 * DROGUE_RIMS);
    uint8_t *rows = (uint8_t *)stage_take(r, (size_t)image.width_px * DROGUE_SEARCH_ROWS);
    drogue_search_level level;
    drogue_search_disc disc;
    drogue_rim rims[DROGUE_RIMS];
    int32_t i;
    if (out == NULL || rows == NULL) {
        return CONF_E_MEMORY;
    }
    if (image.height_px > DROGUE_SEARCH_ROWS || p[0] < 0 || p[0] >= image.width_px || p[1] < 0 ||
        p[1] >= image.height_px || p[2] < 1 || p[2] > 16 * DROGUE_SEARCH_REACH || p[3] < 0 || p[3] > 255) {
        return CONF_E_MALFORMED;
    }
    memset(&level, 0, sizeof level);
    for (i = 0; i < image.height_px; i++) {
        memcpy(rows + i * image.width_px, drogue_image_row(&image, i), (size_t)image.width_px);
    }
    level.rows = rows;
    level.width = image.width_px;
    level.rows_in = image.height_px;
    disc.x = p[0];
    disc.y = p[1];
    disc.ring_q4 = p[2];
    disc.contrast = p[3];
    *out = drogue_rim_find(rims, &level, &disc, 0);
    for (i = 0; i < *out; i++) {
        out[1 + 4 * i] = rims[i].x_q4;
        out[2 + 4 * i] = rims[i].y_q4;
        out[3 + 4 * i] = rims[i].radius_q4;
        out[4 + 4 * i] = (int32_t)rims[i].score;
    }
    return 0;
}

/* A search in the stage's memory for frames up to a width; NULL when it does not fit. */
static int new_search(stage_run *r, drogue_search *search, int32_t width_px)
{
    const size_t bytes = width_px >= 1 && width_px <= INT16_MAX ? DROGUE_SEARCH_BYTES(width_px) : 0;
    void *block = bytes > 0 ? stage_take(r, bytes) : NULL;
    return block != NULL && drogue_search_init(search, block, bytes, width_px) == DROGUE_OK;
}

static void put_sightings(int32_t *out, const drogue_sighting *sightings, int32_t count)
{
    int32_t i;
    for (i = 0; i < count; i++) {
        const drogue_sighting *c = &sightings[i];
        out[0] = c->x_px;
        out[1] = c->y_px;
        out[2] = c->radius_px;
        out[3] = (int32_t)c->score;
        out = stage_put_region(out + 4, &c->region);
    }
}

int stage_search(stage_run *r)
{
    const drogue_image image = r->image;
    int32_t *out = stage_output32(r, "sightings", 3 + 8 * (DROGUE_SEARCH_MAX + DROGUE_SEARCH_DARK));
    drogue_search search;
    int32_t y;
    if (out == NULL || !new_search(r, &search, image.width_px)) {
        return CONF_E_MEMORY;
    }
    search.min_contrast = stage_input32(r, 1)[0];
    out[0] = (int32_t)drogue_search_begin(&search, image.width_px);
    for (y = 0; out[0] == (int32_t)DROGUE_OK && y < image.height_px; y++) {
        drogue_search_row(&search, drogue_image_row(&image, y));
    }
    if (out[0] != (int32_t)DROGUE_OK) {
        return 0;
    }
    out[1] = drogue_search_end(&search);
    out[2] = search.dark_count;
    put_sightings(out + 3, search.best, search.count);
    put_sightings(out + 3 + 8 * DROGUE_SEARCH_MAX, search.dark, search.dark_count);
    return 0;
}

/* Workspace of the capacities in four words: width, edges, labels, arcs. */
static int capacity_workspace(stage_run *r, drogue_workspace *workspace, const int32_t *words)
{
    drogue_capacity capacity;
    size_t bytes;
    void *block;
    if (words[0] < 1 || words[0] > DROGUE_MAX_SIDE || words[1] < 1 || words[1] > CONF_MAX_EDGES || words[2] < 1 ||
        words[2] > CONF_MAX_LABELS || words[3] < 1 || words[3] > CONF_MAX_ARCS) {
        return CONF_E_MALFORMED;
    }
    capacity.width_px = (uint32_t)words[0];
    capacity.edges = (uint32_t)words[1];
    capacity.labels = (uint32_t)words[2];
    capacity.arcs = (uint32_t)words[3];
    bytes = drogue_workspace_bytes(&capacity);
    block = stage_take(r, bytes);
    return block != NULL && drogue_workspace_init(workspace, block, bytes, &capacity) == DROGUE_OK ? 0 : CONF_E_MEMORY;
}

int stage_look(stage_run *r)
{
    const drogue_image image = r->image;
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const drogue_model model = conf_model(stage_input32(r, 2));
    const int32_t *p = stage_input32(r, 3);
    const drogue_region region = conf_region(p);
    int32_t *out = stage_output32(r, "looked", 15);
    drogue_workspace workspace;
    drogue_config config;
    drogue_result result;
    const int failure = out != NULL ? capacity_workspace(r, &workspace, p + 4) : CONF_E_MEMORY;
    if (failure != 0) {
        return failure;
    }
    drogue_config_default(&config);
    config.transfer = (drogue_transfer)p[8];
    out[0] = (int32_t)drogue_measure(&result, &workspace, &(drogue_setup){&camera, &model, &config}, &image, &region);
    out[1] = (int32_t)result.second_look;
    out[2] = (int32_t)result.tried;
    out = stage_put_region(out + 3, &result.region);
    out[0] = result.cover_q16;
    out = stage_put_ellipse(out + 1, &result.ellipse);
    out[0] = result.has_inner;
    out[1] = result.orientation_resolved;
    return 0;
}

int stage_acquire(stage_run *r)
{
    drogue_image image = r->image;
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const drogue_model model = conf_model(stage_input32(r, 2));
    const int32_t *p = stage_input32(r, 3);
    const drogue_region region = conf_region(p + 1);
    int32_t *out = stage_output32(r, "found", 20);
    drogue_workspace workspace;
    drogue_search search;
    drogue_config config;
    drogue_result result;
    if (out == NULL || !new_search(r, &search, p[5]) || !stage_workspace(r, &workspace, p[6])) {
        return CONF_E_MEMORY;
    }
    drogue_config_default(&config);
    search.min_contrast = p[7];
    out[0] = (int32_t)drogue_acquire(&result, &workspace, &search, &(drogue_setup){&camera, &model, &config}, &image,
                                     p[0] != 0 ? &region : NULL);
    out = stage_put_region(out + 1, &result.region);
    out[0] = result.has_inner;
    out[1] = result.orientation_resolved;
    out = stage_put_ellipse(out + 2, &result.ellipse);
    (void)stage_put_pose(out, &result.pose);
    return 0;
}

/* A frame's words of a track. */
static int32_t *put_states(int32_t *at, drogue_track_state state, const drogue_result *result,
                           const drogue_region *asked, const drogue_track *track)
{
    *at++ = (int32_t)state;
    *at++ = (int32_t)result->status;
    at = stage_put_region(at, asked);
    at = stage_put_region(at, &result->region);
    *at++ = (int32_t)result->list.edge_count;
    *at++ = (int32_t)result->list.arc_count;
    *at++ = result->has_inner;
    *at++ = result->orientation_resolved;
    *at++ = (int32_t)track->missed;
    *at++ = track->gated;
    return at;
}

int stage_follow(stage_run *r)
{
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const drogue_model model = conf_model(stage_input32(r, 2));
    const int32_t *p = stage_input32(r, 3);
    const drogue_region first = conf_region(p + 2);
    int32_t *state = stage_output32(r, "states", p[0] > 0 ? 16u * (size_t)p[0] : 0);
    int32_t *estimate = stage_output32(r, "estimates", p[0] > 0 ? 12u * (size_t)p[0] : 0);
    drogue_image image = r->image;
    drogue_track_config track_config;
    drogue_workspace workspace;
    drogue_search search;
    drogue_config config;
    drogue_track track;
    int failure;
    int32_t i;
    if (state == NULL || estimate == NULL || !new_search(r, &search, p[10])) {
        return CONF_E_MEMORY;
    }
    failure = capacity_workspace(r, &workspace, p + 6);
    if (failure != 0) {
        return failure;
    }
    drogue_config_default(&config);
    drogue_track_config_default(&track_config);
    track_config.max_missed = (uint32_t)p[11];
    track_config.reconsider_frames = (uint32_t)p[12];
    track_config.known_frames = (uint32_t)p[13];
    if (p[0] < 1 || p[1] < 0 || image.height_px % p[0] != 0 ||
        drogue_track_init(&track, &track_config, &camera, &model, first.width_px > 0 ? &first : NULL) != DROGUE_OK) {
        return CONF_E_MALFORMED;
    }
    image.height_px /= p[0];
    for (i = 0; i < p[0]; i++, image.data += image.height_px * image.stride) { /* one frame below the other */
        drogue_region asked;
        drogue_result result;
        drogue_track_estimate e;
        const drogue_track_state now =
            drogue_track_frame(&result, &asked, &track, &workspace, &search, &config, &image, (uint32_t)p[1]);
        state = put_states(state, now, &result, &asked, &track);
        drogue_track_get(&e, &track);
        estimate = stage_put_estimate(estimate, &e);
    }
    return 0;
}
