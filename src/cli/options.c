/* SPDX-License-Identifier: Apache-2.0 */
/* The command line by getopt_long: options may stand before or after the command and its files. */
#include "options.h"

#include <errno.h>
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "camera_file.h"
#include "cli.h"
#include "numbers.h"
#include "ranges.h"
#include "settings.h"

/* What getopt_long answers; below every printable character. */
enum {
    OPTION_CAMERA = 1,
    OPTION_DISTORTION,
    OPTION_ROI,
    OPTION_DROGUE,
    OPTION_JSON,
    OPTION_CSV,
    OPTION_MIN_RELIABILITY,
    OPTION_SET,
    OPTION_RAW,
    OPTION_OVERLAY,
    OPTION_FPS,
    OPTION_MAX_MISSED,
    OPTION_LOW,
    OPTION_HIGH,
    OPTION_SMOOTH,
    OPTION_HELP,
    OPTION_HELP_CONFIG,
    OPTION_VERSION,
    OPTION_END
};

static const struct option LONG_OPTIONS[] = {
    {"camera", required_argument, NULL, OPTION_CAMERA},
    {"distortion", required_argument, NULL, OPTION_DISTORTION},
    {"roi", required_argument, NULL, OPTION_ROI},
    {"drogue", required_argument, NULL, OPTION_DROGUE},
    {"json", no_argument, NULL, OPTION_JSON},
    {"csv", no_argument, NULL, OPTION_CSV},
    {"min-reliability", required_argument, NULL, OPTION_MIN_RELIABILITY},
    {"set", required_argument, NULL, OPTION_SET},
    {"raw", required_argument, NULL, OPTION_RAW},
    {"overlay", required_argument, NULL, OPTION_OVERLAY},
    {"fps", required_argument, NULL, OPTION_FPS},
    {"max-missed", required_argument, NULL, OPTION_MAX_MISSED},
    {"low", required_argument, NULL, OPTION_LOW},
    {"high", required_argument, NULL, OPTION_HIGH},
    {"smooth", no_argument, NULL, OPTION_SMOOTH},
    {"help", no_argument, NULL, OPTION_HELP},
    {"help-config", no_argument, NULL, OPTION_HELP_CONFIG},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};
static const char SHORT_OPTIONS[] = ":hV";

#define BIT(option) (1u << (option))
#define POSE_OPTIONS                                                                                         \
    (BIT(OPTION_CAMERA) | BIT(OPTION_DISTORTION) | BIT(OPTION_ROI) | BIT(OPTION_DROGUE) | BIT(OPTION_JSON) | \
     BIT(OPTION_CSV) | BIT(OPTION_SET) | BIT(OPTION_OVERLAY) | BIT(OPTION_MIN_RELIABILITY))

typedef struct command_use {
    const char *name;
    command command;
    int least_files;
    int most_files; /* 0: any number */
    unsigned allowed;
    unsigned needed;
    const char *usage;
} command_use;

static const command_use COMMANDS[] = {
    {"measure", COMMAND_MEASURE, 1, 1, POSE_OPTIONS, BIT(OPTION_CAMERA), "one image"},
    {"track", COMMAND_TRACK, 1, 0, POSE_OPTIONS | BIT(OPTION_FPS) | BIT(OPTION_MAX_MISSED) | BIT(OPTION_RAW),
     BIT(OPTION_CAMERA), "at least one image"},
    {"edges", COMMAND_EDGES, 2, 2, BIT(OPTION_LOW) | BIT(OPTION_HIGH) | BIT(OPTION_SMOOTH),
     BIT(OPTION_LOW) | BIT(OPTION_HIGH), "an image and a file to write"},
};

enum { MAX_NUMBERS = 5 };

#define BILLION UINT64_C(1000000000)
#define MAX_COORDINATE (1 << 20) /* px, of a region: far beyond any image, far from any overflow */

static int parse_camera(drogue_camera *camera, const char *list)
{
    drogue_q16 v[MAX_NUMBERS];
    if (numbers_count(list) == 8) {
        return complain("--camera", "4 numbers are wanted, not 8: decimals stand behind a point, not a comma");
    }
    if (numbers_check_count("--camera", list, 4) || numbers_q16(v, 4, "--camera", list)) {
        return EXIT_BAD;
    }
    camera->fx_px_q16 = v[0];
    camera->fy_px_q16 = v[1];
    camera->cx_px_q16 = v[2];
    camera->cy_px_q16 = v[3];
    return EXIT_MEASURED;
}

/* A file when there is one of that name, or when it is no list. */
static int take_camera(options *out, int distortion_given)
{
    const char *text = out->camera_text;
    if (text == NULL) {
        return EXIT_MEASURED;
    }
    if (access(text, F_OK) != 0) {
        return strchr(text, ',') != NULL
                   ? parse_camera(&out->camera, text)
                   : complain("--camera", "'%s' is neither FX,FY,CX,CY nor a file: %s", text, strerror(errno));
    }
    if (distortion_given) {
        return complain("--distortion", "is in the camera file already");
    }
    out->camera_file = text;
    return camera_file_read(&out->camera, &out->camera_width_px, &out->camera_height_px, text);
}

/* The numbers of a camera, from wherever they are. */
static int check_camera(const options *o)
{
    const char *focal = o->camera_text != NULL ? ranges_focal(&o->camera) : NULL;
    const char *lens = ranges_lens(&o->camera);
    if (focal != NULL) {
        return complain(o->camera_file != NULL ? o->camera_file : "--camera", "%s", focal);
    }
    return lens == NULL ? EXIT_MEASURED
                        : complain(o->camera_file != NULL ? o->camera_file : "--distortion", "%s", lens);
}

static int parse_distortion(drogue_camera *camera, const char *list)
{
    drogue_q16 v[MAX_NUMBERS];
    if (numbers_check_count("--distortion", list, 5) || numbers_q16(v, 5, "--distortion", list)) {
        return EXIT_BAD;
    }
    camera->k1_q16 = v[0];
    camera->k2_q16 = v[1];
    camera->p1_q16 = v[2];
    camera->p2_q16 = v[3];
    camera->k3_q16 = v[4];
    return EXIT_MEASURED;
}

static int parse_model(drogue_model *model, const char *list)
{
    drogue_q16 v[MAX_NUMBERS] = {0};
    const int count = numbers_count(list);
    const char *wrong;
    if (count != 1 && count != 3) {
        return complain("--drogue", "1 or 3 numbers separated by commas are wanted, not %d", count);
    }
    if (numbers_q16(v, count, "--drogue", list)) {
        return EXIT_BAD;
    }
    if (count == 3 && v[1] <= 0) {
        return complain("--drogue", "INNER must be above 0 (at least 1/65536)");
    }
    model->rim_radius_m_q16 = v[0];
    model->inner_radius_m_q16 = v[1];
    model->inner_depth_m_q16 = v[2];
    wrong = ranges_model(model);
    return wrong == NULL ? EXIT_MEASURED : complain("--drogue", "%s", wrong);
}

static int parse_region(drogue_region *region, const char *list)
{
    int32_t v[4];
    const char *wrong;
    int i;
    if (numbers_check_count("--roi", list, 4)) {
        return EXIT_BAD;
    }
    for (i = 0; i < 4; i++) {
        size_t length = numbers_item(list);
        if (numbers_whole(&v[i], "--roi", list, length, -MAX_COORDINATE, MAX_COORDINATE)) {
            return EXIT_BAD;
        }
        list += length + 1;
    }
    region->x_px = v[0];
    region->y_px = v[1];
    region->width_px = v[2];
    region->height_px = v[3];
    wrong = ranges_region(region);
    return wrong == NULL ? EXIT_MEASURED : complain("--roi", "%s", wrong);
}

static int parse_rate(uint64_t *rate, const char *text)
{
    if (numbers_billionths(rate, "--fps", text)) {
        return EXIT_BAD;
    }
    /* a microsecond a frame at least, and no more of them than the library counts */
    return *rate >= BILLION / 2000 && *rate <= 1000000 * BILLION
               ? EXIT_MEASURED
               : complain("--fps", "'%s' is not a rate from 0.0005 to 1000000 frames a second", text);
}

#define MOST_MISSED 1000000

static int parse_max_missed(uint32_t *frames, const char *text)
{
    int32_t value;
    if (numbers_whole(&value, "--max-missed", text, strlen(text), 0, MOST_MISSED)) {
        return EXIT_BAD;
    }
    *frames = (uint32_t)value;
    return EXIT_MEASURED;
}

/* A share, in [0, 1]. */
static int parse_share(drogue_q16 *out, const char *name, const char *text)
{
    if (numbers_check_count(name, text, 1) || numbers_q16(out, 1, name, text)) {
        return EXIT_BAD;
    }
    return *out >= 0 && *out <= DROGUE_Q16_ONE ? EXIT_MEASURED : complain(name, "'%s' is outside [0, 1]", text);
}

static int choose_format(options *out, output_format format)
{
    if (out->format != FORMAT_TABLE && out->format != format) {
        return complain("--csv", "excludes --json");
    }
    out->format = format;
    return EXIT_MEASURED;
}

static int parse_option(options *out, uint64_t thresholds[2], int option, const char *value)
{
    switch (option) {
    case OPTION_CAMERA: out->camera_text = value; return EXIT_MEASURED;
    case OPTION_DISTORTION: return parse_distortion(&out->camera, value);
    case OPTION_ROI: out->region_given = 1; return parse_region(&out->region, value);
    case OPTION_DROGUE: out->model_given = 1; return parse_model(&out->model, value);
    case OPTION_JSON: return choose_format(out, FORMAT_JSON);
    case OPTION_CSV: return choose_format(out, FORMAT_CSV);
    case OPTION_MIN_RELIABILITY: return parse_share(&out->min_reliability_q16, "--min-reliability", value);
    case OPTION_SET: return settings_set(&out->config, value);
    case OPTION_RAW: return raw_parse(&out->raw, value);
    case OPTION_OVERLAY:
        out->overlay = value;
        return *value != '\0' ? EXIT_MEASURED : complain("--overlay", "has no name");
    case OPTION_FPS: return parse_rate(&out->rate, value);
    case OPTION_MAX_MISSED: out->max_missed_given = 1; return parse_max_missed(&out->max_missed, value);
    case OPTION_LOW: return numbers_billionths(&thresholds[0], "--low", value);
    case OPTION_HIGH: return numbers_billionths(&thresholds[1], "--high", value);
    case OPTION_SMOOTH: out->smooth = 1; return EXIT_MEASURED;
    default: return EXIT_MEASURED;
    }
}

static const char *option_name(int option) { return LONG_OPTIONS[option - 1].name; }

/* The command named by the first operand, with the options and files that it takes. */
static int check_use(options *out, unsigned given, char **operands, int count)
{
    const command_use *use = NULL;
    size_t i;
    int option;
    if (count == 0) {
        return complain("no command", "measure, track or edges; see drogue --help");
    }
    for (i = 0; i < sizeof COMMANDS / sizeof COMMANDS[0]; i++) {
        if (strcmp(operands[0], COMMANDS[i].name) == 0) {
            use = &COMMANDS[i];
        }
    }
    if (use == NULL) {
        return complain(operands[0], "no such command: measure, track or edges; see drogue --help");
    }
    for (option = OPTION_CAMERA; option < OPTION_END; option++) {
        if ((given & BIT(option) & ~use->allowed) != 0) {
            return complain(use->name, "takes no option --%s", option_name(option));
        }
        if ((~given & BIT(option) & use->needed) != 0) {
            return complain(use->name, "needs the option --%s", option_name(option));
        }
    }
    out->command = use->command;
    out->files = operands + 1;
    out->file_count = count - 1;
    if (out->file_count < use->least_files || (use->most_files != 0 && out->file_count > use->most_files)) {
        return complain(use->name, "takes %s, not %d files", use->usage, out->file_count);
    }
    return EXIT_MEASURED;
}

/* What getopt_long does not take: it said ':' of an option without its value, '?' of any other. */
static int complain_of(int option, char **argv)
{
    const char text[] = {'-', (char)optopt, '\0'};
    if (option == ':') {
        return complain(argv[optind - 1], "needs a value");
    }
    if (optopt > 0 && optopt < OPTION_END) {
        return complain(argv[optind - 1], "takes no value");
    }
    return optopt != 0 ? complain(text, "unknown option; see drogue --help")
                       : complain(argv[optind - 1], "unknown or ambiguous option; see drogue --help");
}

/* What no option alone can show. */
static int check_together(const options *o, const uint64_t thresholds[2])
{
    if (check_camera(o)) {
        return EXIT_BAD;
    }
    if (o->command == COMMAND_TRACK && o->overlay != NULL && strcmp(o->overlay, "-") == 0) {
        return complain("--overlay", "track writes numbered files, not to standard output");
    }
    if (!drogue_config_valid(&o->config)) {
        return complain("--set", "thresholds contradict each other: low above high, or least above most");
    }
    return thresholds[0] <= thresholds[1] ? EXIT_MEASURED : complain("--low", "must not exceed --high");
}

int options_parse(options *out, int argc, char **argv)
{
    uint64_t thresholds[2] = {0, 0};
    unsigned given = 0;
    int option;
    memset(out, 0, sizeof *out);
    out->model.rim_radius_m_q16 = DROGUE_Q16_ONE;
    out->rate = 30 * BILLION;
    opterr = 0;
    (void)unsetenv("POSIXLY_CORRECT"); /* by which options end at the first operand */
    drogue_config_default(&out->config);
    while ((option = getopt_long(argc, argv, SHORT_OPTIONS, LONG_OPTIONS, NULL)) != -1) {
        switch (option) {
        case 'h':
        case OPTION_HELP: out->command = COMMAND_HELP; return EXIT_MEASURED;
        case 'V':
        case OPTION_VERSION: out->command = COMMAND_VERSION; return EXIT_MEASURED;
        case OPTION_HELP_CONFIG: out->command = COMMAND_HELP_CONFIG; return EXIT_MEASURED;
        case ':':
        case '?': return complain_of(option, argv);
        default: break;
        }
        if (parse_option(out, thresholds, option, optarg)) {
            return EXIT_BAD;
        }
        given |= BIT(option);
    }
    if (check_use(out, given, argv + optind, argc - optind) ||
        take_camera(out, (given & BIT(OPTION_DISTORTION)) != 0) || check_together(out, thresholds)) {
        return EXIT_BAD;
    }
    out->canny_low = (int32_t)(thresholds[0] / BILLION);
    out->canny_high = (int32_t)(thresholds[1] / BILLION);
    return EXIT_MEASURED;
}

const char *options_length_unit(const options *o) { return o->model_given ? "m" : "rim radii"; }
