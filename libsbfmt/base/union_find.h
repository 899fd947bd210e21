/* Sets of numbers that grow together: each number's parent, itself where it is the root of its set, which is
 * the lowest of it, whatever order they are joined in. By path halving. */
#ifndef SBFI_UNION_FIND_H
#define SBFI_UNION_FIND_H

#include <stdint.h>

/* Each number is a set of its own. */
static inline void sbfi_sets_begin(uint32_t *parents, uint32_t count) {
  for (uint32_t i = 0; i < count; i++) parents[i] = i;
}

static inline uint32_t sbfi_set_root(uint32_t *parents, uint32_t i) {
  while (parents[i] != i) i = parents[i] = parents[parents[i]];
  return i;
}

static inline void sbfi_sets_join(uint32_t *parents, uint32_t a, uint32_t b) {
  a = sbfi_set_root(parents, a);
  b = sbfi_set_root(parents, b);
  parents[a > b ? a : b] = a > b ? b : a;
}

#endif
