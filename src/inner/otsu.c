/* SPDX-License-Identifier: Apache-2.0 */
/* Otsu 1979, exact: variances are compared as fractions. */
#include "drogue/inner.h"
#include "drogue/wide.h"

/* A variance as a fraction p^2 / q and the product of such a p^2 with another q: high * 2^52 + low. */
typedef struct product {
    drogue_s128 high;
    uint64_t low;
} product;

/* p^2 * q for 0 <= p < 2^52, 0 <= q < 2^44 */
static product square_times(int64_t p, int64_t q)
{
    const uint64_t mask = (UINT64_C(1) << 52) - 1;
    drogue_s128 square = drogue_s128_mul(p, p);
    int64_t upper = (int64_t)(((uint64_t)square.hi << 12) | (square.lo >> 52));
    drogue_s128 lower = drogue_s128_mul((int64_t)(square.lo & mask), q);
    product r;
    r.high = drogue_s128_add(drogue_s128_mul(upper, q),
                             drogue_s128_from_s64((int64_t)(((uint64_t)lower.hi << 12) | (lower.lo >> 52))));
    r.low = lower.lo & mask;
    return r;
}

/* p^2 / q > r^2 / s? */
static int greater(int64_t p, int64_t q, int64_t r, int64_t s)
{
    product left = square_times(p, s);
    product right = square_times(r, q);
    int order = drogue_s128_cmp(left.high, right.high);
    return order > 0 || (order == 0 && left.low > right.low);
}

uint8_t drogue_otsu(const uint32_t *histogram)
{
    uint32_t total = 0; /* 2^22 pixels of level 255 sum to less than 2^30 */
    uint32_t sum = 0;
    uint32_t below = 0;
    uint32_t sum_below = 0;
    int64_t best_p = 0;
    int64_t best_q = 1;
    uint8_t best = 0;
    int level;
    for (level = 0; level < 256; level++) {
        total += histogram[level];
        sum += histogram[level] * (uint32_t)level;
    }
    for (level = 0; level < 255; level++) {
        int64_t p;
        int64_t q;
        below += histogram[level];
        sum_below += histogram[level] * (uint32_t)level;
        q = (int64_t)((uint64_t)below * (total - below));
        if (q == 0) {
            continue;
        }
        p = (int64_t)((uint64_t)below * sum) -
            (int64_t)((uint64_t)total * sum_below); /* variance between the classes = p^2 / (q total^2) */
        DROGUE_NOTE("centroid: root of Otsu's variance", p, 52);
        DROGUE_NOTE("centroid: weights of Otsu's variance", q, 44);
        if (greater(p, q, best_p, best_q)) {
            best_p = p;
            best_q = q;
            best = (uint8_t)level;
        }
    }
    return best;
}
