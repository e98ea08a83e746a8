// SPDX-License-Identifier: Apache-2.0
// The module drogue._native: measure, search, canny; floats and numpy arrays outside, the library's fixed point inside.
// Whatever takes long runs without Python's lock.
#include "convert.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "odds.h"
#include "ranges.h"
#include "thresholds.h"

namespace drogue_python {

drogue_q16 to_q16(double value, const char *what)
{
    const double scaled = std::floor(value * 65536.0 + 0.5);
    if (!(scaled >= -2147483648.0 && scaled <= 2147483647.0)) {
        throw py::value_error(std::string(what) + " is outside [-32768, 32768)");
    }
    return static_cast<drogue_q16>(scaled);
}

void refuse(const char *wrong)
{
    if (wrong != nullptr) {
        throw py::value_error(wrong);
    }
}

double to_number(const py::handle &value, const char *what)
{
    const double number = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred() == nullptr) {
        return number;
    }
    if (PyErr_ExceptionMatches(PyExc_TypeError)) {
        PyErr_Clear();
        throw py::type_error(std::string(what) + " must be a number");
    }
    if (PyErr_ExceptionMatches(PyExc_OverflowError)) {
        PyErr_Clear();
        throw py::value_error(std::string(what) + " is outside its range");
    }
    throw py::error_already_set();
}

int64_t to_whole(const py::handle &value, int64_t least, int64_t most, const char *no_whole, const char *outside)
{
    const py::object whole = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    int beyond = 0;
    if (!whole) {
        PyErr_Clear();
        throw py::type_error(no_whole);
    }
    const long long number = PyLong_AsLongLongAndOverflow(whole.ptr(), &beyond);
    if (beyond != 0 || number < least || number > most) {
        throw py::value_error(outside);
    }
    return number;
}

static double q16(int64_t v) { return static_cast<double>(v) / 65536.0; }

Grey to_image(const py::object &image)
{
    Grey grey;
    if (!py::isinstance<py::array_t<uint8_t>>(image) || py::reinterpret_borrow<py::array>(image).ndim() != 2) {
        throw py::type_error("the image must be a two-dimensional numpy array of uint8 (rows, columns)");
    }
    const py::array array = py::reinterpret_borrow<py::array>(image);
    if (array.shape(0) < 1 || array.shape(1) < 1 || array.shape(0) > INT16_MAX || array.shape(1) > INT16_MAX) {
        throw py::value_error("the image must have from 1 to 32767 rows and columns");
    }
    grey.pixels = py::array_t<uint8_t, py::array::c_style | py::array::forcecast>::ensure(array);
    grey.image.data = grey.pixels.data();
    grey.image.height_px = static_cast<int32_t>(array.shape(0));
    grey.image.width_px = static_cast<int32_t>(array.shape(1));
    grey.image.stride = grey.image.width_px;
    return grey;
}

drogue_camera to_camera(const py::sequence &v)
{
    static const char *const what[] = {"fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"};
    drogue_camera c;
    drogue_q16 *const members[] = {&c.fx_px_q16, &c.fy_px_q16, &c.cx_px_q16, &c.cy_px_q16, &c.k1_q16,
                                   &c.k2_q16,    &c.p1_q16,    &c.p2_q16,    &c.k3_q16};
    for (size_t i = 0; i < 9; i++) {
        *members[i] = to_q16(to_number(v[i], what[i]), what[i]);
    }
    refuse(ranges_focal(&c));
    refuse(ranges_lens(&c));
    return c;
}

drogue_model to_model(const py::sequence &v)
{
    drogue_model m;
    drogue_q16 *const members[] = {&m.rim_radius_m_q16, &m.inner_radius_m_q16, &m.inner_depth_m_q16};
    static const char *const what[] = {"the rim's radius", "the inner part's radius", "the inner part's depth"};
    for (size_t i = 0; i < 3; i++) {
        *members[i] = to_q16(to_number(v[i], what[i]), what[i]);
    }
    refuse(ranges_model(&m));
    return m;
}

drogue_region to_region(const py::sequence &v)
{
    const int64_t most = 1 << 20;
    drogue_region r;
    int32_t *const members[] = {&r.x_px, &r.y_px, &r.width_px, &r.height_px};
    if (v.size() != 4) {
        throw py::value_error("a region is x, y, width, height");
    }
    for (size_t i = 0; i < 4; i++) {
        *members[i] =
            static_cast<int32_t>(to_whole(v[i], -most, most, "x, y, width and height of a region must be whole numbers",
                                          "a region lies within +-1048576 px"));
    }
    return r;
}

// A threshold's place; nullptr when there is none of that name.
static const threshold *find_threshold(const std::string &name)
{
    const threshold *end = thresholds + threshold_count;
    const threshold *found = std::find_if(thresholds, end, [&](const threshold &t) { return name == t.name; });
    return found == end ? nullptr : found;
}

drogue_config to_config(const py::dict &changed)
{
    drogue_config config;
    drogue_config_default(&config);
    for (const auto &item : changed) {
        const std::string name = py::str(item.first);
        const threshold *t = find_threshold(name);
        if (t == nullptr) {
            throw py::key_error("no threshold is named " + name + "; see drogue.thresholds()");
        }
        const double value = to_number(item.second, name.c_str());
        const double kept = t->is_q16 ? std::floor(value * 65536.0 + 0.5) : value;
        if (!t->is_q16 && kept != std::floor(kept)) {
            throw py::value_error(name + " must be a whole number");
        }
        if (!(kept >= t->least && kept <= t->most)) {
            throw py::value_error(name + " is outside its range");
        }
        const int32_t word = static_cast<int32_t>(kept);
        std::memcpy(reinterpret_cast<char *>(&config) + t->offset, &word, sizeof word);
    }
    if (!drogue_config_valid(&config)) {
        throw py::value_error("thresholds contradict each other: low above high, or least above most");
    }
    return config;
}

static py::dict list_thresholds()
{
    drogue_config defaults;
    drogue_config_default(&defaults);
    py::dict all;
    for (int i = 0; i < threshold_count; i++) {
        const threshold &t = thresholds[i];
        const double unit = t.is_q16 ? 65536.0 : 1.0;
        int32_t word;
        std::memcpy(&word, reinterpret_cast<const char *>(&defaults) + t.offset, sizeof word);
        all[t.name] = py::make_tuple(word / unit, t.least / unit, t.most / unit, t.unit);
    }
    return all;
}

py::tuple from_region(const drogue_region &r) { return py::make_tuple(r.x_px, r.y_px, r.width_px, r.height_px); }

py::array_t<double> from_vector(const drogue_q16 v[3])
{
    py::array_t<double> out(3);
    for (int i = 0; i < 3; i++) {
        out.mutable_at(i) = q16(v[i]);
    }
    return out;
}

static py::tuple from_ellipse(const drogue_ellipse &e)
{
    return py::make_tuple(q16(e.xc_px_q16), q16(e.yc_px_q16), q16(e.a_px_q16), q16(e.b_px_q16), q16(e.angle_rad_q16));
}

static py::tuple from_pose(const drogue_pose &p)
{
    return py::make_tuple(from_vector(p.position_m_q16), from_vector(p.axis_q16), q16(p.yaw_rad_q16),
                          q16(p.pitch_rad_q16));
}

py::dict from_result(const drogue_result &r, const drogue_model &model)
{
    py::dict d;
    py::list arcs;
    py::array_t<double> covariance({5, 5});
    py::array_t<double> position_std(3);
    for (uint32_t arc : r.arcs) {
        arcs.append(arc == DROGUE_NO_ARC ? py::object(py::none()) : py::object(py::int_(arc)));
    }
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 5; j++) {
            covariance.mutable_at(i, j) =
                std::ldexp(static_cast<double>(r.covariance_q48[i][j]), r.covariance_halved - 48);
        }
    }
    for (int i = 0; i < 3; i++) {
        position_std.mutable_at(i) = std::ldexp(static_cast<double>(r.position_std_m_q32[i]), -32);
    }
    d["status"] = drogue_status_name(r.status);
    d["second_look"] = drogue_second_look_name(r.second_look);
    d["region"] = from_region(r.region);
    d["edge_count"] = r.list.edge_count;
    d["arc_count"] = r.list.arc_count;
    d["arcs"] = py::tuple(arcs);
    d["ellipse"] = from_ellipse(r.ellipse);
    d["ideal"] = from_ellipse(r.ideal);
    d["quality"] =
        py::make_tuple(q16(r.quality.fit_ratio_q16), q16(r.quality.length_ratio_q16), q16(r.quality.axis_ratio_q16),
                       q16(r.quality.score_q16), q16(r.quality.reliability_q16));
    d["polarity"] = static_cast<int>(r.polarity);
    d["cluster_members"] = r.cluster_members;
    d["refit_points"] = r.refit_points;
    d["cover"] = q16(r.cover_q16);
    d["outside"] = r.outside;
    d["has_inner"] = r.has_inner != 0;
    d["inner"] = py::make_tuple(q16(r.inner.x_px_q16), q16(r.inner.y_px_q16), r.inner.area_px,
                                q16(r.inner.spread_px_q16), r.inner.threshold, r.inner.contrast, r.inner.rays);
    d["pose"] = from_pose(r.pose);
    d["alternative"] = from_pose(r.alternative);
    d["orientation_resolved"] = r.orientation_resolved != 0;
    d["ambiguity"] = q16(r.ambiguity_q16);
    d["doubt"] = q16(r.doubt_q16);
    d["log_odds"] = odds_known(&r, &model) ? py::object(py::float_(q16(drogue_result_log_odds_q16(&r, &model))))
                                           : py::object(py::none());
    d["covariance"] = covariance;
    d["position_std_m"] = position_std;
    d["axis_std_rad"] = std::ldexp(static_cast<double>(r.axis_std_rad_q32), -32);
    return d;
}

void Memory::fit(int32_t width, int32_t height, uint32_t min_arc_px)
{
    drogue_capacity capacity;
    drogue_capacity_for_any(&capacity, width, height, min_arc_px);
    const size_t words = drogue_workspace_bytes(&capacity) / 8 + 1;
    if (words > workspace_words) {
        workspace_memory.reset(new uint64_t[words]);
        workspace_words = words;
    }
    if (drogue_workspace_init(&workspace, workspace_memory.get(), workspace_words * 8, &capacity) != DROGUE_OK) {
        throw std::bad_alloc();
    }
}

void Memory::fit_search(int32_t width)
{
    if (width > search_width) {
        search_memory.reset(new uint8_t[DROGUE_SEARCH_BYTES(width)]);
        search_width = width;
        drogue_search_init(&search, search_memory.get(), DROGUE_SEARCH_BYTES(width), width);
    }
}

static int32_t side(int32_t pixels) { return std::min<int32_t>(pixels, DROGUE_MAX_SIDE); }

static py::dict measure(const py::object &array, const py::sequence &camera_, const py::sequence &model_,
                        const py::object &region_, const py::dict &config_)
{
    const Grey grey = to_image(array);
    const drogue_camera camera = to_camera(camera_);
    refuse(ranges_centre(&camera, grey.image.width_px, grey.image.height_px));
    const drogue_model model = to_model(model_);
    const drogue_config config = to_config(config_);
    const drogue_setup setup = {&camera, &model, &config};
    const bool search = region_.is_none();
    const drogue_region region = search ? drogue_region() : to_region(region_);
    drogue_result result;
    {
        py::gil_scoped_release release;
        Memory memory;
        memory.fit(side(grey.image.width_px), side(grey.image.height_px), config.min_arc_px);
        if (search) {
            memory.fit_search(grey.image.width_px);
            drogue_acquire(&result, &memory.workspace, &memory.search, &setup, &grey.image, nullptr);
        } else {
            drogue_measure(&result, &memory.workspace, &setup, &grey.image, &region);
        }
    }
    return from_result(result, model);
}

static py::list search(const py::object &array)
{
    const Grey grey = to_image(array);
    py::list found;
    Memory memory;
    int32_t count;
    {
        py::gil_scoped_release release;
        memory.fit_search(grey.image.width_px);
        drogue_search_begin(&memory.search, grey.image.width_px);
        for (int32_t y = 0; y < grey.image.height_px; y++) {
            drogue_search_row(&memory.search, drogue_image_row(&grey.image, y));
        }
        count = drogue_search_end(&memory.search);
    }
    for (int32_t i = 0; i < count; i++) {
        const drogue_sighting &s = memory.search.best[i];
        found.append(py::make_tuple(from_region(s.region), s.x_px, s.y_px, s.radius_px, s.score));
    }
    return found;
}

static py::array_t<uint8_t> canny(const py::object &array, const py::object &low, const py::object &high, bool smooth)
{
    const auto threshold = [](const py::object &value) {
        return static_cast<int32_t>(to_whole(value, 0, INT32_MAX, "low and high must be whole numbers",
                                             "low and high are outside [0, 2147483647]"));
    };
    const Grey grey = to_image(array);
    const drogue_image &image = grey.image;
    py::array_t<uint8_t> map({image.height_px, image.width_px});
    uint8_t *const out = map.mutable_data();
    drogue_frontend_config config;
    drogue_status status;
    std::memset(&config, 0, sizeof config);
    config.canny_low = threshold(low);
    config.canny_high = threshold(high);
    config.smooth = smooth;
    config.min_arc_px = UINT32_MAX; // no arc is that long: the points are listed all the same
    {
        py::gil_scoped_release release;
        Memory memory;
        drogue_frontend frontend;
        drogue_edge_list list;
        std::memset(out, 0, static_cast<size_t>(image.width_px) * static_cast<size_t>(image.height_px));
        memory.fit(side(image.width_px), side(image.height_px), config.min_arc_px);
        status = drogue_frontend_begin(&frontend, &memory.workspace, &config, image.width_px, image.height_px);
        for (int32_t y = 0; status == DROGUE_OK && y < image.height_px; y++) {
            drogue_frontend_row(&frontend, drogue_image_row(&image, y));
        }
        status = status == DROGUE_OK ? drogue_frontend_end(&list, &frontend) : status;
        for (uint32_t i = 0; status == DROGUE_OK && i < list.edge_count; i++) {
            const drogue_edge *e = &memory.workspace.edges[i];
            out[static_cast<size_t>(drogue_edge_y_px(e)) * static_cast<size_t>(image.width_px) +
                static_cast<size_t>(drogue_edge_x_px(e))] = 255;
        }
    }
    if (status != DROGUE_OK) {
        throw py::value_error(std::string("canny: ") + drogue_status_name(status) +
                              ": 0 <= low <= high, and at most 2048 pixels a side");
    }
    return map;
}

} // namespace drogue_python

PYBIND11_MODULE(_native, module)
{
    using namespace drogue_python;
    module.def("version", &drogue_version);
    module.def("thresholds", &list_thresholds);
    module.def("measure", &measure);
    module.def("search", &search);
    module.def("canny", &canny);
    add_tracker(module);
}
