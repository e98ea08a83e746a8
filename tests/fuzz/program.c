/* SPDX-License-Identifier: Apache-2.0 */
/* The program's readers: decimals, the command line, and PNG files whose check sums are put right first, so that what lies
 * behind them is reached. */
#include "fuzz.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "cli.h"
#include "decimal.h"
#include "images.h"
#include "options.h"
#include "png_io.h"

static void read_decimal(const char *text, size_t length)
{
    drogue_q16 value;
    char out[DECIMAL_TEXT];
    if (decimal_to_q16(&value, text, length) == DECIMAL_OK) {
        decimal_format_q16(out, value, 9);
        FUZZ_MUST(strlen(out) < DECIMAL_TEXT);
    }
}

static void read_options(char *text)
{
    enum { MOST = 16 };
    char *argv[MOST + 2];
    char name[] = "measure";
    int argc = 0;
    options o;
    argv[argc++] = name;
    for (text = strtok(text, "\n"); text != NULL && argc <= MOST; text = strtok(NULL, "\n")) {
        argv[argc++] = text;
    }
    argv[argc] = NULL;
    optind = 0; /* getopt begins anew */
    (void)options_parse(&o, argc, argv);
}

static void repair(uint8_t *png, size_t size)
{
    static const uint8_t signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
    size_t at = 8;
    if (size < 8) {
        return;
    }
    memcpy(png, signature, 8);
    while (size - at >= 12) {
        const size_t length =
            (size_t)png[at] << 24 | (size_t)png[at + 1] << 16 | (size_t)png[at + 2] << 8 | png[at + 3];
        unsigned long sum;
        int k;
        if (length > size - at - 12) {
            return;
        }
        sum = crc32(crc32(0, NULL, 0), png + at + 4, (uInt)(length + 4));
        for (k = 0; k < 4; k++) {
            png[at + 8 + length + (size_t)k] = (uint8_t)(sum >> (24 - 8 * k));
        }
        at += 12 + length;
    }
}

static void read_png(uint8_t *png, size_t size)
{
    char path[64];
    FILE *file;
    picture image;
    repair(png, size);
    snprintf(path, sizeof path, "/tmp/drogue-fuzz-%ld.png", (long)getpid());
    file = fopen(path, "wb");
    FUZZ_MUST(file != NULL && fwrite(png, 1, size, file) == size);
    fclose(file);
    if (picture_read_grey(&image, path) == EXIT_MEASURED) {
        size_t i, sum = 0;
        FUZZ_MUST(image.width_px >= 1 && image.height_px >= 1 && image.channels == 1);
        for (i = 0; i < (size_t)image.width_px * (size_t)image.height_px; i++) {
            sum += image.data[i];
        }
        FUZZ_MUST(sum <= 255 * i);
    } else {
        FUZZ_MUST(image.data == NULL);
    }
    picture_free(&image);
    remove(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *copy;
    if (size < 1) {
        return 0;
    }
    copy = fuzz_alloc(size);
    memcpy(copy, data + 1, size - 1);
    copy[size - 1] = '\0';
    switch (data[0] % 3) {
    case 0: read_decimal(copy, size - 1); break;
    case 1: read_options(copy); break;
    default: read_png((uint8_t *)copy, size - 1); break;
    }
    free(copy);
    return 0;
}
