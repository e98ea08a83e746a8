/* SPDX-License-Identifier: Apache-2.0 */
/* The command line: which command, on which files, with what settings. */
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include "drogue/config.h"
#include "drogue/types.h"
#include "raw.h"

typedef enum command {
    COMMAND_MEASURE,
    COMMAND_TRACK,
    COMMAND_EDGES,
    COMMAND_HELP,
    COMMAND_HELP_CONFIG,
    COMMAND_VERSION
} command;

typedef enum output_format { FORMAT_TABLE, FORMAT_JSON, FORMAT_CSV } output_format;

typedef struct options {
    command command;
    char **files; /* operands after the command */
    int file_count;
    char **expanded; /* on the heap: these with folders replaced by their images */
    int expanded_count;
    drogue_camera camera;
    const char *camera_text; /* of --camera */
    const char *camera_file; /* NULL: given as numbers */
    int32_t camera_width_px; /* of the images that the camera file is for; 0: not said */
    int32_t camera_height_px;
    drogue_model model; /* rim radius 1 unless given: positions come out in rim radii */
    int model_given;
    drogue_region region;
    int region_given;
    output_format format;
    drogue_q16 min_reliability_q16;
    drogue_config config;
    raw_format raw;
    const char *overlay; /* NULL: none */
    uint64_t rate;       /* billionths of a frame a second */
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
