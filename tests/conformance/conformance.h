/* SPDX-License-Identifier: Apache-2.0 */
/* The runner: runs cases through the stages, compares with both tiers, reports. Static memory only, no stdio. */
#ifndef DROGUE_TESTS_CONFORMANCE_H
#define DROGUE_TESTS_CONFORMANCE_H

#include "sha256.h"
#include "stages_words.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Expected output, and by how much a word may differ: word i by bound[i % bound_count] LSB. */
typedef struct conf_expected {
    conf_array array;
    const uint64_t *bound; /* a single 0 where the class is exact; CONF_UNDEFINED: not compared */
    size_t bound_count;
} conf_expected;

typedef struct conf_case {
    const char *id; /* "stage/name" */
    const char *stage;
    const char *tier;
    const conf_array *inputs;
    int input_count;
    const conf_expected *reference; /* of the reference tier: some outputs or all */
    int reference_count;
    const conf_expected *exact; /* of the bit-exact tier: all outputs, bound 0 */
    int exact_count;
} conf_case;

/* Cases compiled in; the generated files define these. */
typedef struct conf_case_list {
    const conf_case *cases;
    size_t count;
} conf_case_list;

extern const char conf_vectors_version[];
extern const conf_case_list conf_case_lists[];
extern const size_t conf_case_list_count;

/* Writes a string; lines come in one or more pieces. */
typedef void (*conf_put)(const char *text);

/* What a stage's cases gave. */
typedef struct conf_stage_report {
    uint32_t cases;
    uint32_t exact;         /* cases whose defined reference words are all met bit for bit */
    uint32_t failed;        /* cases with any word off in either tier */
    uint64_t exact_words;   /* that must be met bit for bit */
    uint64_t bounded_words; /* that may differ */
    uint64_t undefined;     /* words that are not compared with the reference */
    uint64_t worst_percent; /* of a word's own bound */
} conf_stage_report;

#define CONF_MAX_STAGES 24

/* What the words of one row of conf_measures gave. */
typedef struct conf_words_report {
    uint64_t words; /* that may differ */
    uint64_t undefined;
    uint64_t worst; /* 10^-9 of the unit, against the reference */
    uint64_t bound; /* the widest; of the relative kinds beside base_lsb */
    uint64_t worst_percent;
} conf_words_report;

typedef struct conf_run {
    conf_put put;
    sha256 digest;
    conf_stage_report stages[CONF_MAX_STAGES];
    conf_words_report words[CONF_MEASURES];
} conf_run;

void conf_begin(conf_run *run, conf_put put);

/* Run a case; a line for each output that is off, naming case, tier, output, first word, expected and found. */
void conf_run_case(conf_run *run, const conf_case *c);

/* Print the table of stages, that of the words that may differ, and the last line; returns 1 when a case failed or none was run, else 0.
 * The digest covers, case by case, the bytes of its id and its output words as little-endian int64. */
int conf_end(conf_run *run);

/* A word in the form of the .hex files: bits / 4 digits. */
#define CONF_HEX_WORD 17
void conf_hex_word(char text[CONF_HEX_WORD], int64_t word, int bits);

#ifdef __cplusplus
}
#endif
#endif
