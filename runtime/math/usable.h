/* Checks numbers of the host: not NaN, and not above a bound that no host needs. */
#ifndef SBRI_USABLE_H
#define SBRI_USABLE_H

#include <stdbool.h>
#include <stdint.h>

#define SBRI_MAX_NUMBER 1e15

static inline bool sbri_usable(const double *numbers, uint32_t count) {
  for (uint32_t i = 0; i < count; i++)
    if (!(numbers[i] >= -SBRI_MAX_NUMBER && numbers[i] <= SBRI_MAX_NUMBER)) return false;
  return true;
}

#endif
