#include "build/geometry/key_set.h"

#include <string.h>

bool sbfi_key_set_init(sbfi_key_set *set, size_t capacity, sbfi_arena *arena) {
  size_t slots = 16, wanted;
  if (!sbfi_multiply_size(capacity, 2, &wanted)) return false;
  while (slots < wanted) slots *= 2;
  *set = (sbfi_key_set){sbfi_arena_allocate(arena, slots, sizeof *set->keys),
      sbfi_arena_allocate(arena, slots, sizeof *set->values), slots};
  if (!set->keys || !set->values) return false;
  memset(set->values, 0xff, slots * sizeof *set->values);
  return true;
}

static uint64_t mixed(uint64_t x) {
  x = (x ^ x >> 32) * UINT64_C(0x9e3779b97f4a7c15);
  return x ^ x >> 29;
}

uint32_t *sbfi_key_set_find(sbfi_key_set *set, sbfi_key key) {
  uint64_t low = (uint64_t)key.at[0] << 32 | key.at[1], high = (uint64_t)key.at[2] << 32 | key.at[3];
  size_t slot = (size_t)mixed(mixed(low) + high) & (set->slot_count - 1);
  while (set->values[slot] != UINT32_MAX && memcmp(&set->keys[slot], &key, sizeof key) != 0)
    slot = (slot + 1) & (set->slot_count - 1);
  if (set->values[slot] == UINT32_MAX) set->keys[slot] = key;
  return &set->values[slot];
}

sbfi_key sbfi_key_sorted(sbfi_key key, int count) {
  for (int i = 1; i < count; i++)
    for (int k = i; k > 0 && key.at[k] < key.at[k - 1]; k--) {
      uint32_t swap = key.at[k];
      key.at[k] = key.at[k - 1];
      key.at[k - 1] = swap;
    }
  return key;
}

sbfi_key sbfi_key_of_position(sbf_vec3 position) {
  sbfi_key key = {{0, 0, 0, 0}};
  position.x += 0.0f; /* -0 becomes 0 */
  position.y += 0.0f;
  position.z += 0.0f;
  memcpy(key.at, &position, sizeof position);
  return key;
}
