/* SPDX-License-Identifier: Apache-2.0 */
/* What the test benches share: the golden vectors' cases one after the other, their arrays by name, comparison with a
 * line for the first word that is off, a line per case, the summary line.
 *
 *     bench b;
 *     const conf_case *c;
 *     bench_begin(&b, "eigen");
 *     while ((c = bench_next(&b, "eigen")) != NULL) {
 *         ... run the top on bench_input(c, "matrix") ...
 *         bench_words(&b, "values", values, bench_expected(c, "values"));
 *     }
 *     return bench_end(&b);
 */
#ifndef DROGUE_HLS_BENCH_H
#define DROGUE_HLS_BENCH_H

#include "conformance.h"
#include "drogue/config.h"
#include "drogue/mask.h"

typedef struct bench {
    const char *name;
    const conf_case *open; /* the case at work */
    size_t list;           /* where to look for the next one */
    size_t index;
    unsigned cases;
    unsigned failed;
    unsigned skips;
    int off;     /* the case at work has failed */
    int skipped; /* the case at work does not fit the top's sizes */
} bench;

void bench_begin(bench *b, const char *name);

/* Next case of the stage among those compiled in, NULL after the last; ends the case before, with its line. */
const conf_case *bench_next(bench *b, const char *stage);

/* Say that the case at work is larger than the top was built for: its line says so, it does not count. */
void bench_skip(bench *b, const char *why);

/* Prints 'NAME: cases=N failed=N skipped=N' and returns the number of failures, at most 100: 1 where no case was run at all. */
int bench_end(bench *b);

/* --- comparison: each counts the case at work as failed, with a line, and returns 0, when anything is off --- */

int bench_word(bench *b, const char *what, int64_t found, int64_t expected);

/* Words of found, as wide as expected's, against all of expected's. */
int bench_words(bench *b, const char *what, const void *found, const conf_array *expected);

/* For what is not a comparison of words: fails unless 'holds'. */
int bench_check(bench *b, const char *what, int holds);

/* --- arrays of a case: NULL when it has none of that name --- */

const conf_array *bench_input(const conf_case *c, const char *name);
const conf_array *bench_expected(const conf_case *c, const char *name); /* of the bit-exact tier */

static inline const int32_t *bench_words32(const conf_array *a) { return (const int32_t *)a->data; }

/* Image, camera, model, region, thresholds of a case of stage 'frame' (image and camera: of any stage that has them). */
drogue_image bench_image(const conf_case *c);
drogue_camera bench_camera(const conf_case *c);
drogue_model bench_model(const conf_case *c);
drogue_region bench_region(const conf_case *c);
drogue_config bench_config(const conf_case *c);

/* The part of a region within the image, its sides 0 or less when there is none, and the mask of the whole region in the
 * part's coordinates. Returns 0 when drogue_measure() takes no region of such sides. */
int bench_place(drogue_region *part, drogue_mask *mask, const drogue_image *image, const drogue_region *region);

#endif
