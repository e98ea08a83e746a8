/* SPDX-License-Identifier: Apache-2.0 */
/* CSV: the sink of the members, once for their names and once for their values. */
#include "csv.h"

#include <string.h>

enum { CSV_DEPTH = 4 };

typedef struct csv {
    FILE *out;
    int names; /* 1: write these */
    int count;
    int depth;
    const char *group[CSV_DEPTH]; /* NULL: a place in an array */
    int place[CSV_DEPTH];
} csv;

static void put_name(csv *c, const char *name)
{
    int i;
    for (i = 1; i <= c->depth; i++) {
        if (c->group[i] != NULL) {
            fprintf(c->out, "%s%s", i > 1 ? "." : "", c->group[i]);
        } else {
            fprintf(c->out, ".%d", c->place[i - 1]);
        }
    }
    if (name != NULL) {
        fprintf(c->out, "%s%s", c->depth > 0 ? "." : "", name);
    } else {
        fprintf(c->out, ".%d", c->place[c->depth]);
    }
}

static void begin(void *state, const char *name, int is_array, int known)
{
    csv *c = state;
    (void)is_array;
    (void)known;
    c->depth++;
    c->group[c->depth] = name;
    c->place[c->depth] = 0;
}

static void end(void *state)
{
    csv *c = state;
    c->depth--;
    c->place[c->depth]++;
}

static void value(void *state, const char *name, const char *text)
{
    csv *c = state;
    fputs(c->count++ > 0 ? "," : "", c->out);
    if (c->names) {
        put_name(c, name);
    } else {
        fputs(text != NULL ? text : "", c->out);
    }
    c->place[c->depth]++;
}

static void text(void *state, const char *name, const char *bytes)
{
    csv *c = state;
    value(state, name, NULL);
    if (c->names || bytes == NULL) {
        return;
    }
    if (strpbrk(bytes, ",\"\r\n") == NULL) {
        fputs(bytes, c->out);
        return;
    }
    fputc('"', c->out);
    for (; *bytes != '\0'; bytes++) {
        fputs(*bytes == '"' ? "\"" : "", c->out);
        fputc(*bytes, c->out);
    }
    fputc('"', c->out);
}

static member_sink begin_line(csv *c, FILE *out, int names)
{
    member_sink sink = {c, begin, end, value, text};
    memset(c, 0, sizeof *c);
    c->out = out;
    c->names = names;
    return sink;
}

void csv_measurement(FILE *out, const measurement *m)
{
    csv c;
    int names;
    for (names = 1; names >= 0; names--) {
        const member_sink sink = begin_line(&c, out, names);
        members_of_measurement(&sink, m);
        fputs("\n", out);
    }
}

void csv_track_line(FILE *out, const track_line *line)
{
    csv c;
    int names;
    for (names = line->frame == 1; names >= 0; names--) {
        const member_sink sink = begin_line(&c, out, names);
        members_of_track_line(&sink, line);
        fputs("\n", out);
    }
}
