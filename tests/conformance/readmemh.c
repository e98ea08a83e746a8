/* SPDX-License-Identifier: Apache-2.0 */
/* Words as Verilog's $readmemh takes them (IEEE 1800-2017, 21.4): numbers between white space, either case, underscores,
 * both kinds of comment, @ADDRESS; so that what $writememh wrote is a result as it stands. */
#include <stdio.h>
#include <string.h>

#include "vectors.h"

typedef struct reader {
    conf_array *array;
    void *data;
    uint8_t *seen; /* a word each: 1 once it is there */
    size_t found;
    const char *at;
    const char *end;
    unsigned long line;
    uint64_t address;
} reader;

static int is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* To the end of a comment: behind the line's end, or behind the star and slash. */
static int skip_comment(reader *r)
{
    const int block = r->at[1] == '*';
    for (r->at += 2; r->at < r->end; r->at++) {
        r->line += *r->at == '\n';
        if (block ? r->at[0] == '*' && r->at[1] == '/' : *r->at == '\n') {
            r->at += block ? 2 : 1;
            return 1;
        }
    }
    return !block;
}

/* To the next token: 0 when a comment has no end. A 0 byte stands behind the text. */
static int skip(reader *r)
{
    while (r->at < r->end) {
        if (is_space(*r->at)) {
            r->line += *r->at == '\n';
            r->at++;
        } else if (r->at[0] == '/' && (r->at[1] == '/' || r->at[1] == '*')) {
            if (!skip_comment(r)) {
                return 0;
            }
        } else {
            return 1;
        }
    }
    return 1;
}

/* The digits at the reader's place: 0 when there is something else, or more than fits into so many bits. */
static int number(uint64_t *out, reader *r, int bits)
{
    const char *begin = r->at;
    *out = 0;
    while (r->at < r->end && !is_space(*r->at) && *r->at != '/') {
        const int digit = hex_digit(*r->at);
        if (digit >= 0) {
            if (*out >> (bits - 4) != 0) {
                return 0;
            }
            *out = *out << 4 | (uint64_t)digit;
        } else if (*r->at != '_' || r->at == begin) {
            return 0;
        }
        r->at++;
    }
    return r->at > begin;
}

static void put(reader *r, uint64_t word)
{
    const size_t i = (size_t)r->address;
    vectors_store(r->data, i, word, r->array->bits);
    r->found += r->seen[i] == 0;
    r->seen[i] = 1;
    r->address++;
}

static int refuse(char reason[VECTORS_TEXT], const reader *r, const char *token, const char *why)
{
    const int length = (int)strcspn(token, " \t\r\n\f\v");
    snprintf(reason, VECTORS_TEXT, "line %lu: '%.*s' %s", r->line, length < 24 ? length : 24, token, why);
    return 0;
}

static int read_token(reader *r, char reason[VECTORS_TEXT])
{
    const char *token = r->at;
    const int is_address = *token == '@';
    const int bits = is_address ? 64 : r->array->bits;
    uint64_t value;
    r->at += is_address;
    if (!number(&value, r, bits)) {
        return refuse(reason, r, token, "is no hexadecimal number of the word's width, all bits known");
    }
    if (is_address) {
        r->address = value;
    } else if (r->address >= r->array->count) {
        snprintf(reason, VECTORS_TEXT, "line %lu: more than the %lu words expected", r->line,
                 (unsigned long)r->array->count);
        return 0;
    } else {
        put(r, value);
    }
    return 1;
}

int vectors_readmemh(conf_array *array, char reason[VECTORS_TEXT], const char *text, size_t bytes)
{
    reader r = {array,
                vectors_alloc(array->count * (size_t)(array->bits / 8)),
                vectors_alloc(array->count),
                0,
                text,
                text + bytes,
                1,
                0};
    array->data = r.data;
    for (;;) {
        if (!skip(&r)) {
            snprintf(reason, VECTORS_TEXT, "a comment has no end");
            return 0;
        }
        if (r.at >= r.end) {
            break;
        }
        if (!read_token(&r, reason)) {
            return 0;
        }
    }
    if (r.found != array->count) {
        snprintf(reason, VECTORS_TEXT, "%lu words expected, %lu found", (unsigned long)array->count,
                 (unsigned long)r.found);
        return 0;
    }
    return 1;
}
