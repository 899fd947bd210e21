/* Changes a character's detail level. State that all levels share is copied. Soft bodies take over shape and
 * velocity relative to their pins: each point is a weighted mean of points of the old level
 * (prepare/sources.c). A shape with more energy than the old one is scaled back towards rest. Loose bodies
 * keep their linear and angular velocity. After jiggle or bones a body begins in its rest shape, moving with
 * its bones. */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"
#include "soft/soft.h"
#include "state/pose/frames.h"
#include "world/detail/choose.h"

enum { ATTEMPTS = 4 };

/* Maximum counted duration of a level: 200 days. */
static const uint32_t LONG_TICKS = 1u << 30;

/* ---- Before ---- */

static float *velocity_of(const sbri_character *c, uint32_t slot) {
  return sbri_velocities(c) + 3 * (size_t)(slot / SBRI_BLOCK * SBRI_BLOCK) + slot % SBRI_BLOCK;
}

/* Displacement and velocity of the points relative to their pin frames; for loose bodies relative to the
 * root.
 */
static void store_body(sbri_character *c, const sbri_body *body, bool moves) {
  const sbri_island *island = &c->model->islands[body->island];
  sbri_point *drivers = sbri_velocity_points(c) + island->first_slot + body->slots.begin;
  sbri_compute_driver_positions(c->model, body, sbri_deltas(c), drivers);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    uint32_t at = island->first_slot + slot;
    const sbri_point *p = &sbri_positions(c)[at], *g = &drivers[slot - body->slots.begin];
    const float *v = velocity_of(c, at), *w = sbri_driver_velocities(c) + (v - sbri_velocities(c));
    float limited = body->is_pinned ? 1 : 0, is = moves ? 1 : 0;
    sbri_offsets(c)[at] = (sbri_point){p->x - g->x, p->y - g->y, p->z - g->z, 0};
    sbri_speeds(c)[at] =
        (sbri_point){is * (v[0] - limited * w[0]), is * (v[SBRI_BLOCK] - limited * w[SBRI_BLOCK]),
            is * (v[2 * SBRI_BLOCK] - limited * w[2 * SBRI_BLOCK]), 0};
  }
}

/* Returns whether it moves: false if its pins have jumped. */
static bool store_soft_motion(sbri_character *c, float tick_s) {
  const sbr_model *model = c->model;
  bool moves = true;
  memset(sbri_offsets(c), 0, model->slot_count * sizeof(sbri_point));
  memset(sbri_speeds(c), 0, model->slot_count * sizeof(sbri_point));
  for (uint32_t i = 0; i < model->island_count; i++)
    moves = sbri_driver_velocities_find(c, &model->islands[i], tick_s) && moves;
  for (uint32_t b = 0; b < model->asset->soft_bodies.count; b++)
    if (model->bodies[b].level) store_body(c, &model->bodies[b], moves);
  return moves;
}

/* ---- State that all detail levels share ---- */

static void copy_shared_state(sbri_character *c, const sbri_character *was) {
  const sbr_model *is = c->model;
  uint32_t frames = sbri_first_jiggle_frame(is);
  uint32_t vertices = is->detail.base->detail.first_vertices[is->asset->render_meshes.count];
  memcpy(sbri_header(c), sbri_header(was), sizeof(sbri_character_state));
  memcpy(sbri_loads(c), sbri_loads(was), SBR_LOAD_CAPACITY * sizeof(sbri_load));
  memcpy(sbri_faded(c), sbri_faded(was), vertices * sizeof(sbri_fading_vertex));
  memcpy(sbri_gait(c), sbri_gait(was), sbri_gait_state_size(&is->rig));
  memcpy(sbri_pose(c), sbri_pose(was), frames * sizeof(sbr_transform));
  memcpy(sbri_previous_pose(c), sbri_previous_pose(was), frames * sizeof(sbr_transform));
  memcpy(sbri_soft_touching(c), sbri_soft_touching(was),
      is->asset->soft_bodies.count * sizeof(sbri_contact_reports));
  sbri_rigid_copy_state(c, was);
}

/* Counters of an island continue in the island that has its first body. */
static void copy_counters(sbri_character *c, const sbri_character *was) {
  for (uint32_t i = 0; i < c->model->island_count; i++) {
    uint32_t body = c->model->islands[i].bodies[0];
    if (!was->model->bodies[body].level) continue;
    const sbri_island_state *from = &sbri_island_states(was)[was->model->bodies[body].island];
    sbri_island_states(c)[i].recoveries = from->recoveries;
    sbri_island_states(c)[i].recovery = from->recovery;
    sbri_island_states(c)[i].element_visits = from->element_visits;
    sbri_island_states(c)[i].reported_asleep = from->reported_asleep;
  }
}

/* ---- Soft bodies ---- */

static sbf_vec3 mean_of(const sbri_sources *sources, const sbri_point *of) {
  sbf_vec3 sum = {0, 0, 0};
  for (int k = 0; k < SBRI_SOURCES; k++) {
    const sbri_point *p = &of[sources->slots[k]];
    sum = sbri_add_scaled(sum, sbri_vec3(p->x, p->y, p->z), sources->weights[k]);
  }
  return sum;
}

/* Applies `fraction` of the old shape and motion, relative to the drivers. */
static void apply_shape(sbri_character *c, const sbri_character *was, const sbri_body *body,
    const sbri_sources *sources, float fraction) {
  const sbri_island *island = &c->model->islands[body->island];
  sbri_point *positions = sbri_positions(c) + island->first_slot;
  sbri_compute_driver_positions(c->model, body, sbri_deltas(c), positions + body->slots.begin);
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    sbf_vec3 offset = mean_of(&sources[island->first_slot + slot], sbri_offsets(was));
    sbri_point *p = &positions[slot];
    *p = (sbri_point){p->x + fraction * offset.x, p->y + fraction * offset.y, p->z + fraction * offset.z, 0};
  }
}

static void add_speeds(
    sbri_character *c, const sbri_character *was, const sbri_body *body, const sbri_sources *sources) {
  const sbri_island *island = &c->model->islands[body->island];
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    sbf_vec3 speed = mean_of(&sources[island->first_slot + slot], sbri_speeds(was));
    float *v = velocity_of(c, island->first_slot + slot);
    v[0] += speed.x, v[SBRI_BLOCK] += speed.y, v[2 * SBRI_BLOCK] += speed.z;
  }
}

static double elastic_of(const sbr_world *world, const sbri_character *c, uint32_t body) {
  return sbri_body_health(world, c, body).elastic_j;
}

/* Energy is proportional to the square of a small strain. */
static void apply_shape_within_energy(const sbr_world *world, sbri_character *c, const sbri_character *was,
    uint32_t index, const sbri_sources *sources) {
  const sbri_body *body = &c->model->bodies[index];
  double max_j = sbri_energies(was)[index];
  float fraction = 1;
  apply_shape(c, was, body, sources, fraction);
  for (int n = 0; n < ATTEMPTS && body->is_pinned; n++) {
    double now = elastic_of(world, c, index);
    if (!(now > max_j)) return;
    fraction *= n + 1 < ATTEMPTS ? 0.98f * (float)sqrt(max_j / now) : 0;
    apply_shape(c, was, body, sources, fraction);
  }
}

/* ---- Jiggles ---- */

/* Mean displacement and velocity of the body's points relative to their drivers. */
static void mean_offset(const sbri_character *was, uint32_t index, sbf_vec3 *offset, sbf_vec3 *speed) {
  const sbri_body *body = &was->model->bodies[index];
  *offset = *speed = sbri_vec3(0, 0, 0);
  if (!body->level || body->slots.real_end == body->slots.begin) return;
  float fraction = 1 / (float)(body->slots.real_end - body->slots.begin);
  uint32_t first = was->model->islands[body->island].first_slot;
  for (uint32_t slot = body->slots.begin; slot < body->slots.real_end; slot++) {
    const sbri_point *o = &sbri_offsets(was)[first + slot], *v = &sbri_speeds(was)[first + slot];
    *offset = sbri_add_scaled(*offset, sbri_vec3(o->x, o->y, o->z), fraction);
    *speed = sbri_add_scaled(*speed, sbri_vec3(v->x, v->y, v->z), fraction);
  }
}

/* Followers continue with these, and with the motion of their bones. */
static void set_followers(sbri_character *c, const sbri_character *was, float tick_s) {
  for (uint32_t j = 0; j < c->model->jiggle_count; j++) {
    const sbri_jiggle *jiggle = &c->model->jiggles[j];
    sbri_position_follower *follower = &sbri_jiggles(c)[j];
    sbf_vec3 offset, speed;
    mean_offset(was, jiggle->body, &offset, &speed);
    sbr_transform before = sbri_delta_of(c, sbri_previous_pose(c), jiggle->parent);
    sbf_vec3 middle = sbri_add(before.position, sbri_rotate(before.rotation, jiggle->middle));
    sbf_vec3 went = sbri_scale(sbri_sub(follower->followed, middle), 1 / tick_s);
    follower->value = sbri_add(follower->followed, offset);
    follower->rate = sbri_add(went, speed);
    sbr_transform *frame = &sbri_pose(c)[sbri_first_jiggle_frame(c->model) + j];
    frame->position = sbri_add_scaled(frame->position, offset, c->scale);
  }
}

/* ---- All steps ---- */

static void copy_soft_bodies(
    const sbr_world *world, sbri_character *c, const sbri_character *was, bool moves, float tick_s) {
  const sbr_model *is = c->model;
  const sbri_sources *sources =
      is->detail.sources ? is->detail.sources[sbri_header(was)->detail_level] : NULL;
  for (uint32_t i = 0; i < is->island_count; i++) {
    sbri_island_reset_to_rest(c, i);
    sbri_drivers_advance(c, &is->islands[i], tick_s);
  }
  for (uint32_t b = 0; sources && b < is->asset->soft_bodies.count; b++) {
    if (!is->bodies[b].level || !was->model->bodies[b].level) continue;
    apply_shape_within_energy(world, c, was, b, sources);
    add_speeds(c, was, &is->bodies[b], sources);
    if (moves && !is->bodies[b].is_pinned && !was->model->bodies[b].is_pinned)
      sbri_body_copy_momentum(c, was, b);
  }
}

/* Switches to the spare storage; the old state is unchanged and becomes the spare one. */
static void switch_storage(const sbr_world *world, sbri_character *c) {
  float tick_s = (float)world->time.tick_s * c->time_scale;
  bool was_soft = sbri_get_detail_level(c)->kind == SBR_DETAIL_SOFT;
  for (uint32_t b = 0; was_soft && b < c->model->asset->soft_bodies.count; b++)
    sbri_energies(c)[b] = elastic_of(world, c, b);
  sbri_deltas_make(c, sbri_previous_pose(c), 0, sbri_previous_deltas(c));
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  bool moves = was_soft && store_soft_motion(c, tick_s);
  const sbri_character was = *c;
  sbri_character_storage_swap(c);
  copy_shared_state(c, &was);
  copy_counters(c, &was);
  sbri_jiggles_reset(c);
  set_followers(c, &was, tick_s);
  sbri_deltas_make(c, sbri_previous_pose(c), 0, sbri_previous_deltas(c));
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  sbri_restore_elements(c);
  copy_soft_bodies(world, c, &was, moves, tick_s);
}

/* Visible jump at a change as a fraction of the amplitude, measured on hard shaking. */
static const float JUMPS_FRACTION = 0.15f;
/* Maximum delay of a change to a coarser level, s; and of a character whose command changes repeatedly. */
static const float SWINGS_MAX_S = 1, LAGS_MAX_S = 2;

/* Additional lag of a body in the next tick because the drive changes; earlier motion does not show it. Asset
 * metres. */
static float lags_m(const sbr_world *world, const sbri_character *c) {
  sbri_gait_input input = sbri_gait_input_of(world, c, NULL);
  float radius_m = 0.5f * c->scale * c->model->detail.base->rest_size_m;
  return sbri_gait_max_speed_change(&c->model->rig, sbri_gait(c), &input, radius_m) * input.tick_s / c->scale;
}

/* For an automatic change that the budget does not demand: whether a level without oscillation would miss too
 * much, or a jump would be visible. The change is tried again later, or at once if it is to a finer level.
 */
static bool has_visible_jump(
    const sbr_world *world, sbri_character *c, uint32_t detail_level, float swings_m) {
  const sbri_detail *detail = world->detail;
  sbri_character_state *head = sbri_header(c);
  const sbr_detail_level *detail_levels = c->model->detail.base->detail.definitions;
  if (!detail || detail->is_short || head->set_detail_level_plus_1 || head->fade_before > 0) return false;
  bool finer = detail_level < head->detail_level,
       swings_on = finer || detail_levels[detail_level].kind == SBR_DETAIL_SOFT;
  float a_metre = sbri_pixels_of(world, c) * c->scale, lags = a_metre * lags_m(world, c);
  float shows = lags + a_metre * swings_m * (swings_on ? JUMPS_FRACTION : 1);
  float max_s = lags > detail->is.error_px ? LAGS_MAX_S : SWINGS_MAX_S;
  return shows > detail->is.error_px &&
         !(finer && (float)head->swing_ticks++ * (float)world->time.tick_s > max_s);
}

/* The requested level, or the nearest possible one. */
static uint32_t find_next_detail_level(const sbri_character *c) {
  const sbr_model *base = c->model->detail.base;
  uint32_t detail_level = sbri_header(c)->next_detail_level, collides = sbri_coarsest_colliding_level(base);
  if (base->detail.definitions[detail_level].kind == SBR_DETAIL_OFFSCREEN && !sbri_rigid_is_still(c))
    detail_level--; /* a character that lies or falls continues to: bones only */
  return c->near && detail_level > collides ? collides : detail_level;
}

const sbr_model *sbri_next_detail_model(const sbri_character *c) {
  return c->model->detail.base->detail.levels[find_next_detail_level(c)];
}

void sbri_detail_level_change(const sbr_world *world, sbri_character *c) {
  sbri_character_state *head = sbri_header(c);
  bool is_new = head->detail_level_ticks == UINT32_MAX; /* it has not been visible yet, or recently */
  head->detail_level_ticks =
      is_new ? LONG_TICKS : head->detail_level_ticks + (head->detail_level_ticks < LONG_TICKS);
  uint32_t detail_level = find_next_detail_level(c);
  bool must_collide = c->near && head->next_detail_level > detail_level;
  bool kept = head->fade_kept > 0, same = c->model == c->model->detail.base->detail.levels[detail_level];
  if (detail_level == head->detail_level) {
    head->fade_kept = 0;
    return;
  }
  if (!same && c->spare.model != c->model->detail.base->detail.levels[detail_level])
    return; /* no memory for it */
  bool coarser = detail_level > head->detail_level, chosen = world->detail && !head->set_detail_level_plus_1;
  if (coarser && chosen && head->fade_before > 0 && !world->detail->is_short) return; /* once per tick only */
  bool returns = sbri_is_away(c);
  bool unseen = head->unseen_ticks > 0 || returns || (is_new && chosen), fades = !unseen && !same;
  if (fades && !kept && !must_collide) {
    sbri_fade_record(c);
    return;
  }
  if (fades && must_collide) {
    (void)sbri_fade_measure(world, c); /* at once: the character may be about to become visible */
  } else if (fades && has_visible_jump(world, c, detail_level, sbri_fade_measure(world, c))) {
    head->next_detail_level = head->detail_level;
    head->detail_level_ticks = head->fade_kept = 0;
    return;
  }
  head->fade_kept = head->swing_ticks = 0;
  if (returns) sbri_away_arrive(world, c);
  if (!same) switch_storage(world, c);
  head = sbri_header(c);
  c->left_detail_level_plus_1 = head->detail_level + 1;
  head->detail_level = detail_level;
  head->detail_level_ticks = 0;
  head->asleep = 0;
  sbri_deltas_make(c, sbri_pose(c), 1, sbri_deltas(c));
  if (fades)
    sbri_fade_begin(world, c);
  else if (!same || returns)
    sbri_fade_end(c);
}
