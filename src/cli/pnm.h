/* SPDX-License-Identifier: Apache-2.0 */
/* Binary PGM and PPM to grey, by the rules of png_io.h: 16 bits rounded to 8, RGB weighted. */
#ifndef CLI_PNM_H
#define CLI_PNM_H

#include <stdio.h>

#include "png_io.h"

/* Read one image behind its first two bytes, 'P' and 'kind'.
 *
 *  out     RGB or grey; free with picture_free()
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int pnm_read(picture *out, FILE *in, const char *path, char kind);

#endif
