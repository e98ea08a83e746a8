/* SPDX-License-Identifier: Apache-2.0 */
/* What the library decides from round to round of its last fits. */
#pragma once

#include "drogue/outline.h"

#ifdef __cplusplus
extern "C" {
#endif

#define DECISIONS_MAX 17 /* collections of 16 rounds */

/* One collection of edge points. */
typedef struct decisions_round {
    drogue_ellipse ellipse;
    drogue_band band;
} decisions_round;

/* The rounds from the fit of the given arcs (an index by quadrant, or DROGUE_NO_ARC); returns how many. */
int decisions_of_refit(decisions_round rounds[DECISIONS_MAX], const drogue_workspace *workspace,
                       const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config,
                       const uint32_t arcs[4]);

/* The rounds from an ellipse whose bins have the given polarities; half the first band's width, 0: the usual one. */
int decisions_of_ring(decisions_round rounds[DECISIONS_MAX], const drogue_workspace *workspace,
                      const drogue_edge_list *list, const drogue_mask *mask, const drogue_config *config,
                      const drogue_ellipse *ring, drogue_q16 band_px_q16, uint32_t bright_bins);

#ifdef __cplusplus
}
#endif
