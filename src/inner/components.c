/* SPDX-License-Identifier: Apache-2.0 */
/* The inner black part: opening, largest component, centroid. Two passes over the disc's rows. */
#include <string.h>

#include "drogue/lanes.h"
#include "pass.h"

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

static void label_opened_row(drogue_inner_pass *p, int32_t y)
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
static const uint32_t *binary_at(const drogue_inner_pass *p, int32_t y)
{
    if (y < 0 || y >= p->image->height_px) {
        return p->ones;
    }
    return y >= p->first_row && y <= p->last_row ? p->binary + y % 3 * p->words : p->zeros;
}

static void erode_step(drogue_inner_pass *p, int32_t y)
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
static int bound_rows(drogue_inner_pass *p)
{
    int32_t height = p->image->height_px;
    int32_t first;
    int32_t last;
    int32_t y;
    for (y = 0; y < height && !drogue_disc_span(&first, &last, p->disc, y, p->image->width_px); y++) {}
    p->first_row = y;
    for (y = height - 1; y > p->first_row && !drogue_disc_span(&first, &last, p->disc, y, p->image->width_px); y--) {}
    p->last_row = y;
    return p->first_row < height;
}

static void open_and_label(drogue_inner_pass *p)
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
    if (!bound_rows(p)) {
        return;
    }
    for (y = p->first_row; y <= p->last_row; y++) {
        uint32_t *row = p->binary + y % 3 * p->words;
        int32_t first;
        int32_t last;
        memset(row, 0, bytes);
        if (drogue_disc_span(&first, &last, p->disc, y, p->image->width_px)) {
            binary_row(row, drogue_image_row(p->image, y), first, last, p->threshold);
        }
        if (y > p->first_row) {
            erode_step(p, y - 1);
        }
    }
    erode_step(p, p->last_row);
    label_opened_row(p, p->last_row);
}

drogue_status drogue_inner_components(drogue_inner_pass *pass, drogue_inner_part *out, drogue_workspace *workspace,
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
    pass->threshold = drogue_disc_threshold(workspace->histogram, image, disc);
    out->threshold = pass->threshold;
    open_and_label(pass);
    drogue_inner_join(workspace->component_parent, workspace->component_strong, workspace->arc_parent,
                      workspace->arc_component, pass->labels.count);
    return pass->labels.full ? DROGUE_E_LABELS_FULL : DROGUE_OK;
}

drogue_status drogue_inner_part_find(drogue_inner_part *out, drogue_workspace *workspace, const drogue_image *image,
                                     const drogue_mask *disc, uint32_t min_area)
{
    drogue_inner_pass pass;
    uint32_t best = 0;
    uint32_t i;
    drogue_status status = drogue_inner_components(&pass, out, workspace, image, disc);
    if (status != DROGUE_OK) {
        return status;
    }
    for (i = 1; i < pass.labels.count; i++) {
        if (workspace->component_strong[i] > (best == 0 ? 0 : workspace->component_strong[best])) {
            best = i;
        }
    }
    if (best == 0 || workspace->component_strong[best] < min_area) {
        return DROGUE_E_NO_INNER_PART;
    }
    DROGUE_NOTE("centroid: coordinate sum", workspace->arc_parent[best], 32);
    out->area_px = workspace->component_strong[best];
    out->x_px_q16 = drogue_inner_mean_q16(workspace->arc_parent[best], out->area_px);
    out->y_px_q16 = drogue_inner_mean_q16(workspace->arc_component[best], out->area_px);
    return DROGUE_OK;
}
