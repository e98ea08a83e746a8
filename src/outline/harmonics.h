/* SPDX-License-Identifier: Apache-2.0 */
/* Inside the outline stage: how far an ellipse was moved and bent, as five harmonics of its radius. */
#ifndef DROGUE_HARMONICS_H
#define DROGUE_HARMONICS_H

#include "drogue/support.h"
#include "slopes.h"

/* Harmonics of what is likely not noise.
 *
 *  pull   out, as that of a support: at most an eighth of the semi-axis
 *  moved  outwards along the normal, slopes Q20, of equal parts of the outline
 *  noise  px Q24, one standard deviation of each; NULL: there is none, all counts
 */
void drogue_find_harmonics(int32_t pull_q24[5], const int32_t moved_q20[DROGUE_EDGE_GROUPS],
                           const int32_t noise_px_q24[DROGUE_EDGE_GROUPS], const drogue_ellipse *e);

/* Put back what drogue_outline_pull() found. */
void drogue_outline_put_back(drogue_ellipse *e, const int32_t pull_q24[5]);

#endif
