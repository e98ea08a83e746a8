/* SPDX-License-Identifier: Apache-2.0 */
/* Comparison of result files with the bit-exact tier, file by file, word by word. */
#include "judge.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define MAX_PATH 1024

typedef struct tally {
    unsigned long files;
    unsigned long equal;
    unsigned long different;
    unsigned long missing;
} tally;

static int is_file(const char *path)
{
    FILE *f = fopen(path, "rb");
    if (f != NULL) {
        fclose(f);
    }
    return f != NULL;
}

/* Path of the result for an expected file: as named, without its folder, and both as words for an image. */
static int find_result(char path[MAX_PATH], const char *folder, const char *expected)
{
    const char *slash = strrchr(expected, '/');
    const char *names[2];
    size_t stem;
    int i;
    names[0] = expected;
    names[1] = slash != NULL ? slash + 1 : expected;
    for (i = 0; i < 4; i++) {
        const char *name = names[i & 1];
        stem = strlen(name) - strlen(".png"); /* .hex is as long */
        if (i < 2) {
            snprintf(path, MAX_PATH, "%s/%s", folder, name);
        } else {
            snprintf(path, MAX_PATH, "%s/%.*s.hex", folder, (int)stem, name);
        }
        if (is_file(path)) {
            return 1;
        }
    }
    return 0;
}

static int read_result(conf_array *result, char reason[VECTORS_TEXT], const char *path)
{
    size_t bytes;
    char *data = vectors_file(&bytes, reason, path);
    if (data == NULL) {
        return 0;
    }
    return strcmp(path + strlen(path) - strlen(".png"), ".png") == 0 ? vectors_png(result, reason, data, bytes)
                                                                     : vectors_readmemh(result, reason, data, bytes);
}

/* Line or, in a picture, pixel of the first word that differs. */
static void print_difference(const char *path, const conf_array *expected, const conf_array *found, size_t first,
                             size_t count)
{
    char expected_hex[CONF_HEX_WORD];
    char found_hex[CONF_HEX_WORD];
    conf_hex_word(expected_hex, conf_word(expected, first), expected->bits);
    conf_hex_word(found_hex, conf_word(found, first), found->bits);
    printf("DIFFERENT %s: line %lu", path, (unsigned long)first + 1);
    if (expected->width_px > 0) {
        printf(" (pixel %lu, %lu)", (unsigned long)(first % (size_t)expected->width_px),
               (unsigned long)(first / (size_t)expected->width_px));
    }
    printf(": expected %s (%lld), found %s (%lld); %lu of %lu words differ\n", expected_hex,
           (long long)conf_word(expected, first), found_hex, (long long)conf_word(found, first), (unsigned long)count,
           (unsigned long)expected->count);
}

/* Is it the expected file itself, as where the folder of a stage of the vectors is judged? */
static int is_expected(const char *path, const char *own, const char *file)
{
    char expected[MAX_PATH];
    struct stat s;
    struct stat of;
    snprintf(expected, MAX_PATH, "%s/%s", own, file);
    return stat(path, &s) == 0 && stat(expected, &of) == 0 && s.st_dev == of.st_dev && s.st_ino == of.st_ino;
}

static void judge_file(tally *t, const char *folder, const char *own, const conf_array *expected, const char *file)
{
    char path[MAX_PATH];
    char reason[VECTORS_TEXT];
    conf_array found = *expected;
    size_t first = 0;
    size_t count = 0;
    size_t i;
    t->files++;
    if (!find_result(path, folder, file)) {
        if (expected->count == 0) { /* no simulator writes a memory without words */
            t->equal++;
            return;
        }
        printf("MISSING %s\n", file);
        t->missing++;
        return;
    }
    if (is_expected(path, own, file)) {
        printf("DIFFERENT %s: is what is expected, no result\n", path);
        t->different++;
        return;
    }
    if (!read_result(&found, reason, path)) {
        printf("DIFFERENT %s: %s\n", path, reason);
        t->different++;
        return;
    }
    for (i = expected->count; i-- > 0;) {
        if (conf_word(expected, i) != conf_word(&found, i)) {
            first = i;
            count++;
        }
    }
    if (count > 0) {
        print_difference(path, expected, &found, first, count);
        t->different++;
    } else {
        t->equal++;
    }
}

/* Is it a folder, and not that of the vectors, in which all that is expected is found? */
static int is_folder(const char *path, const char *own)
{
    struct stat s;
    struct stat of;
    if (stat(path, &s) != 0) {
        fprintf(stderr, "conformance: %s: %s\n", path, strerror(errno));
        return 0;
    }
    if (!S_ISDIR(s.st_mode)) {
        fprintf(stderr, "conformance: %s: is no folder\n", path);
        return 0;
    }
    if (stat(own, &of) == 0 && s.st_dev == of.st_dev && s.st_ino == of.st_ino) {
        fprintf(stderr, "conformance: %s: is the folder of the vectors: what is expected would be judged\n", path);
        return 0;
    }
    return 1;
}

int judge(const vectors *v, const char *what, const char *folder, const char *own)
{
    tally t = {0, 0, 0, 0};
    size_t i;
    int k;
    if (!is_folder(folder, own)) {
        return 2;
    }
    for (i = 0; i < v->count; i++) {
        const vectors_case *c = &v->cases[i];
        if (strcmp(what, c->run.stage) == 0 || strcmp(what, c->run.id) == 0) {
            for (k = 0; k < c->run.exact_count; k++) {
                judge_file(&t, folder, own, &c->run.exact[k].array, c->exact_file[k]);
            }
        }
    }
    if (t.files == 0) {
        fprintf(stderr, "conformance: no stage and no case is named '%s'\n", what);
        return 2;
    }
    printf("judge: files=%lu equal=%lu different=%lu missing=%lu\n", t.files, t.equal, t.different, t.missing);
    return t.equal != t.files;
}
