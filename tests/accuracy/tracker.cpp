/* SPDX-License-Identifier: Apache-2.0 */
/* The library's tracker with its memory. */
#include "tracker.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace accuracy {

namespace {

drogue_capacity capacity_for(const cv::Size &image) { return DROGUE_CAPACITY_FOR(std::max(image.width, image.height)); }

size_t workspace_words(const cv::Size &image)
{
    const drogue_capacity capacity = capacity_for(image);
    return drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1;
}

} // namespace

Pose pose_of(const drogue_pose &p)
{
    return {{from_q16(p.position_m_q16[0]), from_q16(p.position_m_q16[1]), from_q16(p.position_m_q16[2])},
            axis_of(from_q16(p.yaw_rad_q16), from_q16(p.pitch_rad_q16))};
}

drogue_camera camera_of(const Camera &c)
{
    return {to_q16(c.fx_px), to_q16(c.fy_px), to_q16(c.cx_px), to_q16(c.cy_px), to_q16(c.k1),
            to_q16(c.k2),    to_q16(c.p1),    to_q16(c.p2),    to_q16(c.k3)};
}

Tracker::Tracker(const Scene &scene)
    : memory_(workspace_words(scene.image_px)),
      search_memory_(DROGUE_SEARCH_BYTES(static_cast<size_t>(scene.image_px.width)))
{
    const drogue_capacity capacity = capacity_for(scene.image_px);
    const drogue_camera camera = camera_of(scene.camera);
    const drogue_model model = {to_q16(scene.drogue.rim_radius_m), to_q16(scene.drogue.inner_radius_m),
                                to_q16(scene.drogue.inner_depth_m)};
    drogue_track_config track_config;
    if (drogue_workspace_init(&workspace_, memory_.data(), memory_.size() * sizeof(uint32_t), &capacity) != DROGUE_OK ||
        drogue_search_init(&search_, search_memory_.data(), search_memory_.size(), scene.image_px.width) != DROGUE_OK) {
        throw std::runtime_error("workspace refused");
    }
    drogue_config_default(&config_);
    drogue_track_config_default(&track_config);
    (void)drogue_track_init(&track, &track_config, &camera, &model, nullptr);
}

void Tracker::frame(drogue_result &result, const drogue_image &image, uint32_t dt_us)
{
    drogue_region region;
    drogue_track_frame(&result, &region, &track, &workspace_, &search_, &config_, &image, dt_us);
}

SequenceFrame describe(const drogue_track &track, const drogue_result &result)
{
    SequenceFrame f = {};
    drogue_track_estimate e;
    drogue_track_get(&e, &track);
    f.state = track.state;
    f.gated = track.gated != 0;
    f.measured = result.status == DROGUE_OK;
    f.raw = pose_of(result.pose);
    f.filtered = {{from_q16(e.position_m_q16[0]), from_q16(e.position_m_q16[1]), from_q16(e.position_m_q16[2])},
                  axis_of(from_q16(e.yaw_rad_q16), from_q16(e.pitch_rad_q16))};
    for (int k = 0; k < 3; k++) {
        f.filtered_std[k] = std::ldexp(static_cast<double>(e.position_std_m_q32[k]), -32);
    }
    f.filtered_std[3] = std::ldexp(static_cast<double>(e.yaw_std_rad_q32), -32);
    f.filtered_std[4] = std::ldexp(static_cast<double>(e.pitch_std_rad_q32), -32);
    return f;
}

} // namespace accuracy
