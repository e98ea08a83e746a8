/* SPDX-License-Identifier: Apache-2.0 */
/* The golden vectors of a folder, read and checked: manifest, VERSION, words and images. Host only. */
#ifndef DROGUE_TESTS_VECTORS_H
#define DROGUE_TESTS_VECTORS_H

#include "conformance.h"

/* A case, and the names of the files of its bit-exact tier. */
typedef struct vectors_case {
    conf_case run;
    const char *exact_file[CONF_MAX_OUTPUTS];
} vectors_case;

typedef struct vectors {
    const char *version;
    vectors_case *cases;
    size_t count;
} vectors;

/* Read the vectors of a folder. Whatever is not as the manifest and its format say is an error: one line on stderr
 * that names case and field or file. Returns 0 then. Memory is given back by vectors_free(). */
int vectors_read(vectors *out, const char *directory);
void vectors_free(void);

/* --- files, for vectors_read() and for the comparison of other people's results --- */

#define VECTORS_TEXT 512

/* A whole file, a 0 byte behind it; NULL and a reason when it cannot be read. */
char *vectors_file(size_t *bytes, char reason[VECTORS_TEXT], const char *path);

/* Put word i of so many bits. */
void vectors_store(void *data, size_t i, uint64_t word, int bits);

/* Words of a .hex file: 'count' words of array->bits; 0 and a reason when the text is not that. */
int vectors_hex(conf_array *array, char reason[VECTORS_TEXT], const char *text, size_t bytes);

/* The same from what a simulation wrote: any text that $readmemh takes, every word given. */
int vectors_readmemh(conf_array *array, char reason[VECTORS_TEXT], const char *text, size_t bytes);

/* Grey levels of a PNG of array->width_px x height_px; 0 and a reason when it is not that. */
int vectors_png(conf_array *array, char reason[VECTORS_TEXT], const void *file, size_t bytes);

/* The words or grey levels of a file whose SHA-256 must be the given one; 0 and a reason. */
int vectors_data(conf_array *array, char reason[VECTORS_TEXT], const char *path, const char *digest);

/* Memory that vectors_free() gives back; ends the program when there is none. */
void *vectors_alloc(size_t bytes);

#endif
