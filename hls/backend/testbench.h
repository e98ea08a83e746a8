/* SPDX-License-Identifier: Apache-2.0 */
/* What the test benches of the back end and the filter share: the compiled-in cases of a stage, comparison, report. */
#ifndef DROGUE_HLS_TESTBENCH_H
#define DROGUE_HLS_TESTBENCH_H

#include <stdio.h>
#include <string.h>

#include "conformance.h"

/* In co-simulation the size of every array is told before each call. */
#ifdef __BAMBU_SIM__
#include <mdpi/mdpi_user.h>
#define BENCH_ARRAY(index, array) m_param_alloc(index, sizeof(array))
#else
#define BENCH_ARRAY(index, array) ((void)0)
#endif

#ifndef BENCH_ONLY
#define BENCH_ONLY "" /* cases whose id holds this text */
#endif

typedef struct bench {
    const char *name;
    const char *id; /* of the case at work */
    uint32_t cases;
    uint32_t failed;
    uint32_t skipped;
    int off; /* the case at work has a wrong word */
} bench;

static inline int bench_wants(const conf_case *c, const char *stage)
{
    return strcmp(c->stage, stage) == 0 && strstr(c->id, BENCH_ONLY) != NULL;
}

static inline void bench_begin(bench *b, const char *id)
{
    b->id = id;
    b->off = 0;
    b->cases++;
}

/* Compare a word; the first that is wrong in a case is printed. */
static inline void bench_word(bench *b, const char *what, size_t at, int64_t found, int64_t expected)
{
    if (found != expected && !b->off) {
        printf("WRONG %s %s[%lu]: %lld, expected %lld\n", b->id, what, (unsigned long)at, (long long)found,
               (long long)expected);
    }
    b->off |= found != expected;
}

static inline void bench_words32(bench *b, const char *what, const int32_t *found, const int32_t *expected,
                                 size_t count)
{
    size_t i;
    for (i = 0; i < count; i++) {
        bench_word(b, what, i, found[i], expected[i]);
    }
}

static inline void bench_words64(bench *b, const char *what, const int64_t *found, const int64_t *expected,
                                 size_t count)
{
    size_t i;
    for (i = 0; i < count; i++) {
        bench_word(b, what, i, found[i], expected[i]);
    }
}

/* The vector's expected words; a missing output or another number of words is a failure. */
static inline void bench_vector32(bench *b, const conf_case *c, const char *output, const int32_t *found, size_t count)
{
    int k;
    size_t i;
    for (k = 0; k < c->exact_count; k++) {
        if (strcmp(c->exact[k].array.name, output) == 0 && c->exact[k].array.count == count) {
            for (i = 0; i < count; i++) {
                bench_word(b, output, i, found[i], conf_word(&c->exact[k].array, i));
            }
            return;
        }
    }
    bench_word(b, output, 0, 0, 1);
}

static inline void bench_vector64(bench *b, const conf_case *c, const char *output, const int64_t *found, size_t count)
{
    int k;
    size_t i;
    for (k = 0; k < c->exact_count; k++) {
        if (strcmp(c->exact[k].array.name, output) == 0 && c->exact[k].array.count == count) {
            for (i = 0; i < count; i++) {
                bench_word(b, output, i, found[i], conf_word(&c->exact[k].array, i));
            }
            return;
        }
    }
    bench_word(b, output, 0, 0, 1);
}

static inline void bench_end(bench *b, const char *remark)
{
    b->failed += b->off != 0;
    printf("%s %s%s\n", b->off ? "FAILED" : "ok    ", b->id, remark);
}

/* A case that the blocks are too small for. */
static inline void bench_skip(bench *b, const char *id, const char *why)
{
    b->skipped++;
    printf("SKIPPED %s: %s\n", id, why);
}

/* Last line, and what main() returns: a bench that ran nothing has failed. */
static inline int bench_report(const bench *b)
{
    printf("%s: cases=%lu failed=%lu skipped=%lu\n", b->name, (unsigned long)b->cases, (unsigned long)b->failed,
           (unsigned long)b->skipped);
    return b->cases == 0 ? 1 : (int)b->failed;
}

#endif
