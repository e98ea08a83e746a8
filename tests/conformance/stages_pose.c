/* SPDX-License-Identifier: Apache-2.0 */
/* Adapters of the stages behind the ellipse, and of the whole frame: undistort, pose, kalman, frame. */
#include "stage_run.h"

#include <string.h>

#include "drogue/kalman.h"
#include "drogue/undistort.h"

int stage_undistort(stage_run *r)
{
    const drogue_camera camera = conf_camera(stage_input32(r, 0));
    const int32_t *points = stage_input32(r, 1);
    size_t count = r->in[1].count / 2;
    int32_t *undistorted = stage_output32(r, "undistorted", 3 * count);
    int32_t *distorted = stage_output32(r, "distorted", 3 * count);
    size_t i;
    if (undistorted == NULL || distorted == NULL) {
        return CONF_E_MEMORY;
    }
    if (camera.fx_px_q16 <= 0 || camera.fy_px_q16 <= 0) {
        return CONF_E_MALFORMED;
    }
    for (i = 0; i < count; i++, undistorted += 3, distorted += 3) {
        undistorted[1] = distorted[1] = points[2 * i];
        undistorted[2] = distorted[2] = points[2 * i + 1];
        undistorted[0] = (int32_t)drogue_undistort_point(&undistorted[1], &undistorted[2], &camera);
        distorted[0] = (int32_t)drogue_distort_point(&distorted[1], &distorted[2], &camera);
    }
    return 0;
}

int stage_pose(stage_run *r)
{
    const drogue_ellipse ellipse = stage_ellipse(stage_input32(r, 0));
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const int32_t *p = stage_input32(r, 2);
    int32_t *out = stage_output32(r, "pose", 21);
    drogue_pose poses[2];
    drogue_choice choice;
    drogue_status status;
    if (out == NULL) {
        return CONF_E_MEMORY;
    }
    if (!stage_angle_valid(&ellipse)) {
        return CONF_E_MALFORMED;
    }
    status = drogue_pose_from_ellipse(poses, &ellipse, &camera, p[0]);
    if (status == DROGUE_OK) {
        (void)stage_put_pose(stage_put_pose(out + 1, &poses[0]), &poses[1]);
        status = drogue_choose_pose(&choice, poses, p[2], p[3], p[1], &camera);
    }
    if (status == DROGUE_OK) {
        out[17] = (int32_t)choice.index;
        out[18] = choice.distance_px_q16[0];
        out[19] = choice.distance_px_q16[1];
        out[20] = choice.ambiguity_q16;
    }
    out[0] = (int32_t)status;
    return 0;
}

/* Standard deviations of a frame: 1 all positive, 0 all zero (frame missed), -1 neither. */
static int measured(const int32_t std[DROGUE_PARAMETERS])
{
    int positive = 0;
    int zero = 0;
    int k;
    for (k = 0; k < DROGUE_PARAMETERS; k++) {
        positive += std[k] > 0;
        zero += std[k] == 0;
    }
    return positive == DROGUE_PARAMETERS ? 1 : zero == DROGUE_PARAMETERS ? 0 : -1;
}

int stage_kalman(stage_run *r)
{
    const int32_t *p = stage_input32(r, 0);
    const int32_t *frame = stage_input32(r, 1);
    size_t count = r->in[1].count / 10;
    int32_t *out = stage_output32(r, "states", 15 * count);
    drogue_q16 start_std[DROGUE_PARAMETERS][3];
    drogue_kalman filter;
    size_t i;
    int k;
    if (out == NULL) {
        return CONF_E_MEMORY;
    }
    if (p[0] < 1) {
        return CONF_E_MALFORMED;
    }
    for (k = 0; k < 20; k++) {
        if (p[1 + k] < 0) {
            return CONF_E_MALFORMED;
        }
    }
    for (k = 0; k < 15; k++) {
        start_std[k / 3][k % 3] = p[6 + k];
    }
    drogue_kalman_init(&filter, p + 21, (const drogue_q16(*)[3])start_std);
    for (i = 0; i < count; i++, frame += 10) {
        int has_measurement = measured(frame + 5);
        drogue_kalman_predict(&filter, (uint32_t)p[0], p + 1);
        if (has_measurement < 0) {
            return CONF_E_MALFORMED;
        }
        if (has_measurement) {
            drogue_kalman_correct(&filter, frame, frame + 5);
        }
        for (k = 0; k < 3; k++, out += 5) {
            drogue_kalman_state(out, &filter, k);
        }
    }
    return 0;
}

static void put_frame(int32_t *at, const drogue_result *result)
{
    int32_t present = 0;
    int k;
    for (k = 0; k < 4; k++) {
        present |= result->arcs[k] != DROGUE_NO_ARC ? 1 << k : 0;
    }
    *at++ = (int32_t)result->status;
    at = stage_put_ellipse(at, &result->ellipse);
    at = stage_put_ellipse(at, &result->ideal);
    *at++ = (int32_t)result->polarity;
    *at++ = present;
    *at++ = (int32_t)result->refit_points;
    *at++ = result->has_inner;
    *at++ = result->inner.x_px_q16;
    *at++ = result->inner.y_px_q16;
    *at++ = (int32_t)result->inner.area_px;
    *at++ = result->inner.threshold;
    *at++ = result->inner.spread_px_q16;
    at = stage_put_pose(at, &result->pose);
    at = stage_put_pose(at, &result->alternative);
    *at++ = result->orientation_resolved;
    *at = result->ambiguity_q16;
}

static void put_detail(int32_t *at, const drogue_result *result)
{
    int k;
    *at++ = result->region.x_px;
    *at++ = result->region.y_px;
    *at++ = result->region.width_px;
    *at++ = result->region.height_px;
    *at++ = (int32_t)result->list.edge_count;
    *at++ = (int32_t)result->list.arc_count;
    for (k = 0; k < 4; k++) {
        *at++ = result->arcs[k] == DROGUE_NO_ARC ? -1 : (int32_t)result->arcs[k];
    }
    *at++ = result->quality.fit_ratio_q16;
    *at++ = result->quality.length_ratio_q16;
    *at++ = result->quality.axis_ratio_q16;
    *at++ = result->quality.score_q16;
    *at++ = result->quality.reliability_q16;
    *at++ = (int32_t)result->cluster_members;
    *at++ = result->cover_q16;
    *at++ = result->doubt_q16;
    *at++ = (int32_t)result->outside;
    *at = result->inner.rays;
}

static void put_covariance(int64_t *covariance, int64_t *std, const drogue_result *result)
{
    int i;
    int j;
    for (i = 0; i < 5; i++) {
        for (j = 0; j <= i; j++) {
            *covariance++ = result->covariance_q48[i][j];
        }
    }
    for (i = 0; i < 3; i++) {
        *std++ = result->position_std_m_q32[i];
    }
    *std = result->axis_std_rad_q32;
}

void stage_put_result(int32_t frame[38], int32_t detail[20], int64_t covariance[15], int64_t std[4],
                      const drogue_result *result)
{
    put_frame(frame, result);
    put_detail(detail, result);
    put_covariance(covariance, std, result);
}

int stage_frame(stage_run *r)
{
    const drogue_image image = r->image;
    const drogue_camera camera = conf_camera(stage_input32(r, 1));
    const drogue_model model = conf_model(stage_input32(r, 2));
    const drogue_region region = conf_region(stage_input32(r, 3));
    int32_t *frame = stage_output32(r, "frame", 38);
    int32_t *detail = stage_output32(r, "detail", 20);
    int64_t *covariance = (int64_t *)stage_output(r, "covariance", 64, 15);
    int64_t *std = (int64_t *)stage_output(r, "std", 64, 4);
    drogue_workspace workspace;
    drogue_config config;
    drogue_result result;
    if (frame == NULL || detail == NULL || covariance == NULL || std == NULL ||
        !stage_workspace(r, &workspace, image.width_px)) {
        return CONF_E_MEMORY;
    }
    drogue_config_default(&config);
    if (r->in_count > 4) {
        conf_config_take(&config, stage_input32(r, 4));
    }
    (void)drogue_measure(&result, &workspace, &(drogue_setup){&camera, &model, &config}, &image, &region);
    stage_put_result(frame, detail, covariance, std, &result);
    return 0;
}
