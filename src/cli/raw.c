/* SPDX-License-Identifier: Apache-2.0 */
/* Luma planes: gray8 is one; nv12 has one before its chroma; yuyv has it in every other byte. */
#include "raw.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "numbers.h"

static const char *const NAMES[] = {"", "gray8", "nv12", "yuyv"};

int raw_parse(raw_format *out, const char *text)
{
    const char *name = strrchr(text, ',');
    const size_t width = numbers_item(text);
    int kind;
    if (numbers_count(text) != 3) {
        return complain("--raw", "W,H,FORMAT is wanted, such as 1280,720,gray8");
    }
    if (numbers_whole(&out->width_px, "--raw", text, width, 1, INT16_MAX) ||
        numbers_whole(&out->height_px, "--raw", text + width + 1, numbers_item(text + width + 1), 1, INT16_MAX)) {
        return EXIT_BAD;
    }
    if ((uint64_t)out->width_px * (uint64_t)out->height_px > PICTURE_MAX_PIXELS) {
        return complain("--raw", "%dx%d pixels are more than the %u that are read", out->width_px, out->height_px,
                        PICTURE_MAX_PIXELS);
    }
    out->kind = RAW_NONE;
    for (kind = RAW_GRAY8; kind <= RAW_YUYV; kind++) {
        if (strcmp(name + 1, NAMES[kind]) == 0) {
            out->kind = (raw_kind)kind;
        }
    }
    if (out->kind == RAW_NONE) {
        return complain("--raw", "'%s' is not gray8, nv12 or yuyv", name + 1);
    }
    if ((out->kind != RAW_GRAY8 && out->width_px % 2 != 0) || (out->kind == RAW_NV12 && out->height_px % 2 != 0)) {
        return complain("--raw", "%s has an even number of columns%s", NAMES[out->kind],
                        out->kind == RAW_NV12 ? " and rows" : "");
    }
    return EXIT_MEASURED;
}

static int fill(picture *out, int *end, const raw_format *format, FILE *in, const char *path, uint8_t *data)
{
    const size_t pixels = (size_t)format->width_px * (size_t)format->height_px;
    const size_t bytes = format->kind == RAW_GRAY8  ? pixels
                         : format->kind == RAW_NV12 ? pixels + pixels / 2
                                                    : 2 * pixels;
    const size_t step = format->kind == RAW_YUYV ? 2 : 1;
    const size_t found = fread(data, 1, bytes, in);
    size_t i;
    if (found != bytes) {
        *end = found == 0 && !ferror(in);
        return *end         ? EXIT_MEASURED
               : ferror(in) ? complain(path, "%s", strerror(errno))
                            : complain(path, "ends within a frame: %lu of %lu bytes", (unsigned long)found,
                                       (unsigned long)bytes);
    }
    if (picture_create(out, path, format->width_px, format->height_px, 1)) {
        return EXIT_BAD;
    }
    for (i = 0; i < pixels; i++) {
        out->data[i] = data[i * step];
    }
    return EXIT_MEASURED;
}

int raw_read(picture *out, int *end, const raw_format *format, FILE *in, const char *path)
{
    uint8_t *data = malloc((size_t)format->width_px * (size_t)format->height_px * 2);
    int code;
    memset(out, 0, sizeof *out);
    *end = 0;
    if (data == NULL) {
        return complain(path, "out of memory");
    }
    code = fill(out, end, format, in, path, data);
    free(data);
    return code;
}
