#include "build/springs/springs_sides.h"

#include "build/springs/pair_set.h"

bool sbfi_springs_sides(
    sbfi_spring_list *springs, const sbf_uint4 *tetrahedra, uint32_t count, sbfi_arena *arena) {
  static const uint8_t sides[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  sbfi_pair_set known;
  *springs = (sbfi_spring_list){sbfi_arena_allocate(arena, 6 * (size_t)count + 1, sizeof(sbf_uint2)), 0};
  if (!springs->at || !sbfi_pair_set_init(&known, 6 * (size_t)count, arena)) return false;
  for (uint32_t t = 0; t < count; t++)
    for (int s = 0; s < 6; s++) {
      uint32_t a = tetrahedra[t].at[sides[s][0]], b = tetrahedra[t].at[sides[s][1]];
      if (sbfi_pair_set_add(&known, a, b, springs->count) == springs->count)
        springs->at[springs->count++] = (sbf_uint2){{a < b ? a : b, a < b ? b : a}};
    }
  return true;
}
