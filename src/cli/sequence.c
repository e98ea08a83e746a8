/* SPDX-License-Identifier: Apache-2.0 */
/* Operands one after the other; "-" and raw video hold frames until they end. */
#include "sequence.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "cli.h"
#include "images.h"

static int is_folder(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISDIR(s.st_mode);
}

static int is_image(const struct dirent *entry)
{
    const char *dot = strrchr(entry->d_name, '.');
    return dot != NULL &&
           (strcasecmp(dot, ".png") == 0 || strcasecmp(dot, ".pgm") == 0 || strcasecmp(dot, ".ppm") == 0);
}

static char *copy(const char *folder, const char *name)
{
    const size_t length = strlen(folder) + strlen(name) + 2;
    char *path = malloc(length);
    if (path != NULL) {
        snprintf(path, length, "%s%s%s", folder, folder[0] != '\0' ? "/" : "", name);
    }
    return path;
}

static int append(options *o, char *path)
{
    char **more = path != NULL ? realloc(o->expanded, ((size_t)o->expanded_count + 1) * sizeof *more) : NULL;
    if (more == NULL) {
        free(path);
        return complain("frames", "out of memory");
    }
    more[o->expanded_count++] = path;
    o->expanded = more;
    return EXIT_MEASURED;
}

static int append_folder(options *o, const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_image, alphasort);
    int bad = 0;
    int i;
    if (count < 0) {
        return complain(folder, "%s", strerror(errno));
    }
    for (i = 0; i < count; i++) {
        bad = bad || append(o, copy(folder, entries[i]->d_name));
        free(entries[i]);
    }
    free(entries);
    if (count == 0) {
        return complain(folder, "a folder without .png, .pgm or .ppm files");
    }
    return bad ? EXIT_BAD : EXIT_MEASURED;
}

int sequence_expand(options *o)
{
    int i;
    if (o->command != COMMAND_TRACK) {
        return EXIT_MEASURED;
    }
    for (i = 0; i < o->file_count; i++) {
        if (o->file_count > 1 && (strcmp(o->files[i], "-") == 0 || o->raw.kind != RAW_NONE)) {
            return complain(o->files[i], "standard input and raw video stand alone");
        }
        if (is_folder(o->files[i]) && o->raw.kind != RAW_NONE) {
            return complain(o->files[i], "is a folder: raw video is one file or standard input");
        }
        if (is_folder(o->files[i]) ? append_folder(o, o->files[i]) : append(o, copy("", o->files[i]))) {
            return EXIT_BAD;
        }
    }
    o->files = o->expanded;
    o->file_count = o->expanded_count;
    return EXIT_MEASURED;
}

void sequence_free(options *o)
{
    int i;
    for (i = 0; i < o->expanded_count; i++) {
        free(o->expanded[i]);
    }
    free(o->expanded);
}

int sequence_next(picture *out, const char **path, int *end, sequence *s, const options *o)
{
    int code;
    memset(out, 0, sizeof *out);
    *end = s->next >= o->file_count;
    if (*end) {
        return EXIT_MEASURED;
    }
    *path = o->files[s->next];
    if (o->raw.kind == RAW_NONE && strcmp(*path, "-") != 0) {
        s->next++;
        return picture_read_grey(out, *path);
    }
    if (s->stream == NULL) {
        s->stream = images_open(*path);
        if (s->stream == NULL) {
            return EXIT_BAD;
        }
    }
    code = o->raw.kind != RAW_NONE ? raw_read(out, end, &o->raw, s->stream, *path)
                                   : images_next(out, end, s->stream, *path);
    s->next += *end;
    return code;
}

void sequence_close(sequence *s)
{
    images_close(s->stream);
    s->stream = NULL;
}
