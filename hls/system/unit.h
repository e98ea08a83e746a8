/* SPDX-License-Identifier: Apache-2.0 */
/* The soft core's instructions for the units beside it, unit.v. */
#ifndef DROGUE_SYSTEM_UNIT_H
#define DROGUE_SYSTEM_UNIT_H

#include "real_unit.h"

enum {
    UNIT_REAL,
    UNIT_PUSH,
    UNIT_EXPONENT,
    UNIT_ZEROS,
    UNIT_TELL,  /* two words of points_asked */
    UNIT_PLACE, /* what: 0, or 1 for a point that is to be counted; all alike until words are told anew */
    UNIT_SAID,
    UNIT_CLEAR, /* the moments */
    UNIT_ADD,
    UNIT_MOMENTS, /* word after word */
    UNIT_RAY_IMAGE,
    UNIT_RAY_SIZE,
    UNIT_RAY_STEP,
    UNIT_RAY_BEGIN, /* ray_unit.h: what for */
    UNIT_RAY_GREY,  /* sample after sample */
    UNIT_ROOT,      /* of the lower and the upper word */
    UNIT_FIT_PLACE, /* the offset, two words */
    UNIT_FIT_BEGIN, /* its third, and the tolerance; the sums are cleared */
    UNIT_FIT_EDGE,
    UNIT_FIT_RAY, /* on which the edges are that were told since the last one */
    UNIT_FIT_WHICH,
    UNIT_FIT_SUMS,  /* word after word */
    UNIT_RAY_LEAST, /* slope of a peak, and the samples to seek among */
    UNIT_RAY_PEAK,
    UNIT_DIVISOR, /* lower and upper word */
    UNIT_DIVIDE,  /* the same of what it divides; the quotient's upper word by UNIT_EXPONENT */
    UNIT_COUNT,   /* clears the counts: bright bins; points in the moments, and may they leave them? */
    UNIT_COUNTED  /* points_unit.h: which of the counts */
};

#define COUNT_OUT (1u << 31) /* points that are not held leave the moments */

/* In the order of the text: units keep what they were told. An operand of 0 is the register that always is. */
#define UNIT(result, unit, what, first, second)           \
    __asm__ volatile(".insn r 0x0B, %1, %2, %0, %z3, %z4" \
                     : "=r"(result)                       \
                     : "i"(what), "i"(unit), "rJ"(first), "rJ"(second))

#endif
