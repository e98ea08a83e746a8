/* SPDX-License-Identifier: Apache-2.0 */
/* drogue track: the pose over a sequence of images, one JSON line a frame. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "commands.h"
#include "drogue/track.h"
#include "frame.h"
#include "json.h"
#include "outputs.h"
#include "overlay.h"

typedef struct sequence {
    const options *o;
    frame_workspace w;
    drogue_track track;
    int32_t width_px; /* of the first frame */
    int32_t height_px;
    int measured; /* frames */
} sequence;

/* One camera takes frames of one size, and the first region is a part of them. */
static int begin_sequence(sequence *s, const char *path, const picture *grey)
{
    drogue_track_config config;
    drogue_region first;
    if (s->o->region_given && frame_region(&first, s->o, path, grey)) {
        return EXIT_BAD;
    }
    drogue_track_config_default(&config);
    if (s->o->max_missed_given) {
        config.max_missed = s->o->max_missed;
    }
    (void)drogue_track_init(&s->track, &config, &s->o->camera, &s->o->model, s->o->region_given ? &first : NULL);
    s->width_px = grey->width_px;
    s->height_px = grey->height_px;
    return EXIT_MEASURED;
}

/* Draw frame 'number', counted from 1, into OUT-0001.png for OUT.png. */
static int draw_frame(const sequence *s, int number, const picture *grey, const drogue_region *region,
                      const drogue_result *result, drogue_track_state state)
{
    char *path = output_numbered(s->o->overlay, number);
    int code;
    if (path == NULL) {
        return EXIT_BAD;
    }
    code = overlay_write(path, s->o, grey, region, &s->w.workspace, result, drogue_track_state_name(state));
    free(path);
    return code;
}

static int track_frame(sequence *s, int index, const picture *grey)
{
    const char *path = s->o->files[index];
    drogue_region region;
    drogue_result result;
    drogue_track_state state;
    drogue_track_estimate estimate;
    if (index == 0 && begin_sequence(s, path, grey)) {
        return EXIT_BAD;
    }
    if (grey->width_px != s->width_px || grey->height_px != s->height_px) {
        return complain(path, "%dx%d pixels, unlike the first frame's %dx%d", grey->width_px, grey->height_px,
                        s->width_px, s->height_px);
    }
    if (frame_track(&result, &region, &s->track, &s->w, s->o, path, grey)) {
        return EXIT_BAD;
    }
    state = s->track.state;
    drogue_track_get(&estimate, &s->track);
    json_track_line(stdout, path, &result, &s->track, &region, &estimate);
    if (flush_output()) {
        return EXIT_BAD;
    }
    s->measured += result.status == DROGUE_OK;
    return s->o->overlay == NULL ? EXIT_MEASURED : draw_frame(s, index + 1, grey, &region, &result, state);
}

int command_track(const options *o)
{
    sequence s;
    int i;
    int bad = 0;
    memset(&s, 0, sizeof s);
    s.o = o;
    for (i = 0; i < o->file_count && !bad; i++) {
        picture grey;
        bad = picture_read_grey(&grey, o->files[i]) || track_frame(&s, i, &grey);
        picture_free(&grey);
    }
    frame_workspace_free(&s.w);
    return bad ? EXIT_BAD : s.measured > 0 ? EXIT_MEASURED : EXIT_NOTHING;
}
