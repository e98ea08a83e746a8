/* SPDX-License-Identifier: Apache-2.0 */
/* What was measured as a table that a person reads. */
#ifndef CLI_TABLE_H
#define CLI_TABLE_H

#include "drogue/drogue.h"

/* Print the table on standard output.
 *
 *  unit  of positions: "m", or what the rim radius stands for
 */
void table_print(const char *path, const drogue_result *result, const char *unit);

#endif
