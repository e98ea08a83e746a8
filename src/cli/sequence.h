/* SPDX-License-Identifier: Apache-2.0 */
/* The frames of a track: image files, the images of a folder, a stream of images, raw video. */
#ifndef CLI_SEQUENCE_H
#define CLI_SEQUENCE_H

#include <stdio.h>

#include "options.h"
#include "png_io.h"

/* Replace each folder among the operands of track by the images in it (.png, .pgm, .ppm), in the order of their names.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int sequence_expand(options *o);
void sequence_free(options *o); /* what that took */

/* Start with all zero. */
typedef struct sequence {
    FILE *stream; /* of more than one frame */
    int next;     /* operand */
} sequence;

/* Read the next frame.
 *
 *  path    out, what it is called
 *  end     out, 1 when there is none left
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int sequence_next(picture *out, const char **path, int *end, sequence *s, const options *o);
void sequence_close(sequence *s);

#endif
