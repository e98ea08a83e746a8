/* SPDX-License-Identifier: Apache-2.0 */
/* The benches' own test: what is off must be counted, a bench that ran nothing has failed. Over three cases of its own. */
#include "bench.h"

#include <stdio.h>

static const int32_t words[] = {7, -8, 9};
static const int32_t other_words[] = {7, -8, 10};
static const uint64_t bound = 0;
static const conf_array input = {"in", 32, 3, words, 0, 0};
static const conf_expected expected = {{"out", 32, 3, words, 0, 0}, &bound, 1};
static const conf_case first[] = {{"a/one", "a", "ordinary", &input, 1, NULL, 0, &expected, 1},
                                  {"b/one", "b", "ordinary", &input, 1, NULL, 0, &expected, 1}};
static const conf_case second[] = {{"a/two", "a", "ordinary", &input, 1, NULL, 0, &expected, 1}};
const conf_case_list conf_case_lists[] = {{first, 2}, {second, 1}};
const size_t conf_case_list_count = 2;

/* A bench over a stage: its second case, counted from 0, gets the words given; what main() would return. */
static int run(bench *b, const char *stage, const int32_t *last)
{
    const conf_case *c;
    unsigned n = 0;
    bench_begin(b, "own");
    while ((c = bench_next(b, stage)) != NULL) {
        bench_words(b, "out", n++ == 1 ? last : bench_words32(bench_input(c, "in")), bench_expected(c, "out"));
    }
    return bench_end(b);
}

/* Regions with nothing of the image in them, some by numbers that wrap: how many are taken. */
static int refuses_regions(void)
{
    static const drogue_region none[] = {
        {64, 0, 8, 8}, {0, -8, 8, 8}, {0, INT32_MIN, 8, 8}, {INT32_MAX, 0, 8, 8}, {0, 0, 8, INT32_MIN + 5000}};
    static const drogue_image image = {NULL, 64, 48, 64};
    const drogue_region inside = {-4, 40, 8, 16};
    drogue_region part;
    drogue_mask mask;
    int taken = 0;
    size_t i;
    for (i = 0; i < sizeof none / sizeof none[0]; i++) {
        taken += bench_place(&part, &mask, &image, &none[i]);
    }
    taken +=
        !(bench_place(&part, &mask, &image, &inside) && part.x_px == 0 && part.width_px == 4 && part.height_px == 8);
    return taken;
}

int main(void)
{
    bench b;
    int wrong = 0;
    wrong += !(run(&b, "a", words) == 0 && b.cases == 2 && b.failed == 0);
    wrong += !(run(&b, "a", other_words) == 1 && b.cases == 2 && b.failed == 1);
    wrong += !(run(&b, "b", words) == 0 && b.cases == 1);
    wrong += !(run(&b, "c", words) == 1 && b.cases == 0);

    wrong += refuses_regions();

    bench_begin(&b, "skips all");
    while (bench_next(&b, "b") != NULL) {
        bench_skip(&b, "too large");
    }
    wrong += !(bench_end(&b) == 1 && b.skips == 1);

    bench_begin(&b, "single words");
    wrong += bench_next(&b, "b") == NULL;
    wrong += !(bench_word(&b, "right", 5, 5) && !bench_word(&b, "wrong", 5, 6) && !bench_check(&b, "does not", 0));
    wrong += !(bench_expected(b.open, "missing") == NULL && !bench_words(&b, "missing", words, NULL));
    wrong += !(bench_end(&b) == 1);

    bench_begin(&b, "between cases");
    (void)bench_next(&b, "b");
    (void)bench_next(&b, "b");
    wrong += bench_word(&b, "wrong", 1, 2);
    wrong += !(bench_end(&b) == 1);
    printf("bench_test: failed=%d\n", wrong);
    return wrong;
}
