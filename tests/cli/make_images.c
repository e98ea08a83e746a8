/* SPDX-License-Identifier: Apache-2.0 */
/* The images that the end-to-end tests look at, written into a folder.
 *
 * usage: make_images FOLDER */
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    SCENE_WIDTH = 320,
    SCENE_HEIGHT = 240,
    SCENE_RADIUS = 80,
    LARGE_WIDTH = 2400,
    TRACK_FRAMES = 16,
    TRACK_SEEN = 4,
    TRACK_STEP_PX = 2,
    HUGE_SIDE = 900000
};

static const char *folder;

static uint8_t *allocate(int width, int height)
{
    uint8_t *grey = calloc((size_t)width * (size_t)height, 1);
    if (grey == NULL) {
        fprintf(stderr, "make_images: out of memory\n");
        exit(EXIT_FAILURE);
    }
    return grey;
}

static FILE *open_file(const char *name)
{
    char path[4096];
    FILE *file;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    file = fopen(path, "wb");
    if (file == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    return file;
}

/* Write grey levels as another kind of PNG that holds the same colours. */
static void write_as(const char *name, const uint8_t *grey, int width, int height, int kind, int depth, int interlace)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    size_t samples;
    FILE *file = open_file(name);
    size_t bytes = (size_t)depth / 8;
    png_bytep *rows = calloc((size_t)height, sizeof *rows);
    png_bytep data;
    int x, y;
    size_t s, b;
    if (rows == NULL || setjmp(png_jmpbuf(png)) != 0) {
        fprintf(stderr, "make_images: cannot write %s\n", name);
        exit(EXIT_FAILURE);
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, depth, kind, interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (kind == PNG_COLOR_TYPE_PALETTE) {
        png_color palette[256];
        for (x = 0; x < 256; x++) {
            palette[x].red = palette[x].green = palette[x].blue = (png_byte)x;
        }
        png_set_PLTE(png, info, palette, 256);
    }
    png_write_info(png, info);
    samples = png_get_channels(png, info);
    data = allocate(width * (int)(samples * bytes), height);
    for (y = 0; y < height; y++) {
        rows[y] = data + (size_t)y * (size_t)width * samples * bytes;
        for (x = 0; x < width; x++) {
            for (s = 0; s < samples; s++) {
                int alpha = (kind & PNG_COLOR_MASK_ALPHA) != 0 && s + 1 == samples;
                for (b = 0; b < bytes; b++) {
                    rows[y][((size_t)x * samples + s) * bytes + b] =
                        alpha ? (png_byte)(x * 7 + y) : grey[(size_t)y * (size_t)width + (size_t)x];
                }
            }
        }
    }
    png_write_image(png, rows);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    free(data);
    free(rows);
    fclose(file);
}

static void write_grey(const char *name, const uint8_t *grey, int width, int height)
{
    write_as(name, grey, width, height, PNG_COLOR_TYPE_GRAY, 8, PNG_INTERLACE_NONE);
}

static void write_level(const char *name, int level, int width, int height)
{
    uint8_t *grey = allocate(width, height);
    memset(grey, level, (size_t)width * (size_t)height);
    write_grey(name, grey, width, height);
    free(grey);
}

static void write_noise(const char *name, int width, int height)
{
    uint8_t *grey = allocate(width, height);
    uint32_t state = 1;
    int i;
    for (i = 0; i < width * height; i++) {
        state = state * UINT32_C(1664525) + UINT32_C(1013904223);
        grey[i] = (uint8_t)(state >> 24);
    }
    write_grey(name, grey, width, height);
    free(grey);
}

/* Columns left of the middle dark, the others bright. */
static void write_step(const char *name, int width, int height)
{
    uint8_t *grey = allocate(width, height);
    int i;
    for (i = 0; i < width * height; i++) {
        grey[i] = i % width < width / 2 ? 40 : 200;
    }
    write_grey(name, grey, width, height);
    free(grey);
}

/* A drogue seen head-on: a grey disc, a dark disc in its middle; 8 x 8 samples a pixel.
 *
 *  x16, y16  centre in sixteenths of a pixel
 *  left, right  the sky's level in the halves of the image */
static uint8_t *draw_against(int x16, int y16, int left, int right)
{
    uint8_t *grey = allocate(SCENE_WIDTH, SCENE_HEIGHT);
    int x, y, i, j;
    for (y = 0; y < SCENE_HEIGHT; y++) {
        for (x = 0; x < SCENE_WIDTH; x++) {
            int sum = 0;
            for (j = -7; j <= 7; j += 2) {
                for (i = -7; i <= 7; i += 2) {
                    long dx = 16L * x + i - x16, dy = 16L * y + j - y16;
                    long distance2 = dx * dx + dy * dy;
                    const long rim = 16L * SCENE_RADIUS, inner = 16L * SCENE_RADIUS / 2;
                    sum += distance2 <= inner * inner ? 25
                           : distance2 <= rim * rim   ? 120
                           : x <= SCENE_WIDTH / 2     ? left
                                                      : right;
                }
            }
            grey[y * SCENE_WIDTH + x] = (uint8_t)((sum + 32) / 64);
        }
    }
    return grey;
}

/* The scene at the right end of an image wider than a region may be. */
static void write_large_scene(const char *name, const uint8_t *scene)
{
    uint8_t *grey = allocate(LARGE_WIDTH, SCENE_HEIGHT);
    int y;
    memset(grey, 205, (size_t)LARGE_WIDTH * SCENE_HEIGHT);
    for (y = 0; y < SCENE_HEIGHT; y++) {
        memcpy(grey + (y + 1) * LARGE_WIDTH - SCENE_WIDTH, scene + y * SCENE_WIDTH, SCENE_WIDTH);
    }
    write_grey(name, grey, LARGE_WIDTH, SCENE_HEIGHT);
    free(grey);
}

static uint8_t *draw_scene(int x16, int y16) { return draw_against(x16, y16, 205, 205); }

/* The scene without the dark disc. */
static void write_alone(const char *name, const uint8_t *scene)
{
    uint8_t *grey = allocate(SCENE_WIDTH, SCENE_HEIGHT);
    int i;
    for (i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
        grey[i] = scene[i] < 120 ? 120 : scene[i];
    }
    write_grey(name, grey, SCENE_WIDTH, SCENE_HEIGHT);
    free(grey);
}

static void write_scenes(void)
{
    uint8_t *grey = draw_scene(16 * 161 + 4, 16 * 118 + 8);
    int i;
    write_grey("scene.png", grey, SCENE_WIDTH, SCENE_HEIGHT);
    write_large_scene("scene_large.png", grey);
    write_alone("scene_alone.png", grey);
    write_as("scene_grey16.png", grey, SCENE_WIDTH, SCENE_HEIGHT, PNG_COLOR_TYPE_GRAY, 16, PNG_INTERLACE_NONE);
    write_as("scene_grey_alpha.png", grey, SCENE_WIDTH, SCENE_HEIGHT, PNG_COLOR_TYPE_GRAY_ALPHA, 8, PNG_INTERLACE_NONE);
    write_as("scene_rgb.png", grey, SCENE_WIDTH, SCENE_HEIGHT, PNG_COLOR_TYPE_RGB, 8, PNG_INTERLACE_ADAM7);
    write_as("scene_rgba16.png", grey, SCENE_WIDTH, SCENE_HEIGHT, PNG_COLOR_TYPE_RGB_ALPHA, 16, PNG_INTERLACE_ADAM7);
    write_as("scene_palette.png", grey, SCENE_WIDTH, SCENE_HEIGHT, PNG_COLOR_TYPE_PALETTE, 8, PNG_INTERLACE_NONE);
    free(grey);
    grey = draw_against(16 * 161 + 4, 16 * 118 + 8, 45, 45);
    write_grey("scene_bright.png", grey, SCENE_WIDTH, SCENE_HEIGHT);
    free(grey);
    grey = draw_against(16 * 161 + 4, 16 * 118 + 8, 205, 45);
    write_grey("scene_mixed.png", grey, SCENE_WIDTH, SCENE_HEIGHT);
    free(grey);
    grey = draw_scene(16 * 100, 16 * 70);
    write_grey("scene_cut.png", grey, SCENE_WIDTH, SCENE_HEIGHT);
    free(grey);
    for (i = 0; i < TRACK_FRAMES; i++) {
        char name[32];
        snprintf(name, sizeof name, "frame%02d.png", i);
        if (i < TRACK_SEEN) {
            grey = draw_scene(16 * (160 + TRACK_STEP_PX * i), 16 * 119);
            write_grey(name, grey, SCENE_WIDTH, SCENE_HEIGHT);
            free(grey);
        } else {
            write_level(name, 128, SCENE_WIDTH, SCENE_HEIGHT);
        }
    }
}

/* A header that promises a huge image, and the start of its data. */
static void write_huge(const char *name)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE *file = open_file(name);
    static const png_byte start[] = {0x78, 0x9C};
    if (setjmp(png_jmpbuf(png)) != 0) {
        exit(EXIT_FAILURE);
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, HUGE_SIDE, HUGE_SIDE, 8, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    png_write_chunk(png, (png_const_bytep) "IDAT", start, sizeof start);
    png_destroy_write_struct(&png, &info);
    fclose(file);
}

/* The grey levels of a file as they are, on standard output. */
static int print_raw(const char *path)
{
    png_image image;
    uint8_t *grey;
    int good;
    memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path)) {
        return EXIT_FAILURE;
    }
    image.format = PNG_FORMAT_GRAY;
    grey = allocate((int)image.width, (int)image.height);
    good = png_image_finish_read(&image, NULL, grey, 0, NULL) &&
           fwrite(grey, image.width, image.height, stdout) == image.height;
    free(grey);
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char **argv)
{
    if (argc == 3 && strcmp(argv[1], "--raw") == 0) {
        return print_raw(argv[2]);
    }
    if (argc != 2) {
        fprintf(stderr, "usage: make_images FOLDER\n       make_images --raw FILE.png >GREY\n");
        return EXIT_FAILURE;
    }
    folder = argv[1];
    write_scenes();
    write_level("black.png", 0, 64, 48);
    write_level("white.png", 255, 64, 48);
    write_level("one.png", 77, 1, 1);
    write_level("two.png", 77, 2, 2);
    write_level("wide.png", 10, 10000, 1);
    write_level("tall.png", 10, 1, 2048);
    write_level("large.png", 10, 2049, 20);
    write_level("widest.png", 10, 32768, 1);
    write_level("tallest.png", 10, 1, 32768);
    write_noise("noise.png", 256, 200);
    write_noise("noise_full.png", 2048, 2048);
    write_step("step.png", 40, 30);
    write_huge("huge.png");
    return EXIT_SUCCESS;
}
