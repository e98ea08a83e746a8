/* SPDX-License-Identifier: Apache-2.0 */
/* PGM (P5) and PPM (P6) as netpbm defines them: width, height, greatest value, one white space, samples. */
#include "pnm.h"

#include <ctype.h>
#include <stdint.h>

#include "cli.h"

enum { MOST_DIGITS = 8 }; /* as PICTURE_MAX_PIXELS has, which bounds the sides */

/* The next number of the header; -1 when there is none. Comments run from # to the end of the line. */
static long header_number(FILE *in)
{
    long value = 0;
    int digits = 0;
    int c = getc(in);
    while (isspace(c) || c == '#') {
        if (c == '#') {
            while (c != '\n' && c != EOF) {
                c = getc(in);
            }
        } else {
            c = getc(in);
        }
    }
    while (isdigit(c) && digits <= MOST_DIGITS) {
        value = value * 10 + (c - '0');
        digits++;
        c = getc(in);
    }
    return digits > 0 && digits <= MOST_DIGITS && isspace(c) ? value : -1; /* the one white space is read, too */
}

/* Samples from 0 to 'most', a byte each or two with the greater first. */
static int read_samples(picture *out, FILE *in, const char *path, long most)
{
    const size_t count = (size_t)out->width_px * (size_t)out->height_px * (size_t)out->channels;
    size_t i;
    for (i = 0; i < count; i++) {
        const int high = most > 255 ? getc(in) : 0;
        const int low = getc(in);
        const long sample = (long)high * 256 + low;
        if (high == EOF || low == EOF) {
            return complain(path, "the file ends early");
        }
        if (sample > most) {
            return complain(path, "a sample is %ld, more than the %ld that the header allows", sample, most);
        }
        out->data[i] = (uint8_t)((sample * 255 * 2 + most) / (2 * most));
    }
    return EXIT_MEASURED;
}

int pnm_read(picture *out, FILE *in, const char *path, char kind)
{
    long width, height, most;
    if (kind != '5' && kind != '6') {
        return complain(path, "P%c is not read: binary PGM (P5) and PPM (P6) are", kind);
    }
    width = header_number(in);
    height = width < 0 ? -1 : header_number(in);
    most = height < 0 ? -1 : header_number(in);
    if (width < 1 || height < 1 || most < 1 || most > 65535) {
        return complain(path, "no sound header of a PGM or PPM file");
    }
    if ((uint64_t)width * (uint64_t)height > PICTURE_MAX_PIXELS) {
        return complain(path, "%ldx%ld pixels are more than the %u that are read", width, height, PICTURE_MAX_PIXELS);
    }
    return picture_create(out, path, (int32_t)width, (int32_t)height, kind == '5' ? 1 : 3) ||
           read_samples(out, in, path, most);
}
