/* SPDX-License-Identifier: Apache-2.0 */
/* Comparison of a stage's outputs with both tiers, the table of stages and the digest of all outputs. */
#include "conformance.h"

#include <string.h>

/* --- text --- */

static void put_decimal(conf_put put, uint64_t v, int width)
{
    char text[24];
    int at = (int)sizeof text - 1;
    text[at] = '\0';
    do {
        text[--at] = (char)('0' + (int)(v % 10));
        v /= 10;
    } while (v != 0);
    while (at > 0 && (int)sizeof text - 1 - at < width) {
        text[--at] = ' ';
    }
    put(text + at);
}

static void put_signed(conf_put put, int64_t v)
{
    if (v < 0) {
        put("-");
    }
    put_decimal(put, v < 0 ? (uint64_t)0 - (uint64_t)v : (uint64_t)v, 0);
}

/* Thousandths as a decimal fraction. */
static void put_thousandths(conf_put put, uint64_t v, int width)
{
    char text[5];
    text[0] = '.';
    text[1] = (char)('0' + (int)(v / 100 % 10));
    text[2] = (char)('0' + (int)(v / 10 % 10));
    text[3] = (char)('0' + (int)(v % 10));
    text[4] = '\0';
    put_decimal(put, v / 1000, width - 4);
    put(text);
}

static void put_padded(conf_put put, const char *text, size_t width)
{
    size_t k;
    put(text);
    for (k = strlen(text); k < width; k++) {
        put(" ");
    }
}

void conf_hex_word(char text[CONF_HEX_WORD], int64_t word, int bits)
{
    int digits = bits / 4;
    int k;
    for (k = 0; k < digits; k++) {
        text[k] = "0123456789abcdef"[((uint64_t)word >> (4 * (digits - 1 - k))) & 15u];
    }
    text[digits] = '\0';
}

static void put_word(conf_put put, const char *what, int64_t word, int bits)
{
    char hex[CONF_HEX_WORD];
    conf_hex_word(hex, word, bits);
    put(what);
    put(hex);
    put(" (");
    put_signed(put, word);
    put(")");
}

static void put_failure(conf_put put, const conf_case *c, const char *tier, const char *output, const char *what)
{
    put("FAIL ");
    put(c->id);
    put(": ");
    put(tier);
    put(" ");
    put(output);
    put(what);
}

/* --- comparison --- */

static uint64_t difference(int64_t a, int64_t b)
{
    return a > b ? (uint64_t)a - (uint64_t)b : (uint64_t)b - (uint64_t)a;
}

/* What one array's comparison gave. */
typedef struct comparison {
    size_t off;   /* words beyond their bound */
    size_t first; /* of them */
    int exact;    /* no word differs */
} comparison;

static void raise_to(uint64_t *most, uint64_t v) { *most = v > *most ? v : *most; }

/* 10^-9 of the whole; saturated. */
static uint64_t share(uint64_t part, uint64_t whole)
{
    while (part > UINT64_MAX / 1000000000u) {
        part >>= 1;
        whole >>= 1;
    }
    return whole > 0 ? part * 1000000000u / whole : part > 0 ? UINT64_MAX : 0;
}

/* Enter a word that may differ, or is undefined, in its row. */
static void note_word(conf_run *run, const char *stage, const conf_array *expected, size_t i, uint64_t d,
                      uint64_t bound)
{
    const conf_measure *m = conf_measure_of(stage, expected->name, i);
    conf_words_report *r = m != NULL ? &run->words[m - conf_measures] : NULL;
    uint64_t beside = m != NULL && (m->kind == CONF_OF_ITSELF || m->kind == CONF_OF_SCALE) ? m->base_lsb : 0;
    if (r == NULL) {
        return;
    }
    if (bound == CONF_UNDEFINED) {
        r->undefined++;
        return;
    }
    r->words++;
    raise_to(&r->worst_percent, (d > UINT64_MAX / 100 ? UINT64_MAX : d * 100) / bound);
    raise_to(&r->worst, d > beside ? share(d, conf_measure_whole(m, expected, i)) : 0);
    raise_to(&r->bound, bound > beside ? share(bound - beside, conf_measure_whole(m, expected, i)) : 0);
}

/* Compare with one expected array, and enter its words where 'report' is one. */
static comparison compare(conf_run *run, conf_stage_report *report, const char *stage, const conf_expected *expected,
                          const conf_array *found)
{
    comparison r = {0, 0, 1};
    size_t i;
    for (i = 0; i < found->count; i++) {
        uint64_t bound = expected->bound[i % expected->bound_count];
        uint64_t d = difference(conf_word(&expected->array, i), conf_word(found, i));
        if (d != 0 && bound != CONF_UNDEFINED) {
            r.exact = 0;
        }
        if (d > bound && r.off++ == 0) {
            r.first = i;
        }
        if (report == NULL) {
            continue;
        }
        if (bound == 0) {
            report->exact_words++;
        } else if (bound == CONF_UNDEFINED) {
            report->undefined++;
        } else {
            report->bounded_words++;
            raise_to(&report->worst_percent, (d > UINT64_MAX / 100 ? UINT64_MAX : d * 100) / bound);
        }
        if (bound != 0) {
            note_word(run, stage, &expected->array, i, d, bound);
        }
    }
    return r;
}

static const conf_array *named(const conf_array *outputs, int count, const char *name)
{
    int i;
    for (i = 0; i < count; i++) {
        if (strcmp(outputs[i].name, name) == 0) {
            return &outputs[i];
        }
    }
    return NULL;
}

static void put_words_off(conf_put put, const conf_case *c, const char *tier, const conf_expected *expected,
                          const conf_array *found, const comparison *r)
{
    put_failure(put, c, tier, found->name, " word ");
    put_decimal(put, r->first, 0);
    put_word(put, ": expected ", conf_word(&expected->array, r->first), found->bits);
    put_word(put, ", found ", conf_word(found, r->first), found->bits);
    put(", bound ");
    put_decimal(put, expected->bound[r->first % expected->bound_count], 0);
    put(", ");
    put_decimal(put, r->off, 0);
    put(" of ");
    put_decimal(put, found->count, 0);
    put(" words off\n");
}

static int same_shape(const conf_array *a, const conf_array *b)
{
    return a->bits == b->bits && a->count == b->count && a->width_px == b->width_px && a->height_px == b->height_px;
}

static void put_shape(conf_put put, const char *what, const conf_array *a)
{
    put(what);
    put_decimal(put, a->count, 0);
    put(" words of ");
    put_decimal(put, (uint64_t)a->bits, 0);
    put(" bits");
    if (a->width_px > 0) {
        put(" (");
        put_decimal(put, (uint64_t)a->width_px, 0);
        put(" x ");
        put_decimal(put, (uint64_t)a->height_px, 0);
        put(")");
    }
}

/* Compare one expected array; 1 when it is off. 'exact' is cleared when any word differs. */
static int compare_array(conf_run *run, conf_stage_report *report, int *exact, const conf_case *c, const char *tier,
                         const conf_expected *expected, const conf_array *found)
{
    comparison r;
    if (found == NULL || !same_shape(found, &expected->array)) {
        *exact = 0;
        put_failure(run->put, c, tier, expected->array.name, found == NULL ? ": the stage has no such output" : "");
        if (found != NULL) {
            put_shape(run->put, ": expected ", &expected->array);
            put_shape(run->put, ", found ", found);
        }
        run->put("\n");
        return 1;
    }
    r = compare(run, report, c->stage, expected, found);
    if (r.off > 0) {
        put_words_off(run->put, c, tier, expected, found, &r);
    }
    *exact = *exact && r.exact;
    return r.off > 0;
}

/* Outputs that the bit-exact tier does not name are off: nothing may go unchecked. */
static int count_unnamed(conf_run *run, const conf_case *c, const conf_array *outputs, int output_count)
{
    int off = 0;
    int i;
    int k;
    for (i = 0; i < output_count; i++) {
        for (k = 0; k < c->exact_count && strcmp(c->exact[k].array.name, outputs[i].name) != 0; k++) {}
        if (k == c->exact_count) {
            put_failure(run->put, c, "exact", outputs[i].name, ": not among the expected outputs\n");
            off++;
        }
    }
    return off;
}

/* --- run --- */

static void digest_case(conf_run *run, const conf_case *c, const conf_array *outputs, int output_count)
{
    int i;
    size_t k;
    int b;
    sha256_add(&run->digest, c->id, strlen(c->id));
    for (i = 0; i < output_count; i++) {
        for (k = 0; k < outputs[i].count; k++) {
            uint64_t word = (uint64_t)conf_word(&outputs[i], k);
            uint8_t bytes[8];
            for (b = 0; b < 8; b++) {
                bytes[b] = (uint8_t)(word >> (8 * b));
            }
            sha256_add(&run->digest, bytes, 8);
        }
    }
}

void conf_begin(conf_run *run, conf_put put)
{
    memset(run, 0, sizeof *run);
    run->put = put;
    sha256_init(&run->digest);
}

void conf_run_case(conf_run *run, const conf_case *c)
{
    conf_array outputs[CONF_MAX_OUTPUTS];
    conf_stage_report *report;
    int stage;
    int count;
    int off = 0;
    int exact = 1;
    int same = 1;
    int i;
    for (stage = 0; stage < conf_stage_count() && strcmp(conf_stage_name(stage), c->stage) != 0; stage++) {}
    report = &run->stages[stage < CONF_MAX_STAGES ? stage : CONF_MAX_STAGES - 1]; /* an unknown stage fails below */
    count = conf_run_stage(c->stage, c->inputs, c->input_count, outputs, CONF_MAX_OUTPUTS);
    if (count < 0) {
        put_failure(run->put, c, "stage", c->stage, ": ");
        run->put(conf_failure_text(count));
        run->put("\n");
        off = 1;
        exact = 0;
        count = 0;
    } else {
        for (i = 0; i < c->reference_count; i++) {
            const conf_expected *e = &c->reference[i];
            off += compare_array(run, report, &exact, c, "reference", e, named(outputs, count, e->array.name));
        }
        for (i = 0; i < c->exact_count; i++) {
            const conf_expected *e = &c->exact[i];
            off += compare_array(run, NULL, &same, c, "exact", e, named(outputs, count, e->array.name));
        }
        off += count_unnamed(run, c, outputs, count);
    }
    digest_case(run, c, outputs, count);
    report->cases++;
    report->exact += exact ? 1u : 0u;
    report->failed += off > 0 ? 1u : 0u;
}

static void put_stage(conf_put put, const char *name, const conf_stage_report *r)
{
    put_padded(put, name, 12);
    put_decimal(put, r->cases, 6);
    put_decimal(put, r->exact, 7);
    put_decimal(put, r->failed, 7);
    put_decimal(put, r->exact_words, 13);
    put_decimal(put, r->bounded_words, 9);
    put_decimal(put, r->undefined, 10);
    put_decimal(put, r->worst_percent, 12);
    put("\n");
}

static void put_words(conf_put put, const conf_measure *m, const conf_words_report *r)
{
    put_padded(put, m->stage != NULL ? m->stage : "all", 12);
    put_padded(put, m->name, 16);
    put_padded(put, m->unit, 6);
    put_decimal(put, r->words, 9);
    put_decimal(put, r->undefined, 10);
    put_thousandths(put, r->worst, 12);
    put_thousandths(put, r->bound, 12);
    put_decimal(put, r->worst_percent, 10);
    put("\n");
}

int conf_end(conf_run *run)
{
    uint64_t cases = 0;
    uint64_t exact = 0;
    uint64_t failed = 0;
    char hex[SHA256_HEX];
    int i;
    run->put("stage        cases  exact failed  words: exact  bounded undefined  % of bound\n");
    for (i = 0; i < conf_stage_count(); i++) {
        if (run->stages[i].cases > 0) {
            put_stage(run->put, conf_stage_name(i), &run->stages[i]);
        }
        cases += run->stages[i].cases;
        exact += run->stages[i].exact;
        failed += run->stages[i].failed;
    }
    run->put("\nwords that may differ, 10^-6 of their unit\n"
             "stage       what            unit      words undefined       worst       bound   % of it\n");
    for (i = 0; i < CONF_MEASURES; i++) {
        if (run->words[i].words > 0 || run->words[i].undefined > 0) {
            put_words(run->put, &conf_measures[i], &run->words[i]);
        }
    }
    sha256_end(hex, &run->digest);
    run->put("conformance: cases=");
    put_decimal(run->put, cases, 0);
    run->put(" exact=");
    put_decimal(run->put, exact, 0);
    run->put(" failed=");
    put_decimal(run->put, failed, 0);
    run->put(" digest=");
    run->put(hex);
    run->put("\n");
    return failed > 0 || cases == 0;
}
