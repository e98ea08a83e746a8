/* SPDX-License-Identifier: Apache-2.0 */
/* PNG files to 8-bit grey, and 8-bit grey or RGB to PNG files, through libpng.
 *
 * Every kind of PNG is read: 1, 2, 4, 8 and 16 bit, grey, RGB, palette, with alpha or transparency, interlaced.
 *   grey    = (77 R + 150 G + 29 B + 128) >> 8
 *   16 bit  : a sample v becomes v * 255 / 65535 rounded, before the grey is formed
 *   1..4 bit: a sample v becomes v * 255 / (2^bits - 1)
 * Alpha is ignored: the colour counts as it is stored. So are gamma and colour profiles. */
#ifndef CLI_PNG_IO_H
#define CLI_PNG_IO_H

#include <stdint.h>
#include <stdio.h>

#define PICTURE_MAX_PIXELS (1u << 26) /* larger files are refused */

/* Pixels on the heap, rows adjacent. */
typedef struct picture {
    uint8_t *data;
    int32_t width_px;
    int32_t height_px;
    int32_t channels; /* 1 grey, 3 RGB */
} picture;

/* Make a black picture.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint about 'path' when there is no memory
 */
int picture_create(picture *out, const char *path, int32_t width_px, int32_t height_px, int32_t channels);

void picture_free(picture *image);

/* Read a PNG behind its 8 bytes of signature, to the end of its last chunk. One that ends early is refused, and one
 * that a check sum belies: that of any chunk, critical or not, or of the compressed pixels. What was false when its sum
 * was made is taken, where it does not bear on the stored pixels.
 *
 *  out     8-bit grey or RGB; free with picture_free(); empty on failure
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int png_read(picture *out, FILE *in, const char *path);

/* Write a file; "-": standard output.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int picture_write(const picture *image, const char *path);

#endif
