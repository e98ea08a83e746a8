/* SPDX-License-Identifier: Apache-2.0 */
/* A strict JSON reader for tests: every line of standard input must be one value (RFC 8259) in valid UTF-8.
 *
 * usage: json_check [PATH...]   e.g. json_check raw.ellipse.xc position_m.2
 * Prints the text of the value at each path, a line each; exit code 1 when a line is no JSON or a path is missing. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    const char *at;
    const char *found; /* value at the path sought */
    size_t found_length;
    int depth;
} reader;

static int read_value(reader *r, const char *path);

static void skip_space(reader *r)
{
    while (*r->at == ' ' || *r->at == '\t' || *r->at == '\r') {
        r->at++;
    }
}

static int is_digit(char c) { return c >= '0' && c <= '9'; }

static int is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

/* One character of several bytes: shortest form, no surrogate, at most U+10FFFF. */
static int read_utf8(reader *r)
{
    const unsigned char *s = (const unsigned char *)r->at;
    unsigned long code = s[0] & (s[0] < 0xE0 ? 0x1Fu : s[0] < 0xF0 ? 0x0Fu : 0x07u);
    int more = s[0] < 0xC0 ? 0 : s[0] < 0xE0 ? 1 : s[0] < 0xF0 ? 2 : s[0] < 0xF8 ? 3 : 0;
    static const unsigned long least[4] = {0, 0x80, 0x800, 0x10000};
    int i;
    for (i = 1; i <= more; i++) {
        if ((s[i] & 0xC0u) != 0x80u) {
            return 0;
        }
        code = code << 6 | (s[i] & 0x3Fu);
    }
    if (more == 0 || code < least[more] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) {
        return 0;
    }
    r->at += more + 1;
    return 1;
}

static int read_escape(reader *r)
{
    r->at++;
    if (*r->at == 'u') {
        int i;
        for (i = 1; i <= 4; i++) {
            if (!is_hex(r->at[i])) {
                return 0;
            }
        }
        r->at += 5;
        return 1;
    }
    if (*r->at == '\0' || strchr("\"\\/bfnrt", *r->at) == NULL) {
        return 0;
    }
    r->at++;
    return 1;
}

static int read_string(reader *r)
{
    if (*r->at++ != '"') {
        return 0;
    }
    while (*r->at != '"') {
        unsigned char c = (unsigned char)*r->at;
        if (c < 0x20) {
            return 0;
        }
        if (c == '\\') {
            if (!read_escape(r)) {
                return 0;
            }
        } else if (c < 0x80) {
            r->at++;
        } else if (!read_utf8(r)) {
            return 0;
        }
    }
    r->at++;
    return 1;
}

static int read_digits(reader *r)
{
    const char *start = r->at;
    while (is_digit(*r->at)) {
        r->at++;
    }
    return r->at > start;
}

static int read_number(reader *r)
{
    r->at += *r->at == '-';
    if (*r->at == '0' && is_digit(r->at[1])) {
        return 0;
    }
    if (!read_digits(r)) {
        return 0;
    }
    if (*r->at == '.') {
        r->at++;
        if (!read_digits(r)) {
            return 0;
        }
    }
    if (*r->at == 'e' || *r->at == 'E') {
        r->at++;
        r->at += *r->at == '-' || *r->at == '+';
        return read_digits(r);
    }
    return 1;
}

/* What is left of the path inside the member 'key', NULL when the path does not lead there. */
static const char *inside(const char *path, const char *key, size_t length)
{
    if (path == NULL || strncmp(path, key, length) != 0) {
        return NULL;
    }
    return path[length] == '.' ? path + length + 1 : path[length] == '\0' ? path + length : NULL;
}

/* Members of an object or elements of an array, which are keyed by their index. */
static int read_container(reader *r, const char *path, int object)
{
    const char end = object ? '}' : ']';
    int index;
    r->at++;
    skip_space(r);
    if (*r->at == end) {
        r->at++;
        return 1;
    }
    for (index = 0;; index++) {
        char number[16];
        const char *key = number;
        size_t length = (size_t)snprintf(number, sizeof number, "%d", index);
        if (object) {
            skip_space(r);
            key = r->at + 1;
            if (!read_string(r)) {
                return 0;
            }
            length = (size_t)(r->at - 1 - key);
            skip_space(r);
            if (*r->at++ != ':') {
                return 0;
            }
        }
        if (!read_value(r, inside(path, key, length))) {
            return 0;
        }
        skip_space(r);
        if (*r->at == end) {
            r->at++;
            return 1;
        }
        if (*r->at++ != ',') {
            return 0;
        }
    }
}

static int read_word(reader *r, const char *word)
{
    size_t length = strlen(word);
    if (strncmp(r->at, word, length) != 0) {
        return 0;
    }
    r->at += length;
    return 1;
}

static int read_value(reader *r, const char *path)
{
    const char *start;
    int good;
    if (++r->depth > 64) {
        return 0;
    }
    skip_space(r);
    start = r->at;
    switch (*r->at) {
    case '{':
    case '[': good = read_container(r, path, *r->at == '{'); break;
    case '"': good = read_string(r); break;
    case 't': good = read_word(r, "true"); break;
    case 'f': good = read_word(r, "false"); break;
    case 'n': good = read_word(r, "null"); break;
    default: good = read_number(r); break;
    }
    if (good && path != NULL && *path == '\0') {
        r->found = start;
        r->found_length = (size_t)(r->at - start);
    }
    r->depth--;
    return good;
}

static int check_line(const char *line, const char *path)
{
    reader r = {NULL, NULL, 0, 0};
    r.at = line;
    if (!read_value(&r, path)) {
        fprintf(stderr, "json_check: no JSON at byte %ld: %s\n", (long)(r.at - line), line);
        return 0;
    }
    skip_space(&r);
    if (*r.at != '\0') {
        fprintf(stderr, "json_check: more than one value: %s\n", line);
        return 0;
    }
    if (path != NULL && r.found == NULL) {
        fprintf(stderr, "json_check: no %s in: %s\n", path, line);
        return 0;
    }
    if (path != NULL) {
        printf("%.*s\n", (int)r.found_length, r.found);
    }
    return 1;
}

int main(int argc, char **argv)
{
    static char line[1 << 16];
    int lines = 0;
    int i;
    while (fgets(line, sizeof line, stdin) != NULL) {
        size_t length = strlen(line);
        if (length == 0 || line[length - 1] != '\n') {
            fprintf(stderr, "json_check: a line without end, or with a NUL in it\n");
            return EXIT_FAILURE;
        }
        line[length - 1] = '\0';
        lines++;
        if (!check_line(line, NULL)) {
            return EXIT_FAILURE;
        }
        for (i = 1; i < argc; i++) {
            if (!check_line(line, argv[i])) {
                return EXIT_FAILURE;
            }
        }
    }
    if (lines == 0) {
        fprintf(stderr, "json_check: no line\n");
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
