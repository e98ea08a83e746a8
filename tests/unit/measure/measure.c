/* SPDX-License-Identifier: Apache-2.0 */
/* A whole frame: drawn drogues are measured, and every documented failure is provoked. */
#include "suite.h"

#include "drogue/drogue.h"
#include "drogue/undistort.h"
#include "geometry.h"
#include "own_workspace.h"

enum { WIDTH = 320, HEIGHT = 280, FINE = 4 };

typedef struct scene {
    double position[3], yaw, pitch;
    double outside, canopy, inside; /* grey levels */
    double depth;                   /* of the inner part, m */
    double inner_shift[2];          /* m, in the image's x and y */
    double slope[2];                /* of the background, grey levels a pixel */
    double wall, wall_share;        /* grey level within so much of the rim's radius; 0: none */
} scene;

static const drogue_model model = {22938, 13107, 16384}; /* 0.35 m, 0.2 m, 0.25 m behind the end plane */
static const drogue_region whole = {0, 0, WIDTH, HEIGHT};
static uint8_t pixels[WIDTH * HEIGHT];
static const drogue_image image = {pixels, WIDTH, HEIGHT, WIDTH};

static drogue_camera the_camera(void) { return pinhole(1465.5, 1465.5, 160, 140); }

/* Does the ray meet the disc of a radius about 'centre' across 'axis'? */
static int hits(const double ray[3], const double centre[3], const double axis[3], double radius)
{
    double t = dot3(axis, centre) / dot3(axis, ray), d[3];
    int k;
    for (k = 0; k < 3; k++) {
        d[k] = t * ray[k] - centre[k];
    }
    return dot3(d, d) <= radius * radius;
}

static void draw(const scene *s)
{
    double axis[3], inner[3], f = 1465.5;
    int32_t x, y, k;
    axis_of_angles(axis, s->yaw, s->pitch);
    for (k = 0; k < 3; k++) {
        inner[k] = s->position[k] + s->depth * axis[k] + (k < 2 ? s->inner_shift[k] : 0);
    }
    for (y = 0; y < HEIGHT; y++) {
        for (x = 0; x < WIDTH; x++) {
            double sum = 0;
            for (k = 0; k < FINE * FINE; k++) {
                double u = x + (k % FINE + 0.5) / FINE - 0.5, v = y + (k / FINE + 0.5) / FINE - 0.5, ray[3] = {0, 0, 1};
                ray[0] = (u - 160) / f;
                ray[1] = (v - 140) / f;
                sum += !hits(ray, s->position, axis, 0.35)
                           ? s->outside + s->slope[0] * (u - 160) + s->slope[1] * (v - 140)
                       : hits(ray, inner, axis, 0.2)                        ? s->inside
                       : hits(ray, s->position, axis, 0.35 * s->wall_share) ? s->wall
                                                                            : s->canopy;
            }
            pixels[y * WIDTH + x] = (uint8_t)(fmin(fmax(sum / (FINE * FINE), 0), 255) + 0.5);
        }
    }
}

static const scene usual = {{0.01, -0.02, 4.4}, 0.2, -0.1, 200, 110, 10, 0.25, {0, 0}, {0, 0}, 0, 0};

/* Angle between the axes, rad. */
static double axis_error(const drogue_pose *p, const scene *s)
{
    double axis[3], off2 = 0;
    int k;
    axis_of_angles(axis, s->yaw, s->pitch);
    for (k = 0; k < 3; k++) {
        double d = real_of_q16(p->axis_q16[k]) - axis[k];
        off2 += d * d;
    }
    return 2 * asin(fmin(1, sqrt(off2) / 2));
}

static test_workspace usual_workspace(void) { return test_workspace_of(WIDTH, 8192, 4096, 512); }

static drogue_status measure(drogue_result *out, test_workspace *t, const drogue_config *config, const drogue_model *m,
                             const drogue_region *region)
{
    const drogue_camera camera = the_camera();
    drogue_status status;
    memset(out, 0x5A, sizeof *out);
    status = drogue_measure(out, &t->workspace, &(drogue_setup){&camera, m, config}, &image, region);
    MUST(status == out->status, "status returned and status noted differ");
    MUST(guarded_intact(&t->memory), "wrote outside the workspace");
    return status;
}

START_TEST(drawn_drogues)
{
    uint64_t rng = 1;
    int i;
    for (i = 0; i < 24; i++) {
        scene s = usual;
        test_workspace t = usual_workspace();
        drogue_config config;
        drogue_result r;
        drogue_region region;
        double axis[3], d2 = 0, cosine = 0;
        int k;
        s.position[0] = rng_real(&rng, -0.04, 0.04);
        s.position[2] = rng_real(&rng, 4.2, 7);
        s.yaw = rng_real(&rng, -0.35, 0.35);
        s.pitch = rng_real(&rng, -0.35, 0.35);
        if (i & 1) { /* bright canopy on a dark ground */
            s.outside = 40;
            s.canopy = 160;
        }
        draw(&s);
        region.width_px = region.height_px = (int32_t)(2.5 * 1465.5 * 0.35 / s.position[2]);
        region.x_px = (int32_t)(160 + 1465.5 * s.position[0] / s.position[2]) - region.width_px / 2;
        region.y_px = (int32_t)(140 + 1465.5 * s.position[1] / s.position[2]) - region.width_px / 2;
        drogue_config_default(&config);
        MUST(measure(&r, &t, &config, &model, &region) == DROGUE_OK, "case %d: %s", i, drogue_status_name(r.status));
        MUST((int)r.polarity == (i & 1), "case %d: polarity", i);
        MUST(r.has_inner && r.orientation_resolved, "case %d: orientation not resolved", i);
        axis_of_angles(axis, s.yaw, s.pitch);
        for (k = 0; k < 3; k++) {
            double d = real_of_q16(r.pose.position_m_q16[k]) - s.position[k];
            d2 += d * d;
            cosine += axis[k] * real_of_q16(r.pose.axis_q16[k]);
        }
        MUST(sqrt(d2) < 0.005 * s.position[2], "case %d: position off by %g m", i, sqrt(d2));
        MUST(acos(fmin(1, cosine)) < 0.04, "case %d: axis off by %g rad", i, acos(fmin(1, cosine)));
        MUST(memcmp(&r.ideal, &r.ellipse, sizeof r.ideal) == 0, "case %d: no distortion, but another ellipse", i);
        test_workspace_free(&t);
    }
}
END_TEST

START_TEST(a_disc_too_large_refuses_the_outline)
{
    test_workspace t = usual_workspace();
    drogue_model smaller = model; /* what is drawn is its canopy's inner edge: the rim is not in the image */
    drogue_config config;
    drogue_result r;
    scene s = usual;
    s.yaw = s.pitch = 0.02; /* seen from ahead the disc's place says nothing */
    s.position[0] = s.position[1] = 0;
    draw(&s);
    drogue_config_default(&config);
    ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_OK);
    ck_assert_int_eq(r.has_inner, 1);
    smaller.inner_radius_m_q16 = q16_of(0.2 * 0.87);
    smaller.inner_depth_m_q16 = q16_of(0.25);
    ck_assert_int_eq(measure(&r, &t, &config, &smaller, &whole), DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(r.ellipse.a_px_q16, 0);
    ck_assert_int_eq(r.has_inner, 0);
    smaller.inner_radius_m_q16 = q16_of(0.2 * 1.3); /* too small a disc may be another thing: not believed */
    ck_assert_int_eq(measure(&r, &t, &config, &smaller, &whole), DROGUE_OK);
    ck_assert_int_eq(r.has_inner, 0);
    test_workspace_free(&t);
}
END_TEST

/* The same scene of a drogue 7000 times as large as far away: variances of more than 2^15 m^2 are halved, and say so. */
START_TEST(variances_too_large_for_their_format)
{
    test_workspace t = usual_workspace();
    drogue_model other = model; /* its disc is not the one drawn: it is in doubt by a part of the distance */
    drogue_config config;
    drogue_result near, far;
    int k;
    scene s = usual;
    s.yaw = s.pitch = 0.02;
    s.position[0] = s.position[1] = 0;
    draw(&s);
    drogue_config_default(&config);
    other.inner_radius_m_q16 = q16_of(0.2 * 1.3);
    other.inner_depth_m_q16 = q16_of(0.25);
    ck_assert_int_eq(measure(&near, &t, &config, &other, &whole), DROGUE_OK);
    ck_assert_int_eq(near.covariance_halved, 0);
    other.rim_radius_m_q16 *= 7000;
    other.inner_radius_m_q16 *= 7000;
    other.inner_depth_m_q16 *= 7000;
    ck_assert_int_eq(measure(&far, &t, &config, &other, &whole), DROGUE_OK);
    MUST(far.covariance_halved > 0, "variance %g", (double)far.covariance_q48[2][2] * 0x1p-48);
    for (k = 0; k < 3; k++) {
        const double std = (double)far.position_std_m_q32[k] * 0x1p-32;
        const double variance = ldexp((double)far.covariance_q48[k][k], far.covariance_halved - 48);
        MUST(fabs(std / (7000 * (double)near.position_std_m_q32[k] * 0x1p-32) - 1) < 0.01, "std %d: %g m", k, std);
        MUST(fabs(variance / (std * std) - 1) < 0.01, "variance %d: %g m^2 for %g m", k, variance, std);
    }
    test_workspace_free(&t);
}
END_TEST

/* Its outer edge is faint, and the disc is 3 to 5 % larger than what the inner one lets expect. */
START_TEST(a_canopy_so_narrow_that_its_inner_edge_is_found)
{
    double share;
    for (share = 0.955; share < 0.975; share += 0.005) {
        test_workspace t = usual_workspace();
        drogue_config config;
        drogue_result r;
        scene s = usual;
        s.outside = 100;
        s.canopy = 120;
        s.wall = 30;
        s.wall_share = share;
        draw(&s);
        drogue_config_default(&config);
        MUST(measure(&r, &t, &config, &model, &whole) == DROGUE_OK, "share %g: %s", share,
             drogue_status_name(r.status));
        MUST(fabs(real_of_q16(r.ideal.a_px_q16) - 1465.5 * 0.35 / 4.4) < 0.3, "share %g: a = %g px", share,
             real_of_q16(r.ideal.a_px_q16));
        MUST(r.tried != DROGUE_TRIED_FOUND, "share %g: at once", share);
        test_workspace_free(&t);
    }
}
END_TEST

/* A lighter ring about the rim is none of the drogue where the disc is exactly of the size that the rim lets expect. */
START_TEST(a_ring_about_the_rim)
{
    double share;
    for (share = 0.965; share < 0.98; share += 0.005) {
        test_workspace t = usual_workspace();
        const drogue_model within = {q16_of(0.35 * share), 13107, 16384};
        drogue_config config;
        drogue_result r;
        scene s = usual;
        s.canopy = 218;
        s.wall = 150;
        s.wall_share = share;
        draw(&s);
        drogue_config_default(&config);
        MUST(measure(&r, &t, &config, &within, &whole) == DROGUE_OK && r.has_inner, "share %g: %s", share,
             drogue_status_name(r.status));
        MUST(fabs(real_of_q16(r.ideal.a_px_q16) - 1465.5 * 0.35 * share / 4.4) < 0.4,
             "share %g: a = %g px for %g, tried %d, doubt %g", share, real_of_q16(r.ideal.a_px_q16),
             1465.5 * 0.35 * share / 4.4, (int)r.tried, real_of_q16(r.doubt_q16));
        test_workspace_free(&t);
    }
}
END_TEST

/* Noise has no outer edge, however large an outline it is asked about. */
START_TEST(noise_about_the_rim)
{
    const drogue_model alone = {22938, 0, 0};
    drogue_region region = whole;
    uint64_t rng = 5;
    int i, k, ok = 0;
    for (i = 0; i < 48; i++) {
        test_workspace t = usual_workspace();
        const double sigma = 8 + i % 8;
        drogue_config config;
        drogue_result r;
        scene s = usual;
        s.position[2] = 6 + 0.3 * i;
        s.outside = 100;
        s.canopy = 60;
        s.inside = 60;
        s.position[0] = s.position[1] = 0;
        draw(&s);
        for (k = 0; k < WIDTH * HEIGHT; k++) {
            const double noise = rng_real(&rng, -1, 1) + rng_real(&rng, -1, 1) + rng_real(&rng, -1, 1);
            pixels[k] = (uint8_t)fmin(fmax(pixels[k] + sigma * noise + 0.5, 0), 255);
        }
        drogue_config_default(&config);
        region.width_px = region.height_px = (int32_t)(2.5 * 1465.5 * 0.35 / s.position[2]);
        region.x_px = 160 - region.width_px / 2;
        region.y_px = 140 - region.height_px / 2;
        if (measure(&r, &t, &config, &alone, &region) == DROGUE_OK) {
            ok++;
            MUST(r.tried != DROGUE_TRIED_RAYS, "sigma %g, %g px: a = %g px for %g", sigma,
                 1465.5 * 0.35 / s.position[2], real_of_q16(r.ideal.a_px_q16), 1465.5 * 0.35 / s.position[2]);
        }
        test_workspace_free(&t);
    }
    ck_assert_int_gt(ok, 20);
}
END_TEST

START_TEST(without_inner_part)
{
    test_workspace t = usual_workspace();
    drogue_model no_inner = model;
    drogue_config config;
    drogue_result r;
    no_inner.inner_radius_m_q16 = 0;
    draw(&usual);
    drogue_config_default(&config);
    ck_assert_int_eq(measure(&r, &t, &config, &no_inner, &whole), DROGUE_OK);
    ck_assert_int_eq(r.has_inner, 0);
    ck_assert_int_eq(r.orientation_resolved, 0);
    ck_assert_int_eq(r.ambiguity_q16, 65536);
    ck_assert_int_ne(memcmp(&r.pose, &r.alternative, sizeof r.pose), 0);
    ck_assert(r.inner.x_px_q16 == 0 && r.inner.y_px_q16 == 0 && r.inner.area_px == 0);
    config.min_inner_area_px = 1000000; /* known, but not found */
    ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_OK);
    ck_assert_int_eq(r.has_inner, 0);
    ck_assert_int_eq(r.orientation_resolved, 0);
    ck_assert(r.inner.x_px_q16 == 0 && r.inner.y_px_q16 == 0 && r.inner.area_px == 0);
    test_workspace_free(&t);
}
END_TEST

/* A region that is a part of the image, and one that reaches past it, see the same drogue. */
START_TEST(regions_of_one_image)
{
    static const drogue_region regions[] = {
        {12, -6, 300, 280}, {10, -10, 300, 300}, {-5, -25, 330, 330}, {14, -16, 300, 296}};
    test_workspace t = usual_workspace();
    drogue_config config;
    drogue_result r, base;
    size_t i;
    draw(&usual);
    drogue_config_default(&config);
    ck_assert_int_eq(measure(&base, &t, &config, &model, &whole), DROGUE_OK);
    for (i = 0; i < sizeof regions / sizeof regions[0]; i++) {
        ck_assert_int_eq(measure(&r, &t, &config, &model, &regions[i]), DROGUE_OK);
        ck_assert_int_le(abs(r.ellipse.xc_px_q16 - base.ellipse.xc_px_q16), 1000);
        ck_assert_int_le(abs(r.ellipse.yc_px_q16 - base.ellipse.yc_px_q16), 1000);
        ck_assert_int_le(abs(r.ellipse.a_px_q16 - base.ellipse.a_px_q16), 1000);
        ck_assert_int_ge(r.region.x_px, 0);
        ck_assert_int_ge(r.region.y_px, 0);
        ck_assert_int_le(r.region.x_px + r.region.width_px, WIDTH);
        ck_assert_int_le(r.region.y_px + r.region.height_px, HEIGHT);
    }
    test_workspace_free(&t);
}
END_TEST

/* A drogue half out of the image: the ring stays about the middle of the region asked for. */
START_TEST(ring_of_a_clipped_region)
{
    static const drogue_region asked = {-60, -20, 320, 320};
    const drogue_mask ring = drogue_mask_of_size(asked.width_px, asked.height_px);
    test_workspace t = usual_workspace();
    drogue_config config;
    drogue_result r;
    scene s = usual;
    uint32_t i;
    s.position[0] = -0.18;
    draw(&s);
    drogue_config_default(&config);
    ck_assert_int_eq(measure(&r, &t, &config, &model, &asked), DROGUE_OK);
    ck_assert(r.region.x_px == 0 && r.region.y_px == 0 && r.region.width_px == 260 && r.region.height_px == HEIGHT);
    ck_assert(fabs(real_of_q16(r.pose.position_m_q16[0]) + 0.18) < 0.005);
    for (i = 0; i < r.list.edge_count; i++) {
        const drogue_edge *e = &t.workspace.edges[i];
        MUST(drogue_mask_in_ring(&ring, drogue_edge_x_px(e) + 60, drogue_edge_y_px(e) + 20), "point %u", (unsigned)i);
    }
    test_workspace_free(&t);
}
END_TEST

START_TEST(arguments)
{
    test_workspace t = usual_workspace();
    const drogue_camera camera = the_camera();
    drogue_camera bad_camera = camera;
    drogue_image bad_image = image;
    drogue_model bad_model = model;
    drogue_config config, bad_config;
    drogue_result r;
    drogue_config_default(&config);
    bad_image.data = NULL;
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &bad_image, &whole),
                     DROGUE_E_ARGUMENT);
    bad_image = image;
    bad_image.stride = WIDTH - 1;
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &bad_image, &whole),
                     DROGUE_E_ARGUMENT);
    bad_image = image;
    bad_image.width_px = 0;
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &bad_image, &whole),
                     DROGUE_E_ARGUMENT);
    bad_image = image;
    bad_image.height_px = 0;
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &bad_image, &whole),
                     DROGUE_E_ARGUMENT);
    bad_camera.fx_px_q16 = 0;
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&bad_camera, &model, &config}, &image, &whole),
                     DROGUE_E_ARGUMENT);
    bad_model.rim_radius_m_q16 = 0;
    ck_assert_int_eq(measure(&r, &t, &config, &bad_model, &whole), DROGUE_E_ARGUMENT);
    bad_model = model;
    bad_model.inner_radius_m_q16 = -1;
    ck_assert_int_eq(measure(&r, &t, &config, &bad_model, &whole), DROGUE_E_ARGUMENT);
    bad_config = config;
    bad_config.canny_low = bad_config.canny_high + 1;
    ck_assert_int_eq(measure(&r, &t, &bad_config, &model, &whole), DROGUE_E_ARGUMENT);
    ck_assert_int_eq(r.ambiguity_q16, 65536);
    ck_assert_uint_eq(r.arcs[3], DROGUE_NO_ARC);
    ck_assert_int_eq(r.pose.position_m_q16[2], 0);
    test_workspace_free(&t);
}
END_TEST

START_TEST(regions_that_miss)
{
    static const drogue_region bad[] = {{0, 0, 0, 10},
                                        {0, 0, 10, 0},
                                        {0, 0, -5, 10},
                                        {WIDTH, 0, 10, 10},
                                        {0, HEIGHT, 10, 10},
                                        {-10, 0, 10, 10},
                                        {0, -10, 10, 10},
                                        {INT32_MAX, 0, 10, 10},
                                        {INT32_MIN, INT32_MIN, 10, 10},
                                        {0, INT32_MAX, 10, 10},
                                        {0, INT32_MIN, 10, 10},
                                        {0, 0, INT32_MAX, 10},
                                        {0, 0, 10, INT32_MAX},
                                        {0, 0, DROGUE_MAX_REGION + 1, 10},
                                        {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX}};
    test_workspace t = usual_workspace();
    drogue_config config;
    drogue_result r;
    size_t i;
    drogue_config_default(&config);
    for (i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        MUST(measure(&r, &t, &config, &model, &bad[i]) == DROGUE_E_REGION, "region %d: %s", (int)i,
             drogue_status_name(r.status));
    }
    test_workspace_free(&t);
}
END_TEST

/* Coordinates are Q16: what lies beyond 32767 px of an image is no region, and what lies before is one. */
START_TEST(images_beyond_the_coordinates)
{
    enum { LONG = 32900, SHORT = 60 };
    static uint8_t flat[LONG * SHORT];
    static const drogue_image wide = {flat, LONG, SHORT, LONG}, high = {flat, SHORT, LONG, SHORT};
    test_workspace t = usual_workspace();
    const drogue_camera camera = the_camera();
    drogue_config config;
    drogue_result r;
    int32_t end;
    drogue_config_default(&config);
    for (end = INT16_MAX - 1; end <= INT16_MAX + 1; end++) {
        const drogue_region right = {end - 50, 0, 50, 50}, low = {0, end - 50, 50, 50};
        const drogue_status want = end > INT16_MAX ? DROGUE_E_REGION : DROGUE_E_NO_EDGES;
        ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &wide, &right),
                         want);
        ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &high, &low),
                         want);
    }
    { /* nor are parts of them that are too long to be measured */
        const drogue_region across = {0, 0, DROGUE_MAX_SIDE + 1, 50}, down = {0, 0, 50, DROGUE_MAX_SIDE + 1};
        ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &wide, &across),
                         DROGUE_E_REGION);
        ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &config}, &high, &down),
                         DROGUE_E_REGION);
    }
    test_workspace_free(&t);
}
END_TEST

/* Grows a table from nothing until the frame passes: before that its status is the table's own. */
static void check_table(int which, drogue_status full)
{
    drogue_config config;
    drogue_result r;
    int seen_full = 0;
    uint32_t size;
    drogue_config_default(&config);
    for (size = which == 1 ? 2 : 1; size < 20000; size += 1 + size / 6) {
        test_workspace t =
            test_workspace_of(WIDTH, which == 0 ? size : 8192, which == 1 ? size : 4096, which == 2 ? size : 512);
        drogue_status status = measure(&r, &t, &config, &model, &whole);
        test_workspace_free(&t);
        if (status == DROGUE_OK) {
            break;
        }
        MUST(status == full, "table %d of %u: %s", which, (unsigned)size, drogue_status_name(status));
        seen_full = 1;
    }
    MUST(seen_full && size < 20000, "table %d never filled", which);
}

START_TEST(full_tables)
{
    test_workspace narrow = test_workspace_of(WIDTH - 1, 8192, 4096, 512);
    drogue_config config;
    drogue_result r;
    draw(&usual);
    check_table(0, DROGUE_E_EDGES_FULL);
    check_table(1, DROGUE_E_LABELS_FULL);
    check_table(2, DROGUE_E_ARCS_FULL);
    drogue_config_default(&config);
    ck_assert_int_eq(measure(&r, &narrow, &config, &model, &whole), DROGUE_E_WORKSPACE);
    test_workspace_free(&narrow);
}
END_TEST

/* Where noise or bars behind the drogue fill a table, higher thresholds are tried, raised twice if need be. */
START_TEST(what_fills_a_table_is_thresholded)
{
    static const struct {
        double noise, bars;
        uint32_t edges;
        int found;
        drogue_tried tried;
        int narrower; /* found in three quarters of the region, too, which have less bars */
    } cases[] = {{0, 0, 1500, 1, DROGUE_TRIED_FOUND, 0},  {12, 0, 1500, 1, DROGUE_TRIED_NOISE, 0},
                 {20, 0, 1500, 1, DROGUE_TRIED_NOISE, 0}, {20, 0, 900, 1, DROGUE_TRIED_NOISE, 0},
                 {20, 0, 300, 0, DROGUE_TRIED_FOUND, 0},  {0, 36, 8192, 1, DROGUE_TRIED_FOUND, 0},
                 {0, 36, 1400, 1, DROGUE_TRIED_NOISE, 1}, {0, 36, 300, 0, DROGUE_TRIED_FOUND, 0}};
    drogue_config config;
    size_t i;
    int x, y;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        test_workspace t = test_workspace_of(WIDTH, cases[i].edges, 4096, 512);
        drogue_result r;
        uint64_t rng = 21;
        draw(&usual);
        for (y = 0; y < HEIGHT; y++) {
            for (x = 0; x < WIDTH; x++) {
                uint8_t *p = &pixels[y * WIDTH + x];
                const double bars = y < 60 && *p == 200 && x / 8 % 2 != 0 ? cases[i].bars : 0;
                *p = (uint8_t)fmin(fmax(*p + bars + cases[i].noise * rng_normal(&rng), 0), 255);
            }
        }
        drogue_config_default(&config);
        MUST(measure(&r, &t, &config, &model, &whole) == (cases[i].found ? DROGUE_OK : DROGUE_E_EDGES_FULL) &&
                 r.tried == cases[i].tried,
             "case %zu: %s, tried %d", i, drogue_status_name(r.status), (int)r.tried);
        MUST((r.second_look == DROGUE_SECOND_FULL) == !cases[i].found &&
                 (r.second_look == DROGUE_SECOND_ROOM) == (cases[i].tried == DROGUE_TRIED_NOISE),
             "case %zu: %s", i, drogue_second_look_name(r.second_look));
        MUST(!cases[i].found || axis_error(&r.pose, &usual) < 0.05, "case %zu: axis %g off", i,
             axis_error(&r.pose, &usual));
        config.canny_least = config.canny_high; /* no second try */
        MUST(measure(&r, &t, &config, &model, &whole) ==
                 ((cases[i].found && cases[i].tried == DROGUE_TRIED_FOUND) || cases[i].narrower ? DROGUE_OK
                                                                                                : DROGUE_E_EDGES_FULL),
             "case %zu: %s", i, drogue_status_name(r.status));
        test_workspace_free(&t);
    }
}
END_TEST

/* A table that thresholds of the noise fill is told of, though higher ones do not, and find nothing; and of thresholds as
 * large as numbers go there are none to raise. */
START_TEST(what_own_thresholds_fill_is_told)
{
    const uint32_t edges[] = {40, 1u << 16};
    drogue_config config;
    size_t i;
    int k;
    for (k = 0; k < WIDTH * HEIGHT; k++) {
        pixels[k] = (uint8_t)(k < 100 * WIDTH && k % WIDTH / 4 % 2 != 0 ? 101 : 100);
    }
    for (i = 0; i < 2; i++) {
        test_workspace t = test_workspace_of(WIDTH, edges[i], 1u << 14, 1u << 12);
        drogue_result r;
        drogue_config_default(&config);
        ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_E_NO_EDGES);
        MUST((r.second_look == DROGUE_SECOND_FULL) == (i == 0), "%u edges: %s", (unsigned)edges[i],
             drogue_second_look_name(r.second_look));
        config.canny_high = INT32_MAX;
        config.canny_least = 1500000000;
        ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_E_NO_EDGES);
        test_workspace_free(&t);
    }
}
END_TEST

START_TEST(nothing_to_measure)
{
    test_workspace t = usual_workspace();
    drogue_config config;
    drogue_result r;
    int32_t i;
    drogue_config_default(&config);
    memset(pixels, 128, sizeof pixels);
    ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_E_NO_EDGES);
    for (i = 0; i < WIDTH * HEIGHT; i++) { /* one straight edge */
        pixels[i] = i % WIDTH < 40 ? 20 : 220;
    }
    ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_E_NO_ARCS);
    draw(&usual);
    config.min_axis_ratio_q16 = 65536;
    ck_assert_int_eq(measure(&r, &t, &config, &model, &whole), DROGUE_E_NO_ELLIPSE);
    test_workspace_free(&t);
}
END_TEST

/* Without an outline region and list are those looked at last: of a region beside the one asked for. */
START_TEST(edges_are_the_regions)
{
    static const drogue_region region = {50, 30, 220, 220};
    static const drogue_model small = {22938, 7864, 16384}; /* inner radius 0.12 m */
    test_workspace t = usual_workspace();
    drogue_config config;
    drogue_result r;
    int32_t x, y;
    uint32_t k;
    drogue_config_default(&config);
    for (y = 0; y < HEIGHT; y++) { /* a disc alone leads to another region, in which there is no outline either */
        for (x = 0; x < WIDTH; x++) {
            pixels[y * WIDTH + x] = (uint8_t)(10 + 190 * fmin(1, fmax(0, hypot(x - 160.3, y - 140.2) - 37)));
        }
    }
    for (y = 0; y < 8; y++) {
        pixels[(140 + y) * WIDTH + 252] = 100;
    }
    ck_assert_int_eq(measure(&r, &t, &config, &small, &region), DROGUE_E_NO_ARCS);
    ck_assert(r.region.x_px == 23 && r.region.y_px == 3 && r.region.width_px == 274 && r.region.height_px == 274);
    ck_assert_uint_gt(r.list.edge_count, 0);
    for (k = 0; k < r.list.edge_count; k++) { /* of the bar beside the disc */
        ck_assert_int_lt(abs(t.workspace.edges[k].x_q5 - (252 - 23) * 32), 3 * 32);
        ck_assert_int_lt(abs(t.workspace.edges[k].y_q5 - (144 - 3) * 32), 7 * 32);
    }
    test_workspace_free(&t);
}
END_TEST

/* What was tried in all of a region for a disc that its outline does not have leaves the edges of the ring. */
START_TEST(edges_are_the_rings)
{
    static const drogue_region region = {15, 0, 290, 280};
    test_workspace t = usual_workspace();
    drogue_config config;
    drogue_result r;
    double shift;
    uint32_t k;
    int of_region = 0;
    drogue_config_default(&config);
    for (shift = 0.04; shift < 0.14; shift += 0.01) {
        scene s = usual;
        s.canopy = 192; /* of too little contrast for the configured thresholds */
        s.inner_shift[0] = shift;
        draw(&s);
        (void)measure(&r, &t, &config, &model, &region);
        ck_assert_uint_gt(r.list.edge_count, 0);
        if (memcmp(&r.region, &region, sizeof region) != 0) {
            continue;
        }
        of_region++;
        for (k = 0; k < r.list.edge_count; k++) {
            const double dx = t.workspace.edges[k].x_q5 / 32.0 - 144.5;
            const double dy = t.workspace.edges[k].y_q5 / 32.0 - 139.5;
            MUST(hypot(dx, dy) > 290 / 3.0 - 2, "%g m: a point at %g, %g, tried %d, %s", shift, dx, dy, (int)r.tried,
                 drogue_status_name(r.status));
        }
    }
    ck_assert_int_gt(of_region, 0);
    test_workspace_free(&t);
}
END_TEST

START_TEST(geometry_out_of_range)
{
    test_workspace t = usual_workspace();
    drogue_model m = model;
    drogue_config config;
    drogue_result r;
    int k;
    draw(&usual);
    drogue_config_default(&config);
    m.rim_radius_m_q16 = INT32_MAX;
    ck_assert_int_eq(measure(&r, &t, &config, &m, &whole), DROGUE_E_DOMAIN);
    m = model;
    m.inner_depth_m_q16 = -1;
    ck_assert_int_eq(measure(&r, &t, &config, &m, &whole), DROGUE_E_ARGUMENT);
    m.inner_depth_m_q16 = 0;
    m.inner_radius_m_q16 = m.rim_radius_m_q16 + 1;
    ck_assert_int_eq(measure(&r, &t, &config, &m, &whole), DROGUE_E_ARGUMENT);
    m.inner_radius_m_q16 = m.rim_radius_m_q16;
    ck_assert_int_ne(measure(&r, &t, &config, &m, &whole), DROGUE_E_ARGUMENT);
    for (k = 0; k < 5; k++) {
        drogue_camera camera = the_camera();
        drogue_q16 *const lens[5] = {&camera.k1_q16, &camera.k2_q16, &camera.p1_q16, &camera.p2_q16, &camera.k3_q16};
        *lens[k] = DROGUE_MAX_DISTORTION_Q16;
        ck_assert_int_eq(drogue_camera_valid(&camera), 1);
        ++*lens[k];
        ck_assert_int_eq(drogue_camera_valid(&camera), 0);
        *lens[k] = -DROGUE_MAX_DISTORTION_Q16;
        ck_assert_int_eq(drogue_camera_valid(&camera), 1);
        --*lens[k];
        ck_assert_int_eq(drogue_camera_valid(&camera), 0);
    }
    config.canny_low = config.canny_high = config.canny_least = 0; /* every change of grey is an edge */
    ck_assert_int_ne(measure(&r, &t, &config, &model, &whole), DROGUE_E_ARGUMENT);
    test_workspace_free(&t);
}
END_TEST

/* How far the poses' explanations must differ is configured. With the inner part in the end plane only perspective tells
 * the two poses apart, by a pixel or two: an inner centroid that is less sure than that decides nothing. */
START_TEST(inner_part_that_cannot_decide)
{
    test_workspace t = usual_workspace();
    const drogue_model flat = {22938, 13107, 0};
    scene s = usual;
    drogue_config c;
    drogue_result r, resolved;
    drogue_config_default(&c);
    draw(&usual);
    ck_assert_int_eq(measure(&resolved, &t, &c, &model, &whole), DROGUE_OK);
    ck_assert_int_eq(resolved.orientation_resolved, 1);
    c.min_chi2_gap_q16 = INT32_MAX;
    c.inner_std_px_q16 = 16 * 65536; /* so unsure that neither pose is much worse */
    ck_assert_int_eq(measure(&r, &t, &c, &model, &whole), DROGUE_OK);
    ck_assert_int_eq(r.orientation_resolved, 0);
    ck_assert_int_eq(r.has_inner, 1);
    ck_assert(r.axis_std_rad_q32 > resolved.axis_std_rad_q32);
    drogue_config_default(&c);
    c.inner_gate_q16 = 65536;
    s.depth = 0;
    draw(&s);
    ck_assert_int_eq(measure(&r, &t, &c, &flat, &whole), DROGUE_OK);
    ck_assert_int_eq(r.has_inner, 1);
    ck_assert(!r.orientation_resolved || axis_error(&r.pose, &s) < 0.02);
    c.inner_std_px_q16 = 4 * 65536;
    ck_assert_int_eq(measure(&r, &t, &c, &flat, &whole), DROGUE_OK);
    ck_assert_int_eq(r.has_inner, 1);
    ck_assert_int_eq(r.orientation_resolved, 0);
    ck_assert(axis_error(&r.pose, &s) < 0.05 || axis_error(&r.alternative, &s) < 0.05);
    test_workspace_free(&t);
}
END_TEST

/* Largest difference of two poses, LSB. */
static int pose_apart(const drogue_pose *p, const drogue_pose *q)
{
    int k, worst = 0;
    for (k = 0; k < 3; k++) {
        int d = abs(p->position_m_q16[k] - q->position_m_q16[k]), e = abs(p->axis_q16[k] - q->axis_q16[k]);
        worst = d > worst ? d : worst;
        worst = e > worst ? e : worst;
    }
    return worst;
}

/* An inner part elsewhere than the model has it contradicts the outline: the outline alone is believed, and nothing is
 * claimed about the orientation. */
START_TEST(inner_part_that_contradicts)
{
    test_workspace t = usual_workspace();
    scene s = usual;
    drogue_model no_inner = model;
    drogue_config c;
    drogue_result r, alone;
    int turn, k;
    drogue_config_default(&c);
    no_inner.inner_radius_m_q16 = 0;
    for (turn = 0; turn < 3; turn++) {
        s = usual;
        s.yaw = 0.3;
        s.inner_shift[turn == 0] = 0.07; /* m across, sideways and up or down */
        if (turn == 2) {
            s.depth = -0.2; /* seen in the place of the other pose's, or nearly */
            s.inner_shift[0] = 0;
            s.inner_shift[1] = 0.08;
        }
        draw(&s);
        ck_assert_int_eq(measure(&r, &t, &c, &model, &whole), DROGUE_OK);
        MUST(!r.has_inner && r.inner.area_px == 0, "turn %d: an inner part out of place is believed", turn);
        MUST(!r.orientation_resolved, "turn %d: resolved", turn);
        ck_assert_int_eq(measure(&alone, &t, &c, &no_inner, &whole), DROGUE_OK);
        k = pose_apart(&r.pose, &alone.pose) > 2; /* their order carries no meaning */
        MUST(pose_apart(&r.pose, k ? &alone.alternative : &alone.pose) <= 2 &&
                 pose_apart(&r.alternative, k ? &alone.pose : &alone.alternative) <= 2,
             "turn %d: not the outline's poses", turn);
        MUST(k || (r.axis_std_rad_q32 > alone.axis_std_rad_q32 &&
                   r.position_std_m_q32[2] > 2 * alone.position_std_m_q32[2]),
             "turn %d: no doubt in the outline", turn);
    }
    test_workspace_free(&t);
}
END_TEST

/* Is the matrix positive definite? Gauss without exchange. */
static int positive(const int64_t covariance_q48[5][5])
{
    double m[5][5], least = 1;
    int i, j, k;
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            m[i][j] = (double)covariance_q48[i][j];
        }
    }
    for (k = 0; k < 5; k++) {
        least = fmin(least, m[k][k]);
        for (i = k + 1; i < 5; i++) {
            for (j = 4; j >= k; j--) {
                m[i][j] -= m[i][k] / m[k][k] * m[k][j];
            }
        }
    }
    return least > 0;
}

/* Covariance: symmetric, positive, its roots as stated, the error within it; without the inner part the axis is less
 * sure. */
START_TEST(covariance_of_the_result)
{
    uint64_t rng = 7;
    test_workspace t = usual_workspace();
    drogue_model no_inner = model;
    drogue_config c;
    drogue_result r, alone;
    int i, j, k;
    no_inner.inner_radius_m_q16 = 0;
    drogue_config_default(&c);
    for (i = 0; i < 12; i++) {
        scene s = usual;
        double variance;
        s.yaw = rng_real(&rng, -0.35, 0.35);
        s.pitch = rng_real(&rng, -0.35, 0.35);
        draw(&s);
        MUST(measure(&r, &t, &c, &model, &whole) == DROGUE_OK &&
                 measure(&alone, &t, &c, &no_inner, &whole) == DROGUE_OK,
             "case %d: %s", i, drogue_status_name(r.status));
        for (k = 0; k < 2; k++) {
            const drogue_result *q = k ? &alone : &r;
            for (j = 0; j < 25; j++) {
                MUST(q->covariance_q48[j / 5][j % 5] == q->covariance_q48[j % 5][j / 5], "case %d: not symmetric", i);
            }
            MUST(positive(q->covariance_q48), "case %d: not positive", i);
            for (j = 0; j < 3; j++) {
                double root = sqrt((double)q->covariance_q48[j][j]) * 256; /* Q48 to Q32 */
                MUST(fabs((double)q->position_std_m_q32[j] - root) <= 1e-4 * root + 300,
                     "case %d: std %d is %g, not %g", i, j, (double)q->position_std_m_q32[j], root);
            }
            variance = (double)q->covariance_q48[3][3] * pow(cos(real_of_q16(q->pose.pitch_rad_q16)), 2) +
                       (double)q->covariance_q48[4][4];
            MUST(fabs((double)q->axis_std_rad_q32 - 256 * sqrt(variance)) <= 2e-4 * 256 * sqrt(variance) + 300,
                 "case %d: std of the axis", i);
        }
        for (j = 0; j < 3; j++) {
            double off = real_of_q16(r.pose.position_m_q16[j]) - s.position[j];
            MUST(fabs(off) < 6 * (double)r.position_std_m_q32[j] / 4294967296.0, "case %d: %d off by %g of %g", i, j,
                 off, (double)r.position_std_m_q32[j] / 4294967296.0);
        }
        MUST(axis_error(&r.pose, &s) < 6 * (double)r.axis_std_rad_q32 / 4294967296.0, "case %d: axis off by %g of %g",
             i, axis_error(&r.pose, &s), (double)r.axis_std_rad_q32 / 4294967296.0);
        MUST(alone.axis_std_rad_q32 > r.axis_std_rad_q32, "case %d: surer without the inner part", i);
    }
    memset(pixels, 128, sizeof pixels);
    ck_assert_int_ne(measure(&r, &t, &c, &model, &whole), DROGUE_OK);
    for (j = 0; j < 25; j++) {
        ck_assert(r.covariance_q48[j / 5][j % 5] == 0 && r.position_std_m_q32[j % 3] == 0 && r.axis_std_rad_q32 == 0);
    }
    test_workspace_free(&t);
}
END_TEST

/* An off-centre region cuts the outline; it is looked for again in a region about it, and is the same ellipse. */
START_TEST(off_centre_region)
{
    static const drogue_region centred = {13, -7, 300, 280};
    static const int32_t shift[][2] = {{30, 0}, {-30, 0}, {0, 30}, {0, -30}, {22, -22}, {-25, 18}, {38, 5}, {-10, -36}};
    test_workspace t = usual_workspace();
    drogue_config c;
    drogue_result base, r, once;
    size_t i;
    int again = 0;
    drogue_config_default(&c);
    draw(&usual);
    ck_assert_int_eq(measure(&base, &t, &c, &model, &centred), DROGUE_OK);
    for (i = 0; i < sizeof shift / sizeof shift[0]; i++) {
        drogue_region asked = centred;
        double off;
        asked.x_px += shift[i][0];
        asked.y_px += shift[i][1];
        MUST(measure(&r, &t, &c, &model, &asked) == DROGUE_OK, "shift %d: %s", (int)i, drogue_status_name(r.status));
        off = fmax(hypot(real_of_q16(r.ellipse.xc_px_q16 - base.ellipse.xc_px_q16),
                         real_of_q16(r.ellipse.yc_px_q16 - base.ellipse.yc_px_q16)),
                   fmax(fabs(real_of_q16(r.ellipse.a_px_q16 - base.ellipse.a_px_q16)),
                        fabs(real_of_q16(r.ellipse.b_px_q16 - base.ellipse.b_px_q16))));
        MUST(off < 0.02, "shift %d: %g px off", (int)i, off);
        MUST(r.cover_q16 > q16_of(0.95), "shift %d: cover %g", (int)i, real_of_q16(r.cover_q16));
        c.recentre_cover_q16 = 0; /* never looked for again */
        (void)measure(&once, &t, &c, &model, &asked);
        again += once.cover_q16 < r.cover_q16;
        drogue_config_default(&c);
    }
    ck_assert_int_ge(again, 4); /* regions that had cut it */
    test_workspace_free(&t);
}
END_TEST

/* What the first look found stays when the second look cannot be had. */
START_TEST(second_look_that_fails)
{
    static const drogue_region asked = {43, -7, 300, 280};
    drogue_config c;
    drogue_result first, r;
    uint32_t edges;
    int kept = 0;
    drogue_config_default(&c);
    draw(&usual);
    for (edges = 300; edges < 2000; edges += 20) {
        test_workspace t = test_workspace_of(WIDTH, edges, 4096, 512);
        c.recentre_cover_q16 = 0;
        (void)measure(&first, &t, &c, &model, &asked);
        drogue_config_default(&c);
        (void)measure(&r, &t, &c, &model, &asked);
        test_workspace_free(&t);
        MUST(first.status != DROGUE_OK || r.status == DROGUE_OK, "%u edge points: found at the first look, then %s",
             (unsigned)edges, drogue_status_name(r.status));
        kept += first.status == DROGUE_OK;
    }
    ck_assert_int_gt(kept, 5);
}
END_TEST

/* A dark disc off the middle of its region, the outline of which the ring mask cuts. */
static drogue_result off_middle(uint32_t width_px, uint32_t edges, const drogue_region *region)
{
    enum { SIDE = 128 };
    static uint8_t disc[SIDE * SIDE];
    static const drogue_model bare = {22938, 0, 0};
    const drogue_image view = {disc, SIDE, SIDE, SIDE};
    const drogue_camera camera = pinhole(400, 400, 64, 64);
    test_workspace t = test_workspace_of(width_px, edges, 4096, 512);
    drogue_config config;
    drogue_result r;
    int32_t x, y, k;
    for (y = 0; y < SIDE; y++) {
        for (x = 0; x < SIDE; x++) {
            int32_t inside = 0;
            for (k = 0; k < FINE * FINE; k++) {
                inside += hypot(x + (k % FINE + 0.5) / FINE - 76.5, y + (k / FINE + 0.5) / FINE - 60.5) < 40;
            }
            disc[y * SIDE + x] = (uint8_t)(200 - 140 * inside / (FINE * FINE));
        }
    }
    drogue_config_default(&config);
    (void)drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &bare, &config}, &view, region);
    test_workspace_free(&t);
    return r;
}

/* More room in a table gives the same result, or the smaller one's says that a table or the width was in the way. */
START_TEST(second_look_is_told)
{
    static const drogue_region all = {0, 0, 128, 128}, narrow = {25, 15, 84, 84}, about = {26, 10, 101, 101};
    const drogue_result most = off_middle(512, 4096, &all);
    int seen[DROGUE_SECOND_COUNT] = {0};
    uint32_t edges;
    ck_assert_int_eq(most.status, DROGUE_OK);
    ck_assert_int_eq(most.second_look, DROGUE_SECOND_BETTER);
    ck_assert_int_gt(most.cover_q16, DROGUE_Q16(99, 100));
    for (edges = 20; edges < 1200; edges += 20) {
        const drogue_result r = off_middle(512, edges, &all);
        const int same = r.cover_q16 == most.cover_q16 && memcmp(&r.ellipse, &most.ellipse, sizeof r.ellipse) == 0;
        MUST(same || r.second_look == DROGUE_SECOND_FULL || r.status == DROGUE_E_EDGES_FULL, "%u edge points: %s, %s",
             (unsigned)edges, drogue_status_name(r.status), drogue_second_look_name(r.second_look));
        seen[r.second_look] += r.status == DROGUE_OK;
    }
    ck_assert_int_gt(seen[DROGUE_SECOND_FULL], 3);
    ck_assert_int_gt(seen[DROGUE_SECOND_BETTER], 10);
    ck_assert_int_eq(off_middle(84, 4096, &narrow).second_look, DROGUE_SECOND_TOO_WIDE);
    ck_assert_int_eq(off_middle(512, 4096, &narrow).second_look, DROGUE_SECOND_BETTER);
    ck_assert_int_eq(off_middle(512, 4096, &about).second_look, DROGUE_SECOND_NONE);
}
END_TEST

/* Wider and narrower than the ring mask is made for; too narrow a workspace for a wider one says so. */
START_TEST(regions_of_other_sizes)
{
    const double a = 0.35 / 8.8 * 1465.5;
    scene far = usual;
    int tenths, cut = 0;
    far.position[2] = 8.8;
    draw(&far);
    for (tenths = 8; tenths <= 35; tenths++) {
        const int32_t side = (int32_t)(tenths * a / 10);
        const drogue_region asked = {161 - side / 2, 137 - side / 2, side, side};
        test_workspace roomy = usual_workspace(), narrow = test_workspace_of((uint32_t)side, 8192, 4096, 512);
        drogue_config config;
        drogue_result r;
        drogue_config_default(&config);
        MUST((measure(&r, &roomy, &config, &model, &asked) == DROGUE_OK && axis_error(&r.pose, &far) < 0.05) ||
                 tenths < 17,
             "%d tenths of a semi-axis: %s", tenths, drogue_status_name(r.status));
        if (measure(&r, &narrow, &config, &model, &asked) != DROGUE_OK) {
            MUST(r.second_look == DROGUE_SECOND_TOO_WIDE, "%d: %s", tenths, drogue_second_look_name(r.second_look));
            cut++;
        }
        test_workspace_free(&roomy);
        test_workspace_free(&narrow);
    }
    ck_assert_int_gt(cut, 0);
}
END_TEST

/* The background passes through the canopy's own grey: dark against it on one side, bright on the other. */
START_TEST(background_across_the_canopys_grey)
{
    test_workspace t = usual_workspace();
    drogue_config c;
    drogue_result base, r;
    int turn;
    drogue_config_default(&c);
    draw(&usual);
    ck_assert_int_eq(measure(&base, &t, &c, &model, &whole), DROGUE_OK);
    for (turn = 0; turn < 4; turn++) {
        scene s = usual;
        s.outside = 110;
        s.slope[0] = (turn & 1) ? 0.9 : -0.9;
        s.slope[1] = (turn & 2) ? 0.5 : -0.2;
        draw(&s);
        MUST(measure(&r, &t, &c, &model, &whole) == DROGUE_OK, "turn %d: %s", turn, drogue_status_name(r.status));
        MUST(r.polarity == DROGUE_POLARITY_BOTH, "turn %d: polarity %d", turn, (int)r.polarity);
        MUST(abs(r.ellipse.xc_px_q16 - base.ellipse.xc_px_q16) < q16_of(0.1) &&
                 abs(r.ellipse.yc_px_q16 - base.ellipse.yc_px_q16) < q16_of(0.1) &&
                 abs(r.ellipse.a_px_q16 - base.ellipse.a_px_q16) < q16_of(0.15) &&
                 abs(r.ellipse.b_px_q16 - base.ellipse.b_px_q16) < q16_of(0.15),
             "turn %d: centre %g %g, semi-axes %g %g px off", turn,
             real_of_q16(r.ellipse.xc_px_q16 - base.ellipse.xc_px_q16),
             real_of_q16(r.ellipse.yc_px_q16 - base.ellipse.yc_px_q16),
             real_of_q16(r.ellipse.a_px_q16 - base.ellipse.a_px_q16),
             real_of_q16(r.ellipse.b_px_q16 - base.ellipse.b_px_q16));
        MUST(r.orientation_resolved && axis_error(&r.pose, &s) < 0.02, "turn %d: axis off by %g", turn,
             axis_error(&r.pose, &s));
    }
    test_workspace_free(&t);
}
END_TEST

/* A lens that folds the image inside the outline: what cannot be undone is not measured. */
START_TEST(outline_across_a_fold)
{
    static const drogue_model blind = {22938, 0, 0}; /* by this lens the disc would be another's */
    test_workspace t = usual_workspace();
    drogue_camera camera = the_camera();
    drogue_config c;
    drogue_result r;
    drogue_config_default(&c);
    draw(&usual);
    camera.fx_px_q16 = camera.fy_px_q16 = q16_of(150);
    camera.k1_q16 = q16_of(-0.1);
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &blind, &c}, &image, &whole), DROGUE_OK);
    camera.k1_q16 = q16_of(-0.9);
    ck_assert_int_eq(drogue_measure(&r, &t.workspace, &(drogue_setup){&camera, &model, &c}, &image, &whole),
                     DROGUE_E_NO_ELLIPSE);
    ck_assert_int_eq(r.ideal.xc_px_q16, 0);
    ck_assert_int_eq(r.ideal.a_px_q16, 0);
    test_workspace_free(&t);
}
END_TEST

START_TEST(version_is_the_macros)
{
    char text[32];
    (void)snprintf(text, sizeof text, "%d.%d.%d", DROGUE_VERSION_MAJOR, DROGUE_VERSION_MINOR, DROGUE_VERSION_PATCH);
    ck_assert_str_eq(drogue_version(), text);
}
END_TEST

START_TEST(capacity_by_macro_is_capacity_by_function)
{
    const drogue_capacity capacity = DROGUE_CAPACITY_FOR(256);
    ck_assert_uint_eq(drogue_workspace_bytes(&capacity), DROGUE_WORKSPACE_BYTES_FOR(256));
    ck_assert_uint_eq(capacity.width_px, 256);
}
END_TEST

SUITE_MAIN("measure", drawn_drogues, a_disc_too_large_refuses_the_outline, variances_too_large_for_their_format,
           a_canopy_so_narrow_that_its_inner_edge_is_found, without_inner_part, regions_of_one_image,
           ring_of_a_clipped_region, arguments, regions_that_miss, a_ring_about_the_rim, noise_about_the_rim,
           images_beyond_the_coordinates, full_tables, what_fills_a_table_is_thresholded,
           what_own_thresholds_fill_is_told, nothing_to_measure, edges_are_the_regions, edges_are_the_rings,
           geometry_out_of_range, inner_part_that_cannot_decide, inner_part_that_contradicts, covariance_of_the_result,
           off_centre_region, second_look_that_fails, second_look_is_told, regions_of_other_sizes,
           background_across_the_canopys_grey, outline_across_a_fold, version_is_the_macros,
           capacity_by_macro_is_capacity_by_function)
