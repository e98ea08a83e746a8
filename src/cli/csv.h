/* SPDX-License-Identifier: Apache-2.0 */
/* Members as CSV, quoted as in RFC 4180: a line of names, then a line a frame; names of groups and places joined by
 * dots, as in raw.position_m.0; nothing where a member is unknown. */
#ifndef CLI_CSV_H
#define CLI_CSV_H

#include <stdio.h>

#include "members.h"

void csv_measurement(FILE *out, const measurement *m);

/* The line of names comes before frame 1. */
void csv_track_line(FILE *out, const track_line *line);

#endif
