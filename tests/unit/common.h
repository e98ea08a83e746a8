/* SPDX-License-Identifier: Apache-2.0 */
/* What the unit and the golden tests share: reproducible random numbers and buffers with guard words. C99 and C++17. */
#ifndef DROGUE_TESTS_COMMON_H
#define DROGUE_TESTS_COMMON_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TEST_PI 3.14159265358979323846264338327950288

/* splitmix64: every seed is good, and a failing case is repeated from its seed alone. */
static inline uint64_t rng_u64(uint64_t *state)
{
    uint64_t z = (*state += UINT64_C(0x9E3779B97F4A7C15));
    z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
    return z ^ (z >> 31);
}

/* Signed number of a random bit width, so that small and large magnitudes are as frequent. */
static inline int64_t rng_s64_any_width(uint64_t *state)
{
    uint64_t v = rng_u64(state);
    int shift = (int)(rng_u64(state) & 63u);
    return (int64_t)v >> shift;
}

static inline int32_t rng_s32_any_width(uint64_t *state) { return (int32_t)(rng_s64_any_width(state) >> 32); }

/* Integer in [lo, hi]. */
static inline int32_t rng_range(uint64_t *state, int32_t lo, int32_t hi)
{
    uint64_t span = (uint64_t)((int64_t)hi - lo) + 1u;
    return (int32_t)((int64_t)lo + (int64_t)((rng_u64(state) >> 32) * span >> 32));
}

/* Real number in [lo, hi). */
static inline double rng_real(uint64_t *state, double lo, double hi)
{
    return lo + (hi - lo) * ((double)(rng_u64(state) >> 11) * (1.0 / 9007199254740992.0));
}

/* Standard normal, by the sum of twelve uniforms. */
static inline double rng_normal(uint64_t *state)
{
    double sum = -6.0;
    int i;
    for (i = 0; i < 12; i++) {
        sum += rng_real(state, 0.0, 1.0);
    }
    return sum;
}

/* Q16 of a real number, rounded once, ties toward +infinity, saturated. */
static inline int32_t q16_of(double v)
{
    double r = floor(v * 65536.0 + 0.5);
    return r >= 2147483647.0 ? INT32_MAX : r <= -2147483648.0 ? INT32_MIN : (int32_t)r;
}

static inline double real_of_q16(int32_t v) { return (double)v / 65536.0; }

/* Difference of two angles modulo 'turn', in [-turn / 2, turn / 2]. */
static inline double angle_difference(double p, double q, double turn)
{
    double d = fmod(p - q, turn);
    return d > turn / 2 ? d - turn : d < -turn / 2 ? d + turn : d;
}

#define GUARD_BYTES 64u
#define GUARD_PATTERN 0xA5

/* Memory between two guards; the contents start as the guard pattern too, so that what was not written shows. */
typedef struct guarded {
    unsigned char *base;
    void *data;
    size_t bytes;
} guarded;

static inline guarded guarded_alloc(size_t bytes)
{
    guarded g;
    g.base = (unsigned char *)malloc(bytes + 2u * GUARD_BYTES);
    if (g.base == NULL) {
        abort();
    }
    memset(g.base, GUARD_PATTERN, bytes + 2u * GUARD_BYTES);
    g.data = g.base + GUARD_BYTES;
    g.bytes = bytes;
    return g;
}

static inline int guarded_intact(const guarded *g)
{
    size_t i;
    for (i = 0; i < GUARD_BYTES; i++) {
        if (g->base[i] != GUARD_PATTERN || g->base[GUARD_BYTES + g->bytes + i] != GUARD_PATTERN) {
            return 0;
        }
    }
    return 1;
}

static inline void guarded_free(guarded *g)
{
    free(g->base);
    g->base = NULL;
}

#endif
