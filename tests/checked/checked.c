/* SPDX-License-Identifier: Apache-2.0 */
/* The checked primitives and their records. */
#include "checked.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_NAMES 200

static checked_site *sites;
static int excesses;

static void enter(checked_site *site)
{
    if (site->events == 0) {
        site->next = sites;
        sites = site;
    }
    site->events++;
}

void checked_fail(const char *what, const char *file, int line)
{
    excesses++;
    if (excesses <= 20) {
        fprintf(stderr, "%s:%d: %s\n", file, line, what);
    }
}

void checked_note(checked_site *site, int64_t value)
{
    uint64_t magnitude = drogue_abs_u64(value);
    enter(site);
    if (magnitude > site->peak) {
        site->peak = magnitude;
        if (site->bits < 64 && (magnitude >> site->bits) != 0) {
            fprintf(stderr, "%s:%d: %s: %" PRId64 " needs more than %d bits\n", site->file, site->line, site->name,
                    value, site->bits);
            excesses++;
        }
    }
}

void checked_saturation(checked_site *site, int saturated)
{
    enter(site);
    site->peak += saturated ? 1u : 0u;
}

int64_t checked_shl_s64(int64_t v, int n, const char *file, int line)
{
    int64_t r;
    if (n < 0 || n > 63) {
        checked_fail("drogue_shl_s64: count", file, line);
        return 0;
    }
    r = drogue_shl_s64(v, n);
    if ((r >> n) != v) {
        checked_fail("drogue_shl_s64: bits lost", file, line);
    }
    return r;
}

int64_t checked_shr_round_s64(int64_t v, int n, const char *file, int line)
{
    if (n < 0 || n > 63) {
        checked_fail("drogue_shr_round_s64: count", file, line);
        return 0;
    }
    return drogue_shr_round_s64(v, n);
}

int64_t checked_div_round_s64(int64_t num, int64_t den, const char *file, int line)
{
    const int64_t most = INT64_C(1) << 61;
    if (den <= 0 || den > most || num > most || num < -most) {
        checked_fail("drogue_div_round_s64: range", file, line);
        return 0;
    }
    return drogue_div_round_s64(num, den);
}

void checked_sincos_q30(int32_t *sin_q30, int32_t *cos_q30, int32_t angle_rad_q29, const char *file, int line)
{
    const int32_t pi_q29 = 1686629713 + (1 << 13); /* pi, and half a Q16 unit of rounding */
    if (angle_rad_q29 > pi_q29 || angle_rad_q29 < -pi_q29) {
        checked_fail("drogue_sincos_q30: beyond one turn", file, line);
    }
    drogue_sincos_q30(sin_q30, cos_q30, angle_rad_q29);
}

/* The report follows whatever the program did; an excess is a failure. */
static void at_end(void)
{
    fflush(stdout);
    if (checked_report() != 0) {
        fflush(stdout);
        _Exit(3);
    }
}

__attribute__((constructor)) static void at_start(void) { atexit(at_end); }

static int bit_length(uint64_t v) { return 64 - drogue_clz_u64(v); }

static int by_place(const void *left, const void *right)
{
    const checked_site *a = *(const checked_site *const *)left;
    const checked_site *b = *(const checked_site *const *)right;
    int order = strcmp(a->bits > 0 ? a->name : a->file, b->bits > 0 ? b->name : b->file);
    return order != 0 ? order : a->line - b->line;
}

/* The last part of a path. */
static const char *base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

int checked_report(void)
{
    const checked_site *place[MAX_NAMES];
    size_t count = 0;
    size_t i;
    for (; sites != NULL && count < MAX_NAMES; sites = sites->next) {
        place[count++] = sites;
    }
    qsort(place, count, sizeof place[0], by_place);
    printf("| quantity | bits | peak | headroom, bits | place |\n| --- | --- | --- | --- | --- |\n");
    for (i = 0; i < count; i++) {
        const checked_site *s = place[i];
        if (s->bits > 0) {
            printf("| %s | %d | %" PRIu64 " | %d | %s:%d |\n", s->name, s->bits, s->peak, s->bits - bit_length(s->peak),
                   base_name(s->file), s->line);
        }
    }
    printf("\n| saturating operation | calls | saturated | place |\n| --- | --- | --- | --- |\n");
    for (i = 0; i < count; i++) {
        const checked_site *s = place[i];
        if (s->bits == 0 && s->peak > 0) {
            printf("| %s | %" PRIu64 " | %" PRIu64 " | %s:%d |\n", s->name, s->events, s->peak, base_name(s->file),
                   s->line);
        }
    }
    printf("\nchecked: quantities=%zu excesses=%d\n", count, excesses);
    return excesses;
}
