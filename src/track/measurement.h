/* SPDX-License-Identifier: Apache-2.0 */
/* A frame's result as the tracker takes it. */
#ifndef DROGUE_MEASUREMENT_H
#define DROGUE_MEASUREMENT_H

#include "drogue/track.h"

/* One of a result's two poses as the filter takes it. */
typedef struct drogue_measurement {
    drogue_q16 value_q16[DROGUE_PARAMETERS];
    drogue_q16 std_q16[DROGUE_PARAMETERS];
    drogue_real noise[DROGUE_PACKED_MAX]; /* covariance in the filter's order */
    drogue_real apart[DROGUE_PARAMETERS]; /* what the distance of the twins adds to the variances */
    drogue_real doubt[DROGUE_Z + 1];      /* what the inner part's size adds to those of x, y, z */
    int solid;                            /* shows the inner part, or the model has none */
} drogue_measurement;

/* Is it a measurement, and reliable enough? */
static inline int drogue_measurement_counts(const drogue_result *result, const drogue_track_config *c)
{
    return result->status == DROGUE_OK && result->quality.reliability_q16 >= c->min_reliability_q16;
}

/* Standard deviations are never 0. */
static inline drogue_q16 drogue_at_least_one(drogue_q16 v) { return v < 1 ? 1 : v; }

/* Read the pose of a result, or its twin. A cut outline counts for less than its covariance says:
 * drogue_track_end(). */
void drogue_measurement_read(drogue_measurement *m, const drogue_result *result, int twin, const drogue_model *model,
                             const drogue_track_config *c);

#endif
