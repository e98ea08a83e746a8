/* SPDX-License-Identifier: Apache-2.0 */
/* conformance_embed: writes the golden vectors as C files, for targets without files of their own. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "vectors.h"

/* A C file being written; arrays of equal content share one definition. */
typedef struct writer {
    FILE *out;
    const conf_array **arrays; /* written so far; their index is part of their name */
    unsigned long array_count;
    unsigned long bound_count;
} writer;

static size_t array_bytes(const conf_array *a) { return a->count * (size_t)(a->bits / 8); }

static size_t case_bytes(const conf_case *c)
{
    size_t bytes = 0;
    int i;
    for (i = 0; i < c->input_count; i++) {
        bytes += array_bytes(&c->inputs[i]);
    }
    for (i = 0; i < c->reference_count; i++) {
        bytes += array_bytes(&c->reference[i].array);
    }
    for (i = 0; i < c->exact_count; i++) {
        bytes += array_bytes(&c->exact[i].array);
    }
    return bytes;
}

static int same_data(const conf_array *a, const conf_array *b)
{
    return a->bits == b->bits && (a->width_px > 0) == (b->width_px > 0) && a->count == b->count &&
           memcmp(a->data, b->data, array_bytes(a)) == 0;
}

/* The least value has no literal of its own in C. */
static void write_word(FILE *out, int64_t word, int bits)
{
    if (bits == 64 && word == INT64_MIN) {
        fputs("INT64_MIN,", out);
    } else if (bits == 64) {
        fprintf(out, "INT64_C(%lld),", (long long)word);
    } else if (bits == 32 && word == INT32_MIN) {
        fputs("INT32_MIN,", out);
    } else {
        fprintf(out, "%ld,", (long)word);
    }
}

static void write_data(FILE *out, const conf_array *a, unsigned long number)
{
    const size_t line_words = a->bits == 8 ? 32 : a->bits == 64 ? 4 : 12;
    size_t i;
    fprintf(out, "static const %sint%d_t data_%lu[] = {", a->width_px > 0 ? "u" : "", a->bits, number);
    for (i = 0; i < a->count; i++) {
        if (i % line_words == 0) {
            fputs("\n    ", out);
        }
        write_word(out, conf_word(a, i), a->bits);
    }
    fputs(a->count == 0 ? "0};\n" : "};\n", out);
}

/* Number of the array's definition, which is written when there is none yet. */
static unsigned long define_array(writer *w, const conf_array *a)
{
    unsigned long i;
    for (i = 0; i < w->array_count && !same_data(w->arrays[i], a); i++) {}
    if (i == w->array_count) {
        write_data(w->out, a, i);
        w->arrays[w->array_count++] = a;
    }
    return i;
}

static void write_array(FILE *out, const conf_array *a, unsigned long number)
{
    fprintf(out, "{\"%s\", %d, %lu, data_%lu, %ld, %ld}", a->name, a->bits, (unsigned long)a->count, number,
            (long)a->width_px, (long)a->height_px);
}

static void write_inputs(writer *w, const conf_case *c, unsigned long number)
{
    unsigned long data[CONF_MAX_INPUTS];
    int i;
    for (i = 0; i < c->input_count; i++) {
        data[i] = define_array(w, &c->inputs[i]);
    }
    fprintf(w->out, "static const conf_array inputs_%lu[] = {", number);
    for (i = 0; i < c->input_count; i++) {
        fputs("\n    ", w->out);
        write_array(w->out, &c->inputs[i], data[i]);
        fputc(',', w->out);
    }
    fputs("};\n", w->out);
}

static void write_expected(writer *w, const char *tier, const conf_expected *expected, int count, unsigned long number)
{
    unsigned long data[CONF_MAX_OUTPUTS];
    unsigned long first_bound = w->bound_count;
    int i;
    for (i = 0; i < count; i++) {
        size_t k;
        data[i] = define_array(w, &expected[i].array);
        fprintf(w->out, "static const uint64_t bound_%lu[] = {", w->bound_count++);
        for (k = 0; k < expected[i].bound_count; k++) {
            if (expected[i].bound[k] == CONF_UNDEFINED) {
                fputs("CONF_UNDEFINED,", w->out);
            } else {
                fprintf(w->out, "%lluu,", (unsigned long long)expected[i].bound[k]);
            }
        }
        fputs("};\n", w->out);
    }
    if (count == 0) {
        return;
    }
    fprintf(w->out, "static const conf_expected %s_%lu[] = {", tier, number);
    for (i = 0; i < count; i++) {
        fputs("\n    {", w->out);
        write_array(w->out, &expected[i].array, data[i]);
        fprintf(w->out, ", bound_%lu, %lu},", first_bound + (unsigned long)i, (unsigned long)expected[i].bound_count);
    }
    fputs("};\n", w->out);
}

static void write_cases(writer *w, const vectors *v, size_t first, size_t count, unsigned file)
{
    unsigned long i;
    for (i = 0; i < count; i++) {
        const conf_case *c = &v->cases[first + i].run;
        write_inputs(w, c, i);
        write_expected(w, "reference", c->reference, c->reference_count, i);
        write_expected(w, "exact", c->exact, c->exact_count, i);
    }
    fprintf(w->out, "extern const conf_case conf_cases_%u[];\nconst conf_case conf_cases_%u[] = {\n", file, file);
    for (i = 0; i < count; i++) {
        const conf_case *c = &v->cases[first + i].run;
        fprintf(w->out, "    {\"%s\", \"%s\", \"%s\", inputs_%lu, %d, ", c->id, c->stage, c->tier, i, c->input_count);
        if (c->reference_count > 0) {
            fprintf(w->out, "reference_%lu, %d, ", i, c->reference_count);
        } else {
            fputs("0, 0, ", w->out);
        }
        fprintf(w->out, "exact_%lu, %d},\n", i, c->exact_count);
    }
    fputs("};\n", w->out);
}

static FILE *open_file(const char *folder, const char *name)
{
    char path[1024];
    FILE *out;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    out = fopen(path, "w");
    if (out == NULL) {
        perror(path);
        exit(2);
    }
    fputs("/* Generated from the golden vectors by conformance_embed. */\n#include \"conformance.h\"\n\n", out);
    return out;
}

static void close_file(FILE *out)
{
    if (ferror(out) || fclose(out) != 0) {
        perror("conformance_embed");
        exit(2);
    }
}

/* Cases from 'first' on for one file: until 'bytes' are reached; *done counts the bytes of all files. */
static size_t share(const vectors *v, size_t first, size_t *done, size_t bytes)
{
    size_t count = 0;
    while (first + count < v->count && *done < bytes) {
        *done += case_bytes(&v->cases[first + count].run);
        count++;
    }
    return count;
}

static void write_index(const vectors *v, const char *folder, const size_t *counts, unsigned files)
{
    FILE *out = open_file(folder, "cases_index.c");
    unsigned i;
    fprintf(out, "const char conf_vectors_version[] = \"%s\";\n", v->version);
    for (i = 0; i < files; i++) {
        if (counts[i] > 0) {
            fprintf(out, "extern const conf_case conf_cases_%u[];\n", i);
        }
    }
    fputs("const conf_case_list conf_case_lists[] = {\n", out);
    for (i = 0; i < files; i++) {
        if (counts[i] > 0) {
            fprintf(out, "    {conf_cases_%u, %lu},\n", i, (unsigned long)counts[i]);
        }
    }
    fputs("};\nconst size_t conf_case_list_count = sizeof conf_case_lists / sizeof conf_case_lists[0];\n", out);
    close_file(out);
}

/* Is 'chosen' the case's stage or its id? */
static int is_chosen(const conf_case *c, const char *chosen)
{
    return strcmp(c->stage, chosen) == 0 || strcmp(c->id, chosen) == 0;
}

/* Leave the cases of the given stages and ids only; 0 and a line where one names nothing. */
static int choose(vectors *v, char **chosen, int count)
{
    size_t kept = 0;
    size_t i;
    int k;
    for (k = 0; k < count; k++) {
        for (i = 0; i < v->count && !is_chosen(&v->cases[i].run, chosen[k]); i++) {}
        if (i == v->count) {
            fprintf(stderr, "conformance_embed: no stage and no case '%s'\n", chosen[k]);
            return 0;
        }
    }
    for (i = 0; i < v->count; i++) {
        for (k = 0; k < count && !is_chosen(&v->cases[i].run, chosen[k]); k++) {}
        if (k < count) {
            v->cases[kept++] = v->cases[i];
        }
    }
    v->count = kept;
    return 1;
}

int main(int argc, char **argv)
{
    enum { MAX_FILES = 64 };
    size_t counts[MAX_FILES];
    size_t first = 0;
    size_t total = 0;
    size_t done = 0;
    size_t i;
    unsigned files;
    unsigned file;
    vectors v;
    if (argc < 4 || (files = (unsigned)strtoul(argv[3], NULL, 10)) < 1 || files > MAX_FILES) {
        fprintf(stderr,
                "usage: conformance_embed VECTORS FOLDER N [STAGE | STAGE/CASE]...\n"
                "Writes N files (1 to %d) of the cases, cases_0.c and so on, and cases_index.c.\n"
                "Of the stages and cases named only, when any is named.\n",
                MAX_FILES);
        return 2;
    }
    if (!vectors_read(&v, argv[1]) || (argc > 4 && !choose(&v, argv + 4, argc - 4))) {
        return 2;
    }
    for (i = 0; i < v.count; i++) {
        total += case_bytes(&v.cases[i].run);
    }
    for (file = 0; file < files; file++) {
        char name[32];
        writer w = {NULL, NULL, 0, 0};
        size_t left = v.count - first;
        counts[file] = file + 1 == files ? left : share(&v, first, &done, total / files * (file + 1));
        snprintf(name, sizeof name, "cases_%u.c", file);
        w.out = open_file(argv[2], name);
        w.arrays = vectors_alloc((left + 1) * (CONF_MAX_INPUTS + 2 * CONF_MAX_OUTPUTS) * sizeof *w.arrays);
        if (counts[file] > 0) {
            write_cases(&w, &v, first, counts[file], file);
        } else {
            fputs("typedef int conf_no_cases;\n", w.out);
        }
        close_file(w.out);
        first += counts[file];
    }
    write_index(&v, argv[2], counts, files);
    printf("conformance_embed: %lu cases, %lu bytes of words\n", (unsigned long)v.count, (unsigned long)total);
    vectors_free();
    return 0;
}
