/* SPDX-License-Identifier: Apache-2.0 */
/* Image files as grey pictures: PNG, binary PGM and PPM, told apart by their first bytes. "-" is standard input. */
#ifndef CLI_IMAGES_H
#define CLI_IMAGES_H

#include <stdio.h>

#include "png_io.h"

/* Open for reading; "-" is standard input.
 *
 *  return  NULL after a complaint
 */
FILE *images_open(const char *path);
void images_close(FILE *in);

/* Read the next image of a stream as grey, (77 R + 150 G + 29 B + 128) >> 8.
 *
 *  out     free with picture_free(); empty on failure and at the end
 *  end     out, 1 when the stream has ended before a first byte of it
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint; for JPEG and video it says how to convert them
 */
int images_next(picture *out, int *end, FILE *in, const char *path);

/* Read the first image of a file as grey. */
int picture_read_grey(picture *out, const char *path);

#endif
