/* SPDX-License-Identifier: Apache-2.0 */
/* The inner black part: Otsu 1979, opening, largest component, centroid. Two passes over the disc's rows. */
#include "drogue/centroid.h"

#include <string.h>

#include "drogue/wide.h"

/* A variance as a fraction p^2 / q and the product of such a p^2 with another q: high * 2^52 + low. */
typedef struct product {
    drogue_s128 high;
    uint64_t low;
} product;

/* p^2 * q for 0 <= p < 2^52, 0 <= q < 2^44 */
static product square_times(int64_t p, int64_t q)
{
    const uint64_t mask = (UINT64_C(1) << 52) - 1;
    drogue_s128 square = drogue_s128_mul(p, p);
    int64_t upper = (int64_t)(((uint64_t)square.hi << 12) | (square.lo >> 52));
    drogue_s128 lower = drogue_s128_mul((int64_t)(square.lo & mask), q);
    product r;
    r.high = drogue_s128_add(drogue_s128_mul(upper, q),
                             drogue_s128_from_s64((int64_t)(((uint64_t)lower.hi << 12) | (lower.lo >> 52))));
    r.low = lower.lo & mask;
    return r;
}

/* p^2 / q > r^2 / s? */
static int greater(int64_t p, int64_t q, int64_t r, int64_t s)
{
    product left = square_times(p, s);
    product right = square_times(r, q);
    int order = drogue_s128_cmp(left.high, right.high);
    return order > 0 || (order == 0 && left.low > right.low);
}

uint8_t drogue_otsu(const uint32_t *histogram)
{
    int64_t total = 0;
    int64_t sum = 0;
    int64_t below = 0;
    int64_t sum_below = 0;
    int64_t best_p = 0;
    int64_t best_q = 1;
    uint8_t best = 0;
    int level;
    for (level = 0; level < 256; level++) {
        total += histogram[level];
        sum += (int64_t)histogram[level] * level;
    }
    for (level = 0; level < 255; level++) {
        int64_t p;
        int64_t q;
        below += histogram[level];
        sum_below += (int64_t)histogram[level] * level;
        q = below * (total - below);
        if (q == 0) {
            continue;
        }
        p = below * sum - total * sum_below; /* variance between the classes = p^2 / (q total^2) */
        DROGUE_NOTE("centroid: root of Otsu's variance", p, 52);
        DROGUE_NOTE("centroid: weights of Otsu's variance", q, 44);
        if (greater(p, q, best_p, best_q)) {
            best_p = p;
            best_q = q;
            best = (uint8_t)level;
        }
    }
    return best;
}

/* Columns [*first, *last] of the disc in row y, within the image; 0 when there are none. */
static int disc_span(int32_t *first, int32_t *last, const drogue_mask *disc, int32_t y, int32_t width_px)
{
    int64_t dy = 2 * (int64_t)y - disc->centre2_y;
    int64_t rest = 4 * (int64_t)disc->longest_px * disc->longest_px - 9 * dy * dy;
    int64_t half; /* largest |2x - centre2_x| with 9 (2x - centre2_x)^2 <= rest */
    int64_t low;
    int64_t high;
    if (rest < 0) {
        return 0;
    }
    half = drogue_isqrt_u64((uint64_t)(rest / 9));
    low = drogue_floor_div_s64(disc->centre2_x - half + 1, 2);
    high = drogue_floor_div_s64(disc->centre2_x + half, 2);
    *first = (int32_t)(low < 0 ? 0 : low);
    *last = (int32_t)(high > width_px - 1 ? width_px - 1 : high);
    return low <= high && *first <= *last;
}

static void binary_row(uint8_t *out, const uint8_t *row, const drogue_mask *disc, int32_t y, int32_t width_px,
                       uint8_t threshold)
{
    int32_t first;
    int32_t last;
    int32_t x;
    memset(out, 0, (size_t)width_px);
    if (disc_span(&first, &last, disc, y, width_px)) {
        for (x = first; x <= last; x++) {
            out[x] = row[x] <= threshold ? 1 : 0;
        }
    }
}

/* Minimum (erosion) or maximum (dilation) over 3x3; beyond the left and right border nothing counts. */
static void erode_row(uint8_t *out, const uint8_t *const rows[3], int32_t width_px)
{
    int32_t x;
    for (x = 0; x < width_px; x++) {
        int32_t l = x > 0 ? x - 1 : x;
        int32_t r = x + 1 < width_px ? x + 1 : x;
        out[x] = rows[0][l] & rows[0][x] & rows[0][r] & rows[1][l] & rows[1][x] & rows[1][r] & rows[2][l] & rows[2][x] &
                 rows[2][r];
    }
}

static void dilate_row(uint8_t *out, const uint8_t *const rows[3], int32_t width_px)
{
    int32_t x;
    for (x = 0; x < width_px; x++) {
        int32_t l = x > 0 ? x - 1 : x;
        int32_t r = x + 1 < width_px ? x + 1 : x;
        out[x] = rows[0][l] | rows[0][x] | rows[0][r] | rows[1][l] | rows[1][x] | rows[1][r] | rows[2][l] | rows[2][x] |
                 rows[2][r];
    }
}

/* Components of the opened binary image with area and coordinate sums, in the tables of the workspace. The sums
 * fit 32 bits: those over all pixels of 2048 x 2048 do. */
typedef struct dark_pass {
    drogue_workspace *workspace;
    const drogue_image *image;
    const drogue_mask *disc;
    drogue_labels labels;
    uint8_t *binary;  /* ring of 3 rows */
    uint8_t *eroded;  /* ring of 3 rows */
    uint8_t *outside; /* row of ones for the erosion, then of zeros for the dilation */
    uint8_t threshold;
} dark_pass;

static void label_opened_row(dark_pass *p, int32_t y)
{
    drogue_workspace *w = p->workspace;
    size_t width = (size_t)p->image->width_px;
    uint8_t *code = w->code_rows + (size_t)(y & 1) * width;
    uint32_t *row = w->component_rows + (size_t)(y & 1) * width;
    const uint8_t *rows[3];
    int32_t x;
    rows[0] = y > 0 ? p->eroded + (size_t)((y - 1) % 3) * width : p->outside + width;
    rows[1] = p->eroded + (size_t)(y % 3) * width;
    rows[2] = y + 1 < p->image->height_px ? p->eroded + (size_t)((y + 1) % 3) * width : p->outside + width;
    dilate_row(code, rows, p->image->width_px);
    drogue_label_row(row, &p->labels, w->merges, w->component_rows + (size_t)(~y & 1) * width, code,
                     w->code_rows + (size_t)(~y & 1) * width, 1, p->image->width_px);
    for (x = 0; x < p->image->width_px; x++) {
        if (row[x] != 0) {
            w->component_strong[row[x]]++;
            w->arc_parent[row[x]] += (uint32_t)x;
            w->arc_component[row[x]] += (uint32_t)y;
        }
    }
}

static void erode_step(dark_pass *p, int32_t y)
{
    size_t width = (size_t)p->image->width_px;
    const uint8_t *rows[3];
    rows[0] = y > 0 ? p->binary + (size_t)((y - 1) % 3) * width : p->outside;
    rows[1] = p->binary + (size_t)(y % 3) * width;
    rows[2] = y + 1 < p->image->height_px ? p->binary + (size_t)((y + 1) % 3) * width : p->outside;
    erode_row(p->eroded + (size_t)(y % 3) * width, rows, p->image->width_px);
    if (y > 0) {
        label_opened_row(p, y - 1);
    }
}

static void open_and_label(dark_pass *p)
{
    drogue_workspace *w = p->workspace;
    size_t width = (size_t)p->image->width_px;
    size_t table = w->capacity.labels * sizeof(uint32_t);
    int32_t y;
    p->binary = w->raw_rows;
    p->eroded = w->smooth_rows;
    p->outside = w->raw_rows + 3 * width;
    memset(p->outside, 1, width);
    memset(p->outside + width, 0, width);
    memset(w->code_rows, 0, 2 * width);
    memset(w->component_rows, 0, 2 * width * sizeof(uint32_t));
    memset(w->component_strong, 0, table);
    memset(w->arc_parent, 0, table);
    memset(w->arc_component, 0, table);
    drogue_labels_reset(&p->labels, w->component_parent, w->capacity.labels);
    for (y = 0; y < p->image->height_px; y++) {
        binary_row(p->binary + (size_t)(y % 3) * width, drogue_image_row(p->image, y), p->disc, y, p->image->width_px,
                   p->threshold);
        if (y > 0) {
            erode_step(p, y - 1);
        }
    }
    erode_step(p, p->image->height_px - 1);
    label_opened_row(p, p->image->height_px - 1);
}

/* Join the sums of merged labels; returns the label of the largest component, 0 when there is none. */
static uint32_t largest(dark_pass *p)
{
    drogue_workspace *w = p->workspace;
    uint32_t best = 0;
    uint32_t i;
    drogue_labels_flatten(&p->labels);
    for (i = 1; i < p->labels.count; i++) {
        uint32_t root = w->component_parent[i];
        if (root != i) {
            w->component_strong[root] += w->component_strong[i];
            w->arc_parent[root] += w->arc_parent[i];
            w->arc_component[root] += w->arc_component[i];
            w->component_strong[i] = 0;
        }
    }
    for (i = 1; i < p->labels.count; i++) {
        if (w->component_strong[i] > (best == 0 ? 0 : w->component_strong[best])) {
            best = i;
        }
    }
    return best;
}

static uint8_t disc_threshold(uint32_t *histogram, const drogue_image *image, const drogue_mask *disc)
{
    int32_t y;
    memset(histogram, 0, 256 * sizeof(uint32_t));
    for (y = 0; y < image->height_px; y++) {
        const uint8_t *row = drogue_image_row(image, y);
        int32_t first;
        int32_t last;
        int32_t x;
        if (disc_span(&first, &last, disc, y, image->width_px)) {
            for (x = first; x <= last; x++) {
                histogram[row[x]]++;
            }
        }
    }
    return drogue_otsu(histogram);
}

drogue_status drogue_dark_part_find(drogue_dark_part *out, drogue_workspace *workspace, const drogue_image *image,
                                    const drogue_mask *disc, uint32_t min_area)
{
    dark_pass pass;
    uint32_t best;
    memset(out, 0, sizeof *out);
    if (!drogue_image_valid(image) || !drogue_mask_valid(disc)) {
        return DROGUE_E_ARGUMENT;
    }
    if ((uint32_t)image->width_px > workspace->capacity.width_px) {
        return DROGUE_E_WORKSPACE;
    }
    pass.workspace = workspace;
    pass.image = image;
    pass.disc = disc;
    pass.threshold = disc_threshold(workspace->histogram, image, disc);
    out->threshold = pass.threshold;
    open_and_label(&pass);
    best = largest(&pass);
    if (pass.labels.full) {
        return DROGUE_E_LABELS_FULL;
    }
    if (best == 0 || workspace->component_strong[best] < min_area) {
        return DROGUE_E_NO_DARK_PART;
    }
    DROGUE_NOTE("centroid: coordinate sum", workspace->arc_parent[best], 32);
    out->area_px = workspace->component_strong[best];
    out->x_px_q16 = (drogue_q16)drogue_div_round_s64((int64_t)workspace->arc_parent[best] << 16, out->area_px);
    out->y_px_q16 = (drogue_q16)drogue_div_round_s64((int64_t)workspace->arc_component[best] << 16, out->area_px);
    return DROGUE_OK;
}
