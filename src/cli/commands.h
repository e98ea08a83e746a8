/* SPDX-License-Identifier: Apache-2.0 */
/* The commands; each returns the program's exit code. */
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H

#include "options.h"

int command_measure(const options *o);
int command_track(const options *o);
int command_edges(const options *o);

#endif
