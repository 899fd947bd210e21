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
  all->shapes.surfaces = sbfi_allocate(a, characters * sizeof *all->shapes.surfaces);
  all->shapes.level_surfaces = sbfi_allocate(a, characters * sizeof *all->shapes.level_surfaces);
  all->shapes.hulls = sbfi_allocate(a, characters * sizeof *all->shapes.hulls);
  all->shapes.rest_relations = sbfi_allocate(a, characters * sizeof *all->shapes.rest_relations);
  all->group_of = sbfi_allocate(a, characters * sizeof *all->group_of);
  all->member_of = sbfi_allocate(a, characters * sizeof *all->member_of);
  all->next_of_group = sbfi_allocate(a, characters * sizeof *all->next_of_group);
  all->members = sbfi_allocate(a, characters * sizeof *all->members);
  all->groups = sbfi_allocate(a, characters * sizeof *all->groups);
  all->pairs = sbfi_allocate(a, contacts * sizeof *all->pairs);
  all->found_pairs = sbfi_allocate(a, contacts * sizeof *all->found_pairs);
  all->contacts = sbfi_allocate(a, contacts * sizeof *all->contacts);
  all->constraints = sbfi_allocate(a, contacts * sizeof *all->constraints);
  all->cache.at = sbfi_allocate(a, contacts * sizeof *all->cache.at);
  all->cache.next = sbfi_allocate(a, contacts * sizeof *all->cache.next);
  all->pair_reports.at = sbfi_allocate(a, contacts * sizeof *all->pair_reports.at);
  all->pair_reports.next = sbfi_allocate(a, contacts * sizeof *all->pair_reports.next);
  for (all->cache.table_capacity = 1; all->cache.table_capacity < 2 * contacts;)
    all->cache.table_capacity *= 2;
  all->cache.table = sbfi_allocate(a, all->cache.table_capacity * sizeof *all->cache.table);
  for (uint32_t i = 0; all->cache.table && i < all->cache.table_capacity; i++)
    all->cache.table[i] = UINT32_MAX;
  for (size_t i = 0; all->shapes.surfaces && i < characters; i++) all->shapes.surfaces[i] = NULL;
  for (size_t i = 0; all->shapes.level_surfaces && i < characters; i++) all->shapes.level_surfaces[i] = NULL;
  bool good = all->arenas && all->shapes.surfaces && all->shapes.level_surfaces && all->shapes.hulls &&
              all->shapes.rest_relations && all->group_of && all->member_of && all->next_of_group &&
              all->members && all->groups && all->pairs && all->found_pairs && all->contacts &&
              all->constraints && all->cache.at && all->cache.next && all->pair_reports.at &&
              all->pair_reports.next && all->cache.table && sbri_body_contacts_reserve(world, NULL);
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
