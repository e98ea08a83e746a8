/* SPDX-License-Identifier: Apache-2.0 */
/* Names of the files that the program writes, and the promise that none of them is one that it reads. */
#ifndef CLI_OUTPUTS_H
#define CLI_OUTPUTS_H

#include "options.h"

/* OUT-0001.png for OUT.png and number 1.
 *
 *  return  on the heap, or NULL after a complaint
 */
char *output_numbered(const char *out, int number);

/* Is every file that a command is about to write another one than each that it reads?  The same file under another
 * name, by a link or another path, is the same.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int outputs_check(const options *o);

#endif
