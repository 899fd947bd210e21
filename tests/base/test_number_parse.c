#include <fenv.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "float_bits.h"
#include "harness.h"

static uint64_t random_state = UINT64_C(0x9E3779B97F4A7C15);

/* The C library, in the C locale, is the judge; its infinities are our refusals. The span is copied to the
 * end of an allocation of its size, so that the address sanitizer sees a read behind it. */
static void check_like_strtof(const char *text) {
  size_t length = strlen(text), used;
  char *exact = malloc(length);
  memcpy(exact, text, length);
  float value = 0, expected = strtof(text, NULL);
  sbfi_number_status status = sbfi_scan_f32(exact, length, &value, &used);
  free(exact);
  ck_assert_msg(used == length, "%s: %zu of %zu characters used", text, used, length);
  if (isinf(expected)) {
    ck_assert_msg(status == SBFI_NUMBER_OUT_OF_RANGE, "%s: not refused", text);
  } else {
    ck_assert_msg(status == SBFI_NUMBER_READ, "%s: refused", text);
#ifdef __MINGW32__ /* whose strtof is wrong below the normal numbers: 2.1e-45 is not 1.2e-38 */
    if (fabsf(value) < 1.1754944e-38f) return;
#endif
    ck_assert_msg(
        bits_of(value) == bits_of(expected), "%s: %.9g, not %.9g", text, (double)value, (double)expected);
  }
}

START_TEST(simple_numbers_are_read)
{
  const struct {
    const char *text;
    float value;
  } cases[] = {{"0", 0}, {"1", 1}, {"-1", -1}, {"+1", 1}, {"1.", 1}, {".5", 0.5f}, {"-.5e1", -5},
      {"1.e2", 100}, {"007", 7}, {"1E2", 100}, {"1e+2", 100}, {"1e-2", 0.01f}, {"0.1", 0.1f},
      {"16777217", 16777216}, {"16777219", 16777220}, {"3.4028235e38", 3.4028235e38f},
      {"0e99999999999999999999", 0}, {"1e-99999999999999999999", 0},
      {"3.14159265358979323846264338327950288", 3.14159274f}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    float value = -7;
    ck_assert_msg(sbfi_parse_f32(cases[i].text, strlen(cases[i].text), &value) == SBFI_NUMBER_READ, "%s",
        cases[i].text);
    ck_assert_msg(bits_of(value) == bits_of(cases[i].value), "%s", cases[i].text);
    check_like_strtof(cases[i].text);
  }
}
END_TEST

START_TEST(zero_keeps_its_sign)
{
  float value = 1;
  ck_assert_int_eq(sbfi_parse_f32("-0", 2, &value), SBFI_NUMBER_READ);
  ck_assert_uint_eq(bits_of(value), 0x80000000u);
  ck_assert_int_eq(sbfi_parse_f32("-1e-60", 6, &value), SBFI_NUMBER_READ);
  ck_assert_uint_eq(bits_of(value), 0x80000000u);
  ck_assert_int_eq(sbfi_parse_f32("0.000", 5, &value), SBFI_NUMBER_READ);
  ck_assert_uint_eq(bits_of(value), 0);
}
END_TEST

START_TEST(malformed_numbers_are_refused_where_they_break)
{
  const struct {
    const char *text;
    size_t used;
  } cases[] = {{"", 0}, {".", 1}, {"-", 1}, {"+", 1}, {"-.", 2}, {"e5", 0}, {".e5", 1}, {"1e", 2}, {"1e+", 3},
      {"1.5e-", 5}, {"1ex", 2}, {"--1", 1}, {" 1", 0}, {"nan", 0}, {"inf", 0}, {"-inf", 1}, {"INF", 0},
      {",5", 0}, {"\xC2\xA0", 0}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    float value = 42;
    size_t used = 99, length = strlen(cases[i].text);
    ck_assert_msg(sbfi_scan_f32(cases[i].text, length, &value, &used) == SBFI_NUMBER_MALFORMED, "\"%s\"",
        cases[i].text);
    ck_assert_msg(used == cases[i].used, "\"%s\": at %zu", cases[i].text, used);
    ck_assert_int_eq(sbfi_parse_f32(cases[i].text, length, &value), SBFI_NUMBER_MALFORMED);
    ck_assert(value == 42);
  }
}
END_TEST

START_TEST(parsing_stops_at_the_end_of_the_number)
{
  const struct {
    const char *text;
    size_t used;
    float value;
  } cases[] = {{"1..2", 2, 1}, {"0x1", 1, 0}, {"1,5", 1, 1}, {"1.5 2", 3, 1.5f}, {"1-2", 1, 1},
      {"1e5.5", 3, 1e5f}, {"1e5e5", 3, 1e5f}, {"2f", 1, 2}, {"1_000", 1, 1}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    float value = 42;
    size_t used, length = strlen(cases[i].text);
    ck_assert_int_eq(sbfi_scan_f32(cases[i].text, length, &value, &used), SBFI_NUMBER_READ);
    ck_assert_uint_eq(used, cases[i].used);
    ck_assert(value == cases[i].value);
    ck_assert_int_eq(sbfi_parse_f32(cases[i].text, length, &value), SBFI_NUMBER_MALFORMED);
    ck_assert(value == cases[i].value);
  }
}
END_TEST

START_TEST(the_span_bounds_the_reading)
{
  float value = 0;
  int32_t integer = 0;
  ck_assert_int_eq(sbfi_parse_f32("12.75e1", 2, &value), SBFI_NUMBER_READ);
  ck_assert(value == 12);
  ck_assert_int_eq(sbfi_parse_f32("12.75e1", 6, &value), SBFI_NUMBER_MALFORMED);
  ck_assert_int_eq(sbfi_parse_i32("1234", 3, &integer), SBFI_NUMBER_READ);
  ck_assert_int_eq(integer, 123);
}
END_TEST

START_TEST(the_edges_of_the_range_are_exact)
{
  /* the greatest float32, the tie above it (which rounds to infinity) and just below that tie */
  check_like_strtof("340282346638528859811704183484516925440");
  check_like_strtof("340282356779733661637539395458142568448");
  check_like_strtof("340282356779733661637539395458142568447");
  check_like_strtof("340282356779733661637539395458142568447.9999999999999999999999999999999999999999999");
  check_like_strtof("1e39");
  check_like_strtof("-1e39");
  check_like_strtof("1e999999999999999999999999");
  /* the smallest subnormal, half of it (a tie, to zero), a little more */
  check_like_strtof("1.4e-45");
  check_like_strtof("7.006492321624085354618e-46");
  check_like_strtof("7.0064923216240853546186479164495806564013097093825788587853e-46");
  check_like_strtof("7.006492321624085354618647916449580656401309709382578858785341419448955413429303e-46");
  check_like_strtof("7.006492321624085354618647916449580656401309709382578858785341419448955413429304e-46");
  check_like_strtof("1.17549435e-38");
  check_like_strtof("1.17549428e-38");
}
END_TEST

START_TEST(any_number_of_padding_zeros_is_accepted)
{
  enum { ZEROS = 100000 };
  char *text = malloc(ZEROS + 64);
  float value = 0;
  memset(text, '0', ZEROS + 64);
  memcpy(text, "0.", 2); /* 0.000...0123e+100001 */
  size_t length = ZEROS + (size_t)sprintf(text + ZEROS, "123e%d", ZEROS + 1);
  ck_assert_int_eq(sbfi_parse_f32(text, length, &value), SBFI_NUMBER_READ);
  ck_assert(value == 123);
  memset(text, '0', ZEROS + 64);
  text[0] = '7'; /* 7000...000e-99999 */
  length = ZEROS + (size_t)sprintf(text + ZEROS, "e-%d", ZEROS - 1);
  ck_assert_int_eq(sbfi_parse_f32(text, length, &value), SBFI_NUMBER_READ);
  ck_assert(value == 7);
  free(text);
}
END_TEST

/* Between every float32 tried and the next lies a tie, which goes to the even one; a digit far behind it, or
 * one less at its end, must tip it. */
static void check_tie_above(uint32_t bits) {
  char text[400];
  double tie = ((double)from_bits(bits) + (double)from_bits(bits + 1)) / 2;
  snprintf(text, sizeof text, "%.150e", tie);
  check_like_strtof(text);
  float value = 0;
  ck_assert_int_eq(sbfi_parse_f32(text, strlen(text), &value), SBFI_NUMBER_READ);
  ck_assert_uint_eq(bits_of(value), bits + (bits & 1));
  strchr(text, 'e')[-1] = '1';
  ck_assert_int_eq(sbfi_parse_f32(text, strlen(text), &value), SBFI_NUMBER_READ);
  ck_assert_uint_eq(bits_of(value), bits + 1);
  snprintf(text, sizeof text, "%.40e", tie * (1 - 1e-15));
  ck_assert_int_eq(sbfi_parse_f32(text, strlen(text), &value), SBFI_NUMBER_READ);
  ck_assert_uint_eq(bits_of(value), bits);
}

START_TEST(ties_of_every_exponent_go_to_even)
{
  for (uint32_t exponent = 0; exponent < 255; exponent++) {
    const uint32_t fractions[] = {0, 1, 2, 0x2AAAAA, 0x555555, 0x7FFFFE, 0x7FFFFF};
    for (size_t i = 0; i < sizeof fractions / sizeof fractions[0]; i++)
      if ((exponent << 23 | fractions[i]) < 0x7F7FFFFF) check_tie_above(exponent << 23 | fractions[i]);
    for (int i = 0; i < 20; i++)
      check_tie_above(exponent << 23 | (uint32_t)(random_bits(&random_state) % 0x7FFFFF));
  }
}
END_TEST

START_TEST(random_texts_parse_as_in_the_c_library)
{
  char text[256];
  for (int i = 0; i < 300000; i++) {
    uint64_t whole = random_bits(&random_state) >> random_bits(&random_state) % 64,
             part = random_bits(&random_state) >> random_bits(&random_state) % 64;
    float value = from_bits((uint32_t)random_bits(&random_state));
    switch (i % 4) {
    case 0:
      snprintf(text, sizeof text, "%s%llu.%llue%d", i & 4 ? "-" : "", (unsigned long long)whole,
          (unsigned long long)part, (int)(random_bits(&random_state) % 110) - 70);
      break;
    case 1:
      snprintf(text, sizeof text, "%llu", (unsigned long long)whole);
      break;
    case 2:
      snprintf(
          text, sizeof text, "0.%0*llu", (int)(random_bits(&random_state) % 60), (unsigned long long)part);
      break;
    default:
      if (!isfinite(value)) continue;
      snprintf(text, sizeof text, "%.*e", (int)(random_bits(&random_state) % 30),
          (double)value * (1 + 1e-8 * (double)(random_bits(&random_state) % 9)));
    }
    check_like_strtof(text);
  }
}
END_TEST

START_TEST(rounding_mode_changes_nothing)
{
  const int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  for (int i = 0; i < 3; i++) {
    float value = 0;
    fesetround(modes[i]);
    sbfi_number_status status = sbfi_parse_f32("0.1", 3, &value);
    fesetround(FE_TONEAREST);
    ck_assert_int_eq(status, SBFI_NUMBER_READ);
    ck_assert_uint_eq(bits_of(value), 0x3DCCCCCDu);
  }
}
END_TEST

START_TEST(a_comma_locale_changes_nothing)
{
  if (!setlocale(LC_ALL, "de_DE.UTF-8")) {
    harness_skip("the locale de_DE.UTF-8 is not installed");
    return;
  }
  ck_assert_str_eq(localeconv()->decimal_point, ",");
  float value = 0;
  size_t used;
  ck_assert_int_eq(sbfi_parse_f32("1.5", 3, &value), SBFI_NUMBER_READ);
  ck_assert(value == 1.5f);
  ck_assert_int_eq(sbfi_scan_f32("1,5", 3, &value, &used), SBFI_NUMBER_READ);
  ck_assert_uint_eq(used, 1);
}
END_TEST

START_TEST(integers_are_read_within_their_range)
{
  const struct {
    const char *text;
    sbfi_number_status i32, u32;
    int64_t value;
  } cases[] = {{"0", 0, 0, 0}, {"-0", 0, 0, 0}, {"+12", 0, 0, 12}, {"0012", 0, 0, 12}, {"-1", 0, 2, -1},
      {"2147483647", 0, 0, INT32_MAX}, {"2147483648", 2, 0, INT64_C(2147483648)},
      {"-2147483648", 0, 2, INT32_MIN}, {"-2147483649", 2, 2, 0}, {"4294967295", 2, 0, UINT32_MAX},
      {"4294967296", 2, 2, 0}, {"18446744073709551617", 2, 2, 0}, {"99999999999999999999999999", 2, 2, 0},
      {"", 1, 1, 0}, {"-", 1, 1, 0}, {"+", 1, 1, 0}, {"1.0", 1, 1, 0}, {"1e3", 1, 1, 0}, {"0x1", 1, 1, 0},
      {"12a", 1, 1, 0}, {" 1", 1, 1, 0}, {"99999999999x", 1, 1, 0}};
  for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    int32_t i32 = 42;
    uint32_t u32 = 42;
    size_t length = strlen(cases[i].text);
    ck_assert_msg(sbfi_parse_i32(cases[i].text, length, &i32) == cases[i].i32, "i32 \"%s\"", cases[i].text);
    ck_assert_msg(sbfi_parse_u32(cases[i].text, length, &u32) == cases[i].u32, "u32 \"%s\"", cases[i].text);
    ck_assert_int_eq(i32, cases[i].i32 ? 42 : cases[i].value);
    ck_assert_int_eq(u32, cases[i].u32 ? 42 : cases[i].value);
  }
}
END_TEST

START_TEST(a_scanned_integer_reports_its_length)
{
  uint32_t value;
  int32_t corner;
  size_t used;
  ck_assert_int_eq(sbfi_scan_u32("31/2/3", 6, &value, &used), SBFI_NUMBER_READ);
  ck_assert_uint_eq(value, 31);
  ck_assert_uint_eq(used, 2);
  ck_assert_int_eq(sbfi_scan_i32("-4/", 3, &corner, &used), SBFI_NUMBER_READ);
  ck_assert_int_eq(corner, -4);
  ck_assert_uint_eq(used, 2);
  ck_assert_int_eq(sbfi_scan_i32("/2", 2, &corner, &used), SBFI_NUMBER_MALFORMED);
  ck_assert_uint_eq(used, 0);
  ck_assert_int_eq(sbfi_scan_u32("5000000000 1", 12, &value, &used), SBFI_NUMBER_OUT_OF_RANGE);
  ck_assert_uint_eq(used, 10);
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("number_parse");
  TCase *c = tcase_create("float32");
  tcase_add_test(c, simple_numbers_are_read);
  tcase_add_test(c, zero_keeps_its_sign);
  tcase_add_test(c, malformed_numbers_are_refused_where_they_break);
  tcase_add_test(c, parsing_stops_at_the_end_of_the_number);
  tcase_add_test(c, the_span_bounds_the_reading);
  tcase_add_test(c, the_edges_of_the_range_are_exact);
  tcase_add_test(c, any_number_of_padding_zeros_is_accepted);
  tcase_add_test(c, ties_of_every_exponent_go_to_even);
  tcase_add_test(c, random_texts_parse_as_in_the_c_library);
  tcase_add_test(c, rounding_mode_changes_nothing);
  tcase_add_test(c, a_comma_locale_changes_nothing);
  suite_add_tcase(s, c);
  c = tcase_create("integers");
  tcase_add_test(c, integers_are_read_within_their_range);
  tcase_add_test(c, a_scanned_integer_reports_its_length);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
