// SPDX-License-Identifier: Apache-2.0
// The units beside the soft core under Verilator: every word that they answer must be the library's, over operands at the edges
// of their ranges and drawn ones.
// usage: unit_test [DRAWN]     operands drawn for each operation
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "Vdrogue_unit.h"
#include "verilated.h"

#define restrict __restrict
extern "C" {
#include "drogue/rays.h"
#include "system/fit_unit.h"
#include "system/points_unit.h"
#include "system/ray_unit.h"
#include "system/unit.h"
}

namespace {

Vdrogue_unit v;
unsigned long failed, compared, held;
uint64_t state = 1;

uint32_t draw()
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(state >> 32);
}

uint32_t frame[4096]; // the frame memory's words

void tick()
{
    const uint32_t word = v.frame_free ? frame[v.frame_at / 4 % 4096] : draw();
    v.clock = 1;
    v.eval();
    v.frame_word = word;
    v.frame_free = draw() % 8 != 0;
    v.clock = 0;
    v.eval();
}

void ask(unsigned unit, unsigned what, uint32_t first, uint32_t second)
{
    v.asked = 1;
    v.function_id = (uint16_t)(unit << 3 | what);
    v.first = first;
    v.second = second;
    v.eval();
    for (int k = 0; k < 2000 && !v.ready; k++) {
        tick();
    }
    tick();
    v.asked = 0;
}

uint32_t answer()
{
    for (int k = 0; k < 100 && !v.answers; k++) {
        tick();
    }
    v.taken = 1;
    const uint32_t said = v.says;
    tick();
    v.taken = 0;
    return said;
}

// An instruction: what the unit answers.
uint32_t instruction(unsigned unit, unsigned what, uint32_t first, uint32_t second)
{
    ask(unit, what, first, second);
    return answer();
}

void compare(const char *what, uint32_t found, uint32_t expected)
{
    compared++;
    if (found != expected && failed++ < 10) {
        printf("unit: %s: %08x, expected %08x\n", what, found, expected);
    }
}

drogue_real real(uint32_t choice)
{
    static const int32_t mantissas[] = {0, 1 << 30, -(1 << 30), INT32_MAX, -INT32_MAX, (1 << 30) + 1, 0x55555555};
    static const int32_t spans[] = {0, 1, 3, 31, 32, 62, 63, 64, 200};
    drogue_real r;
    const uint32_t m = draw();
    r.mantissa = choice < 7 ? mantissas[choice] : (int32_t)((m | 1u << 30) & INT32_MAX) * (draw() >> 31 ? -1 : 1);
    const int32_t span = spans[draw() % 9];
    r.exponent = r.mantissa == 0 ? 0 : (int32_t)(draw() % (2 * (uint32_t)span + 1)) - span - 31;
    return r;
}

void push(const drogue_real &r) { instruction(UNIT_PUSH, 0, (uint32_t)r.mantissa, (uint32_t)r.exponent); }

void check_real(const char *name, unsigned what, const drogue_real &d, const drogue_real &expected)
{
    compare(name, instruction(UNIT_REAL, what, (uint32_t)d.mantissa, (uint32_t)d.exponent),
            (uint32_t)expected.mantissa);
    compare(name, instruction(UNIT_EXPONENT, 0, 0, 0), (uint32_t)expected.exponent);
}

void reals(uint32_t n)
{
    const bool edges = n < 7 * 7 * 7;
    const drogue_real a = real(edges ? n % 7 : 7), b = real(edges ? n / 7 % 7 : 7), c = real(edges ? n / 49 : 7);
    drogue_real d = real(7), r = c;
    if (draw() % 4 == 0) { // what cancels
        d = b;
    }
    push(a), drogue_real_sum(&r, &a, &b), check_real("sum", REAL_SUM, b, r);
    push(a), drogue_real_difference(&r, &a, &b), check_real("difference", REAL_DIFFERENCE, b, r);
    push(a), drogue_real_product(&r, &a, &b), check_real("product", REAL_PRODUCT, b, r);
    r = c, push(c), push(a), drogue_real_subtract_product(&r, &a, &b);
    check_real("subtract product", REAL_SUBTRACT_PRODUCT, b, r);
    push(a), push(b), push(c), drogue_real_products(&r, &a, &b, &c, &d), check_real("products", REAL_PRODUCTS, d, r);
    push(a), push(b), push(c), drogue_real_determinant(&r, &a, &b, &c, &d),
        check_real("determinant", REAL_DETERMINANT, d, r);
    const int shift = (int)(draw() % 64);
    const int64_t whole = edges ? (int64_t)a.mantissa * (1 << 30) : (int64_t)((uint64_t)draw() << 32 | draw()) >> shift;
    const drogue_real words = {(int32_t)((uint64_t)whole >> 32), (int32_t)(uint32_t)whole}, by = {0, d.exponent};
    push(words), drogue_real_set(&r, whole, d.exponent), check_real("set", REAL_SET, by, r);
    const uint32_t z = edges ? (uint32_t)a.mantissa : draw() >> draw() % 32;
    const uint64_t square = (uint64_t)z * z - (draw() & 1),
                   v64 = edges ? square : ((uint64_t)draw() << 32 | draw()) >> shift;
    push(a), drogue_real_quotient(&r, &a, &b), check_real("quotient", REAL_QUOTIENT, b, r);
    compare("root", instruction(UNIT_ROOT, 0, (uint32_t)v64, (uint32_t)(v64 >> 32)), drogue_isqrt_u64(v64));
    const uint64_t a64 = ((uint64_t)draw() << 32 | draw()) >> draw() % 64,
                   b64 = (((uint64_t)draw() << 32 | draw()) >> draw() % 64) | 1, factor = draw() % 3;
    const uint64_t by64 = edges ? ~0ull >> n % 64 : b64, of64 = edges ? by64 * factor - (n & 1) : a64;
    instruction(UNIT_DIVISOR, 0, (uint32_t)by64, (uint32_t)(by64 >> 32));
    compare("quotient of 64 bits", instruction(UNIT_DIVIDE, 0, (uint32_t)of64, (uint32_t)(of64 >> 32)),
            (uint32_t)(of64 / by64));
    compare("quotient of 64 bits", instruction(UNIT_EXPONENT, 0, 0, 0), (uint32_t)(of64 / by64 >> 32));
    ask(UNIT_ZEROS, 0, z, 0); // and another instruction, long or short, before its answer is taken
    ask(n & 1 ? UNIT_ROOT : UNIT_ZEROS, 0, 1, 0);
    compare("leading zeros", answer(), z == 0 ? 32 : (uint32_t)__builtin_clz(z));
    compare("the answer after", answer(), n & 1 ? 1 : 31);
}

// Points about an ellipse that the unit knows, counted as the soft core has it do.
void counts(const points_asked &a, const drogue_ellipse &e)
{
    drogue_edge edges[60];
    drogue_support support = {};
    drogue_moments m, before;
    support.bright_bins = draw();
    drogue_moments_clear(&m);
    m.n = draw() % 4 ? draw() % 100 + 60 : DROGUE_MAX_FIT_POINTS - draw() % 10;
    before = m;
    const uint32_t counted = draw() & 1;
    instruction(UNIT_CLEAR, 0, 0, 0);
    instruction(UNIT_COUNT, 0, support.bright_bins, (uint32_t)m.n | (counted ? COUNT_OUT : 0));
    for (drogue_edge &edge : edges) {
        const double t = draw() * 6.2831853 / 4294967296.0, r = 0.99 + draw() * 0.02 / 4294967296.0;
        const double axis = e.angle_rad_q16 / 65536.0, u = r * e.a_px_q16 * cos(t), w = r * e.b_px_q16 * sin(t);
        const double grey = draw() & 1 ? 300 : -300;
        edge = {};
        edge.x_q5 = (uint16_t)((e.xc_px_q16 + u * cos(axis) - w * sin(axis)) / 2048);
        edge.y_q5 = (uint16_t)((e.yc_px_q16 + u * sin(axis) + w * cos(axis)) / 2048);
        edge.gx = (int16_t)(grey * cos(axis + t));
        edge.gy = (int16_t)(grey * sin(axis + t));
        uint32_t words[2];
        memcpy(words, &edge.x_q5, sizeof words);
        instruction(UNIT_PLACE, 1, words[0], words[1]);
    }
    drogue_collect_edges(&m, &support, &a.frame, &a.band, edges, 60, 1, counted);
    uint32_t bins = 0;
    for (unsigned k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const drogue_support_bin &b = support.bin[k];
        bins |= (b.count[0] + b.count[1] > 0 ? 1u : 0u) << k;
    }
    held += support.points;
    compare("bins", instruction(UNIT_COUNTED, COUNTED_BINS, 0, 0), bins);
    const support_sums sums = sums_of(&support);
    for (unsigned k = 0; k < 5; k++) {
        uint32_t expected;
        memcpy(&expected, (const char *)&sums + 4 * k, 4);
        compare("sums of the support", instruction(UNIT_COUNTED, COUNTED_SUMS, 0, 0), expected);
    }
    for (unsigned k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const drogue_support_bin &b = support.bin[k];
        compare("counts", instruction(UNIT_COUNTED, COUNTED_COUNTS, k, 0), b.count[0] | b.count[1] << 16);
        if (bins >> k & 1) {
            compare("offsets", instruction(UNIT_COUNTED, COUNTED_OFFSETS, k, 0), (uint32_t)b.sum_q16);
        }
    }
    const bool changed = memcmp(&m, &before, sizeof m) != 0;
    compare("do the moments change", instruction(UNIT_COUNTED, COUNTED_MOMENTS, 0, 0) & changed, changed);
    for (unsigned k = 0; k < sizeof m / 8; k++) {
        uint64_t expected, from;
        memcpy(&expected, (const char *)&m + 8 * k, 8);
        memcpy(&from, (const char *)&before + 8 * k, 8);
        compare("counted moments", instruction(UNIT_MOMENTS, 0, 0, 0), (uint32_t)(expected - from));
        compare("counted moments", instruction(UNIT_MOMENTS, 0, 0, 0), (uint32_t)((expected - from) >> 32));
    }
}

// An ellipse and points about it.
void points()
{
    points_asked a;
    points_said said;
    drogue_ellipse e = {};
    memset(&a, 0, sizeof a);
    e.a_px_q16 = (drogue_q16)(65536 * 5 + draw() % (65536 * 100));
    e.b_px_q16 = (drogue_q16)(e.a_px_q16 - (int32_t)(draw() % (uint32_t)(e.a_px_q16 / 2)));
    e.xc_px_q16 = (drogue_q16)(draw() % (65536 * 256));
    e.yc_px_q16 = (drogue_q16)(draw() % (65536 * 256));
    e.angle_rad_q16 = (drogue_q16)(draw() % 200000) - 100000;
    if (drogue_ellipse_frame_of(&a.frame, &e) != DROGUE_OK) {
        return;
    }
    a.band = drogue_band_of((drogue_q16)(draw() % (8 * 65536)) + 1, (drogue_q16)(draw() % 65537));
    a.reach = reach_of(&a.frame, &a.band);
    a.most_px_q16 = (drogue_q16)(draw() % 300000);
    uint32_t words[POINTS_WORDS + 1] = {};
    memcpy(words, &a, sizeof words - 4);
    for (int i = 0; i < POINTS_WORDS; i += 2) {
        instruction(UNIT_TELL, 0, words[i], words[i + 1]);
    }
    drogue_moments m, sum;
    drogue_moments_clear(&m);
    instruction(UNIT_CLEAR, 0, 0, 0);
    for (int k = 0; k < 40; k++) {
        const uint32_t x = k % 4 ? (uint32_t)(e.xc_px_q16 >> 11) + draw() % 4096 - 2048 : draw();
        const uint32_t y = k % 4 ? (uint32_t)(e.yc_px_q16 >> 11) + draw() % 4096 - 2048 : draw();
        a.place = (x & 0xFFFF) | y << 16;
        a.gradient = ((draw() % 2041 - 1020) & 0xFFFF) | (draw() % 2041 - 1020) << 16;
        instruction(UNIT_PLACE, 0, a.place, a.gradient);
        points_unit_place(&a, &said);
        compare("place", instruction(UNIT_SAID, 0, 0, 0), said.word);
        moments_asked more = {m, a.place, draw() & 1};
        points_unit_moments(&more, &m);
        instruction(UNIT_ADD, 0, more.place, more.out_of);
    }
    for (unsigned k = 0; k < sizeof sum / 4; k++) {
        uint32_t expected;
        memcpy(&expected, (const char *)&m + 4 * k, 4);
        compare("moments", instruction(UNIT_MOMENTS, 0, 0, 0), expected);
    }
    counts(a, e);
}

void wait()
{
    for (uint32_t clocks = draw() % 30; clocks > 20; clocks--) {
        tick();
    }
}

// Peaks of the slope of so many grey levels along a ray that the unit has begun; not always all of them.
void seek(const int32_t *grey, int32_t count, int32_t least, unsigned what)
{
    static const int32_t taps[] = {-2, -3, -4, -3, 0, 3, 4, 3, 2};
    int32_t slope[73] = {};
    for (int32_t i = 0; i + 9 <= count; i++) {
        for (int32_t k = 0; k < 9; k++) {
            slope[i] += taps[k] * grey[i + k];
        }
    }
    for (int32_t i = 1; i + 10 <= count; i++) {
        const bool rises = slope[i] >= least && slope[i] > slope[i - 1] && slope[i] >= slope[i + 1];
        const bool falls = -slope[i] >= least && slope[i] < slope[i - 1] && slope[i] <= slope[i + 1];
        if (!rises && !(falls && what & RAY_EITHER)) {
            continue;
        }
        wait();
        compare("peak", instruction(UNIT_RAY_PEAK, RAY_PEAK_AT, 0, 0), (uint32_t)(i + (falls ? RAY_PEAK_FALLS : 0)));
        compare("before", instruction(UNIT_RAY_PEAK, RAY_PEAK_BEFORE, 0, 0), (uint32_t)slope[i - 1]);
        compare("slope", instruction(UNIT_RAY_PEAK, RAY_PEAK_SLOPE, 0, 0), (uint32_t)slope[i]);
        compare("after", instruction(UNIT_RAY_PEAK, RAY_PEAK_AFTER, 0, 0), (uint32_t)slope[i + 1]);
        compare("level", instruction(UNIT_RAY_PEAK, RAY_PEAK_LEVEL, 0, 0), (uint32_t)grey[i + 4]);
        if (draw() % 64 == 0) {
            return;
        }
    }
    compare("peaks", instruction(UNIT_RAY_PEAK, RAY_PEAK_AT, 0, 0), UINT32_MAX);
}

// A ray across an image in the frame memory, or out of it; not all of its samples are taken.
void rays()
{
    int32_t grey[73];
    drogue_ray r = {};
    const int32_t width = 1 + (int32_t)(draw() % 100), height = 1 + (int32_t)(draw() % 100);
    const uint32_t first = draw() % 1000;
    const drogue_image image = {(const uint8_t *)frame + first, width, height, width + (int32_t)(draw() % 20)};
    r.x_px_q16 = (drogue_q16)(draw() % 0x800000) - 0x100000;
    r.y_px_q16 = (drogue_q16)(draw() % 0x800000) - 0x100000;
    r.nx_q14 = (int32_t)(draw() % 32769) - 16384;
    r.ny_q14 = (int32_t)(draw() % 32769) - 16384;
    r.step_px_q16 = (drogue_q16)(draw() % 131072);
    const drogue_q16 from = (drogue_q16)(draw() % 0x400000) - 0x200000;
    const int32_t count = 1 + (int32_t)(draw() % 73);
    drogue_ray_read(grey, &r, &image, from, count);
    const unsigned what = draw() % 2 ? RAY_GREY : draw() % 2 ? RAY_SEEK : RAY_SEEK | RAY_EITHER;
    const int32_t least = (int32_t)(draw() % 200000);
    instruction(UNIT_RAY_LEAST, 0, (uint32_t)least, (uint32_t)count);
    instruction(UNIT_RAY_IMAGE, 0, first, (uint32_t)image.stride);
    instruction(UNIT_RAY_SIZE, 0, (uint32_t)width, (uint32_t)height);
    instruction(UNIT_RAY_STEP, 0, (uint32_t)drogue_ray_part(r.nx_q14, r.step_px_q16),
                (uint32_t)drogue_ray_part(r.ny_q14, r.step_px_q16));
    instruction(UNIT_RAY_BEGIN, what, (uint32_t)(r.x_px_q16 + drogue_ray_part(r.nx_q14, from)),
                (uint32_t)(r.y_px_q16 + drogue_ray_part(r.ny_q14, from)));
    if (what == RAY_GREY) {
        for (int32_t k = 0; k < count; k++) {
            wait();
            compare("grey", instruction(UNIT_RAY_GREY, 0, 0, 0), (uint32_t)grey[k]);
        }
    } else {
        seek(grey, count, least, what);
    }
}

// Rays with edges about an offset, one with none about it among them.
void fits()
{
    const drogue_q16 v_px_q16[3] = {(drogue_q16)(draw() % 0x80000) - 0x40000, (drogue_q16)(draw() % 0x80000) - 0x40000,
                                    (drogue_q16)(draw() % 0x80000) - 0x40000};
    const drogue_q16 within = draw() % 8 ? (drogue_q16)(draw() % 0x80000) : 0;
    drogue_ray rays[RAYS] = {};
    drogue_ray_sums sums = {}, found = {};
    for (drogue_ray &r : rays) {
        r.count = draw() % (DROGUE_RAY_EDGES + 1);
        r.nx_q14 = (int32_t)(draw() % 32769) - 16384;
        r.ny_q14 = (int32_t)(draw() % 32769) - 16384;
        for (uint32_t i = 0; i < r.count; i++) {
            r.edges[i] = {(drogue_q16)(draw() % 0x100000) - 0x80000, (int32_t)(draw() % (draw() % 8 ? 0xC0000 : 2)),
                          (int32_t)(draw() % 65281)};
        }
    }
    drogue_ray_sums_add_edges(&sums, nullptr, rays, v_px_q16, within);
    instruction(UNIT_FIT_PLACE, 0, (uint32_t)v_px_q16[0], (uint32_t)v_px_q16[1]);
    instruction(UNIT_FIT_BEGIN, 0, (uint32_t)v_px_q16[2], (uint32_t)within);
    for (const drogue_ray &r : rays) {
        for (uint32_t i = 0; i < r.count; i++) {
            instruction(UNIT_FIT_EDGE, 0, (uint32_t)r.edges[i].at_px_q16, (uint32_t)r.edges[i].slope_q8);
        }
        if (r.count > 0) {
            instruction(UNIT_FIT_RAY, 0, (uint32_t)r.nx_q14, (uint32_t)r.ny_q14);
            compare("which", instruction(UNIT_FIT_WHICH, 0, 0, 0),
                    (uint32_t)drogue_ray_chosen(&r, drogue_ray_along(&r, v_px_q16), within));
        }
    }
    fit_sums said = {};
    for (unsigned k = 0; k < FIT_WORDS; k++) {
        const uint32_t word = instruction(UNIT_FIT_SUMS, 0, 0, 0);
        memcpy((char *)&said + 4 * k, &word, 4);
    }
    memcpy(found.normal, said.normal, sizeof said.normal);
    memcpy(found.right, said.right, sizeof said.right);
    found.normal[5] = said.rays;
    found.squares_q16 = said.squares_q16;
    found.slopes_q8 = sums.slopes_q8; // by the soft core
    found.levels_q8 = sums.levels_q8;
    found.rays = said.rays;
    compare("sums", (uint32_t)memcmp(&found, &sums, sizeof sums), 0);
}

} // namespace

int main(int argc, char **argv)
{
    const uint32_t drawn = argc > 1 ? (uint32_t)strtoul(argv[1], nullptr, 10) : 100000;
    v.reset = 1;
    tick();
    v.reset = 0;
    for (uint32_t n = 0; n < 7 * 7 * 7 + drawn; n++) {
        reals(n);
    }
    for (uint32_t n = 0; n < drawn / 40; n++) {
        points();
    }
    for (uint32_t &word : frame) {
        word = draw();
    }
    for (uint32_t n = 0; n < drawn / 10; n++) {
        rays();
    }
    for (uint32_t n = 0; n < drawn / 200; n++) {
        fits();
    }
    printf("unit: words=%lu points held=%lu failed=%lu\n", compared, held, failed);
    return failed != 0;
}
