#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "float_bits.h"
#include "harness.h"

static uint64_t random_state = UINT64_C(0xD1B54A32D192ED03);

static const char *printed(float value) {
  static char text[64];
  memset(text, '#', sizeof text);
  size_t length = sbfi_print_f32(text, value);
  ck_assert_uint_le(length, SBFI_F32_TEXT_SIZE);
  ck_assert_msg(text[SBFI_F32_TEXT_SIZE] == '#', "wrote beyond the room it asks for");
  text[length] = 0;
  return text;
}

START_TEST(the_layout_is_the_canonical_one)
{
  const struct {
    float value;
    const char *text;
  } cases[] = {{0, "0"}, {-0.0f, "-0"}, {1, "1"}, {-1, "-1"}, {0.1f, "0.1"}, {0.5f, "0.5"}, {1000, "1000"},
      {10000, "10000"}, {100000, "1e+05"}, {120000, "120000"}, {0.001f, "0.001"}, {0.0001f, "1e-04"},
      {0.00012f, "0.00012"}, {1.5e-7f, "1.5e-07"}, {1e-10f, "1e-10"}, {1.5e20f, "1.5e+20"},
      {123.456f, "123.456"}, {16777216, "16777216"}, {123456792, "123456792"},
      {1.2345678e12f, "1234567823360"}, {1.2345679e13f, "1.2345679e+13"}, {3.4028235e38f, "3.4028235e+38"},
      {-1.17549435e-38f, "-1.1754944e-38"}, {1e-45f, "1e-45"}, {3.14159274f, "3.1415927"},
      {0.00012345679f, "0.00012345679"}, {1.2345679e-5f, "1.2345679e-05"}, {9.999999e-5f, "9.999999e-05"}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
    ck_assert_str_eq(printed(cases[i].value), cases[i].text);
}
END_TEST

START_TEST(non_finite_numbers_are_not_printed)
{
  char untouched = '#';
  ck_assert_uint_eq(sbfi_print_f32(&untouched, INFINITY), 0);
  ck_assert_uint_eq(sbfi_print_f32(&untouched, -INFINITY), 0);
  ck_assert_uint_eq(sbfi_print_f32(&untouched, NAN), 0);
  ck_assert_int_eq(untouched, '#');
}
END_TEST

/* The significant digits of a printed number as a whole number, its exponent of ten, and how many they are.
 */
static int digits_of(const char *text, long *digits, int *exponent) {
  int count = 0, point = 0, zeros = 0;
  *digits = *exponent = 0;
  for (; *text && *text != 'e'; text++) {
    if (*text == '.') point = 1;
    if (*text < '0' || *text > '9') continue;
    *exponent -= point;
    if (*text == '0') {
      zeros += count > 0;
      continue;
    }
    for (; zeros; zeros--, count++) *digits *= 10;
    *digits = *digits * 10 + (*text - '0');
    count++;
  }
  *exponent += zeros + (*text == 'e' ? atoi(text + 1) : 0);
  return count;
}

static bool reads_back(long digits, int exponent, float value) {
  char text[40];
  snprintf(text, sizeof text, "%lde%d", digits, exponent);
  return bits_of(strtof(text, NULL)) == bits_of(value);
}

/* Judged by the C library: the text reads back; no decimal of one digit fewer does; no decimal as long, one
 * step up or down, is nearer. */
static void check_shortest(uint32_t bits) {
  float value = from_bits(bits);
  const char *text = printed(value);
  ck_assert_msg(bits_of(strtof(text, NULL)) == bits, "%08x as %s", (unsigned)bits, text);
  /* A whole number laid out in full may have more digits than the shortest decimal; it is exact. */
  bool whole = strlen(text) > 7 && !strpbrk(text, ".e");
  if (whole) {
    char exact[64];
    snprintf(exact, sizeof exact, "%.0f", (double)value);
    ck_assert_str_eq(text, exact);
    return;
  }
  long digits, shorter;
  int exponent, count = digits_of(text, &digits, &exponent);
  ck_assert_int_le(count, 9);
  if (count > 1) {
    shorter = digits / 10;
    for (long near = shorter; near <= shorter + 1; near++)
      ck_assert_msg(
          !reads_back(near, exponent + 1, value), "%s: %lde%d is shorter", text, near, exponent + 1);
  }
  char nearest[40];
  snprintf(nearest, sizeof nearest, "%.*e", count - 1, (double)value);
  if (bits_of(strtof(nearest, NULL)) == bits) {
    long expected;
    int expected_exponent;
    int expected_count = digits_of(nearest, &expected, &expected_exponent);
    ck_assert_int_eq(expected_count, count);
    ck_assert_msg(expected == digits && expected_exponent == exponent, "%s, nearer %s", text, nearest);
  }
}

START_TEST(every_exponent_gives_the_shortest_and_nearest)
{
  for (uint32_t exponent = 0; exponent < 255; exponent++) {
    const uint32_t fractions[] = {0, 1, 2, 3, 0x2AAAAA, 0x400000, 0x555555, 0x7FFFFE, 0x7FFFFF};
    for (size_t i = 0; i < sizeof fractions / sizeof fractions[0]; i++)
      if (exponent | fractions[i]) check_shortest(exponent << 23 | fractions[i]);
    for (int i = 0; i < 300; i++)
      check_shortest(exponent << 23 | (uint32_t)(random_bits(&random_state) % 0x7FFFFF + 1));
  }
}
END_TEST

START_TEST(the_smallest_subnormals_are_shortest_too)
{
  for (uint32_t bits = 1; bits < 20000; bits++) check_shortest(bits);
}
END_TEST

START_TEST(random_bit_patterns_survive_the_round_trip)
{
  for (long i = 0; i < 10000000; i++) {
    uint32_t bits = (uint32_t)(random_bits(&random_state) >> 16);
    if ((bits & 0x7F800000) == 0x7F800000) continue;
    char text[SBFI_F32_TEXT_SIZE];
    size_t length = sbfi_print_f32(text, from_bits(bits));
    float back;
    if (length == 0 || length > sizeof text || sbfi_parse_f32(text, length, &back) != SBFI_NUMBER_READ ||
        bits_of(back) != bits)
      ck_abort_msg("%08x became %.*s", (unsigned)bits, (int)length, text);
  }
}
END_TEST

START_TEST(locale_and_rounding_mode_change_nothing)
{
  fesetround(FE_UPWARD);
  ck_assert_str_eq(printed(0.3f), "0.3");
  fesetround(FE_TONEAREST);
  if (!setlocale(LC_ALL, "de_DE.UTF-8")) {
    harness_skip("the locale de_DE.UTF-8 is not installed");
    return;
  }
  ck_assert_str_eq(localeconv()->decimal_point, ",");
  ck_assert_str_eq(printed(1234.5f), "1234.5");
}
END_TEST

START_TEST(integers_are_printed)
{
  char text[SBFI_INTEGER_TEXT_SIZE];
  ck_assert_uint_eq(sbfi_print_u64(text, UINT64_MAX), 20);
  ck_assert_mem_eq(text, "18446744073709551615", 20);
  ck_assert_uint_eq(sbfi_print_i32(text, INT32_MIN), 11);
  ck_assert_mem_eq(text, "-2147483648", 11);
  ck_assert_uint_eq(sbfi_print_i32(text, INT32_MAX), 10);
  ck_assert_mem_eq(text, "2147483647", 10);
  ck_assert_uint_eq(sbfi_print_u32(text, 0), 1);
  ck_assert_int_eq(text[0], '0');
  ck_assert_uint_eq(sbfi_print_u32(text, UINT32_MAX), 10);
  ck_assert_mem_eq(text, "4294967295", 10);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("number_print");
  TCase *c = tcase_create("float32");
  tcase_add_test(c, the_layout_is_the_canonical_one);
  tcase_add_test(c, non_finite_numbers_are_not_printed);
  tcase_add_test(c, every_exponent_gives_the_shortest_and_nearest);
  tcase_add_test(c, the_smallest_subnormals_are_shortest_too);
  tcase_add_test(c, random_bit_patterns_survive_the_round_trip);
  tcase_add_test(c, locale_and_rounding_mode_change_nothing);
  suite_add_tcase(s, c);
  c = tcase_create("integers");
  tcase_add_test(c, integers_are_printed);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
