/* SPDX-License-Identifier: Apache-2.0 */
/* The unit for reals: the library's own functions, of which unit.sh makes Verilog. All but quotients are one put_sum(), whose
 * terms an operation chooses, so that there is one of it. */
#include "real_unit.h"

#include "../../src/arithmetic/real.c"

void real_unit_linear(const real_asked *restrict asked, drogue_real *restrict out)
{
    const real_asked x = *asked;
    const int minus = x.what == REAL_DIFFERENCE || x.what == REAL_SUBTRACT_PRODUCT || x.what == REAL_DETERMINANT;
    const int whole = x.what == REAL_SUM || x.what == REAL_DIFFERENCE;
    const int32_t d = minus ? -x.d.mantissa : x.d.mantissa;
    int64_t first = drogue_product(x.a.mantissa, x.b.mantissa);
    int32_t first_exponent = x.a.exponent + x.b.exponent;
    int64_t second = whole ? drogue_shl_s64(d, 31) : drogue_product(x.c.mantissa, d);
    const int32_t second_exponent = x.d.exponent + (whole ? -31 : x.c.exponent);
    drogue_real result;
    if (whole) {
        first = drogue_shl_s64(x.c.mantissa, 31);
        first_exponent = x.c.exponent - 31;
    } else if (x.what == REAL_SUBTRACT_PRODUCT) {
        first = drogue_shl_s64(x.b.mantissa, 31);
        first_exponent = x.b.exponent - 31;
    } else if (x.what == REAL_PRODUCT) {
        first = 0;
    } else if (x.what == REAL_SET) {
        first = (int64_t)((uint64_t)(uint32_t)x.c.mantissa << 32 | (uint32_t)x.c.exponent);
        first_exponent = x.d.exponent;
        second = 0;
    }
    put_sum(&result, first_exponent, first, second, second_exponent);
    *out = result;
}
