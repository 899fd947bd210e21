/* A set of unordered pairs of points, each with a number, such as the index of a spring or an edge. */
#ifndef SBFI_PAIR_SET_H
#define SBFI_PAIR_SET_H

#include "base/memory.h"

typedef struct sbfi_pair_set {
  uint64_t *keys; /* UINT64_MAX: free */
  uint32_t *values;
  size_t slot_count; /* a power of two, at least twice the capacity */
} sbfi_pair_set;

/* Allocates capacity for `capacity` pairs in the arena; returns false if memory runs out. */
bool sbfi_pair_set_init(sbfi_pair_set *set, size_t capacity, sbfi_arena *arena);

/* The number of the pair: its first one, or `value` if it is new. `a` and `b` differ. */
uint32_t sbfi_pair_set_add(sbfi_pair_set *set, uint32_t a, uint32_t b, uint32_t value);

bool sbfi_pair_set_has(const sbfi_pair_set *set, uint32_t a, uint32_t b);

#endif
