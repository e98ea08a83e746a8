/* SPDX-License-Identifier: Apache-2.0 */
/* Otsu 1979, exact: variances are compared as fractions. */
#include "drogue/inner.h"

#define LIMBS 5 /* 32-bit words of p^2 q: 148 bits */

/* A variance as a fraction p^2 / q, and in 31 bits, on a scale that all of a histogram share: p^2 at least and at most,
 * q at least. */
typedef struct variance {
    uint64_t p; /* < 2^52 */
    uint64_t q; /* < 2^44 */
    uint32_t square_least;
    uint32_t square_most;
    uint32_t q_least;
} variance;

static void set(variance *v, uint64_t p, uint64_t q, int p_room, int q_room)
{
    const uint32_t short_p = (uint32_t)((p << p_room) >> 33);
    const uint64_t square = (uint64_t)short_p * short_p;
    v->p = p;
    v->q = q;
    v->square_least = (uint32_t)(square >> 31);
    v->square_most = (uint32_t)((square + 2 * (uint64_t)short_p) >> 31) + 1; /* (p + 1)^2 <= this */
    v->q_least = (uint32_t)((q << q_room) >> 33);
}

/* v *= by, the lowest word first; by < 2^53 */
static void multiply(uint32_t v[LIMBS], uint64_t by)
{
    uint32_t before = 0; /* v[i - 1] */
    uint64_t carry = 0;
    int i;
    for (i = 0; i < LIMBS; i++) {
        const uint64_t low = (uint64_t)v[i] * (uint32_t)by + (uint32_t)carry;
        const uint64_t high = (uint64_t)before * (uint32_t)(by >> 32) + (carry >> 32);
        const uint64_t sum = (uint64_t)(uint32_t)low + (uint32_t)high;
        before = v[i];
        v[i] = (uint32_t)sum;
        carry = (low >> 32) + (high >> 32) + (sum >> 32);
    }
}

/* v = p^2 q */
static void square_times(uint32_t v[LIMBS], uint64_t p, uint64_t q)
{
    int i;
    for (i = 0; i < LIMBS; i++) {
        v[i] = i == 0;
    }
    multiply(v, p);
    multiply(v, p);
    multiply(v, q);
}

/* a > b? In whole numbers where their short forms do not tell. */
static int greater(const variance *a, const variance *b)
{
    uint32_t left[LIMBS];
    uint32_t right[LIMBS];
    int i = LIMBS - 1;
    if ((uint64_t)a->square_most * (b->q_least + 1) <= (uint64_t)b->square_least * a->q_least) {
        return 0;
    }
    if ((uint64_t)a->square_least * b->q_least >= (uint64_t)b->square_most * (a->q_least + 1)) {
        return 1;
    }
    square_times(left, a->p, b->q);
    square_times(right, b->p, a->q);
    while (i > 0 && left[i] == right[i]) { /* bound: LIMBS */
        i--;
    }
    return left[i] > right[i];
}

uint8_t drogue_otsu(const uint32_t *histogram)
{
    uint32_t total = 0; /* 2^22 pixels of level 255 sum to less than 2^30 */
    uint32_t sum = 0;
    uint32_t below = 0;
    uint32_t sum_below = 0;
    variance best;
    uint8_t found = 0;
    int p_room;
    int q_room;
    int level;
    for (level = 0; level < 256; level++) {
        total += histogram[level];
        sum += histogram[level] * (uint32_t)level;
    }
    if (total == 0) { /* no shift by 64 */
        return 0;
    }
    p_room = drogue_clz_u32(total) + drogue_clz_u32(sum);
    q_room = 2 * drogue_clz_u32(total);
    set(&best, 0, 1, p_room, q_room);
    for (level = 0; level < 255; level++) {
        variance v;
        uint64_t p;
        uint64_t q;
        below += histogram[level];
        sum_below += histogram[level] * (uint32_t)level;
        q = (uint64_t)below * (total - below);
        if (q == 0 || histogram[level] == 0) { /* no class, or the classes of the level before */
            continue;
        }
        p = (uint64_t)below * sum - (uint64_t)total * sum_below; /* variance between the classes = p^2 / (q total^2) */
        DROGUE_NOTE("centroid: root of Otsu's variance", p, 52);
        DROGUE_NOTE("centroid: weights of Otsu's variance", q, 44);
        set(&v, p, q, p_room, q_room);
        if (greater(&v, &best)) {
            best = v;
            found = (uint8_t)level;
        }
    }
    return found;
}
