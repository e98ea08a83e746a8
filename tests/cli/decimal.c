/* SPDX-License-Identifier: Apache-2.0 */
/* Decimal numbers of the command line and of the output: rounded to nearest from any number of digits, back to
 * the same Q16 from the digits printed. */
#include "suite.h"

#include "decimal.h"

static decimal_status parse(drogue_q16 *out, const char *text)
{
    *out = 12345;
    return decimal_to_q16(out, text, strlen(text));
}

static void must_give(const char *text, int64_t expected)
{
    drogue_q16 value;
    decimal_status status = parse(&value, text);
    MUST(status == DECIMAL_OK && value == expected, "'%s' gives status %d, %ld, not %ld", text, (int)status,
         (long)value, (long)expected);
}

static void must_refuse(const char *text, decimal_status expected)
{
    drogue_q16 value;
    decimal_status status = parse(&value, text);
    MUST(status == expected, "'%s' gives status %d, not %d", text, (int)status, (int)expected);
}

START_TEST(numbers_as_people_write_them)
{
    must_give("0", 0);
    must_give("-0", 0);
    must_give("+1", 65536);
    must_give("1.", 65536);
    must_give(".5", 32768);
    must_give("-.5", -32768);
    must_give("0001.50000", 98304);
    must_give("1465.5", 1465 * 65536 + 32768);
    must_give("15e-1", 98304);
    must_give("1.5E+1", 15 * 65536);
    must_give("0.00000015e7", 98304);
    must_give("150000000000000000000000000000e-29", 98304);
    must_give("0e999999999999999999999999", 0);
    must_give("1e-999999999999999999999999", 0);
    must_give("-1e-9", 0);
    must_give("0.1", 6554);
    must_give("-0.1", -6554);
}
END_TEST

START_TEST(garbage_is_no_number)
{
    static const char *const texts[] = {"",    " ",     "1 ",       " 1",  "+",    "-",        ".",    "-.",
                                        "e5",  ".e5",   "1e",       "1e+", "1e5.", "1e5e",     "1..2", "1.2.3",
                                        "--1", "+-1",   "0x10",     "1x",  "nan",  "NaN",      "inf",  "-inf",
                                        "1,5", "1_000", "INFINITY", "1f",  "1e 5", "\xD9\xA1", "1\n",  "1e0x1"};
    size_t i;
    for (i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        must_refuse(texts[i], DECIMAL_NO_NUMBER);
    }
}
END_TEST

START_TEST(range_ends_where_q16_ends)
{
    must_give("32767.9999847412109375", INT32_MAX);
    must_give("32767.99999237060546874", INT32_MAX);
    must_refuse("32767.99999237060546875", DECIMAL_OUT_OF_RANGE);
    must_refuse("32768", DECIMAL_OUT_OF_RANGE);
    must_give("-32768", INT32_MIN);
    must_give("-32768.00000762939453125", INT32_MIN);
    must_refuse("-32768.000007629394531250000000001", DECIMAL_OUT_OF_RANGE);
    must_refuse("-32769", DECIMAL_OUT_OF_RANGE);
    must_refuse("99999", DECIMAL_OUT_OF_RANGE);
    must_refuse("100000", DECIMAL_OUT_OF_RANGE);
    must_refuse("1e99999999999999999999999", DECIMAL_OUT_OF_RANGE);
    must_refuse("18446744073709551616", DECIMAL_OUT_OF_RANGE);
    must_refuse("-4294967296", DECIMAL_OUT_OF_RANGE);
}
END_TEST

/* |half_lsb| / 2^17 as exact text: 17 decimals, then 'more'. */
static void exact_text(char *out, size_t bytes, int negative, uint64_t half_lsb, const char *more)
{
    const uint64_t five_to_17 = UINT64_C(762939453125);
    snprintf(out, bytes, "%s%lu.%017llu%s", negative ? "-" : "", (unsigned long)(half_lsb >> 17),
             (unsigned long long)((half_lsb & 131071u) * five_to_17), more);
}

START_TEST(ties_go_toward_plus_infinity)
{
    uint64_t seed = 1;
    char text[64];
    int i;
    for (i = 0; i < 100000; i++) {
        int64_t below = rng_range(&seed, 0, INT32_MAX - 1); /* the tie is half an LSB above */
        exact_text(text, sizeof text, 0, 2 * (uint64_t)below + 1, "");
        must_give(text, below + 1);
        exact_text(text, sizeof text, 0, 2 * (uint64_t)below + 1, "0000000000000000001");
        must_give(text, below + 1);
        exact_text(text, sizeof text, 1, 2 * (uint64_t)below + 1, "");
        must_give(text, -below);
        exact_text(text, sizeof text, 1, 2 * (uint64_t)below + 1, "0000000000000000001");
        must_give(text, -below - 1);
        exact_text(text, sizeof text, 0, 2 * (uint64_t)below, "");
        must_give(text, below);
    }
}
END_TEST

/* With six decimals no number lies so near a tie that a double could not tell. */
START_TEST(agrees_with_double)
{
    uint64_t seed = 2;
    int i;
    for (i = 0; i < 200000; i++) {
        int64_t millionths = (int64_t)rng_range(&seed, -32767, 32766) * 1000000 + rng_range(&seed, 0, 999999);
        char text[64];
        snprintf(text, sizeof text, "%llde-6", (long long)millionths);
        must_give(text, q16_of((double)millionths / 1e6));
    }
}
END_TEST

static void must_come_back(drogue_q16 value)
{
    char text[DECIMAL_TEXT];
    decimal_format_q16(text, value, 6);
    must_give(text, value);
    decimal_trim(text);
    must_give(text, value);
    MUST(strchr(text, '.') != NULL && text[strlen(text) - 1] != '.', "%s has no decimal", text);
}

START_TEST(printed_numbers_come_back)
{
    uint64_t seed = 3;
    int32_t i;
    for (i = -70000; i <= 70000; i++) {
        must_come_back(i);
    }
    for (i = 0; i < 500000; i++) {
        must_come_back(rng_s32_any_width(&seed));
    }
    must_come_back(INT32_MAX);
    must_come_back(INT32_MIN);
}
END_TEST

static void must_print(drogue_q16 value, int decimals, const char *expected)
{
    char text[DECIMAL_TEXT];
    decimal_format_q16(text, value, decimals);
    ck_assert_str_eq(text, expected);
}

START_TEST(printed_as_expected)
{
    char text[DECIMAL_TEXT];
    must_print(0, 6, "0.000000");
    must_print(1, 6, "0.000015");
    must_print(-1, 6, "-0.000015");
    must_print(-1, 3, "0.000");
    must_print(98304, 1, "1.5");
    must_print(INT32_MIN, 6, "-32768.000000");
    must_print(INT32_MAX, 6, "32767.999985");
    decimal_format_q16(text, 0, 6);
    decimal_trim(text);
    ck_assert_str_eq(text, "0.0");
    decimal_format_q16(text, 100 * 65536, 6);
    decimal_trim(text);
    ck_assert_str_eq(text, "100.0");
    decimal_format_q16(text, 16384, 6);
    decimal_trim(text);
    ck_assert_str_eq(text, "0.25");
}
END_TEST

START_TEST(degrees_agree_with_double)
{
    uint64_t seed = 4;
    int32_t i;
    for (i = 0; i < 200000; i++) {
        drogue_q16 angle = i < 100000 ? rng_range(&seed, -205887, 205887) : rng_s32_any_width(&seed);
        double expected = real_of_q16(angle) * 180.0 / TEST_PI;
        char text[DECIMAL_TEXT];
        decimal_format_degrees(text, angle, 6);
        MUST(fabs(strtod(text, NULL) - expected) < 1.01e-6, "%ld LSB print as %s degrees, not %.7f", (long)angle, text,
             expected);
        decimal_format_degrees(text, angle, 2);
        MUST(fabs(strtod(text, NULL) - expected) < 0.005002, "%ld LSB print as %s degrees, not %.7f", (long)angle, text,
             expected);
    }
}
END_TEST

START_TEST(windows_of_digits)
{
    static const struct {
        const char *text;
        int32_t high, low;
        uint64_t value;
        int above, below;
    } cases[] = {
        {"12345.678", 2, 0, 345, 1, 1},
        {"12345.678", 4, -3, 12345678, 0, 0},
        {"12345.678", -1, -5, 67800, 1, 0},
        {"5e3", 4, 0, 5000, 0, 0},
        {"5e-3", -1, -4, 50, 0, 0},
        {"0.0005", -1, -3, 0, 0, 1},
        {"007", 1, 0, 7, 0, 0},
        {"1e9", 8, -9, 0, 1, 0},
        {"99.999999999999", 8, -9, UINT64_C(99999999999), 0, 1},
    };
    size_t i;
    for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        decimal number;
        decimal_window window;
        ck_assert_int_eq(decimal_parse(&number, cases[i].text, strlen(cases[i].text)), DECIMAL_OK);
        window = decimal_digits(&number, cases[i].high, cases[i].low);
        ck_assert_uint_eq(window.value, cases[i].value);
        ck_assert_int_eq(window.above, cases[i].above);
        ck_assert_int_eq(window.below, cases[i].below);
    }
}
END_TEST

static void must_print_binary(int64_t value, int frac_bits, int digits, const char *expected)
{
    char text[DECIMAL_TEXT];
    decimal_format_binary(text, value, frac_bits, digits);
    ck_assert_str_eq(text, expected);
}

START_TEST(binary_as_expected)
{
    const int64_t one = INT64_C(1) << 48;
    must_print_binary(0, 48, 6, "0.0");
    must_print_binary(one, 48, 6, "1.0");
    must_print_binary(-one, 48, 6, "-1.0");
    must_print_binary(one / 4, 48, 6, "0.25");
    must_print_binary(1, 48, 6, "3.55271e-15");
    must_print_binary(-1, 48, 6, "-3.55271e-15");
    must_print_binary(1, 1, 6, "0.5");
    must_print_binary(1, 59, 9, "1.73472348e-18");
    must_print_binary(905377, 48, 6, "3.21655e-09"); /* 3.216545... */
    must_print_binary(905377, 48, 4, "3.217e-09");
    must_print_binary(INT64_C(123) << 32, 32, 6, "123.0");
    must_print_binary(INT64_C(123456) << 32, 32, 6, "123456.0");
    must_print_binary(INT64_C(999999) << 32, 32, 6, "999999.0");
    must_print_binary((INT64_C(999999) << 32) + (INT64_C(1) << 31), 32, 6, "1.0e+06"); /* a tie, upward */
    must_print_binary(-((INT64_C(999999) << 32) + (INT64_C(1) << 31)), 32, 6, "-999999.0");
    must_print_binary(-((INT64_C(999999) << 32) + (INT64_C(1) << 31)) - 1, 32, 6, "-1.0e+06");
    must_print_binary(INT64_C(1234567) << 32, 32, 6, "1.23457e+06");
    must_print_binary(INT64_C(5) << 46, 48, 2, "1.3"); /* 1.25: ties toward +infinity */
    must_print_binary(-(INT64_C(5) << 46), 48, 2, "-1.2");
    must_print_binary(-(INT64_C(5) << 46) - 1, 48, 2, "-1.3");
    must_print_binary(28147497671, 48, 6, "0.0001"); /* 1.00000000000e-4, not 9.99999e-05 */
    must_print_binary(28147497000, 48, 6, "0.0001"); /* rounds up to it */
    must_print_binary(28147400000, 48, 6, "9.99997e-05");
    must_print_binary(INT64_MAX, 48, 6, "32768.0");
    must_print_binary(INT64_MIN, 48, 6, "-32768.0");
    must_print_binary(INT64_MAX, 1, 9, "4.61168602e+18");
    must_print_binary(INT64_MIN, 1, 9, "-4.61168602e+18");
}
END_TEST

/* Against printf on a long double, which holds the number exactly, away from ties. */
START_TEST(binary_agrees_with_long_double)
{
    uint64_t seed = 5;
    int i, compared = 0;
    for (i = 0; i < 200000; i++) {
        const int64_t value = rng_s64_any_width(&seed);
        const int frac_bits = rng_range(&seed, 1, 59), digits = rng_range(&seed, 2, 9);
        const long double exact = ldexpl((long double)value, -frac_bits);
        char text[DECIMAL_TEXT], expected[64];
        long double got, unit;
        decimal_format_binary(text, value, frac_bits, digits);
        got = strtold(text, NULL);
        if (value == 0) {
            continue;
        }
        unit = powl(10.0L, floorl(log10l(fabsl(exact))) - digits + 1);
        MUST(fabsl(got - exact) <= 0.5000001L * unit, "%lld / 2^%d prints as %s", (long long)value, frac_bits, text);
        MUST(text[strspn(text, "-")] >= '0' && text[strspn(text, "-")] <= '9' && strchr(text, '.') != NULL,
             "%s is no JSON number", text);
        snprintf(expected, sizeof expected, "%.*Le", digits - 1, exact);
        if (fabsl(fabsl(exact) / unit - floorl(fabsl(exact) / unit) - 0.5L) > 1e-6L) {
            MUST(fabsl(strtold(expected, NULL) - got) < 1e-6L * unit, "%s, not %s", text, expected);
            compared++;
        }
    }
    ck_assert_int_gt(compared, 180000);
}
END_TEST

START_TEST(degrees_q32_agree_with_double)
{
    uint64_t seed = 6;
    char text[DECIMAL_TEXT];
    int i;
    for (i = 0; i < 100000; i++) {
        const int64_t angle = rng_s64_any_width(&seed) >> 23;
        const double expected = (double)angle / 4294967296.0 * 180.0 / TEST_PI;
        decimal_format_degrees_q32(text, angle, 6);
        MUST(fabs(strtod(text, NULL) - expected) <= 5.1e-6 * fabs(expected), "%lld LSB print as %s degrees, not %.9g",
             (long long)angle, text, expected);
    }
    decimal_format_degrees_q32(text, INT64_C(13493037705), 6); /* pi */
    ck_assert_str_eq(text, "180.0");
    decimal_format_degrees_q32(text, 0, 6);
    ck_assert_str_eq(text, "0.0");
}
END_TEST

SUITE_MAIN("decimal", numbers_as_people_write_them, garbage_is_no_number, range_ends_where_q16_ends,
           ties_go_toward_plus_infinity, agrees_with_double, printed_numbers_come_back, printed_as_expected,
           degrees_agree_with_double, windows_of_digits, binary_as_expected, binary_agrees_with_long_double,
           degrees_q32_agree_with_double)
