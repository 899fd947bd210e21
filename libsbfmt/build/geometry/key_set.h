/* A set of keys of four numbers, each with a value: which faces, which positions have been seen before. */
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

/* Room for `capacity` keys in memory of the arena; false where memory runs out. */
bool sbfi_key_set_init(sbfi_key_set *set, size_t capacity, sbfi_arena *arena);

/* Where the value of the key stands, which is UINT32_MAX where the key is new: the caller then writes one. */
uint32_t *sbfi_key_set_find(sbfi_key_set *set, sbfi_key key);

/* The key with its first `count` numbers in ascending order. */
sbfi_key sbfi_key_sorted(sbfi_key key, int count);

/* Places in space are equal where their numbers are; 0 and -0 are. */
sbfi_key sbfi_key_of_position(sbf_vec3 position);

#endif
