/* SPDX-License-Identifier: Apache-2.0 */
/* Each stage alone, through the adapters of the golden vectors, which refuse what is out of a stage's range and notice what
 * is written behind a buffer. Twice: the answer must not depend on what memory held. */
#include "fuzz.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "stages.h"

typedef struct input {
    const char *name;
    int bits; /* 0: an image */
    int words;
    int repeat; /* any number of times so many words */
} input;

static const struct {
    const char *stage;
    input in[CONF_MAX_INPUTS];
} stages[] = {
    {"smooth", {{"image", 0, 0, 0}}},
    {"gradient", {{"image", 0, 0, 0}}},
    {"canny", {{"image", 0, 0, 0}, {"params", 32, 3, 0}}},
    {"mask", {{"params", 32, 5, 0}}},
    {"arcs", {{"image", 0, 0, 0}, {"params", 32, 8, 0}}},
    {"constraints", {{"points", 16, 2, 1}, {"params", 32, 5, 0}}},
    {"ellipse", {{"points", 16, 2, 1}, {"params", 32, 1, 0}}},
    {"quality", {{"ellipse", 32, 5, 0}, {"points", 32, 2, 1}, {"params", 32, 3, 0}}},
    {"support", {{"ellipse", 32, 5, 0}, {"edges", 32, 4, 1}, {"params", 32, 4, 0}}},
    {"cluster", {{"candidates", 32, 7, 1}, {"config", 32, 5, 0}}},
    {"eigen", {{"matrix", 64, 6, 0}}},
    {"undistort", {{"camera", 32, 9, 0}, {"points", 32, 2, 1}}},
    {"pose", {{"ellipse", 32, 5, 0}, {"camera", 32, 9, 0}, {"params", 32, 4, 0}}},
    {"joint", {{"ellipse", 32, 5, 0}, {"camera", 32, 9, 0}, {"bins", 32, 64, 0}, {"params", 32, 15, 0}}},
    {"kalman", {{"params", 32, 26, 0}, {"frames", 32, 10, 1}}},
    {"decide", {{"ellipse", 32, 5, 0}, {"camera", 32, 9, 0}, {"bins", 32, 64, 0}, {"params", 32, 31, 0}}},
    {"rim", {{"image", 0, 0, 0}, {"disc", 32, 4, 0}}},
    {"search", {{"image", 0, 0, 0}, {"params", 32, 1, 0}}},
};
enum { STAGES = sizeof stages / sizeof stages[0], OLDER = 15 /* which kept inputs name by their first byte */ };

enum { MOST_WORDS = 160, SIDE = 48 };

static int64_t data[CONF_MAX_INPUTS][MOST_WORDS + SIDE * SIDE / 8];

static conf_array input_of(const input *spec, int64_t *to, fuzz_bytes *b)
{
    conf_array a = {spec->name, spec->bits, 0, to, 0, 0};
    size_t i;
    if (spec->bits == 0) {
        a.bits = 8;
        a.width_px = fuzz_range(b, 1, SIDE);
        a.height_px = fuzz_range(b, 1, SIDE);
        a.count = (size_t)a.width_px * (size_t)a.height_px;
        for (i = 0; i < a.count; i++) {
            ((uint8_t *)to)[i] = b->left > 0 ? fuzz_byte(b) : (uint8_t)(i * i / 7);
        }
        return a;
    }
    a.count = (size_t)spec->words * (spec->repeat ? (size_t)fuzz_range(b, 0, 14) : 1);
    for (i = 0; i < a.count; i++) {
        switch (spec->bits) {
        case 16: ((int16_t *)to)[i] = (int16_t)fuzz_any(b); break;
        case 32: ((int32_t *)to)[i] = fuzz_any(b); break;
        default: to[i] = ((int64_t)fuzz_any(b) * 65536 * 4096) + fuzz_any(b); break;
        }
    }
    return a;
}

/* Most of what any words make the adapters refuse, so seldom that these are left as they are. */
static int left_as_it_is(fuzz_bytes *b) { return fuzz_byte(b) % 16 == 15; }

/* Data of 'decide' that a frame could give: an outline, its support, two poses, a place of the inner part. */
static void make_evidence(fuzz_bytes *b)
{
    int32_t *e = (int32_t *)data[0], *camera = (int32_t *)data[1], *bins = (int32_t *)data[2], *p = (int32_t *)data[3];
    int k;
    if (left_as_it_is(b)) {
        return;
    }
    e[2] = 65536 * fuzz_range(b, 1, 1023) + fuzz_byte(b);
    e[3] = (int32_t)((int64_t)e[2] * fuzz_range(b, 1, 255) / 255);
    e[3] = e[3] < 65536 ? 65536 : e[3];
    e[4] = fuzz_range(b, -102943, 102943);
    for (k = 0; k < 9; k++) { /* any lens, or none */
        camera[k] = k < 2 ? 65536 * fuzz_range(b, 1, 4000) : k < 4 ? camera[k] >> 4 : camera[k] >> 8;
    }
    for (k = 0; k < 32; k++) {
        bins[2 * k] = fuzz_range(b, 0, 99);
        bins[2 * k + 1] = fuzz_range(b, -65536, 65536) * (bins[2 * k] > 0);
    }
    p[0] = fuzz_range(b, 655, 1 << 20);
    p[1] = p[0] / 256 * fuzz_byte(b);
    p[2] &= INT32_MAX;
    for (k = 0; k < 2; k++) { /* the pose in front of the camera, its axis of length 1, angles of it */
        int32_t *pose = p + 3 + 8 * k;
        const int32_t z = fuzz_range(b, 20000, 65536), x = (int32_t)sqrt(65536.0 * 65536.0 - (double)z * z);
        pose[0] >>= 8;
        pose[1] >>= 8;
        pose[2] = fuzz_range(b, 1, 1 << 24);
        pose[3] = k ? -x : x;
        pose[4] = 0;
        pose[5] = z;
        pose[6] = (int32_t)(65536 * atan2(pose[3], z));
        pose[7] = 0;
    }
    for (k = 22; k < 31; k++) {
        p[k] &= INT32_MAX;
    }
    p[23] = fuzz_range(b, 1, 1024 << 16);
    p[24] = fuzz_range(b, 0, 16 << 16);
    p[27] = fuzz_range(b, 0, 1 << 20);
    p[28] %= 65536;
    p[30] %= 9;
}

static void make_disc(const conf_array *image, fuzz_bytes *b)
{
    int32_t *disc = (int32_t *)data[1];
    if (!left_as_it_is(b)) {
        disc[0] = fuzz_range(b, 0, image->width_px - 1);
        disc[1] = fuzz_range(b, 0, image->height_px - 1);
        disc[2] = fuzz_range(b, 1, 16 * DROGUE_SEARCH_REACH);
        disc[3] = fuzz_byte(b);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static int64_t first[1 << 15];
    fuzz_bytes b = {bytes, size};
    conf_array in[CONF_MAX_INPUTS], out[CONF_MAX_OUTPUTS];
    const uint8_t first_byte = fuzz_byte(&b);
    const size_t which = first_byte < 195 ? first_byte % OLDER : OLDER + first_byte % (STAGES - OLDER);
    int inputs, count, again, i;
    size_t k, at = 0;
    for (inputs = 0; inputs < CONF_MAX_INPUTS && stages[which].in[inputs].name != NULL; inputs++) {
        in[inputs] = input_of(&stages[which].in[inputs], data[inputs], &b);
    }
    if (strcmp(stages[which].stage, "decide") == 0) {
        make_evidence(&b);
    } else if (strcmp(stages[which].stage, "rim") == 0) {
        make_disc(&in[0], &b);
    }
    count = conf_run_stage(stages[which].stage, in, inputs, out, CONF_MAX_OUTPUTS);
    if (strcmp(stages[which].stage, "mask") == 0 && count == CONF_E_MEMORY) {
        return 0; /* one of up to 2048 px a side is drawn */
    }
    FUZZ_MUST(count > 0 || count == CONF_E_MALFORMED);
    for (i = 0; i < count; i++) {
        for (k = 0; k < out[i].count && at < sizeof first / sizeof first[0]; k++) {
            first[at++] = conf_word(&out[i], k);
        }
    }
    again = conf_run_stage(stages[which].stage, in, inputs, out, CONF_MAX_OUTPUTS);
    FUZZ_MUST(again == count);
    at = 0;
    for (i = 0; i < count; i++) {
        for (k = 0; k < out[i].count && at < sizeof first / sizeof first[0]; k++) {
            FUZZ_MUST(first[at++] == conf_word(&out[i], k));
        }
    }
    return 0;
}
