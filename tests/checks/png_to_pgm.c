/* SPDX-License-Identifier: Apache-2.0 */
/* png_to_pgm FILE.png >FILE.pgm: the grey picture as the host program reads it. */
#include <stdio.h>

#include "cli.h"
#include "images.h"

int main(int argc, char **argv)
{
    picture grey;
    size_t size;
    int status;
    if (argc != 2) {
        return complain("png_to_pgm", "takes one file");
    }
    if (picture_read_grey(&grey, argv[1]) != EXIT_MEASURED) {
        return EXIT_BAD;
    }
    size = (size_t)grey.width_px * (size_t)grey.height_px;
    printf("P5\n%d %d\n255\n", (int)grey.width_px, (int)grey.height_px);
    status = fwrite(grey.data, 1, size, stdout) == size ? EXIT_MEASURED : EXIT_BAD;
    picture_free(&grey);
    return flush_output() == EXIT_MEASURED ? status : EXIT_BAD;
}
