/* Hash map with keys of four numbers, for faces and positions. */
#ifndef SBFI_KEY_SET_H
#define SBFI_KEY_SET_H

#include "base/memory.h"

typedef struct sbfi_key {
  uint32_t at[4];
} sbfi_key;

typedef struct sbfi_key_set {
  sbfi_key *keys;
  uint32_t *values; /* UINT32_MAX: free */
  size_t slot_count;
} sbfi_key_set;

/* Allocates for `capacity` keys from the arena; false if memory runs out. */
bool sbfi_key_set_init(sbfi_key_set *set, size_t capacity, sbfi_arena *arena);

/* Pointer to the value of the key, which is UINT32_MAX for a new key: the caller then writes one. */
uint32_t *sbfi_key_set_find(sbfi_key_set *set, sbfi_key key);

/* The key with its first `count` numbers in ascending order. */
sbfi_key sbfi_key_sorted(sbfi_key key, int count);

/* Positions are equal if their numbers are; 0 equals -0. */
sbfi_key sbfi_key_of_position(sbf_vec3 position);

#endif
