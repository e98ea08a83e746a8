/* SPDX-License-Identifier: Apache-2.0 */
/* The library's src/track/track.c, which predicts while the camera still writes the frame, and waits for it before it looks. */
#pragma GCC optimize("Os")
#include "drogue/search.h"

#include "machine.h"

static drogue_status measure_when_there(drogue_result *out, drogue_workspace *workspace, const drogue_setup *setup,
                                        const drogue_image *image, const drogue_region *region)
{
    end_capture();
    return drogue_measure(out, workspace, setup, image, region);
}

static drogue_status acquire_when_there(drogue_result *out, drogue_workspace *workspace, drogue_search *search,
                                        const drogue_setup *setup, const drogue_image *image,
                                        const drogue_region *within)
{
    end_capture();
    return drogue_acquire(out, workspace, search, setup, image, within);
}

#define drogue_measure measure_when_there
#define drogue_acquire acquire_when_there
#include "../../src/track/track.c"
