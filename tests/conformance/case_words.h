/* SPDX-License-Identifier: Apache-2.0 */
/* Words of a case as the library's structs: camera, model, region, and every threshold of the method in the order of
 * drogue_config. Of the stages' adapters and of the test benches for hardware, which are built without these. */
#ifndef DROGUE_TESTS_CASE_WORDS_H
#define DROGUE_TESTS_CASE_WORDS_H

#include "drogue/config.h"

#ifdef __cplusplus
extern "C" {
#endif

static inline drogue_camera conf_camera(const int32_t *words)
{
    drogue_camera c;
    c.fx_px_q16 = words[0];
    c.fy_px_q16 = words[1];
    c.cx_px_q16 = words[2];
    c.cy_px_q16 = words[3];
    c.k1_q16 = words[4];
    c.k2_q16 = words[5];
    c.p1_q16 = words[6];
    c.p2_q16 = words[7];
    c.k3_q16 = words[8];
    return c;
}

static inline drogue_model conf_model(const int32_t *words)
{
    drogue_model m;
    m.rim_radius_m_q16 = words[0];
    m.inner_radius_m_q16 = words[1];
    m.inner_depth_m_q16 = words[2];
    return m;
}

static inline drogue_region conf_region(const int32_t *words)
{
    drogue_region r;
    r.x_px = words[0];
    r.y_px = words[1];
    r.width_px = words[2];
    r.height_px = words[3];
    return r;
}

/* Type and member of each threshold. */
/* clang-format off */
#define CONF_CONFIG_LIST(W)                \
    W(int32_t, canny_low)                  \
    W(int32_t, canny_high)                 \
    W(int32_t, canny_least)                \
    W(int32_t, smooth)                     \
    W(drogue_transfer, transfer)           \
    W(uint32_t, min_arc_px)                \
    W(drogue_q16, min_arc_share_q16)       \
    W(drogue_q16, min_short_px_q16)        \
    W(drogue_polarity, polarity)           \
    W(drogue_q16, quality.fit_error_px_q16) \
    W(drogue_q16, quality.k1_q16)          \
    W(drogue_q16, quality.k2_q16)          \
    W(drogue_q16, min_fit_ratio_q16)       \
    W(drogue_q16, min_axis_ratio_q16)      \
    W(drogue_q16, min_size_q16)            \
    W(drogue_q16, max_size_q16)            \
    W(drogue_q16, cluster.centre_px_q16)   \
    W(drogue_q16, cluster.a_px_q16)        \
    W(drogue_q16, cluster.b_px_q16)        \
    W(drogue_q16, cluster.angle_rad_q16)   \
    W(drogue_q16, cluster.round_q16)       \
    W(drogue_q16, search_band_q16)         \
    W(drogue_q16, refit_band_px_q16)       \
    W(drogue_q16, refit_cos_q16)           \
    W(uint32_t, refit_rounds)              \
    W(drogue_q16, min_cover_q16)           \
    W(drogue_q16, recentre_cover_q16)      \
    W(drogue_q16, optics_blur_px_q16)      \
    W(uint32_t, min_inner_area_px)         \
    W(int32_t, min_inner_contrast)         \
    W(drogue_q16, inner_gate_px_q16)       \
    W(drogue_q16, inner_gate_q16)          \
    W(drogue_q16, min_inner_cover_q16)     \
    W(drogue_q16, inner_rms_px_q16)        \
    W(drogue_q16, inner_size_px_q16)       \
    W(drogue_q16, inner_size_q16)          \
    W(drogue_q16, outline_shading_q16)     \
    W(drogue_q16, optics_blur_std_px2_q16) \
    W(drogue_q16, inner_std_px_q16)        \
    W(drogue_q16, inner_std_share_q16)     \
    W(drogue_q16, max_chi2_q16)            \
    W(drogue_q16, min_chi2_gap_q16)
/* clang-format on */

#define CONF_CONFIG_ONE(type, member) +1
#define CONF_CONFIG_WORDS (0 CONF_CONFIG_LIST(CONF_CONFIG_ONE))

static inline void conf_config_put(int32_t words[CONF_CONFIG_WORDS], const drogue_config *config)
{
#define CONF_CONFIG_PUT(type, member) *words++ = (int32_t)config->member;
    CONF_CONFIG_LIST(CONF_CONFIG_PUT)
#undef CONF_CONFIG_PUT
}

static inline void conf_config_take(drogue_config *config, const int32_t words[CONF_CONFIG_WORDS])
{
#define CONF_CONFIG_TAKE(type, member) config->member = (type)*words++;
    CONF_CONFIG_LIST(CONF_CONFIG_TAKE)
#undef CONF_CONFIG_TAKE
}

#ifdef __cplusplus
}
#endif
#endif
