#include "build/springs/pair_set.h"

#include <string.h>

bool sbfi_pair_set_init(sbfi_pair_set *set, size_t capacity, sbfi_arena *arena) {
  size_t slots = 16, wanted;
  if (!sbfi_multiply_size(capacity, 2, &wanted)) return false;
  while (slots < wanted) slots *= 2;
  *set = (sbfi_pair_set){sbfi_arena_allocate(arena, slots, sizeof *set->keys),
      sbfi_arena_allocate(arena, slots, sizeof *set->values), slots};
  if (!set->keys || !set->values) return false;
  memset(set->keys, 0xff, slots * sizeof *set->keys);
  return true;
}

static uint64_t key_of(uint32_t a, uint32_t b) {
  return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
}

/* Slot of the key, or the free one for it (linear probing; a multiplicative hash spreads the neighbouring
 * numbers that are common in meshes). */
static size_t slot_of(const sbfi_pair_set *set, uint64_t key) {
  uint64_t mixed = (key ^ key >> 29) * UINT64_C(0x9e3779b97f4a7c15);
  size_t slot = (size_t)(mixed ^ mixed >> 32) & (set->slot_count - 1);
  while (set->keys[slot] != UINT64_MAX && set->keys[slot] != key) slot = (slot + 1) & (set->slot_count - 1);
  return slot;
}

uint32_t sbfi_pair_set_add(sbfi_pair_set *set, uint32_t a, uint32_t b, uint32_t value) {
  uint64_t key = key_of(a, b);
  size_t slot = slot_of(set, key);
  if (set->keys[slot] == UINT64_MAX) {
    set->keys[slot] = key;
    set->values[slot] = value;
  }
  return set->values[slot];
}

bool sbfi_pair_set_has(const sbfi_pair_set *set, uint32_t a, uint32_t b) {
  return set->keys[slot_of(set, key_of(a, b))] != UINT64_MAX;
}
