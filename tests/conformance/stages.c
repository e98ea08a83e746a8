/* SPDX-License-Identifier: Apache-2.0 */
/* Table of the stages, check of their inputs, and the guarded static memory they run in. */
#include "stage_run.h"

#include <string.h>

/* --- memory: one block, cut into buffers with a guard behind each --- */

#define GUARD_BYTES 16u
#define GUARD_SLACK (STAGE_MAX_BUFFERS * (GUARD_BYTES + 8u))
#define ARCS_BYTES                                                                                   \
    (DROGUE_WORKSPACE_BYTES(DROGUE_MAX_SIDE, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS) + 12u + \
     CONF_MAX_EDGES * 32u)
#define GRADIENT_BYTES (CONF_MAX_PIXELS * 6u)
#define MEMORY_BYTES (CONF_MAX_IMAGE + (ARCS_BYTES > GRADIENT_BYTES ? ARCS_BYTES : GRADIENT_BYTES) + GUARD_SLACK)

static union {
    int64_t align;
    uint8_t bytes[MEMORY_BYTES];
} memory;

static uint8_t guard_byte(size_t offset) { return (uint8_t)(0xA5u ^ (offset & 0xFFu)); }

void *stage_take(stage_run *r, size_t bytes)
{
    uint8_t *at = memory.bytes + r->used;
    size_t end;
    size_t k;
    if (r->guard_count == STAGE_MAX_BUFFERS || bytes > MEMORY_BYTES ||
        r->used + bytes + GUARD_BYTES + 7u > MEMORY_BYTES) {
        return NULL;
    }
    memset(at, 0x5A, bytes);
    end = r->used + bytes;
    r->guard[r->guard_count++] = end;
    for (k = end; k < end + GUARD_BYTES; k++) {
        memory.bytes[k] = guard_byte(k);
    }
    r->used = (end + GUARD_BYTES + 7u) & ~(size_t)7u;
    return at;
}

static int guards_hold(const stage_run *r)
{
    int i;
    size_t k;
    for (i = 0; i < r->guard_count; i++) {
        for (k = r->guard[i]; k < r->guard[i] + GUARD_BYTES; k++) {
            if (memory.bytes[k] != guard_byte(k)) {
                return 0;
            }
        }
    }
    return 1;
}

int stage_workspace(stage_run *r, drogue_workspace *workspace, int32_t width_px)
{
    drogue_capacity capacity = {0, CONF_MAX_EDGES, CONF_MAX_LABELS, CONF_MAX_ARCS};
    size_t bytes;
    void *block;
    if (width_px < 1 || width_px > DROGUE_MAX_SIDE) {
        width_px = DROGUE_MAX_SIDE;
    }
    capacity.width_px = (uint32_t)width_px;
    bytes = drogue_workspace_bytes(&capacity); /* no more than it needs: the guard is right behind */
    block = stage_take(r, bytes);
    return block != NULL && drogue_workspace_init(workspace, block, bytes, &capacity) == DROGUE_OK;
}

/* --- inputs and outputs --- */

static void *new_output(stage_run *r, const conf_array *like)
{
    void *data = r->out_count < r->out_capacity ? stage_take(r, like->count * (size_t)(like->bits / 8)) : NULL;
    if (data != NULL) {
        conf_array *o = &r->out[r->out_count++];
        *o = *like;
        o->data = data;
    }
    return data;
}

void *stage_output(stage_run *r, const char *name, int bits, size_t count)
{
    conf_array like = {NULL, 0, 0, NULL, 0, 0};
    like.name = name;
    like.bits = bits;
    like.count = count;
    return new_output(r, &like);
}

int32_t *stage_output32(stage_run *r, const char *name, size_t count)
{
    int32_t *data = (int32_t *)stage_output(r, name, 32, count);
    if (data != NULL) {
        memset(data, 0, count * sizeof *data);
    }
    return data;
}

uint8_t *stage_output_image(stage_run *r, const char *name, int32_t width_px, int32_t height_px)
{
    conf_array like = {NULL, 8, 0, NULL, 0, 0};
    like.name = name;
    like.count = (size_t)width_px * (size_t)height_px;
    like.width_px = width_px;
    like.height_px = height_px;
    return (uint8_t *)new_output(r, &like);
}

const int32_t *stage_input32(const stage_run *r, int i) { return (const int32_t *)r->in[i].data; }

#define APART 5 /* bytes between an image's rows, which are no pixels */

/* The first input as an image; 0 when it does not fit. */
static int take_image(stage_run *r)
{
    const conf_array *in = &r->in[0];
    const size_t stride = (size_t)in->width_px + APART;
    uint8_t *rows = stride * (size_t)in->height_px <= CONF_MAX_IMAGE
                        ? (uint8_t *)stage_take(r, stride * (size_t)in->height_px)
                        : NULL;
    int32_t y;
    if (rows == NULL) {
        return 0;
    }
    r->image.data = rows;
    r->image.width_px = in->width_px;
    r->image.height_px = in->height_px;
    r->image.stride = in->width_px + APART;
    for (y = 0; y < in->height_px; y++) {
        memcpy(rows + (size_t)y * stride, (const uint8_t *)in->data + (size_t)y * (size_t)in->width_px,
               (size_t)in->width_px);
    }
    return 1;
}

drogue_ellipse stage_ellipse(const int32_t *words)
{
    drogue_ellipse e;
    e.xc_px_q16 = words[0];
    e.yc_px_q16 = words[1];
    e.a_px_q16 = words[2];
    e.b_px_q16 = words[3];
    e.angle_rad_q16 = words[4];
    return e;
}

int stage_angle_valid(const drogue_ellipse *e)
{
    return e->angle_rad_q16 >= -DROGUE_Q16_HALF_PI && e->angle_rad_q16 <= DROGUE_Q16_HALF_PI;
}

int32_t *stage_put_region(int32_t *at, const drogue_region *r)
{
    at[0] = r->x_px;
    at[1] = r->y_px;
    at[2] = r->width_px;
    at[3] = r->height_px;
    return at + 4;
}

int32_t *stage_put_ellipse(int32_t *at, const drogue_ellipse *e)
{
    at[0] = e->xc_px_q16;
    at[1] = e->yc_px_q16;
    at[2] = e->a_px_q16;
    at[3] = e->b_px_q16;
    at[4] = e->angle_rad_q16;
    return at + 5;
}

int32_t *stage_put_pose(int32_t *at, const drogue_pose *p)
{
    int k;
    for (k = 0; k < 3; k++) {
        at[k] = p->position_m_q16[k];
        at[3 + k] = p->axis_q16[k];
    }
    at[6] = p->yaw_rad_q16;
    at[7] = p->pitch_rad_q16;
    return at + 8;
}

int32_t *stage_put_estimate(int32_t *at, const drogue_track_estimate *e)
{
    memcpy(at, e->position_m_q16, sizeof e->position_m_q16);
    memcpy(at + 3, e->velocity_mps_q16, sizeof e->velocity_mps_q16);
    memcpy(at + 6, e->axis_q16, sizeof e->axis_q16);
    at[9] = e->yaw_rad_q16;
    at[10] = e->pitch_rad_q16;
    at[11] = e->orientation_resolved;
    return at + 12;
}

int stage_mask(drogue_mask *mask, const int32_t *words)
{
    const int32_t far_px = 1 << 22;
    mask->centre2_x = words[0];
    mask->centre2_y = words[1];
    mask->longest_px = words[2];
    return words[0] >= -far_px && words[0] <= far_px && words[1] >= -far_px && words[1] <= far_px && words[2] >= 0 &&
           words[2] <= 1 << 20;
}

/* --- table of the stages --- */

typedef enum input_kind { FIXED, LIST, OPTIONAL } input_kind;

/* An input: an image (bits 0), a fixed number of words, a list of items of 'words' words each, or a fixed number that a
 * case may lack, behind all others. */
typedef struct input_spec {
    const char *name;
    int bits;
    uint32_t words;
    input_kind kind;
} input_spec;

typedef struct stage_spec {
    const char *name;
    int (*run)(stage_run *r);
    input_spec inputs[CONF_MAX_INPUTS];
} stage_spec;

static const stage_spec stages[] = {
    {"smooth", stage_smooth, {{"image", 0, 0, FIXED}}},
    {"gradient", stage_gradient, {{"image", 0, 0, FIXED}}},
    {"canny", stage_canny, {{"image", 0, 0, FIXED}, {"params", 32, 3, FIXED}}},
    {"mask", stage_mask_images, {{"params", 32, 5, FIXED}}},
    {"arcs", stage_arcs, {{"image", 0, 0, FIXED}, {"params", 32, 8, FIXED}}},
    {"constraints", stage_constraints, {{"points", 16, 2, LIST}, {"params", 32, 5, FIXED}}},
    {"select", stage_select, {{"points", 16, 2, LIST}, {"arcs", 32, 2, LIST}, {"params", 32, 5, FIXED}}},
    {"ellipse", stage_ellipse_fit, {{"points", 16, 2, LIST}, {"params", 32, 1, FIXED}}},
    {"quality", stage_quality, {{"ellipse", 32, 5, FIXED}, {"points", 32, 2, LIST}, {"params", 32, 3, FIXED}}},
    {"support", stage_support, {{"ellipse", 32, 5, FIXED}, {"edges", 32, 4, LIST}, {"params", 32, 4, FIXED}}},
    {"cluster", stage_cluster, {{"candidates", 32, 7, LIST}, {"config", 32, 5, FIXED}}},
    {"eigen", stage_eigen, {{"matrix", 64, 6, FIXED}}},
    {"undistort", stage_undistort, {{"camera", 32, 9, FIXED}, {"points", 32, 2, LIST}}},
    {"pose", stage_pose, {{"ellipse", 32, 5, FIXED}, {"camera", 32, 9, FIXED}, {"params", 32, 4, FIXED}}},
    {"joint",
     stage_joint,
     {{"ellipse", 32, 5, FIXED}, {"camera", 32, 9, FIXED}, {"bins", 32, 64, FIXED}, {"params", 32, 15, FIXED}}},
    {"kalman", stage_kalman, {{"params", 32, 26, FIXED}, {"frames", 32, 10, LIST}}},
    {"frame",
     stage_frame,
     {{"image", 0, 0, FIXED},
      {"camera", 32, 9, FIXED},
      {"model", 32, 3, FIXED},
      {"region", 32, 4, FIXED},
      {"config", 32, CONF_CONFIG_WORDS, OPTIONAL}}},
    {"decide",
     stage_decide,
     {{"ellipse", 32, 5, FIXED}, {"camera", 32, 9, FIXED}, {"bins", 32, 64, FIXED}, {"params", 32, 31, FIXED}}},
    {"look",
     stage_look,
     {{"image", 0, 0, FIXED}, {"camera", 32, 9, FIXED}, {"model", 32, 3, FIXED}, {"params", 32, 9, FIXED}}},
    {"rim", stage_rim, {{"image", 0, 0, FIXED}, {"disc", 32, 4, FIXED}}},
    {"search", stage_search, {{"image", 0, 0, FIXED}, {"params", 32, 1, FIXED}}},
    {"acquire",
     stage_acquire,
     {{"image", 0, 0, FIXED}, {"camera", 32, 9, FIXED}, {"model", 32, 3, FIXED}, {"params", 32, 8, FIXED}}},
    {"follow",
     stage_follow,
     {{"image", 0, 0, FIXED}, {"camera", 32, 9, FIXED}, {"model", 32, 3, FIXED}, {"params", 32, 14, FIXED}}},
    {"track",
     stage_track,
     {{"setup", 32, 16, FIXED}, {"config", 32, 24, FIXED}, {"frames", 32, 17, LIST}, {"covariance", 64, 15, LIST}}},
};

int conf_stage_count(void) { return (int)(sizeof stages / sizeof stages[0]); }

const char *conf_stage_name(int i) { return i >= 0 && i < conf_stage_count() ? stages[i].name : NULL; }

static int input_meets(const conf_array *a, const input_spec *spec)
{
    if (strcmp(a->name, spec->name) != 0) {
        return 0;
    }
    if (spec->bits == 0) {
        return a->bits == 8 && a->width_px >= 1 && a->width_px <= DROGUE_MAX_SIDE && a->height_px >= 1 &&
               a->height_px <= DROGUE_MAX_SIDE && a->count == (size_t)a->width_px * (size_t)a->height_px;
    }
    if (a->bits != spec->bits || a->width_px != 0 || a->height_px != 0) {
        return 0;
    }
    return spec->kind == LIST ? a->count % spec->words == 0 : a->count == spec->words;
}

static int inputs_meet(const conf_array *inputs, int count, const stage_spec *spec)
{
    int i;
    for (i = 0; i < CONF_MAX_INPUTS && spec->inputs[i].name != NULL; i++) {
        if (i >= count && spec->inputs[i].kind == OPTIONAL) {
            return 1;
        }
        if (i >= count || !input_meets(&inputs[i], &spec->inputs[i])) {
            return 0;
        }
    }
    return i == count;
}

int conf_run_stage(const char *stage, const conf_array *inputs, int input_count, conf_array *outputs,
                   int output_capacity)
{
    stage_run r;
    int failure;
    int i;
    for (i = 0; i < conf_stage_count() && strcmp(stages[i].name, stage) != 0; i++) {}
    if (i == conf_stage_count() || !inputs_meet(inputs, input_count, &stages[i])) {
        return CONF_E_MALFORMED;
    }
    memset(&r, 0, sizeof r);
    r.in = inputs;
    r.in_count = input_count;
    r.out = outputs;
    r.out_capacity = output_capacity;
    if (stages[i].inputs[0].bits == 0 && !take_image(&r)) {
        return CONF_E_MEMORY;
    }
    failure = stages[i].run(&r);
    if (!guards_hold(&r)) {
        return CONF_E_GUARD;
    }
    return failure != 0 ? failure : r.out_count;
}

const char *conf_failure_text(int failure)
{
    switch (failure) {
    case CONF_E_MALFORMED: return "inputs are not what the stage takes";
    case CONF_E_MEMORY: return "inputs need more than the runner's memory";
    case CONF_E_GUARD: return "the library wrote behind a buffer";
    default: return "unknown failure";
    }
}
