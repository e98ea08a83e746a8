/* SPDX-License-Identifier: Apache-2.0 */
/* A YAML or XML file as a list of keys with values: nested keys joined by dots, places in a sequence as numbers, such
 * as "camera_matrix.data.4". The words of an XML element are a sequence. A sequence of YAML without places has the value
 * KEYS_EMPTY. */
#ifndef CLI_KEYS_H
#define CLI_KEYS_H

#include <stddef.h>
#include <stdio.h>

typedef struct keys {
    char **names; /* name and value in one block, a 0 byte between them */
    size_t count;
} keys;

#define KEYS_EMPTY "[]"

/* Read a file; by its first byte, < is XML.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int keys_read(keys *out, const char *path);
void keys_free(keys *k);

/* The value of a key, the first one; NULL when it is not there. */
const char *keys_value(const keys *k, const char *name);

/* Which key, of one and those nested in it, is there again with another value; NULL when none is. */
const char *keys_contradiction(const keys *k, const char *name);

/* Is there a key that begins so? */
int keys_has(const keys *k, const char *beginning);

/* For the readers: bounds, and what is said beyond one. */
enum { KEYS_NAME = 256, KEYS_DEPTH = 8, KEYS_MOST = 20000 };
#define KEYS_TOO_MUCH "is no camera file: nested too deep, or too large"

/* For the readers: add a key. Returns 0 when there are KEYS_MOST, or no memory. */
int keys_add(keys *k, const char *name, const char *value, size_t length);

/* The two forms; each returns NULL, or what is wrong. */
const char *keys_read_yaml(keys *k, FILE *in);
const char *keys_read_xml(keys *k, FILE *in);

#endif
