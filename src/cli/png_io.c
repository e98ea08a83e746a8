/* SPDX-License-Identifier: Apache-2.0 */
/* libpng, with its errors turned into one complaint and its warnings kept quiet. */
#include "png_io.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

/* One file being read or written; reached by pointer only, so that longjmp leaves it alone. */
typedef struct transfer {
    const char *path;
    FILE *file;
    picture *image;
    png_bytep *rows;
    png_structp png;
    png_infop info;
} transfer;

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

static void on_error(png_structp png, png_const_charp reason)
{
    const transfer *t = png_get_error_ptr(png);
    complain(t->path, "%s", reason);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp reason)
{
    (void)png;
    (void)reason;
}

static void read_bytes(png_structp png, png_bytep out, size_t count)
{
    transfer *t = png_get_io_ptr(png);
    if (fread(out, 1, count, t->file) != count) {
        png_error(png, ferror(t->file) ? strerror(errno) : "the file ends early");
    }
}

static void write_bytes(png_structp png, png_bytep bytes, size_t count)
{
    transfer *t = png_get_io_ptr(png);
    if (fwrite(bytes, 1, count, t->file) != count) {
        png_error(png, strerror(errno));
    }
}

static void flush_bytes(png_structp png) { (void)png; }

static int make_rows(transfer *t)
{
    size_t stride = (size_t)t->image->width_px * (size_t)t->image->channels;
    int32_t y;
    t->rows = malloc((size_t)t->image->height_px * sizeof *t->rows);
    if (t->rows == NULL) {
        return complain(t->path, "out of memory");
    }
    for (y = 0; y < t->image->height_px; y++) {
        t->rows[y] = t->image->data + (size_t)y * stride;
    }
    return EXIT_MEASURED;
}

/* Take the header, and ask for 8-bit grey or RGB without alpha. */
static int read_header(transfer *t)
{
    png_uint_32 width, height;
    png_set_user_limits(t->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_read_info(t->png, t->info);
    width = png_get_image_width(t->png, t->info);
    height = png_get_image_height(t->png, t->info);
    if ((uint64_t)width * height > PICTURE_MAX_PIXELS) {
        return complain(t->path, "%lux%lu pixels are more than the %u that are read", (unsigned long)width,
                        (unsigned long)height, PICTURE_MAX_PIXELS);
    }
    png_set_palette_to_rgb(t->png);
    png_set_expand_gray_1_2_4_to_8(t->png);
    png_set_scale_16(t->png);
    png_set_strip_alpha(t->png);
    (void)png_set_interlace_handling(t->png);
    png_read_update_info(t->png, t->info);
    return picture_create(t->image, t->path, (int32_t)width, (int32_t)height, png_get_channels(t->png, t->info));
}

static int read_image(transfer *t)
{
    t->png = png_create_read_struct(PNG_LIBPNG_VER_STRING, t, on_error, on_warning);
    if (t->png == NULL) {
        return complain(t->path, "out of memory");
    }
    t->info = png_create_info_struct(t->png);
    if (t->info == NULL) {
        return complain(t->path, "out of memory");
    }
    if (setjmp(png_jmpbuf(t->png)) != 0) {
        return EXIT_BAD;
    }
    png_set_crc_action(t->png, PNG_CRC_DEFAULT, PNG_CRC_ERROR_QUIT); /* those of ancillary chunks, too */
    png_set_read_fn(t->png, t, read_bytes);
    png_set_sig_bytes(t->png, 8);
    if (read_header(t) || make_rows(t)) {
        return EXIT_BAD;
    }
    png_read_image(t->png, t->rows);
    png_read_end(t->png, NULL);
    return EXIT_MEASURED;
}

int png_read(picture *out, FILE *in, const char *path)
{
    transfer t;
    int bad;
    memset(out, 0, sizeof *out);
    memset(&t, 0, sizeof t);
    t.path = path;
    t.image = out;
    t.file = in;
    bad = read_image(&t);
    png_destroy_read_struct(&t.png, &t.info, NULL);
    free(t.rows);
    if (bad) {
        picture_free(out);
    }
    return bad ? EXIT_BAD : EXIT_MEASURED;
}

static int write_image(transfer *t)
{
    t->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, t, on_error, on_warning);
    if (t->png == NULL) {
        return complain(t->path, "out of memory");
    }
    t->info = png_create_info_struct(t->png);
    if (t->info == NULL) {
        return complain(t->path, "out of memory");
    }
    if (setjmp(png_jmpbuf(t->png)) != 0) {
        return EXIT_BAD;
    }
    png_set_write_fn(t->png, t, write_bytes, flush_bytes);
    png_set_user_limits(t->png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
    png_set_IHDR(t->png, t->info, (png_uint_32)t->image->width_px, (png_uint_32)t->image->height_px, 8,
                 t->image->channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(t->png, t->info);
    png_write_image(t->png, t->rows);
    png_write_end(t->png, t->info);
    return EXIT_MEASURED;
}

int picture_write(const picture *image, const char *path)
{
    transfer t;
    picture shallow = *image;
    int bad;
    memset(&t, 0, sizeof t);
    t.path = path;
    t.image = &shallow;
    t.file = strcmp(path, "-") == 0 ? stdout : fopen(path, "wb");
    if (t.file == NULL) {
        return complain(path, "%s", strerror(errno));
    }
    bad = make_rows(&t) || write_image(&t);
    png_destroy_write_struct(&t.png, &t.info);
    free(t.rows);
    if ((t.file == stdout ? fflush(stdout) : fclose(t.file)) != 0 && !bad) {
        return complain(path, "%s", strerror(errno));
    }
    return bad ? EXIT_BAD : EXIT_MEASURED;
}
