/* SPDX-License-Identifier: Apache-2.0 */
/* What each status means, and what would help: one sentence. docs/program.md lists them. */
#ifndef CLI_EXPLAIN_H
#define CLI_EXPLAIN_H

#include "drogue/status.h"

#define EXPLAIN_UNRELIABLE "its reliability is below --min-reliability"

/* The sentence without a full stop; never NULL. */
const char *explain_status(drogue_status status);

#endif
