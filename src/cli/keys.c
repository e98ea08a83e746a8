/* SPDX-License-Identifier: Apache-2.0 */
/* The list, and which reader a file is for. */
#include "keys.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"

int keys_add(keys *k, const char *name, const char *value, size_t length)
{
    const size_t name_bytes = strlen(name) + 1;
    char **more = k->count < KEYS_MOST ? realloc(k->names, (k->count + 1) * sizeof *more) : NULL;
    char *block;
    if (more == NULL) {
        return 0;
    }
    k->names = more;
    block = malloc(name_bytes + length + 1);
    if (block == NULL) {
        return 0;
    }
    memcpy(block, name, name_bytes);
    memcpy(block + name_bytes, value, length);
    block[name_bytes + length] = '\0';
    k->names[k->count++] = block;
    return 1;
}

void keys_free(keys *k)
{
    size_t i;
    for (i = 0; i < k->count; i++) {
        free(k->names[i]);
    }
    free(k->names);
    memset(k, 0, sizeof *k);
}

const char *keys_value(const keys *k, const char *name)
{
    size_t i;
    for (i = 0; i < k->count; i++) {
        if (strcmp(k->names[i], name) == 0) {
            return k->names[i] + strlen(name) + 1;
        }
    }
    return NULL;
}

const char *keys_contradiction(const keys *k, const char *name)
{
    const size_t length = strlen(name);
    size_t i;
    for (i = 0; i < k->count; i++) {
        const char *own = k->names[i];
        if (strncmp(own, name, length) == 0 && (own[length] == '\0' || own[length] == '.') &&
            strcmp(keys_value(k, own), own + strlen(own) + 1) != 0) {
            return own;
        }
    }
    return NULL;
}

int keys_has(const keys *k, const char *beginning)
{
    size_t i;
    for (i = 0; i < k->count; i++) {
        if (strncmp(k->names[i], beginning, strlen(beginning)) == 0) {
            return 1;
        }
    }
    return 0;
}

static int read_stream(keys *out, FILE *in, const char *path)
{
    int first = getc(in);
    const char *wrong;
    if (first == 0xEF) { /* the mark of UTF-8, which editors of Windows put before a text */
        first = getc(in) == 0xBB && getc(in) == 0xBF ? getc(in) : 0;
    }
    if (first == EOF) {
        return complain(path, "%s", ferror(in) ? strerror(errno) : "the file is empty");
    }
    ungetc(first, in);
    wrong = first == '<' ? keys_read_xml(out, in) : keys_read_yaml(out, in);
    return wrong == NULL ? EXIT_MEASURED : complain(path, "%s", wrong);
}

int keys_read(keys *out, const char *path)
{
    FILE *in = fopen(path, "rb");
    int code;
    memset(out, 0, sizeof *out);
    if (in == NULL) {
        return complain(path, "%s", strerror(errno));
    }
    code = read_stream(out, in, path);
    fclose(in);
    return code;
}
