/* SPDX-License-Identifier: Apache-2.0 */
/* Files of the vectors: whole files, words as hexadecimal lines, grey PNG images; and the memory for them. */
#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vectors.h"

#define MAX_FILE_BYTES (24L << 20)

/* --- memory: a list of blocks --- */

typedef union block {
    union block *next;
    int64_t align;
} block;

static block *blocks;

void *vectors_alloc(size_t bytes)
{
    block *b = malloc(sizeof *b + bytes);
    if (b == NULL) {
        fputs("conformance: out of memory\n", stderr);
        exit(2);
    }
    b->next = blocks;
    blocks = b;
    return memset(b + 1, 0, bytes);
}

void vectors_free(void)
{
    while (blocks != NULL) {
        block *next = blocks->next;
        free(blocks);
        blocks = next;
    }
}

/* --- files --- */

static char *read_stream(size_t *bytes, char reason[VECTORS_TEXT], FILE *stream)
{
    long length = fseek(stream, 0, SEEK_END) == 0 ? ftell(stream) : -1;
    char *data;
    if (length < 0 || length > MAX_FILE_BYTES) {
        snprintf(reason, VECTORS_TEXT, "%s", length < 0 ? "is no plain file" : "is larger than 24 MiB");
        return NULL;
    }
    rewind(stream);
    data = vectors_alloc((size_t)length + 1);
    *bytes = fread(data, 1, (size_t)length, stream);
    if (*bytes != (size_t)length) {
        snprintf(reason, VECTORS_TEXT, "cannot be read");
        return NULL;
    }
    return data;
}

char *vectors_file(size_t *bytes, char reason[VECTORS_TEXT], const char *path)
{
    FILE *stream = fopen(path, "rb");
    char *data;
    if (stream == NULL) {
        snprintf(reason, VECTORS_TEXT, "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    data = read_stream(bytes, reason, stream);
    fclose(stream);
    return data;
}

/* --- words --- */

static int digit(char c) { return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1; }

void vectors_store(void *data, size_t i, uint64_t word, int bits)
{
    switch (bits) {
    case 8: ((uint8_t *)data)[i] = (uint8_t)word; break;
    case 16: ((uint16_t *)data)[i] = (uint16_t)word; break;
    case 32: ((uint32_t *)data)[i] = (uint32_t)word; break;
    default: ((uint64_t *)data)[i] = word; break;
    }
}

int vectors_hex(conf_array *array, char reason[VECTORS_TEXT], const char *text, size_t bytes)
{
    size_t digits = (size_t)array->bits / 4;
    size_t lines = 0;
    size_t at;
    void *data;
    for (at = 0; at < bytes; at += digits + 1, lines++) {
        size_t k;
        for (k = 0; k <= digits; k++) {
            if (at + k >= bytes || (k < digits ? digit(text[at + k]) < 0 : text[at + k] != '\n')) {
                snprintf(reason, VECTORS_TEXT, "line %lu is not %lu lower-case hexadecimal digits",
                         (unsigned long)lines + 1, (unsigned long)digits);
                return 0;
            }
        }
    }
    if (lines != array->count) {
        snprintf(reason, VECTORS_TEXT, "%lu words expected, %lu found", (unsigned long)array->count,
                 (unsigned long)lines);
        return 0;
    }
    data = vectors_alloc(lines * (digits / 2));
    for (at = 0; at < lines; at++) {
        const char *line = text + at * (digits + 1);
        uint64_t word = 0;
        size_t k;
        for (k = 0; k < digits; k++) {
            word = word << 4 | (uint64_t)digit(line[k]);
        }
        vectors_store(data, at, word, array->bits);
    }
    array->data = data;
    return 1;
}

/* --- images --- */

/* Colour type and depth are read from the header itself: the decoder would convert silently. */
static int is_grey8(const uint8_t *file, size_t bytes)
{
    return bytes > 26 && memcmp(file + 12, "IHDR", 4) == 0 && file[24] == 8 && file[25] == 0;
}

/* Does it end with its last chunk: no length, IEND and its checksum? */
static int ends(const uint8_t *file, size_t bytes)
{
    static const uint8_t last[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
    return bytes > sizeof last && memcmp(file + bytes - sizeof last, last, sizeof last) == 0;
}

static int decode(conf_array *array, char reason[VECTORS_TEXT], png_image *png)
{
    uint8_t *data;
    if (png->width != (png_uint_32)array->width_px || png->height != (png_uint_32)array->height_px) {
        snprintf(reason, VECTORS_TEXT, "%ld x %ld pixels expected, %lu x %lu found", (long)array->width_px,
                 (long)array->height_px, (unsigned long)png->width, (unsigned long)png->height);
        return 0;
    }
    if (png->flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB) {
        snprintf(reason, VECTORS_TEXT, "has a gamma or colour profile of its own");
        return 0;
    }
    png->format = PNG_FORMAT_GRAY;
    data = vectors_alloc(array->count);
    if (!png_image_finish_read(png, NULL, data, 0, NULL) || png->warning_or_error != 0) {
        snprintf(reason, VECTORS_TEXT, "is no sound PNG: %s", png->message);
        return 0;
    }
    array->data = data;
    return 1;
}

int vectors_png(conf_array *array, char reason[VECTORS_TEXT], const void *file, size_t bytes)
{
    png_image png;
    int ok;
    memset(&png, 0, sizeof png);
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&png, file, bytes)) {
        snprintf(reason, VECTORS_TEXT, "is no PNG: %s", png.message);
        return 0;
    }
    if (!is_grey8((const uint8_t *)file, bytes) || png.format != PNG_FORMAT_GRAY) {
        snprintf(reason, VECTORS_TEXT, "is no 8-bit grey PNG without alpha");
        ok = 0;
    } else if (!ends((const uint8_t *)file, bytes)) {
        snprintf(reason, VECTORS_TEXT, "does not end as a PNG does: it is cut off, or something follows");
        ok = 0;
    } else {
        ok = decode(array, reason, &png);
    }
    png_image_free(&png);
    return ok;
}

/* --- both, with their digest --- */

int vectors_data(conf_array *array, char reason[VECTORS_TEXT], const char *path, const char *digest)
{
    char found[SHA256_HEX];
    size_t bytes;
    sha256 s;
    char *data = vectors_file(&bytes, reason, path);
    if (data == NULL) {
        return 0;
    }
    sha256_init(&s);
    sha256_add(&s, data, bytes);
    sha256_end(found, &s);
    if (strcmp(found, digest) != 0) {
        snprintf(reason, VECTORS_TEXT, "SHA-256 is %s, field 'sha256' says %.80s", found, digest);
        return 0;
    }
    return array->width_px > 0 ? vectors_png(array, reason, data, bytes) : vectors_hex(array, reason, data, bytes);
}
