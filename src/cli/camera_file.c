/* SPDX-License-Identifier: Apache-2.0 */
/* What the four forms call focal lengths, principal point, distortion and size. */
#include "camera_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "decimal.h"
#include "keys.h"

enum { MOST_COEFFICIENTS = 14, KEPT_COEFFICIENTS = 5 };

/* Key names of a form; the matrix is 3 x 3 by rows, or fx fy cx cy. */
typedef struct form {
    const char *matrix; /* its first place is this with ".0" */
    int is_matrix;
    const char *distortion;
    const char *width;
    const char *height;
} form;

static const form FORMS[] = {
    {"camera_matrix.data", 1, "distortion_coefficients.data", "image_width", "image_height"}, /* OpenCV, ROS */
    {"Camera_Matrix.data", 1, "Distortion_Coefficients.data", "image_Width", "image_Height"}, /* OpenCV before 3 */
    {"cameraMatrix.data", 1, "distCoeffs.data", "image_width", "image_height"},
    {"K", 1, "D", "width", "height"}, /* a camera_info message */
    {"k", 1, "d", "width", "height"},
    {"cam0.intrinsics", 0, "cam0.distortion_coeffs", "cam0.resolution.0", "cam0.resolution.1"}, /* Kalibr */
};

static const char *place_value(const keys *k, const char *name, int place)
{
    char whole[KEYS_NAME];
    snprintf(whole, sizeof whole, "%s.%d", name, place);
    return keys_value(k, whole);
}

static int is_empty(const keys *k, const char *name)
{
    const char *text = keys_value(k, name);
    return text != NULL && strcmp(text, KEYS_EMPTY) == 0;
}

static int read_place(drogue_q16 *out, const keys *k, const char *name, int place, const char *path)
{
    const char *text = place_value(k, name, place);
    if (text == NULL) {
        return complain(path, "has no %s with a number at place %d", name, place);
    }
    if (decimal_to_q16(out, text, strlen(text)) != DECIMAL_OK) {
        return complain(path, "%s: '%s' is no number within +-32768", name, text);
    }
    return EXIT_MEASURED;
}

static int complain_of_two(const char *path, const char *key)
{
    return complain(path, "has %s more than once, with different values", key);
}

/* Rows or columns of a matrix that is called 'stem'; -1 where the file does not say. */
static int read_extent(int32_t *out, const keys *k, const char *stem, const char *side, const char *path)
{
    char name[KEYS_NAME];
    const char *text;
    drogue_q16 value;
    snprintf(name, sizeof name, "%s.%s", stem, side);
    text = keys_value(k, name);
    *out = -1;
    if (text == NULL) {
        return EXIT_MEASURED;
    }
    if (keys_contradiction(k, name) != NULL) {
        return complain_of_two(path, name);
    }
    if (decimal_to_q16(&value, text, strlen(text)) != DECIMAL_OK || value < 0 || value % DROGUE_Q16_ONE != 0) {
        return complain(path, "%s: '%s' is no number of %s", name, text, side);
    }
    *out = value / DROGUE_Q16_ONE;
    return EXIT_MEASURED;
}

/* Where rows and columns stand beside the numbers, they must be as many: or one of the three is not what was meant. */
static int check_extent(const keys *k, const char *data, int count, const char *path)
{
    const char *end = strstr(data, ".data");
    char stem[KEYS_NAME];
    int32_t rows;
    int32_t cols;
    if (end == NULL) { /* a form without them */
        return EXIT_MEASURED;
    }
    snprintf(stem, sizeof stem, "%.*s", (int)(end - data), data);
    if (read_extent(&rows, k, stem, "rows", path) || read_extent(&cols, k, stem, "cols", path)) {
        return EXIT_BAD;
    }
    return rows < 0 || cols < 0 || rows * cols == count
               ? EXIT_MEASURED
               : complain(path, "%s: rows x cols is %d x %d, but data has %d numbers", stem, rows, cols, count);
}

static int read_matrix(drogue_camera *out, const keys *k, const form *f, const char *path)
{
    drogue_q16 m[9] = {0};
    int i;
    for (i = 0; i < (f->is_matrix ? 9 : 4); i++) {
        if (read_place(&m[i], k, f->matrix, i, path)) {
            return EXIT_BAD;
        }
    }
    if (place_value(k, f->matrix, i) != NULL) {
        return complain(path, "%s has more than %d numbers", f->matrix, i);
    }
    if (f->is_matrix && (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != DROGUE_Q16_ONE)) {
        return complain(path, "%s is not fx 0 cx 0 fy cy 0 0 1: skew is not modelled", f->matrix);
    }
    if (check_extent(k, f->matrix, i, path)) {
        return EXIT_BAD;
    }
    out->fx_px_q16 = m[0];
    out->fy_px_q16 = f->is_matrix ? m[4] : m[1];
    out->cx_px_q16 = m[2];
    out->cy_px_q16 = f->is_matrix ? m[5] : m[3];
    return EXIT_MEASURED;
}

/* Is it a camera without distortion as ROS writes one: no coefficients, of plumb_bob or of no model? */
static int is_plain(const keys *k, const form *f)
{
    const char *model = keys_value(k, "distortion_model");
    return f->is_matrix && is_empty(k, f->distortion) &&
           (model == NULL || *model == '\0' || strcmp(model, "plumb_bob") == 0);
}

/* Brown-Conrady of OpenCV's order; what follows the fifth is another model unless it is 0. */
static int read_distortion(drogue_camera *out, const keys *k, const form *f, const char *path)
{
    drogue_q16 v[MOST_COEFFICIENTS] = {0};
    int count = 0;
    int i;
    while (count < MOST_COEFFICIENTS && place_value(k, f->distortion, count) != NULL) {
        if (read_place(&v[count], k, f->distortion, count, path)) {
            return EXIT_BAD;
        }
        count++;
    }
    if (place_value(k, f->distortion, count) != NULL && count == MOST_COEFFICIENTS) {
        return complain(path, "%s: more than %d numbers; Brown-Conrady has five", f->distortion, MOST_COEFFICIENTS);
    }
    if (count < 4 && !is_plain(k, f)) {
        return complain(path, "has no %s with four or five numbers", f->distortion);
    }
    for (i = KEPT_COEFFICIENTS; i < count; i++) {
        if (v[i] != 0) {
            return complain(path, "%s: coefficient %d is of the rational model; Brown-Conrady has five", f->distortion,
                            i + 1);
        }
    }
    if (check_extent(k, f->distortion, count, path)) {
        return EXIT_BAD;
    }
    out->k1_q16 = v[0];
    out->k2_q16 = v[1];
    out->p1_q16 = v[2];
    out->p2_q16 = v[3];
    out->k3_q16 = v[4];
    return EXIT_MEASURED;
}

/* A camera or lens model by name, where the file has one, must be this one. */
static int check_name(const keys *k, const char *key, const char *const *good, const char *path)
{
    const char *name = keys_value(k, key);
    if (name == NULL) {
        return EXIT_MEASURED;
    }
    for (; *good != NULL; good++) {
        if (strcmp(name, *good) == 0) {
            return EXIT_MEASURED;
        }
    }
    return complain(path, "%s is '%s', which is not the Brown-Conrady model of a pinhole camera", key, name);
}

static int check_model(const keys *k, const form *f, const char *path)
{
    static const char *const lenses[] = {"plumb_bob", "rational_polynomial", "radtan", NULL};
    static const char *const cameras[] = {"pinhole", NULL};
    static const char *const no[] = {"0", "false", NULL};
    if (keys_has(k, "cam1.")) {
        return complain(path, "holds more than one camera: keep one, as cam0");
    }
    return (!is_plain(k, f) && check_name(k, "distortion_model", lenses, path)) ||
           check_name(k, "cam0.distortion_model", lenses, path) || check_name(k, "cam0.camera_model", cameras, path) ||
           check_name(k, "fisheye_model", no, path) || check_name(k, "fisheye", no, path);
}

static int read_side(int32_t *out, const keys *k, const char *name, const char *path)
{
    const char *text = keys_value(k, name);
    drogue_q16 value;
    *out = 0;
    if (text == NULL) {
        return EXIT_MEASURED;
    }
    if (decimal_to_q16(&value, text, strlen(text)) != DECIMAL_OK || value <= 0 || value % DROGUE_Q16_ONE != 0) {
        return complain(path, "%s: '%s' is no number of pixels", name, text);
    }
    *out = value / DROGUE_Q16_ONE;
    return EXIT_MEASURED;
}

/* Both sides of the images, or neither. */
static int read_size(int32_t *width_px, int32_t *height_px, const keys *k, const form *f, const char *path)
{
    if (read_side(width_px, k, f->width, path) || read_side(height_px, k, f->height, path)) {
        return EXIT_BAD;
    }
    return (*width_px > 0) == (*height_px > 0)
               ? EXIT_MEASURED
               : complain(path, "has %s without %s", *width_px > 0 ? f->width : f->height,
                          *width_px > 0 ? f->height : f->width);
}

/* Of two values of a key readers of YAML take the first, the last or neither: none is what was meant for sure. */
static int check_once(const keys *k, const form *f, const char *path)
{
    const char *const read[] = {f->matrix, f->distortion, f->width, f->height};
    size_t i;
    for (i = 0; i < sizeof read / sizeof read[0]; i++) {
        const char *twice = keys_contradiction(k, read[i]);
        if (twice != NULL) {
            return complain_of_two(path, twice);
        }
    }
    return is_empty(k, f->distortion) && place_value(k, f->distortion, 0) != NULL ? complain_of_two(path, f->distortion)
                                                                                  : EXIT_MEASURED;
}

static int interpret(drogue_camera *out, int32_t *width_px, int32_t *height_px, const keys *k, const char *path)
{
    size_t i;
    for (i = 0; i < sizeof FORMS / sizeof FORMS[0]; i++) {
        const form *f = &FORMS[i];
        if (place_value(k, f->matrix, 0) != NULL) {
            return check_once(k, f, path) || check_model(k, f, path) || read_matrix(out, k, f, path) ||
                   read_distortion(out, k, f, path) || read_size(width_px, height_px, k, f, path);
        }
    }
    return complain(path, "has no camera_matrix (OpenCV, ROS), K (camera_info) or cam0 with intrinsics (Kalibr)");
}

int camera_file_read(drogue_camera *out, int32_t *width_px, int32_t *height_px, const char *path)
{
    keys k;
    const int bad = keys_read(&k, path) || interpret(out, width_px, height_px, &k, path);
    keys_free(&k);
    return bad ? EXIT_BAD : EXIT_MEASURED;
}
