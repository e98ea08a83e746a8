// SPDX-License-Identifier: Apache-2.0
// The small system under Verilator beside the library: the camera brings frames from a file, every word of region, result,
// estimate and track must be that of drogue_track_frame() on this machine. Clocks of each frame by part.
// usage: bench FRAMES.raw [PROFILE]     PROFILE: clocks of the frames after the first by the address of their instruction
#include <cstdio>
#include <cstring>
#include <map>
#include <vector>

#include "machine.hpp"

extern "C" {
#include "follow.h"
}

namespace {

std::vector<uint32_t> words;

void add(const void *from, size_t bytes)
{
    const size_t at = words.size();
    words.resize(at + bytes / 4);
    memcpy(&words[at], from, bytes);
}

struct Clocks {
    unsigned long capture = 0, block = 0, runs = 0, lists = 0, all = 0;
};

} // namespace

int main(int argc, char **argv)
{
    static follow f;
    static uint8_t pixels[SIDE * SIDE];
    std::map<uint32_t, unsigned long> profile;
    FILE *file = argc == 2 || argc == 3 ? fopen(argv[1], "rb") : nullptr;
    if (file == nullptr) {
        fprintf(stderr, "usage: bench FRAMES.raw [PROFILE]\n");
        return 2;
    }
    Machine m;
    unsigned long failed = 0, frames = 0, seen[3] = {0, 0, 0}, second_looks = 0;
    Clocks most;
    add("\0\0\0", 4);
    if (follow_begin(&f) != DROGUE_OK) {
        return 2;
    }
    setvbuf(stdout, nullptr, _IOLBF, 0);
    printf("frame  state     status          runs  camera    front end    lists  processor       all  second look\n");
    while (fread(pixels, 1, sizeof pixels, file) == sizeof pixels) {
        size_t got = 0;
        Clocks c;
        bool was_busy = false;
        unsigned long ended = 0, list_read = 0;
        follow_frame(&f, pixels);
        add("\0\0\0", 4); // drogue_block_last()
        add(&f.region, sizeof f.region);
        add(&f.result, sizeof f.result);
        add(&f.estimate, sizeof f.estimate);
        add(&f.track, sizeof f.track);
        const unsigned long begin = m.clock;
        unsigned long first = 0;
        m.show(pixels, sizeof pixels, frames % 2 == 0);
        while (got < words.size()) {
            const bool taken = m.settle();
            if (taken) {
                first = first == 0 ? m.clock : first;
                c.capture = m.clock + 1 - first;
            }
            if (m.v.result_valid) {
                if (m.v.result != words[got] && failed++ < 5) {
                    printf("frame %lu: word %zu is %08x, expected %08x\n", frames, got, m.v.result, words[got]);
                }
                got++;
            }
            c.block += m.v.block_busy;
            c.runs += m.v.block_busy && !was_busy;
            if (was_busy && !m.v.block_busy) {
                ended = m.clock;
            }
            if (m.v.list_read) {
                list_read = m.clock;
            }
            if (m.v.block_busy && !was_busy && list_read > ended) {
                c.lists += list_read - ended;
            }
            was_busy = m.v.block_busy;
            if (argc == 3 && frames > 0) {
                profile[m.instruction()]++;
            }
            m.rise();
            if (m.clock - begin > 400ul * 1000 * 1000) {
                printf("frame %lu: no end, %zu of %zu words\n", frames, got, words.size());
                return 1;
            }
        }
        if (list_read > ended) {
            c.lists += list_read - ended;
        }
        words.clear();
        c.all = m.clock - first;
        seen[f.track.state]++;
        second_looks += f.result.second_look != DROGUE_SECOND_NONE;
        printf("%5lu  %-9s %-14s %5lu %7lu %12lu %8lu %10lu %9lu  %s\n", frames, drogue_track_state_name(f.track.state),
               drogue_status_name(f.result.status), c.runs, c.capture, c.block, c.lists,
               c.all - c.block - c.lists, // it predicts while the camera writes
               c.all, drogue_second_look_name(f.result.second_look));
        fflush(stdout);
        if (f.track.state == DROGUE_TRACKING && f.region.width_px > 0 && c.all > most.all) { // not one of a search
            most = c;
        }
        frames++;
    }
    if (argc == 3) {
        FILE *out = fopen(argv[2], "w");
        if (out == nullptr) {
            fprintf(stderr, "bench: %s cannot be written\n", argv[2]);
            return 2;
        }
        for (const auto &at : profile) {
            fprintf(out, "%08x %lu\n", at.first, at.second);
        }
        fclose(out);
    }
    printf(
        "system: side=%d frames=%lu words off=%lu lost=%lu tracking=%lu coasting=%lu second looks=%lu; most clocks of a frame "
        "that was tracked %lu: %lu frames/s at 50 MHz\n",
        SIDE, frames, failed, seen[0], seen[1], seen[2], second_looks, most.all,
        most.all ? 50ul * 1000 * 1000 / most.all : 0);
    return failed != 0 || frames == 0;
}
