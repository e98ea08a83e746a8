/* SPDX-License-Identifier: Apache-2.0 */
/* Checked arithmetic: included ahead of every source of the core, it gives the primitives of fixed.h and real.h bodies
 * that verify their stated ranges, and makes DROGUE_NOTE record peaks. Same names, same bits.
 *
 * What no primitive stands for, plain + - * << on integers, the compiler's undefined-behaviour sanitizer verifies in
 * the same build. */
#ifndef CHECKED_H
#define CHECKED_H

#include <stdint.h>

/* One place in the source: a named quantity, or an operation that can saturate. Registered when first met. */
typedef struct checked_site {
    const char *name;
    const char *file;
    int line;
    int bits; /* that hold the magnitude; 0: a saturating operation, counted in 'events' */
    uint64_t peak;
    uint64_t events;
    struct checked_site *next;
} checked_site;

void checked_note(checked_site *site, int64_t value);
void checked_saturation(checked_site *site, int saturated);
void checked_fail(const char *what, const char *file, int line);

#define DROGUE_NOTE(name, value, bits)                                                \
    do {                                                                              \
        static checked_site checked_here = {name, __FILE__, __LINE__, bits, 0, 0, 0}; \
        checked_note(&checked_here, (int64_t)(value));                                \
    } while (0)

#include "drogue/fixed.h"
#include "drogue/real.h"

#ifndef CHECKED_PRIMITIVES /* the sources that define the primitives only take DROGUE_NOTE */

/* A statement expression gives each place its own record. */
#define CHECKED_SATURATION(name, saturated)                                        \
    do {                                                                           \
        static checked_site checked_here = {name, __FILE__, __LINE__, 0, 0, 0, 0}; \
        checked_saturation(&checked_here, saturated);                              \
    } while (0)

#define drogue_sat_s32(v)                                                                     \
    __extension__({                                                                           \
        int64_t checked_v = (v);                                                              \
        CHECKED_SATURATION("drogue_sat_s32", checked_v > INT32_MAX || checked_v < INT32_MIN); \
        (drogue_sat_s32)(checked_v);                                                          \
    })
#define drogue_real_to_s64(v, frac)                                                                                  \
    __extension__({                                                                                                  \
        drogue_real checked_v = (v);                                                                                 \
        int checked_frac = (frac);                                                                                   \
        CHECKED_SATURATION("drogue_real_to_s64", checked_v.mantissa != 0 && checked_v.exponent + checked_frac > 32); \
        (drogue_real_to_s64)(checked_v, checked_frac);                                                               \
    })
#define drogue_real_to_s32(v, frac)                                                               \
    __extension__({                                                                               \
        int64_t checked_q = drogue_real_to_s64(v, frac);                                          \
        CHECKED_SATURATION("drogue_real_to_s32", checked_q > INT32_MAX || checked_q < INT32_MIN); \
        (drogue_sat_s32)(checked_q);                                                              \
    })
#define drogue_real_to_q16(v) drogue_real_to_s32(v, 16)
#define drogue_q16_div(a, b)                                          \
    __extension__({                                                   \
        drogue_q16 checked_a = (a);                                   \
        drogue_q16 checked_b = (b);                                   \
        CHECKED_SATURATION("drogue_q16_div by zero", checked_b == 0); \
        (drogue_q16_div)(checked_a, checked_b);                       \
    })
#define drogue_q16_add(a, b) drogue_sat_s32((int64_t)(a) + (b))
#define drogue_q16_sub(a, b) drogue_sat_s32((int64_t)(a) - (b))
#define drogue_q16_mul(a, b) drogue_sat_s32(drogue_shr_round_s64((int64_t)(a) * (b), 16))
#define drogue_q16_from_int(v) drogue_sat_s32((int64_t)(v)*DROGUE_Q16_ONE)

#define drogue_shl_s64(v, n) checked_shl_s64(v, n, __FILE__, __LINE__)
#define drogue_shr_round_s64(v, n) checked_shr_round_s64(v, n, __FILE__, __LINE__)
#define drogue_div_round_s64(num, den) checked_div_round_s64(num, den, __FILE__, __LINE__)
#define drogue_sincos_q30(s, c, angle) checked_sincos_q30(s, c, angle, __FILE__, __LINE__)

#endif

int64_t checked_shl_s64(int64_t v, int n, const char *file, int line);
int64_t checked_shr_round_s64(int64_t v, int n, const char *file, int line);
int64_t checked_div_round_s64(int64_t num, int64_t den, const char *file, int line);
void checked_sincos_q30(int32_t *sin_q30, int32_t *cos_q30, int32_t angle_rad_q29, const char *file, int line);

/* Print the table of peaks and saturations; returns the number of excesses so far. */
int checked_report(void);

#endif
