/* Powers of ten as 64-bit significands, for the float32 reader and printer. */
#ifndef SBFI_NUMBER_POWERS_H
#define SBFI_NUMBER_POWERS_H

#include <stdint.h>

/* The reader needs 10^-65 .. 10^38, the printer 10^-31 .. 10^45. */
enum { SBFI_POWER_MIN = -65, SBFI_POWER_MAX = 45 };

/* Item n - SBFI_POWER_MIN is floor(10^n * 2^(63 - L)) with L = floor(log2(10^n)): its top bit is set, and
 * 10^n is in [item, item + 1) * 2^(L - 63). */
extern const uint64_t sbfi_power_of_ten[SBFI_POWER_MAX - SBFI_POWER_MIN + 1];

_Static_assert(-1 >> 1 == -1, "the logarithms below rest on an arithmetic right shift");

/* floor(log2(10^n)): 217706 / 2^16 is accurate enough for log2(10) and every |n| of the table. */
static inline int sbfi_log2_of_power(int n) {
  return n * 217706 >> 16;
}

static inline uint64_t sbfi_power_significand(int n) {
  return sbfi_power_of_ten[n - SBFI_POWER_MIN];
}

#endif
