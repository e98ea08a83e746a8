/* SPDX-License-Identifier: Apache-2.0 */
/* Joint pose of outline and inner part by Gauss-Newton. */
#include "drogue/joint.h"

#include <string.h>

#define SETTLED_BITS 20 /* a step that turns by less than 2^-20 rad and moves by less of the distance is the last */
#define FIT_PARAMETERS 5

typedef drogue_wide wide;

static wide add(wide a, wide b) { return drogue_wide_add(a, b); }
static wide sub(wide a, wide b) { return drogue_wide_sub(a, b); }
static wide mul(wide a, wide b) { return drogue_wide_mul(a, b); }
static wide integer(int64_t v) { return drogue_wide_from_s64(v, 0); }

static wide dot(const wide a[3], const wide b[3])
{
    return add(add(mul(a[0], b[0]), mul(a[1], b[1])), mul(a[2], b[2]));
}

/* ---- the outline's covariance */

/* cos and sin of the middle of bin k, Q30. */
static void bin_direction(int32_t *c_q30, int32_t *s_q30, uint32_t k)
{
    /* cos of 5.625 + 11.25 i degrees */
    static const int32_t quarter_q30[8] = {1068571464, 1027506862, 946955747, 830013654,
                                           681174602,  506158392,  311690799, 105245103};
    const uint32_t i = k & 7u;
    const uint32_t quadrant = k >> 3;
    const int32_t near_q30 = quarter_q30[i];
    const int32_t far_q30 = quarter_q30[7 - i];
    *c_q30 = quadrant == 0 ? near_q30 : quadrant == 1 ? -far_q30 : quadrant == 2 ? -near_q30 : far_q30;
    *s_q30 = quadrant == 0 ? far_q30 : quadrant == 1 ? near_q30 : quadrant == 2 ? -far_q30 : -near_q30;
}

drogue_status drogue_joint_outline_covariance(drogue_joint_outline *outline, const drogue_support *support,
                                              drogue_q16 shading_q16, drogue_q16 blur_px2_q16)
{
    const wide a = drogue_wide_from_q16(outline->ellipse.a_px_q16);
    const wide b = drogue_wide_from_q16(outline->ellipse.b_px_q16);
    int64_t sum_q30[DROGUE_PACKED_MAX]; /* information: points times products of the basis functions */
    wide information[DROGUE_PACKED_MAX];
    wide scatter = {0, 0};
    wide shading_share;
    wide blur_share;
    uint32_t bins = 0;
    uint32_t k;
    int i;
    int j;
    memset(sum_q30, 0, sizeof sum_q30);
    for (k = 0; k < DROGUE_SUPPORT_BINS; k++) {
        const int64_t n = support->bin[k].count[(support->bright_bins >> k) & 1u];
        const int64_t sum_q16 = support->bin[k].sum_q16;
        int64_t basis_q30[FIT_PARAMETERS];
        int32_t c;
        int32_t s;
        if (n == 0) {
            continue;
        }
        bins++;
        DROGUE_NOTE("joint: squared sum of a bin's offsets, Q32", sum_q16 * sum_q16, 61); /* support.c: 2^30 */
        scatter = add(scatter, drogue_wide_div(drogue_wide_from_s64(sum_q16 * sum_q16, -32), integer(n)));
        bin_direction(&c, &s, k);
        basis_q30[0] = INT64_C(1) << 30;
        basis_q30[1] = c;
        basis_q30[2] = s;
        basis_q30[3] = drogue_shr_round_s64((int64_t)c * c - (int64_t)s * s, 30);
        basis_q30[4] = drogue_shr_round_s64((int64_t)c * s, 29);
        for (i = 0; i < FIT_PARAMETERS; i++) {
            for (j = 0; j <= i; j++) {
                sum_q30[DROGUE_PACKED(i, j)] += n * drogue_shr_round_s64(basis_q30[i] * basis_q30[j], 30);
                /* 2^22 points at most, basis functions at most 1 */
                DROGUE_NOTE("joint: information, Q30", sum_q30[DROGUE_PACKED(i, j)], 53);
            }
        }
    }
    if (bins <= FIT_PARAMETERS || support->gradient == 0) {
        return DROGUE_E_DEGENERATE;
    }
    scatter = drogue_wide_div(scatter, integer((int64_t)bins - FIT_PARAMETERS));
    for (i = 0; i < DROGUE_PACKED_MAX; i++) {
        information[i] = drogue_wide_from_s64(sum_q30[i], -30);
    }
    if (drogue_cholesky_factor(information, FIT_PARAMETERS) != DROGUE_OK) {
        return DROGUE_E_DEGENERATE;
    }
    drogue_cholesky_invert(outline->covariance, information, FIT_PARAMETERS);
    shading_share = drogue_wide_div(mul(drogue_wide_from_q16(shading_q16), integer(support->points)),
                                    mul(a, integer((int64_t)support->gradient)));
    blur_share = drogue_wide_div(drogue_wide_from_q16(blur_px2_q16), mul(a, b));
    for (i = 0; i < FIT_PARAMETERS; i++) {
        for (j = 0; j <= i; j++) {
            outline->covariance[DROGUE_PACKED(i, j)] = mul(outline->covariance[DROGUE_PACKED(i, j)], scatter);
        }
        outline->covariance[DROGUE_PACKED(i, i)] =
            add(outline->covariance[DROGUE_PACKED(i, i)], mul(shading_share, shading_share));
    }
    outline->covariance[0] = add(outline->covariance[0], mul(blur_share, blur_share));
    return DROGUE_OK;
}

/* ---- the model */

/* Pose as the solver moves it. */
typedef struct state {
    wide position[3];
    wide angle[2]; /* yaw, pitch */
    wide axis[3];
    wide turn[2][3]; /* derivatives of the axis by yaw and pitch */
} state;

static void turn_axis(state *s)
{
    int32_t sin_yaw;
    int32_t cos_yaw;
    int32_t sin_pitch;
    int32_t cos_pitch;
    wide sy;
    wide cy;
    wide sp;
    wide cp;
    drogue_sincos_q30(&sin_yaw, &cos_yaw, (int32_t)drogue_wide_to_s64(s->angle[0], 29));
    drogue_sincos_q30(&sin_pitch, &cos_pitch, (int32_t)drogue_wide_to_s64(s->angle[1], 29));
    sy = drogue_wide_from_s64(sin_yaw, -30);
    cy = drogue_wide_from_s64(cos_yaw, -30);
    sp = drogue_wide_from_s64(sin_pitch, -30);
    cp = drogue_wide_from_s64(cos_pitch, -30);
    s->axis[0] = mul(sy, cp);
    s->axis[1] = sp;
    s->axis[2] = mul(cy, cp);
    s->turn[0][0] = s->axis[2];
    s->turn[0][1] = integer(0);
    s->turn[0][2] = drogue_wide_neg(s->axis[0]);
    s->turn[1][0] = drogue_wide_neg(mul(sy, sp));
    s->turn[1][1] = cp;
    s->turn[1][2] = drogue_wide_neg(mul(cy, sp));
}

/* Residuals over their standard deviations, and their derivatives by the five parameters: five rows of the outline,
 * two of the inner part. */
#define ROWS 7

typedef struct equations {
    wide residual[ROWS];
    wide slope[ROWS][FIT_PARAMETERS];
    int rows;
} equations;

/* The fitted ellipse's frame as rays: ray(u, v) = first u + second v + third. */
typedef struct ray_frame {
    wide column[3][3];
    wide gram[DROGUE_PACKED(2, 2) + 1]; /* products of the columns, packed */
    wide radius2;
} ray_frame;

static void ray_frame_of(ray_frame *out, const drogue_ellipse *e, const drogue_camera *camera, drogue_q16 radius_m_q16)
{
    const wide fx = drogue_wide_from_q16(camera->fx_px_q16);
    const wide fy = drogue_wide_from_q16(camera->fy_px_q16);
    const wide a = drogue_wide_from_q16(e->a_px_q16);
    const wide b = drogue_wide_from_q16(e->b_px_q16);
    const wide radius = drogue_wide_from_q16(radius_m_q16);
    int32_t s_q30;
    int32_t c_q30;
    wide s;
    wide c;
    int i;
    int j;
    drogue_sincos_q30(&s_q30, &c_q30, (int32_t)drogue_shl_s64(e->angle_rad_q16, 13));
    s = drogue_wide_from_s64(s_q30, -30);
    c = drogue_wide_from_s64(c_q30, -30);
    out->column[0][0] = drogue_wide_div(mul(a, c), fx);
    out->column[0][1] = drogue_wide_div(mul(a, s), fy);
    out->column[0][2] = integer(0);
    out->column[1][0] = drogue_wide_neg(drogue_wide_div(mul(b, s), fx));
    out->column[1][1] = drogue_wide_div(mul(b, c), fy);
    out->column[1][2] = integer(0);
    out->column[2][0] = drogue_wide_div(drogue_wide_from_s64((int64_t)e->xc_px_q16 - camera->cx_px_q16, -16), fx);
    out->column[2][1] = drogue_wide_div(drogue_wide_from_s64((int64_t)e->yc_px_q16 - camera->cy_px_q16, -16), fy);
    out->column[2][2] = integer(1);
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            out->gram[DROGUE_PACKED(i, j)] = dot(out->column[i], out->column[j]);
        }
    }
    out->radius2 = mul(radius, radius);
}

/* Coefficients of 1, cos t, sin t, cos 2t, sin 2t of the conic q on the unit circle. */
static void harmonics(wide out[FIT_PARAMETERS], const wide q[6])
{
    out[0] = add(drogue_wide_scale(add(q[0], q[2]), -1), q[5]);
    out[1] = drogue_wide_scale(q[3], 1);
    out[2] = drogue_wide_scale(q[4], 1);
    out[3] = drogue_wide_scale(sub(q[0], q[2]), -1);
    out[4] = q[1];
}

/* Where the circle's image lies off the fitted ellipse, and how that changes with the pose. With n the axis, c the
 * centre, d = n.c, k = c.c - R^2, the cone is d^2 I - d (n c' + c n') + k n n'; here in the ellipse's frame. */
static void outline_rows(equations *out, const state *s, const ray_frame *frame)
{
    const wide d = dot(s->axis, s->position);
    const wide k = sub(dot(s->position, s->position), frame->radius2);
    wide n[3];
    wide c[3];
    wide dn[2][3];
    wide nc[6]; /* n_i c_j + c_i n_j, packed */
    wide q[6];
    wide h[FIT_PARAMETERS];
    wide radial; /* dF/dr on the unit circle, constant to first order */
    int p;
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        n[i] = dot(frame->column[i], s->axis);
        c[i] = dot(frame->column[i], s->position);
        dn[0][i] = dot(frame->column[i], s->turn[0]);
        dn[1][i] = dot(frame->column[i], s->turn[1]);
    }
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            const int at = DROGUE_PACKED(i, j);
            nc[at] = add(mul(n[i], c[j]), mul(c[i], n[j]));
            q[at] = add(mul(d, sub(mul(d, frame->gram[at]), nc[at])), mul(k, mul(n[i], n[j])));
        }
    }
    radial = add(q[0], q[2]);
    harmonics(h, q);
    for (i = 0; i < FIT_PARAMETERS; i++) {
        out->residual[i] = drogue_wide_neg(drogue_wide_div(h[i], radial));
    }
    for (p = 0; p < FIT_PARAMETERS; p++) {
        wide dd;
        wide dq[6];
        wide dh[FIT_PARAMETERS];
        wide dradial;
        dd = p < 3 ? s->axis[p] : dot(s->turn[p - 3], s->position);
        for (i = 0; i < 3; i++) {
            for (j = 0; j <= i; j++) {
                const int at = DROGUE_PACKED(i, j);
                wide turned; /* what the changed vector alone does */
                if (p < 3) {
                    turned = sub(drogue_wide_scale(mul(s->position[p], mul(n[i], n[j])), 1),
                                 mul(d, add(mul(n[i], frame->column[j][p]), mul(frame->column[i][p], n[j]))));
                } else {
                    const wide *t = dn[p - 3];
                    turned = sub(mul(k, add(mul(t[i], n[j]), mul(n[i], t[j]))),
                                 mul(d, add(mul(t[i], c[j]), mul(c[i], t[j]))));
                }
                dq[at] = add(mul(dd, sub(drogue_wide_scale(mul(d, frame->gram[at]), 1), nc[at])), turned);
            }
        }
        dradial = add(dq[0], dq[2]);
        harmonics(dh, dq);
        for (i = 0; i < FIT_PARAMETERS; i++) {
            out->slope[i][p] = drogue_wide_neg(drogue_wide_div(add(dh[i], mul(out->residual[i], dradial)), radial));
        }
    }
    out->rows = FIT_PARAMETERS;
}

/* Divide the outline's rows by the root of its covariance. */
static void whiten(equations *out, const wide root[DROGUE_PACKED_MAX])
{
    int p;
    int i;
    int k;
    for (p = 0; p <= FIT_PARAMETERS; p++) {
        for (i = 0; i < FIT_PARAMETERS; i++) {
            wide sum = p < FIT_PARAMETERS ? out->slope[i][p] : out->residual[i];
            for (k = 0; k < i; k++) {
                const wide done = p < FIT_PARAMETERS ? out->slope[k][p] : out->residual[k];
                sum = sub(sum, mul(root[DROGUE_PACKED(i, k)], done));
            }
            sum = drogue_wide_div(sum, root[DROGUE_PACKED(i, i)]);
            if (p < FIT_PARAMETERS) {
                out->slope[i][p] = sum;
            } else {
                out->residual[i] = sum;
            }
        }
    }
}

/* Centre (x, y, z = 1) of the image of the disc about the axis at a depth, in ray coordinates. */
static drogue_status disc_centre(wide centre[2], wide middle[3], const state *s, const drogue_model *model)
{
    const wide depth = drogue_wide_from_q16(model->inner_depth_m_q16);
    const wide radius = drogue_wide_from_q16(model->inner_radius_m_q16);
    wide d;
    wide k;
    wide q[6];
    wide determinant;
    int i;
    int j;
    for (i = 0; i < 3; i++) {
        middle[i] = add(s->position[i], mul(depth, s->axis[i]));
    }
    if (middle[2].mantissa <= 0) {
        return DROGUE_E_BEHIND_CAMERA;
    }
    d = dot(s->axis, middle);
    k = sub(dot(middle, middle), mul(radius, radius));
    for (i = 0; i < 3; i++) {
        for (j = 0; j <= i; j++) {
            const wide *n = s->axis;
            q[DROGUE_PACKED(i, j)] =
                sub(mul(k, mul(n[i], n[j])), mul(d, add(mul(n[i], middle[j]), mul(middle[i], n[j]))));
        }
        q[DROGUE_PACKED(i, i)] = add(q[DROGUE_PACKED(i, i)], mul(d, d));
    }
    determinant = sub(mul(q[0], q[2]), mul(q[1], q[1]));
    if (determinant.mantissa <= 0) {
        return DROGUE_E_DOMAIN;
    }
    centre[0] = drogue_wide_div(sub(mul(q[1], q[4]), mul(q[2], q[3])), determinant);
    centre[1] = drogue_wide_div(sub(mul(q[1], q[3]), mul(q[0], q[4])), determinant);
    return DROGUE_OK;
}

/* The inner part's rows: image of the disc's centroid less the measured one; slopes are those of its centre. */
static drogue_status inner_rows(equations *out, const state *s, const drogue_joint_inner *inner,
                                const drogue_camera *camera, const drogue_model *model)
{
    const wide std = drogue_wide_from_q16(inner->std_px_q16);
    const wide depth = drogue_wide_from_q16(model->inner_depth_m_q16);
    const int64_t measured_q16[2] = {(int64_t)inner->x_px_q16 - camera->cx_px_q16,
                                     (int64_t)inner->y_px_q16 - camera->cy_px_q16};
    wide centre[2];
    wide middle[3];
    const drogue_status status = disc_centre(centre, middle, s, model);
    int i;
    int p;
    if (status != DROGUE_OK) {
        return status;
    }
    for (i = 0; i < 2; i++) {
        const wide scale = drogue_wide_div(drogue_wide_from_q16(i == 0 ? camera->fx_px_q16 : camera->fy_px_q16), std);
        const int row = FIT_PARAMETERS + i;
        out->residual[row] =
            sub(mul(scale, centre[i]), drogue_wide_div(drogue_wide_from_s64(measured_q16[i], -16), std));
        for (p = 0; p < FIT_PARAMETERS; p++) {
            wide across = integer(p == i); /* change of the disc's centre along x or y, and along z */
            wide along = integer(p == 2);
            if (p >= 3) {
                across = mul(depth, s->turn[p - 3][i]);
                along = mul(depth, s->turn[p - 3][2]);
            }
            out->slope[row][p] = mul(scale, drogue_wide_div(sub(across, mul(centre[i], along)), middle[2]));
        }
    }
    out->rows = ROWS;
    return DROGUE_OK;
}

/* ---- the solver */

/* Normal equations; angles get the information 1 / rad^2, which only matters where nothing else says anything. */
static drogue_status normal_equations(wide normal[DROGUE_PACKED_MAX], wide right[FIT_PARAMETERS], const equations *e)
{
    int i;
    int j;
    int r;
    for (i = 0; i < FIT_PARAMETERS; i++) {
        right[i] = integer(0);
        for (j = 0; j <= i; j++) {
            wide sum = integer(i == j && i >= 3);
            for (r = 0; r < e->rows; r++) {
                sum = add(sum, mul(e->slope[r][i], e->slope[r][j]));
            }
            normal[DROGUE_PACKED(i, j)] = sum;
        }
        for (r = 0; r < e->rows; r++) {
            right[i] = sub(right[i], mul(e->slope[r][i], e->residual[r]));
        }
    }
    return drogue_cholesky_factor(normal, FIT_PARAMETERS);
}

static drogue_status all_rows(equations *e, state *s, const ray_frame *frame, const wide root[DROGUE_PACKED_MAX],
                              const drogue_joint_inner *inner, const drogue_camera *camera, const drogue_model *model)
{
    turn_axis(s);
    outline_rows(e, s, frame);
    whiten(e, root);
    return inner->std_px_q16 > 0 ? inner_rows(e, s, inner, camera, model) : DROGUE_OK;
}

static wide limited(wide v, wide most)
{
    return drogue_wide_cmp(v, most) > 0                    ? most
           : drogue_wide_cmp(v, drogue_wide_neg(most)) < 0 ? drogue_wide_neg(most)
                                                           : v;
}

/* One step, at most half a radian in each angle, and never past the plane of the camera. */
static void move(state *s, const wide step[FIT_PARAMETERS])
{
    const wide most_turn = drogue_wide_from_s64(1, -1);
    const wide most_angle = drogue_wide_from_q16(DROGUE_Q16_HALF_PI);
    int i;
    for (i = 0; i < 3; i++) {
        s->position[i] = add(s->position[i], step[i]);
    }
    for (i = 0; i < 2; i++) {
        s->angle[i] = limited(add(s->angle[i], limited(step[3 + i], most_turn)), most_angle);
    }
}

static int small(const wide step[FIT_PARAMETERS], const state *s)
{
    int i;
    for (i = 0; i < FIT_PARAMETERS; i++) {
        const wide most = drogue_wide_scale(i < 3 ? s->position[2] : integer(1), -SETTLED_BITS);
        if (drogue_wide_cmp(limited(step[i], most), step[i]) != 0) {
            return 0;
        }
    }
    return 1;
}

static wide square_sum(const wide *v, int count)
{
    wide sum = integer(0);
    int i;
    for (i = 0; i < count; i++) {
        sum = add(sum, mul(v[i], v[i]));
    }
    return sum;
}

static void start_from(state *s, const drogue_pose *pose)
{
    int k;
    for (k = 0; k < 3; k++) {
        s->position[k] = drogue_wide_from_q16(pose->position_m_q16[k]);
    }
    s->angle[0] = drogue_wide_from_q16(pose->yaw_rad_q16);
    s->angle[1] = drogue_wide_from_q16(pose->pitch_rad_q16);
}

static drogue_status finish(drogue_pose *out, const state *s)
{
    int k;
    for (k = 0; k < 3; k++) {
        out->position_m_q16[k] = drogue_wide_to_q16(s->position[k]);
        out->axis_q16[k] = drogue_wide_to_q16(s->axis[k]);
        if (out->position_m_q16[k] == DROGUE_Q16_MAX || out->position_m_q16[k] == DROGUE_Q16_MIN) {
            return DROGUE_E_DOMAIN;
        }
    }
    out->yaw_rad_q16 = drogue_wide_to_q16(s->angle[0]);
    out->pitch_rad_q16 = drogue_wide_to_q16(s->angle[1]);
    return s->position[2].mantissa > 0 ? DROGUE_OK : DROGUE_E_BEHIND_CAMERA;
}

drogue_status drogue_joint_solve(drogue_joint *out, const drogue_pose *start, const drogue_joint_outline *outline,
                                 const drogue_joint_inner *inner, const drogue_camera *camera,
                                 const drogue_model *model, int steps)
{
    wide root[DROGUE_PACKED_MAX];
    wide normal[DROGUE_PACKED_MAX];
    wide right[FIT_PARAMETERS];
    ray_frame frame;
    equations e;
    state s;
    drogue_status status;
    int last = 0;
    int step;
    memcpy(root, outline->covariance, sizeof root);
    status = drogue_cholesky_factor(root, FIT_PARAMETERS);
    ray_frame_of(&frame, &outline->ellipse, camera, model->rim_radius_m_q16);
    start_from(&s, start);
    for (step = 0; !last && status == DROGUE_OK; step++) {
        status = all_rows(&e, &s, &frame, root, inner, camera, model);
        if (status == DROGUE_OK) {
            status = normal_equations(normal, right, &e);
        }
        if (status != DROGUE_OK) {
            return status;
        }
        last = step == steps;
        if (steps > 0) {
            drogue_cholesky_solve(right, normal, FIT_PARAMETERS);
            last = last || small(right, &s);
            move(&s, right);
        }
    }
    if (status != DROGUE_OK) {
        return status;
    }
    drogue_cholesky_invert(out->covariance, normal, FIT_PARAMETERS);
    out->chi2 = square_sum(e.residual, e.rows);
    turn_axis(&s);
    return finish(&out->pose, &s);
}

drogue_status drogue_inner_disc_image(drogue_ellipse *out, const drogue_pose *pose, const drogue_camera *camera,
                                      const drogue_model *model)
{
    const wide fx = drogue_wide_from_q16(camera->fx_px_q16);
    const wide fy = drogue_wide_from_q16(camera->fy_px_q16);
    wide centre[2];
    wide middle[3];
    wide size;
    wide facing;
    state s;
    drogue_status status;
    memset(out, 0, sizeof *out);
    start_from(&s, pose);
    turn_axis(&s);
    status = disc_centre(centre, middle, &s, model);
    if (status != DROGUE_OK) {
        return status;
    }
    size = drogue_wide_div(mul(drogue_wide_from_q16(model->inner_radius_m_q16), drogue_wide_scale(add(fx, fy), -1)),
                           middle[2]);
    facing = drogue_wide_div(dot(s.axis, middle), drogue_wide_sqrt(dot(middle, middle)));
    out->xc_px_q16 = drogue_wide_to_q16(add(mul(fx, centre[0]), drogue_wide_from_q16(camera->cx_px_q16)));
    out->yc_px_q16 = drogue_wide_to_q16(add(mul(fy, centre[1]), drogue_wide_from_q16(camera->cy_px_q16)));
    out->a_px_q16 = drogue_wide_to_q16(size);
    out->b_px_q16 = drogue_wide_to_q16(mul(size, facing));
    return out->b_px_q16 > 0 ? DROGUE_OK : DROGUE_E_DOMAIN;
}
