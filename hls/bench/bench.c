/* SPDX-License-Identifier: Apache-2.0 */
#include "bench.h"

#include "case_words.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "drogue/measure.h"

enum { MOST_FAILURES = 100 }; /* an exit status holds 8 bits */

void bench_begin(bench *b, const char *name)
{
    memset(b, 0, sizeof *b);
    b->name = name;
}

static void end_case(bench *b)
{
    if (b->open == NULL) {
        return;
    }
    if (b->skipped && !b->off) {
        b->cases--;
        b->skips++;
    } else {
        printf("%-7s %s\n", b->off ? "FAILED" : "ok", b->open->id);
        b->failed += b->off ? 1u : 0u;
    }
    b->open = NULL;
}

const conf_case *bench_next(bench *b, const char *stage)
{
    end_case(b);
    for (; b->list < conf_case_list_count; b->list++, b->index = 0) {
        while (b->index < conf_case_lists[b->list].count) {
            const conf_case *c = &conf_case_lists[b->list].cases[b->index++];
            if (strcmp(c->stage, stage) == 0) {
                b->open = c;
                b->off = b->skipped = 0;
                b->cases++;
                return c;
            }
        }
    }
    b->list = b->index = 0; /* for another stage */
    return NULL;
}

void bench_skip(bench *b, const char *why)
{
    b->skipped = 1;
    printf("SKIPPED %s: %s\n", b->open->id, why);
}

int bench_end(bench *b)
{
    end_case(b);
    printf("%s: cases=%u failed=%u skipped=%u\n", b->name, b->cases, b->failed, b->skips);
    if (b->cases == 0) {
        return 1;
    }
    return b->failed < MOST_FAILURES ? (int)b->failed : MOST_FAILURES;
}

static const char *id(const bench *b) { return b->open != NULL ? b->open->id : b->name; }

/* Between cases a failure counts at once. */
static void miss(bench *b)
{
    b->off = 1;
    b->failed += b->open == NULL ? 1u : 0u;
}

int bench_check(bench *b, const char *what, int holds)
{
    if (!holds) {
        printf("%s: %s: does not hold\n", id(b), what);
        miss(b);
    }
    return holds;
}

int bench_word(bench *b, const char *what, int64_t found, int64_t expected)
{
    if (found != expected) {
        printf("%s: %s: %" PRId64 " instead of %" PRId64 "\n", id(b), what, found, expected);
        miss(b);
    }
    return found == expected;
}

int bench_words(bench *b, const char *what, const void *found, const conf_array *expected)
{
    conf_array own;
    size_t i;
    if (expected == NULL) {
        return bench_check(b, what, 0);
    }
    own = *expected;
    own.data = found;
    for (i = 0; i < own.count && conf_word(&own, i) == conf_word(expected, i); i++) {}
    if (i == own.count) {
        return 1;
    }
    printf("%s: %s: word %lu: %" PRId64 " instead of %" PRId64 "\n", id(b), what, (unsigned long)i, conf_word(&own, i),
           conf_word(expected, i));
    miss(b);
    return 0;
}

const conf_array *bench_input(const conf_case *c, const char *name)
{
    int i;
    for (i = 0; i < c->input_count; i++) {
        if (strcmp(c->inputs[i].name, name) == 0) {
            return &c->inputs[i];
        }
    }
    return NULL;
}

const conf_array *bench_expected(const conf_case *c, const char *name)
{
    int i;
    for (i = 0; i < c->exact_count; i++) {
        if (strcmp(c->exact[i].array.name, name) == 0) {
            return &c->exact[i].array;
        }
    }
    return NULL;
}

drogue_image bench_image(const conf_case *c)
{
    const conf_array *a = bench_input(c, "image");
    drogue_image image;
    image.data = (const uint8_t *)a->data;
    image.width_px = a->width_px;
    image.height_px = a->height_px;
    image.stride = a->width_px;
    return image;
}

drogue_camera bench_camera(const conf_case *c) { return conf_camera(bench_words32(bench_input(c, "camera"))); }

drogue_model bench_model(const conf_case *c) { return conf_model(bench_words32(bench_input(c, "model"))); }

drogue_region bench_region(const conf_case *c) { return conf_region(bench_words32(bench_input(c, "region"))); }

drogue_config bench_config(const conf_case *c)
{
    const conf_array *moved = bench_input(c, "config");
    drogue_config config;
    drogue_config_default(&config);
    if (moved != NULL) {
        conf_config_take(&config, bench_words32(moved));
    }
    return config;
}

int bench_place(drogue_region *part, drogue_mask *mask, const drogue_image *image, const drogue_region *region)
{
    *part = *region;
    if (region->width_px < 1 || region->height_px < 1 || region->width_px > DROGUE_MAX_REGION ||
        region->height_px > DROGUE_MAX_REGION) {
        return 0;
    }
    drogue_clip(&part->x_px, &part->width_px, image->width_px);
    drogue_clip(&part->y_px, &part->height_px, image->height_px);
    if (part->width_px < 1 || part->height_px < 1) {
        return 0;
    }
    *mask = drogue_mask_of_size(region->width_px, region->height_px);
    mask->centre2_x += 2 * (region->x_px - part->x_px);
    mask->centre2_y += 2 * (region->y_px - part->y_px);
    return 1;
}
