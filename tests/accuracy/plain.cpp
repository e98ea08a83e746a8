/* SPDX-License-Identifier: Apache-2.0 */
/* Draws the plain scenes. */
#include "plain.hpp"

#include <cmath>

namespace accuracy {

cv::Vec3d draw_place(Random &random, double distance_m, double field)
{
    const double down = random.uniform(-field, field);
    const double across = random.uniform(-field, field);
    return distance_m * cv::Vec3d(across, down, 1);
}

cv::Vec3d draw_sun(Random &random)
{
    const double z = random.uniform(-1, 0.5);
    const double y = random.uniform(-1, -0.2);
    const double x = random.uniform(-1, 1);
    return cv::normalize(cv::Vec3d(x, y, z));
}

PlainScene plain_scene(uint64_t seed, double distance_m, int index)
{
    const double tilt = 20 * CV_PI / 180;
    const double field = 0.25; /* tan 14 degrees */
    PlainScene plain;
    Scene &s = plain.scene;
    s.seed = hash_at(seed, index, std::lround(distance_m * 1000));
    Random random(s.seed);

    s.pose.position_m = draw_place(random, distance_m, field);
    const double yaw = random.uniform(-tilt, tilt);
    const double pitch = random.uniform(-tilt, tilt);
    s.pose.axis = axis_of(yaw, pitch);
    s.drogue.rib_phase = random.uniform(0, 1);
    s.look = index % 3 == 1 || index % 6 == 5 ? Look::bright() : Look::dark();
    s.background = index % 3 == 0 ? Background::sky() : index % 3 == 1 ? Background::ground() : Background::cloud();
    s.look.sun = draw_sun(random);
    s.sensor.blur_px = random.uniform(0.5, 0.9);

    const Ellipse rim = s.rim();
    const int side = static_cast<int>(std::lround(2.5 * rim.a_px));
    const double x = rim.xc_px + 0.03 * rim.a_px * random.uniform(-1, 1);
    const double y = rim.yc_px + 0.03 * rim.a_px * random.uniform(-1, 1);
    plain.region = cv::Rect(static_cast<int>(std::lround(x - (side - 1) / 2.0)),
                            static_cast<int>(std::lround(y - (side - 1) / 2.0)), side, side);
    return plain;
}

} // namespace accuracy
