/* Fills sbri_island_tick, the input of the time integrators: tables, points and contacts of one island.
 * Reports the contacts afterwards. */
#include <string.h>

#include "contact/contact.h"
#include "math/vec3.h"
#include "shapes/external_body.h"
#include "skin/skin.h"
#include "soft/soft.h"
#include "soft/solvers/rolling.h"
#include "soft/solvers/scheme.h"
#include "soft/solvers/soft_contacts.h"

void sbri_island_fill_unused_slots(sbri_character *c, const sbri_island *island) {
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    for (uint32_t slot = body->slots.real_end; slot < body->slots.end; slot++)
      positions[slot] = positions[slot / SBRI_BLOCK * SBRI_BLOCK];
    for (uint32_t slot = body->slots.first_spare;
         slot < body->slots.end && body->slots.real_end > body->slots.first_spare; slot++) {
      if (slot < body->slots.real_end && sbri_origins(c)[island->first_slot + slot] != SBRI_UNUSED) continue;
      positions[slot] = positions[body->slots.begin];
      float *v = sbri_velocities(c) + 3 * (size_t)island->first_slot;
      uint32_t to = 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK, from = 3 * body->slots.begin;
      for (uint32_t k = 0; k < 3; k++) v[to + k * SBRI_BLOCK] = v[from + k * SBRI_BLOCK];
    }
  }
}

void sbri_island_prepare_contacts(const sbri_island_tick *tick, sbri_character *c) {
  size_t first = tick->island->first_slot;
  sbri_contact_tables tables = {sbri_near_ground(c) + first / SBRI_BLOCK, sbri_planes(c) + 4 * first,
      sbri_ground_pressing(c) + 2 * first, sbri_contacts(c), sbri_contact_counts(c), NULL, NULL,
      sbri_contacts_of_points(c) + first, sbri_slot_contacts(c) + first, NULL, NULL, NULL, NULL, NULL, NULL};
  memset(tick->contacts.slots, 0, (tick->island->slot_count + SBRI_BLOCK - 1) / SBRI_BLOCK);
  for (uint32_t b = 0; b < tick->island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[tick->island->bodies[b]];
    sbri_skin surface = sbri_skin_now(c, &body->surface.skin);
    tables.surface = &surface;
    tables.external_bodies = &sbri_external_bodies_of(c)[tick->island->bodies[b]];
    tables.touched = &sbri_soft_touching(c)[tick->island->bodies[b]];
    tables.self_boxes = sbri_self_boxes(c) + body->self.first_face;
    tables.self_balls = sbri_self_balls(c) + body->self.first_face;
    tables.self_nodes = sbri_self_nodes(c) + 2 * (size_t)body->self.first_face + tick->island->bodies[b];
    tables.self_items = sbri_self_items(c) + body->self.first_face;
    tables.self_edges = sbri_self_edges(c) + body->self.first_face;
    sbri_contact_prepare(tick, body, &tables);
    sbri_rolling_apply_resistance(tick, body);
  }
}

static sbri_environment environment_of(const sbr_world *world, const sbri_character *c) {
  const sbf_asset *asset = c->model->asset;
  const sbri_delta *anchor = &sbri_deltas(c)[sbri_anchor_frame(c->model)];
  return (sbri_environment){.gravity = world->has_gravity ? world->gravity : asset->environment.gravity,
      .wind = sbri_scale(asset->environment.wind, c->time_scale),
      .origin = sbri_header(c)->origin,
      .scale = c->scale,
      .anchor = {anchor->position, anchor->rotation},
      .ground = &c->ground,
      .loads = sbri_loads_now(c)->at,
      .load_count = sbri_loads_now(c)->count,
      .colliders = &world->colliders};
}

static sbri_tick_contacts contacts_of(const sbri_character *c, size_t first_slot) {
  return (sbri_tick_contacts){.planes = sbri_planes(c) + 4 * first_slot,
      .near_ground = sbri_near_ground(c) + first_slot / SBRI_BLOCK,
      .pressing = sbri_ground_pressing(c) + 2 * first_slot,
      .at = sbri_contacts(c),
      .counts = sbri_contact_counts(c),
      .blocks = sbri_contact_blocks(c),
      .block_counts = sbri_contact_block_counts(c),
      .slots = sbri_contact_slots(c) + first_slot / SBRI_BLOCK,
      .weights = sbri_contact_weights(c) + first_slot,
      .external_bodies = sbri_external_bodies_of(c)};
}

static sbri_tick_springs springs_of(
    const sbri_character *c, const sbri_island *island, sbri_island_state *state) {
  const sbri_island_links *links = &island->links;
  return (sbri_tick_springs){.rests = links->flows ? sbri_rests(c) + links->first_flow : NULL,
      .strengths = links->flows ? sbri_strengths(c) + links->first_flow : NULL,
      .edges = sbri_edges(c) + 3 * SBRI_BLOCK * (size_t)links->first_block,
      .stretch = &state->stretch};
}

static sbri_tick_solids solids_of(
    const sbri_character *c, const sbri_island *island, sbri_island_state *state) {
  const sbri_island_tetrahedra *tetrahedra = &island->tetrahedra;
  sbri_tetrahedron_block *flowing = tetrahedra->flow ? sbri_solids(c) + tetrahedra->first_state_block : NULL;
  return (sbri_tick_solids){.blocks = flowing ? flowing : tetrahedra->blocks,
      .flowing = flowing,
      .torn = flowing ? sbri_torn(c) + tetrahedra->first_state : NULL,
      .edges = sbri_solid_edges(c) + 9 * SBRI_BLOCK * (size_t)tetrahedra->first_block,
      .compressed = sbri_compressed_blocks(c) + tetrahedra->first_block,
      .rotations = sbri_rotations(c) + 4 * SBRI_BLOCK * (size_t)island->regions.first_rotation,
      .max_flow_stretch = &state->max_flow_stretch,
      .stiffening = &state->stiffening,
      .min_ratio = &state->min_ratio};
}

static sbri_tick_scratch scratch_of(const sbri_character *c, const sbri_island *island) {
  size_t first = island->first_slot;
  return (sbri_tick_scratch){.begins = sbri_begins(c) + first,
      .velocity_points = sbri_velocity_points(c) + first,
      .element_forces = sbri_element_forces(c) + first,
      .external_forces = island->stability.has_external_forces ? sbri_external_forces(c) + first : NULL,
      .accelerations = sbri_accelerations(c) + 3 * first,
      .older_velocities = sbri_older_velocities(c) + 3 * first,
      .moves = sbri_moves(c) + first};
}

sbri_island_tick sbri_island_tick_of(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island) {
  sbri_island_state *state = &sbri_island_states(c)[index];
  size_t first = island->first_slot;
  return (sbri_island_tick){.model = c->model,
      .island = island,
      .tick_s = (float)world->time.tick_s * c->time_scale,
      .fraction = 1,
      .collides = world->body_contacts && sbri_contact_islands(c)[index],
      .environment = environment_of(world, c),
      .positions = sbri_positions(c) + first,
      .velocities = sbri_velocities(c) + 3 * first,
      .targets = sbri_targets(c) + first,
      .driver_velocities = sbri_driver_velocities(c) + 3 * first,
      .contacts = contacts_of(c, first),
      .surfaces = {.vertices = sbri_surface_vertices(c),
          .faces = sbri_surface_faces(c),
          .forces = sbri_surface_forces(c),
          .velocities = sbri_surface_velocities(c)},
      .springs = springs_of(c, island, state),
      .solids = solids_of(c, island, state),
      .scratch = scratch_of(c, island),
      .tears = &sbri_tears_of(c)[index],
      .step_error_m = island->stepping.step_error_m,
      .element_visits = &state->element_visits};
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
