/* SPDX-License-Identifier: Apache-2.0 */
/* The program's files but PNG: cameras in YAML and XML, by libyaml and expat, and PGM and PPM. */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "camera_file.h"
#include "cli.h"
#include "images.h"

static void read_camera(const char *path)
{
    drogue_camera camera;
    int32_t width = 0, height = 0;
    memset(&camera, 0, sizeof camera);
    if (camera_file_read(&camera, &width, &height, path) == EXIT_MEASURED) {
        FUZZ_MUST(width >= 0 && height >= 0 && (width == 0) == (height == 0));
    }
}

/* All images of the file, one behind the other, as 'track' reads them. */
static void read_images(const char *path)
{
    FILE *in = images_open(path);
    picture image;
    int end = 0, most;
    FUZZ_MUST(in != NULL);
    for (most = 4; most > 0 && !end; most--) {
        if (images_next(&image, &end, in, path) != EXIT_MEASURED) {
            FUZZ_MUST(image.data == NULL);
            break;
        }
        if (!end) {
            size_t i, sum = 0;
            FUZZ_MUST(image.width_px >= 1 && image.height_px >= 1 && image.channels == 1);
            for (i = 0; i < (size_t)image.width_px * (size_t)image.height_px; i++) {
                sum += image.data[i];
            }
            FUZZ_MUST(sum <= 255 * i);
        }
        picture_free(&image);
    }
    images_close(in);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const beginnings[4] = {"", "", "P5", "P6"};
    char path[64];
    FILE *file;
    const char *beginning;
    if (size < 1) {
        return 0;
    }
    beginning = beginnings[data[0] % 4];
    snprintf(path, sizeof path, "/tmp/drogue-fuzz-files-%ld", (long)getpid());
    file = fopen(path, "wb");
    FUZZ_MUST(file != NULL && fwrite(beginning, 1, strlen(beginning), file) == strlen(beginning));
    FUZZ_MUST(fwrite(data + 1, 1, size - 1, file) == size - 1);
    fclose(file);
    if (*beginning == '\0') {
        read_camera(path);
    } else {
        read_images(path);
    }
    remove(path);
    return 0;
}
