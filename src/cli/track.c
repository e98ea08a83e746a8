/* SPDX-License-Identifier: Apache-2.0 */
/* drogue track: the pose over a sequence of images, one JSON line a frame. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli.h"
#include "commands.h"
#include "csv.h"
#include "drogue/track.h"
#include "explain.h"
#include "frame.h"
#include "json.h"
#include "outputs.h"
#include "overlay.h"
#include "sequence.h"

/* When the frames are, without a rounded step that adds up. */
typedef struct frame_clock {
    uint64_t whole_us; /* exact time since the first: these, and */
    uint64_t rest;     /* shares of a microsecond, in units of 1 / rate */
    uint64_t us;       /* rounded */
} frame_clock;

typedef struct tracker {
    const options *o;
    frame_clock clock;
    frame_workspace w;
    drogue_track track;
    int32_t width_px; /* of the first frame */
    int32_t height_px;
    long frames;
    long of_status[DROGUE_STATUS_COUNT]; /* frames of each */
    long unreliable;                     /* frames measured, but below --min-reliability */
} tracker;

/* One camera takes frames of one size, and the first region is a part of them. */
static int begin_track(tracker *s, const char *path, const picture *grey)
{
    drogue_track_config config;
    drogue_region first;
    if (frame_check_camera(s->o, path, grey) || (s->o->region_given && frame_region(&first, s->o, path, grey))) {
        return EXIT_BAD;
    }
    drogue_track_config_default(&config);
    if (s->o->max_missed_given) {
        config.max_missed = s->o->max_missed;
    }
    config.min_reliability_q16 = s->o->min_reliability_q16;
    (void)drogue_track_init(&s->track, &config, &s->o->camera, &s->o->model, s->o->region_given ? &first : NULL);
    s->width_px = grey->width_px;
    s->height_px = grey->height_px;
    return EXIT_MEASURED;
}

/* Draw frame 'number', counted from 1, into OUT-0001.png for OUT.png. */
static int draw_frame(const tracker *s, int number, const picture *grey, const drogue_region *region,
                      const measurement *m, drogue_track_state state)
{
    char *path = output_numbered(s->o->overlay, number);
    int code;
    if (path == NULL) {
        return EXIT_BAD;
    }
    code = overlay_write(path, s->o, grey, region, &s->w.workspace, m, drogue_track_state_name(state));
    free(path);
    return code;
}

static void print_line(const tracker *s, const measurement *m, const drogue_region *region)
{
    drogue_track_estimate estimate;
    track_line line;
    drogue_track_get(&estimate, &s->track);
    line.raw = *m;
    line.frame = s->frames;
    line.time_us = s->clock.us;
    line.track = &s->track;
    line.region = region;
    line.estimate = &estimate;
    if (s->o->format == FORMAT_CSV) {
        csv_track_line(stdout, &line);
    } else {
        json_track_line(stdout, &line);
    }
}

/* On to the next frame; returns the microseconds between the two, as rounded. */
static uint32_t advance(frame_clock *c, uint64_t rate)
{
    const uint64_t million = UINT64_C(1000000000000000); /* billionths */
    const uint64_t before = c->us;
    c->whole_us += million / rate;
    c->rest += million % rate;
    if (c->rest >= rate) {
        c->rest -= rate;
        c->whole_us++;
    }
    c->us = c->whole_us + (2 * c->rest >= rate);
    return (uint32_t)(c->us - before);
}

static int track_frame(tracker *s, const char *path, const picture *grey)
{
    /* the tracker does not say where it searched */
    measurement m = {path, NULL, &s->o->model, options_length_unit(s->o), -1, 0};
    drogue_region region;
    drogue_result result;
    drogue_track_state state;
    uint32_t dt_us;
    if (s->frames == 0 && begin_track(s, path, grey)) {
        return EXIT_BAD;
    }
    if (grey->width_px != s->width_px || grey->height_px != s->height_px) {
        return complain(path, "%dx%d pixels, unlike the first frame's %dx%d", grey->width_px, grey->height_px,
                        s->width_px, s->height_px);
    }
    dt_us = s->frames == 0 ? 0 : advance(&s->clock, s->o->rate);
    if (frame_track(&result, &region, &s->track, &s->w, s->o, path, grey, dt_us)) {
        return EXIT_BAD;
    }
    state = s->track.state;
    s->frames++;
    s->of_status[result.status]++;
    m.result = &result;
    m.unreliable = frame_unreliable(s->o, &result);
    s->unreliable += m.unreliable;
    print_line(s, &m, &region);
    if (flush_output()) {
        return EXIT_BAD;
    }
    return s->o->overlay == NULL ? EXIT_MEASURED : draw_frame(s, (int)s->frames, grey, &region, &m, state);
}

/* How many frames gave nothing, a line a status. */
static void remark(const tracker *s)
{
    int i;
    for (i = DROGUE_OK + 1; i < DROGUE_STATUS_COUNT; i++) {
        if (s->of_status[i] > 0) {
            fprintf(stderr, "drogue: %ld of %ld frames: %s: %s\n", s->of_status[i], s->frames,
                    drogue_status_name((drogue_status)i), explain_status((drogue_status)i));
        }
    }
    if (s->unreliable > 0) {
        fprintf(stderr, "drogue: %ld of %ld frames: unreliable: %s\n", s->unreliable, s->frames, EXPLAIN_UNRELIABLE);
    }
}

/* Frames done, on a terminal, in place; nothing where standard error is a file or a pipe. */
static void show_progress(const tracker *s, int done)
{
    if (!isatty(STDERR_FILENO)) {
        return;
    }
    if (done) {
        fputs("\r\033[K", stderr);
    } else if (s->o->file_count > 1) {
        fprintf(stderr, "\rframe %ld of %d\r", s->frames, s->o->file_count);
    } else {
        fprintf(stderr, "\rframe %ld\r", s->frames);
    }
}

int command_track(const options *o)
{
    sequence frames = {NULL, 0};
    tracker s;
    int end = 0;
    int bad = 0;
    memset(&s, 0, sizeof s);
    s.o = o;
    while (!bad && !end) {
        const char *path;
        picture grey;
        bad = sequence_next(&grey, &path, &end, &frames, o) || (!end && track_frame(&s, path, &grey));
        picture_free(&grey);
        show_progress(&s, bad || end);
    }
    sequence_close(&frames);
    frame_workspace_free(&s.w);
    if (bad) {
        return EXIT_BAD;
    }
    if (s.frames == 0) {
        return complain(o->files[0], "holds no frame");
    }
    remark(&s);
    return s.of_status[DROGUE_OK] > s.unreliable ? EXIT_MEASURED : EXIT_NOTHING;
}
