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
    low = (disc->centre2_x - half + 1) >> 1;
    high = (disc->centre2_x + half) >> 1;
    *first = (int32_t)(low < 0 ? 0 : low);
    *last = (int32_t)(high > width_px - 1 ? width_px - 1 : high);
    return low <= high && *first <= *last;
}

/* Rows of the binary image are bits, pixel x at bit x % 32 of word x / 32. */
enum { BITS = 32 };

/* Levels at most the threshold, columns first .. last. */
static void binary_row(uint32_t *out, const uint8_t *row, int32_t first, int32_t last, uint32_t threshold)
{
    const uint32_t limit = DROGUE_LANES(0x8000u + threshold); /* less a level: top bit set where that is dark */
    int32_t x = first & ~3;
    for (; x <= last; x += 4) {
        uint32_t word = 0;
        uint32_t dark;
        if (x >= first && x + 3 <= last) {
            const uint8_t *p = row + x;
            word = (uint32_t)p[0] | ((uint32_t)p[1] << 8) | ((uint32_t)p[2] << 16) | ((uint32_t)p[3] << 24);
        } else {
            int32_t k;
            for (k = 0; k < 4; k++) { /* outside the disc nothing is dark */
                word |= (x + k >= first && x + k <= last ? (uint32_t)row[x + k] : 255u) << (8 * k);
            }
        }
        dark = (((limit - drogue_lanes_even(word)) >> 1) & DROGUE_LANES(0x4000u)) |
               ((limit - drogue_lanes_odd(word)) & DROGUE_LANES(0x8000u));
        out[x / BITS] |= (((dark >> 14) | (dark >> 28)) & 15u) << (x % BITS);
    }
}

/* Erosion by 3x3; 'valid' holds the columns of the last word, beyond the border nothing counts. */
static void erode_row(uint32_t *out, const uint32_t *const rows[3], int32_t words, uint32_t valid)
{
    uint32_t before = ~(uint32_t)0;
    uint32_t at = rows[0][0] & rows[1][0] & rows[2][0];
    int32_t i;
    for (i = 0; i < words; i++) {
        uint32_t after = ~(uint32_t)0;
        if (i + 1 < words) {
            after = rows[0][i + 1] & rows[1][i + 1] & rows[2][i + 1];
        } else {
            at |= ~valid;
        }
        out[i] = at & ((at << 1) | (before >> 31)) & ((at >> 1) | (after << 31));
        before = at;
        at = after;
    }
    out[words - 1] &= valid;
}

/* Dilation by 3x3. */
static void dilate_row(uint32_t *out, const uint32_t *const rows[3], int32_t words, uint32_t valid)
{
    uint32_t before = 0;
    uint32_t at = rows[0][0] | rows[1][0] | rows[2][0];
    int32_t i;
    for (i = 0; i < words; i++) {
        uint32_t after = i + 1 < words ? rows[0][i + 1] | rows[1][i + 1] | rows[2][i + 1] : 0;
        out[i] = at | (at << 1) | (before >> 31) | (at >> 1) | (after << 31);
        before = at;
        at = after;
    }
    out[words - 1] &= valid;
}

/* Components of the opened binary image with area and coordinate sums, in the tables of the workspace. The sums
 * fit 32 bits: those over all pixels of 2048 x 2048 do. */
typedef struct dark_pass {
    drogue_workspace *workspace;
    const drogue_image *image;
    const drogue_mask *disc;
    drogue_labels labels;
    uint32_t *binary; /* ring of 3 rows */
    uint32_t *eroded; /* ring of 3 rows */
    uint32_t *opened; /* 1 row */
    uint32_t *ones;   /* 1 row: outside the image for the erosion */
    uint32_t *zeros;  /* 1 row: outside the disc, and outside the image for the dilation */
    int32_t words;
    int32_t first_row; /* of the disc, within the image */
    int32_t last_row;
    uint32_t valid; /* columns of the last word */
    uint8_t threshold;
} dark_pass;

/* List the columns of the opened row and set their codes. */
static uint32_t list_opened(drogue_slope *points, uint8_t *code, const uint32_t *opened, int32_t words)
{
    uint32_t count = 0;
    int32_t i;
    for (i = 0; i < words; i++) {
        uint32_t bits = opened[i];
        int32_t x = i * BITS;
        for (; bits != 0; bits >>= 1, x++) {
            if ((bits & 1u) != 0) {
                points[count++].x = (uint16_t)x;
                code[x] = 1;
            }
        }
    }
    return count;
}

static void label_opened_row(dark_pass *p, int32_t y)
{
    drogue_workspace *w = p->workspace;
    size_t width = (size_t)p->image->width_px;
    uint8_t *code = w->code_rows + (size_t)(y & 1) * width;
    uint32_t *row = w->component_rows + (size_t)(y & 1) * width;
    const uint32_t *rows[3];
    uint32_t count;
    uint32_t i;
    rows[0] = y > p->first_row ? p->eroded + (y - 1) % 3 * p->words : p->zeros;
    rows[1] = p->eroded + y % 3 * p->words;
    rows[2] = y < p->last_row ? p->eroded + (y + 1) % 3 * p->words : p->zeros;
    dilate_row(p->opened, rows, p->words, p->valid);
    memset(code, 0, width);
    count = list_opened(w->slope_rows, code, p->opened, p->words);
    drogue_label_points(row, &p->labels, w->merges, w->component_rows + (size_t)(~y & 1) * width, code,
                        w->code_rows + (size_t)(~y & 1) * width, 1, p->image->width_px, w->slope_rows, count);
    for (i = 0; i < count; i++) {
        uint32_t x = w->slope_rows[i].x;
        uint32_t label = row[x];
        if (label != 0) {
            w->component_strong[label]++;
            w->arc_parent[label] += x;
            w->arc_component[label] += (uint32_t)y;
        }
    }
}

/* Row y of the binary image, or what stands for it outside the disc. */
static const uint32_t *binary_at(const dark_pass *p, int32_t y)
{
    if (y < 0 || y >= p->image->height_px) {
        return p->ones;
    }
    return y >= p->first_row && y <= p->last_row ? p->binary + y % 3 * p->words : p->zeros;
}

static void erode_step(dark_pass *p, int32_t y)
{
    const uint32_t *rows[3];
    rows[0] = binary_at(p, y - 1);
    rows[1] = binary_at(p, y);
    rows[2] = binary_at(p, y + 1);
    erode_row(p->eroded + y % 3 * p->words, rows, p->words, p->valid);
    if (y > p->first_row) {
        label_opened_row(p, y - 1);
    }
}

/* Rows of the disc within the image; 0 when there are none. */
static int disc_rows(dark_pass *p)
{
    int32_t height = p->image->height_px;
    int32_t first;
    int32_t last;
    int32_t y;
    for (y = 0; y < height && !disc_span(&first, &last, p->disc, y, p->image->width_px); y++) {}
    p->first_row = y;
    for (y = height - 1; y > p->first_row && !disc_span(&first, &last, p->disc, y, p->image->width_px); y--) {}
    p->last_row = y;
    return p->first_row < height;
}

static void open_and_label(dark_pass *p)
{
    drogue_workspace *w = p->workspace;
    size_t width = (size_t)p->image->width_px;
    size_t table = w->capacity.labels * sizeof(uint32_t);
    size_t bytes;
    int32_t y;
    p->words = (p->image->width_px + BITS - 1) / BITS;
    p->valid = ~(uint32_t)0 >> (p->words * BITS - p->image->width_px);
    bytes = (size_t)p->words * sizeof(uint32_t);
    p->binary = (uint32_t *)(void *)w->smooth_rows;
    p->eroded = p->binary + 3 * p->words;
    p->opened = p->eroded + 3 * p->words;
    p->ones = p->opened + p->words;
    p->zeros = p->ones + p->words;
    memset(p->ones, 0xFF, bytes);
    memset(p->zeros, 0, bytes);
    memset(w->code_rows, 0, 2 * width);
    memset(w->component_strong, 0, table);
    memset(w->arc_parent, 0, table);
    memset(w->arc_component, 0, table);
    drogue_labels_reset(&p->labels, w->component_parent, w->capacity.labels);
    if (!disc_rows(p)) {
        return;
    }
    for (y = p->first_row; y <= p->last_row; y++) {
        uint32_t *row = p->binary + y % 3 * p->words;
        int32_t first;
        int32_t last;
        memset(row, 0, bytes);
        if (disc_span(&first, &last, p->disc, y, p->image->width_px)) {
            binary_row(row, drogue_image_row(p->image, y), first, last, p->threshold);
        }
        if (y > p->first_row) {
            erode_step(p, y - 1);
        }
    }
    erode_step(p, p->last_row);
    label_opened_row(p, p->last_row);
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
