/* SPDX-License-Identifier: Apache-2.0 */
/* The inner disc in the measurement model of the joint pose: its image, and how that moves with the pose. */
#include "joint_model.h"

#include <string.h>

#include "drogue/ellipse.h"

static const drogue_real one = DROGUE_REAL_ONE;

/* The inner disc as rays: lengths over the depth of its middle. */
typedef struct disc {
    drogue_real over_depth;
    drogue_real middle[2];
    drogue_real axis[3];
    drogue_real radius;
    drogue_real across2;  /* squared part of the axis across the line of sight */
    drogue_real size;     /* 1 - radius^2 across2 */
    drogue_real image[2]; /* centre of its image, which is not the image of its middle */
} disc;

/* A circle of radius r about c with axis n touches the planes v where (v.c)^2 = r^2 (|v|^2 - (v.n)^2); the pole of the
 * line at infinity, v = (0, 0, 1), is the centre of its image. */
static drogue_status see_disc(disc *out, const drogue_joint_state *s, const drogue_joint_frame *frame)
{
    drogue_real r2;
    drogue_real t;
    drogue_real depth;
    int k;
    for (k = 0; k < 3; k++) {
        drogue_real_set(&out->axis[k], s->axis_q30[k], -30);
    }
    drogue_real_set(&depth, s->position_q30[2], s->scale - 30);
    drogue_real_products(&depth, &depth, &one, &frame->depth, &out->axis[2]);
    if (depth.mantissa <= 0) {
        return DROGUE_E_BEHIND_CAMERA;
    }
    drogue_real_quotient(&out->over_depth, &one, &depth);
    drogue_real_product(&out->radius, &frame->radius, &out->over_depth);
    drogue_real_product(&r2, &out->radius, &out->radius);
    drogue_real_products(&out->across2, &out->axis[0], &out->axis[0], &out->axis[1], &out->axis[1]);
    drogue_real_determinant(&out->size, &one, &one, &out->across2, &r2);
    drogue_real_product(&r2, &r2, &out->axis[2]);
    for (k = 0; k < 2; k++) {
        drogue_real_set(&t, s->position_q30[k], s->scale - 30);
        drogue_real_products(&t, &t, &one, &frame->depth, &out->axis[k]);
        drogue_real_product(&out->middle[k], &t, &out->over_depth);
        if ((out->middle[k].mantissa != 0 && out->middle[k].exponent > -30) ||
            out->size.mantissa <= 0) { /* two focal lengths off the axis */
            return DROGUE_E_DOMAIN;
        }
        drogue_real_products(&t, &out->middle[k], &one, &r2, &out->axis[k]);
        drogue_real_quotient(&out->image[k], &t, &out->size);
    }
    return DROGUE_OK;
}

/* The inner part's rows: image of the disc's centroid less the measured one; slopes are those of its middle. */
drogue_status drogue_joint_inner_rows(drogue_joint_rows *out, const drogue_joint_state *s,
                                      const drogue_joint_frame *frame)
{
    disc seen;
    const drogue_status status = see_disc(&seen, s, frame);
    int i;
    int p;
    if (status != DROGUE_OK) {
        return status;
    }
    for (i = 0; i < 2; i++) {
        drogue_real_difference(&out->column[DROGUE_JOINT_FIT].inner[i], &seen.image[i], &frame->inner[i]);
        drogue_real_copy(&out->column[i].inner[i], &seen.over_depth);
        drogue_real_set(&out->column[1 - i].inner[i], 0, 0);
        drogue_real_product(&out->column[2].inner[i], &seen.image[i], &seen.over_depth);
        drogue_real_negate(&out->column[2].inner[i]);
        for (p = 3; p < DROGUE_JOINT_FIT; p++) { /* change of the disc's middle across and along the ray */
            drogue_real *const slope = &out->column[p].inner[i];
            drogue_real across;
            drogue_real along;
            drogue_real_set(&across, s->turn_q30[p - 3][i], -30);
            drogue_real_set(&along, s->turn_q30[p - 3][2], -30);
            drogue_real_determinant(slope, &across, &one, &seen.image[i], &along);
            drogue_real_product(slope, slope, &frame->depth);
            drogue_real_product(slope, slope, &seen.over_depth);
        }
    }
    return DROGUE_OK;
}

/* ray focal + centre */
static drogue_q16 pixel_q16(const drogue_real *ray, int64_t focal_px_q16, drogue_q16 centre_px_q16)
{
    drogue_real t;
    drogue_real_set(&t, focal_px_q16, -16);
    drogue_real_product(&t, ray, &t);
    return drogue_q16_add(drogue_real_to_q16(t), centre_px_q16);
}

/* The same planes give the matrix whose eigenvalues are the squared semi-axes of the image, without a difference of
 * what is nearly equal: with m the middle and n the axis, in the image's two coordinates,
 * (r / size)^2 (across2 m m' + nz (m n' + n m') + (r^2 - 1) n n' + size). Entries xx, xy, yy. */
static void disc_shape(drogue_real shape[3], const disc *seen, const drogue_camera *camera)
{
    drogue_real scale[2];
    drogue_real less; /* 1 - r^2 */
    int i;
    int j;
    drogue_real_quotient(&scale[0], &seen->radius, &seen->size);
    drogue_real_set_q16(&scale[1], camera->fy_px_q16);
    drogue_real_product(&scale[1], &scale[0], &scale[1]);
    drogue_real_set_q16(&less, camera->fx_px_q16);
    drogue_real_product(&scale[0], &scale[0], &less);
    drogue_real_determinant(&less, &one, &one, &seen->radius, &seen->radius);
    for (i = 0; i < 2; i++) {
        for (j = 0; j <= i; j++) {
            drogue_real *const entry = &shape[i + j];
            drogue_real t;
            drogue_real u;
            drogue_real_products(&t, &seen->middle[i], &seen->axis[j], &seen->axis[i], &seen->middle[j]);
            drogue_real_product(&u, &seen->middle[i], &seen->middle[j]);
            drogue_real_products(&t, &seen->across2, &u, &seen->axis[2], &t);
            drogue_real_product(&u, &seen->axis[i], &seen->axis[j]);
            if (i == j) {
                drogue_real_determinant(&u, &seen->size, &one, &u, &less);
            } else {
                drogue_real_product(&u, &u, &less);
                drogue_real_negate(&u);
            }
            drogue_real_sum(&t, &t, &u);
            drogue_real_product(&t, &t, &scale[i]);
            drogue_real_product(entry, &t, &scale[j]);
        }
    }
}

drogue_status drogue_inner_disc_image(drogue_ellipse *out, const drogue_pose *pose, const drogue_camera *camera,
                                      const drogue_model *model)
{
    drogue_joint_state s;
    drogue_joint_frame frame;
    drogue_real shape[3];
    drogue_real facing;
    disc seen;
    drogue_status status = drogue_joint_place(&s, pose, model);
    memset(out, 0, sizeof *out);
    drogue_joint_size_disc(&frame, model);
    if (status == DROGUE_OK) {
        status = see_disc(&seen, &s, &frame);
    }
    if (status != DROGUE_OK) {
        return status;
    }
    drogue_real_products(&facing, &seen.axis[0], &seen.middle[0], &seen.axis[1], &seen.middle[1]);
    drogue_real_sum(&facing, &facing, &seen.axis[2]);
    disc_shape(shape, &seen, camera);
    if (facing.mantissa <= 0 || drogue_shape_ellipse(out, shape) != DROGUE_OK) {
        return DROGUE_E_DOMAIN;
    }
    out->xc_px_q16 = pixel_q16(&seen.image[0], camera->fx_px_q16, camera->cx_px_q16);
    out->yc_px_q16 = pixel_q16(&seen.image[1], camera->fy_px_q16, camera->cy_px_q16);
    return DROGUE_OK;
}
