/* SPDX-License-Identifier: Apache-2.0 */
/* Both poses of an ellipse against the closed form in quadruple precision from the same Q16 ellipse. */
#include "geometry.h"
#include "golden.hpp"
#include "quad.h"

#include "drogue/pose.h"

namespace {

struct Pose {
    long double position[3], axis[3], yaw, pitch;
};

/* Paper (20)-(30), signs as design corrects them. */
void closed_form(Pose out[2], const drogue_ellipse &e, const drogue_camera &c, drogue_q16 radius)
{
    const quad fx = (quad)c.fx_px_q16 / 65536, fy = (quad)c.fy_px_q16 / 65536, r = (quad)radius / 65536;
    const quad u = ((quad)e.xc_px_q16 - c.cx_px_q16) / 65536 / fx, v = ((quad)e.yc_px_q16 - c.cy_px_q16) / 65536 / fy;
    const quad a = (quad)e.a_px_q16 / 65536, b = (quad)e.b_px_q16 / 65536;
    const quad cosine = cosl((long double)e.angle_rad_q16 / 65536), sine = sinl((long double)e.angle_rad_q16 / 65536);
    quad m[3][3], value[3], vector[3][3];
    /* Major and minor axis as rows: the ellipse is p p' + q q' = 1 in normalised coordinates. */
    const quad p[2] = {cosine * fx / a, sine * fy / a}, q[2] = {-sine * fx / b, cosine * fy / b};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            m[i][j] = p[i] * p[j] + q[i] * q[j];
        }
    }
    m[0][2] = m[2][0] = -(m[0][0] * u + m[0][1] * v);
    m[1][2] = m[2][1] = -(m[1][0] * u + m[1][1] * v);
    m[2][2] = -(m[0][2] * u + m[1][2] * v) - 1;
    quad_eigen3(value, vector, m);
    const quad sum = value[0] - value[2], tilt = quad_sqrt((value[0] - value[1]) / sum),
               upright = quad_sqrt((value[1] - value[2]) / sum);
    const quad x = r * tilt * quad_sqrt(-value[2] / value[0]), z = r * upright * quad_sqrt(value[0] / -value[2]);
    const int away = vector[2][2] < 0 ? -1 : 1;
    for (int i = 0; i < 2; i++) {
        const int side = i == 0 ? 1 : -1;
        for (int k = 0; k < 3; k++) {
            out[i].position[k] = (long double)(side * x * vector[0][k] + away * z * vector[2][k]);
            out[i].axis[k] = (long double)(-side * tilt * vector[0][k] + away * upright * vector[2][k]);
        }
        out[i].yaw = atan2l(out[i].axis[0], out[i].axis[2]);
        out[i].pitch = asinl(std::clamp(out[i].axis[1], -1.0L, 1.0L));
    }
}

struct Difference {
    double position, axis, angles;
};

Difference difference(const drogue_pose &got, const Pose &p)
{
    Difference d = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        d.position = std::max(d.position, lsb_from(got.position_m_q16[k], p.position[k]));
        d.axis = std::max(d.axis, lsb_from(got.axis_q16[k], p.axis[k]));
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
        Pose expected[2];
        if (!ellipse_of_circle(&e, centre, normal, real_of_q16(radius), 1465.5, 1465.5, 1023.5, 1023.5)) {
            continue;
        }
        drogue_ellipse ellipse = ellipse_to_q16(&e);
        if (seed % 7 == 0) { /* on the axis and exactly round: head-on */
            ellipse.xc_px_q16 = camera.cx_px_q16;
            ellipse.yc_px_q16 = camera.cy_px_q16;
            ellipse.b_px_q16 = ellipse.a_px_q16 - rng_range(&rng, 0, 2);
        }
        if (drogue_pose_from_ellipse(got, &ellipse, &camera, radius) != DROGUE_OK) {
            position.add(INFINITY, name);
            continue;
        }
        closed_form(expected, ellipse, camera, radius);
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
