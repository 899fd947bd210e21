/* float32 to the shortest digits that read back to it, after R. Giulietti, "The Schubfach way to render
 * doubles", 2020 (its float32 form: 64-bit powers, 96-bit products), compared with std::to_chars for each of
 * the 2^31 positive values. The header describes the choice of layout and the exact form of whole numbers. */
#include "base/number.h"

#include <string.h>

#include "base/number_powers.h"

/* digits * 10^exponent, digits below 10^9 and not a multiple of 10. */
typedef struct decimal {
  uint32_t digits;
  int exponent;
} decimal;

/* factor * significand / 2^64 rounded to odd: the last bit is set if something was cut off, so comparisons
 * with whole numbers stay correct. */
static uint32_t multiply_round_to_odd(uint64_t significand, uint32_t factor) {
  uint64_t low = (uint64_t)(uint32_t)significand * factor;
  uint64_t high = (significand >> 32) * factor + (low >> 32);
  return (uint32_t)(high >> 32) | ((uint32_t)high > 1);
}

/* The shortest decimal inside the rounding interval of c * 2^q; of several, the nearest. */
static decimal shortest_decimal(uint32_t c, int q, bool irregular) {
  /* The ends of the interval are inside if ties go to an even c. */
  uint32_t open = c & 1;
  /* Below a power of two floats are twice as dense, so the interval is shorter on that side. */
  uint32_t lower = 4 * c - (irregular ? 1 : 2), upper = 4 * c + 2;
  /* floor(log10(2^q)), or of 3/4 of it if irregular: 10^k is as long as the interval or up to ten times
   * shorter. */
  int k = (q * 1262611 - (irregular ? 524031 : 0)) >> 22;
  int h = q + sbfi_log2_of_power(-k) + 1;
  uint64_t power = sbfi_power_significand(-k) + 1;
  uint32_t value4 = multiply_round_to_odd(power, (4 * c) << h);
  uint32_t lower4 = multiply_round_to_odd(power, lower << h) + open;
  uint32_t upper4 = multiply_round_to_odd(power, upper << h) - open;
  uint32_t below = value4 / 4, digits;
  uint32_t below10 = below / 10 * 10, above10 = below10 + 10;
  bool below10_in = below >= 10 && lower4 <= 4 * below10, above10_in = below >= 10 && 4 * above10 <= upper4;
  if (below10_in != above10_in) { /* not both: the interval is shorter than 10 */
    digits = below10_in ? below10 : above10;
  } else {
    bool below_in = lower4 <= 4 * below, above_in = 4 * (below + 1) <= upper4;
    uint32_t middle4 = 4 * below + 2;
    bool up = below_in != above_in ? above_in : value4 > middle4 || (value4 == middle4 && (below & 1));
    digits = below + up;
  }
  for (; digits % 10 == 0; digits /= 10) k++;
  return (decimal){digits, k};
}

/* Writes the decimal digits of `value` so that they end before `end`; returns their start. */
static char *digits_before(char *end, uint64_t value) {
  do {
    *--end = (char)('0' + value % 10);
    value /= 10;
  } while (value);
  return end;
}

static size_t digits_to(char *to, uint64_t value) {
  char digits[SBFI_INTEGER_TEXT_SIZE], *end = digits + sizeof digits, *first = digits_before(end, value);
  memcpy(to, first, (size_t)(end - first));
  return (size_t)(end - first);
}

/* d.ddde±XX of `count` digits, the first of which stands for 10^exponent. */
static char *write_with_exponent(char *to, const char *digits, int count, int exponent) {
  *to++ = digits[0];
  if (count > 1) {
    *to++ = '.';
    memcpy(to, digits + 1, (size_t)count - 1);
    to += count - 1;
  }
  *to++ = 'e';
  *to++ = exponent < 0 ? '-' : '+';
  if (exponent < 0) exponent = -exponent;
  *to++ = (char)('0' + exponent / 10);
  *to++ = (char)('0' + exponent % 10);
  return to;
}

size_t sbfi_print_f32(char *to, float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  uint32_t field = bits >> 23 & 0xFF, fraction = bits & 0x7FFFFF;
  if (field == 0xFF) return 0;
  char *at = to;
  if (bits >> 31) *at++ = '-';
  if (field == 0 && fraction == 0) {
    *at++ = '0';
    return (size_t)(at - to);
  }
  uint32_t c = field ? fraction | 0x800000 : fraction;
  int q = field ? (int)field - 150 : -149;
  decimal shortest = shortest_decimal(c, q, fraction == 0 && field > 1);

  char buffer[SBFI_INTEGER_TEXT_SIZE], *end = buffer + sizeof buffer;
  const char *digits = digits_before(end, shortest.digits);
  int count = (int)(end - digits), exponent = shortest.exponent + count - 1;
  int length_with_exponent = count + (count > 1) + 4;
  if (exponent < 0) {
    if (1 - exponent + count > length_with_exponent)
      return (size_t)(write_with_exponent(at, digits, count, exponent) - to);
    memcpy(at, "0.00000000", 10);
    at += 1 - exponent;
    memcpy(at, digits, (size_t)count);
    return (size_t)(at + count - to);
  }
  if (shortest.exponent < 0) { /* the point is among the digits */
    memcpy(at, digits, (size_t)exponent + 1);
    at += exponent + 1;
    *at++ = '.';
    memcpy(at, digits + exponent + 1, (size_t)-shortest.exponent);
    return (size_t)(at - shortest.exponent - to);
  }
  if (exponent + 1 > length_with_exponent)
    return (size_t)(write_with_exponent(at, digits, count, exponent) - to);
  /* At most 14 digits after the point, so the whole number fits 64 bits. */
  return (size_t)(at - to) + digits_to(at, q < 0 ? c >> -q : (uint64_t)c << q);
}

size_t sbfi_print_u64(char *to, uint64_t value) {
  return digits_to(to, value);
}

size_t sbfi_print_u32(char *to, uint32_t value) {
  return digits_to(to, value);
}

size_t sbfi_print_i32(char *to, int32_t value) {
  if (value >= 0) return digits_to(to, (uint64_t)value);
  *to = '-';
  return 1 + digits_to(to + 1, (uint64_t) - (int64_t)value);
}
