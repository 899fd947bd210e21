#include "shapes/sides.h"

static uint32_t bucket_of(uint32_t low, uint32_t high, uint32_t mask) {
  return (low * 0x9e3779b1u ^ high * 0x85ebca6bu) & mask;
}

static uint32_t next_of(uint32_t side) {
  return side / 3 * 3 + (side % 3 + 1) % 3;
}

static uint32_t third_of(uint32_t side) {
  return side / 3 * 3 + (side % 3 + 2) % 3;
}

void sbri_sides_find(const uint32_t *corners, uint32_t count, uint32_t *beside, uint32_t *table) {
  uint32_t mask = sbri_sides_table(count) - 1;
  for (uint32_t i = 0; i <= mask; i++) table[i] = UINT32_MAX;
  for (uint32_t i = 0; i < 3 * count; i++) {
    uint32_t a = corners[i], b = corners[next_of(i)], low = a < b ? a : b, high = a < b ? b : a;
    uint32_t at = bucket_of(low, high, mask);
    for (; table[at] != UINT32_MAX; at = (at + 1) & mask) {
      uint32_t c = corners[table[at]], d = corners[next_of(table[at])];
      if ((c < d ? c : d) == low && (c < d ? d : c) == high) break;
    }
    beside[i] = table[at] == UINT32_MAX ? SBRI_RIM : SBRI_SAME_SIDE;
    if (table[at] == UINT32_MAX)
      table[at] = i;
    else
      beside[table[at]] = corners[third_of(i)];
  }
}
