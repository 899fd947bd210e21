/* Numbers by their bits, and bits by chance. */
#ifndef TEST_FLOAT_BITS_H
#define TEST_FLOAT_BITS_H

#include <stdint.h>
#include <string.h>

/* Marsaglia's xorshift64; `state` is never 0. */
static inline uint64_t random_bits(uint64_t *state) {
  *state ^= *state << 13;
  *state ^= *state >> 7;
  return *state ^= *state << 17;
}

static inline uint32_t bits_of(float value) {
  uint32_t bits;
  memcpy(&bits, &value, sizeof bits);
  return bits;
}

static inline float from_bits(uint32_t bits) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

#endif
