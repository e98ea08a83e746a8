/* SPDX-License-Identifier: Apache-2.0 */
/* Output names, compared with the input by device and inode. */
#include "outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli.h"

#define MOST_FRAMES 99999 /* of a stream, whose length nobody knows beforehand, that are looked at */

typedef struct identity {
    dev_t device;
    ino_t inode;
} identity;

typedef struct inputs {
    identity *files; /* ordered */
    size_t count;
} inputs;

char *output_numbered(const char *out, int number)
{
    const size_t length = strlen(out) + 16;
    const char *slash = strrchr(out, '/');
    const char *dot = strrchr(slash != NULL ? slash : out, '.');
    const int stem = dot != NULL ? (int)(dot - out) : (int)strlen(out);
    char *path = malloc(length);
    if (path == NULL) {
        complain(out, "out of memory");
        return NULL;
    }
    snprintf(path, length, "%.*s-%04d%s", stem, out, number, out + stem);
    return path;
}

static int compare(const void *a, const void *b)
{
    const identity *x = a;
    const identity *y = b;
    if (x->device != y->device) {
        return x->device < y->device ? -1 : 1;
    }
    return x->inode < y->inode ? -1 : x->inode > y->inode;
}

/* What a path or, where that is "-", a stream names: 1 for a file that writing would change, 0 for what is not there, a
 * device or a pipe. */
static int identify(identity *out, const char *path, int stream)
{
    struct stat s;
    const int named = strcmp(path, "-") == 0 ? fstat(stream, &s) : stat(path, &s);
    if (named != 0 || !S_ISREG(s.st_mode)) {
        return 0;
    }
    memset(out, 0, sizeof *out);
    out->device = s.st_dev;
    out->inode = s.st_ino;
    return 1;
}

static int is_input(const inputs *in, const char *path)
{
    identity id;
    return in->count > 0 && identify(&id, path, STDOUT_FILENO) &&
           bsearch(&id, in->files, in->count, sizeof id, compare) != NULL;
}

static int check(const inputs *in, const char *path)
{
    return is_input(in, path) ? complain(path, "is read as input and would be overwritten") : EXIT_MEASURED;
}

static int check_all(const options *o, const inputs *in)
{
    int count = o->file_count;
    int bad = 0;
    int i;
    if (o->command == COMMAND_EDGES) {
        return check(in, o->files[1]);
    }
    if (o->overlay == NULL) {
        return EXIT_MEASURED;
    }
    if (o->command == COMMAND_MEASURE) {
        return check(in, o->overlay);
    }
    if (o->raw.kind != RAW_NONE || strcmp(o->files[0], "-") == 0) { /* a stream stands alone */
        count = MOST_FRAMES;
    }
    for (i = 0; i < count && !bad; i++) {
        char *path = output_numbered(o->overlay, i + 1);
        bad = path == NULL || check(in, path);
        free(path);
    }
    return bad ? EXIT_BAD : EXIT_MEASURED;
}

int outputs_check(const options *o)
{
    const int count = o->command == COMMAND_EDGES ? 1 : o->file_count; /* its second file is written */
    inputs in = {NULL, 0};
    int code;
    int i;
    in.files = malloc(((size_t)count + 2) * sizeof *in.files);
    if (in.files == NULL) {
        return complain("input", "out of memory");
    }
    for (i = 0; i < count; i++) {
        in.count += (size_t)identify(&in.files[in.count], o->files[i], STDIN_FILENO);
    }
    if (o->camera_file != NULL) {
        in.count += (size_t)identify(&in.files[in.count], o->camera_file, STDIN_FILENO);
    }
    qsort(in.files, in.count, sizeof *in.files, compare);
    code = check_all(o, &in);
    free(in.files);
    return code;
}
