/* SPDX-License-Identifier: Apache-2.0 */
/* Camera files: OpenCV's FileStorage (YAML, XML), ROS camera_info (YAML), Kalibr's camchain (YAML). YAML needs libyaml
 * and XML needs expat at build time; a program built without says so. */
#ifndef CLI_CAMERA_FILE_H
#define CLI_CAMERA_FILE_H

#include "drogue/types.h"

/* Read a camera of the pinhole model with Brown-Conrady distortion of up to five coefficients.
 *
 *  width, height  out, of the images it is for; 0 when the file does not say
 *  return         EXIT_MEASURED, or EXIT_BAD after a complaint: a key that is missing, a model that is another one
 */
int camera_file_read(drogue_camera *out, int32_t *width_px, int32_t *height_px, const char *path);

#endif
