/* Fills sbri_island_tick, the input of the time integrators: tables, points and contacts of one island.
 * Reports the contacts afterwards. */
#include <string.h>

#include "collide/external_body.h"
#include "contact/contact.h"
#include "math/vec3.h"
#include "skin/skin.h"
#include "soft/soft.h"
#include "solvers/rolling.h"
#include "solvers/scheme.h"
#include "solvers/soft_contacts.h"

void sbri_island_fill_unused_slots(sbri_character *c, const sbri_island *island) {
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    for (uint32_t slot = body->slot_real_end; slot < body->slot_end; slot++)
      positions[slot] = positions[slot / SBRI_BLOCK * SBRI_BLOCK];
    for (uint32_t slot = body->first_spare; slot < body->slot_end && body->slot_real_end > body->first_spare;
         slot++) {
      if (slot < body->slot_real_end && sbri_origins(c)[island->first_slot + slot] != SBRI_UNUSED) continue;
      positions[slot] = positions[body->slot_begin];
      float *v = sbri_velocities(c) + 3 * (size_t)island->first_slot;
      uint32_t to = 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK, from = 3 * body->slot_begin;
      for (uint32_t k = 0; k < 3; k++) v[to + k * SBRI_BLOCK] = v[from + k * SBRI_BLOCK];
    }
  }
}

void sbri_island_prepare_contacts(const sbri_island_tick *tick, sbri_character *c) {
  size_t first = tick->island->first_slot;
  sbri_contact_tables tables = {sbri_near_ground(c) + first / SBRI_BLOCK, sbri_planes(c) + 4 * first,
      sbri_ground_pressing(c) + 2 * first, sbri_contacts(c), sbri_contact_counts(c), NULL, NULL,
      sbri_slot_contacts(c) + first, NULL, NULL, NULL, NULL, NULL, NULL};
  memset(tick->contact_slots, 0, (tick->island->slot_count + SBRI_BLOCK - 1) / SBRI_BLOCK);
  for (uint32_t b = 0; b < tick->island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[tick->island->bodies[b]];
    sbri_skin surface = sbri_skin_now(c, &body->surface);
    tables.surface = &surface;
    tables.external_bodies = &sbri_external_bodies_of(c)[tick->island->bodies[b]];
    tables.touched = &sbri_soft_touching(c)[tick->island->bodies[b]];
    tables.self_boxes = sbri_self_boxes(c) + body->first_self_face;
    tables.self_balls = sbri_self_balls(c) + body->first_self_face;
    tables.self_nodes = sbri_self_nodes(c) + 2 * (size_t)body->first_self_face + tick->island->bodies[b];
    tables.self_items = sbri_self_items(c) + body->first_self_face;
    tables.self_edges = sbri_self_edges(c) + body->first_self_face;
    sbri_contact_prepare(tick, body, &tables);
    sbri_rolling_apply_resistance(tick, body);
  }
}

sbri_island_tick sbri_island_tick_of(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island) {
  const sbr_model *model = c->model;
  size_t first = island->first_slot;
  float tick_s = (float)world->tick_s * c->time_scale;
  const sbri_delta *anchor = &sbri_deltas(c)[sbri_anchor_frame(model)];
  return (sbri_island_tick){.model = model,
      .island = island,
      .tick_s = tick_s,
      .fraction = 1,
      .collides = world->body_contacts && sbri_contact_islands(c)[index],
      .gravity = world->has_gravity ? world->gravity : model->asset->environment.gravity,
      .wind = sbri_scale(model->asset->environment.wind, c->time_scale),
      .origin = sbri_header(c)->origin,
      .scale = c->scale,
      .ground = &c->ground,
      .loads = sbri_loads_now(c)->at,
      .load_count = sbri_loads_now(c)->count,
      .colliders = &world->colliders,
      .positions = sbri_positions(c) + first,
      .velocities = sbri_velocities(c) + 3 * first,
      .targets = sbri_targets(c) + first,
      .driver_velocities = sbri_driver_velocities(c) + 3 * first,
      .begins = sbri_begins(c) + first,
      .velocity_points = sbri_velocity_points(c) + first,
      .surface_vertices = sbri_surface_vertices(c),
      .surface_faces = sbri_surface_faces(c),
      .planes = sbri_planes(c) + 4 * first,
      .pressing = sbri_ground_pressing(c) + 2 * first,
      .near_ground = sbri_near_ground(c) + first / SBRI_BLOCK,
      .contacts = sbri_contacts(c),
      .contact_counts = sbri_contact_counts(c),
      .contact_blocks = sbri_contact_blocks(c),
      .contact_block_counts = sbri_contact_block_counts(c),
      .contact_slots = sbri_contact_slots(c) + first / SBRI_BLOCK,
      .contact_weights = sbri_contact_weights(c) + first,
      .external_bodies = sbri_external_bodies_of(c),
      .rests = island->link_flows ? sbri_rests(c) + island->first_flow : NULL,
      .strengths = island->link_flows ? sbri_strengths(c) + island->first_flow : NULL,
      .rotations = sbri_rotations(c) + 4 * SBRI_BLOCK * (size_t)island->first_rotation,
      .external_forces = island->has_external_forces ? sbri_external_forces(c) + first : NULL,
      .anchor = {anchor->position, anchor->rotation},
      .surface_forces = sbri_surface_forces(c),
      .surface_velocities = sbri_surface_velocities(c),
      .accelerations = sbri_accelerations(c) + 3 * first,
      .older_velocities = sbri_older_velocities(c) + 3 * first,
      .moves = sbri_moves(c) + first,
      .edges = sbri_edges(c) + 3 * SBRI_BLOCK * (size_t)island->first_link_block,
      .solid_edges = sbri_solid_edges(c) + 9 * SBRI_BLOCK * (size_t)island->first_tetrahedron_block,
      .tetrahedra =
          island->solid_flows ? sbri_solids(c) + island->first_solid_block : island->tetrahedron_blocks,
      .flowing = island->solid_flows ? sbri_solids(c) + island->first_solid_block : NULL,
      .torn = island->solid_flows ? sbri_torn(c) + island->first_solid : NULL,
      .max_flow_stretch = &sbri_island_states(c)[index].max_flow_stretch,
      .tears = &sbri_tears_of(c)[index],
      .step_error_m = island->step_error_m,
      .element_forces = sbri_element_forces(c) + first,
      .stretch = &sbri_island_states(c)[index].stretch,
      .element_visits = &sbri_island_states(c)[index].element_visits,
      .stiffening = &sbri_island_states(c)[index].stiffening,
      .min_ratio = &sbri_island_states(c)[index].min_ratio};
}

void sbri_island_report_contacts(const sbri_island_tick *tick, sbri_character *c) {
  for (uint32_t b = 0; b < tick->island->body_count && !tick->island->scheme->forceless; b++) {
    uint32_t body = tick->island->bodies[b];
    sbri_soft_contacts_report(tick, &c->model->bodies[body], &sbri_soft_touching(c)[body]);
  }
}

void sbri_island_find_contacts(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, &now);
  sbri_island_prepare_contacts(&tick, c);
}
