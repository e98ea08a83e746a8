/* SPDX-License-Identifier: Apache-2.0 */
/* The table of drogue measure: a line a quantity, '-' where it is unknown. */
#include "table.h"

#include <stdio.h>

#include "decimal.h"

enum { TABLE_DECIMALS = 4 };

static void put_label(const char *label) { printf("%-13s ", label); }

static void put_q16(const char *before, drogue_q16 value)
{
    char text[DECIMAL_TEXT];
    decimal_format_q16(text, value, TABLE_DECIMALS);
    printf("%s%s", before, text);
}

static void put_degrees(const char *before, drogue_q16 angle_rad_q16)
{
    char text[DECIMAL_TEXT];
    decimal_format_degrees(text, angle_rad_q16, TABLE_DECIMALS);
    printf("%s%s", before, text);
}

static void put_vector(const drogue_q16 v[3])
{
    put_q16("", v[0]);
    put_q16(", ", v[1]);
    put_q16(", ", v[2]);
}

static void put_outline(const drogue_result *r)
{
    put_q16("centre ", r->ellipse.xc_px_q16);
    put_q16(", ", r->ellipse.yc_px_q16);
    put_q16(" px, semi-axes ", r->ellipse.a_px_q16);
    put_q16(", ", r->ellipse.b_px_q16);
    put_degrees(" px, angle ", r->ellipse.angle_rad_q16);
    puts(" degrees");
    put_label("reliability");
    put_q16("", r->quality.reliability_q16);
    printf(", %s inside\n", r->polarity == DROGUE_POLARITY_DARK     ? "dark"
                            : r->polarity == DROGUE_POLARITY_BRIGHT ? "bright"
                                                                    : "dark and bright");
}

static void put_pose(const drogue_pose *pose, const char *unit)
{
    put_vector(pose->position_m_q16);
    printf(" %s\n", unit);
    put_label("  axis");
    put_vector(pose->axis_q16);
    putchar('\n');
    put_label("  yaw, pitch");
    put_degrees("", pose->yaw_rad_q16);
    put_degrees(", ", pose->pitch_rad_q16);
    puts(" degrees");
}

void table_print(const char *path, const drogue_result *r, const char *unit)
{
    put_label("image");
    puts(path);
    put_label("status");
    fputs(drogue_status_name(r->status), stdout);
    puts(r->second_look >= DROGUE_SECOND_TOO_WIDE ? ", but the workspace was too small for a second look" : "");
    put_label("ellipse");
    if (r->ellipse.a_px_q16 > 0) {
        put_outline(r);
    } else {
        puts("-");
    }
    put_label("inner centre");
    if (r->has_inner) {
        put_q16("", r->inner.x_px_q16);
        put_q16(", ", r->inner.y_px_q16);
        puts(" px");
    } else {
        puts("-");
    }
    put_label("position");
    if (r->status != DROGUE_OK) {
        puts("-");
        return;
    }
    put_pose(&r->pose, unit);
    put_label("alternative");
    put_pose(&r->alternative, unit);
    put_label("orientation");
    put_q16(r->orientation_resolved ? "resolved, ambiguity " : "unresolved: either of the two, ambiguity ",
            r->ambiguity_q16);
    putchar('\n');
}
