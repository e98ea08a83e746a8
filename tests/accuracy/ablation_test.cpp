/* SPDX-License-Identifier: Apache-2.0 */
/* Self-test of the reduced extractions: the stages put together give the library's measurement bit for bit, each
 * reduced extraction works where nothing disturbs it, and none invents a drogue. */
#include <cmath>
#include <cstdio>
#include <cstring>

#include "ablation.hpp"
#include "check.hpp"
#include "measure.hpp"
#include "plain.hpp"

using namespace accuracy;

namespace {

const drogue_model model = {to_q16(0.35), to_q16(0.12), to_q16(0.25)};

Ellipse outline_of(const drogue_result &r)
{
    return {from_q16(r.ideal.xc_px_q16), from_q16(r.ideal.yc_px_q16), from_q16(r.ideal.a_px_q16),
            from_q16(r.ideal.b_px_q16), from_q16(r.ideal.angle_rad_q16)};
}

cv::Mat picture(const Scene &scene, const cv::Rect &region)
{
    cv::Mat image = cv::Mat::zeros(scene.image_px, CV_8U);
    render(scene, region).copyTo(image(region));
    return image;
}

void test_stages()
{
    for (const double distance : {6.0, 14.0, 25.0}) {
        for (int i = 0; i < 6; i++) {
            const PlainScene plain = plain_scene(7, distance, i);
            const Camera &camera = plain.scene.camera;
            const cv::Mat image = picture(plain.scene, plain.region);
            const Measurement m = measure(image, camera, model, plain.region);
            const drogue_result r = measure_by_stages(image, camera, model, plain.region, m.raw);
            truth("stages: measured", m.ok && r.status == DROGUE_OK);
            truth("stages: outline", std::memcmp(&r.ideal, &m.raw.ideal, sizeof r.ideal) == 0);
            truth("stages: pose", std::memcmp(&r.pose, &m.raw.pose, sizeof r.pose) == 0);
            truth("stages: other pose", std::memcmp(&r.alternative, &m.raw.alternative, sizeof r.pose) == 0);
            truth("stages: resolved", r.orientation_resolved == m.raw.orientation_resolved);
            truth("stages: covariance",
                  std::memcmp(r.covariance_q48, m.raw.covariance_q48, sizeof r.covariance_q48) == 0);
        }
    }
}

/* A drogue that is one grey level in its rim and walls, on one other: the rim is the only edge in the ring mask. */
void test_undisturbed()
{
    for (const bool bright : {false, true}) {
        Scene s;
        s.pose = {{0.4, -0.3, 8}, axis_of(0.15, -0.1)};
        s.look = bright ? Look::bright() : Look::dark();
        s.background = {bright ? 40.0 : 220.0, bright ? 40.0 : 220.0, 0, 64, 0};
        s.look.ambient = 1;
        s.look.rib_gain = 1;
        s.look.depth_loss = 0;
        s.drogue.hose_length_m = 0;
        s.drogue.housing_length_m = 0;
        s.sensor.noise = 0.5;
        const Ellipse rim = s.rim();
        const int side = static_cast<int>(2.5 * rim.a_px);
        const cv::Rect region(static_cast<int>(rim.xc_px) - side / 2, static_cast<int>(rim.yc_px) - side / 2, side,
                              side);
        const cv::Mat image = picture(s, region);
        const Measurement m = measure(image, s.camera, model, region);
        truth("undisturbed: library", m.ok);
        for (const drogue_result &r : ablate(image, s.camera, model, region, m.raw)) {
            truth("undisturbed: measured", r.status == DROGUE_OK);
            near("undisturbed: outline, px", ellipse_error_px(outline_of(r), rim), 0, 0.1);
            near("undisturbed: z, m", from_q16(r.pose.position_m_q16[2]), 8, 0.02);
            truth("undisturbed: orientation", r.orientation_resolved != 0);
        }
    }
}

void test_nothing_there()
{
    const cv::Mat flat(400, 400, CV_8U, cv::Scalar(128));
    const Camera camera = {1465.5, 1465.5, 199.5, 199.5};
    const cv::Rect region(100, 100, 200, 200);
    const Measurement m = measure(flat, camera, model, region);
    for (const drogue_result &r : ablate(flat, camera, model, region, m.raw)) {
        truth("flat picture: refused", r.status != DROGUE_OK);
    }
    /* A stroke through the ring is no ellipse for any extraction with arcs or score. */
    cv::Mat stroke = flat.clone();
    stroke.rowRange(130, 400) = cv::Scalar(40);
    const Measurement n = measure(stroke, camera, model, region);
    const auto results = ablate(stroke, camera, model, region, n.raw);
    for (const Extraction e : {Extraction::arcs, Extraction::quality, Extraction::both}) {
        truth("straight edge: refused", results[static_cast<size_t>(e)].status != DROGUE_OK);
    }
}

/* The region may reach past the image. */
void test_border()
{
    Scene s;
    s.pose = {{-4.55, 0.5, 7}, axis_of(0.1, 0.05)};
    const Ellipse rim = s.rim();
    const int side = static_cast<int>(2.5 * rim.a_px);
    const cv::Rect region(static_cast<int>(rim.xc_px) - side / 2, static_cast<int>(rim.yc_px) - side / 2, side, side);
    const cv::Rect seen = region & cv::Rect({0, 0}, s.image_px);
    truth("border: the region reaches past it", seen.width < region.width);
    const cv::Mat image = picture(s, seen);
    const Measurement m = measure(image, s.camera, model, region);
    truth("border: library", m.ok);
    for (const drogue_result &r : ablate(image, s.camera, model, region, m.raw)) {
        truth("border: measured", r.status == DROGUE_OK);
        near("border: x of the outline", outline_of(r).xc_px, rim.xc_px, 0.2 * rim.a_px);
    }
}

} // namespace

int main()
{
    test_stages();
    test_undisturbed();
    test_nothing_there();
    test_border();
    return finish("ablation_test");
}
