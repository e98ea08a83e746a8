/* SPDX-License-Identifier: Apache-2.0 */
/* JSON by hand, without floating point: the numbers keep every bit of their Q16 with six decimals, (co)variances six
 * significant digits. */
#include "json.h"

#include "decimal.h"

enum { JSON_DECIMALS = 6, JSON_DIGITS = 6 };

/* Length of the UTF-8 character at the start of a text; 0 when there is none (RFC 3629). */
static int utf8_length(const unsigned char *s)
{
    int length = s[0] < 0x80 ? 1 : s[0] < 0xC2 ? 0 : s[0] < 0xE0 ? 2 : s[0] < 0xF0 ? 3 : s[0] < 0xF5 ? 4 : 0;
    int i;
    for (i = 1; i < length; i++) {
        if ((s[i] & 0xC0) != 0x80) {
            return 0;
        }
    }
    if ((s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF0 && s[1] < 0x90) ||
        (s[0] == 0xF4 && s[1] > 0x8F)) {
        return 0;
    }
    return length;
}

void json_string(FILE *out, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', out);
    while (*s != '\0') {
        int length = utf8_length(s);
        if (length == 0) {
            fputs("\\ufffd", out);
            s++;
        } else if (*s == '"' || *s == '\\') {
            fprintf(out, "\\%c", *s++);
        } else if (*s < 0x20) {
            fprintf(out, "\\u%04x", (unsigned)*s++);
        } else {
            fwrite(s, 1, (size_t)length, out);
            s += length;
        }
    }
    fputc('"', out);
}

static void put_number(FILE *out, char text[DECIMAL_TEXT])
{
    decimal_trim(text);
    fputs(text, out);
}

static void put_q16(FILE *out, const char *key, drogue_q16 value)
{
    char text[DECIMAL_TEXT];
    decimal_format_q16(text, value, JSON_DECIMALS);
    fprintf(out, "\"%s\":", key);
    put_number(out, text);
}

static void put_degrees(FILE *out, const char *key, drogue_q16 angle_rad_q16)
{
    char text[DECIMAL_TEXT];
    decimal_format_degrees(text, angle_rad_q16, JSON_DECIMALS);
    fprintf(out, "\"%s\":", key);
    put_number(out, text);
}

static void put_vector(FILE *out, const char *key, const drogue_q16 v[3])
{
    int i;
    fprintf(out, "\"%s\":[", key);
    for (i = 0; i < 3; i++) {
        char text[DECIMAL_TEXT];
        decimal_format_q16(text, v[i], JSON_DECIMALS);
        fputs(i > 0 ? "," : "", out);
        put_number(out, text);
    }
    fputc(']', out);
}

static const char *polarity_name(drogue_polarity polarity)
{
    return polarity == DROGUE_POLARITY_DARK ? "dark" : polarity == DROGUE_POLARITY_BRIGHT ? "bright" : "mixed";
}

static void put_outline(FILE *out, const drogue_result *r)
{
    /* The outline can be known when its pose is not. */
    if (r->ellipse.a_px_q16 <= 0) {
        fputs("\"ellipse\":null,\"reliability\":null,\"polarity\":null,", out);
        return;
    }
    fputs("\"ellipse\":{", out);
    put_q16(out, "xc", r->ellipse.xc_px_q16);
    fputc(',', out);
    put_q16(out, "yc", r->ellipse.yc_px_q16);
    fputc(',', out);
    put_q16(out, "a", r->ellipse.a_px_q16);
    fputc(',', out);
    put_q16(out, "b", r->ellipse.b_px_q16);
    fputc(',', out);
    put_degrees(out, "angle_deg", r->ellipse.angle_rad_q16);
    fputs("},", out);
    put_q16(out, "reliability", r->quality.reliability_q16);
    fprintf(out, ",\"polarity\":\"%s\",", polarity_name(r->polarity));
}

static void put_inner_centre(FILE *out, const drogue_result *r)
{
    if (!r->has_inner) {
        fputs("\"inner_centre\":null,", out);
        return;
    }
    fputs("\"inner_centre\":{", out);
    put_q16(out, "x", r->inner.x_px_q16);
    fputc(',', out);
    put_q16(out, "y", r->inner.y_px_q16);
    fputs("},", out);
}

static void put_binary(FILE *out, const char *before, int64_t value, int frac_bits)
{
    char text[DECIMAL_TEXT];
    decimal_format_binary(text, value, frac_bits, JSON_DIGITS);
    fprintf(out, "%s%s", before, text);
}

static void put_uncertainty(FILE *out, const drogue_result *r)
{
    char text[DECIMAL_TEXT];
    int i;
    int j;
    fputs("\"covariance\":[", out);
    for (i = 0; i < 5; i++) {
        for (j = 0; j < 5; j++) {
            put_binary(out, j > 0 ? "," : i > 0 ? ",[" : "[", r->covariance_q48[i][j], 48);
        }
        fputc(']', out);
    }
    fputs("],\"position_std_m\":[", out);
    for (i = 0; i < 3; i++) {
        put_binary(out, i > 0 ? "," : "", r->position_std_m_q32[i], 32);
    }
    decimal_format_degrees_q32(text, r->axis_std_rad_q32, JSON_DIGITS);
    fprintf(out, "],\"axis_std_deg\":%s", text);
}

static void put_pose(FILE *out, const drogue_result *r)
{
    if (r->status != DROGUE_OK) {
        fputs("\"position_m\":null,\"axis\":null,\"yaw_deg\":null,\"pitch_deg\":null,\"alternative\":null,"
              "\"orientation_resolved\":null,\"ambiguity\":null,\"covariance\":null,\"position_std_m\":null,"
              "\"axis_std_deg\":null",
              out);
        return;
    }
    put_vector(out, "position_m", r->pose.position_m_q16);
    fputc(',', out);
    put_vector(out, "axis", r->pose.axis_q16);
    fputc(',', out);
    put_degrees(out, "yaw_deg", r->pose.yaw_rad_q16);
    fputc(',', out);
    put_degrees(out, "pitch_deg", r->pose.pitch_rad_q16);
    fputs(",\"alternative\":{", out);
    put_vector(out, "position_m", r->alternative.position_m_q16);
    fputc(',', out);
    put_vector(out, "axis", r->alternative.axis_q16);
    fprintf(out, "},\"orientation_resolved\":%s,", r->orientation_resolved ? "true" : "false");
    put_q16(out, "ambiguity", r->ambiguity_q16);
    fputc(',', out);
    put_uncertainty(out, r);
}

void json_measurement(FILE *out, const char *path, const drogue_result *result)
{
    fputs("{\"image\":", out);
    json_string(out, path);
    fprintf(out, ",\"status\":\"%s\",\"second_look\":\"%s\",", drogue_status_name(result->status),
            drogue_second_look_name(result->second_look));
    put_outline(out, result);
    put_inner_centre(out, result);
    put_pose(out, result);
    fputc('}', out);
}

/* round(v * unit / 2^32) for a v >= 0 that may be as large as there is */
static int64_t scaled_q32(int64_t v_q32, int64_t unit)
{
    return (v_q32 >> 32) * unit + (((v_q32 & INT64_C(0xFFFFFFFF)) * unit + (INT64_C(1) << 31)) >> 32);
}

static void put_metres_q32(FILE *out, int64_t v_q32)
{
    char text[DECIMAL_TEXT];
    decimal_format(text, scaled_q32(v_q32, 1000000), JSON_DECIMALS);
    put_number(out, text);
}

static void put_degrees_q32(FILE *out, const char *key, int64_t angle_rad_q32)
{
    char text[DECIMAL_TEXT];
    decimal_format(text, scaled_q32(angle_rad_q32, 57295780), JSON_DECIMALS);
    fprintf(out, ",\"%s\":", key);
    put_number(out, text);
}

static void put_estimate(FILE *out, const drogue_track_estimate *estimate)
{
    int i;
    put_vector(out, "position_m", estimate->position_m_q16);
    fputc(',', out);
    put_vector(out, "velocity_mps", estimate->velocity_mps_q16);
    fputc(',', out);
    put_vector(out, "axis", estimate->axis_q16);
    fputc(',', out);
    put_degrees(out, "yaw_deg", estimate->yaw_rad_q16);
    fputc(',', out);
    put_degrees(out, "pitch_deg", estimate->pitch_rad_q16);
    fprintf(out, ",\"orientation_resolved\":%s,\"position_std_m\":[",
            estimate->orientation_resolved ? "true" : "false");
    for (i = 0; i < 3; i++) {
        fputs(i > 0 ? "," : "", out);
        put_metres_q32(out, estimate->position_std_m_q32[i]);
    }
    fputc(']', out);
    put_degrees_q32(out, "yaw_std_deg", estimate->yaw_std_rad_q32);
    put_degrees_q32(out, "pitch_std_deg", estimate->pitch_std_rad_q32);
    put_degrees_q32(out, "axis_std_deg", estimate->axis_std_rad_q32);
}

void json_track_line(FILE *out, const char *path, const drogue_result *result, const drogue_track *track,
                     const drogue_region *region, const drogue_track_estimate *estimate)
{
    fputs("{\"image\":", out);
    json_string(out, path);
    fprintf(out, ",\"state\":\"%s\",\"gated\":%s,\"raw\":", drogue_track_state_name(track->state),
            track->gated ? "true" : "false");
    json_measurement(out, path, result);
    if (track->state == DROGUE_LOST) {
        fputs(",\"filtered\":null", out);
    } else {
        fputs(",\"filtered\":{", out);
        put_estimate(out, estimate);
        fputc('}', out);
    }
    fprintf(out, ",\"roi\":[%ld,%ld,%ld,%ld]}\n", (long)region->x_px, (long)region->y_px, (long)region->width_px,
            (long)region->height_px);
}
