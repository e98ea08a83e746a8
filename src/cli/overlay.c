/* SPDX-License-Identifier: Apache-2.0 */
/* The overlay: the part of the image that matters, enlarged when small, with what was found drawn on it. */
#include "overlay.h"

#include <stdio.h>

#include "canvas.h"
#include "cli.h"
#include "decimal.h"
#include "drogue/undistort.h"
#include "font.h"

enum {
    LEAST_WIDTH = 640,    /* canvas pixels: room for the words */
    MOST_ENLARGED = 2048, /* canvas pixels: no image is enlarged beyond */
    MOST_WHOLE = 1600,    /* a longer side is cropped about the region, where that is a part of the image */
    MOST_CROPPED = 3200,
    MOST_WORD_SCALE = 5, /* canvas pixels a font pixel */
    ELLIPSE_SIDES = 360,
    AXIS_STEPS = 8,
    WORD_LINES = 6
};

static const colour EDGE_COLOUR = {0, 200, 210};
static const colour ARC_COLOURS[4] = {{255, 130, 0}, {0, 190, 40}, {50, 110, 255}, {220, 40, 220}};
static const colour ELLIPSE_COLOUR = {255, 40, 40};
static const colour INNER_COLOUR = {120, 255, 60};
static const colour AXIS_COLOUR = {255, 225, 0};
static const colour TWIN_COLOUR = {165, 140, 40};
static const colour REGION_COLOUR = {140, 150, 255};
static const colour WORD_COLOUR = {240, 240, 240};
static const colour BAND_COLOUR = {24, 26, 32};

/* The canvas and the part of the image on it. */
typedef struct view {
    picture canvas;
    int32_t x_px; /* image pixel in the top left corner */
    int32_t y_px;
    int32_t width_px; /* of the image */
    int32_t height_px;
    int32_t scale;      /* canvas pixels an image pixel */
    int32_t word_scale; /* canvas pixels a font pixel */
} view;

static int32_t smaller(int32_t a, int32_t b) { return a < b ? a : b; }

/* One side of the crop: the region with a margin, moved so that it lies in the image. */
static void crop(int32_t *first, int32_t *size, int32_t start, int32_t region_size, int32_t limit)
{
    int32_t margin = region_size / 4 + 16;
    *size = smaller(smaller(region_size + 2 * margin, limit), MOST_CROPPED);
    *first = start - margin < 0 ? 0 : smaller(start - margin, limit - *size);
}

static void choose_part(view *v, const picture *grey, const drogue_region *region)
{
    v->x_px = 0;
    v->y_px = 0;
    v->width_px = grey->width_px;
    v->height_px = grey->height_px;
    if ((grey->width_px > MOST_WHOLE || grey->height_px > MOST_WHOLE) &&
        (region->width_px < grey->width_px || region->height_px < grey->height_px)) {
        crop(&v->x_px, &v->width_px, region->x_px, region->width_px, grey->width_px);
        crop(&v->y_px, &v->height_px, region->y_px, region->height_px, grey->height_px);
    }
    v->scale = (LEAST_WIDTH + v->width_px - 1) / v->width_px;
    while (v->scale > 1 && v->height_px * v->scale > MOST_ENLARGED) {
        v->scale--;
    }
}

static int32_t line_height(const view *v) { return FONT_LINE * v->word_scale; }

static int make_canvas(view *v, const char *path, const picture *grey)
{
    int32_t width = v->width_px * v->scale;
    int32_t x, y;
    width = width < LEAST_WIDTH ? LEAST_WIDTH : width;
    v->word_scale = smaller(width / LEAST_WIDTH + 1, MOST_WORD_SCALE);
    if (picture_create(&v->canvas, path, width, v->height_px * v->scale + (WORD_LINES + 1) * line_height(v), 3)) {
        return EXIT_BAD;
    }
    canvas_fill(&v->canvas, 0, 0, width, v->canvas.height_px, BAND_COLOUR, 256);
    for (y = 0; y < v->height_px; y++) {
        for (x = 0; x < v->width_px; x++) {
            uint8_t p = grey->data[(size_t)(v->y_px + y) * (size_t)grey->width_px + (size_t)(v->x_px + x)];
            colour c = {p, p, p};
            canvas_fill(&v->canvas, x * v->scale, y * v->scale, v->scale, v->scale, c, 256);
        }
    }
    return EXIT_MEASURED;
}

/* Image position, px Q16, to canvas position, Q8; far positions are clamped where squares still fit. */
static int64_t to_canvas(const view *v, int64_t position_q16, int32_t first_px)
{
    const int64_t most = INT64_C(1) << 28;
    int64_t q8 = drogue_shr_round_s64((position_q16 - (int64_t)first_px * 65536) * v->scale, 8) + (v->scale - 1) * 128;
    return q8 > most ? most : q8 < -most ? -most : q8;
}

static void draw_line(view *v, int64_t x0_q16, int64_t y0_q16, int64_t x1_q16, int64_t y1_q16, int32_t width, colour c)
{
    canvas_line(&v->canvas, to_canvas(v, x0_q16, v->x_px), to_canvas(v, y0_q16, v->y_px), to_canvas(v, x1_q16, v->x_px),
                to_canvas(v, y1_q16, v->y_px), width, c);
}

static void draw_region(view *v, const drogue_region *r)
{
    /* Along the outer edges of its outermost pixels. */
    int64_t left = (int64_t)r->x_px * 65536 - 32768, right = left + (int64_t)r->width_px * 65536;
    int64_t top = (int64_t)r->y_px * 65536 - 32768, bottom = top + (int64_t)r->height_px * 65536;
    draw_line(v, left, top, right, top, 2, REGION_COLOUR);
    draw_line(v, left, bottom, right, bottom, 2, REGION_COLOUR);
    draw_line(v, left, top, left, bottom, 2, REGION_COLOUR);
    draw_line(v, right, top, right, bottom, 2, REGION_COLOUR);
}

/* One edge point as a square that is 'rim' canvas pixels larger on each side than the image pixel. */
static void draw_edge(view *v, const drogue_result *r, const drogue_edge *e, int32_t rim, colour c, int32_t alpha)
{
    int32_t x = drogue_edge_x_px(e) + r->region.x_px - v->x_px;
    int32_t y = drogue_edge_y_px(e) + r->region.y_px - v->y_px;
    if (x < v->width_px && y < v->height_px) {
        canvas_fill(&v->canvas, x * v->scale - rim, y * v->scale - rim, v->scale + 2 * rim, v->scale + 2 * rim, c,
                    alpha);
    }
}

static void draw_edges(view *v, const drogue_result *r, const drogue_workspace *w)
{
    uint32_t i;
    for (i = 0; i < r->list.edge_count; i++) {
        draw_edge(v, r, &w->edges[i], 0, EDGE_COLOUR, 120);
    }
}

static void draw_arcs(view *v, const drogue_result *r, const drogue_workspace *w)
{
    uint32_t i, quadrant;
    for (quadrant = 0; quadrant < 4; quadrant++) {
        if (r->arcs[quadrant] < r->list.arc_count) {
            const drogue_arc *arc = &w->arcs[r->arcs[quadrant]];
            for (i = arc->first; i < arc->first + arc->count; i++) {
                draw_edge(v, r, &w->edges[i], 1, ARC_COLOURS[quadrant], 256);
            }
        }
    }
}

/* Point of an ellipse at the parameter 2 pi i / ELLIPSE_SIDES, px Q16. */
static void ellipse_point(int64_t *x_q16, int64_t *y_q16, const drogue_ellipse *e, int32_t i)
{
    const int64_t two_pi_q29 = INT64_C(3373259426);
    int64_t angle_q29 = (two_pi_q29 * i / ELLIPSE_SIDES) - two_pi_q29 / 2;
    int32_t s, c, sin_e, cos_e;
    int64_t u, w;
    drogue_sincos_q30(&s, &c, (int32_t)angle_q29);
    drogue_sincos_of_q16(&sin_e, &cos_e, e->angle_rad_q16);
    u = drogue_shr_round_s64((int64_t)e->a_px_q16 * c, 30);
    w = drogue_shr_round_s64((int64_t)e->b_px_q16 * s, 30);
    *x_q16 = e->xc_px_q16 + drogue_shr_round_s64(u * cos_e - w * sin_e, 30);
    *y_q16 = e->yc_px_q16 + drogue_shr_round_s64(u * sin_e + w * cos_e, 30);
}

static void draw_ellipse(view *v, const drogue_ellipse *e)
{
    int64_t x0, y0;
    int32_t i;
    ellipse_point(&x0, &y0, e, 0);
    for (i = 1; i <= ELLIPSE_SIDES; i++) {
        int64_t x1, y1;
        ellipse_point(&x1, &y1, e, i);
        draw_line(v, x0, y0, x1, y1, v->scale == 1 ? 1 : 2, ELLIPSE_COLOUR);
        x0 = x1;
        y0 = y1;
    }
}

static void draw_cross(view *v, drogue_q16 x_q16, drogue_q16 y_q16, colour c)
{
    int64_t arm_q16 = (int64_t)(8 + 2 * v->scale) * 65536 / v->scale;
    draw_line(v, x_q16 - arm_q16, y_q16, x_q16 + arm_q16, y_q16, 2, c);
    draw_line(v, x_q16, y_q16 - arm_q16, x_q16, y_q16 + arm_q16, 2, c);
}

/* The axis from the centre of the end plane two rim radii into the drogue, as the lens shows it. */
static void draw_axis(view *v, const drogue_pose *pose, const options *o, colour c)
{
    drogue_q16 x0 = 0, y0 = 0;
    int32_t i;
    for (i = 0; i <= AXIS_STEPS; i++) {
        drogue_q16 depth = drogue_sat_s32((int64_t)o->model.rim_radius_m_q16 * 2 * i / AXIS_STEPS);
        drogue_q16 x, y;
        if (drogue_project_axis_point(&x, &y, pose, depth, &o->camera) != DROGUE_OK ||
            drogue_distort_point(&x, &y, &o->camera) != DROGUE_OK) {
            return;
        }
        if (i > 0) {
            draw_line(v, x0, y0, x, y, 2, c);
        } else {
            int32_t dot = v->word_scale;
            canvas_fill(&v->canvas, (int32_t)(to_canvas(v, x, v->x_px) >> 8) - dot,
                        (int32_t)(to_canvas(v, y, v->y_px) >> 8) - dot, 2 * dot + 1, 2 * dot + 1, c, 256);
        }
        x0 = x;
        y0 = y;
    }
}

/* Print lines of words from the band's top on. */
static void put_line(view *v, int32_t line, const char *text)
{
    int32_t y = v->height_px * v->scale + line_height(v) / 2 + line * line_height(v);
    (void)canvas_text(&v->canvas, 4 * v->word_scale, y, v->word_scale, WORD_COLOUR, text);
}

static void put_legend(view *v, int32_t line)
{
    static const char *const quadrant_letters[4] = {"a", "r", "c", "s"};
    int32_t y = v->height_px * v->scale + line_height(v) / 2 + line * line_height(v);
    int32_t x = 4 * v->word_scale;
    int i;
    x = canvas_text(&v->canvas, x, y, v->word_scale, EDGE_COLOUR, "edges ");
    for (i = 0; i < 4; i++) {
        x = canvas_text(&v->canvas, x, y, v->word_scale, ARC_COLOURS[i], quadrant_letters[i]);
    }
    x = canvas_text(&v->canvas, x, y, v->word_scale, ELLIPSE_COLOUR, " ellipse");
    x = canvas_text(&v->canvas, x, y, v->word_scale, INNER_COLOUR, " inner centre");
    x = canvas_text(&v->canvas, x, y, v->word_scale, AXIS_COLOUR, " axis");
    (void)canvas_text(&v->canvas, x, y, v->word_scale, REGION_COLOUR, " region");
}

static void put_words(view *v, const measurement *m, const char *state)
{
    const drogue_result *r = m->result;
    char line[128], x[DECIMAL_TEXT], y[DECIMAL_TEXT], z[DECIMAL_TEXT];
    snprintf(line, sizeof line, "%s%sstatus %s", state != NULL ? state : "", state != NULL ? ", " : "",
             measurement_status(m));
    put_line(v, 0, line);
    put_legend(v, WORD_LINES - 1);
    if (r->ellipse.a_px_q16 > 0) {
        decimal_format_q16(x, r->quality.reliability_q16, 3);
        snprintf(line, sizeof line, "reliability %s, %s inside", x,
                 r->polarity == DROGUE_POLARITY_DARK     ? "dark"
                 : r->polarity == DROGUE_POLARITY_BRIGHT ? "bright"
                                                         : "dark and bright");
        put_line(v, 1, line);
    }
    if (!measurement_known(m)) {
        return;
    }
    decimal_format_q16(x, r->pose.position_m_q16[0], 3);
    decimal_format_q16(y, r->pose.position_m_q16[1], 3);
    decimal_format_q16(z, r->pose.position_m_q16[2], 3);
    snprintf(line, sizeof line, "position %s, %s, %s %s", x, y, z, m->length_unit);
    put_line(v, 2, line);
    decimal_format_degrees(x, r->pose.yaw_rad_q16, 2);
    decimal_format_degrees(y, r->pose.pitch_rad_q16, 2);
    snprintf(line, sizeof line, "yaw %s, pitch %s degrees", x, y);
    put_line(v, 3, line);
    put_line(v, 4, r->orientation_resolved ? "orientation resolved" : "orientation unresolved: either of two");
}

int overlay_write(const char *path, const options *o, const picture *grey, const drogue_region *region,
                  const drogue_workspace *workspace, const measurement *m, const char *state)
{
    const drogue_result *result = m->result;
    view v;
    int code;
    choose_part(&v, grey, region);
    if (make_canvas(&v, path, grey)) {
        return EXIT_BAD;
    }
    draw_edges(&v, result, workspace);
    draw_region(&v, region);
    draw_arcs(&v, result, workspace);
    if (result->ellipse.a_px_q16 > 0) {
        draw_ellipse(&v, &result->ellipse);
    }
    if (measurement_known(m)) {
        if (!result->orientation_resolved) {
            draw_axis(&v, &result->alternative, o, TWIN_COLOUR);
        }
        draw_axis(&v, &result->pose, o, AXIS_COLOUR);
    }
    if (result->has_inner) {
        draw_cross(&v, result->inner.x_px_q16, result->inner.y_px_q16, INNER_COLOUR);
    }
    /* Lines that left the image must not cross the words. */
    canvas_fill(&v.canvas, 0, v.height_px * v.scale, v.canvas.width_px, v.canvas.height_px, BAND_COLOUR, 256);
    put_words(&v, m, state);
    code = picture_write(&v.canvas, path);
    picture_free(&v.canvas);
    return code;
}
