/* SPDX-License-Identifier: Apache-2.0 */
/* A larger outline along rays, which the edge detector does not tell: the outer edge of a lip some pixels wide, or one
 * whose step is too low, which so many pixels together show. */
#include "drogue/frontend.h"
#include "drogue/inner.h"
#include "drogue/noise.h"

#include "fit.h"

#define LEAST 10 /* grey levels, of which blur may leave half as a slope; and a quarter of what is noise in Sobel's */
#define LEAST_LINE 16 /* the same of a lip's edge, of which samples so near leave a quarter; and half of that noise */
#define LEAST_ALONG 8 /* of an edge that many rays together have shown; and three quarters of that noise */
#define ALONG DROGUE_Q16(2, 1)     /* px: in place of what is beyond, for a look about a place */
#define WITHIN DROGUE_Q16(3, 4)    /* px: what agrees */
#define ENOUGH (7 * RAYS / 16)     /* rays that agree */
#define ENOUGH_LINE (3 * RAYS / 4) /* the same, to a lip's edge */
#define LARGEST DROGUE_Q16(180, 1) /* px: of a larger one the points would cover too little */
#define PHASES 8                   /* all that there are */
#define PARTS 8                    /* of the outline, of which all but two must have some */
#define HALF DROGUE_Q16(1, 2)      /* px between samples */
#define STEEP_Q2 7                 /* the front end's gradient over the grey 1/2 and 1 px to either side, their sum */

static drogue_q16 reach_of(drogue_q16 beyond_px_q16) { return drogue_q16_add(beyond_px_q16 / 8 * 5, DROGUE_Q16_ONE); }

/* Do enough rays agree, all about? */
static int all_about(const drogue_ray rays[RAYS], const drogue_q16 v_px_q16[3], uint32_t enough)
{
    uint32_t seen = 0;
    uint32_t parts = 0;
    uint32_t agree = 0;
    int32_t k;
    for (k = 0; k < RAYS; k++) {
        if (drogue_ray_chosen(&rays[k], drogue_ray_along(&rays[k], v_px_q16), WITHIN) >= 0) {
            seen |= 1u << (k / (RAYS / PARTS));
            agree++;
        }
    }
    for (k = 0; k < PARTS; k++) {
        parts += seen >> k & 1u;
    }
    return parts >= PARTS - 2 && agree >= enough;
}

static inline int16_t gradient_of(int32_t n_q14, int32_t grey_q8)
{
    return (int16_t)drogue_shr_round_s64(drogue_product(n_q14, grey_q8 * STEEP_Q2), 24);
}

/* A ray's edge as an edge point; 0 when it is outside the region. */
static int put_point(drogue_edge *out, drogue_ray *r, const drogue_ray_edge *e, const drogue_image *view)
{
    const int32_t x = r->x_px_q16 + drogue_ray_part(r->nx_q14, e->at_px_q16);
    const int32_t y = r->y_px_q16 + drogue_ray_part(r->ny_q14, e->at_px_q16);
    int32_t grey_q8[5];
    int32_t rise_q8;
    if (x < 0 || y < 0 || x >> 16 >= view->width_px - 1 || y >> 16 >= view->height_px - 1) {
        return 0;
    }
    r->step_px_q16 = HALF;
    drogue_ray_read(grey_q8, r, view, e->at_px_q16 - 2 * HALF, 5);
    rise_q8 = grey_q8[4] + grey_q8[3] - grey_q8[1] - grey_q8[0];
    out->arc = DROGUE_NO_ARC;
    out->x_q5 = (uint16_t)((x + 1024) >> 11);
    out->y_q5 = (uint16_t)((y + 1024) >> 11);
    out->gx = gradient_of(r->nx_q14, rise_q8);
    out->gy = gradient_of(r->ny_q14, rise_q8);
    return 1;
}

/* Edges on rays about an ellipse, without what belongs to the one within. */
static void cast(drogue_ray rays[RAYS], const drogue_image *view, const drogue_ellipse *about, drogue_q16 beyond_px_q16,
                 int32_t phase, drogue_ray_look look, int32_t least)
{
    drogue_rays_cast(rays, view, about, reach_of(beyond_px_q16), phase, 1, least, look);
    drogue_rays_keep(rays, NULL, -(beyond_px_q16 / 2), DROGUE_Q16_MAX);
}

/* Do the edges that are looked for make an outline, and how far off is it? */
static int settle(drogue_q16 v_px_q16[3], drogue_ray rays[RAYS], const drogue_image *view, const drogue_ellipse *about,
                  drogue_q16 beyond_px_q16, drogue_ray_look look, int32_t least)
{
    drogue_ray_sums sums;
    v_px_q16[0] = v_px_q16[1] = v_px_q16[2] = 0;
    cast(rays, view, about, beyond_px_q16, 4, look, least);
    return drogue_ray_sums_settle(&sums, v_px_q16, rays, reach_of(beyond_px_q16), WITHIN, 1) &&
           all_about(rays, v_px_q16, look == DROGUE_RAY_LINES ? ENOUGH_LINE : ENOUGH);
}

/* Of the edges on rays in all phases write those that an offset from the ellipse puts them to. */
static uint32_t put_points(const drogue_workspace *workspace, const drogue_image *view, const drogue_ellipse *about,
                           const drogue_q16 v_px_q16[3], drogue_q16 beyond_px_q16, drogue_ray_look look, int32_t least)
{
    drogue_ray *const rays = workspace->rays;
    uint32_t count = 0;
    int32_t phase;
    int32_t k;
    for (phase = 0; phase < PHASES; phase++) {
        cast(rays, view, about, beyond_px_q16, phase, look, least);
        for (k = 0; k < RAYS && count < workspace->capacity.edges && count < DROGUE_INNER_BEYOND_POINTS; k++) {
            const int32_t which = drogue_ray_chosen(&rays[k], drogue_ray_along(&rays[k], v_px_q16), WITHIN);
            if (which >= 0) {
                count += (uint32_t)put_point(&workspace->edges[count], &rays[k], &rays[k].edges[which], view);
            }
        }
    }
    return count;
}

/* Is it large enough for rays, and small enough for their points to show its parts? */
static int is_of_size(const drogue_ellipse *about)
{
    return about->b_px_q16 >= DROGUE_Q16_ONE && about->a_px_q16 <= LARGEST;
}

uint32_t drogue_inner_beyond(const drogue_workspace *workspace, const drogue_image *view, const drogue_ellipse *about,
                             drogue_q16 beyond_px_q16)
{
    drogue_ray *const rays = workspace->rays;
    drogue_ray_look look = DROGUE_RAY_LINES;
    drogue_q16 v_px_q16[3];
    int32_t noise;
    int32_t least;
    if (!is_of_size(about)) {
        return 0;
    }
    noise = drogue_noise_threshold(workspace->histogram, view);
    least = larger(LEAST_LINE, noise / 2);
    while (!settle(v_px_q16, rays, view, about, beyond_px_q16, look, least)) { /* bound: 2 */
        if (look == DROGUE_RAY_STEPS) {
            return 0;
        }
        look = DROGUE_RAY_STEPS;
        least = larger(LEAST, noise / 4);
    }
    return put_points(workspace, view, about, v_px_q16, beyond_px_q16, look, least);
}

uint32_t drogue_inner_along(const drogue_workspace *workspace, const drogue_image *view, const drogue_ellipse *about)
{
    const drogue_q16 there[3] = {0, 0, 0};
    if (!is_of_size(about)) {
        return 0;
    }
    return put_points(workspace, view, about, there, ALONG, DROGUE_RAY_LINES,
                      larger(LEAST_ALONG, 3 * drogue_noise_threshold(workspace->histogram, view) / 4));
}
