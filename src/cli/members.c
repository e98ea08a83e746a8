/* SPDX-License-Identifier: Apache-2.0 */
/* The members in their order. Numbers keep every bit of their Q16 with six decimals, (co)variances six significant
 * digits. */
#include "members.h"

#include <stdio.h>

#include "decimal.h"
#include "odds.h"

enum { MEMBER_DECIMALS = 6, MEMBER_DIGITS = 6 };

static void put_number(const member_sink *s, const char *name, char text[DECIMAL_TEXT], int known)
{
    decimal_trim(text);
    s->value(s->state, name, known ? text : NULL);
}

static void put_q16(const member_sink *s, const char *name, drogue_q16 value, int known)
{
    char text[DECIMAL_TEXT];
    decimal_format_q16(text, value, MEMBER_DECIMALS);
    put_number(s, name, text, known);
}

static void put_degrees(const member_sink *s, const char *name, drogue_q16 angle_rad_q16, int known)
{
    char text[DECIMAL_TEXT];
    decimal_format_degrees(text, angle_rad_q16, MEMBER_DECIMALS);
    put_number(s, name, text, known);
}

static void put_whole(const member_sink *s, const char *name, long value, int known)
{
    char text[DECIMAL_TEXT];
    snprintf(text, sizeof text, "%ld", value);
    s->value(s->state, name, known ? text : NULL);
}

static void put_flag(const member_sink *s, const char *name, int value, int known)
{
    s->value(s->state, name, !known ? NULL : value ? "true" : "false");
}

static void put_vector(const member_sink *s, const char *name, const drogue_q16 v[3], int known)
{
    int i;
    s->begin(s->state, name, 1, known);
    for (i = 0; i < 3; i++) {
        put_q16(s, NULL, v[i], known);
    }
    s->end(s->state);
}

static void put_binary(const member_sink *s, int64_t value, int frac_bits, int known)
{
    char text[DECIMAL_TEXT];
    decimal_format_binary(text, value, frac_bits, MEMBER_DIGITS);
    s->value(s->state, NULL, known ? text : NULL);
}

static void put_region(const member_sink *s, const char *name, const drogue_region *r, int known)
{
    s->begin(s->state, name, 1, known);
    put_whole(s, NULL, r->x_px, known);
    put_whole(s, NULL, r->y_px, known);
    put_whole(s, NULL, r->width_px, known);
    put_whole(s, NULL, r->height_px, known);
    s->end(s->state);
}

static const char *polarity_name(drogue_polarity polarity)
{
    return polarity == DROGUE_POLARITY_DARK ? "dark" : polarity == DROGUE_POLARITY_BRIGHT ? "bright" : "mixed";
}

static long count_arcs(const drogue_result *r)
{
    long count = 0;
    int i;
    for (i = 0; i < 4; i++) {
        count += r->arcs[i] != DROGUE_NO_ARC;
    }
    return count;
}

/* Also of what is not sure enough for a pose to be shown: they say by how much. */
static void put_log_odds(const member_sink *s, const measurement *m)
{
    const int known = odds_known(m->result, m->model);
    put_q16(s, "log_odds", known ? drogue_result_log_odds_q16(m->result, m->model) : 0, known);
}

/* The outline can be known when its pose is not. */
static void put_outline(const member_sink *s, const drogue_result *r)
{
    const int known = r->ellipse.a_px_q16 > 0;
    s->begin(s->state, "ellipse", 0, known);
    put_q16(s, "xc", r->ellipse.xc_px_q16, known);
    put_q16(s, "yc", r->ellipse.yc_px_q16, known);
    put_q16(s, "a", r->ellipse.a_px_q16, known);
    put_q16(s, "b", r->ellipse.b_px_q16, known);
    put_degrees(s, "angle_deg", r->ellipse.angle_rad_q16, known);
    s->end(s->state);
    put_q16(s, "reliability", r->quality.reliability_q16, known);
    put_q16(s, "cover", r->cover_q16, known);
    put_whole(s, "outside", (long)r->outside, known);
    put_whole(s, "arcs", count_arcs(r), known);
    put_whole(s, "cluster_members", (long)r->cluster_members, known);
    s->text(s->state, "polarity", known ? polarity_name(r->polarity) : NULL);
    s->begin(s->state, "inner_centre", 0, r->has_inner);
    put_q16(s, "x", r->inner.x_px_q16, r->has_inner);
    put_q16(s, "y", r->inner.y_px_q16, r->has_inner);
    s->end(s->state);
}

static void put_pose(const member_sink *s, const drogue_pose *pose, int known)
{
    put_vector(s, "position_m", pose->position_m_q16, known);
    put_vector(s, "axis", pose->axis_q16, known);
    put_degrees(s, "yaw_deg", pose->yaw_rad_q16, known);
    put_degrees(s, "pitch_deg", pose->pitch_rad_q16, known);
}

static void put_uncertainty(const member_sink *s, const drogue_result *r, int known)
{
    char text[DECIMAL_TEXT];
    int i;
    int j;
    s->begin(s->state, "covariance", 1, known);
    for (i = 0; i < 5; i++) {
        s->begin(s->state, NULL, 1, known);
        for (j = 0; j < 5; j++) {
            put_binary(s, r->covariance_q48[i][j], 48 - r->covariance_halved, known);
        }
        s->end(s->state);
    }
    s->end(s->state);
    s->begin(s->state, "position_std_m", 1, known);
    for (i = 0; i < 3; i++) {
        put_binary(s, r->position_std_m_q32[i], 32, known);
    }
    s->end(s->state);
    decimal_format_degrees_q32(text, r->axis_std_rad_q32, MEMBER_DIGITS);
    s->value(s->state, "axis_std_deg", known ? text : NULL);
}

const char *measurement_status(const measurement *m)
{
    return m->unreliable ? "unreliable" : drogue_status_name(m->result->status);
}

int measurement_known(const measurement *m) { return m->result->status == DROGUE_OK && !m->unreliable; }

void members_of_measurement(const member_sink *s, const measurement *m)
{
    const drogue_result *r = m->result;
    const int known = measurement_known(m);
    s->text(s->state, "image", m->path);
    s->text(s->state, "status", measurement_status(m));
    put_region(s, "region", &r->region, r->region.width_px > 0 && r->region.height_px > 0);
    put_flag(s, "searched", m->searched, m->searched >= 0);
    s->text(s->state, "second_look", drogue_second_look_name(r->second_look));
    put_outline(s, r);
    s->text(s->state, "length_unit", m->length_unit);
    put_pose(s, &r->pose, known);
    s->begin(s->state, "alternative", 0, known);
    put_pose(s, &r->alternative, known);
    s->end(s->state);
    put_flag(s, "orientation_resolved", r->orientation_resolved, known);
    put_q16(s, "ambiguity", r->ambiguity_q16, known);
    put_q16(s, "doubt", r->doubt_q16, known);
    put_log_odds(s, m);
    put_uncertainty(s, r, known);
}

/* round(v * unit / 2^32) for a v >= 0 that may be as large as there is */
static int64_t scaled_q32(int64_t v_q32, int64_t unit)
{
    return (v_q32 >> 32) * unit + (((v_q32 & INT64_C(0xFFFFFFFF)) * unit + (INT64_C(1) << 31)) >> 32);
}

static void put_millionths(const member_sink *s, const char *name, int64_t value, int known)
{
    char text[DECIMAL_TEXT];
    decimal_format(text, value, MEMBER_DECIMALS);
    put_number(s, name, text, known);
}

static void put_degrees_q32(const member_sink *s, const char *name, int64_t angle_rad_q32, int known)
{
    put_millionths(s, name, scaled_q32(angle_rad_q32, 57295780), known);
}

static void put_estimate(const member_sink *s, const drogue_track_estimate *e, int known)
{
    int i;
    s->begin(s->state, "filtered", 0, known);
    put_vector(s, "position_m", e->position_m_q16, known);
    put_vector(s, "velocity_mps", e->velocity_mps_q16, known);
    put_vector(s, "axis", e->axis_q16, known);
    put_degrees(s, "yaw_deg", e->yaw_rad_q16, known);
    put_degrees(s, "pitch_deg", e->pitch_rad_q16, known);
    put_flag(s, "orientation_resolved", e->orientation_resolved, known);
    s->begin(s->state, "position_std_m", 1, known);
    for (i = 0; i < 3; i++) {
        put_millionths(s, NULL, scaled_q32(e->position_std_m_q32[i], 1000000), known);
    }
    s->end(s->state);
    put_degrees_q32(s, "yaw_std_deg", e->yaw_std_rad_q32, known);
    put_degrees_q32(s, "pitch_std_deg", e->pitch_std_rad_q32, known);
    put_degrees_q32(s, "axis_std_deg", e->axis_std_rad_q32, known);
    s->end(s->state);
}

void members_of_track_line(const member_sink *s, const track_line *line)
{
    s->text(s->state, "image", line->raw.path);
    put_whole(s, "frame", line->frame, 1);
    put_millionths(s, "time_s", (int64_t)line->time_us, 1);
    s->text(s->state, "state", drogue_track_state_name(line->track->state));
    put_flag(s, "gated", line->track->gated, 1);
    s->begin(s->state, "raw", 0, 1);
    members_of_measurement(s, &line->raw);
    s->end(s->state);
    put_estimate(s, line->estimate, line->track->state != DROGUE_LOST);
    put_region(s, "roi", line->region, 1);
}
