// SPDX-License-Identifier: Apache-2.0
// The small system under Verilator: its clock and its camera.
#ifndef DROGUE_SYSTEM_MACHINE_HPP
#define DROGUE_SYSTEM_MACHINE_HPP

#include <cstddef>
#include <cstdint>

#include "Vdrogue_system.h"
#include "Vdrogue_system_VexRiscv.h"
#include "Vdrogue_system___024root.h"
#include "Vdrogue_system_drogue_system.h"
#include "verilated.h"

class Machine {
public:
    Vdrogue_system v;
    unsigned long clock = 0;

    Machine()
    {
        v.reset = 1;
        for (int i = 0; i < 8; i++) {
            v.eval();
            rise();
        }
        v.reset = 0;
    }

    // The frame that the camera brings when the system asks for one; the pixels must stay. More follow, to be dropped.
    // A camera that waits holds each pixel until it is taken; one that does not brings the frame again and again.
    void show(const uint8_t *pixels, size_t count, bool waits = true)
    {
        rest_ = at_ > 0 ? count_ + beyond - at_ : rest_;
        pixels_ = pixels;
        count_ = count;
        at_ = 0;
        waits_ = waits;
        begun_ = false;
    }
    size_t sent() const { return at_; }

    // Address of the instruction that the soft core is about to complete; it publishes that itself.
    uint32_t instruction() const { return v.rootp->drogue_system->core->lastStagePc; }

    // The clock's low half: inputs, and what follows from them in v. True when a pixel of the frame is captured.
    bool settle()
    {
        const bool of_frame = rest_ == 0 && at_ < count_;
        v.camera_valid = rest_ > 0 || (count_ > 0 && at_ < count_ + beyond);
        v.camera_first = rest_ == 0 && at_ == 0;
        v.camera_pixel = of_frame ? pixels_[at_] : 0xA5;
        v.eval();
        taken_ = v.camera_valid && v.camera_ready;
        begun_ = v.camera_first ? taken_ : begun_;
        return taken_ && begun_ && of_frame;
    }

    // Its rising edge.
    void rise()
    {
        v.clock = 1;
        v.eval();
        v.clock = 0; // takes effect with the inputs of the next clock
        clock++;
        if (taken_ || (!waits_ && v.camera_valid)) {
            rest_ > 0 ? rest_-- : at_++;
        }
        if (!waits_ && at_ == count_ + beyond) {
            at_ = 0;
        }
    }

private:
    static const size_t beyond = 40; // pixels after those asked for
    const uint8_t *pixels_ = nullptr;
    size_t count_ = 0, at_ = 0, rest_ = 0; // of the frame; rest_: of the one before
    bool waits_ = true, taken_ = false, begun_ = false;
};

#endif
