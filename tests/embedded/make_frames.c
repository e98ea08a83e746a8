/* SPDX-License-Identifier: Apache-2.0 */
/* make_frames FILE.json... >frames.c: the region of each frame as C (frames.h). Runs on the host. */
#include <cjson/cJSON.h>
#include <libgen.h>
#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "frames.h"

static void fail(const char *name, const char *why)
{
    fprintf(stderr, "make_frames: %s: %s\n", name, why);
    exit(2);
}

static cJSON *read_json(const char *path)
{
    static char text[1 << 16];
    FILE *file = fopen(path, "rb");
    size_t length = file == NULL ? 0 : fread(text, 1, sizeof text - 1, file);
    cJSON *json;
    if (file == NULL) {
        fail(path, "cannot be read");
    }
    fclose(file);
    text[length] = '\0';
    json = cJSON_Parse(text);
    if (json == NULL) {
        fail(path, "is no JSON");
    }
    return json;
}

/* Number in an object of the sidecar; 'absent' when it is not there. */
static double number(const cJSON *json, const char *object, const char *key, double absent)
{
    const cJSON *item = cJSON_GetObjectItem(cJSON_GetObjectItem(json, object), key);
    return cJSON_IsNumber(item) ? item->valuedouble : absent;
}

static int whole(const cJSON *json, const char *object, const char *key)
{
    double value = number(json, object, key, NAN);
    if (!(fabs(value) < 1e6)) {
        fail(key, "missing");
    }
    return (int)value;
}

static long q16(double value)
{
    if (!(fabs(value) < 32767)) {
        fail("number", "missing or too large for Q16");
    }
    return lround(value * 65536.0);
}

/* Grey picture beside the sidecar. */
static uint8_t *read_png(const char *json_path, const char *name, int *width, int *height)
{
    char folder[1024];
    char path[2048];
    png_image png = {.version = PNG_IMAGE_VERSION};
    uint8_t *pixels;
    snprintf(folder, sizeof folder, "%s", json_path);
    snprintf(path, sizeof path, "%s/%s", dirname(folder), name);
    if (!png_image_begin_read_from_file(&png, path) || (png.format & PNG_FORMAT_FLAG_COLOR) != 0) {
        fail(path, "is no grey PNG");
    }
    png.format = PNG_FORMAT_GRAY;
    pixels = malloc(PNG_IMAGE_SIZE(png));
    if (pixels == NULL || !png_image_finish_read(&png, NULL, pixels, 0, NULL)) {
        fail(path, "cannot be read");
    }
    *width = (int)png.width;
    *height = (int)png.height;
    return pixels;
}

/* The table entry of a frame; its pixels go to stdout at once. Returns text. */
static char *write_frame(const char *path, int index)
{
    cJSON *json = read_json(path);
    const char *image = cJSON_GetStringValue(cJSON_GetObjectItem(json, "image"));
    const cJSON *position = cJSON_GetObjectItem(json, "position_m");
    int x = whole(json, "region", "x_px");
    int y = whole(json, "region", "y_px");
    int width = whole(json, "region", "width_px");
    int height = whole(json, "region", "height_px");
    int image_width, image_height, row, column;
    static const char *const lens[] = {"k1", "k2", "p1", "p2", "k3"};
    long k[5];
    char *entry = malloc(1024);
    uint8_t *pixels = image == NULL ? NULL : read_png(path, image, &image_width, &image_height);
    if (pixels == NULL || entry == NULL || cJSON_GetArraySize(position) != 3) {
        fail(path, "is no frame's sidecar");
    }
    if (x < 0 || y < 0 || width < 1 || height < 1 || x + width > image_width || y + height > image_height ||
        width > FRAMES_SIDE_PX || height > FRAMES_SIDE_PX) {
        fail(path, "region outside the picture, or too large");
    }
    printf("static const uint8_t pixels_%d[] = {", index);
    for (row = 0; row < height; row++) {
        for (column = 0; column < width; column++) {
            printf("%s%d,", column % 24 == 0 ? "\n    " : "", pixels[(y + row) * image_width + x + column]);
        }
    }
    printf("};\n");
    for (row = 0; row < 5; row++) {
        k[row] = q16(number(json, "camera", lens[row], 0.0));
    }
    snprintf(entry, 1024,
             "    {\"%.*s\", {pixels_%d, %d, %d, %d}, {%ld, %ld, %ld, %ld, %ld, %ld, %ld, %ld, %ld}, "
             "{%ld, %ld, %ld}, {%ld, %ld, %ld}},\n",
             (int)strcspn(image, "."), image, index, width, height, width, q16(number(json, "camera", "fx_px", NAN)),
             q16(number(json, "camera", "fy_px", NAN)), q16(number(json, "camera", "cx_px", NAN) - x),
             q16(number(json, "camera", "cy_px", NAN) - y), k[0], k[1], k[2], k[3], k[4],
             q16(number(json, "drogue", "rim_radius_m", NAN)), q16(number(json, "drogue", "inner_radius_m", NAN)),
             q16(number(json, "drogue", "inner_depth_m", NAN)), q16(cJSON_GetArrayItem(position, 0)->valuedouble),
             q16(cJSON_GetArrayItem(position, 1)->valuedouble), q16(cJSON_GetArrayItem(position, 2)->valuedouble));
    free(pixels);
    cJSON_Delete(json);
    return entry;
}

int main(int argc, char **argv)
{
    char **entries = calloc((size_t)argc, sizeof *entries);
    int i, demo = 0;
    if (argc < 2 || entries == NULL) {
        fail("usage", "make_frames FILE.json... >frames.c");
    }
    puts("/* Generated by make_frames. */\n#include \"frames.h\"\n");
    for (i = 1; i < argc; i++) {
        entries[i] = write_frame(argv[i], i);
        demo = strstr(entries[i], "{\"demo\"") != NULL ? i : demo;
    }
    if (demo == 0) {
        fail("frames", "demo is not among them");
    }
    puts("const frame frames[] = {");
    for (i = 1; i < argc; i++) {
        fputs(entries[i], stdout);
        free(entries[i]);
    }
    puts("};\nconst size_t frame_count = sizeof frames / sizeof frames[0];");
    printf("const frame *const frame_demo = &frames[%d];\n", demo - 1);
    free(entries);
    return ferror(stdout) || fclose(stdout) != 0 ? 2 : 0;
}
