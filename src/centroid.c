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

/* Join the sums of merged labels: afterwards roots alone have an area. */
static void join_components(dark_pass *p)
{
    drogue_workspace *w = p->workspace;
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
}

/* Rows that a disc can reach, within the image. */
static void window_rows(int32_t *first, int32_t *last, const drogue_mask *disc, int32_t height_px)
{
    const int64_t low = ((int64_t)disc->centre2_y - disc->longest_px) / 2;
    const int64_t high = ((int64_t)disc->centre2_y + disc->longest_px) / 2;
    *first = (int32_t)(low < 0 ? 0 : low);
    *last = (int32_t)(high > height_px - 1 ? height_px - 1 : high);
}

static uint8_t disc_threshold(uint32_t *histogram, const drogue_image *image, const drogue_mask *disc)
{
    int32_t y;
    int32_t low;
    int32_t high;
    memset(histogram, 0, 256 * sizeof(uint32_t));
    window_rows(&low, &high, disc, image->height_px);
    for (y = low; y <= high; y++) {
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

/* Threshold, open and label the disc. */
static drogue_status dark_components(dark_pass *pass, drogue_dark_part *out, drogue_workspace *workspace,
                                     const drogue_image *image, const drogue_mask *disc)
{
    memset(out, 0, sizeof *out);
    if (!drogue_image_valid(image) || !drogue_mask_valid(disc)) {
        return DROGUE_E_ARGUMENT;
    }
    if ((uint32_t)image->width_px > workspace->capacity.width_px) {
        return DROGUE_E_WORKSPACE;
    }
    pass->workspace = workspace;
    pass->image = image;
    pass->disc = disc;
    pass->threshold = disc_threshold(workspace->histogram, image, disc);
    out->threshold = pass->threshold;
    open_and_label(pass);
    join_components(pass);
    return pass->labels.full ? DROGUE_E_LABELS_FULL : DROGUE_OK;
}

static drogue_q16 mean_q16(int64_t sum, int64_t count) { return (drogue_q16)drogue_div_round_s64(sum * 65536, count); }

drogue_status drogue_dark_part_find(drogue_dark_part *out, drogue_workspace *workspace, const drogue_image *image,
                                    const drogue_mask *disc, uint32_t min_area)
{
    dark_pass pass;
    uint32_t best = 0;
    uint32_t i;
    drogue_status status = dark_components(&pass, out, workspace, image, disc);
    if (status != DROGUE_OK) {
        return status;
    }
    for (i = 1; i < pass.labels.count; i++) {
        if (workspace->component_strong[i] > (best == 0 ? 0 : workspace->component_strong[best])) {
            best = i;
        }
    }
    if (best == 0 || workspace->component_strong[best] < min_area) {
        return DROGUE_E_NO_DARK_PART;
    }
    DROGUE_NOTE("centroid: coordinate sum", workspace->arc_parent[best], 32);
    out->area_px = workspace->component_strong[best];
    out->x_px_q16 = mean_q16(workspace->arc_parent[best], out->area_px);
    out->y_px_q16 = mean_q16(workspace->arc_component[best], out->area_px);
    return DROGUE_OK;
}

static uint64_t distance2_q32(const drogue_dark_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    return drogue_square_sum(drogue_q16_sub(part->x_px_q16, x_px_q16), drogue_q16_sub(part->y_px_q16, y_px_q16));
}

static drogue_q16 distance_q16(const drogue_dark_part *part, drogue_q16 x_px_q16, drogue_q16 y_px_q16)
{
    return drogue_sat_s32((int64_t)drogue_isqrt_u64(distance2_q32(part, x_px_q16, y_px_q16)));
}

/* Components whose centroids lie within an expected disc, together; area 0 when there are none. */
static void components_within(drogue_dark_part *out, const dark_pass *p, const drogue_ellipse *expected,
                              uint32_t min_area)
{
    const drogue_workspace *w = p->workspace;
    const uint64_t reach2_q32 = drogue_square_sum(expected->a_px_q16, 0);
    int64_t x = 0;
    int64_t y = 0;
    uint32_t i;
    out->area_px = 0;
    for (i = 1; i < p->labels.count; i++) {
        const uint32_t area = w->component_strong[i];
        drogue_dark_part one;
        if (area < min_area || area == 0) {
            continue;
        }
        one.x_px_q16 = mean_q16(w->arc_parent[i], area);
        one.y_px_q16 = mean_q16(w->arc_component[i], area);
        if (distance2_q32(&one, expected->xc_px_q16, expected->yc_px_q16) <= reach2_q32) {
            out->area_px += area;
            x += w->arc_parent[i];
            y += w->arc_component[i];
        }
    }
    DROGUE_NOTE("centroid: coordinate sum of components", x > y ? x : y, 33);
    if (out->area_px > 0) {
        out->x_px_q16 = mean_q16(x, out->area_px);
        out->y_px_q16 = mean_q16(y, out->area_px);
    }
}

drogue_q16 drogue_dark_fill(const drogue_dark_part *part, const drogue_ellipse *expected)
{
    const drogue_wide box =
        drogue_wide_mul(drogue_wide_from_q16(expected->a_px_q16), drogue_wide_from_q16(expected->b_px_q16));
    return drogue_wide_to_q16(drogue_wide_div(drogue_wide_from_s64(part->area_px, 0),
                                              drogue_wide_mul(box, drogue_wide_from_q16(DROGUE_Q16_PI))));
}

/* How badly a part fits an expected disc: distance in its semi-axes plus the share by which the areas differ, Q16. */
static drogue_q16 misfit(const drogue_dark_part *part, const drogue_ellipse *expected)
{
    const drogue_q16 away =
        drogue_q16_div(distance_q16(part, expected->xc_px_q16, expected->yc_px_q16), expected->a_px_q16);
    const int64_t fill = (int64_t)drogue_dark_fill(part, expected) - DROGUE_Q16_ONE;
    return drogue_sat_s32(away + (fill < 0 ? -fill : fill));
}

/* Mean grey of the pixels at or below the threshold, rounded down; the histogram is the disc's. */
static int32_t dark_level(const uint32_t *histogram, uint8_t threshold)
{
    uint64_t count = 0;
    uint64_t sum = 0;
    uint32_t level;
    for (level = 0; level <= threshold; level++) {
        count += histogram[level];
        sum += (uint64_t)histogram[level] * level;
    }
    return count > 0 ? (int32_t)(sum / count) : 0;
}

/* Disc about the part of a multiple of the expected semi-axis, and a pixel. */
static drogue_mask window_about(const drogue_dark_part *part, const drogue_ellipse *expected, drogue_q16 factor_q16)
{
    drogue_mask window; /* radius longest / 3 */
    window.centre2_x = (int32_t)drogue_shr_round_s64(part->x_px_q16, 15);
    window.centre2_y = (int32_t)drogue_shr_round_s64(part->y_px_q16, 15);
    window.longest_px = (int32_t)drogue_shr_round_s64(3 * (int64_t)expected->a_px_q16 * factor_q16, 32) + 3;
    return window;
}

/* Darkness falls from 1 to 0 between two grey levels: a pixel at the edge counts by its grey, one of the surround not at
 * all. */
typedef struct ramp {
    int32_t full;  /* level of darkness 'range' and more */
    int32_t range; /* levels to darkness 0 */
} ramp;

/* Centroid of darkness in a window; the part's place and area. */
static void weigh(drogue_dark_part *part, const drogue_image *image, const drogue_mask *window, const ramp *r)
{
    int64_t sum = 0;
    int64_t x_sum = 0;
    int64_t y_sum = 0;
    int32_t y;
    int32_t low;
    int32_t high;
    window_rows(&low, &high, window, image->height_px);
    for (y = low; y <= high; y++) {
        const uint8_t *row = drogue_image_row(image, y);
        int32_t row_sum = 0;
        int32_t first;
        int32_t last;
        int32_t x;
        if (!disc_span(&first, &last, window, y, image->width_px)) {
            continue;
        }
        for (x = first; x <= last; x++) {
            const int32_t level = row[x] - r->full;
            const int32_t darkness = level < 0 ? r->range : level > r->range ? 0 : r->range - level;
            row_sum += darkness;
            x_sum += darkness * x;
        }
        sum += row_sum;
        y_sum += (int64_t)row_sum * y;
    }
    /* The range is at most 171 levels (2 / 3 of 255, and 1), over 2^22 pixels with coordinates below 2^11. */
    DROGUE_NOTE("centroid: sum of darkness", sum, 30);
    DROGUE_NOTE("centroid: x weighted by darkness", x_sum, 41);
    DROGUE_NOTE("centroid: y weighted by darkness", y_sum, 41);
    if (sum > 0) {
        part->x_px_q16 = mean_q16(x_sum, sum);
        part->y_px_q16 = mean_q16(y_sum, sum);
        part->area_px = (uint32_t)drogue_div_round_s64(sum, r->range);
    }
}

/* Weigh the part about its own threshold, that of a window about it, then at a third of the way to the dark level below
 * and above: the middle of the two, and how far apart they are. */
static void weigh_about(drogue_dark_part *part, uint32_t *histogram, const drogue_image *image,
                        const drogue_ellipse *expected)
{
    const drogue_mask around = window_about(part, expected, DROGUE_Q16(16, 10));
    drogue_mask window = window_about(part, expected, DROGUE_Q16(12, 10));
    drogue_dark_part lower;
    drogue_dark_part upper;
    ramp r;
    int32_t half;
    part->threshold = disc_threshold(histogram, image, &around);
    half = (part->threshold - dark_level(histogram, part->threshold)) / 3;
    r.range = 2 * half + 1;
    r.full = part->threshold - half;
    weigh(part, image, &window, &r);
    window = window_about(part, expected, DROGUE_Q16(12, 10));
    weigh(part, image, &window, &r);
    lower = *part;
    upper = *part;
    r.full -= half;
    weigh(&lower, image, &window, &r);
    r.full += 2 * half;
    weigh(&upper, image, &window, &r);
    part->spread_px_q16 = distance_q16(&lower, upper.x_px_q16, upper.y_px_q16);
}

drogue_status drogue_dark_disc_find(drogue_dark_part *out, uint32_t *which, drogue_workspace *workspace,
                                    const drogue_image *image, const drogue_mask *disc, uint32_t min_area,
                                    const drogue_ellipse *expected, uint32_t count)
{
    drogue_dark_part part;
    dark_pass pass;
    drogue_q16 least = DROGUE_Q16_MAX;
    uint32_t i;
    drogue_status status = dark_components(&pass, out, workspace, image, disc);
    *which = 0;
    if (status != DROGUE_OK) {
        return status;
    }
    part = *out;
    for (i = 0; i < count; i++) {
        components_within(&part, &pass, &expected[i], min_area);
        if (part.area_px > 0 && misfit(&part, &expected[i]) < least) {
            least = misfit(&part, &expected[i]);
            *out = part;
            *which = i;
        }
    }
    if (least == DROGUE_Q16_MAX) {
        return DROGUE_E_NO_DARK_PART;
    }
    weigh_about(out, workspace->histogram, image, &expected[*which]);
    return DROGUE_OK;
}
