/* SPDX-License-Identifier: Apache-2.0 */
/* Both poses of an ellipse against the closed form in quadruple precision from the same Q16 ellipse. */
#include "geometry.h"
#include "golden.hpp"
#include "reference.hpp"

#include "drogue/pose.h"

namespace {

struct Difference {
    double position, axis, angles;
};

Difference difference(const drogue_pose &got, const reference::Pose &p)
{
    Difference d = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        d.position = std::max(d.position, lsb_from(got.position_m_q16[k], p.position[(std::size_t)k]));
        d.axis = std::max(d.axis, lsb_from(got.axis_q16[k], p.axis[(std::size_t)k]));
    }
    d.angles = std::max(lsb_from(got.yaw_rad_q16, p.yaw), lsb_from(got.pitch_rad_q16, p.pitch));
    return d;
}

} // namespace

int main()
{
    Report position("pose_position", 4), axis("pose_axis", 4), angles("pose_angles", 4);
    const drogue_camera camera = pinhole(1465.5, 1465.5, 1023.5, 1023.5);
    const drogue_q16 radius = 22938; /* 0.35 m */
    for (int seed = 1; seed <= 6000; seed++) {
        std::uint64_t rng = 0x905Eu + (std::uint64_t)seed;
        const double z = rng_real(&rng, 2, 25),
                     tilt = seed % 10 == 0 ? rng_real(&rng, 0, 0.01) : rng_real(&rng, 0, TEST_PI / 6);
        const double turn = rng_real(&rng, 0, 2 * TEST_PI), off = seed % 3 == 0 ? 0 : 0.5;
        const double centre[3] = {z * off * rng_real(&rng, -1, 1), z * off * rng_real(&rng, -1, 1), z};
        const double normal[3] = {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
        const std::string name = name_of("seed", seed);
        ellipse_real e;
        drogue_pose got[2];
        std::array<reference::Pose, 2> expected;
        if (!ellipse_of_circle(&e, centre, normal, real_of_q16(radius), 1465.5, 1465.5, 1023.5, 1023.5)) {
            continue;
        }
        drogue_ellipse ellipse = ellipse_to_q16(&e);
        if (seed % 7 == 0) { /* on the axis and exactly round: head-on */
            ellipse.xc_px_q16 = camera.cx_px_q16;
            ellipse.yc_px_q16 = camera.cy_px_q16;
            ellipse.b_px_q16 = ellipse.a_px_q16 - rng_range(&rng, 0, 2);
        }
        const reference::Ellipse seen = {real_of_q16(ellipse.xc_px_q16), real_of_q16(ellipse.yc_px_q16),
                                         real_of_q16(ellipse.a_px_q16), real_of_q16(ellipse.b_px_q16),
                                         real_of_q16(ellipse.angle_rad_q16)};
        const bool ok = reference::poses(seen, {1465.5L, 1465.5L, 1023.5L, 1023.5L}, real_of_q16(radius), expected);
        if (drogue_pose_from_ellipse(got, &ellipse, &camera, radius) != DROGUE_OK || !ok) {
            position.add(INFINITY, name);
            continue;
        }
        const Difference straight[2] = {difference(got[0], expected[0]), difference(got[1], expected[1])};
        const Difference crossed[2] = {difference(got[0], expected[1]), difference(got[1], expected[0])};
        const Difference *d = straight[0].axis + straight[1].axis + straight[0].position + straight[1].position <=
                                      crossed[0].axis + crossed[1].axis + crossed[0].position + crossed[1].position
                                  ? straight
                                  : crossed;
        position.add(std::max(d[0].position, d[1].position), name);
        axis.add(std::max(d[0].axis, d[1].axis), name);
        angles.add(std::max(d[0].angles, d[1].angles), name);
    }
    const bool ok[] = {position.finish(6000), axis.finish(6000), angles.finish(6000)};
    return ok[0] && ok[1] && ok[2] ? EXIT_SUCCESS : EXIT_FAILURE;
}
