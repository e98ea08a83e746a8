/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers of the command line, exact in form, count and range. */
#include "numbers.h"

#include <stdio.h>
#include <string.h>

#include "cli.h"

int numbers_refuse(const char *name, const char *text, size_t length, decimal_status status, const char *range)
{
    if (status == DECIMAL_OUT_OF_RANGE) {
        return complain(name, "'%.*s' is outside %s", (int)length, text, range);
    }
    return complain(name, "'%.*s' is not a decimal number", (int)length, text);
}

size_t numbers_item(const char *list) { return strcspn(list, ","); }

int numbers_count(const char *list)
{
    int n = 1;
    for (; *list != '\0'; list++) {
        n += *list == ',';
    }
    return n;
}

int numbers_q16(drogue_q16 *out, int count, const char *name, const char *list)
{
    int i;
    for (i = 0; i < count; i++) {
        size_t length = numbers_item(list);
        decimal_status status = decimal_to_q16(&out[i], list, length);
        if (status != DECIMAL_OK) {
            return numbers_refuse(name, list, length, status, "[-32768, 32768)");
        }
        list += length + 1;
    }
    return EXIT_MEASURED;
}

int numbers_check_count(const char *name, const char *list, int count)
{
    int given = numbers_count(list);
    if (given != count) {
        return complain(name, "%d numbers separated by commas are wanted, not %d", count, given);
    }
    return EXIT_MEASURED;
}

int numbers_billionths(uint64_t *out, const char *name, const char *text)
{
    decimal number;
    decimal_window window;
    size_t length = strlen(text);
    decimal_status status = decimal_parse(&number, text, length);
    if (status == DECIMAL_OK) {
        window = decimal_digits(&number, 8, -9);
        *out = window.value;
        if (window.above || (number.negative && (window.value != 0 || window.below))) {
            status = DECIMAL_OUT_OF_RANGE;
        }
    }
    return status == DECIMAL_OK ? EXIT_MEASURED : numbers_refuse(name, text, length, status, "[0, 1000000000)");
}

int numbers_whole(int32_t *out, const char *name, const char *text, size_t length, int32_t least, int32_t most)
{
    char range[48];
    decimal number;
    decimal_window whole = {0, 0, 0};
    decimal_status status = decimal_parse(&number, text, length);
    if (status == DECIMAL_OK) {
        whole = decimal_digits(&number, 9, 0);
        if (whole.below) {
            return complain(name, "'%.*s' is not a whole number", (int)length, text);
        }
        if (whole.above || whole.value > INT32_MAX) {
            status = DECIMAL_OUT_OF_RANGE;
        } else {
            *out = number.negative ? -(int32_t)whole.value : (int32_t)whole.value;
            status = *out < least || *out > most ? DECIMAL_OUT_OF_RANGE : DECIMAL_OK;
        }
    }
    snprintf(range, sizeof range, "[%ld, %ld]", (long)least, (long)most);
    return status == DECIMAL_OK ? EXIT_MEASURED : numbers_refuse(name, text, length, status, range);
}
