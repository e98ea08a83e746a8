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

    // The frame that the camera brings when the system asks for one; the pixels must stay.
    void show(const uint8_t *pixels, size_t count)
    {
        pixels_ = pixels;
        count_ = count;
        sent_ = 0;
    }
    size_t sent() const { return sent_; }

    // Address of the instruction that the soft core is about to complete; it publishes that itself.
    uint32_t instruction() const { return v.rootp->drogue_system->core->lastStagePc; }

    // The clock's low half: inputs, and what follows from them in v. True when the camera's pixel is taken.
    bool settle()
    {
        v.camera_valid = sent_ < count_;
        v.camera_first = sent_ == 0;
        v.camera_pixel = sent_ < count_ ? pixels_[sent_] : 0;
        v.eval();
        return v.camera_valid && v.camera_ready;
    }

    // Its rising edge; 'taken' is what settle() said.
    void rise(bool taken = false)
    {
        v.clock = 1;
        v.eval();
        v.clock = 0; // takes effect with the inputs of the next clock
        clock++;
        sent_ += taken;
    }

private:
    const uint8_t *pixels_ = nullptr;
    size_t count_ = 0, sent_ = 0;
};

#endif
