/* SPDX-License-Identifier: Apache-2.0 */
/* The pure operator that the stream labels with. */
#ifndef DROGUE_HLS_CHOOSE_LABEL_H
#define DROGUE_HLS_CHOOSE_LABEL_H

#include <stdint.h>

/* Label of a pixel in the lower half of the word, the label it merges with in the upper half; 0 for none. */
uint64_t drogue_hls_choose_label(uint32_t above, uint32_t left, uint32_t above_left, uint32_t above_right);

#endif
