/* SPDX-License-Identifier: Apache-2.0 */
/* Decimal numbers as people write them, to and from integers: exact, the same on every machine. */
#ifndef CLI_DECIMAL_H
#define CLI_DECIMAL_H

#include <stddef.h>
#include <stdint.h>

#include "drogue/fixed.h"

/* A number as written: [+-] digits [. digits] [e [+-] digits], at least one digit before the exponent. */
typedef struct decimal {
    const char *digits; /* from the first digit or the point on */
    size_t length;      /* characters up to the exponent, the point included */
    int32_t top_place;  /* power of ten of the first digit; +-DECIMAL_FAR when farther */
    int negative;
} decimal;

#define DECIMAL_FAR 1000000000

/* Some places of a number. */
typedef struct decimal_window {
    uint64_t value; /* the digits at the places, as an integer in units of the lowest */
    int above;      /* 1: a digit other than 0 above the places */
    int below;      /* 1: a digit other than 0 below them */
} decimal_window;

typedef enum decimal_status { DECIMAL_OK, DECIMAL_NO_NUMBER, DECIMAL_OUT_OF_RANGE } decimal_status;

/* Read a number that fills the whole text.
 *
 *  text    length characters; spaces, hexadecimal digits, "nan" and "inf" are no number
 *  return  DECIMAL_OK, DECIMAL_NO_NUMBER
 */
decimal_status decimal_parse(decimal *out, const char *text, size_t length);

/* The digits at the places 10^high .. 10^low, at most 19 of them. */
decimal_window decimal_digits(const decimal *number, int32_t high, int32_t low);

/* Read a number as Q16, rounded to nearest, ties toward +infinity, whatever the count of digits.
 *
 *  return  DECIMAL_OK, DECIMAL_NO_NUMBER, DECIMAL_OUT_OF_RANGE when it rounds to no Q16
 */
decimal_status decimal_to_q16(drogue_q16 *out, const char *text, size_t length);

#define DECIMAL_TEXT 24 /* bytes that a number needs as text */

/* Write value / 10^decimals; decimals in [1, 6]. */
void decimal_format(char out[DECIMAL_TEXT], int64_t value, int decimals);

/* Write a Q16 number, or an angle of rad Q16 in degrees, rounded to so many decimals. */
void decimal_format_q16(char out[DECIMAL_TEXT], drogue_q16 value, int decimals);
void decimal_format_degrees(char out[DECIMAL_TEXT], drogue_q16 angle_rad_q16, int decimals);

/* Write value / 2^frac_bits with so many significant digits, rounded to nearest, ties toward +infinity; without zeros
 * at the end, but for one decimal. From 10^-4 up to 10^6 as in 0.00123, otherwise as in 1.23e-09.
 *
 *  frac_bits  [1, 59]
 *  digits     [2, 9]
 *  text       is never longer than DECIMAL_TEXT
 */
void decimal_format_binary(char out[DECIMAL_TEXT], int64_t value, int frac_bits, int digits);

/* Write an angle of rad Q32 in degrees, with so many significant digits; |angle| < 2^40. */
void decimal_format_degrees_q32(char out[DECIMAL_TEXT], int64_t angle_rad_q32, int digits);

/* Drop zeros at the end, but for the first decimal. */
void decimal_trim(char text[DECIMAL_TEXT]);

#endif
