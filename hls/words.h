/* SPDX-License-Identifier: Apache-2.0 */
/* Tops of the back end and their registers: a frame's edge points and arcs -> drogue_hls_outline() -> where to look for
 * the inner part -> drogue_hls_pose(). Every register is 32 bits wide; 64-bit values take two, the low one first. Real
 * numbers are Q16 where their names in include/drogue say nothing else. */
#ifndef DROGUE_HLS_WORDS_H
#define DROGUE_HLS_WORDS_H

#include "drogue/inner.h"
#include "drogue/measure.h"
#include "drogue_hls.h"

/* What both tops are told. */
typedef struct drogue_hls_parameters {
    drogue_camera camera;
    drogue_model model;
    drogue_config config;
    drogue_mask mask; /* the ring's, in the region's coordinates */
    int32_t x_px;     /* the region's pixel (0, 0) in the image */
    int32_t y_px;
    int32_t larger; /* 1: the larger outline about the one found is wanted */
} drogue_hls_parameters;

/* The parameters' registers from address 0 up: name, type, member. Up to MIN_CHI2_GAP they belong to the camera, the
 * drogue and the method; those after it to the frame. */
/* clang-format off */
#define DROGUE_HLS_PARAMETER_LIST(R)                               \
    R(FX, drogue_q16, camera.fx_px_q16)                            \
    R(FY, drogue_q16, camera.fy_px_q16)                            \
    R(CX, drogue_q16, camera.cx_px_q16)                            \
    R(CY, drogue_q16, camera.cy_px_q16)                            \
    R(K1, drogue_q16, camera.k1_q16)                               \
    R(K2, drogue_q16, camera.k2_q16)                               \
    R(P1, drogue_q16, camera.p1_q16)                               \
    R(P2, drogue_q16, camera.p2_q16)                               \
    R(K3, drogue_q16, camera.k3_q16)                               \
    R(RIM_RADIUS, drogue_q16, model.rim_radius_m_q16)              \
    R(INNER_RADIUS, drogue_q16, model.inner_radius_m_q16)          \
    R(INNER_DEPTH, drogue_q16, model.inner_depth_m_q16)            \
    R(CANNY_LOW, int32_t, config.canny_low)                        \
    R(CANNY_HIGH, int32_t, config.canny_high)                      \
    R(CANNY_LEAST, int32_t, config.canny_least)                    \
    R(SMOOTH, int32_t, config.smooth)                              \
    R(TRANSFER, drogue_transfer, config.transfer)                  \
    R(MIN_ARC, uint32_t, config.min_arc_px)                        \
    R(MIN_ARC_SHARE, drogue_q16, config.min_arc_share_q16)         \
    R(MIN_SHORT, drogue_q16, config.min_short_px_q16)              \
    R(POLARITY, drogue_polarity, config.polarity)                  \
    R(FIT_ERROR, drogue_q16, config.quality.fit_error_px_q16)      \
    R(QUALITY_K1, drogue_q16, config.quality.k1_q16)               \
    R(QUALITY_K2, drogue_q16, config.quality.k2_q16)               \
    R(MIN_FIT_RATIO, drogue_q16, config.min_fit_ratio_q16)         \
    R(MIN_AXIS_RATIO, drogue_q16, config.min_axis_ratio_q16)       \
    R(MIN_SIZE, drogue_q16, config.min_size_q16)                   \
    R(MAX_SIZE, drogue_q16, config.max_size_q16)                   \
    R(CLUSTER_CENTRE, drogue_q16, config.cluster.centre_px_q16)    \
    R(CLUSTER_A, drogue_q16, config.cluster.a_px_q16)              \
    R(CLUSTER_B, drogue_q16, config.cluster.b_px_q16)              \
    R(CLUSTER_ANGLE, drogue_q16, config.cluster.angle_rad_q16)     \
    R(CLUSTER_ROUND, drogue_q16, config.cluster.round_q16)         \
    R(SEARCH_BAND, drogue_q16, config.search_band_q16)             \
    R(REFIT_BAND, drogue_q16, config.refit_band_px_q16)            \
    R(REFIT_COS, drogue_q16, config.refit_cos_q16)                 \
    R(REFIT_ROUNDS, uint32_t, config.refit_rounds)                 \
    R(MIN_COVER, drogue_q16, config.min_cover_q16)                 \
    R(RECENTRE_COVER, drogue_q16, config.recentre_cover_q16)       \
    R(OPTICS_BLUR, drogue_q16, config.optics_blur_px_q16)          \
    R(MIN_INNER_AREA, uint32_t, config.min_inner_area_px)           \
    R(MIN_INNER_CONTRAST, int32_t, config.min_inner_contrast)      \
    R(INNER_GATE_PX, drogue_q16, config.inner_gate_px_q16)         \
    R(INNER_GATE, drogue_q16, config.inner_gate_q16)               \
    R(INNER_COVER, drogue_q16, config.min_inner_cover_q16)         \
    R(INNER_RMS, drogue_q16, config.inner_rms_px_q16)              \
    R(INNER_SIZE_PX, drogue_q16, config.inner_size_px_q16)         \
    R(INNER_SIZE, drogue_q16, config.inner_size_q16)               \
    R(OUTLINE_SHADING, drogue_q16, config.outline_shading_q16)     \
    R(OPTICS_BLUR_STD, drogue_q16, config.optics_blur_std_px2_q16) \
    R(INNER_STD, drogue_q16, config.inner_std_px_q16)              \
    R(INNER_STD_SHARE, drogue_q16, config.inner_std_share_q16)     \
    R(MAX_CHI2, drogue_q16, config.max_chi2_q16)                   \
    R(MIN_CHI2_GAP, drogue_q16, config.min_chi2_gap_q16)           \
    R(MASK_CENTRE2_X, int32_t, mask.centre2_x)                     \
    R(MASK_CENTRE2_Y, int32_t, mask.centre2_y)                     \
    R(MASK_LONGEST, int32_t, mask.longest_px)                      \
    R(REGION_X, int32_t, x_px)                                     \
    R(REGION_Y, int32_t, y_px)                                     \
    R(LARGER, int32_t, larger)
/* clang-format on */

#define DROGUE_HLS_INDEX(name, type, member) DROGUE_HLS_P_##name,
enum drogue_hls_parameter { DROGUE_HLS_PARAMETER_LIST(DROGUE_HLS_INDEX) DROGUE_HLS_PARAMETERS };
#undef DROGUE_HLS_INDEX

static inline void drogue_hls_pack_parameters(int32_t words[DROGUE_HLS_PARAMETERS], const drogue_hls_parameters *p)
{
#define DROGUE_HLS_PACK(name, type, member) words[DROGUE_HLS_P_##name] = (int32_t)p->member;
    DROGUE_HLS_PARAMETER_LIST(DROGUE_HLS_PACK)
#undef DROGUE_HLS_PACK
}

static inline void drogue_hls_unpack_parameters(drogue_hls_parameters *p, const int32_t words[DROGUE_HLS_PARAMETERS])
{
#define DROGUE_HLS_UNPACK(name, type, member) p->member = (type)words[DROGUE_HLS_P_##name];
    DROGUE_HLS_PARAMETER_LIST(DROGUE_HLS_UNPACK)
#undef DROGUE_HLS_UNPACK
}

/* What drogue_hls_outline() leaves: for the second step, for the inner part's top (EXPECTED), for whoever draws. */
enum drogue_hls_outline_word {
    DROGUE_HLS_O_STATUS,  /* status register; other than 0 in its low byte: the step ended there */
    DROGUE_HLS_O_FOUND,   /* drogue_status of drogue_outline_find() alone */
    DROGUE_HLS_O_ELLIPSE, /* as seen, coordinates of the region: xc yc a b angle */
    DROGUE_HLS_O_FITTED = DROGUE_HLS_O_ELLIPSE + 5,   /* the same with what moved it not put back */
    DROGUE_HLS_O_IDEAL = DROGUE_HLS_O_FITTED + 5,     /* without distortion, coordinates of the image */
    DROGUE_HLS_O_QUALITY = DROGUE_HLS_O_IDEAL + 5,    /* drogue_quality: five words */
    DROGUE_HLS_O_POLARITY = DROGUE_HLS_O_QUALITY + 5, /* drogue_polarity */
    DROGUE_HLS_O_ARCS,                                /* by quadrant; -1: none */
    DROGUE_HLS_O_CLUSTER_MEMBERS = DROGUE_HLS_O_ARCS + 4,
    DROGUE_HLS_O_REFIT_POINTS,
    DROGUE_HLS_O_COVER,
    DROGUE_HLS_O_BAND,
    DROGUE_HLS_O_POSES, /* two: x y z, axis x y z, yaw, pitch */
    DROGUE_HLS_O_EXPECTED_COUNT = DROGUE_HLS_O_POSES + 2 * 8,
    DROGUE_HLS_O_EXPECTED,                                              /* two ellipses, coordinates of the region */
    DROGUE_HLS_O_BINS = DROGUE_HLS_O_EXPECTED + 2 * 5,                  /* 32 times: count dark, count bright, sum */
    DROGUE_HLS_O_SQUARES = DROGUE_HLS_O_BINS + 3 * DROGUE_SUPPORT_BINS, /* Q32, 64 bits */
    DROGUE_HLS_O_GRADIENT = DROGUE_HLS_O_SQUARES + 2,                   /* 64 bits */
    DROGUE_HLS_O_POINTS = DROGUE_HLS_O_GRADIENT + 2,
    DROGUE_HLS_O_BRIGHT_BINS,
    DROGUE_HLS_O_COVERED,
    DROGUE_HLS_O_PULL,                          /* five words, Q24 */
    DROGUE_HLS_O_SMEAR = DROGUE_HLS_O_PULL + 5, /* two words, px^2 Q16 */
    DROGUE_HLS_O_AXIS = DROGUE_HLS_O_SMEAR + 2, /* from which the bins count, rad Q16 */
    DROGUE_HLS_O_OUTSIDE,                       /* parts outside which another edge shows, four bits */
    DROGUE_HLS_OUTLINE_WORDS
};

/* What drogue_hls_edge() leaves. */
enum drogue_hls_edge_word {
    DROGUE_HLS_E_STATUS, /* drogue_status: DROGUE_OK, DROGUE_E_NO_INNER_PART; DROGUE_E_ARGUMENT: nothing was looked for */
    DROGUE_HLS_E_X,      /* coordinates of the region */
    DROGUE_HLS_E_Y,
    DROGUE_HLS_E_GROWN,
    DROGUE_HLS_E_STD,
    DROGUE_HLS_E_RMS,
    DROGUE_HLS_E_RAYS,
    DROGUE_HLS_E_WHICH, /* of the expected discs, 0 or 1 */
    DROGUE_HLS_E_LEVEL,
    DROGUE_HLS_E_CONTRAST,
    DROGUE_HLS_EDGE_WORDS
};

static inline void drogue_hls_pack_edge_words(int32_t words[DROGUE_HLS_EDGE_WORDS], const drogue_inner_edge *e)
{
    words[DROGUE_HLS_E_X] = e->x_px_q16;
    words[DROGUE_HLS_E_Y] = e->y_px_q16;
    words[DROGUE_HLS_E_GROWN] = e->grown_px_q16;
    words[DROGUE_HLS_E_STD] = e->std_px_q16;
    words[DROGUE_HLS_E_RMS] = e->spread_px_q16;
    words[DROGUE_HLS_E_RAYS] = (int32_t)e->rays;
    words[DROGUE_HLS_E_WHICH] = (int32_t)e->which;
    words[DROGUE_HLS_E_LEVEL] = e->threshold;
    words[DROGUE_HLS_E_CONTRAST] = e->contrast;
}

static inline void drogue_hls_unpack_edge_words(drogue_inner_edge *e, const int32_t words[DROGUE_HLS_EDGE_WORDS])
{
    e->x_px_q16 = words[DROGUE_HLS_E_X];
    e->y_px_q16 = words[DROGUE_HLS_E_Y];
    e->grown_px_q16 = words[DROGUE_HLS_E_GROWN];
    e->std_px_q16 = words[DROGUE_HLS_E_STD];
    e->spread_px_q16 = words[DROGUE_HLS_E_RMS];
    e->rays = (uint32_t)words[DROGUE_HLS_E_RAYS];
    e->which = (uint32_t)words[DROGUE_HLS_E_WHICH] & 1u;
    e->threshold = (uint8_t)words[DROGUE_HLS_E_LEVEL];
    e->contrast = (uint8_t)words[DROGUE_HLS_E_CONTRAST];
}

/* What drogue_hls_pose() leaves. */
enum drogue_hls_result_word {
    DROGUE_HLS_R_STATUS, /* status register */
    DROGUE_HLS_R_HAS_INNER,
    DROGUE_HLS_R_INNER, /* coordinates of the image: x y area spread threshold contrast rays; 0 without HAS_INNER */
    DROGUE_HLS_R_POSE = DROGUE_HLS_R_INNER + 7, /* x y z, axis x y z, yaw, pitch */
    DROGUE_HLS_R_ALTERNATIVE = DROGUE_HLS_R_POSE + 8,
    DROGUE_HLS_R_RESOLVED = DROGUE_HLS_R_ALTERNATIVE + 8,
    DROGUE_HLS_R_AMBIGUITY,
    DROGUE_HLS_R_TOO_LARGE, /* 1: the inner disc is too large for the outline, which drogue_measure() refuses unless
                               another try finds better */
    DROGUE_HLS_R_DOUBT,     /* share of the distance that is in the covariance */
    DROGUE_HLS_R_HALVED,    /* so often are the covariance's entries halved */
    DROGUE_HLS_RESULT_WORDS
};

#define DROGUE_HLS_COVARIANCE_WORDS 15 /* Q48, of x y z yaw pitch, by rows of the lower triangle */
#define DROGUE_HLS_STD_WORDS 4         /* Q32, of x y z (m), axis (rad) */

static inline void drogue_hls_unpack_pose(drogue_pose *p, const int32_t words[8])
{
    int k;
    for (k = 0; k < 3; k++) {
        p->position_m_q16[k] = words[k];
        p->axis_q16[k] = words[3 + k];
    }
    p->yaw_rad_q16 = words[6];
    p->pitch_rad_q16 = words[7];
}

static inline void drogue_hls_pack_pose(int32_t words[8], const drogue_pose *p)
{
    int k;
    for (k = 0; k < 3; k++) {
        words[k] = p->position_m_q16[k];
        words[3 + k] = p->axis_q16[k];
    }
    words[6] = p->yaw_rad_q16;
    words[7] = p->pitch_rad_q16;
}

static inline uint64_t drogue_hls_unpack_u64(const int32_t words[2])
{
    return (uint64_t)(uint32_t)words[0] | (uint64_t)(uint32_t)words[1] << 32;
}

static inline void drogue_hls_pack_u64(int32_t words[2], uint64_t v)
{
    words[0] = (int32_t)(uint32_t)v;
    words[1] = (int32_t)(uint32_t)(v >> 32);
}

/* A view of a region's pixels in a memory of the block's own: the library reads them by a member, and no compiler follows a
 * port through one. Returns 0, and reads nothing, where the region does not fit. */
static inline int drogue_hls_take_pixels(drogue_image *view, uint8_t memory[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT],
                                         const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], int32_t width_px,
                                         int32_t height_px)
{
    const int fits = width_px >= 1 && width_px <= DROGUE_HLS_WIDTH && height_px >= 1 && height_px <= DROGUE_HLS_HEIGHT;
    const int32_t count = fits ? width_px * height_px : 0;
    int32_t i;
    for (i = 0; i < count; i++) {
#ifndef __BAMBU__
#pragma HLS pipeline II = 1
#pragma HLS loop_tripcount max = DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT
#endif
        memory[i] = pixels[i];
    }
    view->data = memory;
    view->width_px = width_px;
    view->height_px = height_px;
    view->stride = width_px;
    return fits;
}

/* From the lists to the outline, the two poses that it allows, and where the inner part should be.
 *
 *  edges, arcs      drogue_hls.h; an arc's points lie within the list
 *  pixels           the region's, width_px * height_px grey levels, row by row
 *  frontend_status  the front end's status register: other than 0 in its low byte is passed on, the lists are not read
 *  outline          all words are written in every case; 0 where there is nothing to say, ARCS -1
 *  STATUS           drogue_measure()'s; DROGUE_E_ARGUMENT for parameters, lists or sizes outside their range too
 */
void drogue_hls_outline(const uint64_t edges[DROGUE_HLS_EDGES], uint32_t edge_count,
                        const uint64_t arcs[DROGUE_HLS_ARCS], uint32_t arc_count, uint32_t frontend_status,
                        const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT], int32_t width_px, int32_t height_px,
                        const int32_t parameters[DROGUE_HLS_PARAMETERS], int32_t outline[DROGUE_HLS_OUTLINE_WORDS]);

/* From the outline and the region's pixels to the inner disc: drogue_inner_edge_find().
 *
 *  pixels  width_px * height_px grey levels, row by row
 *  edge    all words are written in every case
 */
void drogue_hls_edge(const uint8_t pixels[DROGUE_HLS_WIDTH * DROGUE_HLS_HEIGHT],
                     const int32_t parameters[DROGUE_HLS_PARAMETERS], const int32_t outline[DROGUE_HLS_OUTLINE_WORDS],
                     int32_t width_px, int32_t height_px, int32_t edge[DROGUE_HLS_EDGE_WORDS]);

/* From the outline and the inner part to the pose and its covariance.
 *
 *  edge    not looked at when INNER_RADIUS is 0
 *  result, covariance, std  all words are written in every case; 0 where there is nothing to say, AMBIGUITY 1
 *  STATUS  drogue_measure()'s
 */
void drogue_hls_pose(const int32_t parameters[DROGUE_HLS_PARAMETERS], const int32_t outline[DROGUE_HLS_OUTLINE_WORDS],
                     const int32_t edge[DROGUE_HLS_EDGE_WORDS], int32_t result[DROGUE_HLS_RESULT_WORDS],
                     int64_t covariance[DROGUE_HLS_COVARIANCE_WORDS], int64_t std[DROGUE_HLS_STD_WORDS]);

/* Stages alone, to prove and to measure them. */

/* drogue_eigen_sym3(): matrix a00 a01 a02 a11 a12 a22, Q60 -> mantissa and exponent of each value, then
 * three vectors Q30; returns the sweeps. */
int32_t drogue_hls_eigen(const int64_t matrix[6], int32_t eigen[15]);

/* drogue_ellipse_fit(): points x in the low and y in the high 16 bits, unit 2^-frac_bits px -> xc yc a b angle, 0 on
 * failure; returns the drogue_status, DROGUE_E_ARGUMENT for more points than the memory. */
int32_t drogue_hls_fit(const uint32_t points[DROGUE_HLS_EDGES], uint32_t count, int32_t frac_bits, int32_t ellipse[5]);

/* drogue_pose_from_ellipse(): ellipse, fx fy cx cy -> two poses, 0 on failure; returns the drogue_status. */
int32_t drogue_hls_cone(const int32_t ellipse[5], const int32_t camera[4], int32_t radius_m_q16, int32_t poses[16]);

#endif
