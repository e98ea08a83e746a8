/* SPDX-License-Identifier: Apache-2.0 */
/* Whole frames, searched. */
#include "search_frames.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>

#include "drogue/search.h"
#include "tracker.hpp"

namespace accuracy {

namespace {

const cv::Size image_px = {1280, 720};

double thread_seconds()
{
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

cv::Rect square(double x, double y, double half)
{
    return {static_cast<int>(x - half), static_cast<int>(y - half), static_cast<int>(2 * half),
            static_cast<int>(2 * half)};
}

/* Where the rim is to be seen, and how large. */
struct Place {
    double x_px, y_px, a_px;
};

Place draw_place(Random &random)
{
    Place p;
    p.a_px = 8 * std::pow(150.0 / 8, random.uniform(0, 1));
    const double room = 1.15 * p.a_px + 4;
    p.x_px = random.uniform(room, image_px.width - room);
    p.y_px = random.uniform(room, image_px.height - room);
    return p;
}

void draw_pose(Scene &s, Random &random, const Place &p)
{
    const double z = s.camera.fx_px * s.drogue.rim_radius_m / p.a_px;
    const double tilt = random.uniform(0, 33) * CV_PI / 180;
    const double towards = random.uniform(0, 2 * CV_PI);
    const cv::Vec3d ray((p.x_px - s.camera.cx_px) / s.camera.fx_px, (p.y_px - s.camera.cy_px) / s.camera.fy_px, 1);
    const cv::Vec3d sight = cv::normalize(ray); /* the tilt is against the line of sight */
    const cv::Vec3d e1 = cv::normalize(cv::Vec3d(sight[2], 0, -sight[0]));
    const cv::Vec3d e2 = sight.cross(e1);
    s.pose.position_m = z * ray;
    s.pose.axis = std::cos(tilt) * sight + std::sin(tilt) * (std::cos(towards) * e1 + std::sin(towards) * e2);
}

bool right(const drogue_result &r, const WholeFrame &frame)
{
    const double limit = std::max(1.0, 0.03 * frame.rim.a_px);
    return frame.has_drogue && std::fabs(from_q16(r.ideal.xc_px_q16) - frame.rim.xc_px) < limit &&
           std::fabs(from_q16(r.ideal.yc_px_q16) - frame.rim.yc_px) < limit &&
           std::fabs(from_q16(r.ideal.a_px_q16) - frame.rim.a_px) < limit;
}

} // namespace

WholeFrame make_whole_frame(uint64_t seed, int index, bool has_drogue, const Variety &variety, const std::string &cache)
{
    WholeFrame f;
    Scene &s = f.scene;
    s.seed = hash_at(seed, index, (has_drogue ? 70 : 60) + variety.held_out);
    Random random(s.seed);
    const auto ground = static_cast<Ground>(index % grounds);
    const int things = index / grounds % 4; /* none, discs, aircraft, probe; discs with the last two at times */
    s.image_px = image_px;
    s.camera = {variety.held_out ? 1400.0 : 1100.0, variety.held_out ? 1400.0 : 1100.0, 639.5, 359.5};
    s.coarse = true;
    s.sensor.blur_px = random.uniform(0.4, 1.1);
    cv::Mat painted = paint_ground(random, ground, image_px);
    f.has_drogue = has_drogue;
    f.kind = name_of(ground);
    const Place at = draw_place(random);
    const cv::Rect about = square(at.x_px, at.y_px, 1.3 * at.a_px + 3);
    const cv::Rect kept = has_drogue ? about : cv::Rect();
    if (things == 2) {
        paint_aircraft(painted, random, kept);
        f.kind += ", aircraft";
    }
    if (things == 1 || (things > 1 && random.uniform(0, 1) < 0.4)) {
        paint_discs(painted, random, kept);
        f.kind += ", discs";
    }
    if (things == 3) {
        paint_probe(painted, random, kept);
        f.kind += ", probe";
    }
    draw_drogue(s, random, cv::mean(painted(about & cv::Rect({0, 0}, image_px)))[0], variety);
    draw_pose(s, random, at);
    f.rim = s.rim();
    s.background.plate = plate_of(painted, s.sensor.blur_px);
    const std::string path =
        cache.empty() ? "" : cache + "/frame_" + std::to_string(s.seed) + (has_drogue ? "_d" : "_n") + ".raw";
    f.image.create(image_px, CV_8U);
    std::ifstream in(path, std::ios::binary);
    if (path.empty() || !in.read(reinterpret_cast<char *>(f.image.data), image_px.area())) {
        f.image = exposed(has_drogue ? light_of(s) : s.background.plate, 1, random.uniform(1, 5), s.seed);
        if (!path.empty()) {
            std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char *>(f.image.data), image_px.area());
        }
    }
    return f;
}

Search search_whole(const WholeFrame &frame)
{
    const drogue_camera camera = camera_of(frame.scene.camera);
    const Drogue &d = frame.scene.drogue;
    const drogue_model model = {to_q16(d.rim_radius_m), to_q16(d.inner_radius_m), to_q16(d.inner_depth_m)};
    const drogue_image view = {frame.image.data, frame.image.cols, frame.image.rows,
                               static_cast<int32_t>(frame.image.step)};
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(std::max(view.width_px, view.height_px));
    std::vector<uint32_t> memory(drogue_workspace_bytes(&capacity) / sizeof(uint32_t) + 1);
    std::vector<uint8_t> search_memory(DROGUE_SEARCH_BYTES(static_cast<size_t>(view.width_px)));
    drogue_workspace workspace;
    drogue_search search;
    drogue_config config;
    const drogue_setup setup = {&camera, &model, &config};
    Search s;
    CV_Assert(drogue_workspace_init(&workspace, memory.data(), memory.size() * sizeof(uint32_t), &capacity) ==
                  DROGUE_OK &&
              drogue_search_init(&search, search_memory.data(), search_memory.size(), view.width_px) == DROGUE_OK);
    drogue_config_default(&config);
    const double before = thread_seconds();
    (void)drogue_acquire(&s.result, &workspace, &search, &setup, &view, nullptr);
    s.seconds = thread_seconds() - before;
    s.finding = s.result.status != DROGUE_OK ? Finding::none : right(s.result, frame) ? Finding::hit : Finding::wrong;
    s.log_odds = s.result.status == DROGUE_OK || s.result.status == DROGUE_E_UNSURE
                     ? drogue_result_log_odds_q16(&s.result, &model) / 65536.0
                     : std::nan("");
    s.unsure_right = s.result.status == DROGUE_E_UNSURE && right(s.result, frame);
    s.sighted = -1;
    for (int k = search.count - 1; k >= 0 && frame.has_drogue; k--) {
        const drogue_sighting &b = search.best[k];
        if (std::hypot(b.x_px - frame.rim.xc_px, b.y_px - frame.rim.yc_px) < 0.35 * frame.rim.a_px &&
            b.radius_px > 0.8 * frame.rim.a_px && b.radius_px < 1.25 * frame.rim.a_px) {
            s.sighted = k;
        }
    }
    drogue_result there;
    const cv::Rect about = square(frame.rim.xc_px, frame.rim.yc_px, 1.25 * frame.rim.a_px);
    const drogue_region region = {about.x, about.y, about.width, about.height};
    (void)drogue_measure(&there, &workspace, &setup, &view, &region);
    s.can_be = there.status == DROGUE_OK && right(there, frame);
    s.can_decide = s.can_be && there.orientation_resolved;
    return s;
}

} // namespace accuracy
