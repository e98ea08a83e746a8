/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for reals beside the soft core: what it is told and what it says, and its instructions' numbers. */
#ifndef DROGUE_SYSTEM_REAL_UNIT_H
#define DROGUE_SYSTEM_REAL_UNIT_H

#include "drogue/real.h"

/* Operations on the last of the reals that the unit was told: of a, b, c, d, where d comes with the operation. */
enum {
    REAL_SET,              /* c.mantissa 2^32 + c.exponent, times 2^d.exponent */
    REAL_SUM,              /* c + d */
    REAL_DIFFERENCE,       /* c - d */
    REAL_PRODUCT,          /* c d */
    REAL_SUBTRACT_PRODUCT, /* b - c d */
    REAL_PRODUCTS,         /* a b + c d */
    REAL_DETERMINANT,      /* a b - c d */
    REAL_QUOTIENT          /* c / d; by unit.v's divider */
};

typedef struct real_asked {
    drogue_real a;
    drogue_real b;
    drogue_real c;
    drogue_real d;
    uint32_t what;
} real_asked;

void real_unit_linear(const real_asked *restrict asked, drogue_real *restrict out);

#endif
