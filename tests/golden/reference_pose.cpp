/* SPDX-License-Identifier: Apache-2.0 */
/* Reference of the stages behind the ellipse: eigenvectors, lens distortion and its inverse, pose. */
#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "quad.h"

namespace reference {

namespace {

/* Signs as drogue/eigen.h fixes them. */
void orient(quad vector[3][3])
{
    for (int k = 0; k < 2; k++) {
        int at = 0;
        for (int i = 1; i < 3; i++) {
            at = quad_abs(vector[k][i]) > quad_abs(vector[k][at]) ? i : at;
        }
        if (vector[k][at] < 0) {
            for (int i = 0; i < 3; i++) {
                vector[k][i] = -vector[k][i];
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        vector[2][i] = vector[0][j] * vector[1][k] - vector[0][k] * vector[1][j];
    }
}

/* Position with distortion, and the derivatives, which are symmetric. */
struct Distorted {
    Real x, y, dxx, dxy, dyy;
};

Distorted brown(const Camera &c, Real x, Real y)
{
    const Real r2 = x * x + y * y;
    const Real radial = 1 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
    const Real slope = c.k1 + r2 * (2 * c.k2 + r2 * 3 * c.k3);
    return {x * radial + 2 * c.p1 * x * y + c.p2 * (r2 + 2 * x * x),
            y * radial + c.p1 * (r2 + 2 * y * y) + 2 * c.p2 * x * y,
            radial + 2 * x * x * slope + 2 * c.p1 * y + 6 * c.p2 * x, 2 * x * y * slope + 2 * c.p1 * x + 2 * c.p2 * y,
            radial + 2 * y * y * slope + 6 * c.p1 * y + 2 * c.p2 * x};
}

/* Does the map keep its orientation there? */
bool unfolded(const Distorted &d) { return d.dxx > 0 && d.dyy > 0 && d.dxx * d.dyy > d.dxy * d.dxy; }

/* Newton's method from (x, y); false when it leaves the neighbourhood or crosses a fold. */
bool newton(const Camera &c, Real &x, Real &y, Real u, Real v)
{
    Real px = x, py = y;
    for (int i = 0; i < 60; i++) {
        const Distorted d = brown(c, px, py);
        if (!unfolded(d)) {
            return false;
        }
        const Real det = d.dxx * d.dyy - d.dxy * d.dxy;
        const Real dx = (d.dyy * (u - d.x) - d.dxy * (v - d.y)) / det;
        const Real dy = (d.dxx * (v - d.y) - d.dxy * (u - d.x)) / det;
        px += dx;
        py += dy;
        if (!(std::hypot(px - x, py - y) < 0.125L)) {
            return false;
        }
        if (std::hypot(dx, dy) <= 1e-17L * (1 + std::hypot(px, py))) {
            x = px;
            y = py;
            return true;
        }
    }
    return false;
}

constexpr Real MOST = 4; /* focal lengths off the axis */

bool enter(const Camera &c, Point p, Real &x, Real &y)
{
    if (!(c.fx > 0) || !(c.fy > 0)) {
        return false;
    }
    for (const Real k : {c.k1, c.k2, c.p1, c.p2, c.k3}) {
        if (std::fabs(k) > 256) {
            return false;
        }
    }
    x = (p.x - c.cx) / c.fx;
    y = (p.y - c.cy) / c.fy;
    return std::fabs(x) <= MOST && std::fabs(y) <= MOST;
}

bool leave(const Camera &c, Point &p, Real x, Real y)
{
    const Point q = {c.fx * x + c.cx, c.fy * y + c.cy};
    if (!in_q16(q.x) || !in_q16(q.y)) {
        return false;
    }
    p = q;
    return true;
}

/* Cone through an ellipse in camera coordinates, (22) up to scale: p p' + q q' = 1, p and q along its axes. */
void cone_of(quad m[3][3], const Ellipse &e, const Camera &c)
{
    const quad u = (static_cast<quad>(e.xc) - c.cx) / c.fx, v = (static_cast<quad>(e.yc) - c.cy) / c.fy;
    const quad cosine = cosl(e.angle), sine = sinl(e.angle);
    const quad p[2] = {cosine * c.fx / e.a, sine * c.fy / e.a}, q[2] = {-sine * c.fx / e.b, cosine * c.fy / e.b};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2; j++) {
            m[i][j] = p[i] * p[j] + q[i] * q[j];
        }
    }
    m[0][2] = m[2][0] = -(m[0][0] * u + m[0][1] * v);
    m[1][2] = m[2][1] = -(m[1][0] * u + m[1][1] * v);
    m[2][2] = -(m[0][2] * u + m[1][2] * v) - 1;
}

} // namespace

Eigen3 eigen(const std::array<int64_t, 6> &a)
{
    const quad m[3][3] = {{static_cast<quad>(a[0]), static_cast<quad>(a[1]), static_cast<quad>(a[2])},
                          {static_cast<quad>(a[1]), static_cast<quad>(a[3]), static_cast<quad>(a[4])},
                          {static_cast<quad>(a[2]), static_cast<quad>(a[4]), static_cast<quad>(a[5])}};
    quad value[3], vector[3][3];
    Eigen3 out;
    quad_eigen3(value, vector, m);
    orient(vector);
    for (size_t k = 0; k < 3; k++) {
        out.value[k] = static_cast<Real>(value[k]);
        for (size_t i = 0; i < 3; i++) {
            out.vector[k][i] = static_cast<Real>(vector[k][i]);
        }
    }
    return out;
}

bool distort(const Camera &c, Point &p)
{
    Real x, y;
    if (!enter(c, p, x, y)) {
        return false;
    }
    const Distorted d = brown(c, x, y);
    return leave(c, p, d.x, d.y);
}

bool distort(const Camera &c, Ellipse &e)
{
    Real radius[2][2];
    Point centre = {e.xc, e.yc};
    if (c.k1 == 0 && c.k2 == 0 && c.p1 == 0 && c.p2 == 0 && c.k3 == 0) {
        return true;
    }
    for (int i = 0; i < 2; i++) {
        const Real x = i == 0 ? e.a * std::cos(e.angle) : -e.b * std::sin(e.angle);
        const Real y = i == 0 ? e.a * std::sin(e.angle) : e.b * std::cos(e.angle);
        Point ahead = {e.xc + x, e.yc + y}, behind = {e.xc - x, e.yc - y};
        if (!distort(c, ahead) || !distort(c, behind)) {
            return false;
        }
        radius[i][0] = (ahead.x - behind.x) / 2;
        radius[i][1] = (ahead.y - behind.y) / 2;
    }
    const Real det = radius[0][0] * radius[1][1] - radius[0][1] * radius[1][0];
    const auto sum = [&](int i, int k) { return radius[0][i] * radius[0][k] + radius[1][i] * radius[1][k]; };
    const Ellipse seen = conic_ellipse({sum(1, 1), -2 * sum(0, 1), sum(0, 0), 0, 0, -det * det});
    if (!seen.ok || !distort(c, centre)) {
        return false;
    }
    e = {centre.x, centre.y, seen.a, seen.b, seen.angle, true};
    return true;
}

bool undistort(const Camera &c, Point &p)
{
    Real u, v, x = 0, y = 0, part = 0, step = 1 / 64.0L;
    if (!enter(c, p, u, v)) {
        return false;
    }
    while (part < 1) { /* along the line from the axis to the point as seen, in steps that Newton's method follows */
        const Real next = std::min<Real>(part + step, 1);
        if (newton(c, x, y, next * u, next * v)) {
            part = next;
        } else if ((step /= 2) < 1e-7L) {
            return false;
        }
    }
    return std::fabs(x) <= MOST && std::fabs(y) <= MOST && leave(c, p, x, y);
}

bool poses(const Ellipse &e, const Camera &c, Real radius, std::array<Pose, 2> &out)
{
    quad m[3][3], value[3], vector[3][3];
    if (!(c.fx > 0) || !(c.fy > 0) || !(radius > 0) || !(e.b > 0) || !(e.a >= e.b)) {
        return false;
    }
    cone_of(m, e, c);
    quad_eigen3(value, vector, m);
    if (!(value[1] > 0) || !(value[2] < 0)) {
        return false;
    }
    orient(vector);
    const quad sum = value[0] - value[2], tilt = quad_sqrt((value[0] - value[1]) / sum),
               upright = quad_sqrt((value[1] - value[2]) / sum);
    const quad x = radius * tilt * quad_sqrt(-value[2] / value[0]),
               z = radius * upright * quad_sqrt(value[0] / -value[2]);
    const int away = vector[2][2] < 0 ? -1 : 1;
    for (size_t i = 0; i < 2; i++) {
        const int side = i == 0 ? 1 : -1;
        for (size_t k = 0; k < 3; k++) {
            out[i].position[k] = static_cast<Real>(side * x * vector[0][k] + away * z * vector[2][k]);
            out[i].axis[k] = static_cast<Real>(-side * tilt * vector[0][k] + away * upright * vector[2][k]);
            if (!in_q16(out[i].position[k])) {
                return false;
            }
        }
        out[i].yaw = atan2l(out[i].axis[0], out[i].axis[2]);
        out[i].pitch = asinl(std::clamp(out[i].axis[1], -1.0L, 1.0L));
    }
    return true;
}

bool project(const Pose &pose, Real depth, const Camera &c, Point &out)
{
    std::array<Real, 3> p;
    for (size_t k = 0; k < 3; k++) {
        p[k] = pose.position[k] + depth * pose.axis[k];
    }
    if (!(p[2] > 0)) {
        return false;
    }
    out = {c.fx * p[0] / p[2] + c.cx, c.fy * p[1] / p[2] + c.cy};
    return true;
}

bool choose(const std::array<Pose, 2> &pair, Point p, Real depth, const Camera &c, Choice &out)
{
    for (size_t i = 0; i < 2; i++) {
        Point q;
        if (!project(pair[i], depth, c, q)) {
            return false;
        }
        out.distance[i] = std::hypot(q.x - p.x, q.y - p.y);
    }
    out.index = out.distance[1] < out.distance[0] ? 1 : 0;
    const auto [nearer, farther] = std::minmax(out.distance[0], out.distance[1]);
    out.ambiguity = farther > 0 ? nearer / farther : 1;
    return true;
}

} // namespace reference
