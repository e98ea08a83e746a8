/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the joint pose: Gauss-Newton with derivatives by dual numbers and cv::solve. The circle's image comes from
 * the plane's homography, not from the cone's closed form. */
#include "reference.hpp"

#include <algorithm>
#include <cmath>

namespace reference {

namespace {

constexpr Real PI = 3.14159265358979323846264338327950288L;
constexpr int PARAMETERS = 5; /* x y z yaw pitch */

/* A number and its derivatives by the five parameters. */
struct Dual {
    Real v = 0;
    std::array<Real, PARAMETERS> d = {};

    Dual() = default;
    Dual(Real value) : v(value) {}
};

Dual combine(Real v, Real p, const Dual &a, Real q, const Dual &b)
{
    Dual r(v);
    for (size_t k = 0; k < PARAMETERS; k++) {
        r.d[k] = p * a.d[k] + q * b.d[k];
    }
    return r;
}
Dual operator+(const Dual &a, const Dual &b) { return combine(a.v + b.v, 1, a, 1, b); }
Dual operator-(const Dual &a, const Dual &b) { return combine(a.v - b.v, 1, a, -1, b); }
Dual operator*(const Dual &a, const Dual &b) { return combine(a.v * b.v, b.v, a, a.v, b); }
Dual operator/(const Dual &a, const Dual &b) { return combine(a.v / b.v, 1 / b.v, a, -a.v / (b.v * b.v), b); }
Dual sine(const Dual &a) { return combine(std::sin(a.v), std::cos(a.v), a, 0, a); }
Dual cosine(const Dual &a) { return combine(std::cos(a.v), -std::sin(a.v), a, 0, a); }

using Vector = std::array<Dual, 3>;
Dual dot(const Vector &a, const Vector &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector &a, const Vector &b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/* A circle's plane: two directions in it, its normal. */
struct Frame {
    Vector position, first, second, axis;
};

Frame frame_of(const std::array<Real, PARAMETERS> &at)
{
    std::array<Dual, PARAMETERS> p;
    for (size_t k = 0; k < PARAMETERS; k++) {
        p[k].v = at[k];
        p[k].d[k] = 1;
    }
    const Dual sy = sine(p[3]), cy = cosine(p[3]), sp = sine(p[4]), cp = cosine(p[4]);
    Frame f;
    f.position = {p[0], p[1], p[2]};
    f.axis = {sy * cp, sp, cy * cp};
    f.first = {cy, Dual(0), Dual(0) - sy};
    f.second = cross(f.axis, f.first);
    return f;
}

/* Conic of a circle's image in the coordinates (u, v, 1) of three rays: q00 q01 q11 q02 q12 q22. */
std::array<Dual, 6> conic_of(const Frame &f, const Vector &centre, Real radius, const std::array<Vector, 3> &rays)
{
    /* rows of the adjoint of the homography [first second centre]: a ray's place in the plane up to scale */
    const Vector row[3] = {cross(f.second, centre), cross(centre, f.first), cross(f.first, f.second)};
    Dual g[3][3];
    for (size_t i = 0; i < 3; i++) {
        for (size_t k = 0; k < 3; k++) {
            g[i][k] = dot(row[i], rays[k]);
        }
    }
    std::array<Dual, 6> q;
    const size_t pair[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 2}, {1, 2}, {2, 2}};
    for (size_t n = 0; n < 6; n++) {
        const size_t i = pair[n][0], k = pair[n][1];
        q[n] = g[0][i] * g[0][k] + g[1][i] * g[1][k] - Dual(radius * radius) * g[2][i] * g[2][k];
    }
    return q;
}

/* Rays of a measured ellipse's frame: (u, v) on its unit circle. */
std::array<Vector, 3> rays_of(const Ellipse &e, const Camera &c)
{
    const Real cosine = std::cos(e.angle), sine = std::sin(e.angle);
    return {Vector{e.a * cosine / c.fx, e.a * sine / c.fy, Dual(0)},
            Vector{-e.b * sine / c.fx, e.b * cosine / c.fy, Dual(0)},
            Vector{(e.xc - c.cx) / c.fx, (e.yc - c.cy) / c.fy, Dual(1)}};
}

/* The ranges that the library's solver is for (joint_model.h): poses, rays, conics and rows outside have nothing to do
 * with a drogue that was seen. Lengths in radii of the rim. */
constexpr Real FARTHEST = 65536, WIDEST = 2, STEEPEST = 1024, MOST_OFF = 2, LEAST_CONIC = 1 / 65536.0L,
               LARGEST_CONIC = 128;

bool in_range(const std::array<Real, PARAMETERS> &at, Real radius)
{
    return std::max({std::fabs(at[0]), std::fabs(at[1]), std::fabs(at[2])}) <= FARTHEST * radius;
}

bool in_range(const std::array<Vector, 3> &rays)
{
    Real widest = 0;
    for (const Vector &ray : rays) {
        for (const Dual &d : ray) {
            widest = std::max(widest, std::fabs(d.v));
        }
    }
    return widest <= WIDEST;
}

bool in_range(Real value, const std::array<Real, PARAMETERS> &by, Real radius)
{
    Real most = std::fabs(value);
    for (size_t k = 0; k < PARAMETERS; k++) {
        most = std::max(most, std::fabs(by[k]) * (k < 3 ? radius : 1));
    }
    return most <= STEEPEST;
}

/* Harmonics of how far the circle's image lies off the ellipse, in units of its semi-axes; false out of range. */
bool outline_residual(std::array<Dual, 5> &out, const Frame &f, Real radius, const std::array<Vector, 3> &rays)
{
    const std::array<Dual, 6> q = conic_of(f, f.position, radius, rays);
    const Dual radial = Dual(0) - q[0] - q[2];
    const Real size = -2 * radial.v / (radius * radius);
    if (!(size >= LEAST_CONIC && size <= LARGEST_CONIC)) {
        return false;
    }
    out = {((q[0] + q[2]) / Dual(2) + q[5]) / radial, Dual(2) * q[3] / radial, Dual(2) * q[4] / radial,
           (q[0] - q[2]) / Dual(2) / radial, q[1] / radial};
    return std::all_of(out.begin(), out.end(),
                       [&](const Dual &d) { return std::fabs(d.v) < MOST_OFF && in_range(d.v, d.d, radius); });
}

/* Centre of the inner disc's image in ray coordinates, and the disc's middle in space. */
Solved disc_centre(std::array<Dual, 2> &centre, Vector &middle, const Frame &f, const Model &model)
{
    const std::array<Vector, 3> straight = {Vector{Dual(1), Dual(0), Dual(0)}, Vector{Dual(0), Dual(1), Dual(0)},
                                            Vector{Dual(0), Dual(0), Dual(1)}};
    for (size_t i = 0; i < 3; i++) {
        middle[i] = f.position[i] + Dual(model.inner_depth) * f.axis[i];
    }
    if (!(middle[2].v > 0)) {
        return Solved::behind;
    }
    const std::array<Dual, 6> q = conic_of(f, middle, model.inner_radius, straight);
    const Dual det = q[0] * q[2] - q[1] * q[1];
    if (!(det.v > 0) || std::max(std::fabs(middle[0].v), std::fabs(middle[1].v)) > WIDEST * middle[2].v) {
        return Solved::domain;
    }
    centre = {(q[1] * q[4] - q[2] * q[3]) / det, (q[1] * q[3] - q[0] * q[4]) / det};
    return Solved::ok;
}

/* Rows of residuals and slopes, over their standard deviations. */
struct Rows {
    std::vector<double> residual;
    std::vector<std::array<double, PARAMETERS>> slope;

    void add(Real value, const std::array<Real, PARAMETERS> &by)
    {
        std::array<double, PARAMETERS> d;
        std::transform(by.begin(), by.end(), d.begin(), [](Real v) { return static_cast<double>(v); });
        residual.push_back(static_cast<double>(value));
        slope.push_back(d);
    }
};

bool cholesky(Covariance &root, const Covariance &a)
{
    root = Covariance::zeros();
    for (int j = 0; j < PARAMETERS; j++) {
        for (int i = j; i < PARAMETERS; i++) {
            double sum = a(i, j);
            for (int k = 0; k < j; k++) {
                sum -= root(i, k) * root(j, k);
            }
            if (i == j && !(sum > a(j, j) * 0x1p-40)) {
                return false;
            }
            root(i, j) = i == j ? std::sqrt(sum) : sum / root(j, j);
        }
    }
    return true;
}

void add_outline(Rows &rows, const std::array<Dual, 5> &residual, const Covariance &root)
{
    std::array<Dual, 5> white;
    for (int i = 0; i < 5; i++) {
        Dual sum = residual[static_cast<size_t>(i)];
        for (int k = 0; k < i; k++) {
            sum = sum - Dual(root(i, k)) * white[static_cast<size_t>(k)];
        }
        white[static_cast<size_t>(i)] = sum / Dual(root(i, i));
        rows.add(white[static_cast<size_t>(i)].v, white[static_cast<size_t>(i)].d);
    }
}

Solved add_inner(Rows &rows, const Frame &f, const Inner &inner, const Camera &c, const Model &model)
{
    std::array<Dual, 2> centre;
    Vector middle;
    const Solved solved = disc_centre(centre, middle, f, model);
    if (solved != Solved::ok) {
        return solved;
    }
    const Real focal[2] = {c.fx, c.fy}, measured[2] = {inner.at.x - c.cx, inner.at.y - c.cy};
    for (size_t i = 0; i < 2; i++) {
        std::array<Real, PARAMETERS> by; /* the disc's middle stands for the centre of its image */
        for (size_t k = 0; k < PARAMETERS; k++) {
            by[k] = (middle[i].d[k] - centre[i].v * middle[2].d[k]) / middle[2].v;
        }
        const Real off = centre[i].v - measured[i] / focal[i];
        if (!in_range(off, by, model.rim_radius)) {
            return Solved::domain;
        }
        for (Real &slope : by) {
            slope *= focal[i] / inner.std;
        }
        rows.add(off * focal[i] / inner.std, by);
    }
    return Solved::ok;
}

/* Normal matrix and right side; a weak prior on the angles. */
void normal_equations(Covariance &normal, cv::Vec<double, 5> &right, const Rows &rows)
{
    normal = Covariance::diag({0, 0, 0, 1, 1});
    right = cv::Vec<double, 5>::all(0);
    for (size_t r = 0; r < rows.residual.size(); r++) {
        for (int i = 0; i < PARAMETERS; i++) {
            right[i] -= rows.slope[r][static_cast<size_t>(i)] * rows.residual[r];
            for (int j = 0; j < PARAMETERS; j++) {
                normal(i, j) += rows.slope[r][static_cast<size_t>(i)] * rows.slope[r][static_cast<size_t>(j)];
            }
        }
    }
}

/* Points times products of 1, cos t, sin t, cos 2t, sin 2t in the middles of the bins. */
Covariance information_of(const Support &s)
{
    Covariance information = Covariance::zeros();
    for (int k = 0; k < SUPPORT_BINS; k++) {
        const int n = s.count[static_cast<size_t>(k)][s.bright >> k & 1];
        const auto t = static_cast<double>((k + 0.5L) * 2 * PI / SUPPORT_BINS);
        const cv::Vec<double, 5> basis(1, std::cos(t), std::sin(t), std::cos(2 * t), std::sin(2 * t));
        information += static_cast<double>(n) * Covariance(basis * basis.t());
    }
    return information;
}

Pose pose_at(const std::array<Real, PARAMETERS> &at)
{
    const Frame f = frame_of(at);
    return {{at[0], at[1], at[2]}, {f.axis[0].v, f.axis[1].v, f.axis[2].v}, at[3], at[4]};
}

} // namespace

bool outline_covariance(Covariance &out, const Ellipse &e, const Support &s, Real shading, Real blur)
{
    int bins = 0;
    Real scatter = 0;
    Covariance root;
    for (int k = 0; k < SUPPORT_BINS; k++) {
        const int n = s.count[static_cast<size_t>(k)][s.bright >> k & 1];
        const Real sum = s.sum[static_cast<size_t>(k)];
        bins += n > 0;
        scatter += n > 0 ? sum * sum / n : 0;
    }
    const Covariance information = information_of(s);
    if (bins <= PARAMETERS || !(s.gradient > 0) || !cholesky(root, information)) {
        return false;
    }
    const Real shade = shading * s.points / (e.a * s.gradient), blurred = blur / (e.a * e.b);
    out = static_cast<double>(scatter / (bins - PARAMETERS)) * information.inv(cv::DECOMP_CHOLESKY) +
          static_cast<double>(shade * shade) * Covariance::eye();
    out(0, 0) += static_cast<double>(blurred * blurred);
    for (int i = 0; i < PARAMETERS; i++) {
        const Real left = s.pull[static_cast<size_t>(i)] / 2;
        out(i, i) += static_cast<double>(left * left + 0.09L / (e.a * e.a * e.b * e.b)); /* and 0.3 px^2 by the grid */
    }
    {
        const auto c2 = static_cast<double>(std::cos(2 * e.angle)), s2 = static_cast<double>(std::sin(2 * e.angle));
        const auto p = static_cast<double>(s.smear[0]), q = static_cast<double>(s.smear[1]), v = std::hypot(p, q);
        const double c = p * c2 + q * s2, d = q * c2 - p * s2; /* from the major axis */
        const auto share = static_cast<double>(0.01171875L / (e.a * e.b));
        const cv::Vec<double, 5> alike(v / 2, 0, 0, c / 2, d / 2);
        out += share * Covariance(alike * alike.t());
        out(1, 1) += share * v * (v + c) / 2;
        out(2, 2) += share * v * (v - c) / 2;
        out(1, 2) += share * v * d / 2;
        out(2, 1) += share * v * d / 2;
    }
    return true;
}

double condition_of(const Support &s)
{
    const Covariance information = information_of(s);
    return cv::trace(information) * cv::trace(information.inv(cv::DECOMP_CHOLESKY));
}

Joint solve_joint(const Pose &start, const Ellipse &e, const Covariance &outline, const Inner &inner, const Camera &c,
                  const Model &model, int steps)
{
    const std::array<Vector, 3> rays = rays_of(e, c);
    std::array<Real, PARAMETERS> at = {start.position[0], start.position[1], start.position[2], start.yaw, start.pitch};
    Covariance root, normal;
    Joint out = {};
    if (!cholesky(root, outline)) {
        out.solved = Solved::degenerate;
        return out;
    }
    out.solved = !(at[2] > 0) ? Solved::behind : in_range(rays) ? Solved::ok : Solved::domain;
    bool last = out.solved != Solved::ok;
    for (int step = 0; !last; step++) {
        const Frame f = frame_of(at);
        Rows rows;
        cv::Vec<double, 5> right, move;
        std::array<Dual, 5> residual;
        if (!in_range(at, model.rim_radius) || !outline_residual(residual, f, model.rim_radius, rays)) {
            out.solved = Solved::domain;
            return out;
        }
        add_outline(rows, residual, root);
        out.solved = inner.std > 0 ? add_inner(rows, f, inner, c, model) : Solved::ok;
        if (out.solved != Solved::ok) {
            return out;
        }
        normal_equations(normal, right, rows);
        Covariance unused;
        if (!cholesky(unused, normal)) {
            out.solved = Solved::degenerate;
            return out;
        }
        out.chi2 = 0;
        for (const double r : rows.residual) {
            out.chi2 += r * r;
        }
        last = step == steps;
        if (steps > 0) {
            cv::solve(normal, right, move, cv::DECOMP_CHOLESKY);
            bool small = true;
            for (int k = 0; k < PARAMETERS; k++) {
                small = small && std::fabs(move[k]) <= (k < 3 ? static_cast<double>(at[2]) : 1) * 0x1p-20;
            }
            last = last || small;
            const Real half = std::fabs(at[2]) / 2; /* no step passes the camera */
            for (size_t k = 0; k < PARAMETERS; k++) {
                const Real by = move[static_cast<int>(k)];
                at[k] = k < 3 ? at[k] + std::clamp(by, -half, half)
                              : std::clamp(at[k] + std::clamp<Real>(by, -0.5L, 0.5L), -PI / 2, PI / 2);
            }
        }
    }
    if (out.solved != Solved::ok) {
        return out;
    }
    out.covariance = normal.inv(cv::DECOMP_CHOLESKY);
    out.pose = pose_at(at);
    for (size_t k = 0; k < 3; k++) {
        if (q16(at[k]) == INT32_MAX || q16(at[k]) == INT32_MIN) {
            out.solved = Solved::domain;
        }
    }
    if (out.solved == Solved::ok && !(at[2] > 0)) {
        out.solved = Solved::behind;
    }
    return out;
}

Solved disc_image(Ellipse &out, const Pose &pose, const Camera &c, const Model &model)
{
    const Frame f = frame_of({pose.position[0], pose.position[1], pose.position[2], pose.yaw, pose.pitch});
    const std::array<Vector, 3> pixels = {Vector{1 / c.fx, Dual(0), Dual(0)}, Vector{Dual(0), 1 / c.fy, Dual(0)},
                                          Vector{Dual(0), Dual(0), Dual(1)}};
    std::array<Dual, 2> centre;
    Vector middle;
    const Solved solved = disc_centre(centre, middle, f, model);
    out = {0, 0, 0, 0, 0, false};
    if (solved != Solved::ok) {
        return solved;
    }
    const std::array<Dual, 6> q = conic_of(f, middle, model.inner_radius, pixels);
    const Ellipse e = conic_ellipse({q[0].v, 2 * q[1].v, q[2].v, 2 * q[3].v, 2 * q[4].v, q[5].v});
    if (!(dot(f.axis, middle).v > 0) || !e.ok) {
        return Solved::domain;
    }
    out = {e.xc + c.cx, e.yc + c.cy, e.a, e.b, e.angle, true};
    return Solved::ok;
}

} // namespace reference
