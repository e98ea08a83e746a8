/* SPDX-License-Identifier: Apache-2.0 */
/* One threshold by its name in the table. */
#include "settings.h"

#include <stdio.h>
#include <string.h>

#include "cli.h"
#include "numbers.h"
#include "thresholds.h"

enum { RANGE_TEXT = 2 * DECIMAL_TEXT + 8 };

static int32_t *member(drogue_config *config, const threshold *s)
{
    return (int32_t *)(void *)((char *)config + s->offset);
}

static void format(char out[DECIMAL_TEXT], const threshold *s, int32_t value)
{
    if (!s->is_q16) {
        snprintf(out, DECIMAL_TEXT, "%ld", (long)value);
    } else {
        decimal_format_q16(out, value, 6);
        decimal_trim(out);
    }
}

static void format_range(char out[RANGE_TEXT], const threshold *s)
{
    char least[DECIMAL_TEXT];
    char most[DECIMAL_TEXT];
    format(least, s, s->least);
    format(most, s, s->most);
    snprintf(out, RANGE_TEXT, s->most == INT32_MAX ? "%s or more" : "%s to %s", least, most);
}

static int parse(int32_t *out, const threshold *s, const char *text)
{
    char range[RANGE_TEXT];
    if (!s->is_q16) {
        return numbers_whole(out, s->name, text, strlen(text), s->least, s->most);
    }
    if (numbers_check_count(s->name, text, 1) || numbers_q16(out, 1, s->name, text)) {
        return EXIT_BAD;
    }
    format_range(range, s);
    return *out >= s->least && *out <= s->most ? EXIT_MEASURED : complain(s->name, "'%s' is not %s", text, range);
}

int settings_set(drogue_config *config, const char *assignment)
{
    const size_t length = strcspn(assignment, "=");
    int i;
    if (assignment[length] != '=') {
        return complain("--set", "'%s' is not NAME=VALUE", assignment);
    }
    for (i = 0; i < threshold_count; i++) {
        if (strlen(thresholds[i].name) == length && strncmp(thresholds[i].name, assignment, length) == 0) {
            return parse(member(config, &thresholds[i]), &thresholds[i], assignment + length + 1);
        }
    }
    return complain("--set", "no threshold is named '%.*s'; see drogue --help-config", (int)length, assignment);
}

void settings_print(void)
{
    drogue_config defaults;
    char value[DECIMAL_TEXT];
    char range[RANGE_TEXT];
    int i;
    drogue_config_default(&defaults);
    printf("%-22s %-10s %-20s %s\n", "--set NAME", "default", "range", "unit, effect");
    for (i = 0; i < threshold_count; i++) {
        format(value, &thresholds[i], *member(&defaults, &thresholds[i]));
        format_range(range, &thresholds[i]);
        printf("%-22s %-10s %-20s %s\n", thresholds[i].name, value, range, thresholds[i].unit);
    }
}
