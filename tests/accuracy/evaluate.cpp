/* SPDX-License-Identifier: Apache-2.0 */
/* Runs trials on threads, judges and sums up. */
#include "evaluate.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <thread>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "processing.hpp"

namespace accuracy {

namespace {

/* e' C^-1 e of some of the five parameters; negative when C is not positive definite. */
double mahalanobis(const cv::Matx<double, 5, 5> &c, const cv::Vec<double, 5> &e, int from, int count)
{
    /* Metres and radians differ little here, but variances span decades: scale to unit diagonal first. */
    cv::Mat scaled(count, count, CV_64F);
    cv::Mat error(count, 1, CV_64F);
    for (int i = 0; i < count; i++) {
        if (!(c(from + i, from + i) > 0)) {
            return -1;
        }
        error.at<double>(i) = e[from + i] / std::sqrt(c(from + i, from + i));
        for (int j = 0; j < count; j++) {
            scaled.at<double>(i, j) = c(from + i, from + j) / std::sqrt(c(from + i, from + i) * c(from + j, from + j));
        }
    }
    cv::Mat solved;
    if (!cv::solve(scaled, error, solved, cv::DECOMP_CHOLESKY)) {
        return -1;
    }
    return error.dot(solved);
}

void add_nees(Outcome &o, const drogue_result &raw)
{
    const cv::Vec<double, 5> e(o.position_m[0], o.position_m[1], o.position_m[2], o.angles_rad[0], o.angles_rad[1]);
    cv::Matx<double, 5, 5> c;
    for (int i = 0; i < 5; i++) {
        for (int j = 0; j < 5; j++) {
            c(i, j) = std::ldexp(static_cast<double>(raw.covariance_q48[i][j]), raw.covariance_halved - 48);
        }
    }
    o.nees = mahalanobis(c, e, 0, 5);
    o.nees_position = mahalanobis(c, e, 0, 3);
    o.nees_angles = mahalanobis(c, e, 3, 2);
    o.has_covariance = raw.covariance_q48[0][0] > 0 && o.nees >= 0;
}

/* A region with other sides about the same middle, within the image. */
cv::Rect resized(const cv::Rect &r, double side, const cv::Size &image)
{
    const int width = cvRound(side * r.width);
    const int height = cvRound(side * r.height);
    return cv::Rect(r.x + (r.width - width) / 2, r.y + (r.height - height) / 2, width, height) &
           cv::Rect({0, 0}, image);
}

} // namespace

cv::Vec3d Outcome::percent() const
{
    const double k = 100 / distance_m;
    return {std::fabs(position_m[0]) * k, std::fabs(position_m[1]) * k, std::fabs(position_m[2]) * k};
}

double Outcome::percent_mean() const
{
    const cv::Vec3d p = percent();
    return (p[0] + p[1] + p[2]) / 3;
}

Outcome judge(const Trial &t, const Measurement &m)
{
    Outcome o;
    o.status = m.raw.status;
    o.distance_m = t.distance_m();
    if (!m.ok) {
        return o;
    }
    o.inner = m.raw.has_inner != 0;
    o.resolved = m.raw.orientation_resolved != 0;
    o.ellipse_px = ellipse_error_px(m.ideal, t.rim);
    o.ellipse_share = o.ellipse_px / t.rim.a_px;
    o.verdict = o.ellipse_px <= std::max(1.0, 0.03 * t.rim.a_px) ? Verdict::right : Verdict::wrong;
    const Drogue &d = t.scene.drogue;
    const Ellipse disc = project_circle(t.scene.camera, t.scene.pose, d.inner_radius_m, d.inner_depth_m);
    o.centroid_px =
        o.inner ? std::hypot(m.inner_px.x - disc.xc_px, m.inner_px.y - disc.yc_px) : std::nan(""); /* no lens here */
    o.position_m = m.pose.position_m - t.pose.position_m;
    o.angles_rad = {yaw_of(m.pose.axis) - yaw_of(t.pose.axis), pitch_of(m.pose.axis) - pitch_of(t.pose.axis)};
    o.axis_deg = angle_between_deg(m.pose.axis, t.pose.axis);
    o.twin = o.resolved && angle_between_deg(m.alternative.axis, t.pose.axis) < o.axis_deg - 2;
    add_nees(o, m.raw);
    return o;
}

cv::Mat picture_of(const Trial &t, const std::string &cache)
{
    namespace fs = std::filesystem;
    if (cache.empty()) {
        return render(t.scene, t.region);
    }
    char name[64];
    std::snprintf(name, sizeof name, "%s_%d_%016llx.png", name_of(t.condition), t.index,
                  static_cast<unsigned long long>(fingerprint(t)));
    const fs::path path = fs::path(cache) / name;
    cv::Mat picture;
    if (fs::exists(path)) {
        picture = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
    }
    if (picture.size() != t.region.size()) {
        picture = render(t.scene, t.region);
        const fs::path part = fs::path(cache) / (std::string("part_") + name); /* whole or not at all */
        if (!cv::imwrite(part.string(), picture)) {
            throw std::runtime_error("cannot write " + part.string());
        }
        fs::rename(part, path);
    }
    return picture;
}

std::vector<Outcome> run_trials(const std::vector<Trial> &trials, const RunOptions &options)
{
    std::vector<Outcome> outcomes(trials.size());
    std::atomic<size_t> next{0};
    size_t done = 0;
    std::exception_ptr failure;
    std::mutex report;
    const auto work = [&] {
        for (size_t i = next++; i < trials.size(); i = next++) {
            try {
                const Trial &t = trials[i];
                const cv::Rect asked = resized(t.region, options.side, t.scene.image_px);
                Trial seen = t;
                if (options.side != 1) {
                    seen.region = resized(t.region, 1.35 * std::max(1.0, options.side), t.scene.image_px);
                }
                const cv::Mat picture = picture_of(seen, options.cache);
                const cv::Mat region = options.processing.empty() ? picture : processed(picture, options.processing);
                cv::Mat image = cv::Mat::zeros(t.scene.image_px, CV_8U);
                region.copyTo(image(seen.region)); /* the library looks nowhere else */
                const Measurement m = measure(image, t.scene.camera, t.model, asked, transfer_of(options.processing));
                outcomes[i] = judge(t, m);
                const std::lock_guard<std::mutex> lock(report);
                done++;
                if (options.inspect) {
                    options.inspect(seen, region, m, outcomes[i]);
                }
                if (options.progress) {
                    options.progress(done, trials.size());
                }
            } catch (...) {
                const std::lock_guard<std::mutex> lock(report);
                failure = std::current_exception();
                next = trials.size();
            }
        }
    };
    if (!options.cache.empty()) {
        std::filesystem::create_directories(options.cache);
    }
    cv::setNumThreads(1);
    const unsigned threads = options.threads > 0 ? static_cast<unsigned>(options.threads)
                                                 : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::thread> pool;
    for (unsigned i = 0; i < threads; i++) {
        pool.emplace_back(work);
    }
    for (std::thread &t : pool) {
        t.join();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
    return outcomes;
}

Summary summarise(const std::vector<Outcome> &outcomes)
{
    Summary s;
    std::vector<double> part[3], position, axis, nees, nees_position, nees_angles;
    for (const Outcome &o : outcomes) {
        s.scenes++;
        if (o.verdict == Verdict::unmeasured) {
            s.unmeasured++;
            s.statuses[drogue_status_name(o.status)]++;
            continue;
        }
        s.no_inner += !o.inner;
        s.unresolved += !o.resolved;
        s.twin += o.twin;
        if (o.verdict == Verdict::wrong) {
            s.wrong++;
            continue;
        }
        s.right++;
        for (int i = 0; i < 3; i++) {
            part[i].push_back(o.percent()[i]);
        }
        position.push_back(o.percent_mean());
        axis.push_back(o.axis_deg);
        if (o.resolved && o.has_covariance) {
            s.with_covariance++;
            nees.push_back(o.nees);
            nees_position.push_back(o.nees_position);
            nees_angles.push_back(o.nees_angles);
        }
    }
    for (int i = 0; i < 3; i++) {
        s.median_percent[i] = median(part[i]);
        s.mean_percent[i] = mean(part[i]);
    }
    s.median_position = median(position);
    s.mean_position = mean(position);
    s.median_axis = median(axis);
    s.mean_axis = mean(axis);
    s.p90_axis = percentile(axis, 90);
    s.mean_nees = mean(nees);
    s.median_nees = median(nees);
    s.mean_nees_position = mean(nees_position);
    s.mean_nees_angles = mean(nees_angles);
    return s;
}

cv::Mat overlay(const Trial &t, const cv::Mat &region, const Measurement &m)
{
    const double zoom = std::max(1.0, std::round(600.0 / region.cols));
    cv::Mat canvas;
    const auto draw = [&](const Ellipse &e, const cv::Scalar &colour) {
        for (int i = 0; i < 720; i++) {
            const cv::Point2d p = (e.at(i * CV_PI / 360) - cv::Point2d(t.region.tl())) * zoom;
            cv::circle(canvas, cv::Point2i(p + cv::Point2d(zoom / 2, zoom / 2)), 1, colour, -1);
        }
    };
    cv::resize(region, canvas, {}, zoom, zoom, cv::INTER_NEAREST);
    cv::cvtColor(canvas, canvas, cv::COLOR_GRAY2BGR);
    draw(t.rim, {0, 220, 0});
    if (m.ok) {
        draw(m.ideal, {0, 0, 255});
    }
    if (m.raw.has_inner != 0) {
        draw({m.inner_px.x, m.inner_px.y, 1, 1, 0}, {0, 0, 255});
    }
    return canvas;
}

} // namespace accuracy
