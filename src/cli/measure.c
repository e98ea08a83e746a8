/* SPDX-License-Identifier: Apache-2.0 */
/* drogue measure: the pose in one image, as a table, JSON or CSV. */
#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "commands.h"
#include "csv.h"
#include "explain.h"
#include "frame.h"
#include "images.h"
#include "json.h"
#include "overlay.h"
#include "table.h"

static int find(drogue_result *result, drogue_region *region, int *searched, frame_workspace *w, const options *o,
                const picture *grey)
{
    const char *path = o->files[0];
    if (o->region_given) {
        return frame_region(region, o, path, grey) || frame_measure(result, searched, w, o, path, grey, region);
    }
    *searched = 1;
    return frame_acquire(result, region, w, o, path, grey);
}

static void print(const options *o, const measurement *m)
{
    switch (o->format) {
    case FORMAT_JSON: json_measurement(stdout, m); break;
    case FORMAT_CSV: csv_measurement(stdout, m); break;
    case FORMAT_TABLE: table_print(m); break;
    }
}

/* What a user should know beside the members, on standard error. */
static void remark(const options *o, const measurement *m)
{
    if (m->unreliable) {
        complain(m->path, "unreliable: %s", EXPLAIN_UNRELIABLE);
    } else if (m->result->status != DROGUE_OK) {
        complain(m->path, "%s: %s", drogue_status_name(m->result->status), explain_status(m->result->status));
    } else if (o->region_given && m->searched) {
        complain(m->path,
                 "found by a search within --roi, whose longest side should be 2 to 3 major semi-axes with the "
                 "drogue about its middle");
    }
}

static int measure(const options *o, frame_workspace *w, const picture *grey)
{
    measurement m = {o->files[0], NULL, &o->model, options_length_unit(o), 0, 0};
    drogue_region region;
    drogue_result result;
    if (frame_check_camera(o, m.path, grey) || find(&result, &region, &m.searched, w, o, grey)) {
        return EXIT_BAD;
    }
    m.result = &result;
    m.unreliable = frame_unreliable(o, &result);
    if (o->overlay == NULL || strcmp(o->overlay, "-") != 0) { /* the picture has standard output for itself */
        print(o, &m);
    }
    if (flush_output()) {
        return EXIT_BAD;
    }
    remark(o, &m);
    if (o->overlay != NULL && overlay_write(o->overlay, o, grey, &region, &w->workspace, &m, NULL)) {
        return EXIT_BAD;
    }
    return measurement_known(&m) ? EXIT_MEASURED : EXIT_NOTHING;
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
