// SPDX-License-Identifier: Apache-2.0
// The tracker with its memory. Frames of one tracker come one at a time, from whatever thread.
#include "convert.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include "ranges.h"

namespace drogue_python {

static py::array_t<double> from_vector_q32(const int64_t v[3])
{
    py::array_t<double> out(3);
    for (int i = 0; i < 3; i++) {
        out.mutable_at(i) = std::ldexp(static_cast<double>(v[i]), -32);
    }
    return out;
}

class Tracker {
public:
    Tracker(const py::sequence &camera, const py::sequence &model, const py::object &region, const py::dict &config_,
            const py::object &max_missed, const py::object &min_reliability)
        : config(to_config(config_))
    {
        drogue_track_config track_config;
        const bool whole = region.is_none();
        const drogue_region first = whole ? drogue_region() : to_region(region);
        const drogue_camera c = to_camera(camera);
        const drogue_model m = to_model(model);
        refuse(whole ? nullptr : ranges_region(&first));
        drogue_track_config_default(&track_config);
        track_config.max_missed = static_cast<uint32_t>(to_whole(
            max_missed, 0, UINT32_MAX, "max_missed must be a whole number", "max_missed is outside [0, 4294967295]"));
        track_config.min_reliability_q16 = to_q16(to_number(min_reliability, "min_reliability"), "min_reliability");
        if (drogue_track_init(&track, &track_config, &c, &m, whole ? nullptr : &first) != DROGUE_OK) {
            throw py::value_error("min_reliability is from 0 to 1");
        }
    }

    py::tuple frame(const py::object &array, const py::object &dt_s)
    {
        const Grey grey = to_image(array);
        const double dt_us = std::floor(to_number(dt_s, "the time between frames") * 1e6 + 0.5);
        drogue_result result;
        drogue_region region;
        drogue_track_estimate e;
        drogue_track_state state;
        bool gated;
        if (!(dt_us >= 1 && dt_us <= 2147483647)) {
            throw py::value_error("the time between frames is from 1 us to 2147 s");
        }
        {
            py::gil_scoped_release release;
            const std::lock_guard<std::mutex> one_at_a_time(mutex);
            take_size(grey.image);
            memory.fit(std::min<int32_t>(grey.image.width_px, DROGUE_MAX_SIDE),
                       std::min<int32_t>(grey.image.height_px, DROGUE_MAX_SIDE), config.min_arc_px);
            memory.fit_search(grey.image.width_px);
            state = drogue_track_frame(&result, &region, &track, &memory.workspace, &memory.search, &config,
                                       &grey.image, static_cast<uint32_t>(dt_us));
            gated = track.gated != 0;
            drogue_track_get(&e, &track);
        }
        py::object estimate = py::none();
        if (state != DROGUE_LOST) {
            estimate = py::make_tuple(from_vector(e.position_m_q16), from_vector(e.velocity_mps_q16),
                                      from_vector(e.axis_q16), e.yaw_rad_q16 / 65536.0, e.pitch_rad_q16 / 65536.0,
                                      e.orientation_resolved != 0, from_vector_q32(e.position_std_m_q32),
                                      std::ldexp(static_cast<double>(e.yaw_std_rad_q32), -32),
                                      std::ldexp(static_cast<double>(e.pitch_std_rad_q32), -32),
                                      std::ldexp(static_cast<double>(e.axis_std_rad_q32), -32));
        }
        return py::make_tuple(drogue_track_state_name(state), gated, from_region(region),
                              from_result(result, track.model), estimate);
    }

private:
    // One camera takes frames of one size.
    void take_size(const drogue_image &image)
    {
        if (width_px == 0) {
            refuse(ranges_centre(&track.camera, image.width_px, image.height_px));
            width_px = image.width_px;
            height_px = image.height_px;
        }
        if (image.width_px != width_px || image.height_px != height_px) {
            throw py::value_error(std::to_string(image.width_px) + "x" + std::to_string(image.height_px) +
                                  " pixels, unlike the first frame's " + std::to_string(width_px) + "x" +
                                  std::to_string(height_px));
        }
    }

    int32_t width_px = 0; // of the first frame
    int32_t height_px = 0;
    std::mutex mutex;
    drogue_config config;
    drogue_track track;
    Memory memory;
};

void add_tracker(py::module_ &module)
{
    py::class_<Tracker>(module, "Tracker")
        .def(py::init<const py::sequence &, const py::sequence &, const py::object &, const py::dict &,
                      const py::object &, const py::object &>())
        .def("frame", &Tracker::frame);
}

} // namespace drogue_python
