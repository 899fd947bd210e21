#include "harness.h"

#include <string.h>

#include "base/number_powers.h"

/* 320 bits, least limb first: enough for 10^45 and for 2^279. */
typedef struct wide {
  uint32_t limb[10];
} wide;

static void multiply_by_ten(wide *n) {
  uint64_t carry = 0;
  for (int i = 0; i < 10; i++) {
    carry += (uint64_t)n->limb[i] * 10;
    n->limb[i] = (uint32_t)carry;
    carry >>= 32;
  }
}

static void divide_by_ten(wide *n) {
  uint64_t rest = 0;
  for (int i = 9; i >= 0; i--) {
    rest = rest << 32 | n->limb[i];
    n->limb[i] = (uint32_t)(rest / 10);
    rest %= 10;
  }
}

static int bit(const wide *n, int index) {
  return index < 0 ? 0 : n->limb[index / 32] >> index % 32 & 1;
}

static int bit_length(const wide *n) {
  int length = 320;
  while (length && !bit(n, length - 1)) length--;
  return length;
}

START_TEST(powers_are_the_floor_of_the_exact_value)
{
  for (int n = SBFI_POWER_MIN; n <= SBFI_POWER_MAX; n++) {
    wide power = {{1}};
    for (int i = 0; i < (n < 0 ? -n : n); i++) multiply_by_ten(&power);
    int log2 = n < 0 ? -bit_length(&power) : bit_length(&power) - 1;
    wide exact = power;
    int top = log2;
    if (n < 0) { /* floor(2^(63 - log2) / 10^-n), whose top bit is bit 63 */
      memset(&exact, 0, sizeof exact);
      exact.limb[(63 - log2) / 32] = UINT32_C(1) << (63 - log2) % 32;
      for (int i = 0; i < -n; i++) divide_by_ten(&exact);
      top = 63;
    }
    uint64_t expected = 0;
    for (int i = 0; i < 64; i++) expected = expected << 1 | (uint64_t)bit(&exact, top - i);
    ck_assert_msg(sbfi_power_significand(n) == expected, "10^%d", n);
    ck_assert_msg(sbfi_log2_of_power(n) == log2, "log2 of 10^%d", n);
    ck_assert(expected >> 63);
  }
}
END_TEST

static Suite *suite(void) {
  Suite *s = suite_create("number_powers");
  TCase *c = tcase_create("table");
  tcase_add_test(c, powers_are_the_floor_of_the_exact_value);
  suite_add_tcase(s, c);
  return s;
}

int main(void) {
  return harness_run(suite());
}
