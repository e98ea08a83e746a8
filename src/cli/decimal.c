/* SPDX-License-Identifier: Apache-2.0 */
/* Decimal numbers to and from integers, without floating point. */
#include "decimal.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "drogue/fixed.h"

#define FIVE_TO_17 UINT64_C(762939453125)

static int is_digit(char c) { return c >= '0' && c <= '9'; }

/* Digits at the start of a text. */
static size_t count_digits(const char *text, size_t length)
{
    size_t n = 0;
    while (n < length && is_digit(text[n])) {
        n++;
    }
    return n;
}

/* [+-] digits that fill the text, clamped to +-DECIMAL_FAR; 0 when it is something else. */
static int parse_exponent(int64_t *out, const char *text, size_t length)
{
    int negative = length > 0 && text[0] == '-';
    size_t i = length > 0 && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    if (i == length || count_digits(text + i, length - i) != length - i) {
        return 0;
    }
    *out = 0;
    for (; i < length && *out < DECIMAL_FAR; i++) {
        *out = *out * 10 + (text[i] - '0');
    }
    if (*out > DECIMAL_FAR) {
        *out = DECIMAL_FAR;
    }
    if (negative) {
        *out = -*out;
    }
    return 1;
}

decimal_status decimal_parse(decimal *out, const char *text, size_t length)
{
    size_t whole, fraction = 0, i;
    int64_t exponent = 0, top;
    i = length > 0 && (text[0] == '-' || text[0] == '+') ? 1 : 0;
    out->negative = length > 0 && text[0] == '-';
    out->digits = text + i;
    whole = count_digits(text + i, length - i);
    i += whole;
    if (i < length && text[i] == '.') {
        fraction = count_digits(text + i + 1, length - i - 1);
        i += 1 + fraction;
    }
    out->length = (size_t)(text + i - out->digits);
    if (whole + fraction == 0) {
        return DECIMAL_NO_NUMBER;
    }
    if (i < length) {
        if ((text[i] != 'e' && text[i] != 'E') || !parse_exponent(&exponent, text + i + 1, length - i - 1)) {
            return DECIMAL_NO_NUMBER;
        }
    }
    top = (int64_t)whole - 1 + exponent;
    out->top_place = (int32_t)(top > DECIMAL_FAR ? DECIMAL_FAR : top < -DECIMAL_FAR ? -DECIMAL_FAR : top);
    return DECIMAL_OK;
}

decimal_window decimal_digits(const decimal *number, int32_t high, int32_t low)
{
    decimal_window window = {0, 0, 0};
    int64_t place = number->top_place;
    int32_t missing;
    size_t i;
    for (i = 0; i < number->length; i++) {
        int digit = number->digits[i] - '0';
        if (number->digits[i] == '.') {
            continue;
        }
        if (place > high) {
            window.above |= digit != 0;
        } else if (place >= low) {
            window.value = window.value * 10 + (uint64_t)digit;
        } else {
            window.below |= digit != 0;
        }
        place--;
    }
    /* The places that the text stops short of are 0; above the window nothing was taken yet. */
    for (missing = low; missing <= high && missing <= place; missing++) {
        window.value *= 10;
    }
    return window;
}

decimal_status decimal_to_q16(drogue_q16 *out, const char *text, size_t length)
{
    decimal number;
    decimal_window whole, fraction;
    uint64_t half_lsb, magnitude;
    int more;
    if (decimal_parse(&number, text, length) != DECIMAL_OK) {
        return DECIMAL_NO_NUMBER;
    }
    /* A tie is a multiple of 2^-17, which has 17 decimals: with these and whether more follow, nothing is lost. */
    whole = decimal_digits(&number, 4, 0);
    fraction = decimal_digits(&number, -1, -17);
    if (whole.above) {
        return DECIMAL_OUT_OF_RANGE;
    }
    half_lsb = (whole.value << 17) + fraction.value / FIVE_TO_17;
    more = fraction.value % FIVE_TO_17 != 0 || fraction.below;
    magnitude = (half_lsb >> 1) + ((half_lsb & 1u) != 0 && (more || !number.negative) ? 1u : 0u);
    if (magnitude > (uint64_t)INT32_MAX + (number.negative ? 1u : 0u)) {
        return DECIMAL_OUT_OF_RANGE;
    }
    *out = (drogue_q16)(number.negative ? -(int64_t)magnitude : (int64_t)magnitude);
    return DECIMAL_OK;
}

static int64_t power_of_ten(int n)
{
    int64_t p = 1;
    while (n-- > 0) {
        p *= 10;
    }
    return p;
}

void decimal_format(char out[DECIMAL_TEXT], int64_t value, int decimals)
{
    char text[DECIMAL_TEXT]; /* from the last character backward */
    uint64_t rest = drogue_abs_u64(value);
    int at = DECIMAL_TEXT;
    int place;
    text[--at] = '\0';
    for (place = 0; at > 2 && (rest > 0 || place <= decimals); place++) {
        if (place == decimals && place > 0) {
            text[--at] = '.';
        }
        text[--at] = (char)('0' + rest % 10);
        rest /= 10;
    }
    if (value < 0) {
        text[--at] = '-';
    }
    memcpy(out, text + at, (size_t)(DECIMAL_TEXT - at));
}

void decimal_format_q16(char out[DECIMAL_TEXT], drogue_q16 value, int decimals)
{
    decimal_format(out, drogue_shr_round_s64(value * power_of_ten(decimals), 16), decimals);
}

/* v * factor / 2^32 rounded to nearest, ties toward +infinity; factor >= 0, the result must fit. */
static int64_t scaled(int64_t v, int64_t factor)
{
    const int64_t low = (int64_t)(uint32_t)v;
    const uint64_t last = (uint64_t)low * (uint32_t)factor + (UINT32_C(1) << 31);
    return (v >> 32) * factor + low * (factor >> 32) + (int64_t)(last >> 32);
}

void decimal_format_degrees(char out[DECIMAL_TEXT], drogue_q16 angle_rad_q16, int decimals)
{
    /* 180 / pi * 10^6 over 2^16, Q32. */
    int64_t millionths = scaled(angle_rad_q16, INT64_C(3754936206169));
    decimal_format(out, drogue_div_round_s64(millionths, power_of_ten(6 - decimals)), decimals);
}

#define WHOLE_PLACES 19 /* of a magnitude up to 2^62 */
#define MOST_PLACES (WHOLE_PLACES + 59)

/* All digits of magnitude / 2^frac_bits, the first at 10^18: frac_bits places after the point are exact. */
static int exact_digits(char digits[MOST_PLACES], uint64_t magnitude, int frac_bits)
{
    const uint64_t mask = (UINT64_C(1) << frac_bits) - 1;
    uint64_t whole = magnitude >> frac_bits;
    uint64_t fraction = magnitude & mask;
    int i;
    for (i = WHOLE_PLACES - 1; i >= 0; i--) {
        digits[i] = (char)(whole % 10);
        whole /= 10;
    }
    for (i = WHOLE_PLACES; i < WHOLE_PLACES + frac_bits; i++) {
        fraction *= 10;
        digits[i] = (char)(fraction >> frac_bits);
        fraction &= mask;
    }
    return i;
}

/* The first 'count' digits from 'first' on as a number, rounded. */
static int64_t rounded(const char *digits, int length, int first, int count, int negative)
{
    int64_t v = 0;
    int next = 0;
    int more = 0;
    int i;
    for (i = first; i < first + count; i++) {
        v = v * 10 + (i < length ? digits[i] : 0);
    }
    if (i < length) {
        next = digits[i];
        for (i++; i < length; i++) {
            more |= digits[i];
        }
    }
    return v + (next > 5 || (next == 5 && (more != 0 || !negative)));
}

/* v / 10^decimals without zeros at the end. */
static void format_trimmed(char out[DECIMAL_TEXT], int64_t v, int decimals, int negative)
{
    while (decimals > 1 && v % 10 == 0) {
        v /= 10;
        decimals--;
    }
    decimal_format(out, negative ? -v : v, decimals);
}

void decimal_format_binary(char out[DECIMAL_TEXT], int64_t value, int frac_bits, int digits)
{
    const int negative = value < 0;
    char all[MOST_PLACES];
    const int length = exact_digits(all, drogue_abs_u64(value), frac_bits);
    int first = 0;
    int power; /* of ten, of the first digit */
    int64_t v;
    if (value == 0) {
        snprintf(out, DECIMAL_TEXT, "0.0");
        return;
    }
    while (all[first] == 0) {
        first++;
    }
    power = WHOLE_PLACES - 1 - first;
    v = rounded(all, length, first, digits, negative);
    if (v == power_of_ten(digits)) {
        v /= 10;
        power++;
    }
    if (power >= -4 && power < 6) {
        for (; digits - 1 - power < 1; digits++) {
            v *= 10;
        }
        format_trimmed(out, v, digits - 1 - power, negative);
    } else {
        format_trimmed(out, v, digits - 1, negative);
        snprintf(out + strlen(out), DECIMAL_TEXT - strlen(out), "e%s%02d", power < 0 ? "-" : "+", abs(power));
    }
}

void decimal_format_degrees_q32(char out[DECIMAL_TEXT], int64_t angle_rad_q32, int digits)
{
    /* 180 / pi, Q48 */
    decimal_format_binary(out, scaled(angle_rad_q32, INT64_C(16127328204063727)), 48, digits);
}

void decimal_trim(char text[DECIMAL_TEXT])
{
    size_t n = strlen(text);
    while (n > 2 && text[n - 1] == '0' && text[n - 2] != '.') {
        n--;
    }
    text[n] = '\0';
}
