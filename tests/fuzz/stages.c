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

/* Data of 'decide' that a frame could give: an outline, its support, the two poses of it, a place of the inner part. */
static void make_evidence(fuzz_bytes *b)
{
    int32_t *e = (int32_t *)data[0], *camera = (int32_t *)data[1], *bins = (int32_t *)data[2], *p = (int32_t *)data[3];
    const int32_t f = fuzz_range(b, 50, 4000), a = fuzz_range(b, 2, 1000), count = fuzz_range(b, 0, 60);
    const int32_t rim = fuzz_range(b, 655, 1 << 20), spread = fuzz_range(b, 0, 65535), lens = fuzz_byte(b);
    uint32_t seed = fuzz_byte(b);
    int k;
    memset(camera, 0, 9 * sizeof *camera);
    camera[0] = camera[1] = f * 65536;
    for (k = 4; k < 9 && lens % 4 == 3; k++) {
        camera[k] = fuzz_any(b) >> 8 >> lens / 16;
    }
    e[0] = fuzz_range(b, -500 * 65536, 500 * 65536);
    e[1] = fuzz_range(b, -500 * 65536, 500 * 65536);
    e[2] = a * 65536;
    e[3] = e[2] - (int32_t)((int64_t)(e[2] - 65536) * fuzz_byte(b) / 256);
    e[4] = fuzz_range(b, -102943, 102943);
    for (k = 0; k < 32; k++) {
        seed = seed * 1664525u + 1013904223u;
        bins[2 * k] = count;
        bins[2 * k + 1] = count > 0 ? (int32_t)(seed >> 8) % (spread + 1) - spread / 2 : 0;
    }
    memset(p, 0, 31 * sizeof *p);
    p[0] = rim;
    p[1] = (int32_t)((int64_t)rim * fuzz_byte(b) / 256);
    p[2] = (int32_t)((int64_t)rim * fuzz_byte(b) / 128);
    for (k = 0; k < 2; k++) { /* axis of length 1, angles of it; off what the outline says, at times */
        const double distance = (double)rim * f / a, c = e[3] / (double)e[2], s = (k ? -1 : 1) * sqrt(1 - c * c);
        int32_t *pose = p + 3 + 8 * k;
        pose[2] = distance < 1 ? 1 : distance > 1e9 ? 1000000000 : (int32_t)distance;
        pose[0] = (int32_t)(pose[2] / 65536.0 / f * e[0]);
        pose[1] = (int32_t)(pose[2] / 65536.0 / f * e[1]);
        pose[3] = (int32_t)(65536 * s);
        pose[5] = (int32_t)(65536 * c);
        pose[6] = (int32_t)(65536 * atan2(s, c));
    }
    p[19] = fuzz_range(b, 0, 1);
    p[20] = e[0] + fuzz_range(b, -8 * 65536, 8 * 65536);
    p[21] = e[1] + fuzz_range(b, -8 * 65536, 8 * 65536);
    p[22] = fuzz_range(b, 1, 65536);
    p[23] = fuzz_range(b, 1, 1024 * 65536);
    p[24] = fuzz_range(b, 0, 16 * 65536);
    p[25] = fuzz_range(b, 0, INT32_MAX);
    p[26] = fuzz_range(b, 0, INT32_MAX);
    p[27] = fuzz_range(b, 0, 1 << 20);
    p[28] = fuzz_range(b, 0, 65535);
    p[29] = fuzz_range(b, 0, 65535);
    p[30] = fuzz_range(b, 0, 8);
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
    fuzz_bytes none = {bytes, 0};
    int inputs, count, again, made, i;
    size_t k, at = 0;
    made = strcmp(stages[which].stage, "decide") == 0 && !left_as_it_is(&b);
    for (inputs = 0; inputs < CONF_MAX_INPUTS && stages[which].in[inputs].name != NULL; inputs++) {
        in[inputs] = input_of(&stages[which].in[inputs], data[inputs], made ? &none : &b);
    }
    if (made) {
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
