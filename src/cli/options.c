/* SPDX-License-Identifier: Apache-2.0 */
/* The command line by getopt_long: options may stand before or after the command and its files. */
#include "options.h"

#include <getopt.h>
#include <string.h>

#include "cli.h"
#include "decimal.h"
#include "drogue/drogue.h"

/* What getopt_long answers; below every printable character. */
enum {
    OPTION_CAMERA = 1,
    OPTION_DISTORTION,
    OPTION_ROI,
    OPTION_DROGUE,
    OPTION_JSON,
    OPTION_OVERLAY,
    OPTION_FPS,
    OPTION_MAX_MISSED,
    OPTION_LOW,
    OPTION_HIGH,
    OPTION_SMOOTH,
    OPTION_HELP,
    OPTION_VERSION,
    OPTION_END
};

static const struct option LONG_OPTIONS[] = {
    {"camera", required_argument, NULL, OPTION_CAMERA}, {"distortion", required_argument, NULL, OPTION_DISTORTION},
    {"roi", required_argument, NULL, OPTION_ROI},       {"drogue", required_argument, NULL, OPTION_DROGUE},
    {"json", no_argument, NULL, OPTION_JSON},           {"overlay", required_argument, NULL, OPTION_OVERLAY},
    {"fps", required_argument, NULL, OPTION_FPS},       {"max-missed", required_argument, NULL, OPTION_MAX_MISSED},
    {"low", required_argument, NULL, OPTION_LOW},       {"high", required_argument, NULL, OPTION_HIGH},
    {"smooth", no_argument, NULL, OPTION_SMOOTH},       {"help", no_argument, NULL, OPTION_HELP},
    {"version", no_argument, NULL, OPTION_VERSION},     {NULL, 0, NULL, 0},
};

#define BIT(option) (1u << (option))
#define POSE_OPTIONS                                                                                         \
    (BIT(OPTION_CAMERA) | BIT(OPTION_DISTORTION) | BIT(OPTION_ROI) | BIT(OPTION_DROGUE) | BIT(OPTION_JSON) | \
     BIT(OPTION_OVERLAY))

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
    {"track", COMMAND_TRACK, 1, 0, POSE_OPTIONS | BIT(OPTION_FPS) | BIT(OPTION_MAX_MISSED), BIT(OPTION_CAMERA),
     "at least one image"},
    {"edges", COMMAND_EDGES, 2, 2, BIT(OPTION_LOW) | BIT(OPTION_HIGH) | BIT(OPTION_SMOOTH),
     BIT(OPTION_LOW) | BIT(OPTION_HIGH), "an image and a file to write"},
};

enum { MAX_NUMBERS = 5 };

#define MAX_COORDINATE (1 << 20) /* px, of a region: far beyond any image, far from any overflow */

static int bad_number(const char *name, const char *text, size_t length, decimal_status status, const char *range)
{
    if (status == DECIMAL_OUT_OF_RANGE) {
        return complain(name, "'%.*s' is outside %s", (int)length, text, range);
    }
    return complain(name, "'%.*s' is not a decimal number", (int)length, text);
}

/* Length of the number at the start of a list: up to the comma or the end. */
static size_t item_length(const char *list) { return strcspn(list, ","); }

static int count_items(const char *list)
{
    int n = 1;
    for (; *list != '\0'; list++) {
        n += *list == ',';
    }
    return n;
}

/* Read a list of exactly 'count' Q16 numbers. */
static int parse_q16_list(drogue_q16 *out, int count, const char *name, const char *list)
{
    int i;
    for (i = 0; i < count; i++) {
        size_t length = item_length(list);
        decimal_status status = decimal_to_q16(&out[i], list, length);
        if (status != DECIMAL_OK) {
            return bad_number(name, list, length, status, "[-32768, 32768)");
        }
        list += length + 1;
    }
    return EXIT_MEASURED;
}

static int check_count(const char *name, const char *list, int count)
{
    int given = count_items(list);
    if (given != count) {
        return complain(name, "%d numbers separated by commas are wanted, not %d", count, given);
    }
    return EXIT_MEASURED;
}

static int parse_camera(drogue_camera *camera, const char *list)
{
    drogue_q16 v[MAX_NUMBERS];
    if (check_count("--camera", list, 4) || parse_q16_list(v, 4, "--camera", list)) {
        return EXIT_BAD;
    }
    if (v[0] <= 0 || v[1] <= 0) {
        return complain("--camera", "FX and FY must be greater than 0 (at least 1/65536)");
    }
    camera->fx_px_q16 = v[0];
    camera->fy_px_q16 = v[1];
    camera->cx_px_q16 = v[2];
    camera->cy_px_q16 = v[3];
    return EXIT_MEASURED;
}

static int parse_distortion(drogue_camera *camera, const char *list)
{
    drogue_q16 v[MAX_NUMBERS];
    if (check_count("--distortion", list, 5) || parse_q16_list(v, 5, "--distortion", list)) {
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
    int count = count_items(list);
    if (count != 1 && count != 3) {
        return complain("--drogue", "1 or 3 numbers separated by commas are wanted, not %d", count);
    }
    if (parse_q16_list(v, count, "--drogue", list)) {
        return EXIT_BAD;
    }
    if (v[0] <= 0 || (count == 3 && v[1] <= 0)) {
        return complain("--drogue", "a radius must be greater than 0 (at least 1/65536)");
    }
    if (v[2] < 0) {
        return complain("--drogue", "INNER_DEPTH must not be negative");
    }
    model->rim_radius_m_q16 = v[0];
    model->inner_radius_m_q16 = v[1];
    model->inner_depth_m_q16 = v[2];
    return EXIT_MEASURED;
}

static int parse_region(drogue_region *region, const char *list)
{
    int32_t v[4];
    int i;
    if (check_count("--roi", list, 4)) {
        return EXIT_BAD;
    }
    for (i = 0; i < 4; i++) {
        size_t length = item_length(list);
        decimal number;
        decimal_window whole;
        decimal_status status = decimal_parse(&number, list, length);
        if (status == DECIMAL_OK) {
            whole = decimal_digits(&number, 6, 0);
            if (whole.below) {
                return complain("--roi", "'%.*s' is not a whole number", (int)length, list);
            }
            if (whole.above || whole.value > MAX_COORDINATE) {
                status = DECIMAL_OUT_OF_RANGE;
            }
        }
        if (status != DECIMAL_OK) {
            return bad_number("--roi", list, length, status, "[-1048576, 1048576]");
        }
        v[i] = number.negative ? -(int32_t)whole.value : (int32_t)whole.value;
        list += length + 1;
    }
    if (v[2] <= 0 || v[3] <= 0) {
        return complain("--roi", "width and height must be greater than 0");
    }
    if (v[2] > DROGUE_MAX_REGION || v[3] > DROGUE_MAX_REGION) {
        return complain("--roi", "width and height must not exceed %d", DROGUE_MAX_REGION);
    }
    region->x_px = v[0];
    region->y_px = v[1];
    region->width_px = v[2];
    region->height_px = v[3];
    return EXIT_MEASURED;
}

/* A number in [0, 10^9) as whole billionths, the rest cut off. */
static int parse_billionths(uint64_t *out, const char *name, const char *text)
{
    decimal number;
    decimal_window window;
    size_t length = strlen(text);
    decimal_status status = decimal_parse(&number, text, length);
    if (status == DECIMAL_OK) {
        window = decimal_digits(&number, 8, -9);
        *out = window.value;
        if (window.above || (number.negative && (window.value != 0 || window.below))) {
            status = DECIMAL_OUT_OF_RANGE;
        }
    }
    return status == DECIMAL_OK ? EXIT_MEASURED : bad_number(name, text, length, status, "[0, 1000000000)");
}

static int parse_rate(uint32_t *frame_us, const char *text)
{
    const uint64_t million_in_billionths = UINT64_C(1000000000000000);
    uint64_t rate, us;
    if (parse_billionths(&rate, "--fps", text)) {
        return EXIT_BAD;
    }
    us = rate == 0 ? 0 : (2 * million_in_billionths + rate) / (2 * rate);
    if (us == 0 || us > INT32_MAX) {
        return complain("--fps", "'%s' is not a rate from 0.0005 to 2000000 frames a second", text);
    }
    *frame_us = (uint32_t)us;
    return EXIT_MEASURED;
}

#define MOST_MISSED 1000000

static int parse_max_missed(uint32_t *frames, const char *text)
{
    size_t length = strlen(text);
    decimal number;
    decimal_window whole;
    decimal_status status = decimal_parse(&number, text, length);
    if (status == DECIMAL_OK) {
        whole = decimal_digits(&number, 6, 0);
        if (whole.below) {
            return complain("--max-missed", "'%s' is not a whole number", text);
        }
        if (whole.above || whole.value > MOST_MISSED || (number.negative && whole.value != 0)) {
            status = DECIMAL_OUT_OF_RANGE;
        }
    }
    if (status != DECIMAL_OK) {
        return bad_number("--max-missed", text, length, status, "[0, 1000000]");
    }
    *frames = (uint32_t)whole.value;
    return EXIT_MEASURED;
}

static int parse_option(options *out, uint64_t thresholds[2], int option, const char *value)
{
    switch (option) {
    case OPTION_CAMERA: return parse_camera(&out->camera, value);
    case OPTION_DISTORTION: return parse_distortion(&out->camera, value);
    case OPTION_ROI: out->region_given = 1; return parse_region(&out->region, value);
    case OPTION_DROGUE: out->model_given = 1; return parse_model(&out->model, value);
    case OPTION_JSON: out->json = 1; return EXIT_MEASURED;
    case OPTION_OVERLAY: out->overlay = value; return EXIT_MEASURED;
    case OPTION_FPS: return parse_rate(&out->frame_us, value);
    case OPTION_MAX_MISSED: out->max_missed_given = 1; return parse_max_missed(&out->max_missed, value);
    case OPTION_LOW: return parse_billionths(&thresholds[0], "--low", value);
    case OPTION_HIGH: return parse_billionths(&thresholds[1], "--high", value);
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

int options_parse(options *out, int argc, char **argv)
{
    const uint64_t billion = UINT64_C(1000000000);
    uint64_t thresholds[2] = {0, 0};
    unsigned given = 0;
    int option;
    memset(out, 0, sizeof *out);
    out->model.rim_radius_m_q16 = DROGUE_Q16_ONE;
    out->frame_us = 33333;
    opterr = 0;
    while ((option = getopt_long(argc, argv, ":", LONG_OPTIONS, NULL)) != -1) {
        if (option == OPTION_HELP || option == OPTION_VERSION) {
            out->command = option == OPTION_HELP ? COMMAND_HELP : COMMAND_VERSION;
            return EXIT_MEASURED;
        }
        if (option == ':') {
            return complain(argv[optind - 1], "needs a value");
        }
        if (option == '?' && optopt > 0 && optopt < OPTION_END) {
            return complain(argv[optind - 1], "takes no value");
        }
        if (option == '?' && optopt != 0) {
            char text[] = {'-', (char)optopt, '\0'};
            return complain(text, "unknown option; see drogue --help");
        }
        if (option == '?') {
            return complain(argv[optind - 1], "unknown or ambiguous option; see drogue --help");
        }
        if (parse_option(out, thresholds, option, optarg)) {
            return EXIT_BAD;
        }
        given |= BIT(option);
    }
    if (check_use(out, given, argv + optind, argc - optind)) {
        return EXIT_BAD;
    }
    if (thresholds[0] > thresholds[1]) {
        return complain("--low", "must not exceed --high");
    }
    out->canny_low = (int32_t)(thresholds[0] / billion);
    out->canny_high = (int32_t)(thresholds[1] / billion);
    return EXIT_MEASURED;
}

const char *options_length_unit(const options *o) { return o->model_given ? "m" : "rim radii"; }
