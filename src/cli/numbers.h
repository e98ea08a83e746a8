/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers of the command line. Each function returns EXIT_MEASURED, or EXIT_BAD after a complaint about 'name'. */
#ifndef CLI_NUMBERS_H
#define CLI_NUMBERS_H

#include <stddef.h>

#include "decimal.h"

/* Complain of a text that is not a number, or not in 'range'. */
int numbers_refuse(const char *name, const char *text, size_t length, decimal_status status, const char *range);

/* Length of the number at the start of a list: up to the comma or the end. */
size_t numbers_item(const char *list);

/* Numbers in a list. */
int numbers_count(const char *list);
int numbers_check_count(const char *name, const char *list, int count);

/* Read a list of exactly 'count' Q16 numbers. */
int numbers_q16(drogue_q16 *out, int count, const char *name, const char *list);

/* A number in [0, 10^9) as whole billionths, the rest cut off. */
int numbers_billionths(uint64_t *out, const char *name, const char *text);

/* A whole number in [least, most]. */
int numbers_whole(int32_t *out, const char *name, const char *text, size_t length, int32_t least, int32_t most);

#endif
