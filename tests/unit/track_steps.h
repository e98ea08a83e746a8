/* SPDX-License-Identifier: Apache-2.0 */
/* A track fed with results instead of images. */
#ifndef DROGUE_TESTS_TRACK_STEPS_H
#define DROGUE_TESTS_TRACK_STEPS_H

#include "drogue/track.h"
#include "results.h"
#include "suite.h"

static const drogue_model steps_model = {22938, 13107, 16384};

enum { DT_US = 40000 };

static inline drogue_track new_track(void)
{
    const drogue_camera camera = pinhole(1465.5, 1465.5, 1023.5, 1023.5);
    drogue_track_config config;
    drogue_track t;
    drogue_track_config_default(&config);
    (void)drogue_track_init(&t, &config, &camera, &steps_model, NULL);
    return t;
}

static inline drogue_track_state step(drogue_track *t, const drogue_result *r)
{
    drogue_region region;
    drogue_track_begin(&region, t, DT_US);
    return drogue_track_end(t, r);
}

static inline drogue_track steady_track(const drogue_result *hit)
{
    drogue_track t = new_track();
    int k;
    for (k = 0; k < 50; k++) {
        ck_assert_int_eq(step(&t, hit), DROGUE_TRACKING);
    }
    return t;
}

static inline void must_be_at(const drogue_track *t, double x, double y, double z, double tolerance)
{
    drogue_track_estimate e;
    drogue_track_get(&e, t);
    MUST(fabs(real_of_q16(e.position_m_q16[0]) - x) <= tolerance &&
             fabs(real_of_q16(e.position_m_q16[1]) - y) <= tolerance &&
             fabs(real_of_q16(e.position_m_q16[2]) - z) <= tolerance,
         "at (%g, %g, %g), not (%g, %g, %g)", real_of_q16(e.position_m_q16[0]), real_of_q16(e.position_m_q16[1]),
         real_of_q16(e.position_m_q16[2]), x, y, z);
}

#endif
