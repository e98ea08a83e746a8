/* SPDX-License-Identifier: Apache-2.0 */
/* Between the files that read the manifest only: fields of its objects, and the bounds. */
#ifndef DROGUE_TESTS_VECTORS_FIELDS_H
#define DROGUE_TESTS_VECTORS_FIELDS_H

#include <cjson/cJSON.h>

#include "vectors.h"

/* Where in the manifest we are, for messages; unused ones are NULL. */
typedef struct vectors_reader {
    const char *directory;
    const char *id;
    const char *stage;
    const char *tier; /* inputs, reference, exact */
    const char *array;
} vectors_reader;

/* One line on stderr, with where we are; returns 0. */
int vectors_fail(const vectors_reader *r, const char *format, ...);

/* Is the word one of a list of words, separated by single spaces? */
int vectors_listed(const char *list, const char *word);

/* Every required field once, none that is neither required nor optional. */
int vectors_fields(const vectors_reader *r, const cJSON *object, const char *required, const char *optional);

/* Text of a field; NULL and a line when it has none. */
const char *vectors_text(const vectors_reader *r, const cJSON *object, const char *name);

/* Is the item a whole number in [low, high]? */
int vectors_whole(const cJSON *item, double low, double high);

/* The same of a field, taken; 0 and a line when it is not. */
int vectors_number(const vectors_reader *r, int32_t *out, const cJSON *object, const char *name, int32_t low,
                   int32_t high);

/* Bounds of an expected output whose words are read: no wider than stages_words.h has them. */
int vectors_bound(const vectors_reader *r, conf_expected *e, const cJSON *bound);

#endif
