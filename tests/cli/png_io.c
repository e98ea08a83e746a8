/* SPDX-License-Identifier: Apache-2.0 */
/* Every kind of PNG becomes the grey that src/cli/png_io.h promises, checked pixel by pixel. */
#include "suite.h"

#include <png.h>

#include "cli.h"
#include "images.h"
#include "png_io.h"

static const char PATH[] = "png_io_test.png";

/* A kind of file, and random samples of that kind. */
typedef struct specimen {
    int kind; /* PNG_COLOR_TYPE_ */
    int depth;
    int interlace;
    int transparency; /* a tRNS chunk */
    int width, height;
    int channels;
    uint16_t *samples;
    png_color palette[256];
} specimen;

static int channels_of(int kind)
{
    return (kind == PNG_COLOR_TYPE_RGB || kind == PNG_COLOR_TYPE_RGB_ALPHA ? 3 : 1) +
           ((kind & PNG_COLOR_MASK_ALPHA) != 0 ? 1 : 0);
}

static void fill(specimen *s, uint64_t *seed)
{
    size_t count, i;
    s->channels = channels_of(s->kind);
    count = (size_t)(s->width * s->height * s->channels);
    s->samples = malloc(count * sizeof *s->samples);
    ck_assert_ptr_nonnull(s->samples);
    for (i = 0; i < count; i++) {
        s->samples[i] = (uint16_t)(rng_u64(seed) & ((1u << s->depth) - 1));
    }
    for (i = 0; i < 256; i++) {
        s->palette[i].red = (png_byte)rng_u64(seed);
        s->palette[i].green = (png_byte)rng_u64(seed);
        s->palette[i].blue = (png_byte)rng_u64(seed);
    }
}

static void write_transparency(png_structp png, png_infop info, const specimen *s)
{
    png_byte alpha[2] = {0, 100};
    png_color_16 colour;
    memset(&colour, 0, sizeof colour);
    colour.gray = s->samples[0];
    colour.red = s->samples[0];
    colour.green = s->channels >= 3 ? s->samples[1] : 0;
    colour.blue = s->channels >= 3 ? s->samples[2] : 0;
    png_set_tRNS(png, info, alpha, s->kind == PNG_COLOR_TYPE_PALETTE ? 2 : 0,
                 s->kind == PNG_COLOR_TYPE_PALETTE ? NULL : &colour);
}

static void write_specimen(const specimen *s)
{
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    FILE *file = fopen(PATH, "wb");
    size_t row_samples = (size_t)(s->width * s->channels);
    size_t bytes = s->depth == 16 ? 2 : 1;
    png_byte *data = malloc(row_samples * bytes * (size_t)s->height);
    png_bytep *rows = malloc((size_t)s->height * sizeof *rows);
    char key[] = "Comment", words[] = "of no weight";
    png_text text;
    size_t i;
    memset(&text, 0, sizeof text);
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key;
    text.text = words;
    text.text_length = sizeof words - 1;
    ck_assert(file != NULL && data != NULL && rows != NULL);
    for (i = 0; i < row_samples * (size_t)s->height; i++) {
        if (bytes == 2) {
            data[2 * i] = (png_byte)(s->samples[i] >> 8);
            data[2 * i + 1] = (png_byte)(s->samples[i] & 255);
        } else {
            data[i] = (png_byte)s->samples[i];
        }
    }
    for (i = 0; i < (size_t)s->height; i++) {
        rows[i] = data + i * row_samples * bytes;
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)s->width, (png_uint_32)s->height, s->depth, s->kind, s->interlace,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_gAMA(png, info, 1.0); /* must not matter */
    png_set_text(png, info, &text, 1);
    if (s->kind == PNG_COLOR_TYPE_PALETTE) {
        png_set_PLTE(png, info, s->palette, 1 << s->depth);
    }
    if (s->transparency) {
        write_transparency(png, info, s);
    }
    png_write_info(png, info);
    png_set_packing(png);
    png_write_image(png, rows);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    fclose(file);
    free(data);
    free(rows);
}

/* round(v * 255 / most) */
static unsigned to_8_bit(unsigned v, int depth)
{
    unsigned most = (1u << depth) - 1;
    return (unsigned)(((uint64_t)v * 510 + most) / (2 * (uint64_t)most));
}

static unsigned grey_of(unsigned r, unsigned g, unsigned b) { return (77 * r + 150 * g + 29 * b + 128) / 256; }

static unsigned expected_grey(const specimen *s, size_t pixel)
{
    const uint16_t *v = s->samples + pixel * (size_t)s->channels;
    if (s->kind == PNG_COLOR_TYPE_PALETTE) {
        return grey_of(s->palette[v[0]].red, s->palette[v[0]].green, s->palette[v[0]].blue);
    }
    if (s->channels < 3) {
        return to_8_bit(v[0], s->depth);
    }
    return grey_of(to_8_bit(v[0], s->depth), to_8_bit(v[1], s->depth), to_8_bit(v[2], s->depth));
}

static void check_specimen(specimen *s, uint64_t *seed)
{
    picture grey;
    size_t i;
    fill(s, seed);
    write_specimen(s);
    ck_assert_int_eq(picture_read_grey(&grey, PATH), EXIT_MEASURED);
    ck_assert_int_eq(grey.width_px, s->width);
    ck_assert_int_eq(grey.height_px, s->height);
    ck_assert_int_eq(grey.channels, 1);
    for (i = 0; i < (size_t)(s->width * s->height); i++) {
        MUST(grey.data[i] == expected_grey(s, i), "kind %d, %d bit, interlace %d, tRNS %d, pixel %d: %d, not %u",
             s->kind, s->depth, s->interlace, s->transparency, (int)i, grey.data[i], expected_grey(s, i));
    }
    picture_free(&grey);
    free(s->samples);
}

START_TEST(every_kind_reads_as_documented)
{
    static const int kinds[][2] = {
        {PNG_COLOR_TYPE_GRAY, 1},        {PNG_COLOR_TYPE_GRAY, 2},      {PNG_COLOR_TYPE_GRAY, 4},
        {PNG_COLOR_TYPE_GRAY, 8},        {PNG_COLOR_TYPE_GRAY, 16},     {PNG_COLOR_TYPE_PALETTE, 1},
        {PNG_COLOR_TYPE_PALETTE, 2},     {PNG_COLOR_TYPE_PALETTE, 4},   {PNG_COLOR_TYPE_PALETTE, 8},
        {PNG_COLOR_TYPE_RGB, 8},         {PNG_COLOR_TYPE_RGB, 16},      {PNG_COLOR_TYPE_GRAY_ALPHA, 8},
        {PNG_COLOR_TYPE_GRAY_ALPHA, 16}, {PNG_COLOR_TYPE_RGB_ALPHA, 8}, {PNG_COLOR_TYPE_RGB_ALPHA, 16}};
    static const int sizes[][2] = {{1, 1}, {13, 7}, {300, 5}};
    uint64_t seed = 5;
    size_t k, size;
    int interlace, transparency;
    for (k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
        for (size = 0; size < sizeof sizes / sizeof sizes[0]; size++) {
            for (interlace = PNG_INTERLACE_NONE; interlace <= PNG_INTERLACE_ADAM7; interlace++) {
                for (transparency = 0; transparency <= !(kinds[k][0] & PNG_COLOR_MASK_ALPHA); transparency++) {
                    specimen s;
                    memset(&s, 0, sizeof s);
                    s.kind = kinds[k][0];
                    s.depth = kinds[k][1];
                    s.interlace = interlace;
                    s.transparency = transparency;
                    s.width = sizes[size][0];
                    s.height = sizes[size][1];
                    check_specimen(&s, &seed);
                }
            }
        }
    }
}
END_TEST

static void write_bytes_of(const uint8_t *bytes, size_t count)
{
    FILE *file = fopen(PATH, "wb");
    ck_assert(file != NULL && fwrite(bytes, 1, count, file) == count);
    fclose(file);
}

static int reads(const uint8_t *bytes, size_t count)
{
    picture grey;
    int status;
    write_bytes_of(bytes, count);
    status = picture_read_grey(&grey, PATH);
    MUST((grey.data != NULL) == (status == EXIT_MEASURED), "a picture in spite of a failure, or none");
    picture_free(&grey);
    return status == EXIT_MEASURED;
}

/* Any bit of any chunk's check sum, and any of what it covers, of critical chunks and others; what lies behind the last
 * chunk does not count. */
START_TEST(each_check_sum_counts)
{
    static uint8_t bytes[4096];
    specimen s;
    uint64_t seed = 7;
    size_t count, at, chunks = 0;
    FILE *file;
    memset(&s, 0, sizeof s);
    s.kind = PNG_COLOR_TYPE_RGB;
    s.depth = 8;
    s.transparency = 1;
    s.width = 13;
    s.height = 7;
    fill(&s, &seed);
    write_specimen(&s);
    free(s.samples);
    file = fopen(PATH, "rb");
    ck_assert_ptr_nonnull(file);
    count = fread(bytes, 1, sizeof bytes - 1, file);
    fclose(file);
    ck_assert(reads(bytes, count));
    for (at = 8; at < count; chunks++) {
        const size_t length = (size_t)bytes[at + 2] * 256 + bytes[at + 3];
        size_t k, bit;
        for (k = at + 8; k < at + 12 + length; k++) { /* contents and check sum */
            for (bit = k < at + 8 + length ? 7 : 0; bit < 8; bit++) {
                bytes[k] ^= (uint8_t)(1u << bit);
                MUST(!reads(bytes, count), "%.4s: byte %d of %d, bit %d: read in spite of it", (char *)&bytes[at + 4],
                     (int)(k - at - 8), (int)length, (int)bit);
                bytes[k] ^= (uint8_t)(1u << bit);
            }
        }
        at += 12 + length;
    }
    ck_assert_uint_eq(chunks, 6); /* IHDR gAMA tRNS tEXt IDAT IEND */
    ck_assert(reads(bytes, count + 1));
}
END_TEST

START_TEST(what_is_written_reads_back)
{
    uint64_t seed = 6;
    picture out, in;
    size_t i;
    int32_t channels;
    for (channels = 1; channels <= 3; channels += 2) {
        ck_assert_int_eq(picture_create(&out, PATH, 37, 11, channels), EXIT_MEASURED);
        for (i = 0; i < (size_t)(37 * 11 * channels); i++) {
            out.data[i] = (uint8_t)rng_u64(&seed);
        }
        ck_assert_int_eq(picture_write(&out, PATH), EXIT_MEASURED);
        ck_assert_int_eq(picture_read_grey(&in, PATH), EXIT_MEASURED);
        for (i = 0; i < 37 * 11; i++) {
            const uint8_t *p = out.data + i * (size_t)channels;
            ck_assert_uint_eq(in.data[i], channels == 1 ? p[0] : grey_of(p[0], p[1], p[2]));
        }
        picture_free(&out);
        picture_free(&in);
    }
}
END_TEST

SUITE_MAIN("png_io", every_kind_reads_as_documented, each_check_sum_counts, what_is_written_reads_back)
