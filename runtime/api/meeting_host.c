/* Bodies that meet each other, as hosts ask for it: sbrun/collision.h. */
#include "base/diagnostic.h"
#include "meet/meetings.h"

enum { DEFAULT_TOUCHES = 4096, MOST_TOUCHES = 1 << 24 };

static bool make(sbr_world *world, uint32_t touches) {
  size_t characters = world->character_capacity;
  const sbf_allocator *a = &world->allocator;
  sbri_meetings *all = sbfi_allocate(a, sizeof *all);
  if (!all) return false;
  *all = (sbri_meetings){.character_capacity = world->character_capacity, .touch_capacity = touches};
  world->meetings = all;
  all->arenas = sbfi_allocate(a, characters * sizeof *all->arenas);
  all->surfaces = sbfi_allocate(a, characters * sizeof *all->surfaces);
  all->all_surfaces = sbfi_allocate(a, characters * sizeof *all->all_surfaces);
  all->hulls = sbfi_allocate(a, characters * sizeof *all->hulls);
  all->together = sbfi_allocate(a, characters * sizeof *all->together);
  all->group_of = sbfi_allocate(a, characters * sizeof *all->group_of);
  all->member_of = sbfi_allocate(a, characters * sizeof *all->member_of);
  all->next_of_group = sbfi_allocate(a, characters * sizeof *all->next_of_group);
  all->members = sbfi_allocate(a, characters * sizeof *all->members);
  all->groups = sbfi_allocate(a, characters * sizeof *all->groups);
  all->pairs = sbfi_allocate(a, touches * sizeof *all->pairs);
  all->found_pairs = sbfi_allocate(a, touches * sizeof *all->found_pairs);
  all->touches = sbfi_allocate(a, touches * sizeof *all->touches);
  all->rows = sbfi_allocate(a, touches * sizeof *all->rows);
  all->memories = sbfi_allocate(a, touches * sizeof *all->memories);
  all->next_memories = sbfi_allocate(a, touches * sizeof *all->next_memories);
  all->contacts = sbfi_allocate(a, touches * sizeof *all->contacts);
  all->next_contacts = sbfi_allocate(a, touches * sizeof *all->next_contacts);
  for (all->found_capacity = 1; all->found_capacity < 2 * touches;) all->found_capacity *= 2;
  all->found_memories = sbfi_allocate(a, all->found_capacity * sizeof *all->found_memories);
  for (uint32_t i = 0; all->found_memories && i < all->found_capacity; i++)
    all->found_memories[i] = UINT32_MAX;
  for (size_t i = 0; all->surfaces && i < characters; i++) all->surfaces[i] = NULL;
  for (size_t i = 0; all->all_surfaces && i < characters; i++) all->all_surfaces[i] = NULL;
  bool good = all->arenas && all->surfaces && all->all_surfaces && all->hulls && all->together &&
              all->group_of && all->member_of && all->next_of_group && all->members && all->groups &&
              all->pairs && all->found_pairs && all->touches && all->rows && all->memories &&
              all->next_memories && all->contacts && all->next_contacts && all->found_memories &&
              sbri_meetings_reserve(world, NULL);
  for (uint32_t i = 0; good && i < characters; i++) {
    all->group_of[i] = UINT32_MAX;
    if (world->characters[i].model) good = sbri_meet_surfaces_make(world, i);
  }
  if (!good) sbri_meetings_free(world);
  return good;
}

sbf_status sbr_world_bodies_meet(sbr_world *world, uint32_t touch_capacity, sbf_diagnostic *error) {
  if (!world || touch_capacity > MOST_TOUCHES)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL, "sbr_world_bodies_meet: no world, or more than %d touches",
        (int)MOST_TOUCHES);
  if (world->meetings || make(world, touch_capacity ? touch_capacity : DEFAULT_TOUCHES)) return SBF_OK;
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for bodies that meet each other");
}
