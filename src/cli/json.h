/* SPDX-License-Identifier: Apache-2.0 */
/* What was measured as JSON (RFC 8259), one object a line; the keys are always all there, null where unknown. */
#ifndef CLI_JSON_H
#define CLI_JSON_H

#include <stdio.h>

#include "drogue/track.h"

/* Text as a JSON string; bytes that are not UTF-8 become U+FFFD. */
void json_string(FILE *out, const char *text);

/* One measurement as an object, without a line end. */
void json_measurement(FILE *out, const char *path, const drogue_result *result);

/* One frame of a track as a line.
 *
 *  region    asked for in this frame, before it was clipped
 *  estimate  of the filter, not used while lost
 */
void json_track_line(FILE *out, const char *path, const drogue_result *result, const drogue_track *track,
                     const drogue_region *region, const drogue_track_estimate *estimate);

#endif
