/* SPDX-License-Identifier: Apache-2.0 */
/* Writes a set of vectors with one case a stage, from the library itself: something to try the runner on, and to
 * spoil. Where the class is lsb, the first word that may differ is off by its bound.
 * usage: tiny_vectors FOLDER */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "conformance.h"

#define ONE 65536
#define SIDE 96
#define COUNT(array) (sizeof(array) / sizeof *(array))

static const char *folder;
static FILE *manifest;

static void *checked(void *p, const char *path)
{
    if (p == NULL) {
        perror(path);
        exit(1);
    }
    return p;
}

static void path_of(char path[1024], const char *file) { snprintf(path, 1024, "%s/%s", folder, file); }

static void sha_of_file(char hex[SHA256_HEX], const char *file)
{
    char path[1024];
    sha256 s;
    FILE *in;
    int c;
    path_of(path, file);
    in = checked(fopen(path, "rb"), path);
    sha256_init(&s);
    while ((c = getc(in)) != EOF) {
        uint8_t byte = (uint8_t)c;
        sha256_add(&s, &byte, 1);
    }
    fclose(in);
    sha256_end(hex, &s);
}

static void write_image(const char *path, const conf_array *a)
{
    png_image png;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    png.width = (png_uint_32)a->width_px;
    png.height = (png_uint_32)a->height_px;
    png.format = PNG_FORMAT_GRAY;
    if (!png_image_write_to_file(&png, path, 0, a->data, 0, NULL)) {
        fprintf(stderr, "%s: %s\n", path, png.message);
        exit(1);
    }
}

/* The file of an array, off by 'off' LSB in word 'at', and its entry in the manifest. */
static void write_array(const char *id, const conf_array *a, const char *end, const char *class, size_t at, int off)
{
    char file[256];
    char path[1024];
    char hex[SHA256_HEX];
    snprintf(file, sizeof file, "%s.%s%s.%s", id, a->name, end, a->width_px > 0 ? "png" : "hex");
    path_of(path, file);
    if (a->width_px > 0) {
        write_image(path, a);
    } else {
        FILE *out = checked(fopen(path, "wb"), path);
        size_t i;
        for (i = 0; i < a->count; i++) {
            conf_hex_word(hex, conf_word(a, i) + (i == at ? off : 0), a->bits);
            fprintf(out, "%s\n", hex);
        }
        fclose(out);
    }
    sha_of_file(hex, file);
    fprintf(manifest, "        {\"name\": \"%s\", \"file\": \"%s\", \"bits\": %d, ", a->name, file, a->bits);
    if (a->width_px > 0) {
        fprintf(manifest, "\"width\": %d, \"height\": %d, ", (int)a->width_px, (int)a->height_px);
    } else {
        fprintf(manifest, "\"count\": %lu, ", (unsigned long)a->count);
    }
    fprintf(manifest, "%s\"sha256\": \"%s\"}", class, hex);
}

/* A case; bound: list of bounds of the first output, NULL when all are exact; the first bound above 0 is used up. */
static void write_case(const char *stage, const conf_array *inputs, int input_count, const char *bound, size_t at,
                       int off)
{
    static int written;
    conf_array outputs[CONF_MAX_OUTPUTS];
    char id[64];
    char path[1024];
    char class[96];
    int count = conf_run_stage(stage, inputs, input_count, outputs, CONF_MAX_OUTPUTS);
    int i;
    if (count < 0) {
        fprintf(stderr, "%s: %s\n", stage, conf_failure_text(count));
        exit(1);
    }
    path_of(path, stage);
    (void)mkdir(path, 0777);
    snprintf(id, sizeof id, "%s/tiny", stage);
    fprintf(manifest, "%s    {\"id\": \"%s\", \"stage\": \"%s\", \"tier\": \"ordinary\", \"flags\": [\"tiny\"],\n",
            written++ ? ",\n" : "", id, stage);
    fprintf(manifest, "      \"origin\": {\"seed\": 0, \"generator\": \"tiny\"},\n      \"inputs\": [\n");
    for (i = 0; i < input_count; i++) {
        write_array(id, &inputs[i], "", "", 0, 0);
        fputs(i + 1 < input_count ? ",\n" : "],\n", manifest);
    }
    snprintf(class, sizeof class, "\"class\": \"lsb\", \"bound\": %s, ", bound != NULL ? bound : "");
    fprintf(manifest, "      \"reference\": [\n");
    write_array(id, &outputs[0], ".ref", bound != NULL ? class : "\"class\": \"exact\", ", at, off);
    for (i = 1; i < count; i++) {
        fputs(",\n", manifest);
        write_array(id, &outputs[i], ".ref", "\"class\": \"exact\", ", 0, 0);
    }
    fprintf(manifest, "],\n      \"exact\": [\n");
    for (i = 0; i < count; i++) {
        write_array(id, &outputs[i], ".out", "\"class\": \"exact\", ", 0, 0);
        fputs(i + 1 < count ? ",\n" : "]}", manifest);
    }
}

static conf_array words(const char *name, int bits, size_t count, const void *data)
{
    conf_array a = {NULL, 0, 0, NULL, 0, 0};
    a.name = name;
    a.bits = bits;
    a.count = count;
    a.data = data;
    return a;
}

/* A dark ellipse with a black disc in it, on a bright ground with some texture. */
static conf_array picture(uint8_t *pixels)
{
    conf_array a = words("image", 8, SIDE * SIDE, pixels);
    int x;
    int y;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            int dx = 10 * x - 470;
            int dy = 11 * y - 520;
            int d = dx * dx + dy * dy;
            int shade = d < 100 * 100 ? 10 : d < 360 * 360 ? 90 : 190;
            pixels[y * SIDE + x] = (uint8_t)(shade + (x * 7 + y * 13) % 5);
        }
    }
    a.width_px = a.height_px = SIDE;
    return a;
}

static void pixel_cases(const conf_array *image)
{
    static const int32_t canny[] = {40, 100, 1};
    static const int32_t mask[] = {33, 21, 32, 20, 33};
    static const int32_t arcs[] = {40, 100, 1, 1, SIDE - 1, SIDE - 1, SIDE, 10};
    conf_array in[2];
    in[0] = *image;
    write_case("smooth", in, 1, NULL, 0, 0);
    write_case("gradient", in, 1, NULL, 0, 0);
    in[1] = words("params", 32, COUNT(canny), canny);
    write_case("canny", in, 2, NULL, 0, 0);
    in[0] = words("params", 32, COUNT(mask), mask);
    write_case("mask", in, 1, NULL, 0, 0);
    in[0] = *image;
    in[1] = words("params", 32, COUNT(arcs), arcs);
    write_case("arcs", in, 2, NULL, 0, 0);
}

static void geometry_cases(void)
{
    static const int16_t arc[] = {30, 4, 31, 4, 32, 5, 33, 5, 34, 6, 35, 7, 36, 8, 36, 9, 37, 10};
    static const int32_t constraints[] = {40, 40, 41, 0, 98304};
    static const int16_t points[] = {100, 0, 71, 42, 0, 60, -71, 42, -100, 0, -71, -42, 0, -60, 71, -42};
    static const int32_t frac_bits[] = {2};
    static const int32_t ellipse[] = {0, 0, 25 * ONE, 15 * ONE, 0};
    static const int32_t near_points[] = {25 * ONE, 0, 0, 15 * ONE, -24 * ONE, 0, 0, 0};
    static const int32_t quality[] = {ONE, 6 * ONE, 19661};
    static const int32_t candidates[] = {0,   0, 25 * ONE, 15 * ONE, 0, 60000, 0,
                                         ONE, 0, 25 * ONE, 15 * ONE, 0, 50000, 0};
    static const int32_t config[] = {3 * ONE, 3 * ONE, 3 * ONE, 13107, 58982};
    static const int32_t arcs[] = {9, 0};
    static const int32_t select[] = {40, 40, 41, 98304, 2};
    static const int32_t edges[] = {800, 0, 90, 0, 0, 480, 0, 70, 400, 300, 50, 50, 500, 20, 90, 1};
    static const int32_t band[] = {ONE, 57016, 1, 2};
    static const int64_t matrix[] = {INT64_C(1) << 58, 12345, -(INT64_C(1) << 50),
                                     INT64_C(1) << 57, 999,   -(INT64_C(1) << 56)};
    conf_array in[3];
    in[0] = words("points", 16, COUNT(arc), arc);
    in[1] = words("params", 32, COUNT(constraints), constraints);
    write_case("constraints", in, 2, "[4, 4, 4, 4, 0, 0]", 0, -4);
    in[1] = words("arcs", 32, COUNT(arcs), arcs);
    in[2] = words("params", 32, COUNT(select), select);
    write_case("select", in, 3, NULL, 0, 0);
    in[0] = words("points", 16, COUNT(points), points);
    in[1] = words("params", 32, 1, frac_bits);
    write_case("ellipse", in, 2, "[0, 4, 4, 4, 4, 64]", 1, 4);
    in[0] = words("ellipse", 32, COUNT(ellipse), ellipse);
    in[1] = words("points", 32, COUNT(near_points), near_points);
    in[2] = words("params", 32, COUNT(quality), quality);
    write_case("quality", in, 3, "4", 0, 4);
    in[1] = words("edges", 32, COUNT(edges), edges);
    in[2] = words("params", 32, COUNT(band), band);
    write_case("support", in, 3, NULL, 0, 0);
    in[0] = words("candidates", 32, COUNT(candidates), candidates);
    in[1] = words("config", 32, COUNT(config), config);
    write_case("cluster", in, 2, NULL, 0, 0);
    in[0] = words("matrix", 64, COUNT(matrix), matrix);
    write_case("eigen", in, 1, "2", 0, 2);
}

static void pose_cases(const conf_array *image)
{
    static const int32_t ellipse[] = {300 * ONE, 200 * ONE, 40 * ONE, 35 * ONE, 30000};
    static const int32_t camera[] = {1465 * ONE, 1465 * ONE, 320 * ONE, 240 * ONE, -9000, 3000, 60, -70, 10};
    static const int32_t pixels[] = {10 * ONE, 20 * ONE, 600 * ONE, 400 * ONE, INT32_MAX, INT32_MIN};
    static const int32_t pose[] = {22938, 16384, 302 * ONE, 203 * ONE};
    static const int32_t model[] = {22938, 6554, 16384};
    static const int32_t region[] = {2, 3, 90, 90};
    /* model, start, inner part, shading and blur, gradient, steps */
    static const int32_t joint[] = {22938, 7864, 16384, -10000, -20000, 850000, 9000, -8000,
                                    0,     0,    0,     249037, 7864,   300000, 5};
    static int32_t bins[64];
    static int32_t filter[26];
    static int32_t frames[4 * 10];
    conf_array in[4];
    int i;
    in[0] = words("camera", 32, COUNT(camera), camera);
    in[1] = words("points", 32, COUNT(pixels), pixels);
    write_case("undistort", in, 2, "[0, 4, 4]", 1, 4);
    in[0] = words("ellipse", 32, COUNT(ellipse), ellipse);
    in[1] = words("camera", 32, COUNT(camera), camera);
    in[2] = words("params", 32, COUNT(pose), pose);
    write_case("pose", in, 3, "[0, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 0, 8, 8, 8]", 1, 4);
    for (i = 0; i < 64; i++) {
        bins[i] = i % 2 == 0 ? 7 : (i * 29) % 41 - 20;
    }
    in[2] = words("bins", 32, COUNT(bins), bins);
    in[3] = words("params", 32, COUNT(joint), joint);
    write_case("joint", in, 4, "[0, 4, 4, 4, 4, 4, 4, 4, 4, 4]", 1, 4);
    for (i = 0; i < 26; i++) {
        filter[i] = i == 0 ? 20000 : 2000 * i;
    }
    for (i = 0; i < 40; i++) {
        frames[i] = i / 10 == 2 && i % 10 >= 5 ? 0 : 3000 + 77 * i; /* the third is missed */
    }
    in[0] = words("params", 32, COUNT(filter), filter);
    in[1] = words("frames", 32, COUNT(frames), frames);
    write_case("kalman", in, 2, "16", 0, 16);
    in[0] = *image;
    in[1] = words("camera", 32, COUNT(camera), camera);
    in[2] = words("model", 32, COUNT(model), model);
    in[3] = words("region", 32, COUNT(region), region);
    write_case("frame", in, 4, NULL, 0, 0);
}

int main(int argc, char **argv)
{
    static uint8_t pixels[SIDE * SIDE];
    char path[1024];
    conf_array image = picture(pixels);
    FILE *version;
    if (argc != 2) {
        fputs("usage: tiny_vectors FOLDER\n", stderr);
        return 2;
    }
    folder = argv[1];
    (void)mkdir(folder, 0777);
    path_of(path, "VERSION");
    version = checked(fopen(path, "wb"), path);
    fputs("0.0.1\n", version);
    fclose(version);
    path_of(path, "manifest.json");
    manifest = checked(fopen(path, "wb"), path);
    fputs("{\"schema\": \"manifest.schema.json\", \"version\": \"0.0.1\", \"opencv\": \"none\",\n  \"cases\": [\n",
          manifest);
    pixel_cases(&image);
    geometry_cases();
    pose_cases(&image);
    fputs("\n]}\n", manifest);
    return fclose(manifest) != 0;
}
