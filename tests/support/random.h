/* A small generator of the tests' own, so that every machine tests the same numbers. */
#ifndef TEST_RANDOM_H
#define TEST_RANDOM_H

#include <stdint.h>

/* The linear congruential one of Numerical Recipes; its lower bits repeat early, so take the upper ones. */
static inline uint32_t random_next(uint32_t *state) {
  return *state = *state * 1664525u + 1013904223u;
}

/* `high` excluded, but for rounding. */
static inline float random_between(uint32_t *state, float low, float high) {
  return low + (high - low) * (float)(random_next(state) >> 8) / 16777216.0f;
}

/* The i-th of numbers that look like chance, from -1 to 1: with nothing kept from one to the next. */
static inline float random_scattered(uint32_t i) {
  return (float)(i * 2654435761u >> 8 & 0xffff) / 32768.0f - 1;
}

#endif
