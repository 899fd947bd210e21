/* Springs between all pairs of points that have none yet. */
#include "build/springs/pair_set.h"
#include "build/springs/springs.h"

static void enter(sbfi_pair_set *set, const sbfi_spring_list *list) {
  for (uint32_t s = 0; s < list->count; s++) sbfi_pair_set_add(set, list->at[s].at[0], list->at[s].at[1], 0);
}

bool sbfi_springs_brute(
    sbfi_spring_list *springs, uint32_t count, const sbfi_surface_springs *known, sbfi_arena *arena) {
  size_t pairs = (size_t)count * (count - (count > 0)) / 2;
  size_t known_count = (size_t)known->structural.count + known->shear.count + known->flexion.count;
  sbfi_pair_set set;
  *springs = (sbfi_spring_list){NULL, 0};
  if (!sbfi_pair_set_init(&set, known_count + 1, arena)) return false;
  springs->at = sbfi_arena_allocate(arena, pairs + 1, sizeof *springs->at);
  if (!springs->at || pairs > UINT32_MAX) return false;
  enter(&set, &known->structural);
  enter(&set, &known->shear);
  enter(&set, &known->flexion);
  for (uint32_t a = 0; a < count; a++)
    for (uint32_t b = a + 1; b < count; b++)
      if (!sbfi_pair_set_has(&set, a, b)) springs->at[springs->count++] = (sbf_uint2){{a, b}};
  return true;
}
