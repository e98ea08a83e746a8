/* SPDX-License-Identifier: Apache-2.0 */
/* One frame: the result's properties, a dirty workspace, more room, a shift by whole pixels with another surround. */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

#include "drogue/undistort.h"

static drogue_result measured(const fuzz_scene *s, const drogue_image *image, const drogue_setup *setup,
                              const drogue_region *region, const drogue_capacity *capacity, uint8_t fill)
{
    fuzz_workspace w = fuzz_workspace_make(capacity, fill);
    drogue_result r;
    uint32_t i;
    (void)s;
    memset(&r, fill, sizeof r);
    FUZZ_MUST(drogue_measure(&r, &w.workspace, setup, image, region) == r.status);
    for (i = 0; i < r.list.edge_count; i++) { /* of the region that the result names, pose or not */
        FUZZ_MUST(w.workspace.edges[i].x_q5 < r.region.width_px * 32);
        FUZZ_MUST(w.workspace.edges[i].y_q5 < r.region.height_px * 32);
    }
    fuzz_check_result(&r, region, image);
    free(w.memory);
    return r;
}

/* Room for three times as much in one table alone. */
static void widen(drogue_capacity *capacity, int which)
{
    uint32_t *const tables[4] = {&capacity->width_px, &capacity->edges, &capacity->labels, &capacity->arcs};
    *tables[which] *= 3;
}

/* The image within a larger one, of other pixels all around it: the same pose, and the outline where it went. Five
 * quarters of the region, which are tried, too, are the image. */
static void shifted(const fuzz_scene *s, fuzz_bytes *b, const drogue_capacity *capacity, uint8_t around)
{
    const drogue_image *image = &s->image;
    const int32_t x = fuzz_range(b, 0, 9), y = fuzz_range(b, 0, 9);
    drogue_model model = *s->setup.model;
    const drogue_region region = {image->width_px / 10, image->height_px / 10, image->width_px * 4 / 5,
                                  image->height_px * 4 / 5};
    drogue_region moved = region;
    drogue_config config = s->config;
    drogue_camera camera = s->camera;
    drogue_setup setup = s->setup;
    drogue_image larger = *image;
    drogue_result here, there;
    uint8_t *pixels;
    int32_t row;
    config.recentre_cover_q16 = 0; /* a second look may reach past the region */
    setup.config = &config;
    here = measured(s, image, &setup, &region, capacity, 1);
    if (here.status != DROGUE_OK || !here.has_inner || here.doubt_q16 > DROGUE_Q16(1, 64) ||
        here.tried >= DROGUE_TRIED_RAYS) {
        model.inner_radius_m_q16 = 0; /* so may the region about a disc, which is looked for where none is believed */
        setup.model = &model;
        here = measured(s, image, &setup, &region, capacity, 1);
    }
    larger.width_px = larger.stride = image->width_px + 2 * x + 1;
    larger.height_px = image->height_px + 2 * y + 1;
    pixels = fuzz_alloc((size_t)larger.stride * (size_t)larger.height_px);
    memset(pixels, around, (size_t)larger.stride * (size_t)larger.height_px);
    for (row = 0; row < image->height_px; row++) {
        memcpy(pixels + (size_t)(row + y) * (size_t)larger.stride + x,
               image->data + (size_t)row * (size_t)image->stride, (size_t)image->width_px);
    }
    larger.data = pixels;
    moved.x_px += x;
    moved.y_px += y;
    camera.cx_px_q16 += x * 65536;
    camera.cy_px_q16 += y * 65536;
    setup.camera = &camera;
    there = measured(s, &larger, &setup, &moved, capacity, 2);
    FUZZ_MUST(here.status == there.status && here.second_look == there.second_look);
    FUZZ_MUST(here.ellipse.a_px_q16 == there.ellipse.a_px_q16 && here.ellipse.b_px_q16 == there.ellipse.b_px_q16);
    FUZZ_MUST(here.ellipse.a_px_q16 == 0 || here.ellipse.xc_px_q16 + x * 65536 == there.ellipse.xc_px_q16);
    FUZZ_MUST(here.ellipse.a_px_q16 == 0 || here.ellipse.yc_px_q16 + y * 65536 == there.ellipse.yc_px_q16);
    FUZZ_MUST(memcmp(&here.pose, &there.pose, sizeof here.pose) == 0);
    FUZZ_MUST(memcmp(here.covariance_q48, there.covariance_q48, sizeof here.covariance_q48) == 0);
    free(pixels);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_bytes b = {data, size};
    fuzz_scene s;
    drogue_capacity capacity, more, one;
    drogue_result clean, dirty, roomy;
    int k;
    fuzz_scene_make(&s, &b, 160);
    capacity = fuzz_capacity(&b, 160);
    more = capacity;
    more.width_px *= 4;
    more.edges *= 4;
    more.labels *= 4;
    more.arcs *= 4;
    clean = measured(&s, &s.image, &s.setup, &s.region, &capacity, 0);
    dirty = measured(&s, &s.image, &s.setup, &s.region, &capacity, 0xA5);
    FUZZ_MUST(memcmp(&clean, &dirty, sizeof clean) == 0);
    roomy = measured(&s, &s.image, &s.setup, &s.region, &more, 0x5A);
    FUZZ_MUST(fuzz_short_of_room(&clean) || memcmp(&clean, &roomy, sizeof clean) == 0);
    for (k = 0; k < 4 && !fuzz_short_of_room(&clean); k++) {
        one = capacity;
        widen(&one, k);
        roomy = measured(&s, &s.image, &s.setup, &s.region, &one, 0x33);
        FUZZ_MUST(memcmp(&clean, &roomy, sizeof clean) == 0);
    }
    if (fuzz_byte(&b) % 4 == 0 && !drogue_camera_distorts(&s.camera) && labs((long)s.camera.cx_px_q16) < 1L << 28 &&
        labs((long)s.camera.cy_px_q16) < 1L << 28) {
        shifted(&s, &b, &more, fuzz_byte(&b));
    }
    fuzz_scene_free(&s);
    return 0;
}
