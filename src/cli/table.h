/* SPDX-License-Identifier: Apache-2.0 */
/* Members as a table that a person reads: status and image first, then a line a member, '-' where it is unknown. */
#ifndef CLI_TABLE_H
#define CLI_TABLE_H

#include "members.h"

/* Print the table on standard output. */
void table_print(const measurement *m);

#endif
