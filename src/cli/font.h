/* SPDX-License-Identifier: Apache-2.0 */
/* A bitmap font for the words on an overlay: lower-case letters, digits and the signs that numbers need. */
#ifndef CLI_FONT_H
#define CLI_FONT_H

#include <stdint.h>

enum {
    FONT_WIDTH = 5,
    FONT_HEIGHT = 9,  /* the last two rows are below the baseline */
    FONT_ADVANCE = 6, /* from one character to the next */
    FONT_LINE = 11    /* from one line to the next */
};

/* Rows of a character, top first; bit 4 is the leftmost pixel. A character that the font lacks is a box. */
const uint8_t *font_rows(char c);

#endif
