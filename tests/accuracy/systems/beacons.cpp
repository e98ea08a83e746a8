/* SPDX-License-Identifier: Apache-2.0 */
/* Lamps: Gauss-Newton on directions, orthogonal iteration, matching, cv::solvePnP; the ring's two circles. */
#include "beacons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <opencv2/calib3d.hpp>

#include "reference.hpp"

namespace accuracy {

namespace {

/* Drogue's frame to the camera's. */
struct Rigid {
    cv::Matx33d rotation = cv::Matx33d::eye();
    cv::Vec3d position;
};

cv::Vec3d lamp(double radius_m, double angle_deg, double depth_m)
{
    const double a = angle_deg * CV_PI / 180;
    return {radius_m * std::cos(a), radius_m * std::sin(a), depth_m};
}

double normal(Random &random)
{
    const uint64_t seed = random.next();
    return normal_at(seed, 0, 0);
}

std::vector<cv::Vec3d> directions_of(const std::vector<cv::Point2d> &px, const Camera &camera)
{
    std::vector<cv::Vec3d> directions;
    for (const cv::Point2d &p : px) {
        directions.push_back(
            cv::normalize(cv::Vec3d((p.x - camera.cx_px) / camera.fx_px, (p.y - camera.cy_px) / camera.fy_px, 1)));
    }
    return directions;
}

Estimate estimate_of(const Rigid &r)
{
    Estimate e;
    e.ok = e.has_axis = r.position[2] > 0;
    e.position_m = r.position;
    e.axis = r.rotation * cv::Vec3d(0, 0, 1);
    return e;
}

cv::Matx33d about_z(double angle)
{
    return {std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1};
}

cv::Matx33d cross_matrix(const cv::Vec3d &v) { return {0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0}; }

/* The rotation nearest to a matrix. */
cv::Matx33d nearest_rotation(const cv::Matx33d &m)
{
    cv::Vec3d w;
    cv::Matx33d u, vt;
    cv::SVD::compute(m, w, u, vt);
    const double sign = cv::determinant(u * vt) < 0 ? -1 : 1;
    return u * cv::Matx33d::diag({1, 1, sign}) * vt;
}

/* Lu, Hager and Mjolsness 2000: object-space collinearity error, least by turns over translation and rotation. */
class OrthogonalIteration {
public:
    OrthogonalIteration(const std::vector<cv::Vec3d> &points_m, const std::vector<cv::Vec3d> &directions)
        : points_(points_m)
    {
        cv::Matx33d sum = cv::Matx33d::zeros();
        for (const cv::Vec3d &d : directions) {
            sight_.push_back(d * d.t());
            sum += sight_.back();
        }
        n_ = static_cast<double>(points_.size());
        solve_ = (cv::Matx33d::eye() - sum * (1 / n_)).inv() * (1 / n_);
        for (const cv::Vec3d &p : points_) {
            mean_ += p * (1 / n_);
        }
        /* Weak perspective: the points lie where the lines of sight meet z = 1. */
        std::vector<cv::Vec3d> flat;
        for (const cv::Vec3d &d : directions) {
            flat.push_back(d * (1 / d[2]));
        }
        turn(flat);
    }

    /* Until nothing changes, or so many steps. */
    Rigid run(int steps)
    {
        std::vector<cv::Vec3d> seen(points_.size());
        for (int i = 0; i < steps; i++) {
            const cv::Vec3d before = now_.position;
            for (size_t k = 0; k < points_.size(); k++) {
                seen[k] = sight_[k] * (now_.rotation * points_[k] + now_.position);
            }
            turn(seen);
            if (cv::norm(now_.position - before) < 1e-12 * cv::norm(now_.position)) {
                break;
            }
        }
        return now_;
    }

    double error() const
    {
        double sum = 0;
        for (size_t k = 0; k < points_.size(); k++) {
            const cv::Vec3d q = now_.rotation * points_[k] + now_.position;
            sum += cv::norm(q - sight_[k] * q, cv::NORM_L2SQR) / q.dot(q);
        }
        return now_.position[2] > 0 ? sum : std::numeric_limits<double>::infinity();
    }

private:
    void turn(const std::vector<cv::Vec3d> &seen)
    {
        cv::Vec3d mean;
        for (const cv::Vec3d &q : seen) {
            mean += q * (1 / n_);
        }
        cv::Matx33d m = cv::Matx33d::zeros();
        for (size_t k = 0; k < points_.size(); k++) {
            m += (seen[k] - mean) * (points_[k] - mean_).t();
        }
        now_.rotation = nearest_rotation(m);
        cv::Vec3d sum;
        for (size_t k = 0; k < points_.size(); k++) {
            const cv::Vec3d q = now_.rotation * points_[k];
            sum += sight_[k] * q - q;
        }
        now_.position = solve_ * sum;
    }

    std::vector<cv::Vec3d> points_;
    std::vector<cv::Matx33d> sight_; /* onto each line of sight */
    cv::Matx33d solve_;
    cv::Vec3d mean_;
    double n_ = 0;
    Rigid now_;
};

constexpr int until_it_stands = 2000;

/* Which seen point each lamp falls on, when the drogue is seen in weak perspective at an attitude; empty when two lamps
 * want one point. Middle and size are those of the seen points. */
std::vector<size_t> match(const std::vector<cv::Point2d> &seen, const cv::Matx33d &rotation)
{
    const auto settle = [](std::vector<cv::Point2d> points) {
        cv::Point2d mean;
        double size = 0;
        const double n = static_cast<double>(points.size());
        for (const cv::Point2d &p : points) {
            mean += p * (1 / n);
        }
        for (cv::Point2d &p : points) {
            p -= mean;
            size += p.dot(p) / n;
        }
        for (cv::Point2d &p : points) {
            p *= 1 / std::sqrt(size);
        }
        return points;
    };
    std::vector<cv::Point2d> lamps;
    for (const cv::Vec3d &l : lamps_m()) {
        const cv::Vec3d q = rotation * l;
        lamps.emplace_back(q[0], q[1]);
    }
    lamps = settle(lamps);
    const std::vector<cv::Point2d> points = settle(seen);
    std::vector<size_t> at;
    std::set<size_t> taken;
    for (const cv::Point2d &l : lamps) {
        const auto nearest = std::min_element(points.begin(), points.end(), [&](const auto &a, const auto &b) {
            return cv::norm(a - l) < cv::norm(b - l);
        });
        at.push_back(static_cast<size_t>(nearest - points.begin()));
        taken.insert(at.back());
    }
    return taken.size() == lamps.size() ? at : std::vector<size_t>();
}

std::set<std::vector<size_t>> likely_matches(const std::vector<cv::Point2d> &seen)
{
    std::set<std::vector<size_t>> matches;
    for (int yaw = -40; yaw <= 40; yaw += 20) {
        for (int pitch = -40; pitch <= 40; pitch += 20) {
            for (int roll = 0; roll < 360; roll += 15) {
                const Pose p = {{0, 0, 1}, axis_of(yaw * CV_PI / 180, pitch * CV_PI / 180)};
                const cv::Vec3d x = p.first(), y = p.second(), z = p.axis;
                const cv::Matx33d attitude(x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]);
                const std::vector<size_t> m = match(seen, attitude * about_z(roll * CV_PI / 180));
                if (!m.empty()) {
                    matches.insert(m);
                }
            }
        }
    }
    return matches;
}

} // namespace

const std::vector<cv::Vec3d> &lamps_m()
{
    static const std::vector<cv::Vec3d> lamps = {lamp(0.35, 0, 0),      lamp(0.35, 50, 0),    lamp(0.35, 130, 0),
                                                 lamp(0.35, 200, 0),    lamp(0.35, 290, 0),   lamp(0.14, 20, 0.25),
                                                 lamp(0.14, 170, 0.25), lamp(0.14, 260, 0.25)};
    return lamps;
}

std::vector<cv::Point2d> see_lamps(const Camera &camera, const Pose &pose, double roll_rad, double noise_px,
                                   Random &random)
{
    std::vector<cv::Point2d> seen;
    for (const cv::Vec3d &l : lamps_m()) {
        const cv::Vec3d q = about_z(roll_rad) * l;
        const cv::Point2d p =
            camera.project_ideal(pose.position_m + q[0] * pose.first() + q[1] * pose.second() + q[2] * pose.axis);
        const double dx = normal(random);
        const double dy = normal(random);
        seen.emplace_back(p.x + noise_px * dx, p.y + noise_px * dy);
    }
    return seen;
}

Estimate visnav(const std::vector<cv::Point2d> &seen_px, const Camera &camera)
{
    const std::vector<cv::Vec3d> seen = directions_of(seen_px, camera);
    const std::vector<cv::Vec3d> &lamps = lamps_m();
    cv::Vec3d mean;
    for (const cv::Vec3d &d : seen) {
        mean += d;
    }
    double sine = 0, cosine = 0;
    for (size_t k = 0; k < seen.size(); k++) {
        const cv::Vec3d d = seen[k] * (1 / seen[k][2]) - mean * (1 / mean[2]);
        sine += lamps[k][0] * d[1] - lamps[k][1] * d[0];
        cosine += lamps[k][0] * d[0] + lamps[k][1] * d[1];
    }
    Rigid now = {about_z(std::atan2(sine, cosine)), mean * (10 / mean[2])};
    for (int step = 0; step < 100; step++) {
        cv::Matx<double, 6, 6> normal_matrix = cv::Matx<double, 6, 6>::zeros();
        cv::Vec<double, 6> right;
        for (size_t k = 0; k < seen.size(); k++) {
            const cv::Vec3d turned = now.rotation * lamps[k];
            const cv::Vec3d q = turned + now.position;
            const double length = cv::norm(q);
            const cv::Vec3d d = q * (1 / length);
            const cv::Matx33d by_position = (cv::Matx33d::eye() - d * d.t()) * (1 / length);
            const cv::Matx33d by_turn = by_position * cross_matrix(turned) * -1.0;
            cv::Matx<double, 3, 6> j;
            for (int r = 0; r < 3; r++) {
                for (int c = 0; c < 3; c++) {
                    j(r, c) = by_turn(r, c);
                    j(r, c + 3) = by_position(r, c);
                }
            }
            normal_matrix += j.t() * j;
            right += j.t() * (seen[k] - d);
        }
        cv::Vec<double, 6> x;
        if (!cv::solve(normal_matrix, right, x, cv::DECOMP_SVD)) {
            return {};
        }
        /* A start at 10 m may be far off: no step takes the drogue behind the sensor or turns it over. */
        const double scale = std::min({1.0, 0.5 * now.position[2] / (std::fabs(x[5]) + 1e-300),
                                       0.5 / (cv::norm(cv::Vec3d(x[0], x[1], x[2])) + 1e-300)});
        x *= scale;
        cv::Matx33d by;
        cv::Rodrigues(cv::Vec3d(x[0], x[1], x[2]), by);
        now.rotation = by * now.rotation;
        now.position += cv::Vec3d(x[3], x[4], x[5]);
        if (cv::norm(x) < 1e-12) {
            return estimate_of(now);
        }
    }
    return {}; /* it did not settle */
}

Estimate pollini(std::vector<cv::Point2d> seen_px, const Camera &camera)
{
    double least = std::numeric_limits<double>::infinity();
    Rigid best;
    for (const std::vector<size_t> &m : likely_matches(seen_px)) {
        std::vector<cv::Point2d> ordered;
        for (const size_t i : m) {
            ordered.push_back(seen_px[i]);
        }
        OrthogonalIteration rough(lamps_m(), directions_of(ordered, camera));
        rough.run(10);
        if (rough.error() < least) {
            least = rough.error();
            best = rough.run(until_it_stands);
        }
    }
    return std::isfinite(least) ? estimate_of(best) : Estimate();
}

Estimate meng(const std::vector<cv::Point2d> &seen_px, const Camera &camera)
{
    return estimate_of(OrthogonalIteration(lamps_m(), directions_of(seen_px, camera)).run(until_it_stands));
}

Estimate opencv_pnp(const std::vector<cv::Point2d> &seen_px, const Camera &camera, int method, bool planar)
{
    const auto count = static_cast<std::ptrdiff_t>(planar ? rim_lamps : lamps_m().size());
    const std::vector<cv::Point3d> points(lamps_m().begin(), lamps_m().begin() + count);
    const std::vector<cv::Point2d> seen(seen_px.begin(), seen_px.begin() + count);
    const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
    cv::Vec3d turn, position;
    Rigid r;
    if (!cv::solvePnP(points, seen, k, cv::noArray(), turn, position, false, method)) {
        return {};
    }
    cv::Rodrigues(turn, r.rotation);
    r.position = position;
    return estimate_of(r);
}

std::vector<cv::Point2d> see_circle(const Camera &camera, const Pose &pose, double radius_m, double noise_px,
                                    Random &random)
{
    const Ellipse e = project_circle(camera, pose, radius_m, 0);
    const int count = std::max(8, static_cast<int>(std::lround(CV_PI * (e.a_px + e.b_px))));
    std::vector<cv::Point2d> seen;
    for (int i = 0; i < count; i++) {
        const cv::Point2d p = e.at(2 * CV_PI * i / count);
        const double dx = normal(random);
        const double dy = normal(random);
        seen.emplace_back(p.x + noise_px * dx, p.y + noise_px * dy);
    }
    return seen;
}

Estimate wang(const std::vector<cv::Point2d> &outer_px, const std::vector<cv::Point2d> &inner_px, const Camera &camera,
              double rim_radius_m)
{
    const auto ellipse = [](const std::vector<cv::Point2d> &points) {
        const reference::Ellipse e = reference::fit(points);
        const auto d = [](reference::Real v) { return static_cast<double>(v); };
        return e.ok ? Ellipse{d(e.xc), d(e.yc), d(e.a), d(e.b), d(e.angle)} : Ellipse{0, 0, 0, 0, 0};
    };
    const Ellipse outer = ellipse(outer_px);
    const Ellipse inner = ellipse(inner_px);
    std::array<Pose, 2> outer_poses, inner_poses;
    Estimate best;
    if (!circle_poses(outer_poses, camera, outer, rim_radius_m) ||
        !circle_poses(inner_poses, camera, inner, ring_inner_radius_m)) {
        return best;
    }
    double least = std::numeric_limits<double>::infinity();
    const double wo = outer.a_px * outer.a_px;
    const double wi = inner.a_px * inner.a_px;
    for (const Pose &o : outer_poses) {
        for (const Pose &i : inner_poses) {
            /* One centre: the wrong circles' lie on other lines of sight for each radius, by far more than their axes
             * differ. */
            const double apart = cv::norm(cv::normalize(o.position_m) - cv::normalize(i.position_m));
            if (apart < least) {
                least = apart;
                best.ok = best.has_axis = true;
                best.position_m = (wo * o.position_m + wi * i.position_m) * (1 / (wo + wi));
                best.axis = cv::normalize(wo * o.axis + wi * i.axis);
            }
        }
    }
    return best;
}

} // namespace accuracy
