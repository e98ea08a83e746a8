/* SPDX-License-Identifier: Apache-2.0 */
/* What the fuzz targets share: numbers and scenes from bytes, and the properties that every result has. */
#ifndef DROGUE_TESTS_FUZZ_H
#define DROGUE_TESTS_FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "drogue/drogue.h"
#include "drogue/search.h"

/* libFuzzer calls this; 0 always. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A property that does not hold ends the run. */
#define FUZZ_MUST(condition) \
    ((condition) ? (void)0 : fuzz_fail(__FILE__ ": a property does not hold: " #condition, __LINE__))
void fuzz_fail(const char *what, int line);

/* Bytes not used up yet; beyond the last they are 0. */
typedef struct fuzz_bytes {
    const uint8_t *at;
    size_t left;
} fuzz_bytes;

uint8_t fuzz_byte(fuzz_bytes *b);
int32_t fuzz_any(fuzz_bytes *b);                              /* any 32 bits, small and extreme ones as often */
int32_t fuzz_range(fuzz_bytes *b, int32_t low, int32_t high); /* both included */

/* Camera, model, valid thresholds, an image in a block of its own, with a drogue in it or noise. */
typedef struct fuzz_scene {
    drogue_camera camera;
    drogue_model model;
    drogue_config config;
    drogue_setup setup;
    uint8_t *pixels;
    drogue_image image;
    drogue_region region; /* a usual or any one */
    int32_t radius_px;    /* of the drogue drawn */
} fuzz_scene;

/* Sides up to 'most_px'. Free with fuzz_scene_free(). */
void fuzz_scene_make(fuzz_scene *s, fuzz_bytes *b, int32_t most_px);
void fuzz_scene_draw(fuzz_scene *s, fuzz_bytes *b); /* the next frame of it */
void fuzz_scene_free(fuzz_scene *s);

/* A workspace in a block of its own, every byte of which is 'fill'. */
typedef struct fuzz_workspace {
    drogue_workspace workspace;
    uint32_t *memory;
} fuzz_workspace;
fuzz_workspace fuzz_workspace_make(const drogue_capacity *capacity, uint8_t fill);
drogue_capacity fuzz_capacity(fuzz_bytes *b, int32_t width_px);

/* What holds for every result, see docs/security.md. */
void fuzz_check_result(const drogue_result *r, const drogue_region *asked, const drogue_image *image);

/* Does the status, or what became of the second look, say that room was short? */
int fuzz_short_of_room(const drogue_result *r);

void *fuzz_alloc(size_t bytes);

#endif
