/* Times of the last tick, and counts of the world: sbrun/debug.h. */
#include <string.h>

#include "coupling/body_contact/body_contacts.h"

const char *sbr_stage_get_name(sbr_stage stage) {
  static const char *const names[SBR_STAGE_COUNT] = {
      "colliders", "detail", "broad_phase", "animation", "contact_groups", "islands", "events"};
  return (unsigned)stage < SBR_STAGE_COUNT ? names[stage] : "";
}

void sbr_world_set_clock(sbr_world *world, sbr_clock clock) {
  if (!world) return;
  world->timing.clock = clock;
  memset(&world->timing.profile, 0, sizeof world->timing.profile);
}

sbr_profile sbr_world_get_profile(const sbr_world *world) {
  return world ? world->timing.profile : (sbr_profile){0};
}

static void add_island(const sbri_character *c, uint32_t index, sbr_counters *to) {
  const sbri_island *island = &c->model->islands[index];
  const sbri_island_state *state = &sbri_island_states(c)[index];
  bool awake = !state->asleep && !sbri_header(c)->asleep && !sbri_header(c)->paused;
  to->island_count++;
  for (uint32_t slot = 0; slot < island->free_count; slot++) to->point_count += island->masses[slot] > 0;
  to->spring_count += island->springs.count;
  to->element_visit_count += state->element_visits;
  for (uint32_t b = 0; b < island->body_count; b++) {
    uint32_t body = island->bodies[b];
    to->soft_body_count++;
    to->soft_body_awake_count += awake;
    to->tetrahedron_count += c->model->bodies[body].elements.tetrahedron_count;
    if (awake) to->contact_count += sbri_contact_counts(c)[body];
  }
}

sbr_counters sbr_world_get_counters(const sbr_world *world) {
  sbr_counters to = {0};
  if (!world) return to;
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    if (!c->model) continue;
    to.character_count++;
    to.rigid_body_count += c->model->asset->rigid_bodies.count;
    to.state_bytes += c->model->layout.state_size;
    to.memory_bytes += sbri_character_storage_size(c->model);
    for (uint32_t k = 0; k < c->model->island_count; k++) add_island(c, k, &to);
  }
  for (uint32_t i = 0; i < world->colliders.capacity; i++)
    to.collider_count += world->colliders.at[i].shape != NULL;
  if (world->body_contacts) to.body_contact_count = world->body_contacts->pair_reports.count;
  return to;
}
