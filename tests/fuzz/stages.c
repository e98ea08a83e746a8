/* SPDX-License-Identifier: Apache-2.0 */
/* Each stage alone, through the adapters of the golden vectors, which refuse what is out of a stage's range and notice what
 * is written behind a buffer. Twice: the answer must not depend on what memory held. */
#include "fuzz.h"

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
};

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

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    static int64_t first[1 << 15];
    fuzz_bytes b = {bytes, size};
    conf_array in[CONF_MAX_INPUTS], out[CONF_MAX_OUTPUTS];
    const size_t which = fuzz_byte(&b) % (sizeof stages / sizeof stages[0]);
    int inputs, count, again, i;
    size_t k, at = 0;
    for (inputs = 0; inputs < CONF_MAX_INPUTS && stages[which].in[inputs].name != NULL; inputs++) {
        in[inputs] = input_of(&stages[which].in[inputs], data[inputs], &b);
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
