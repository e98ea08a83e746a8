/* SPDX-License-Identifier: Apache-2.0 */
/* What was measured as a list of named members, each in one place; JSON, table and CSV are sinks for them, so that all
 * three hold the same. docs/program.md says what each means. */
#ifndef CLI_MEMBERS_H
#define CLI_MEMBERS_H

#include "drogue/track.h"

/* Where members go. A group that is not known still brings its members, without text. */
typedef struct member_sink {
    void *state;
    void (*begin)(void *state, const char *name, int is_array, int known);
    void (*end)(void *state);
    void (*value)(void *state, const char *name, const char *text); /* number, true or false; NULL: not known */
    void (*text)(void *state, const char *name, const char *text);  /* any bytes; NULL: not known */
} member_sink;

/* One measurement, and what the program knows about it beside the library's result. */
typedef struct measurement {
    const char *path;
    const drogue_result *result;
    const drogue_model *model;
    const char *length_unit;
    int searched;   /* 1: the whole image, or the region asked for, was searched for it; -1: not known */
    int unreliable; /* 1: measured, but below --min-reliability */
} measurement;

/* One frame of a track. */
typedef struct track_line {
    measurement raw;
    long frame; /* from 1 on */
    uint64_t time_us;
    const drogue_track *track;
    const drogue_region *region;           /* asked for, before it was clipped */
    const drogue_track_estimate *estimate; /* not used while lost */
} track_line;

/* Status in words: the library's, or "unreliable". */
const char *measurement_status(const measurement *m);

/* Is there a pose to show? */
int measurement_known(const measurement *m);

void members_of_measurement(const member_sink *sink, const measurement *m);
void members_of_track_line(const member_sink *sink, const track_line *line);

#endif
