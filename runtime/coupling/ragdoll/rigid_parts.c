/* A tick of a character's rigid parts, with the soft bodies that are coupled to them. */
#include <string.h>

#include "coupling/ragdoll/ragdoll.h"
#include "math/quat.h"

/* Fraction of its size per second below which an undriven body comes to rest. */
static const float IDLE_1_S = 0.01f;
/* The same for decaying motion: its maximum speed falls by this factor within the period of a swinging hand.
 */
static const float DAMPING_1_S = 0.2f, DECAY_FACTOR = 0.8f, DAMPING_S = 0.5f;

/* ---- Stepping ---- */

static bool has_invalid_numbers(const sbri_rigid_body_state *body) {
  const float *numbers = &body->pose.position.x;
  bool lost = false;
  for (int i = 0; i < 16; i++) lost = lost || !(fabsf(numbers[i]) < 1e6f);
  return lost;
}

/* Maximum speed of a body over its size, 1/s; infinite if a body must not rest. */
static float max_relative_speed(const sbri_character *c) {
  const sbri_rigid_model *model = &c->model->rigid;
  float max = sbri_coupled_are_idle(c) ? 0 : INFINITY;
  for (uint32_t b = 0; b < model->body_count; b++) {
    const sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    float size = model->bodies[b].radius > 0 ? 2 * model->bodies[b].radius : c->model->rest_size_m;
    sbf_vec3 turn =
        sbri_angular_velocity_from_momentum(&model->bodies[b], body->pose.rotation, body->angular_momentum);
    float fraction = sbri_length(body->velocity) / size + 0.5f * sbri_length(turn);
    if (body->mode == SBR_RIGID_DRIVEN || !(fraction <= DAMPING_1_S)) return INFINITY;
    max = fraction > max ? fraction : max;
  }
  return max;
}

/* Whether all motion has been slow for some time and has decayed since the interval before. Oscillations that
 * decay come to rest; a body that slumps or tips accelerates and does not. */
static bool is_decaying(const sbr_world *world, const sbri_character *c, float fraction) {
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  float tick_s = (float)world->time.tick_s * c->time_scale;
  if (!(fraction <= DAMPING_1_S)) {
    drive->decay.ticks = 0, drive->decay.max = drive->decay.before = 0;
    return false;
  }
  drive->decay.max = fraction > drive->decay.max ? fraction : drive->decay.max;
  if (++drive->decay.ticks < world->sleep_ticks || (float)drive->decay.ticks * tick_s < DAMPING_S)
    return false;
  bool decays = drive->decay.max <= DECAY_FACTOR * drive->decay.before;
  drive->decay.before = drive->decay.max;
  drive->decay.ticks = 0, drive->decay.max = 0;
  return decays;
}

static void may_sleep(const sbr_world *world, sbri_character *c) {
  const sbri_rigid_model *model = &c->model->rigid;
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  if (!world->sleep_ticks) return;
  float fraction = max_relative_speed(c);
  bool is_idle = fraction <= IDLE_1_S, decays = is_decaying(world, c, fraction);
  drive->idle_ticks = is_idle ? drive->idle_ticks + 1 : 0;
  if (!decays && drive->idle_ticks < world->sleep_ticks) return;
  drive->asleep = 1;
  drive->last_step_s = 0;
  for (uint32_t b = 0; b < model->body_count; b++)
    sbri_rigid_bodies(c)[b].velocity = sbri_rigid_bodies(c)[b].angular_momentum = sbri_vec3(0, 0, 0);
  sbri_coupled_put_to_sleep(world, c);
}

/* Whether a kinematic body next to sleeping ones has moved. */
static bool has_moved_support(const sbri_character *c) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    if (!sbri_rigid_is_simulated(c, b) &&
        memcmp(&sbri_rigid_targets(c)[b], &sbri_rigid_bodies(c)[b].pose, sizeof(sbr_transform)) != 0)
      return true;
  return false;
}

static void begin_step(void *user, const sbri_rigid_tick *tick, float from, float to, float weight_s) {
  sbri_coupled *group = user;
  if (group->any) sbri_coupled_before_step(group, tick, from, to, weight_s);
  sbri_reflex_act(group->character, tick, tick->tick_s * (to - from));
}

static void end_step(void *user, const sbri_rigid_tick *tick, float step_s, float weight_s) {
  const sbri_coupled *group = user;
  if (group->any) sbri_coupled_after_step(group, tick, step_s, weight_s);
  if (group->any) sbri_attached_loads_end(group->character, tick, step_s, weight_s);
}

static sbri_rigid_tick tick_of(const sbr_world *world, sbri_character *c) {
  const sbr_transform *anchor = &sbri_pose(c)[sbri_anchor_frame(c->model)];
  return (sbri_rigid_tick){.model = &c->model->rigid,
      .bodies = sbri_rigid_bodies(c),
      .joints = sbri_rigid_joints(c),
      .drive = sbri_rigid_drive(c),
      .kept = sbri_rigid_kept(c),
      .targets = sbri_rigid_targets(c),
      .anchor = {sbri_scale(anchor->position, 1 / c->scale), anchor->rotation},
      .ground = &c->ground,
      .colliders = &world->colliders,
      .origin = sbri_header(c)->origin,
      .scale = c->scale,
      .gravity = world->has_gravity ? world->gravity : c->model->asset->environment.gravity,
      .tick_s = (float)world->time.tick_s * c->time_scale,
      .substeps = c->model->rigid_substeps,
      .coarse = c->model->rigid_coarse,
      .touching = sbri_rigid_touching(c),
      .work = c->rigid_work};
}

bool sbri_rigid_parts_begin(const sbr_world *world, sbri_character *c, sbri_rigid_parts *parts) {
  const sbri_rigid_model *model = &c->model->rigid;
  parts->steps = false;
  if (!model->body_count) return false;
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  sbri_rigid_frames_follow(c, sbri_pose(c));
  if (!drive->any_dynamic) return false;
  for (uint32_t b = 0; b < model->body_count; b++)
    sbri_rigid_targets(c)[b] = sbri_rigid_target(c, sbri_pose(c), b);
  memcpy(sbri_animated(c), sbri_pose(c), c->model->frame_count * sizeof(sbr_transform));
  parts->coupled = (sbri_coupled){.world = world, .character = c, .animated = sbri_animated(c)};
  if (drive->asleep &&
      (world->colliders.is_moving || has_moved_support(c) || !sbri_coupled_sleep(&parts->coupled)))
    drive->asleep = drive->idle_ticks = 0, drive->decay.before = 0;
  if (drive->asleep || !c->rigid_work) {
    sbri_rigid_pose(c, sbri_animated(c), 1, 0, sbri_vec3(0, 0, 0), sbri_pose(c));
    return false;
  }
  parts->steps = true;
  parts->tick = tick_of(world, c);
  sbri_coupled_begin(&parts->coupled);
  bool any = parts->coupled.any;
  parts->tick.external = (sbri_rigid_external_forces){.before_step = begin_step,
      .after_step = end_step,
      .user = &parts->coupled,
      .squares = any ? model->pinned_squares : NULL,
      .attached_loads = any ? sbri_attached_loads(c) : NULL,
      .steps = parts->coupled.steps};
  sbri_rigid_begin(&parts->tick, &parts->work);
  return true;
}

void sbri_rigid_parts_end(sbri_rigid_parts *parts) {
  sbri_character *c = parts->coupled.character;
  const sbri_rigid_model *model = &c->model->rigid;
  sbri_rigid_end(&parts->tick, &parts->work);
  bool lost = false;
  for (uint32_t b = 0; b < model->body_count; b++)
    lost = lost || has_invalid_numbers(&sbri_rigid_bodies(c)[b]);
  if (lost) /* invalid numbers: resets to the animation */
    for (uint32_t b = 0; b < model->body_count; b++)
      sbri_rigid_set_frame(&sbri_rigid_bodies(c)[b], sbri_rigid_targets(c)[b]);
  sbri_rigid_pose(c, sbri_animated(c), 1, 0, sbri_vec3(0, 0, 0), sbri_pose(c));
  sbri_coupled_end(&parts->coupled);
  may_sleep(parts->coupled.world, c);
}

void sbri_rigid_tick_parts(const sbr_world *world, sbri_character *c) {
  sbri_rigid_parts parts;
  if (!sbri_rigid_parts_begin(world, c, &parts)) return;
  uint32_t steps = parts.tick.substeps, done = 0;
  float begin = 0; /* where steps of equal length begin */
  for (float from = 0, to; done < steps; from = to) {
    to = begin + (1 - begin) * ((float)++done / (float)steps);
    sbri_rigid_advance(&parts.tick, &parts.work, from, to);
    uint32_t left = sbri_coupled_steps_left(&parts.coupled, 1 - to, steps - done);
    if (left > steps - done && done < steps) begin = to, steps = left, done = 0;
  }
  sbri_rigid_parts_end(&parts);
}
