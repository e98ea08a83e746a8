// SPDX-License-Identifier: Apache-2.0
// The golden vectors of stage 'frame' through the small system under Verilator: every output word; and frames that fill
// the block's labels and its points, which must be what the library says on this machine.
#include <cstring>
#include <vector>

#include "machine.hpp"

extern "C" {
#include "bench/bench.h"
#include "driver/block.h"
#include "order.h"
#include "stage_run.h"
}

namespace {

const unsigned long most_clocks = 200ul * 1000 * 1000;

// Everything that stage 'frame' puts out.
struct Words {
    int32_t frame[38], detail[20];
    int64_t covariance[15], std[4];
    bool operator==(const Words &o) const
    {
        return memcmp(frame, o.frame, sizeof frame) == 0 && memcmp(detail, o.detail, sizeof detail) == 0 &&
               memcmp(covariance, o.covariance, sizeof covariance) == 0 && memcmp(std, o.std, sizeof std) == 0;
    }
    explicit Words(const drogue_result *result) { stage_put_result(frame, detail, covariance, std, result); }
};

class System {
public:
    Machine m;
    unsigned long clocks = 0; // of the last frame, from its first pixel to its last word

    // What the system says of a frame; false when it does not, or its driver complains.
    bool measure(drogue_result *result, const order *o, const uint8_t *pixels)
    {
        std::vector<uint32_t> words;
        m.show((const uint8_t *)o, sizeof *o);
        run(sizeof *o, 0, &words);
        m.show(pixels, (size_t)(o->width_px * o->height_px));
        const unsigned long begin = m.clock;
        const bool ended = run((size_t)(o->width_px * o->height_px), 1 + sizeof *result / 4, &words);
        clocks = m.clock - begin;
        if (!ended) {
            return false;
        }
        memcpy(result, &words[1], sizeof *result);
        if (words[0] != DROGUE_BLOCK_OK) { // drogue_block_last()
            printf("the driver says: %u\n", words[0]);
        }
        return words[0] == DROGUE_BLOCK_OK;
    }

private:
    // Until the camera has brought so many pixels and so many words have come; false when they do not.
    bool run(size_t pixels, size_t count, std::vector<uint32_t> *words)
    {
        const unsigned long begin = m.clock;
        while (m.sent() < pixels || words->size() < count) {
            m.settle();
            if (m.v.result_valid) {
                words->push_back(m.v.result);
            }
            m.rise();
            if (m.clock - begin > most_clocks) {
                return false;
            }
        }
        return true;
    }
};

unsigned long frames, most, sum;

bool measure(bench *b, System *s, drogue_result *result, const order *o, const uint8_t *pixels)
{
    if (!bench_check(b, "the system answers", s->measure(result, o, pixels))) {
        return false;
    }
    printf("        %lu clocks\n", s->clocks);
    frames++;
    sum += s->clocks;
    most = s->clocks > most ? s->clocks : most;
    return true;
}

void run_case(bench *b, System *s, const conf_case *c)
{
    const drogue_image image = bench_image(c);
    const order o = {bench_camera(c), bench_model(c), bench_region(c), image.width_px, image.height_px};
    drogue_result result;
    if (bench_input(c, "config") != NULL) {
        bench_skip(b, "the firmware has the default thresholds");
        return;
    }
    if (image.width_px * image.height_px > WIDEST * WIDEST) {
        bench_skip(b, "larger than the frame memory");
        return;
    }
    order_measure(&result, &o, image.data);
    if (result.status == DROGUE_E_WORKSPACE) {
        bench_skip(b, "region wider than the block");
        return;
    }
    if (measure(b, s, &result, &o, image.data)) {
        const Words words(&result);
        bench_words(b, "frame", words.frame, bench_expected(c, "frame"));
        bench_words(b, "detail", words.detail, bench_expected(c, "detail"));
        bench_words(b, "covariance", words.covariance, bench_expected(c, "covariance"));
        bench_words(b, "std", words.std, bench_expected(c, "std"));
    }
}

// A frame of the largest size whose answer must be 'status', as the library has it.
void run_drawn(bench *b, System *s, const char *what, drogue_status status, const uint8_t *pixels)
{
    const order o = {{DROGUE_Q16(1465, 1), DROGUE_Q16(1465, 1), DROGUE_Q16(255, 2), DROGUE_Q16(255, 2), 0, 0, 0, 0, 0},
                     {DROGUE_Q16(35, 100), DROGUE_Q16(12, 100), DROGUE_Q16(25, 100)},
                     {0, 0, WIDEST, WIDEST},
                     WIDEST,
                     WIDEST};
    drogue_result expected, result;
    order_measure(&expected, &o, pixels);
    bench_word(b, what, expected.status, status);
    if (measure(b, s, &result, &o, pixels)) {
        const Words found(&result), wanted(&expected);
        bench_check(b, what, found == wanted);
        printf("drawn   %s: %s, %u points, %u arcs\n", what, drogue_status_name(result.status), result.list.edge_count,
               result.list.arc_count);
    }
}

} // namespace

int main()
{
    static uint8_t pixels[WIDEST * WIDEST];
    System s;
    const conf_case *c;
    bench b;
    setvbuf(stdout, nullptr, _IOLBF, 0);
    bench_begin(&b, "system");
    while ((c = bench_next(&b, "frame")) != nullptr) {
        run_case(&b, &s, c);
    }
    // Squares: each a component. Bars: few components, many points.
    for (int i = 0; i < WIDEST * WIDEST; i++) {
        pixels[i] = i % 6 < 3 && i / WIDEST % 6 < 3 ? 200 : 20;
    }
    run_drawn(&b, &s, "squares", DROGUE_E_LABELS_FULL, pixels);
    for (int i = 0; i < WIDEST * WIDEST; i++) {
        pixels[i] = i / WIDEST % 16 < 8 ? 200 : 20;
    }
    run_drawn(&b, &s, "bars", DROGUE_E_EDGES_FULL, pixels);
    const int failed = bench_end(&b);
    printf("system: %lu frames, %lu clocks a frame, at most %lu\n", frames, frames ? sum / frames : 0, most);
    return failed;
}
