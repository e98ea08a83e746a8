/* SPDX-License-Identifier: Apache-2.0 */
/* Somebody else's outputs against the bit-exact tier. */
#ifndef DROGUE_TESTS_JUDGE_H
#define DROGUE_TESTS_JUDGE_H

#include "vectors.h"

/* Compare the result files in a folder with the bit-exact tier of a stage or of one case. A result file is named
 * like the expected one, with its folder or without; the result for an image may be words instead, FILE.hex in
 * place of FILE.png; one without words may be missing. Prints a line for each file that differs or is missing, and a
 * summary.
 *
 *  what    name of a stage, or id of a case
 *  own     the vectors' folder, which is refused
 *  return  0 when all files are there and equal, 1 when not, 2 when nothing goes by that name
 */
int judge(const vectors *v, const char *what, const char *folder, const char *own);

#endif
