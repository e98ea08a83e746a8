/* SPDX-License-Identifier: Apache-2.0 */
/* Drawing on an RGB picture with integers only. Positions are canvas pixels, lines in Q8 of them. */
#ifndef CLI_CANVAS_H
#define CLI_CANVAS_H

#include "png_io.h"

typedef struct colour {
    uint8_t r, g, b;
} colour;

/* Mix a colour into one pixel: alpha 0 leaves it, 256 replaces it. Pixels outside are left out. */
void canvas_blend(picture *canvas, int32_t x, int32_t y, colour c, int32_t alpha);

/* Mix a colour into a rectangle. */
void canvas_fill(picture *canvas, int32_t x, int32_t y, int32_t width, int32_t height, colour c, int32_t alpha);

/* Straight line of a width in canvas pixels with soft edges, its ends cut along the pixel grid so that the lines of a
 * polygon join without a gap or an overlap. */
void canvas_line(picture *canvas, int64_t x0_q8, int64_t y0_q8, int64_t x1_q8, int64_t y1_q8, int32_t width, colour c);

/* Text with its top left corner at (x, y), every pixel of the font 'scale' pixels wide.
 *
 *  return  x after the last character
 */
int32_t canvas_text(picture *canvas, int32_t x, int32_t y, int32_t scale, colour c, const char *text);

#endif
