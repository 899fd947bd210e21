/* Text to float32, correctly rounded, with integers only, so that the rounding mode does not matter.
 *
 * A decimal w * 10^q, w of at most 19 digits, is multiplied by a 64-bit significand of 10^q; the product
 * gives an interval that contains the exact value, with a relative width of 2^-57. If both ends round to the
 * same float32, that is the result. Otherwise (exact ties, and about one other number in 2^33) the exact
 * decimal is compared with the single tie inside the interval, using long integers. The two steps follow W.
 * D. Clinger, "How to read floating point numbers accurately", PLDI 1990; D. Lemire, "Number parsing at a
 * gigabyte per second", Software: Practice and Experience 51(8), 2021; we keep 64 bits of each power instead
 * of 128, since a float32 leaves 39 bits of slack. */
#include "base/number.h"

#include <string.h>

#include "base/number_powers.h"

enum {
  SHORT_DIGITS = 19, /* always fit 64 bits */
  LONG_DIGITS = 120, /* a tie between two float32 has at most 113 significant digits */
  LIMB_COUNT = 24    /* 768 bits, enough for compare_with_tie */
};

/* The digits of one number as they stand in the text: [first, last) with at most one point among them. */
typedef struct digit_run {
  const char *first, *last;
  int64_t exponent; /* of ten, if the point were after the last digit */
  bool negative;
} digit_run;

static inline bool is_digit(char c) {
  return (unsigned char)(c - '0') < 10;
}

static int leading_zeros(uint64_t value) {
#if defined(__GNUC__)
  return __builtin_clzll(value);
#else
  int count = 0;
  for (; !(value >> 63); value <<= 1) count++;
  return count;
#endif
}

/* The upper half of a * b. */
static uint64_t multiply_high(uint64_t a, uint64_t b) {
  uint64_t al = (uint32_t)a, ah = a >> 32, bl = (uint32_t)b, bh = b >> 32;
  uint64_t middle = ah * bl + (al * bl >> 32), other = al * bh + (uint32_t)middle;
  return ah * bh + (middle >> 32) + (other >> 32);
}

/* An unsigned integer, least limb first. */
typedef struct long_integer {
  uint32_t limb[LIMB_COUNT];
  int count;
} long_integer;

static void multiply_add(long_integer *n, uint32_t factor, uint32_t addend) {
  uint64_t carry = addend;
  for (int i = 0; i < n->count; i++) {
    carry += (uint64_t)n->limb[i] * factor;
    n->limb[i] = (uint32_t)carry;
    carry >>= 32;
  }
  if (carry) n->limb[n->count++] = (uint32_t)carry;
}

static void multiply_by_power_of_five(long_integer *n, int64_t power) {
  for (; power >= 13; power -= 13) multiply_add(n, 1220703125, 0);
  for (; power > 0; power--) multiply_add(n, 5, 0);
}

static void shift_left(long_integer *n, int64_t bits) {
  int limbs = (int)(bits / 32);
  memmove(n->limb + limbs, n->limb, (size_t)n->count * sizeof n->limb[0]);
  memset(n->limb, 0, (size_t)limbs * sizeof n->limb[0]);
  n->count += limbs;
  multiply_add(n, UINT32_C(1) << bits % 32, 0);
}

static int compare(const long_integer *a, const long_integer *b) {
  if (a->count != b->count) return a->count < b->count ? -1 : 1;
  for (int i = a->count - 1; i >= 0; i--)
    if (a->limb[i] != b->limb[i]) return a->limb[i] < b->limb[i] ? -1 : 1;
  return 0;
}

/* Compares the exact value of the digits with tie * 2^exponent; tie is odd and below 2^26.
 *
 * Digits after the first LONG_DIGITS count only as "slightly more". That is exact, because the tie has no
 * digits there: if the kept digits are below the tie, so are all digits; if they are equal, the remaining
 * digits decide. The two numbers agree within a factor of four, so after shifting both to one scale neither
 * is much longer than the longer one before: 120 digits take 399 bits, 2^26 * 5^166 (for the smallest
 * subnormal) takes 412. Positive powers stay small, since the number is below 10^39. */
static int compare_with_tie(const digit_run *run, uint32_t tie, int exponent) {
  long_integer a = {.count = 0}, b = {.limb = {tie}, .count = 1};
  int64_t power = run->exponent;
  int taken = 0;
  bool more = false;
  for (const char *at = run->first; at < run->last; at++) {
    if (*at == '.' || (taken == 0 && *at == '0')) continue;
    if (taken < LONG_DIGITS) {
      multiply_add(&a, 10, (uint32_t)(*at - '0'));
      taken++;
    } else {
      more |= *at != '0';
      power++;
    }
  }
  if (power > 0) multiply_by_power_of_five(&a, power);
  if (power < 0) multiply_by_power_of_five(&b, -power);
  int64_t shift = power - exponent;
  if (shift > 0) shift_left(&a, shift);
  if (shift < 0) shift_left(&b, -shift);
  int order = compare(&a, &b);
  return order == 0 && more ? 1 : order;
}

/* Bits of the float32 nearest to digits * 10^power, digits not 0; 0x7F800000 if infinite. `run` is the whole
 * number; `digits` may be only its first 19 digits. */
static uint32_t nearest_f32(const digit_run *run, uint64_t digits, int64_t power) {
  if (power > 38) return 0x7F800000;    /* at least 10^39 */
  if (power < SBFI_POWER_MIN) return 0; /* less than 10^19 * 10^-66, below half the smallest subnormal */
  int zeros = leading_zeros(digits);
  /* The exact value is in (high - 1, high + 17) * 2^exponent. The significand of the power is too small by
   * less than 1, which adds less than 1 to the product's upper half. Digits beyond the nineteenth add less
   * than 1 to `digits`, shifted by at most 4, so less than 16. Halving, to leave a bit for sums, drops a
   * half. */
  uint64_t high = multiply_high(digits << zeros, sbfi_power_significand((int)power)) >> 1;
  int exponent = 65 + sbfi_log2_of_power((int)power) - 63 - zeros;
  /* Bits of `high` below the last bit of the float: 24 of 62 or 63 are kept, fewer for a subnormal. */
  int drop = high >> 62 ? 39 : 38;
  if (drop + exponent < -149) drop = -149 - exponent;
  if (drop > 64) return 0; /* at most a quarter of the smallest subnormal */
  uint32_t above = 1, below = 0;
  if (drop < 63) {
    uint64_t half = UINT64_C(1) << (drop - 1);
    above = (uint32_t)((high + 17 + half) >> drop);
    below = (uint32_t)((high - 1 + half) >> drop);
  }
  uint32_t rounded = above;
  if (above != below) {
    int order = compare_with_tie(run, 2 * above - 1, exponent + drop - 1);
    if (order < 0 || (order == 0 && (above & 1))) rounded--;
  }
  /* The leading bit of a normal number, and a carry out of the significand, increment the exponent field. */
  return ((uint32_t)(exponent + drop + 149) << 23) + rounded;
}

/* Returns the first 19 significant digits of a longer run, and the number of digits after them. */
static int64_t first_digits(const digit_run *run, uint64_t *digits) {
  int taken = 0;
  int64_t left = 0;
  *digits = 0;
  for (const char *at = run->first; at < run->last; at++) {
    if (*at == '.') continue;
    if (taken < SHORT_DIGITS) {
      *digits = *digits * 10 + (uint64_t)(*at - '0');
      if (*digits) taken++;
    } else {
      left++;
    }
  }
  return left;
}

/* Reads "[+-]? digits" after the "e"; saturates beyond any exponent that a text's length can offset. */
static const char *scan_exponent(const char *at, const char *end, int64_t *exponent) {
  bool negative = at < end && *at == '-';
  if (at < end && (*at == '-' || *at == '+')) at++;
  int64_t value = 0;
  for (; at < end && is_digit(*at); at++)
    if (value < INT64_C(100000000000000000)) value = value * 10 + (*at - '0');
  *exponent = negative ? -value : value;
  return at;
}

sbfi_number_status sbfi_scan_f32(const char *text, size_t length, float *value, size_t *used) {
  const char *at = text, *end = text + length;
  digit_run run = {.negative = at < end && *at == '-'};
  if (at < end && (*at == '-' || *at == '+')) at++;
  run.first = at;
  uint64_t digits = 0; /* wraps after 19 digits; then they are read again */
  int64_t count, fraction = 0;
  for (; at < end && is_digit(*at); at++) digits = digits * 10 + (uint64_t)(*at - '0');
  count = at - run.first;
  if (at < end && *at == '.') {
    const char *point = at++;
    for (; at < end && is_digit(*at); at++) digits = digits * 10 + (uint64_t)(*at - '0');
    fraction = at - point - 1;
    count += fraction;
  }
  run.last = at;
  *used = (size_t)(at - text);
  if (count == 0) return SBFI_NUMBER_MALFORMED;
  if (at < end && (*at == 'e' || *at == 'E')) {
    at = scan_exponent(at + 1, end, &run.exponent);
    *used = (size_t)(at - text);
    if (!is_digit(at[-1])) return SBFI_NUMBER_MALFORMED;
  }
  run.exponent -= fraction;
  int64_t power = run.exponent;
  if (count > SHORT_DIGITS) power += first_digits(&run, &digits);
  uint32_t bits = digits ? nearest_f32(&run, digits, power) : 0;
  if (bits >= 0x7F800000) return SBFI_NUMBER_OUT_OF_RANGE;
  bits |= (uint32_t)run.negative << 31;
  memcpy(value, &bits, sizeof bits);
  return SBFI_NUMBER_READ;
}

/* Reads an integer as sign and magnitude; the magnitude saturates above 2^32. */
static bool scan_integer(const char *text, size_t length, bool *negative, uint64_t *size, size_t *used) {
  const char *at = text, *end = text + length;
  *negative = at < end && *at == '-';
  if (at < end && (*at == '-' || *at == '+')) at++;
  const char *first = at;
  *size = 0;
  for (; at < end && is_digit(*at); at++)
    if (*size <= UINT32_MAX) *size = *size * 10 + (uint64_t)(*at - '0');
  *used = (size_t)(at - text);
  return at > first;
}

sbfi_number_status sbfi_scan_i32(const char *text, size_t length, int32_t *value, size_t *used) {
  bool negative;
  uint64_t size;
  if (!scan_integer(text, length, &negative, &size, used)) return SBFI_NUMBER_MALFORMED;
  if (size > (uint64_t)INT32_MAX + negative) return SBFI_NUMBER_OUT_OF_RANGE;
  *value = (int32_t)(negative ? -(int64_t)size : (int64_t)size);
  return SBFI_NUMBER_READ;
}

sbfi_number_status sbfi_scan_u32(const char *text, size_t length, uint32_t *value, size_t *used) {
  bool negative;
  uint64_t size;
  if (!scan_integer(text, length, &negative, &size, used)) return SBFI_NUMBER_MALFORMED;
  if (size > (negative ? 0 : UINT32_MAX)) return SBFI_NUMBER_OUT_OF_RANGE;
  *value = (uint32_t)size;
  return SBFI_NUMBER_READ;
}

sbfi_number_status sbfi_parse_f32(const char *text, size_t length, float *value) {
  size_t used;
  float read;
  sbfi_number_status status = sbfi_scan_f32(text, length, &read, &used);
  if (status != SBFI_NUMBER_MALFORMED && used != length) return SBFI_NUMBER_MALFORMED;
  if (status == SBFI_NUMBER_READ) *value = read;
  return status;
}

sbfi_number_status sbfi_parse_i32(const char *text, size_t length, int32_t *value) {
  size_t used;
  int32_t read;
  sbfi_number_status status = sbfi_scan_i32(text, length, &read, &used);
  if (status != SBFI_NUMBER_MALFORMED && used != length) return SBFI_NUMBER_MALFORMED;
  if (status == SBFI_NUMBER_READ) *value = read;
  return status;
}

sbfi_number_status sbfi_parse_u32(const char *text, size_t length, uint32_t *value) {
  size_t used;
  uint32_t read;
  sbfi_number_status status = sbfi_scan_u32(text, length, &read, &used);
  if (status != SBFI_NUMBER_MALFORMED && used != length) return SBFI_NUMBER_MALFORMED;
  if (status == SBFI_NUMBER_READ) *value = read;
  return status;
}
