/* SPDX-License-Identifier: Apache-2.0 */
/* The table of drogue measure: the sink of the members with a line for each, arrays on one line, groups indented. */
#include "table.h"

#include <stdio.h>
#include <string.h>

enum { TABLE_LABEL = 22, TABLE_DEPTH = 4 };

typedef struct table {
    int depth;
    int is_array[TABLE_DEPTH];
    int items; /* on the line of an array */
} table;

static void put_label(const table *t, const char *name)
{
    printf("%*s%-*s ", 2 * t->depth, "", TABLE_LABEL - 2 * t->depth, name != NULL ? name : "");
}

static void begin(void *state, const char *name, int is_array, int known)
{
    table *t = state;
    (void)known;
    if (t->is_array[t->depth]) { /* a matrix: a line a row */
        if (t->items > 0) {
            printf("\n%*s ", TABLE_LABEL, "");
        }
    } else {
        if (is_array) {
            put_label(t, name);
        } else {
            printf("%*s%s\n", 2 * t->depth, "", name);
        }
    }
    t->depth++;
    t->is_array[t->depth] = is_array;
    t->items = 0;
}

static void end(void *state)
{
    table *t = state;
    const int was_array = t->is_array[t->depth];
    t->depth--;
    t->items = 1;
    if (was_array && !t->is_array[t->depth]) {
        putchar('\n');
    }
}

static void value(void *state, const char *name, const char *text)
{
    table *t = state;
    text = text != NULL ? text : "-";
    if (t->is_array[t->depth]) {
        printf("%s%s", t->items++ > 0 ? ", " : "", text);
        return;
    }
    put_label(t, name);
    puts(text);
}

static void text(void *state, const char *name, const char *bytes)
{
    if (strcmp(name, "image") != 0 && strcmp(name, "status") != 0) { /* these are the first line */
        value(state, name, bytes);
    }
}

void table_print(const measurement *m)
{
    table t;
    const member_sink sink = {&t, begin, end, value, text};
    const int unresolved = measurement_known(m) && !m->result->orientation_resolved;
    memset(&t, 0, sizeof t);
    printf("%s: %s%s\n", m->path, measurement_status(m),
           unresolved ? ", orientation unresolved: either pose, this or the alternative" : "");
    members_of_measurement(&sink, m);
}
