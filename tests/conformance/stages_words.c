/* SPDX-License-Identifier: Apache-2.0 */
/* The words of each output, and the bounds. A stage's own rounding is its base. What a case's conditioning adds comes from
 * the generator, which reckons it from the reference alone; beyond 'most' the word is undefined in that case. */
#include "stages_words.h"

#include <string.h>

/* A letter a word; behind '|' the letters repeat. '.': exact; '?': there is no reference. */
static const struct layout {
    const char *stage;
    const char *output;
    const char *words;
} layouts[] = {{"smooth", "image", "|."},
               {"gradient", "gx", "|."},
               {"gradient", "gy", "|."},
               {"canny", "map", "|."},
               {"mask", "ring", "|."},
               {"arcs", "arcs", "|."},
               {"arcs", "edges", "|."},
               {"constraints", "verdict", "pppp.."},
               {"constraints", "distance2", "d"},
               {"select", "choices", "|."},
               {"ellipse", "ellipse", ".ppppa"},
               {"quality", "quality", "rc|r"},
               {"quality", "status", "."},
               {"support", "summary", "|."},
               {"support", "bins", "|..s"},
               {"support", "members", "|."},
               {"support", "sums", "q."},
               {"cluster", "winner", ".."},
               {"eigen", "values", "vvv"},
               {"eigen", "vectors", "|d"},
               {"eigen", "full", "|?"},
               {"undistort", "undistorted", "|.pp"},
               {"undistort", "distorted", "|.pp"},
               {"pose", "pose", ".mmmrrrrrmmmrrrrr.ddx"},
               {"joint", "joint", ".mmmrrrrrk"},
               {"joint", "disc", ".ppppa"},
               {"joint", "covariance", "|v"},
               {"joint", "outline", "|o"},
               {"kalman", "states", "|k"},
               {"frame", "frame", ".ppppaiiiib....cc..smmmrrrrrmmmrrrrr.x"},
               {"frame", "detail", "..........qqqqq..h.."},
               {"frame", "covariance", "|v"},
               {"frame", "std", "|t"},
               {"decide", "decision", ".mmmrrrrrmmmrrrrr.."},
               {"decide", "covariance", "|v"},
               {"decide", "std", "|t"},
               {"look", "looked", "........ppppa.."},
               {"rim", "rims", ".|ppp."},
               {"search", "sightings", "|."},
               {"acquire", "found", ".......ppppammmrrrrr"},
               {"follow", "states", "|?"},
               {"follow", "estimates", "|?"},
               {"track", "states", "|."},
               {"track", "estimates", "|mmmvvvrrrrr."},
               {"track", "std", "|t"}};

/* clang-format off: a row a measure */
const conf_measure conf_measures[CONF_MEASURES] = {
    /* stage       letter name             unit      q   kind            base  most  undefined */
    {"constraints", 'p', "rectangle", "px", 16, CONF_LSB, 4, 4, NULL},
    {"constraints", 'd', "distance2", "itself", 32, CONF_OF_ITSELF, 1 << 20, 10, NULL},
    {"ellipse", 'p', "centre, axes", "px", 16, CONF_LSB, 4, 8, NULL},
    {"ellipse", 'a', "angle", "rad", 16, CONF_LSB, 4, 1024, "circle"},
    {"quality", 'r', "ratios", "1", 16, CONF_LSB, 4, 4, "domain"},
    {"quality", 'c', "circumference", "px", 16, CONF_LSB, 4, 4, "domain"},
    {"support", 's', "sum of a bin", "px", 16, CONF_LSB, 0, 16, NULL},
    {"support", 'q', "squares", "px^2", 32, CONF_LSB, 0, 1 << 18, NULL},
    {"eigen", 'v', "values", "1", 30, CONF_LSB, 4, 4, NULL},
    {"eigen", 'd', "vectors", "1", 30, CONF_LSB, 4, 4096, "free-vector"},
    {"undistort", 'p', "point", "px", 16, CONF_LSB, 4, 36, NULL},
    {"pose", 'm', "position", "m", 16, CONF_LSB, 4, 20, "ill-conditioned"},
    {"pose", 'r', "axis, angles", "rad", 16, CONF_LSB, 4, 20, "ill-conditioned"},
    {"pose", 'd', "distances", "px", 16, CONF_LSB, 8, 8, NULL},
    {"pose", 'x', "ambiguity", "1", 16, CONF_LSB, 8, 8, NULL},
    {"joint", 'm', "position", "m", 16, CONF_LSB, 4, 4, NULL},
    {"joint", 'r', "axis, angles", "rad", 16, CONF_LSB, 4, 4, NULL},
    {"joint", 'k', "chi2", "itself", 16, CONF_OF_ITSELF, 4, 62, NULL},
    {"joint", 'p', "inner disc", "px", 16, CONF_LSB, 4, 4, NULL},
    {"joint", 'a', "its angle", "rad", 16, CONF_LSB, 4, 1024, "circle"},
    {"joint", 'v', "covariance", "scale", 48, CONF_OF_SCALE, 4, 123, NULL},
    {"joint", 'o', "the outline's", "scale", 48, CONF_OF_SCALE, 4, 62, "ill-conditioned"},
    {"kalman", 'k', "states", "m, rad", 16, CONF_LSB, 16, 16, NULL},
    {"frame", 'p', "outline", "px", 16, CONF_LSB, 4, 4, NULL},
    {"frame", 'a', "its angle", "rad", 16, CONF_LSB, 4, 1024, "circle"},
    {"frame", 'i', "ideal outline", "px", 16, CONF_LSB, 4, 1024, NULL},
    {"frame", 'b', "its angle", "rad", 16, CONF_LSB, 4, 1024, "circle"},
    {"frame", 'c', "inner part", "px", 16, CONF_LSB, 4, 4, NULL},
    {"frame", 's', "its spread", "px", 16, CONF_LSB, 3, 3, NULL},
    {"frame", 'm', "position", "m", 16, CONF_LSB, 4, 512, NULL},
    {"frame", 'r', "axis, angles", "rad", 16, CONF_LSB, 4, 656, NULL},
    {"frame", 'x', "ambiguity", "1", 16, CONF_LSB, 0, 2048, "ill-conditioned"},
    {"frame", 'q', "quality", "1", 16, CONF_LSB, 4, 4, NULL},
    {"frame", 'h', "doubt", "1", 16, CONF_LSB, 4, 4, NULL},
    {"frame", 'v', "covariance", "scale", 48, CONF_OF_SCALE, 4, 15625, "ill-conditioned"},
    {"frame", 't', "std", "itself", 32, CONF_OF_ITSELF, 4, 7813, "ill-conditioned"},
    {"decide", 'm', "position", "m", 16, CONF_LSB, 2, 2, NULL},
    {"decide", 'r', "axis, angles", "rad", 16, CONF_LSB, 2, 2, NULL},
    {"decide", 'v', "covariance", "scale", 48, CONF_OF_SCALE, 4, 123, NULL},
    {"decide", 't', "std", "itself", 32, CONF_OF_ITSELF, 4, 123, NULL},
    {"look", 'p', "outline", "px", 16, CONF_LSB, 4, 4, NULL},
    {"look", 'a', "its angle", "rad", 16, CONF_LSB, 4, 1024, "circle"},
    {"rim", 'p', "circle", "cell", 4, CONF_LSB, 1, 1, NULL},
    {"acquire", 'p', "outline", "px", 16, CONF_LSB, 4, 4, NULL},
    {"acquire", 'a', "its angle", "rad", 16, CONF_LSB, 4, 1024, "circle"},
    {"acquire", 'm', "position", "m", 16, CONF_LSB, 4, 512, NULL},
    {"acquire", 'r', "axis, angles", "rad", 16, CONF_LSB, 4, 656, NULL},
    {"track", 'm', "position", "m", 16, CONF_LSB, 2, 2, NULL},
    {"track", 'v', "velocity", "m/s", 16, CONF_LSB, 8, 8, NULL},
    {"track", 'r', "axis, angles", "rad", 16, CONF_LSB, 2, 2, NULL},
    {"track", 't', "std", "m, rad", 32, CONF_LSB, 16384, 16384, NULL},
    {NULL, '.', "exact", "", 0, CONF_EXACT, 0, 0, NULL},
    {NULL, '?', "no reference", "", 0, CONF_UNREFERENCED, 0, 0, "no-reference"}};
/* clang-format on */

static const char *layout_of(const char *stage, const char *output)
{
    size_t k;
    for (k = 0; k < sizeof layouts / sizeof layouts[0]; k++) {
        if (strcmp(layouts[k].stage, stage) == 0 && strcmp(layouts[k].output, output) == 0) {
            return layouts[k].words;
        }
    }
    return NULL;
}

size_t conf_measure_period(size_t *before, const char *stage, const char *output)
{
    const char *layout = layout_of(stage, output);
    const char *bar = layout != NULL ? strchr(layout, '|') : NULL;
    *before = layout == NULL ? 0 : bar != NULL ? (size_t)(bar - layout) : strlen(layout);
    return bar != NULL ? strlen(bar + 1) : 0;
}

const conf_measure *conf_measure_of(const char *stage, const char *output, size_t i)
{
    const char *layout = layout_of(stage, output);
    size_t before;
    size_t period = conf_measure_period(&before, stage, output);
    size_t k;
    if (layout == NULL || (i >= before && period == 0)) {
        return NULL;
    }
    i = i < before ? i : before + 1 + (i - before) % period;
    for (k = 0; k < CONF_MEASURES; k++) {
        const conf_measure *m = &conf_measures[k];
        if (m->letter == layout[i] && (m->stage == NULL || strcmp(m->stage, stage) == 0)) {
            return m;
        }
    }
    return NULL;
}

static uint64_t size_of_word(int64_t word) { return word < 0 ? (uint64_t)0 - (uint64_t)word : (uint64_t)word; }

/* Root of a diagonal entry, rounded down. */
static uint64_t root(uint64_t v)
{
    uint64_t r = 0;
    int bit;
    for (bit = 31; bit >= 0; bit--) {
        uint64_t next = r | (uint64_t)1 << bit;
        r = next * next <= v ? next : r;
    }
    return r;
}

uint64_t conf_measure_whole(const conf_measure *m, const conf_array *words, size_t i)
{
    size_t row = 0;
    size_t column;
    switch (m->kind) {
    case CONF_OF_ITSELF: return size_of_word(conf_word(words, i));
    case CONF_OF_SCALE: break;
    default: return (uint64_t)1 << m->q;
    }
    while ((row + 1) * (row + 2) / 2 <= i) {
        row++;
    }
    column = i - row * (row + 1) / 2;
    row = row * (row + 3) / 2; /* of the diagonal */
    column = column * (column + 3) / 2;
    return row >= words->count
               ? 0
               : root(size_of_word(conf_word(words, row))) * root(size_of_word(conf_word(words, column)));
}

uint64_t conf_measure_widest(const conf_measure *m, const conf_array *words, size_t i)
{
    uint64_t whole = conf_measure_whole(m, words, i);
    if (m->kind != CONF_OF_ITSELF && m->kind != CONF_OF_SCALE) {
        return m->most;
    }
    return m->base_lsb + whole / 1000000 * m->most + (whole % 1000000 * m->most + 999999) / 1000000;
}
