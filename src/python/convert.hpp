// SPDX-License-Identifier: Apache-2.0
// Between Python's values and the library's: floats and Q formats, arrays and images, dictionaries and results.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>

#include "drogue/search.h"
#include "drogue/track.h"

namespace drogue_python {

namespace py = pybind11;

// Nearest Q16, ties upward. ValueError outside [-32768, 32768).
drogue_q16 to_q16(double value, const char *what);

// A float, or what Python makes one of; TypeError or ValueError that names it otherwise.
double to_number(const py::handle &value, const char *what);

// As Python's own indices: no float, whatever its value. TypeError, ValueError with these words.
int64_t to_whole(const py::handle &value, int64_t least, int64_t most, const char *no_whole, const char *outside);

// ValueError that says so, where something is wrong.
void refuse(const char *wrong);

// Grey image, rows adjacent: the array itself where it is so already.
struct Grey {
    py::array_t<uint8_t> pixels;
    drogue_image image;
};
// TypeError where it is none.
Grey to_image(const py::object &image);

drogue_camera to_camera(const py::sequence &nine);
drogue_model to_model(const py::sequence &three);
drogue_region to_region(const py::sequence &four);
drogue_config to_config(const py::dict &changed);

py::dict from_result(const drogue_result &r, const drogue_model &model);
py::tuple from_region(const drogue_region &r);
py::array_t<double> from_vector(const drogue_q16 v[3]);

// Memory for regions of so many pixels, each of which may be an edge point, and for a search of that width.
class Memory {
public:
    drogue_workspace workspace;
    drogue_search search;
    void fit(int32_t width, int32_t height, uint32_t min_arc_px);
    void fit_search(int32_t width);

private:
    std::unique_ptr<uint64_t[]> workspace_memory;
    std::unique_ptr<uint8_t[]> search_memory;
    size_t workspace_words = 0;
    int32_t search_width = 0;
};

void add_tracker(py::module_ &module);

} // namespace drogue_python
