/* SPDX-License-Identifier: Apache-2.0 */
/* Every threshold of drogue_config (include/drogue/config.h, where each is explained) with the range that
 * drogue_config_valid() demands: for --set and --help-config, and for the Python package. */
#ifndef CLI_THRESHOLDS_H
#define CLI_THRESHOLDS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct threshold {
    const char *name; /* the member's, without Q format */
    size_t offset;    /* in drogue_config, of an int32_t, uint32_t or enum */
    int is_q16;       /* 0: a whole number */
    int32_t least;    /* as the member is kept */
    int32_t most;     /* INT32_MAX: no limit but the format's */
    const char *unit; /* and effect */
} threshold;

extern const threshold thresholds[];
extern const int threshold_count;

#ifdef __cplusplus
}
#endif
#endif
