/* SPDX-License-Identifier: Apache-2.0 */
/* Drogue: the pose of a refuelling drogue from one camera image, in fixed point.
 *
 * This header brings all others, installed or as two files. drogue_measure() does a frame in one call (measure.h),
 * drogue_acquire() finds the drogue in a whole image (search.h), drogue_track_frame() follows it (track.h); each stage
 * can be called alone, and through its own header. State lives in structs of the caller, memory in a workspace of the
 * caller (workspace.h):
 *
 *     static uint32_t memory[DROGUE_WORKSPACE_BYTES_FOR(256) / 4 + 1];
 *     const drogue_capacity capacity = DROGUE_CAPACITY_FOR(256);
 *     drogue_workspace workspace;
 *     drogue_config config;
 *     const drogue_setup setup = {&camera, &model, &config};
 *     drogue_result result;
 *
 *     drogue_workspace_init(&workspace, memory, sizeof memory, &capacity);
 *     drogue_config_default(&config);
 *     if (drogue_measure(&result, &workspace, &setup, &image, &region) == DROGUE_OK) {
 *         use(result.pose.position_m_q16);
 *     }
 */
#ifndef DROGUE_H
#define DROGUE_H

#include "drogue/eigen.h"
#include "drogue/noise.h"
#include "drogue/track.h"
#include "drogue/undistort.h"

#endif
