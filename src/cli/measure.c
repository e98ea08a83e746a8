/* SPDX-License-Identifier: Apache-2.0 */
/* drogue measure: the pose in one image, as a table or as JSON. */
#include <stdio.h>

#include "cli.h"
#include "commands.h"
#include "frame.h"
#include "json.h"
#include "overlay.h"
#include "table.h"

static int measure(const options *o, frame_workspace *w, const picture *grey)
{
    const char *path = o->files[0];
    drogue_region region;
    drogue_result result;
    if (o->region_given ? frame_region(&region, o, path, grey) || frame_measure(&result, w, o, path, grey, &region)
                        : frame_acquire(&result, &region, w, o, path, grey)) {
        return EXIT_BAD;
    }
    if (o->json) {
        json_measurement(stdout, path, &result);
        putchar('\n');
    } else {
        table_print(path, &result, options_length_unit(o));
    }
    if (flush_output()) {
        return EXIT_BAD;
    }
    if (o->overlay != NULL && overlay_write(o->overlay, o, grey, &region, &w->workspace, &result, NULL)) {
        return EXIT_BAD;
    }
    return result.status == DROGUE_OK ? EXIT_MEASURED : EXIT_NOTHING;
}

int command_measure(const options *o)
{
    frame_workspace w = {0};
    picture grey;
    int code;
    if (picture_read_grey(&grey, o->files[0])) {
        return EXIT_BAD;
    }
    code = measure(o, &w, &grey);
    frame_workspace_free(&w);
    picture_free(&grey);
    return code;
}
