/* SPDX-License-Identifier: Apache-2.0 */
/* The kind of an image by its first bytes, and its grey. */
#include "images.h"

#include <errno.h>
#include <string.h>

#include "cli.h"
#include "pnm.h"

enum { SIGNATURE = 8 };

static const unsigned char PNG[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

FILE *images_open(const char *path)
{
    FILE *in = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
    if (in == NULL) {
        complain(path, "%s", strerror(errno));
    }
    return in;
}

void images_close(FILE *in)
{
    if (in != NULL && in != stdin) {
        fclose(in);
    }
}

/* RGB to grey in place. */
static void make_grey(picture *image)
{
    size_t count = (size_t)image->width_px * (size_t)image->height_px, i;
    if (image->channels == 3) {
        for (i = 0; i < count; i++) {
            const uint8_t *rgb = image->data + 3 * i;
            image->data[i] = (uint8_t)((77u * rgb[0] + 150u * rgb[1] + 29u * rgb[2] + 128u) >> 8);
        }
        image->channels = 1;
    }
}

/* Name the kind of a file that is not read, and the way out. */
static int refuse(const char *path, const unsigned char *s, size_t n)
{
    if (n >= 3 && s[0] == 0xFF && s[1] == 0xD8 && s[2] == 0xFF) {
        return complain(path, "a JPEG file, not PNG, PGM or PPM: ffmpeg -i FILE.jpg FILE.png converts it");
    }
    if (n >= SIGNATURE &&
        (memcmp(s + 4, "ftyp", 4) == 0 || memcmp(s, "RIFF", 4) == 0 || memcmp(s, "\x1A\x45\xDF\xA3", 4) == 0)) {
        return complain(
            path, "a video file: ffmpeg -i FILE -f rawvideo -pix_fmt gray - | drogue track - --raw W,H,gray8 ...");
    }
    return complain(path, "not a PNG file, nor PGM or PPM");
}

int images_next(picture *out, int *end, FILE *in, const char *path)
{
    unsigned char s[SIGNATURE];
    size_t n = fread(s, 1, 2, in);
    int code;
    memset(out, 0, sizeof *out);
    *end = 0;
    if (n == 2 && s[0] == 'P' && s[1] >= '1' && s[1] <= '7') {
        code = pnm_read(out, in, path, (char)s[1]);
    } else {
        n += n == 2 ? fread(s + 2, 1, SIGNATURE - 2, in) : 0;
        if (ferror(in)) {
            return complain(path, "%s", strerror(errno));
        }
        if (n == 0) {
            *end = 1;
            return EXIT_MEASURED;
        }
        code = n == SIGNATURE && memcmp(s, PNG, SIGNATURE) == 0 ? png_read(out, in, path) : refuse(path, s, n);
    }
    if (code != EXIT_MEASURED) {
        picture_free(out);
        return code;
    }
    make_grey(out);
    return EXIT_MEASURED;
}

int picture_read_grey(picture *out, const char *path)
{
    FILE *in = images_open(path);
    int end;
    int code;
    memset(out, 0, sizeof *out);
    if (in == NULL) {
        return EXIT_BAD;
    }
    code = images_next(out, &end, in, path);
    images_close(in);
    return code == EXIT_MEASURED && end ? complain(path, "the file is empty") : code;
}
