/* One control tick of everything: characters' poses first, each a task; then their islands, each a task. A
 * task touches nothing that another one does, so neither the number of threads nor their order shows. */
#include <string.h>

#include "collide/contact.h"
#include "collide/rolling.h"
#include "core/world.h"
#include "math/vec3.h"
#include "skin/skin.h"
#include "solvers/outer_forces.h"
#include "solvers/router.h"

/* The origin follows when the character is this far from it, in m. */
static const float REBASE_AT_M = 4;

sbri_gait_input sbri_gait_input_of(const sbr_world *world, const sbri_character *c) {
  const sbri_character_state *head = sbri_head(c);
  return (sbri_gait_input){.forward = head->forward,
      .sideways = head->sideways,
      .turn = head->turn,
      .tick_s = (float)world->tick_s,
      .scale = c->scale,
      .hold = c->hold,
      .origin = head->origin,
      .ground = &world->ground};
}

/* ---- The character ---- */

static float whole(float metres) {
  return (float)(int32_t)(metres < 0 ? metres - 0.5f : metres + 0.5f);
}

static void shift_frames(sbr_transform *pose, uint32_t count, sbf_vec3 shift) {
  for (uint32_t f = 0; f < count; f++) pose[f].position = sbri_sub(pose[f].position, shift);
}

static void shift_points(sbri_point *points, uint32_t count, sbf_vec3 shift) {
  for (uint32_t i = 0; i < count; i++)
    points[i] = (sbri_point){points[i].x - shift.x, points[i].y - shift.y, points[i].z - shift.z, 0};
}

/* Moves the origin by whole metres to where the character is, and everything the other way. */
static void rebase(sbri_character *c) {
  const sbr_model *model = c->model;
  sbf_vec3 at = sbri_pose(c)[sbri_root_frame(model)].position;
  if (fabsf(at.x) < REBASE_AT_M && fabsf(at.y) < REBASE_AT_M && fabsf(at.z) < REBASE_AT_M) return;
  if (!(fabsf(at.x) < 1e9f && fabsf(at.y) < 1e9f && fabsf(at.z) < 1e9f)) return;
  sbf_vec3 shift = {whole(at.x), whole(at.y), whole(at.z)}, own = sbri_scale(shift, 1 / c->scale);
  sbri_character_state *head = sbri_head(c);
  head->origin.x += (double)shift.x, head->origin.y += (double)shift.y, head->origin.z += (double)shift.z;
  sbri_gait_rebase(&model->rig, sbri_gait(c), shift);
  shift_frames(sbri_pose(c), model->frame_count, shift);
  shift_frames(sbri_previous_pose(c), model->frame_count, shift);
  sbri_rigid_rebase(c, own);
  shift_points(sbri_positions(c), model->slot_count, own);
  shift_points(sbri_previous_positions(c), model->slot_count, own);
  for (uint32_t i = 0; i < model->island_count; i++) {
    const sbri_island *island = &model->islands[i];
    float *before = sbri_velocities(c) + 3 * (size_t)island->first_slot;
    if (!island->scheme->forceless) continue;
    for (uint32_t k = 0; k < 3 * island->free_count; k++) {
      uint32_t axis = k / SBRI_BLOCK % 3;
      before[k] -= axis == 0 ? own.x : axis == 1 ? own.y : own.z;
    }
  }
}

static void tick_character(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_character *c = &world->characters[index];
  c->event_count = 0;
  if (!c->model || sbri_character_sleeps(world, c)) return;
  for (uint32_t i = 0; i < c->model->island_count; i++)
    sbri_tears_of(c)[i].count = sbri_tears_of(c)[i].unsplit = 0;
  rebase(c);
  sbri_settle(c);
  if (sbri_head(c)->paused) return;
  sbri_gait_input input = sbri_gait_input_of(world, c);
  sbr_transform *pose = sbri_pose(c);
  bool has_bodies = c->model->island_count > 0; /* which alone ask where frames carry them */
  if (has_bodies) sbri_deltas_make(c, pose, sbri_previous_deltas(c));
  bool may_sleep = sbri_character_may_sleep(world, c);
  if (may_sleep) sbri_character_keep_gait(c);
  c->event_count = sbri_gait_tick(&c->model->rig, sbri_gait(c), &input, pose, c->events, SBRI_TICK_EVENTS);
  pose[sbri_root_frame(c->model)] = sbri_root_place(c, &world->ground);
  sbri_rigid_tick_parts(world, c);
  if (has_bodies) sbri_deltas_make(c, pose, sbri_deltas(c));
  sbri_head(c)->asleep = may_sleep && sbri_character_is_still(c);
}

/* ---- The islands ---- */

/* Velocities of the guides over the tick, in blocks; `tick_s` is the character's own. Returns their mean. */
static sbf_vec3 find_guide_velocities(
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

/* Inert lanes lie where their block's first point does, room for points that split where the body's does. */
static void tuck_padding(sbri_character *c, const sbri_island *island) {
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

static void prepare_contacts(const sbri_island_tick *tick, sbri_character *c) {
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

/* `island` as sbri_island_now has it. */
static sbri_island_tick make_tick(
    const sbr_world *world, sbri_character *c, uint32_t index, const sbri_island *island) {
  const sbr_model *model = c->model;
  size_t first = island->first_slot;
  float tick_s = (float)world->tick_s * c->time_scale;
  return (sbri_island_tick){.model = model,
      .island = island,
      .tick_s = tick_s,
      .gravity = world->has_gravity ? world->gravity : model->asset->environment.gravity,
      .wind = sbri_scale(model->asset->environment.wind, c->time_scale),
      .origin = sbri_head(c)->origin,
      .scale = c->scale,
      .ground = &world->ground,
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

void sbri_island_contacts(const sbr_world *world, sbri_character *c, uint32_t index) {
  sbri_island now = sbri_island_now(c, &c->model->islands[index]);
  sbri_island_tick tick = make_tick(world, c, index, &now);
  prepare_contacts(&tick, c);
}

static void tick_island(void *context, uint32_t index) {
  sbr_world *world = context;
  sbri_work work = world->work[index];
  sbri_character *c = &world->characters[work.character];
  if (sbri_island_sleeps(world, c, work.island)) return;
  const sbr_model *model = c->model;
  sbri_island now = sbri_island_now(c, &model->islands[work.island]);
  const sbri_island *island = &now;
  size_t first = island->first_slot;
  float tick_s = (float)world->tick_s * c->time_scale;
  bool jumped = false;
  sbf_vec3 guide_velocity = find_guide_velocities(c, island, tick_s, &jumped);
  if (jumped) {
    ride_along(c, work.island, tick_s);
    sbri_island_states(c)[work.island].guide_velocity = guide_velocity;
    return;
  }
  soften_start(c, island, work.island, guide_velocity, tick_s);
  sbri_held_places(island, sbri_deltas(c), sbri_targets(c) + first);
  tuck_padding(c, island);
  sbri_island_tick tick = make_tick(world, c, work.island, island);
  tick.outer_rad_s = &now.outer_rad_s;
  if (!island->scheme->forceless) sbri_outer_look(&tick), prepare_contacts(&tick, c);
  sbri_router_choose(&tick, &sbri_island_states(c)[work.island].recovering)->tick(&tick);
  if (island->tears && tick.tears->count > 0) tick.tears->unsplit = sbri_island_split(c, work.island);
  sbri_island_recover(world, c, work.island);
  sbri_island_may_sleep(world, c, work.island);
}

/* ---- The world ---- */

static void run(sbr_world *world, sbr_task *task, size_t count) {
  if (world->tasks.run)
    world->tasks.run(world->tasks.user, task, world, (uint32_t)count);
  else
    for (uint32_t i = 0; i < count; i++) task(world, i);
}

static void add_event(sbr_world *world, const sbri_character *c, sbr_event event, sbf_vec3 place) {
  sbr_double3 origin = sbri_head(c)->origin;
  event.character = sbri_id_of(world, c);
  event.tick = world->ticks;
  event.position =
      (sbr_double3){origin.x + (double)place.x, origin.y + (double)place.y, origin.z + (double)place.z};
  world->events[world->event_head++ % SBRI_EVENTS] = event;
}

/* The body that lists the element: of a spring between bodies, the first. */
static uint32_t body_of_tear(const sbr_model *model, const sbri_island *island, const sbri_tear *tear) {
  uint32_t spring = 0, link = tear->link;
  for (uint32_t b = 0; tear->solid && b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    if (link - body->first_tetrahedron < body->tetrahedron_count) return island->bodies[b];
  }
  while (spring < island->spring_count && island->link_of_spring[spring] != link) spring++;
  for (uint32_t b = 0; b < island->body_count; b++) {
    const sbri_body *body = &model->bodies[island->bodies[b]];
    if (spring >= body->first_spring && spring < body->spring_end) return island->bodies[b];
  }
  return island->bodies[0];
}

static void follow_tears(sbr_world *world) {
  for (uint32_t i = 0; i < world->work_count; i++) {
    sbri_character *c = &world->characters[world->work[i].character];
    uint32_t island = world->work[i].island;
    if (c->model->islands[island].tears && sbri_tears_of(c)[island].count > 0) sbri_skins_follow(c, island);
  }
}

static void gather_events(sbr_world *world) {
  for (uint32_t i = 0; i < world->character_capacity; i++) {
    const sbri_character *c = &world->characters[i];
    for (uint32_t e = 0; c->model && e < c->event_count; e++) {
      const sbri_gait_event *from = &c->events[e];
      add_event(world, c, (sbr_event){.kind = from->kind, .leg = from->leg}, from->position);
    }
    for (uint32_t k = 0; c->model && !sbri_head(c)->asleep && k < c->model->island_count; k++) {
      const sbri_tears *tears = &sbri_tears_of(c)[k];
      for (uint32_t e = 0; e < tears->count && e < SBRI_TEARS; e++) {
        uint32_t body = body_of_tear(c->model, &c->model->islands[k], &tears->at[e]);
        add_event(world, c, (sbr_event){.kind = SBR_EVENT_TEAR, .soft_body = body},
            sbri_scale(tears->at[e].place, c->scale));
      }
      if (tears->unsplit)
        add_event(world, c,
            (sbr_event){.kind = SBR_EVENT_UNSPLIT, .soft_body = c->model->islands[k].bodies[0]},
            sbri_scale(tears->at[0].place, c->scale));
    }
  }
}

/* Counts who was stepped, and tells who has fallen asleep or woken. */
static void note_sleep(sbr_world *world) {
  world->awake_count = 0;
  for (size_t i = 0; i < world->work_count; i++) {
    const sbri_character *c = &world->characters[world->work[i].character];
    const sbri_island *island = &c->model->islands[world->work[i].island];
    sbri_island_state *state = &sbri_island_states(c)[world->work[i].island];
    if (!state->asleep) world->awake_count += island->body_count;
    if (state->asleep == state->told_asleep) continue;
    state->told_asleep = state->asleep;
    const sbri_point *p = sbri_positions(c) + island->first_slot;
    add_event(world, c,
        (sbr_event){
            .kind = state->asleep ? SBR_EVENT_ASLEEP : SBR_EVENT_AWAKE, .soft_body = island->bodies[0]},
        sbri_scale(sbri_vec3(p->x, p->y, p->z), c->scale));
  }
}

void sbri_step_tick(sbr_world *world) {
  world->ticks++;
  run(world, tick_character, world->character_capacity);
  sbri_work_list(world);
  run(world, tick_island, world->work_count);
  follow_tears(world);
  gather_events(world);
  note_sleep(world);
}
