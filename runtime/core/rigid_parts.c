/* A character's rigid parts among the rest of it: where the animation has them, what moves them, and the
 * bones that move with them. */
#include <string.h>

#include "core/world.h"
#include "math/quat.h"

/* Slower than this share of its size a second, with nothing that draws it, a body comes to rest. */
static const float QUIET_1_S = 0.01f;

bool sbri_rigid_is_simulated(const sbri_character *c, uint32_t body) {
  return sbri_rigid_bodies(c)[body].mode != SBR_RIGID_KINEMATIC && c->model->rigid.bodies[body].mass > 0;
}

/* ---- From bones to bodies ---- */

/* Where the pose has a body's own frame, asset metres. */
sbr_transform sbri_rigid_target(const sbri_character *c, const sbr_transform *pose, uint32_t body) {
  const sbri_rigid_body *is = &c->model->rigid.bodies[body];
  uint32_t frame = is->source->bone >= 0 ? (uint32_t)is->source->bone : sbri_root_frame(c->model);
  sbr_transform rest = sbri_frame_rest(c->model, frame);
  sbf_quat turn = sbri_quat_multiply(pose[frame].rotation, sbri_quat_conjugate(rest.rotation));
  sbf_vec3 arm = sbri_rotate(turn, sbri_sub(is->center, rest.position));
  return (sbr_transform){sbri_add(sbri_scale(pose[frame].position, 1 / c->scale), arm),
      sbri_quat_normalize(sbri_quat_multiply(turn, is->axes))};
}

static void put_at(sbri_rigid_body_state *body, sbr_transform place) {
  body->pose = place;
  body->velocity = body->spin = body->fine = sbri_vec3(0, 0, 0);
}

void sbri_rigid_wake(sbri_character *c) {
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  drive->asleep = drive->quiet_ticks = drive->slow_ticks = drive->any = 0;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) drive->any |= sbri_rigid_is_simulated(c, b);
  sbri_character_wake(c);
}

void sbri_rigid_set_drive(sbri_character *c, const sbr_rigid_drive *drive) {
  sbri_rigid_drive_state *to = sbri_rigid_drive(c);
  to->frequency_hz = sbri_clamp(drive->frequency_hz, 0, 100);
  to->damping_ratio = sbri_clamp(drive->damping_ratio, 0, 10);
  to->strength = sbri_clamp(drive->strength, 0, 1e6f);
  to->joint_damping_1_s = sbri_clamp(drive->joint_damping_1_s, 0, 100);
}

void sbri_rigid_place(sbri_character *c, bool as_in_file) {
  const sbri_rigid_model *model = &c->model->rigid;
  if (!model->body_count) return;
  const sbr_rigid_drive drive = sbr_default_rigid_drive();
  if (as_in_file) sbri_rigid_set_drive(c, &drive);
  for (uint32_t b = 0; b < model->body_count; b++) {
    sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    put_at(body, sbri_rigid_target(c, sbri_pose(c), b));
    if (!as_in_file) continue;
    bool dynamic = model->bodies[b].source->motion == SBF_BODY_MOTION_DYNAMIC && model->bodies[b].mass > 0;
    body->mode = dynamic ? SBR_RIGID_PASSIVE : SBR_RIGID_KINEMATIC;
    body->share = 1;
  }
  sbri_rigid_drive(c)->last_step_s = 0;
  sbri_rigid_drive(c)->kept_touches = 0;
  sbri_reflex_end(c);
  memset(sbri_rigid_joints(c), 0, model->joint_count * sizeof *sbri_rigid_joints(c));
  sbri_rigid_wake(c);
}

void sbri_rigid_carry(sbri_character *c) {
  if (!c->model->rigid.body_count) return;
  sbri_reflex_end(c);
  sbri_rigid_drive(c)->kept_touches = 0;
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    put_at(&sbri_rigid_bodies(c)[b], sbri_rigid_target(c, sbri_pose(c), b));
  sbri_rigid_wake(c);
}

void sbri_rigid_rebase(sbri_character *c, sbf_vec3 shift) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    sbf_vec3 *at = &sbri_rigid_bodies(c)[b].pose.position;
    *at = sbri_sub(*at, shift);
  }
  for (uint32_t i = 0; c->model->rigid.body_count && i < sbri_rigid_drive(c)->kept_touches; i++) {
    sbri_kept_touch *kept = &sbri_rigid_kept(c)[i];
    kept->offset -= sbri_dot(kept->normal, shift);
  }
}

/* ---- From bodies to bones ---- */

/* What has carried the body from rest to `now`, applied to a place and axes of rest. */
static sbr_transform carried(
    const sbri_character *c, uint32_t body, const sbr_transform *now, const sbr_transform *rest) {
  const sbri_rigid_body *is = &c->model->rigid.bodies[body];
  sbf_quat turn = sbri_quat_multiply(now->rotation, sbri_quat_conjugate(is->axes));
  sbf_vec3 at = sbri_add(now->position, sbri_rotate(turn, sbri_sub(rest->position, is->center)));
  return (sbr_transform){
      sbri_scale(at, c->scale), sbri_quat_normalize(sbri_quat_multiply(turn, rest->rotation))};
}

/* A body goes on as it moves. */
static sbr_transform ahead(const sbri_character *c, uint32_t body, float seconds) {
  const sbri_rigid_body_state *now = &sbri_rigid_bodies(c)[body];
  sbr_transform to = now->pose;
  if (!(seconds > 0)) return to;
  to.position = sbri_add_scaled(to.position, now->velocity, seconds);
  (void)sbri_free_turn(&c->model->rigid.bodies[body], now->pose.rotation, now->spin, seconds, &to.rotation);
  return to;
}

/* A bone as the pose `by` has it against its parent, where that is at `parent_now`. */
static sbr_transform against(
    const sbr_transform *by, uint32_t bone, uint32_t parent, const sbr_transform *parent_now) {
  sbf_quat turn = sbri_quat_multiply(parent_now->rotation, sbri_quat_conjugate(by[parent].rotation));
  sbf_vec3 away = sbri_sub(by[bone].position, by[parent].position);
  return (sbr_transform){sbri_add(parent_now->position, sbri_rotate(turn, away)),
      sbri_quat_normalize(sbri_quat_multiply(turn, by[bone].rotation))};
}

static sbr_transform between(const sbr_transform *a, const sbr_transform *b, float share) {
  return (sbr_transform){
      sbri_lerp(a->position, b->position, share), sbri_quat_blend(a->rotation, b->rotation, share)};
}

void sbri_rigid_pose(
    const sbri_character *c, const sbr_transform *animated, float share, float ahead_s, sbr_transform *pose) {
  const sbr_model *model = c->model;
  const sbr_transform *before = sbri_previous_pose(c);
  for (uint32_t i = 0; i < model->frame_count; i++) {
    uint32_t frame = i < model->rig.bone_count ? model->rig.subtree[i] : i;
    int32_t body = model->carrier_of_frame[frame];
    if (body < 0 || !sbri_rigid_is_simulated(c, (uint32_t)body)) {
      pose[frame] = share < 1 ? between(&before[frame], &animated[frame], share) : animated[frame];
      continue;
    }
    if (sbri_body_frame(model, (uint32_t)body) == frame) {
      sbr_transform now = ahead(c, (uint32_t)body, ahead_s), rest = sbri_frame_rest(model, frame);
      pose[frame] = carried(c, (uint32_t)body, &now, &rest);
      continue;
    }
    uint32_t parent = (uint32_t)model->rig.parents[frame];
    pose[frame] = against(animated, frame, parent, &pose[parent]);
    if (share >= 1) continue;
    sbr_transform was = against(before, frame, parent, &pose[parent]);
    pose[frame] = between(&was, &pose[frame], share);
  }
}

void sbri_rigid_frames_follow(const sbri_character *c, sbr_transform *pose) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++) {
    if (c->model->rigid.own_frames[b] == UINT32_MAX) continue;
    int32_t bone = c->model->rigid.bodies[b].source->bone;
    uint32_t frame = sbri_body_frame(c->model, b);
    sbr_transform at = sbri_rigid_target(c, pose, b), rest = sbri_frame_rest(c->model, frame);
    pose[frame] = bone < 0 ? pose[sbri_root_frame(c->model)] : carried(c, b, &at, &rest);
  }
}

/* ---- Stepping ---- */

static bool is_lost(const sbri_rigid_body_state *body) {
  const float *numbers = &body->pose.position.x;
  bool lost = false;
  for (int i = 0; i < 16; i++) lost = lost || !(fabsf(numbers[i]) < 1e6f);
  return lost;
}

static void may_sleep(const sbr_world *world, sbri_character *c) {
  const sbri_rigid_model *model = &c->model->rigid;
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  bool quiet = world->sleep_ticks > 0 && sbri_coupled_are_quiet(c);
  for (uint32_t b = 0; b < model->body_count && quiet; b++) {
    sbri_rigid_body_state *body = &sbri_rigid_bodies(c)[b];
    float size = model->bodies[b].radius > 0 ? 2 * model->bodies[b].radius : c->model->rest_size_m;
    sbf_vec3 turn = sbri_spin_velocity(&model->bodies[b], body->pose.rotation, body->spin);
    float speed = sbri_length(body->velocity) + 0.5f * size * sbri_length(turn);
    quiet = body->mode != SBR_RIGID_DRIVEN && speed <= QUIET_1_S * size;
  }
  drive->quiet_ticks = quiet ? drive->quiet_ticks + 1 : 0;
  if (!quiet || drive->quiet_ticks < world->sleep_ticks) return;
  drive->asleep = 1;
  drive->last_step_s = 0;
  for (uint32_t b = 0; b < model->body_count; b++)
    sbri_rigid_bodies(c)[b].velocity = sbri_rigid_bodies(c)[b].spin = sbri_vec3(0, 0, 0);
  sbri_coupled_put_to_sleep(world, c);
}

/* Whether what holds the sleepers has moved. */
static bool is_moved(const sbri_character *c) {
  for (uint32_t b = 0; b < c->model->rigid.body_count; b++)
    if (!sbri_rigid_is_simulated(c, b) &&
        memcmp(&sbri_rigid_targets(c)[b], &sbri_rigid_bodies(c)[b].pose, sizeof(sbr_transform)) != 0)
      return true;
  return false;
}

static void act(void *user, const sbri_rigid_tick *tick, float from, float to) {
  sbri_coupled *group = user;
  if (group->any) sbri_coupled_act(group, tick, from, to);
  sbri_reflex_act(group->character, tick, tick->tick_s * (to - from));
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
      .ground = &world->ground,
      .colliders = &world->colliders,
      .origin = sbri_head(c)->origin,
      .scale = c->scale,
      .gravity = world->has_gravity ? world->gravity : c->model->asset->environment.gravity,
      .tick_s = (float)world->tick_s * c->time_scale,
      .substeps = c->model->rigid_substeps,
      .touching = sbri_rigid_touching(c),
      .work = sbri_rigid_work(c)};
}

bool sbri_rigid_parts_begin(const sbr_world *world, sbri_character *c, sbri_rigid_parts *parts) {
  const sbri_rigid_model *model = &c->model->rigid;
  parts->steps = false;
  if (!model->body_count) return false;
  sbri_rigid_drive_state *drive = sbri_rigid_drive(c);
  sbri_rigid_frames_follow(c, sbri_pose(c));
  if (!drive->any) return false;
  for (uint32_t b = 0; b < model->body_count; b++)
    sbri_rigid_targets(c)[b] = sbri_rigid_target(c, sbri_pose(c), b);
  memcpy(sbri_animated(c), sbri_pose(c), c->model->frame_count * sizeof(sbr_transform));
  parts->coupled = (sbri_coupled){.world = world, .character = c, .animated = sbri_animated(c)};
  if (drive->asleep && (world->colliders.moving || is_moved(c) || !sbri_coupled_sleep(&parts->coupled)))
    drive->asleep = drive->quiet_ticks = 0;
  if (drive->asleep) {
    sbri_rigid_pose(c, sbri_animated(c), 1, 0, sbri_pose(c));
    return false;
  }
  parts->steps = true;
  parts->tick = tick_of(world, c);
  sbri_coupled_begin(&parts->coupled);
  parts->tick.pull = (sbri_rigid_pull){
      act, &parts->coupled, parts->coupled.any ? model->pinned_squares : NULL, parts->coupled.steps};
  sbri_rigid_begin(&parts->tick, &parts->work);
  return true;
}

void sbri_rigid_parts_end(sbri_rigid_parts *parts) {
  sbri_character *c = parts->coupled.character;
  const sbri_rigid_model *model = &c->model->rigid;
  sbri_rigid_end(&parts->tick, &parts->work);
  bool lost = false;
  for (uint32_t b = 0; b < model->body_count; b++) lost = lost || is_lost(&sbri_rigid_bodies(c)[b]);
  if (lost) /* no motion any more: back to where the animation has them */
    for (uint32_t b = 0; b < model->body_count; b++)
      put_at(&sbri_rigid_bodies(c)[b], sbri_rigid_targets(c)[b]);
  sbri_rigid_pose(c, sbri_animated(c), 1, 0, sbri_pose(c));
  sbri_coupled_end(&parts->coupled);
  may_sleep(parts->coupled.world, c);
}

void sbri_rigid_tick_parts(const sbr_world *world, sbri_character *c) {
  sbri_rigid_parts parts;
  if (!sbri_rigid_parts_begin(world, c, &parts)) return;
  uint32_t steps = parts.tick.substeps;
  for (uint32_t i = 0; i < steps; i++)
    sbri_rigid_advance(&parts.tick, &parts.work, (float)i / (float)steps, (float)(i + 1) / (float)steps);
  sbri_rigid_parts_end(&parts);
}

bool sbri_rigid_is_still(const sbri_character *c) {
  const sbri_rigid_drive_state *drive = c->model->rigid.body_count ? sbri_rigid_drive(c) : NULL;
  return !drive || !drive->any || drive->asleep;
}
