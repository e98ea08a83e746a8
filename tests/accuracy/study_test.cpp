/* SPDX-License-Identifier: Apache-2.0 */
/* Self-test of the study: the conditions keep their promises, verdicts and calibration are computed right, bars are
 * judged as written. */
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <opencv2/imgproc.hpp>

#include "check.hpp"
#include "evaluate.hpp"
#include "report.hpp"

using namespace accuracy;

namespace {

/* Largest share of a canopy's outline whose background is within 10 grey levels of it, over the scenes. */
double low_contrast_share(const Trial &t)
{
    const cv::Point2d centre(t.rim.xc_px, t.rim.yc_px);
    int low = 0;
    for (int i = 0; i < 360; i++) {
        const cv::Point2d edge = t.rim.at(i * CV_PI / 180);
        const cv::Point2d outside = centre + 1.02 * (edge - centre);
        const double canopy = trace(t.scene, centre + 0.985 * (edge - centre)).grey;
        const double behind = background_grey(t.scene, cvRound(outside.x), cvRound(outside.y));
        low += std::fabs(canopy - behind) <= 10;
    }
    return low / 360.0;
}

void test_promises(const Trial &t)
{
    const Scene &s = t.scene;
    const double a = t.rim.a_px;
    const bool off = t.condition == Condition::off_centre || t.condition == Condition::all;
    const double shift = (off ? 0.15 : 0.03) * a + 0.5;
    const double x = t.region.x + (t.region.width - 1) / 2.0;
    const double y = t.region.y + (t.region.height - 1) / 2.0;
    truth("region within the image", (t.region & cv::Rect({0, 0}, s.image_px)) == t.region);
    truth("region's centre", std::fabs(x - t.rim.xc_px) <= shift && std::fabs(y - t.rim.yc_px) <= shift);
    truth("region's side", std::fabs(t.region.width / a - 2.5) <= (off ? 0.3 : 0) + 0.5 / a);
    truth("distance", s.pose.position_m[2] >= 2 && s.pose.position_m[2] <= 25);
    truth("tilt", angle_between_deg(s.pose.axis, {0, 0, 1}) <= 30 + 1e-9);
    truth("line of sight", angle_between_deg(s.pose.axis, cv::normalize(s.pose.position_m)) <= 36);
    near("rim of the model", from_q16(t.model.rim_radius_m_q16), s.drogue.rim_radius_m - 0.84 * s.drogue.scallop_m / 2,
         1e-5);
    near("end plane and inner part",
         cv::norm(t.pose.position_m + from_q16(t.model.inner_depth_m_q16) * t.pose.axis - s.inner_centre_m()), 0, 1e-5);
    truth("Gaussian blur", s.sensor.motion_sigma_px <= std::min(3.0, 0.1 * a));
    truth("linear blur", s.sensor.motion_length_px <= std::min(9.0, 0.25 * a));
    truth("noise", s.sensor.noise >= 2 && s.sensor.noise <= 8);
    truth("scallops", s.drogue.scallop_m <= 0.03 * s.drogue.rim_radius_m);
    if (s.sensor.light_radius_px > 0) {
        for (int i = 0; i < 360; i++) {
            const double distance = cv::norm(t.rim.at(i * CV_PI / 180) - s.sensor.light_at_px);
            truth("light", 1 - distance / s.sensor.light_radius_px > 0.32);
        }
    }
}

void test_conditions()
{
    for (int c = 0; c < conditions; c++) {
        const auto condition = static_cast<Condition>(c);
        int near_ones = 0;
        double low = 0;
        for (int i = 0; i < 120; i++) {
            const Trial t = trial(7, condition, i);
            test_promises(t);
            near_ones += t.distance_m() < 2 * std::sqrt(12.5);
            low = std::max(low, low_contrast_share(t));
            truth("the same again", fingerprint(t) == fingerprint(trial(7, condition, i)));
            truth("another index", fingerprint(t) != fingerprint(trial(7, condition, i + 1)));
            truth("another seed", fingerprint(t) != fingerprint(trial(8, condition, i)));
            if (condition == Condition::low_contrast) {
                truth("low contrast over part of each outline", low_contrast_share(t) > 0.02);
            }
        }
        near("distances spread evenly in their logarithm", near_ones, 60, 2);
        if (condition == Condition::plain) {
            truth("enough contrast in plain scenes", low < 0.25); /* here and there ribs before cloud */
        }
    }
    const Trial t = trial(3, Condition::all, 5);
    truth("the picture is the same again",
          cv::norm(picture_of(t, ""), picture_of(trial(3, Condition::all, 5), ""), cv::NORM_INF) == 0);
}

/* The mean outline of a scalloped drogue has its area. */
void test_scallops()
{
    for (int i = 0; i < 4; i++) {
        Trial t = trial_at(1, Condition::scallops, i, 3);
        Scene &s = t.scene;
        s.background = {0, 0, 0, 64, 0};
        s.look.canopy_grey = s.look.coupling_grey = s.look.inner_grey = 100;
        s.look.rib_gain = s.look.ambient = 1;
        s.look.depth_loss = 0;
        s.drogue.hose_length_m = s.drogue.housing_length_m = 0;
        const cv::Moments m = cv::moments(render_light(s, t.region));
        const double mean_radius = std::sqrt(t.rim.a_px * t.rim.b_px);
        near("area of a scalloped drogue, as radius", std::sqrt(m.m00 / 100 / CV_PI) / mean_radius, 1, 2e-4);
        near("its centre x", m.m10 / m.m00 + t.region.x, t.rim.xc_px, 0.02);
        near("its centre y", m.m01 / m.m00 + t.region.y, t.rim.yc_px, 0.02);
    }
}

/* A measurement off the truth by given errors, with a covariance. */
Measurement off_by(const Trial &t, const cv::Vec<double, 5> &e, const cv::Matx<double, 5, 5> &c)
{
    Measurement m = {};
    m.ok = true;
    m.raw.status = DROGUE_OK;
    m.raw.has_inner = m.raw.orientation_resolved = 1;
    m.ideal = t.rim;
    m.pose.position_m = t.pose.position_m + cv::Vec3d(e[0], e[1], e[2]);
    m.pose.axis = axis_of(yaw_of(t.pose.axis) + e[3], pitch_of(t.pose.axis) + e[4]);
    m.alternative = {m.pose.position_m, {0, 0, -1}};
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 5; j++) {
            m.raw.covariance_q48[i][j] = std::llround(std::ldexp(c(i, j), 48));
        }
    }
    return m;
}

void test_calibration()
{
    /* Errors L g with normal g have the covariance L L'. */
    const double root[25] = {1e-4, 0, 0,    0, 0,    5e-5, 2e-4, 0, 0,    0,     1e-3, -2e-3, 5e-3,
                             0,    0, 1e-3, 0, 2e-3, 3e-3, 0,    0, 1e-3, -1e-3, 5e-4, 2e-3};
    const cv::Matx<double, 5, 5> l(root);
    const Trial t = trial(1, Condition::plain, 0);
    std::vector<Outcome> outcomes;
    for (int i = 0; i < 4000; i++) {
        cv::Vec<double, 5> g;
        for (int k = 0; k < 5; k++) {
            g[k] = normal_at(99, i, k);
        }
        outcomes.push_back(judge(t, off_by(t, l * g, l * l.t())));
    }
    const Summary s = summarise(outcomes);
    near("right", s.right, 4000, 0);
    near("with covariance", s.with_covariance, 4000, 0);
    near("normalised error squared", s.mean_nees, 5, 0.2);
    near("its median", s.median_nees, 4.35, 0.2);
    near("of the position", s.mean_nees_position, 3, 0.15);
    near("of the angles", s.mean_nees_angles, 2, 0.1);

    truth("no covariance", !judge(t, off_by(t, {}, {})).has_covariance);
    cv::Matx<double, 5, 5> indefinite = cv::Matx<double, 5, 5>::eye() * 1e-6;
    indefinite(0, 1) = indefinite(1, 0) = 2e-6;
    truth("no covariance that is indefinite", !judge(t, off_by(t, {}, indefinite)).has_covariance);
}

void test_verdicts()
{
    const Trial t = trial_at(1, Condition::plain, 0, 10);
    const cv::Matx<double, 5, 5> none;
    Measurement m = off_by(t, {0.01, -0.02, 0.03, 0, 0}, none);
    const Outcome o = judge(t, m);
    truth("right", o.verdict == Verdict::right && !o.twin);
    near("x", o.percent()[0], 0.1, 1e-9);
    near("y", o.percent()[1], 0.2, 1e-9);
    near("mean", o.percent_mean(), 0.2, 1e-9);
    const double limit = std::max(1.0, 0.03 * t.rim.a_px);
    m.ideal.a_px += 1.05 * limit;
    m.ideal.b_px += 1.05 * limit;
    truth("wrong", judge(t, m).verdict == Verdict::wrong);
    m.ideal = t.rim;
    m.pose.axis = axis_of(yaw_of(t.pose.axis) + 0.3, 0);
    m.alternative = t.pose;
    truth("twin", judge(t, m).twin);
    m.raw.orientation_resolved = 0;
    truth("open, no twin", !judge(t, m).twin && !judge(t, m).resolved);
    m.ok = false;
    m.raw.status = DROGUE_E_NO_ELLIPSE;
    const Summary s = summarise({o, judge(t, m)});
    truth("unmeasured", s.unmeasured == 1 && s.right == 1 && s.statuses.at("no_ellipse") == 1);
}

std::string report_of(const std::string &folder)
{
    std::ifstream in(folder + "/report.md");
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

void test_bars(const std::string &folder)
{
    const auto verdict = [&](const auto &judge) {
        Report report(folder, "test");
        judge(report);
        return report.finish();
    };
    truth("at most", verdict([](Report &r) { r.at_most("v", 1.0, 1.0, "px"); }));
    truth("above", !verdict([](Report &r) { r.at_most("v", 1.0001, 1.0, "px"); }));
    truth("no number", !verdict([](Report &r) { r.at_most("v", std::nan(""), 1.0, "px"); }));
    truth("at least", verdict([](Report &r) { r.at_least("v", 1.0, 1.0, "px"); }));
    truth("below", !verdict([](Report &r) { r.at_least("v", 0.9999, 1.0, "px"); }));
    truth("within", verdict([](Report &r) { r.within("v", 4.1, 4, 6, ""); }));
    truth("beyond", !verdict([](Report &r) { r.within("v", 6.1, 4, 6, ""); }));
    truth("known", verdict([](Report &r) {
              r.known_missed("v", "a reason");
              r.at_most("v", 2, 1, "px");
          }));
    truth("known shows", report_of(folder).find("**missed**, known: a reason") != std::string::npos);
    truth("not judged", verdict([](Report &r) { r.not_judged("v", "a reason"); }));
    truth("10 of 1000 at 1 %", verdict([](Report &r) { r.rate_at_most("v", 10, 1000, 0.01); }));
    truth("11 of 1000 at 1 %", !verdict([](Report &r) { r.rate_at_most("v", 11, 1000, 0.01); }));
    truth("3 of 1000 at 0.2 %", !verdict([](Report &r) { r.rate_at_most("v", 3, 1000, 0.002); }));
    truth("1 of 60 at 0.2 %", verdict([](Report &r) { r.rate_at_most("v", 1, 60, 0.002); }));  /* p = 0.11 */
    truth("2 of 60 at 0.2 %", !verdict([](Report &r) { r.rate_at_most("v", 2, 60, 0.002); })); /* p = 0.0066 */
    truth("no trial", !verdict([](Report &r) { r.rate_at_most("v", 0, 0, 0.01); }));
}

} // namespace

int main(int argc, char **argv)
{
    if (argc != 2) {
        std::fputs("usage: study_test FOLDER (written to)\n", stderr);
        return 2;
    }
    near("fixed", fixed(1.005, 1) == "1.0" && fixed(std::nan(""), 1) == "-", 1, 0);
    near("significant", significant(0.012345, 2) == "0.012" && significant(123.4, 2) == "123", 1, 0);
    test_conditions();
    test_scallops();
    test_calibration();
    test_verdicts();
    test_bars(argv[1]);
    return finish("study_test");
}
