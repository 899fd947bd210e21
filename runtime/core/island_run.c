/* One control tick of an island: what is made ready, what its scheme does, and what follows from it. */
#include "collide/contact.h"
#include "collide/rolling.h"
#include "core/world.h"
#include "math/vec3.h"
#include "skin/skin.h"
#include "solvers/outer_forces.h"
#include "solvers/router.h"
#include "solvers/touches.h"

sbf_vec3 sbri_guide_velocities_find(
    sbri_character *c, const sbri_island *island, float tick_s, bool *jumped) {
  float rate = 1 / tick_s, count = 0;
  sbf_vec3 sum = {0, 0, 0};
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    if (!body->held) continue;
    sbri_point *from = sbri_begins(c) + island->first_slot + body->slot_begin;
    sbri_point *to = sbri_velocity_points(c) + island->first_slot + body->slot_begin;
    sbri_guide_places(c->model, body, sbri_previous_deltas(c), from);
    sbri_guide_places(c->model, body, sbri_deltas(c), to);
    sbri_follow_origins(c, body, from);
    sbri_follow_origins(c, body, to);
    float farthest = 0;
    float *velocities = sbri_guide_velocities(c) + 3 * (size_t)(island->first_slot + body->slot_begin);
    for (uint32_t i = 0; i < body->slot_end - body->slot_begin; i++) {
      float x = to[i].x - from[i].x, y = to[i].y - from[i].y, z = to[i].z - from[i].z;
      float *v = velocities + 3 * (i / SBRI_BLOCK * SBRI_BLOCK) + i % SBRI_BLOCK,
            square = x * x + y * y + z * z;
      v[0] = x * rate, v[SBRI_BLOCK] = y * rate, v[2 * SBRI_BLOCK] = z * rate;
      sum = sbri_add(sum, sbri_vec3(v[0], v[SBRI_BLOCK], v[2 * SBRI_BLOCK]));
      count += 1;
      farthest = square > farthest ? square : farthest;
    }
    float most = body->rest_size_m + 0.05f * c->model->rest_size_m;
    *jumped = *jumped || farthest > most * most;
  }
  return count > 0 ? sbri_scale(sum, 1 / count) : sum;
}

/* Gives the body's points what its guides' velocity has changed by beyond what it is made to feel. */
static void soften_start(
    sbri_character *c, const sbri_island *island, uint32_t index, sbf_vec3 guide_velocity, float tick_s) {
  sbri_island_state *state = &sbri_island_states(c)[index];
  sbf_vec3 change = sbri_sub(guide_velocity, state->guide_velocity);
  float most = island->most_acceleration_m_s2 * tick_s, size = sbri_length(change);
  state->guide_velocity = guide_velocity;
  if (island->scheme->forceless || !(most > 0) || !(size > most)) return;
  sbf_vec3 excess = sbri_scale(change, 1 - most / size);
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t slot = 0; slot < island->free_count; slot++) {
    float *v = velocities + 3 * (slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
    if (!(island->masses[slot] > 0)) continue;
    v[0] += excess.x, v[SBRI_BLOCK] += excess.y, v[2 * SBRI_BLOCK] += excess.z;
  }
}

/* Carries the island with its frames, as fast as they go. */
static void ride_along(sbri_character *c, uint32_t index, float tick_s) {
  const sbri_island *island = &c->model->islands[index];
  sbri_island_carry(c, index);
  float *velocities = sbri_velocities(c) + 3 * (size_t)island->first_slot;
  const float *guides = sbri_guide_velocities(c) + 3 * (size_t)island->first_slot;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[island->bodies[b]];
    for (uint32_t i = 3 * body->slot_begin; body->held && i < 3 * body->slot_end; i++)
      velocities[i] = island->scheme->forceless ? velocities[i] - guides[i] * tick_s : guides[i];
  }
}

void sbri_island_tuck(sbri_character *c, const sbri_island *island) {
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
      sbri_touches(c), sbri_touch_counts(c), NULL};
  for (uint32_t b = 0; b < tick->island->body_count; b++) {
    const sbri_body *body = &c->model->bodies[tick->island->bodies[b]];
    sbri_skin surface = sbri_skin_now(c, &body->surface);
    tables.surface = &surface;
    sbri_contact_prepare(tick, body, &tables);
    sbri_rolling_resist(tick, body);
  }
}

sbri_island_tick sbri_island_tick_of(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island) {
  const sbr_model *model = c->model;
  size_t first = island->first_slot;
  float tick_s = (float)world->tick_s * c->time_scale;
  return (sbri_island_tick){.model = model,
      .island = island,
      .tick_s = tick_s,
      .share = 1,
      .gravity = world->has_gravity ? world->gravity : model->asset->environment.gravity,
      .wind = sbri_scale(model->asset->environment.wind, c->time_scale),
      .origin = sbri_head(c)->origin,
      .scale = c->scale,
      .ground = &world->ground,
      .colliders = &world->colliders,
      .positions = sbri_positions(c) + first,
      .velocities = sbri_velocities(c) + 3 * first,
      .targets = sbri_targets(c) + first,
      .guide_velocities = sbri_guide_velocities(c) + 3 * first,
      .begins = sbri_begins(c) + first,
      .velocity_points = sbri_velocity_points(c) + first,
      .surface_vertices = sbri_surface_vertices(c),
      .surface_faces = sbri_surface_faces(c),
      .planes = sbri_planes(c) + 4 * first,
      .near_ground = sbri_near_ground(c) + first / SBRI_BLOCK,
      .touches = sbri_touches(c),
      .touch_counts = sbri_touch_counts(c),
      .rests = island->link_flows ? sbri_rests(c) + island->first_flow : NULL,
      .strengths = island->link_flows ? sbri_strengths(c) + island->first_flow : NULL,
      .rotations = sbri_rotations(c) + 4 * SBRI_BLOCK * (size_t)island->first_rotation,
      .outer = island->has_outer ? sbri_outer(c) + first : NULL,
      .anchor = sbri_deltas(c)[sbri_anchor_frame(model)],
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
      .thinning = &sbri_island_states(c)[index].thinning,
      .tears = &sbri_tears_of(c)[index],
      .step_error_m = model->step_error_m,
      .element_forces = sbri_element_forces(c) + first,
      .stretch = &sbri_island_states(c)[index].stretch,
      .stiffening = &sbri_island_states(c)[index].stiffening,
      .least_ratio = &sbri_island_states(c)[index].least_ratio};
}

void sbri_island_tell(const sbri_island_tick *tick, sbri_character *c) {
  for (uint32_t b = 0; b < tick->island->body_count && !tick->island->scheme->forceless; b++) {
    uint32_t body = tick->island->bodies[b];
    sbri_touches_tell(tick, &c->model->bodies[body], &sbri_soft_touching(c)[body]);
  }
}

void sbri_island_contacts(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, &now);
  sbri_island_prepare_contacts(&tick, c);
}

void sbri_island_run(const sbr_world *world, sbri_character *c, uint32_t index) {
  if (sbri_island_sleeps(world, c, index)) return;
  const sbr_model *model = c->model;
  sbri_island now = sbri_island_now(c, &model->islands[index]);
  const sbri_island *island = &now;
  size_t first = island->first_slot;
  float tick_s = (float)world->tick_s * c->time_scale;
  bool jumped = false;
  sbf_vec3 guide_velocity = sbri_guide_velocities_find(c, island, tick_s, &jumped);
  if (jumped) {
    ride_along(c, index, tick_s);
    sbri_island_states(c)[index].guide_velocity = guide_velocity;
    return;
  }
  soften_start(c, island, index, guide_velocity, tick_s);
  sbri_held_places(island, sbri_deltas(c), sbri_targets(c) + first);
  sbri_island_tuck(c, island);
  sbri_island_tick tick = sbri_island_tick_of(world, c, index, island);
  tick.outer_rad_s = &now.outer_rad_s;
  if (!island->scheme->forceless) sbri_outer_look(&tick), sbri_island_prepare_contacts(&tick, c);
  sbri_router_choose(&tick, &sbri_island_states(c)[index].recovering)->tick(&tick);
  sbri_island_tell(&tick, c);
  if (island->tears && tick.tears->count > 0) tick.tears->unsplit = sbri_island_split(c, index);
  sbri_island_recover(world, c, index);
  sbri_island_may_sleep(world, c, index);
}
