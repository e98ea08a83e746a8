/* SPDX-License-Identifier: Apache-2.0 */
/* Members as JSON (RFC 8259), one object a line; the keys are always all there, null where unknown. */
#ifndef CLI_JSON_H
#define CLI_JSON_H

#include <stdio.h>

#include "members.h"

void json_measurement(FILE *out, const measurement *m);
void json_track_line(FILE *out, const track_line *line);

#endif
