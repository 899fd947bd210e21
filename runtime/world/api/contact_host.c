/* Public calls for contacts between bodies: sbrun/collision.h. */
#include "base/diagnostic.h"
#include "coupling/body_contact/body_contacts.h"

enum { DEFAULT_CONTACTS = 4096, MAX_CONTACTS = 1 << 24 };

static bool make(sbr_world *world, uint32_t contacts) {
  size_t characters = world->character_capacity;
  const sbf_allocator *a = &world->allocator;
  sbri_body_contacts *all = sbfi_allocate(a, sizeof *all);
  if (!all) return false;
  *all = (sbri_body_contacts){.character_capacity = world->character_capacity, .contact_capacity = contacts};
  world->body_contacts = all;
  all->arenas = sbfi_allocate(a, characters * sizeof *all->arenas);
  all->surfaces = sbfi_allocate(a, characters * sizeof *all->surfaces);
  all->level_surfaces = sbfi_allocate(a, characters * sizeof *all->level_surfaces);
  all->hulls = sbfi_allocate(a, characters * sizeof *all->hulls);
  all->rest_relations = sbfi_allocate(a, characters * sizeof *all->rest_relations);
  all->group_of = sbfi_allocate(a, characters * sizeof *all->group_of);
  all->member_of = sbfi_allocate(a, characters * sizeof *all->member_of);
  all->next_of_group = sbfi_allocate(a, characters * sizeof *all->next_of_group);
  all->members = sbfi_allocate(a, characters * sizeof *all->members);
  all->groups = sbfi_allocate(a, characters * sizeof *all->groups);
  all->pairs = sbfi_allocate(a, contacts * sizeof *all->pairs);
  all->found_pairs = sbfi_allocate(a, contacts * sizeof *all->found_pairs);
  all->contacts = sbfi_allocate(a, contacts * sizeof *all->contacts);
  all->constraints = sbfi_allocate(a, contacts * sizeof *all->constraints);
  all->cached = sbfi_allocate(a, contacts * sizeof *all->cached);
  all->next_cached = sbfi_allocate(a, contacts * sizeof *all->next_cached);
  all->touching = sbfi_allocate(a, contacts * sizeof *all->touching);
  all->next_touching = sbfi_allocate(a, contacts * sizeof *all->next_touching);
  for (all->table_capacity = 1; all->table_capacity < 2 * contacts;) all->table_capacity *= 2;
  all->cache_table = sbfi_allocate(a, all->table_capacity * sizeof *all->cache_table);
  for (uint32_t i = 0; all->cache_table && i < all->table_capacity; i++) all->cache_table[i] = UINT32_MAX;
  for (size_t i = 0; all->surfaces && i < characters; i++) all->surfaces[i] = NULL;
  for (size_t i = 0; all->level_surfaces && i < characters; i++) all->level_surfaces[i] = NULL;
  bool good = all->arenas && all->surfaces && all->level_surfaces && all->hulls && all->rest_relations &&
              all->group_of && all->member_of && all->next_of_group && all->members && all->groups &&
              all->pairs && all->found_pairs && all->contacts && all->constraints && all->cached &&
              all->next_cached && all->touching && all->next_touching && all->cache_table &&
              sbri_body_contacts_reserve(world, NULL);
  for (uint32_t i = 0; good && i < characters; i++) {
    all->group_of[i] = UINT32_MAX;
    if (world->characters[i].model) good = sbri_contact_surfaces_create(world, i);
  }
  if (!good) sbri_body_contacts_free(world);
  return good;
}

sbf_status sbr_world_enable_body_contacts(sbr_world *world, uint32_t max_contacts, sbf_diagnostic *error) {
  if (!world || max_contacts > MAX_CONTACTS)
    return sbfi_diagnose(error, SBF_CODE_BAD_CALL,
        "sbr_world_enable_body_contacts: world is NULL, or the capacity exceeds %d contacts",
        (int)MAX_CONTACTS);
  if (world->body_contacts || make(world, max_contacts ? max_contacts : DEFAULT_CONTACTS)) return SBF_OK;
  return sbfi_diagnose(error, SBF_CODE_OUT_OF_MEMORY, "no memory for contacts between bodies");
}
