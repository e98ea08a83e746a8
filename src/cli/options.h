/* SPDX-License-Identifier: Apache-2.0 */
/* The command line: which command, on which files, with what settings. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "drogue/types.h"

typedef enum command { COMMAND_MEASURE, COMMAND_TRACK, COMMAND_EDGES, COMMAND_HELP, COMMAND_VERSION } command;

typedef struct options {
    command command;
    char **files; /* operands after the command */
    int file_count;
    drogue_camera camera;
    drogue_model model; /* rim radius 1 unless given: positions come out in rim radii */
    int model_given;
    drogue_region region;
    int region_given;
    int json;
    const char *overlay; /* NULL: none */
    uint32_t frame_us;   /* from one frame to the next */
    uint32_t max_missed; /* frames in a row that a track survives */
    int max_missed_given;
    int32_t canny_low;
    int32_t canny_high;
    int smooth;
} options;

/* Read the command line; argv is permuted so that the files come last.
 *
 *  return  EXIT_MEASURED, or EXIT_BAD after a complaint
 */
int options_parse(options *out, int argc, char **argv);

/* What positions are counted in: "m", or "rim radii" when no radius was given. */
const char *options_length_unit(const options *o);

#endif
