/* SPDX-License-Identifier: Apache-2.0 */
/* Whatever comes: noise, flat and saturated images, single pixels, any valid configuration, any camera and model. Nothing
 * traps, the status is a documented one, and the result is what the status says. Worth most under the sanitizers. */
#include "suite.h"

#include "drogue/drogue.h"
#include "drogue/undistort.h"
#include "geometry.h"
#include "images.h"
#include "own_workspace.h"

enum { MOST_SIDE = 96, RUNS = 12000 };

typedef struct hostile {
    uint8_t pixels[MOST_SIDE * MOST_SIDE];
    drogue_image image;
    drogue_region region;
    drogue_config config;
    drogue_camera camera;
    drogue_model model;
    int known; /* configuration, camera and model are the usual ones */
} hostile;

static int32_t any_up_to(uint64_t *rng, int32_t most)
{
    int32_t v = rng_s32_any_width(rng);
    v = v < 0 ? ~v : v;
    return v > most ? rng_range(rng, 0, most) : v;
}

static void random_image(hostile *h, int kind, uint64_t *rng)
{
    int32_t width = rng_range(rng, 1, kind % 9 == 0 ? 3 : MOST_SIDE),
            height = rng_range(rng, 1, kind % 7 == 0 ? 3 : MOST_SIDE);
    int32_t i, noise = rng_range(rng, 0, 12);
    if (kind & 1) {
        kind = IMAGE_KINDS + 2;
        width = rng_range(rng, 40, MOST_SIDE);
        height = width + rng_range(rng, -10, 0);
    }
    h->image.data = h->pixels;
    h->image.width_px = h->image.stride = width;
    h->image.height_px = height;
    switch (kind % (IMAGE_KINDS + 3)) {
    case IMAGE_KINDS: memset(h->pixels, kind & 1 ? 255 : 0, sizeof h->pixels); break;
    case IMAGE_KINDS + 1: /* saturated: black and white alone */
        image_fill(h->pixels, width, height, IMAGE_RINGS, rng);
        for (i = 0; i < width * height; i++) {
            h->pixels[i] = h->pixels[i] > 127 ? 255 : 0;
        }
        break;
    case IMAGE_KINDS + 2: /* a drogue of sorts, in noise */
        image_fill(h->pixels, width, height, IMAGE_RINGS, rng);
        for (i = 0; i < width * height; i++) {
            h->pixels[i] = image_grey(h->pixels[i] + noise * rng_normal(rng));
        }
        break;
    default: image_fill(h->pixels, width, height, kind % (IMAGE_KINDS + 3), rng); break;
    }
}

static void random_region(hostile *h, uint64_t *rng)
{
    h->region.x_px = h->region.y_px = 0;
    h->region.width_px = h->image.width_px;
    h->region.height_px = h->image.height_px;
    switch (rng_range(rng, 0, 4)) {
    case 0:
        h->region.x_px = rng_range(rng, -MOST_SIDE, MOST_SIDE);
        h->region.y_px = rng_range(rng, -MOST_SIDE, MOST_SIDE);
        h->region.width_px = rng_range(rng, 1, 2 * MOST_SIDE);
        h->region.height_px = rng_range(rng, 1, 2 * MOST_SIDE);
        break;
    case 1:
        h->region.width_px = h->region.height_px = 1;
        h->region.x_px = rng_range(rng, 0, h->image.width_px - 1);
        break;
    case 2:
        h->region.x_px = rng_s32_any_width(rng);
        h->region.width_px = rng_s32_any_width(rng);
        h->region.height_px = any_up_to(rng, DROGUE_MAX_REGION);
        break;
    default: break;
    }
}

/* Some members at random within their ranges, the rest as they are; every other time only plausible ones. */
static void random_config(drogue_config *c, uint64_t *rng)
{
    int k;
    do {
        drogue_config_default(c);
        c->min_cover_q16 = rng_range(rng, 0, 3) ? c->min_cover_q16 : 0; /* more outlines go all the way */
        c->min_arc_px = rng_range(rng, 0, 3) ? c->min_arc_px : 6;
        for (k = rng_range(rng, 0, 12); k > 0; k--) {
            switch (rng_range(rng, 0, 33)) {
            case 0: c->canny_high = any_up_to(rng, 5000); break;
            case 1: c->canny_low = any_up_to(rng, c->canny_high); break;
            case 2: c->smooth = rng_range(rng, 0, 1); break;
            case 3: c->min_arc_px = (uint32_t)rng_u64(rng) >> rng_range(rng, 0, 31); break;
            case 4: c->min_arc_share_q16 = any_up_to(rng, 65536); break;
            case 5: c->min_short_px_q16 = any_up_to(rng, INT32_MAX); break;
            case 6:
                c->polarity = (drogue_polarity)rng_range(rng, 0, 2);
                c->transfer = (drogue_transfer)rng_range(rng, 0, 1);
                break;
            case 7: c->quality.fit_error_px_q16 = any_up_to(rng, 1024 * 65536); break;
            case 8: c->quality.k1_q16 = any_up_to(rng, 64 * 65536); break;
            case 9: c->quality.k2_q16 = any_up_to(rng, 65535); break;
            case 10: c->min_fit_ratio_q16 = any_up_to(rng, 65536); break;
            case 11: c->min_axis_ratio_q16 = any_up_to(rng, 65536); break;
            case 12: c->max_size_q16 = any_up_to(rng, INT32_MAX); break;
            case 13: c->min_size_q16 = any_up_to(rng, INT32_MAX); break;
            case 14: c->cluster.centre_px_q16 = any_up_to(rng, INT32_MAX); break;
            case 15: c->cluster.a_px_q16 = any_up_to(rng, INT32_MAX); break;
            case 16: c->cluster.angle_rad_q16 = any_up_to(rng, INT32_MAX); break;
            case 17: c->cluster.round_q16 = any_up_to(rng, 65536); break;
            case 18: c->search_band_q16 = any_up_to(rng, 65536); break;
            case 19: c->refit_band_px_q16 = 1 + any_up_to(rng, 8 * 65536 - 1); break;
            case 20: c->refit_cos_q16 = any_up_to(rng, 65536); break;
            case 21: c->refit_rounds = (uint32_t)rng_range(rng, 0, 16); break;
            case 22: c->min_cover_q16 = any_up_to(rng, 65536); break;
            case 23: c->recentre_cover_q16 = any_up_to(rng, 65536); break;
            case 24: c->optics_blur_px_q16 = any_up_to(rng, 16 * 65536); break;
            case 25: c->min_inner_area_px = (uint32_t)rng_u64(rng) >> rng_range(rng, 0, 31); break;
            case 26: c->inner_gate_q16 = any_up_to(rng, INT32_MAX); break;
            case 27: c->min_inner_cover_q16 = any_up_to(rng, 65536); break;
            case 28: c->inner_size_q16 = c->inner_rms_px_q16 = any_up_to(rng, INT32_MAX); break;
            case 29: c->outline_shading_q16 = 1 + any_up_to(rng, 1024 * 65536 - 1); break;
            case 30: c->optics_blur_std_px2_q16 = any_up_to(rng, 16 * 65536); break;
            case 31: c->inner_std_px_q16 = 1 + any_up_to(rng, 16 * 65536 - 1); break;
            case 32: c->inner_std_share_q16 = any_up_to(rng, 65536); break;
            default: c->max_chi2_q16 = c->min_chi2_gap_q16 = any_up_to(rng, INT32_MAX); break;
            }
        }
    } while (!drogue_config_valid(c));
}

/* A coefficient of the lens within its range. */
static drogue_q16 random_distortion(uint64_t *rng)
{
    const drogue_q16 any = rng_s32_any_width(rng);
    return any > DROGUE_MAX_DISTORTION_Q16 || any < -DROGUE_MAX_DISTORTION_Q16 ? any / 128 : any;
}

static void random_setup(hostile *h, uint64_t *rng)
{
    drogue_model *m = &h->model;
    int k;
    h->camera =
        pinhole(rng_real(rng, 50, 3000), rng_real(rng, 50, 3000), rng_real(rng, -50, 150), rng_real(rng, -50, 150));
    h->model.rim_radius_m_q16 = q16_of(0.35);
    h->model.inner_radius_m_q16 = q16_of(0.17);
    h->model.inner_depth_m_q16 = q16_of(0.2);
    drogue_config_default(&h->config);
    h->known = rng_range(rng, 0, 3) == 0;
    if (h->known) {
        return;
    }
    random_config(&h->config, rng);
    for (k = rng_range(rng, 0, 6); k > 0; k--) {
        drogue_q16 any = rng_s32_any_width(rng), positive = (any < 0 ? ~any : any) | 1;
        switch (rng_range(rng, 0, 11)) {
        case 0: h->camera.fx_px_q16 = positive; break;
        case 1: h->camera.fy_px_q16 = positive; break;
        case 2: h->camera.cx_px_q16 = any; break;
        case 3: h->camera.cy_px_q16 = any; break;
        case 4: h->camera.k1_q16 = random_distortion(rng); break;
        case 5: h->camera.k2_q16 = random_distortion(rng); break;
        case 6: h->camera.p1_q16 = random_distortion(rng); break;
        case 7: h->camera.p2_q16 = random_distortion(rng); break;
        case 8: h->camera.k3_q16 = random_distortion(rng); break;
        case 9: h->model.rim_radius_m_q16 = positive; break;
        case 10: h->model.inner_radius_m_q16 = positive; break;
        default: h->model.inner_depth_m_q16 = positive; break;
        }
    }
    m->inner_radius_m_q16 = m->inner_radius_m_q16 < m->rim_radius_m_q16 ? m->inner_radius_m_q16 : m->rim_radius_m_q16;
}

static int all_zero(const void *data, size_t bytes)
{
    const unsigned char *p = data;
    size_t i;
    for (i = 0; i < bytes && p[i] == 0; i++) {}
    return i == bytes;
}

static void must_be_a_pose(const drogue_pose *p, int run)
{
    double axis[3];
    int k;
    for (k = 0; k < 3; k++) {
        axis[k] = real_of_q16(p->axis_q16[k]);
    }
    MUST(fabs(dot3(axis, axis) - 1) < 1e-3, "run %d: axis of length^2 %g", run, dot3(axis, axis));
    MUST(fabs(real_of_q16(p->pitch_rad_q16)) < 1.5709 && fabs(real_of_q16(p->yaw_rad_q16)) < 3.1417, "run %d: angles",
         run);
}

static void check_result(const drogue_result *r, const hostile *h, int run)
{
    const int found = r->status == DROGUE_OK;
    int i, j;
    MUST(strcmp(drogue_status_name(r->status), "unknown") != 0 && r->status != DROGUE_E_TOO_FEW_POINTS &&
             r->status != DROGUE_E_DEGENERATE && r->status != DROGUE_E_NO_INNER_PART && r->status != DROGUE_E_WORKSPACE,
         "run %d: status %s", run, drogue_status_name(r->status));
    /* every argument is within its documented range */
    MUST(r->status != DROGUE_E_ARGUMENT, "run %d: arguments refused", run);
    MUST((r->has_inner == 0 || r->has_inner == 1) && (r->orientation_resolved == 0 || r->orientation_resolved == 1) &&
             (unsigned)r->polarity <= DROGUE_POLARITY_BOTH,
         "run %d: flags", run);
    MUST(r->doubt_q16 >= 0 && r->doubt_q16 < 65536 && r->ambiguity_q16 >= 0 && r->ambiguity_q16 <= 65536 &&
             r->cover_q16 >= 0 && r->cover_q16 <= 65536,
         "run %d: shares", run);
    MUST(!r->orientation_resolved || (found && r->has_inner), "run %d: resolved without an inner part", run);
    for (i = 0; i < 4; i++) {
        MUST(r->arcs[i] == DROGUE_NO_ARC || r->arcs[i] < r->list.arc_count, "run %d: arc %d", run, i);
    }
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            MUST(r->covariance_q48[i][j] == r->covariance_q48[j][i], "run %d: covariance", run);
        }
        MUST(r->covariance_q48[i][i] >= 0, "run %d: variance %d", run, i);
    }
    if (found) {
        must_be_a_pose(&r->pose, run);
        must_be_a_pose(&r->alternative, run);
        MUST(r->pose.position_m_q16[2] > 0 || !h->known, "run %d: behind the camera", run);
        MUST(r->ellipse.a_px_q16 >= r->ellipse.b_px_q16 && r->ellipse.b_px_q16 > 0, "run %d: ellipse", run);
        MUST(r->cover_q16 >= h->config.min_cover_q16 ||
                 (r->tried == DROGUE_TRIED_DISC && r->has_inner && 8 * r->cover_q16 >= 5 * h->config.min_cover_q16 - 4),
             "run %d: cover %d", run, (int)r->cover_q16);
        MUST(r->position_std_m_q32[2] > 0 && r->axis_std_rad_q32 > 0, "run %d: sure of it", run);
    } else {
        MUST(all_zero(&r->pose, sizeof r->pose) && all_zero(&r->alternative, sizeof r->alternative) &&
                 all_zero(r->covariance_q48, sizeof r->covariance_q48) && r->axis_std_rad_q32 == 0,
             "run %d: %s, but something of a pose", run, drogue_status_name(r->status));
    }
}

static void run_all(uint64_t seed, int runs, int *measured, int *statuses)
{
    static hostile h;
    int i;
    for (i = 0; i < runs; i++) {
        uint64_t rng = seed + (uint64_t)i;
        const int small = i % 10 == 0; /* tables that may fill */
        test_workspace t;
        drogue_result r, again;
        random_image(&h, i, &rng);
        random_region(&h, &rng);
        random_setup(&h, &rng);
        t = small ? test_workspace_of(MOST_SIDE, (uint32_t)rng_range(&rng, 1, 600), (uint32_t)rng_range(&rng, 2, 300),
                                      (uint32_t)rng_range(&rng, 1, 40))
                  : test_workspace_ample(MOST_SIDE, MOST_SIDE);
        memset(&r, 0x5A, sizeof r);
        memset(&again, 0xA5, sizeof again);
        MUST(drogue_measure(&r, &t.workspace, &(drogue_setup){&h.camera, &h.model, &h.config}, &h.image, &h.region) ==
                 r.status,
             "run %d: two statuses", i);
        MUST(guarded_intact(&t.memory), "run %d: wrote outside the workspace", i);
        check_result(&r, &h, i);
        (void)drogue_measure(&again, &t.workspace, &(drogue_setup){&h.camera, &h.model, &h.config}, &h.image,
                             &h.region);
        MUST(r.status == again.status && memcmp(&r.ellipse, &again.ellipse, sizeof r.ellipse) == 0 &&
                 memcmp(&r.pose, &again.pose, sizeof r.pose) == 0 &&
                 memcmp(r.covariance_q48, again.covariance_q48, sizeof r.covariance_q48) == 0,
             "run %d: another result the second time", i);
        *measured += r.status == DROGUE_OK;
        statuses[r.status]++;
        test_workspace_free(&t);
    }
}

START_TEST(whatever_comes)
{
    int measured = 0, statuses[DROGUE_STATUS_COUNT] = {0}, kinds = 0, k;
    run_all(1, RUNS, &measured, statuses);
    for (k = 0; k < DROGUE_STATUS_COUNT; k++) {
        kinds += statuses[k] > 0;
    }
    MUST(measured > RUNS / 50, "%d measured", measured); /* so that all stages are run */
    MUST(kinds >= 7, "%d kinds of status", kinds);
}
END_TEST

/* The region alone decides: what is too far, too large or nothing is refused; next to the limit there is only no pixel. */
START_TEST(ends_of_regions)
{
    static uint8_t pixels[32 * 32];
    static const drogue_region refused[] = {
        {(1 << 20) + 1, 0, 32, 32},
        {-(1 << 20) - 1, 0, 32, 32},
        {0, (1 << 20) + 1, 32, 32},
        {0, -(1 << 20) - 1, 32, 32},
        {1 << 20, 0, 32, 32},
        {0, -(1 << 20), 32, 32},
        {0, 0, 0, 32},
        {0, 0, 32, -1},
    };
    test_workspace w = test_workspace_of(32, 1000, 1000, 100);
    drogue_config config;
    drogue_result r;
    const drogue_camera camera = {100 << 16, 100 << 16, 16 << 16, 16 << 16, 0, 0, 0, 0, 0};
    const drogue_model model = {22938, 7864, 16384};
    const drogue_setup setup = {&camera, &model, &config};
    drogue_image image = {pixels, 32, 32, 32};
    size_t k;
    drogue_config_default(&config);
    for (k = 0; k < sizeof refused / sizeof *refused; k++) {
        MUST(drogue_measure(&r, &w.workspace, &setup, &image, &refused[k]) == DROGUE_E_REGION, "region %zu", k);
    }
    image.height_px = 0;
    ck_assert_int_eq(drogue_measure(&r, &w.workspace, &setup, &image, NULL), DROGUE_E_ARGUMENT);
    test_workspace_free(&w);
}
END_TEST

SUITE_MAIN("hostile", whatever_comes, ends_of_regions)
