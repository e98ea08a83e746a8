/* SPDX-License-Identifier: Apache-2.0 */
/* The joint pose, its covariance and chi2 against Gauss-Newton in double from the same Q16 inputs; image of the inner disc. */
#include "geometry.h"
#include "golden.hpp"
#include "reference.hpp"

#include "drogue/joint.h"

namespace {

double packed_difference(const drogue_real *got, const reference::Covariance &expected)
{
    double most = 0;
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j <= i; j++) {
            const drogue_real w = got[DROGUE_PACKED(i, j)];
            const double scale = std::sqrt(expected(i, i) * expected(j, j));
            most = std::max(most, std::fabs(std::ldexp((double)w.mantissa, w.exponent) - expected(i, j)) / scale);
        }
    }
    return most * 0x1p20; /* units of 2^-20 of the entry's scale */
}

struct Task {
    drogue_joint_outline outline;
    drogue_support support;
    drogue_joint_inner inner;
    drogue_pose start;
    drogue_model model;
    reference::Support model_support;
};

/* False when there is no image of the circle. */
bool random_task(Task *t, int seed, const drogue_camera *camera)
{
    std::uint64_t rng = 0x701Du + (std::uint64_t)seed;
    const double z = rng_real(&rng, 2, 25), tilt = rng_real(&rng, 0, TEST_PI / 6),
                 turn = rng_real(&rng, 0, 2 * TEST_PI);
    const double centre[3] = {z * rng_real(&rng, -0.3, 0.3), z * rng_real(&rng, -0.3, 0.3), z};
    const double normal[3] = {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
    ellipse_real e;
    drogue_pose pair[2];
    drogue_choice choice;
    *t = Task();
    t->model = {22938, 7864, 16384};
    if (!ellipse_of_circle(&e, centre, normal, 22938 / 65536.0, 1465.5, 1465.5, 1023.5, 1023.5)) {
        return false;
    }
    e.a += 0.03 * rng_normal(&rng);
    e.b = std::min(e.a, e.b + 0.03 * rng_normal(&rng));
    t->outline.ellipse = ellipse_to_q16(&e);
    const double middle[3] = {centre[0] + 0.25 * normal[0], centre[1] + 0.25 * normal[1], centre[2] + 0.25 * normal[2]};
    t->inner.x_px_q16 = q16_of(1465.5 * middle[0] / middle[2] + 1023.5 + 0.05 * rng_normal(&rng));
    t->inner.y_px_q16 = q16_of(1465.5 * middle[1] / middle[2] + 1023.5 + 0.05 * rng_normal(&rng));
    t->inner.std_px_q16 = seed % 4 == 0 ? 0 : rng_range(&rng, 1500, 12000);
    for (int k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const int n = std::max(1, (int)(e.a * rng_real(&rng, 0.13, 0.19)));
        const int sum = (int)std::lround(65536 * 0.1 * rng_normal(&rng) / e.a * n);
        t->support.bin[k].count[0] = (std::uint32_t)n;
        t->support.bin[k].sum_q16 = sum;
        t->support.points += (std::uint32_t)n;
        t->model_support.count[(std::size_t)k][0] = n;
        t->model_support.sum[(std::size_t)k] = sum / 65536.0L;
    }
    t->support.gradient = 150u * t->support.points;
    t->support.axis_rad_q16 = t->outline.ellipse.angle_rad_q16;
    t->model_support.points = (int)t->support.points;
    t->model_support.gradient = (reference::Real)t->support.gradient;
    if (drogue_pose_from_ellipse(pair, &t->outline.ellipse, camera, t->model.rim_radius_m_q16) != DROGUE_OK ||
        drogue_choose_pose(&choice, pair, t->inner.x_px_q16, t->inner.y_px_q16, t->model.inner_depth_m_q16, camera) !=
            DROGUE_OK) {
        return false;
    }
    t->start = pair[seed % 7 == 0 ? 1 - choice.index : choice.index];
    return true;
}

} // namespace

int main()
{
    Report position("joint_position", 1), axis("joint_axis", 1), angles("joint_angles", 1),
        covariance("joint_covariance", 64), outline("outline_covariance", 1), chi2("joint_chi2", 16),
        disc("inner_disc", 2);
    const drogue_camera camera = pinhole(1465.5, 1465.5, 1023.5, 1023.5);
    const reference::Camera model_camera = {1465.5L, 1465.5L, 1023.5L, 1023.5L};
    for (int seed = 1; seed <= 1500; seed++) {
        const std::string name = name_of("seed", seed);
        Task t;
        drogue_joint got;
        drogue_ellipse image;
        if (!random_task(&t, seed, &camera)) {
            continue;
        }
        const drogue_ellipse &q = t.outline.ellipse;
        const reference::Ellipse e = {real_of_q16(q.xc_px_q16), real_of_q16(q.yc_px_q16), real_of_q16(q.a_px_q16),
                                      real_of_q16(q.b_px_q16), real_of_q16(q.angle_rad_q16)};
        const reference::Model model = {real_of_q16(t.model.rim_radius_m_q16), real_of_q16(t.model.inner_radius_m_q16),
                                        real_of_q16(t.model.inner_depth_m_q16)};
        reference::Pose start;
        for (std::size_t k = 0; k < 3; k++) {
            start.position[k] = real_of_q16(t.start.position_m_q16[k]);
            start.axis[k] = real_of_q16(t.start.axis_q16[k]);
        }
        start.yaw = real_of_q16(t.start.yaw_rad_q16);
        start.pitch = real_of_q16(t.start.pitch_rad_q16);
        reference::Covariance expected_outline;
        reference::Ellipse expected_image;
        drogue_real own_outline[DROGUE_PACKED_MAX];
        if (drogue_joint_outline_covariance(own_outline, &q, &t.support, 249037, 7864) != DROGUE_OK ||
            drogue_joint_outline_weigh(&t.outline, &q, own_outline) != DROGUE_OK ||
            !reference::outline_covariance(expected_outline, e, t.model_support, 249037 / 65536.0L, 7864 / 65536.0L)) {
            outline.add(INFINITY, name);
            continue;
        }
        outline.add(packed_difference(own_outline, expected_outline), name);
        const reference::Joint expected = reference::solve_joint(
            start, e, expected_outline,
            {{real_of_q16(t.inner.x_px_q16), real_of_q16(t.inner.y_px_q16)}, real_of_q16(t.inner.std_px_q16)},
            model_camera, model, 5);
        if (drogue_joint_solve(&got, &t.start, &t.outline, &t.inner, &camera, &t.model, 5) != DROGUE_OK ||
            expected.solved != reference::Solved::ok) {
            position.add(INFINITY, name);
            continue;
        }
        double most[2] = {0, 0};
        for (int k = 0; k < 3; k++) {
            most[0] = std::max(most[0], lsb_from(got.pose.position_m_q16[k], expected.pose.position[(std::size_t)k]));
            most[1] = std::max(most[1], lsb_from(got.pose.axis_q16[k], expected.pose.axis[(std::size_t)k]));
        }
        position.add(most[0], name);
        axis.add(most[1], name);
        angles.add(std::max(lsb_from(got.pose.yaw_rad_q16, expected.pose.yaw),
                            lsb_from(got.pose.pitch_rad_q16, expected.pose.pitch)),
                   name);
        covariance.add(packed_difference(got.covariance, expected.covariance), name);
        const double found = std::ldexp((double)got.chi2.mantissa, got.chi2.exponent);
        chi2.add(65536 * std::fabs(found - expected.chi2) / (1 + expected.chi2), name);
        const bool seen = reference::disc_image(expected_image, start, model_camera, model) == reference::Solved::ok;
        if (drogue_inner_disc_image(&image, &t.start, &camera, &t.model) == DROGUE_OK && seen) {
            disc.add(
                std::max({lsb_from(image.xc_px_q16, expected_image.xc), lsb_from(image.yc_px_q16, expected_image.yc),
                          lsb_from(image.a_px_q16, expected_image.a), lsb_from(image.b_px_q16, expected_image.b)}),
                name);
        }
    }
    const bool ok[] = {position.finish(1400), axis.finish(1400), angles.finish(1400), covariance.finish(1400),
                       outline.finish(1400),  chi2.finish(1400), disc.finish(1400)};
    return std::all_of(std::begin(ok), std::end(ok), [](bool v) { return v; }) ? EXIT_SUCCESS : EXIT_FAILURE;
}
