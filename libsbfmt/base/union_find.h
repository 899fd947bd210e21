/* Union-find with path halving: each number's parent, or itself if it is the root. The root of a set is its
 * lowest number, whatever the order of the unions. */
#ifndef SBFI_UNION_FIND_H
#define SBFI_UNION_FIND_H

#include <stdint.h>

/* Puts each number into its own set. */
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
