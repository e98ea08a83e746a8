/* SPDX-License-Identifier: Apache-2.0 */
/* --set NAME=VALUE and --help-config: every threshold of drogue_config by name, from one table. */
#ifndef CLI_SETTINGS_H
#define CLI_SETTINGS_H

#include "drogue/config.h"

/* Change one threshold by "NAME=VALUE".
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint: no such name, no number, outside its range
 */
int settings_set(drogue_config *config, const char *assignment);

/* Print the table: name, default, range, unit and effect. */
void settings_print(void);

#endif
