/* SPDX-License-Identifier: Apache-2.0 */
/* JSON by hand: the sink of the members. */
#include "json.h"

#include <string.h>

enum { JSON_DEPTH = 4 };

typedef struct json {
    FILE *out;
    int depth;
    int count[JSON_DEPTH]; /* of what a group holds so far */
    int is_array[JSON_DEPTH];
    int unknown; /* groups within one that is null, itself included */
} json;

/* Length of the UTF-8 character at the start of a text; 0 when there is none (RFC 3629). */
static int utf8_length(const unsigned char *s)
{
    int length = s[0] < 0x80 ? 1 : s[0] < 0xC2 ? 0 : s[0] < 0xE0 ? 2 : s[0] < 0xF0 ? 3 : s[0] < 0xF5 ? 4 : 0;
    int i;
    for (i = 1; i < length; i++) {
        if ((s[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    if ((s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF0 && s[1] < 0x90) ||
        (s[0] == 0xF4 && s[1] > 0x8F)) {
        return 0;
    }
    return length;
}

/* Text as a JSON string; bytes that are not UTF-8 become U+FFFD. */
static void put_string(FILE *out, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', out);
    while (*s != '\0') {
        int length = utf8_length(s);
        if (length == 0) {
            fputs("\\ufffd", out);
            s++;
        } else if (*s == '"' || *s == '\\') {
            fprintf(out, "\\%c", *s++);
        } else if (*s < 0x20) {
            fprintf(out, "\\u%04x", (unsigned)*s++);
        } else {
            fwrite(s, 1, (size_t)length, out);
            s += length;
        }
    }
    fputc('"', out);
}

/* What stands before a value: comma, key. */
static void put_name(json *j, const char *name)
{
    fputs(j->count[j->depth]++ > 0 ? "," : "", j->out);
    if (name != NULL && !j->is_array[j->depth]) {
        fprintf(j->out, "\"%s\":", name);
    }
}

static void begin(void *state, const char *name, int is_array, int known)
{
    json *j = state;
    if (j->unknown > 0) {
        j->unknown++;
        return;
    }
    put_name(j, name);
    if (!known) {
        fputs("null", j->out);
        j->unknown = 1;
        return;
    }
    j->depth++;
    j->count[j->depth] = 0;
    j->is_array[j->depth] = is_array;
    fputc(is_array ? '[' : '{', j->out);
}

static void end(void *state)
{
    json *j = state;
    if (j->unknown > 0) {
        j->unknown--;
        return;
    }
    fputc(j->is_array[j->depth] ? ']' : '}', j->out);
    j->depth--;
}

static void value(void *state, const char *name, const char *text)
{
    json *j = state;
    if (j->unknown == 0) {
        put_name(j, name);
        fputs(text != NULL ? text : "null", j->out);
    }
}

static void text(void *state, const char *name, const char *bytes)
{
    json *j = state;
    if (j->unknown > 0) {
        return;
    }
    put_name(j, name);
    if (bytes == NULL) {
        fputs("null", j->out);
    } else {
        put_string(j->out, bytes);
    }
}

static member_sink begin_line(json *j, FILE *out)
{
    member_sink sink = {j, begin, end, value, text};
    memset(j, 0, sizeof *j);
    j->out = out;
    fputc('{', out);
    return sink;
}

void json_measurement(FILE *out, const measurement *m)
{
    json j;
    const member_sink sink = begin_line(&j, out);
    members_of_measurement(&sink, m);
    fputs("}\n", out);
}

void json_track_line(FILE *out, const track_line *line)
{
    json j;
    const member_sink sink = begin_line(&j, out);
    members_of_track_line(&sink, line);
    fputs("}\n", out);
}
