/* SPDX-License-Identifier: Apache-2.0 */
/* Raw video: frames one after the other, without any header. */
#ifndef CLI_RAW_H
#define CLI_RAW_H

#include <stdint.h>
#include <stdio.h>

#include "png_io.h"

typedef enum raw_kind { RAW_NONE, RAW_GRAY8, RAW_NV12, RAW_YUYV } raw_kind;

typedef struct raw_format {
    raw_kind kind; /* RAW_NONE: the input is image files */
    int32_t width_px;
    int32_t height_px;
} raw_format;

/* Read "W,H,gray8|nv12|yuyv".
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int raw_parse(raw_format *out, const char *text);

/* Read the next frame; grey is the luma as it is.
 *
 *  out     free with picture_free()
 *  end     out, 1 when the stream has ended before a first byte of it
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint about 'path': a part of a frame, no memory
 */
int raw_read(picture *out, int *end, const raw_format *format, FILE *in, const char *path);

#endif
