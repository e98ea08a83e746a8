/* SPDX-License-Identifier: Apache-2.0 */
#include "choose_label.h"

#include "drogue/label.h"

uint64_t drogue_hls_choose_label(uint32_t above, uint32_t left, uint32_t above_left, uint32_t above_right)
{
    uint32_t merge_with;
    const uint32_t label = drogue_label_choose(&merge_with, above, left, above_left, above_right);
    return label | (uint64_t)merge_with << 32;
}
