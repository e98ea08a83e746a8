/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of what finds and follows a drogue: rim, search, decide, look, acquire, track. */
#include "stage_run.h"

#include <string.h>

#include "drogue/decide.h"
#include "drogue/track.h"

static drogue_region region_of(const int32_t *words)
{
    drogue_region r;
    r.x_px = words[0];
    r.y_px = words[1];
    r.width_px = words[2];
    r.height_px = words[3];
    return r;
}

static int32_t *put_region(int32_t *at, const drogue_region *r)
{
    at[0] = r->x_px;
    at[1] = r->y_px;
    at[2] = r->width_px;
    at[3] = r->height_px;
    return at + 4;
}

static drogue_model model_of(const int32_t *words)
{
    drogue_model m;
    m.rim_radius_m_q16 = words[0];
    m.inner_radius_m_q16 = words[1];
    m.inner_depth_m_q16 = words[2];
    return m;
}

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
        out = put_region(out + 4, &c->region);
    }
}

int stage_search(stage_run *r)
{
    const drogue_image image = r->image;
    int32_t *out = stage_output32(r, "sightings", 4 + 8 * (DROGUE_SEARCH_MAX + DROGUE_SEARCH_DARK));
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
    out[3] = search.darkest;
    put_sightings(out + 4, search.best, search.count);
    put_sightings(out + 4 + 8 * DROGUE_SEARCH_MAX, search.dark, search.dark_count);
    return 0;
}

/* A pose as stage_put_pose() writes it. */
static drogue_pose whole_pose(const int32_t words[8])
{
    drogue_pose p;
    memcpy(p.position_m_q16, words, sizeof p.position_m_q16);
    memcpy(p.axis_q16, words + 3, sizeof p.axis_q16);
    p.yaw_rad_q16 = words[6];
    p.pitch_rad_q16 = words[7];
    return p;
}

/* Covariance by rows of the lower triangle, and standard deviations. */
static void put_covariance(int64_t *covariance, int64_t *std, const drogue_decision *d)
{
    int i;
    int j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            *covariance++ = d->covariance_q48[i][j];
        }
    }
    memcpy(std, d->position_std_m_q32, sizeof d->position_std_m_q32);
    std[3] = d->axis_std_rad_q32;
}

int stage_decide(stage_run *r)
{
    const drogue_camera camera = stage_camera(stage_input32(r, 1));
    const int32_t *p = stage_input32(r, 3);
    const drogue_model model = model_of(p);
    int32_t *out = stage_output32(r, "decision", 19);
    int64_t *covariance = (int64_t *)stage_output(r, "covariance", 64, 15);
    int64_t *std = (int64_t *)stage_output(r, "std", 64, 4);
    drogue_config config;
    drogue_support support;
    drogue_evidence evidence;
    drogue_decision decision;
    if (out == NULL || covariance == NULL || std == NULL) {
        return CONF_E_MEMORY;
    }
    memset(covariance, 0, 15 * sizeof *covariance);
    memset(std, 0, 4 * sizeof *std);
    memset(&decision, 0, sizeof decision);
    drogue_config_default(&config);
    evidence.ideal = stage_ellipse(stage_input32(r, 0));
    evidence.poses[0] = whole_pose(p + 3);
    evidence.poses[1] = whole_pose(p + 11);
    evidence.nearer = p[19] != 0 ? 1 : 0;
    evidence.inner.x_px_q16 = p[20];
    evidence.inner.y_px_q16 = p[21];
    evidence.inner.std_px_q16 = p[22];
    evidence.doubt_q16 = p[28];
    evidence.too_far_q16 = p[29];
    evidence.support = &support;
    config.outline_shading_q16 = p[23];
    config.optics_blur_std_px2_q16 = p[24];
    config.max_chi2_q16 = p[25];
    config.min_chi2_gap_q16 = p[26];
    if (!drogue_config_valid(&config) ||
        !stage_support_of_words(&support, stage_input32(r, 2), p[27], stage_input32(r, 0)[4]) || p[22] < 0 ||
        p[28] < 0 || p[29] < 0 || camera.fx_px_q16 <= 0 || camera.fy_px_q16 <= 0 || p[0] <= 0 || p[1] < 0 ||
        !stage_angle_valid(&evidence.ideal) || evidence.ideal.b_px_q16 < DROGUE_Q16_ONE ||
        evidence.ideal.a_px_q16 < evidence.ideal.b_px_q16) {
        return CONF_E_MALFORMED;
    }
    out[0] = (int32_t)drogue_decide(&decision, &evidence, &(drogue_setup){&camera, &model, &config});
    if (out[0] == (int32_t)DROGUE_OK) {
        int32_t *at = stage_put_pose(stage_put_pose(out + 1, &decision.pose), &decision.alternative);
        at[0] = decision.orientation_resolved;
        at[1] = decision.doubt_q16;
        put_covariance(covariance, std, &decision);
    }
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
    const drogue_camera camera = stage_camera(stage_input32(r, 1));
    const drogue_model model = model_of(stage_input32(r, 2));
    const int32_t *p = stage_input32(r, 3);
    const drogue_region region = region_of(p);
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
    out[2] = result.tried;
    out = put_region(out + 3, &result.region);
    out[0] = result.cover_q16;
    out = stage_put_ellipse(out + 1, &result.ellipse);
    out[0] = result.has_inner;
    out[1] = result.orientation_resolved;
    return 0;
}

int stage_acquire(stage_run *r)
{
    drogue_image image = r->image;
    const drogue_camera camera = stage_camera(stage_input32(r, 1));
    const drogue_model model = model_of(stage_input32(r, 2));
    const int32_t *p = stage_input32(r, 3);
    const drogue_region region = region_of(p + 1);
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
    out[0] = (int32_t)drogue_acquire(&result, &search, &workspace, &(drogue_setup){&camera, &model, &config}, &image,
                                     p[0] != 0 ? &region : NULL);
    out = put_region(out + 1, &result.region);
    out[0] = result.has_inner;
    out[1] = result.orientation_resolved;
    out = stage_put_ellipse(out + 2, &result.ellipse);
    (void)stage_put_pose(out, &result.pose);
    return 0;
}

static void read_track_config(drogue_track_config *c, const int32_t *p)
{
    drogue_track_config_default(c); /* what the words do not hold */
    c->max_missed = (uint32_t)p[0];
    c->agree_frames = (uint32_t)p[1];
    c->reconsider_frames = (uint32_t)p[2];
    c->known_frames = (uint32_t)p[3];
    c->min_region_px = p[4];
    c->max_region_px = p[5];
    c->gate_q16 = p[6];
    c->position_gate_q16 = p[7];
    c->region_scale_q16 = p[8];
    c->region_sigmas_q16 = p[9];
    c->lateral_std_q16 = p[10];
    c->depth_std_q16 = p[11];
    c->angle_std_rad_q16 = p[12];
    c->position_floor_m_q16 = p[13];
    c->angle_floor_rad_q16 = p[14];
    memcpy(c->process_std_q16, p + 15, sizeof c->process_std_q16);
    c->process_step_q16 = p[20];
    c->lasting_share_q16 = p[21];
    c->start_rate_std_q16 = p[22];
    c->start_accel_std_q16 = p[23];
}

/* A pose of position, yaw and pitch. */
static drogue_pose pose_of(const int32_t words[5])
{
    drogue_pose p;
    memset(&p, 0, sizeof p);
    memcpy(p.position_m_q16, words, sizeof p.position_m_q16);
    p.yaw_rad_q16 = words[3];
    p.pitch_rad_q16 = words[4];
    return p;
}

static void read_result(drogue_result *result, const int32_t *f, const int64_t *covariance)
{
    int i;
    int j;
    memset(result, 0, sizeof *result);
    result->status = (drogue_status)f[1];
    result->second_look = (drogue_second_look)f[2];
    result->has_inner = f[3];
    result->orientation_resolved = f[4];
    result->cover_q16 = f[5];
    result->doubt_q16 = f[16];
    result->pose = pose_of(f + 6);
    result->alternative = pose_of(f + 11);
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            result->covariance_q48[i][j] = result->covariance_q48[j][i] = *covariance++;
        }
    }
}

int stage_track(stage_run *r)
{
    const int32_t *s = stage_input32(r, 0);
    const int32_t *frame = stage_input32(r, 2);
    const int64_t *covariance = (const int64_t *)r->in[3].data;
    const size_t count = r->in[2].count / 17;
    const drogue_camera camera = stage_camera(s);
    const drogue_model model = model_of(s + 9);
    const drogue_region first = region_of(s + 12);
    int32_t *out = stage_output32(r, "states", 19 * count);
    int32_t *estimate = stage_output32(r, "estimates", 12 * count);
    int64_t *std = (int64_t *)stage_output(r, "std", 64, 6 * count);
    drogue_track_config config;
    drogue_track track;
    drogue_status status;
    size_t i;
    if (out == NULL || estimate == NULL || std == NULL) {
        return CONF_E_MEMORY;
    }
    if (r->in[3].count != 15 * count) {
        return CONF_E_MALFORMED;
    }
    read_track_config(&config, stage_input32(r, 1));
    memset(std, 0, 6 * count * sizeof *std);
    status = drogue_track_init(&track, &config, &camera, &model, first.width_px > 0 ? &first : NULL);
    for (i = 0; status != DROGUE_OK && i < count; i++) {
        out[19 * i] = (int32_t)status;
    }
    for (i = 0; status == DROGUE_OK && i < count; i++, frame += 17, covariance += 15) {
        drogue_region region;
        drogue_result result;
        drogue_track_estimate e;
        if (frame[0] < 1 || frame[1] < 0 || frame[1] >= (int32_t)DROGUE_STATUS_COUNT) {
            return CONF_E_MALFORMED;
        }
        read_result(&result, frame, covariance);
        drogue_track_begin(&region, &track, (uint32_t)frame[0]);
        *out++ = (int32_t)status;
        out = put_region(out, &region);
        *out++ = track.search;
        out = put_region(out, &track.reach);
        *out++ = (int32_t)drogue_track_end(&track, &result);
        *out++ = (int32_t)track.missed;
        *out++ = track.gated;
        *out++ = track.orientation_known;
        *out++ = (int32_t)track.open_frames;
        *out++ = (int32_t)track.turned;
        *out++ = (int32_t)track.trial;
        *out++ = (int32_t)track.agreeing;
        *out++ = track.second_known;
        drogue_track_get(&e, &track);
        memcpy(estimate, e.position_m_q16, sizeof e.position_m_q16);
        memcpy(estimate + 3, e.velocity_mps_q16, sizeof e.velocity_mps_q16);
        memcpy(estimate + 6, e.axis_q16, sizeof e.axis_q16);
        estimate[9] = e.yaw_rad_q16;
        estimate[10] = e.pitch_rad_q16;
        estimate[11] = e.orientation_resolved;
        estimate += 12;
        memcpy(std, e.position_std_m_q32, sizeof e.position_std_m_q32);
        std[3] = e.yaw_std_rad_q32;
        std[4] = e.pitch_std_rad_q32;
        std[5] = e.axis_std_rad_q32;
        std += 6;
    }
    return 0;
}
