/* SPDX-License-Identifier: Apache-2.0 */
/* Stands in for src/cli/png_io.c in digest.sh, so that the host program can be built for targets without libpng: its
 * images are PGM, as png_to_pgm.c writes them. */
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "png_io.h"

void *uncleared(size_t count, size_t size);

/* In place of calloc() in one of the builds. */
void *uncleared(size_t count, size_t size) { return malloc(count * size); }

int picture_create(picture *out, const char *path, int32_t width_px, int32_t height_px, int32_t channels)
{
    out->width_px = width_px;
    out->height_px = height_px;
    out->channels = channels;
    out->data = calloc((size_t)width_px * (size_t)height_px, (size_t)channels);
    return out->data == NULL ? complain(path, "out of memory") : EXIT_MEASURED;
}

void picture_free(picture *image)
{
    free(image->data);
    memset(image, 0, sizeof *image);
}

int png_read(picture *out, FILE *in, const char *path)
{
    (void)out;
    (void)in;
    return complain(path, "this build reads no PNG");
}

int picture_write(const picture *image, const char *path)
{
    (void)image;
    return complain(path, "this build writes no pictures");
}
