/* SPDX-License-Identifier: Apache-2.0 */
/* YAML through libyaml's events. */
#include "keys.h"

#include <string.h>

#ifdef HAVE_YAML
#include <yaml.h>

typedef struct level {
    int is_sequence;
    int place;
    int has_key;   /* a mapping: its next scalar is a value */
    size_t length; /* of the name up to here */
} level;

typedef struct walk {
    keys *k;
    char name[KEYS_NAME];
    level levels[KEYS_DEPTH];
    int depth;
    const char *wrong;
} walk;

/* Append a word to the name behind the present level's. */
static void extend(walk *w, const char *word, size_t length)
{
    const size_t at = w->levels[w->depth].length;
    if (at + length + 2 > KEYS_NAME) {
        w->wrong = KEYS_TOO_MUCH;
        return;
    }
    if (at > 0) {
        w->name[at] = '.';
    }
    memcpy(w->name + at + (at > 0), word, length);
    w->name[at + (at > 0) + length] = '\0';
}

/* A value or a nested node begins: in a sequence its name is its place. */
static void begin_node(walk *w)
{
    level *l = &w->levels[w->depth];
    if (w->depth > 0 && l->is_sequence) {
        char place[16];
        snprintf(place, sizeof place, "%d", l->place++);
        extend(w, place, strlen(place));
    }
    l->has_key = 0;
}

static void scalar(walk *w, const yaml_event_t *e)
{
    level *l = &w->levels[w->depth];
    const char *text = (const char *)e->data.scalar.value;
    if (memchr(text, '\0', e->data.scalar.length) != NULL) { /* names and values end there */
        w->wrong = "is no camera file: it holds a NUL";
        return;
    }
    if (w->depth > 0 && !l->is_sequence && !l->has_key) {
        extend(w, text, e->data.scalar.length);
        l->has_key = 1;
        return;
    }
    begin_node(w);
    if (w->wrong == NULL && !keys_add(w->k, w->name, text, e->data.scalar.length)) {
        w->wrong = KEYS_TOO_MUCH;
    }
}

static void open_level(walk *w, int is_sequence)
{
    begin_node(w);
    if (w->depth + 1 >= KEYS_DEPTH) {
        w->wrong = KEYS_TOO_MUCH;
        return;
    }
    w->depth++;
    memset(&w->levels[w->depth], 0, sizeof w->levels[w->depth]);
    w->levels[w->depth].is_sequence = is_sequence;
    w->levels[w->depth].length = strlen(w->name);
}

static void close_level(walk *w)
{
    const level *l = &w->levels[w->depth--];
    if (l->is_sequence && l->place == 0 && !keys_add(w->k, w->name, KEYS_EMPTY, strlen(KEYS_EMPTY))) {
        w->wrong = KEYS_TOO_MUCH;
    }
}

static void handle(walk *w, const yaml_event_t *e)
{
    switch (e->type) {
    case YAML_SCALAR_EVENT: scalar(w, e); break;
    case YAML_MAPPING_START_EVENT: open_level(w, 0); break;
    case YAML_SEQUENCE_START_EVENT: open_level(w, 1); break;
    case YAML_MAPPING_END_EVENT:
    case YAML_SEQUENCE_END_EVENT: close_level(w); break;
    case YAML_ALIAS_EVENT: w->wrong = "is no camera file: it holds an alias"; break;
    default: break;
    }
    if (!w->levels[w->depth].has_key) { /* what comes next begins at this level's name */
        w->name[w->levels[w->depth].length] = '\0';
    }
}

/* OpenCV begins with "%YAML:1.0", which is no directive of YAML. */
static void skip_directive(FILE *in)
{
    int c = getc(in);
    if (c != '%') {
        ungetc(c, in);
        return;
    }
    while (c != '\n' && c != EOF) {
        c = getc(in);
    }
}

const char *keys_read_yaml(keys *k, FILE *in)
{
    walk w;
    yaml_parser_t parser;
    int done = 0;
    memset(&w, 0, sizeof w);
    w.k = k;
    skip_directive(in);
    if (!yaml_parser_initialize(&parser)) {
        return "out of memory";
    }
    yaml_parser_set_input_file(&parser, in);
    while (!done && w.wrong == NULL) {
        yaml_event_t event;
        if (!yaml_parser_parse(&parser, &event)) {
            w.wrong = "is no YAML";
            break;
        }
        done = event.type == YAML_STREAM_END_EVENT;
        handle(&w, &event);
        yaml_event_delete(&event);
    }
    yaml_parser_delete(&parser);
    return w.wrong;
}

#else

const char *keys_read_yaml(keys *k, FILE *in)
{
    (void)k;
    (void)in;
    return "YAML is not read: this program was built without libyaml";
}

#endif
