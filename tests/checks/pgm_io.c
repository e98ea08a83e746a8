/* SPDX-License-Identifier: Apache-2.0 */
/* Stands in for src/cli/png_io.c in digest.sh: PGM instead of PNG, so that the host program can be built for
 * targets without libpng. Reads what png_to_pgm.c writes. */
#include "png_io.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

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

int picture_read_grey(picture *out, const char *path)
{
    int width_px = 0, height_px = 0;
    int status = EXIT_BAD;
    FILE *file = fopen(path, "rb");
    memset(out, 0, sizeof *out);
    if (file == NULL || fscanf(file, "P5 %d %d 255", &width_px, &height_px) != 2 || fgetc(file) != '\n' ||
        width_px <= 0 || height_px <= 0 || (uint64_t)width_px * (uint64_t)height_px > PICTURE_MAX_PIXELS) {
        complain(path, "not a PGM file of 8 bit");
    } else if (picture_create(out, path, width_px, height_px, 1) == EXIT_MEASURED) {
        size_t size = (size_t)width_px * (size_t)height_px;
        if (fread(out->data, 1, size, file) == size) {
            status = EXIT_MEASURED;
        } else {
            complain(path, "the file ends early");
            picture_free(out);
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return status;
}

int picture_write(const picture *image, const char *path)
{
    (void)image;
    return complain(path, "this build writes no pictures");
}
