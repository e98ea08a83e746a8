/* SPDX-License-Identifier: Apache-2.0 */
/* What each output word of a stage is, and how far the library may be from the reference in it: the one table of bounds,
 * for the generator that writes them and for the runner that takes no wider one. */
#ifndef DROGUE_TESTS_STAGES_WORDS_H
#define DROGUE_TESTS_STAGES_WORDS_H

#include "stages.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum conf_kind {
    CONF_EXACT,     /* no bit may differ */
    CONF_LSB,       /* 'most' is in LSB */
    CONF_OF_ITSELF, /* 'most' is in millionths of the word */
    CONF_OF_SCALE, /* entry of a symmetric 5 x 5 matrix: 'most' is in millionths of the root of the diagonal's product */
    CONF_UNREFERENCED /* the bit-exact tier alone says what it is */
} conf_kind;

/* Words of a stage that share unit and bound. */
typedef struct conf_measure {
    const char *stage;
    char letter; /* in the layout of the stage's outputs */
    const char *name;
    const char *unit;
    int q; /* fractional bits */
    conf_kind kind;
    uint32_t base_lsb;     /* of every case: rounding */
    uint32_t most;         /* to what the conditioning of a case may widen it; for the relative kinds beside base_lsb */
    const char *undefined; /* why a word is undefined in a case that needs more; NULL: no case may */
} conf_measure;

/* Bound of a word that is undefined in a case: it is not compared in the reference tier. */
#define CONF_UNDEFINED UINT64_MAX

#define CONF_MEASURES 53
extern const conf_measure conf_measures[CONF_MEASURES];

/* What word i of an output is; NULL when the stage has no such output. */
const conf_measure *conf_measure_of(const char *stage, const char *output, size_t i);

/* Words after which the measures of an output repeat; 'before' of them come first and do not. */
size_t conf_measure_period(size_t *before, const char *stage, const char *output);

/* The number that millionths of word i are of, in LSB: one unit, the word itself or its scale. */
uint64_t conf_measure_whole(const conf_measure *m, const conf_array *words, size_t i);

/* The widest bound of word i, LSB. */
uint64_t conf_measure_widest(const conf_measure *m, const conf_array *words, size_t i);

#ifdef __cplusplus
}
#endif
#endif
