/* SPDX-License-Identifier: Apache-2.0 */
/* The library for simulators that call C: SystemVerilog's DPI-C, Simulink's S-functions and C Caller. No struct crosses the
 * border: a handle, ints and arrays of ints, words in the formats of the golden vectors (vectors/README.md, 'frame'). A host
 * model beside the hardware, with memory from the heap; hls/dpi/drogue_dpi.svh has the imports. */
#ifndef DROGUE_DPI_H
#define DROGUE_DPI_H

#ifdef __cplusplus
extern "C" {
#endif

/* Open a model for images of one size.
 *
 *  width, height  px, [1, 2048]
 *  return         a handle for the functions below; NULL when a side is out of range or there is no memory
 */
void *drogue_dpi_open(int width, int height);
void drogue_dpi_close(void *handle);

/* Set one pixel; 0 at the start. Ignored outside the image. */
void drogue_dpi_put(void *handle, int x, int y, int grey);

/* Set all pixels, width * height grey levels by rows: for callers that have them as an array. */
void drogue_dpi_image(void *handle, const unsigned char *grey);

#define DROGUE_DPI_THRESHOLDS 42

/* From now on measure with these thresholds instead of the defaults.
 *
 *  words   every one in the order of drogue_config, as 'config' of the vectors has them
 *  return  1; 0, and nothing is changed, when one is outside its range
 */
int drogue_dpi_thresholds(void *handle, const int words[DROGUE_DPI_THRESHOLDS]);

/* Measure the image.
 *
 *  camera  fx fy cx cy k1 k2 p1 p2 k3, Q16
 *  model   radius of the rim, of the inner part, its depth, m Q16
 *  region  x y width height, px
 *  return  the status (drogue/status.h): 0 when there is a pose
 */
int drogue_dpi_measure(void *handle, const int camera[9], const int model[3], const int region[4]);

/* The outline of the last measurement as seen: xc yc a b (px) angle (rad), Q16; zeros when there is none. */
void drogue_dpi_ellipse(void *handle, int words[5]);

/* A pose of the last measurement: position (m), axis, yaw, pitch (rad), Q16; zeros when there is none.
 *
 *  which  0: the one chosen; 1: the other that the outline allows
 */
void drogue_dpi_pose(void *handle, int which, int words[8]);

/* 1 when the inner part decided between the two poses. */
int drogue_dpi_resolved(void *handle);

#ifdef __cplusplus
}
#endif
#endif
