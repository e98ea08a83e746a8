/* SPDX-License-Identifier: Apache-2.0 */
/* The counting functions. CMakeLists.txt reads the names to wrap from the lines that begin with WRAP. */
#include "stages.h"

#include <string.h>

#include "counter.h"
#include "drogue/drogue.h"
#include "drogue/ellipse.h"
#include "drogue/inner.h"
#include "drogue/joint.h"

const char *const stage_names[STAGE_COUNT] = {"front_end", "constraints", "fit",   "outline",
                                              "inner",     "pose",        "joint", "rest"};

static uint32_t counts[STAGE_COUNT];
static stage current;
static uint32_t since;

/* Book what has run since the last call on the stage that ran, and go over to another. Returns the one that ran. */
static stage enter(stage next)
{
    stage was = current;
    uint32_t now = counter_read();
    counts[was] += counter_between(since, now);
    since = now;
    current = next;
    return was;
}

void stages_begin(void)
{
    memset(counts, 0, sizeof counts);
    current = REST;
    since = counter_read();
}

void stages_end(uint32_t instructions[STAGE_COUNT])
{
    (void)enter(REST);
    memcpy(instructions, counts, sizeof counts);
}

#define WRAP(where, type, name, parameters, arguments) \
    type __real_##name parameters;                     \
    type __wrap_##name parameters;                     \
    type __wrap_##name parameters                      \
    {                                                  \
        stage outer = enter(where);                    \
        type result = __real_##name arguments;         \
        (void)enter(outer);                            \
        return result;                                 \
    }

#define WRAP_VOID(where, name, parameters, arguments) \
    void __real_##name parameters;                    \
    void __wrap_##name parameters;                    \
    void __wrap_##name parameters                     \
    {                                                 \
        stage outer = enter(where);                   \
        __real_##name arguments;                      \
        (void)enter(outer);                           \
    }

/* clang-format off */
WRAP(FRONT_END, drogue_status, drogue_frontend_begin, (drogue_frontend *a, drogue_workspace *b,
     const drogue_frontend_config *c, int32_t d, int32_t e), (a, b, c, d, e))
WRAP_VOID(FRONT_END, drogue_frontend_row, (drogue_frontend *a, const uint8_t *b), (a, b))
WRAP(FRONT_END, drogue_status, drogue_frontend_end, (drogue_edge_list *a, drogue_frontend *b), (a, b))
WRAP(CONSTRAINTS, drogue_status, drogue_select_arcs, (drogue_arc_choices *a, drogue_point *b, const drogue_edge *c,
     const drogue_arc *d, uint32_t e, const drogue_mask *f, drogue_q16 g, drogue_polarity h), (a, b, c, d, e, f, g, h))
WRAP(FIT, drogue_status, drogue_ellipse_fit, (drogue_ellipse *a, const drogue_moments *b, int c), (a, b, c))
WRAP(OUTLINE, drogue_status, drogue_outline_find, (drogue_outline *a, const drogue_workspace *b,
     const drogue_edge_list *c, const drogue_mask *d, const drogue_config *e), (a, b, c, d, e))
WRAP_VOID(OUTLINE, drogue_outline_pull, (drogue_outline *a, drogue_ray b[DROGUE_RAYS], const drogue_image *c,
     const drogue_config *d), (a, b, c, d))
WRAP(OUTLINE, drogue_status, drogue_outline_undistorted, (drogue_ellipse *a, const drogue_outline *b,
     const drogue_workspace *c, const drogue_edge_list *d, const drogue_setup *e, int32_t f, int32_t g),
     (a, b, c, d, e, f, g))
WRAP(INNER, drogue_status, drogue_inner_edge_find, (drogue_inner_edge *a, drogue_ray b[DROGUE_RAYS],
     const drogue_image *c, const drogue_inner_expected *d, const drogue_ellipse *e, const drogue_config *f),
     (a, b, c, d, e, f))
WRAP(POSE, drogue_status, drogue_pose_from_ellipse, (drogue_pose a[2], const drogue_ellipse *b, const drogue_camera *c,
     drogue_q16 d), (a, b, c, d))
WRAP(POSE, drogue_status, drogue_choose_pose, (drogue_choice *a, const drogue_pose b[2], drogue_q16 c, drogue_q16 d,
     drogue_q16 e, const drogue_camera *f), (a, b, c, d, e, f))
WRAP(JOINT, drogue_status, drogue_joint_outline_covariance, (drogue_real a[DROGUE_PACKED_MAX], const drogue_ellipse *b,
     const drogue_support *c, drogue_q16 d, drogue_q16 e), (a, b, c, d, e))
WRAP(JOINT, drogue_status, drogue_joint_solve, (drogue_joint *a, const drogue_pose *b, const drogue_joint_outline *c,
     const drogue_joint_inner *d, const drogue_camera *e, const drogue_model *f, int g), (a, b, c, d, e, f, g))
/* clang-format on */
