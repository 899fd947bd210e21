#include "animation/gait/gait.h"

#include <string.h>

#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"
#include "animation/skeleton/rig_mass.h"
#include "base/assert.h"
#include "math/quat.h"
#include "math/trig.h"

static const float SMOOTHING_S = 0.18f; /* smoothing time of commands, s */
static const float DISPLACED_S = 0.1f;  /* smoothing time of the speed of host displacements, s */
static const float ACCELERATION = 0.2f; /* maximum acceleration, in reaches per squared duration of a step */
static const float BRISK_S = 0.4f;      /* on level ground, minimum duration of a step in this formula: large
                                           bodies would take seconds to accelerate */
static const float STILL_SPEED =
    0.004f; /* speed below which the character stands still, m/s and rad/s per metre of leg */
static const float MAX_STANDING_S = 1; /* maximum counted time of standing, s */
static const float SLOWING_S = 0.05f;  /* time constant for slowing down while feet are at their reach, s */
static const float TOLERATED_WAIT_S = 0.1f; /* wait for balance after which the body slows down, s */
static const float BALANCE_S = 0.2f;        /* further wait after which it stands, s */
static const float RECOVERY_S = 0.12f;      /* time constant for regaining speed after a wait, s */

size_t sbri_gait_state_size(const sbri_rig *rig) {
  size_t size = sizeof(sbri_gait_state) + 2 * sizeof(sbri_lag) * rig->tails.bone_count +
                sizeof(sbri_chain_bone) * rig->chains.bone_count +
                sizeof(sbri_spring_end) * rig->springs.chains.bone_count +
                sizeof(sbri_spring_clock) * rig->springs.chains.count +
                sizeof(sbri_limb_target) * rig->asset->ik_chains.count +
                sizeof(sbri_bone_follower) * rig->asset->followers.count + sbri_motion_size(rig);
  return (size + 15) & ~(size_t)15;
}

static void store_stance(sbri_gait_state *state, const sbri_stance *stance) {
  state->posture.root = stance->root;
  state->posture.hips_yaw = stance->hips_yaw;
  state->posture.hips_pitch = stance->hips_pitch;
  state->posture.chest_yaw = stance->chest_yaw;
  state->posture.lowered = stance->lowered;
  state->spares_knees = stance->spares_knees;
}

void sbri_gait_reset(
    const sbri_rig *rig, void *memory, const sbri_gait_input *input, sbf_vec3 position, float heading) {
  sbri_gait_state *state = memory;
  memset(memory, 0, sbri_gait_state_size(rig));
  state->motion.position = position;
  state->motion.heading = sbri_wrap_angle(heading);
  sbri_sincos(state->motion.heading, &state->motion.heading_sine, &state->motion.heading_cosine);
  state->stepping.standing_s = 1;
  SBF_ASSERT(rig->leg_count <= SBRI_MAX_LEGS);
  state->foot_count = rig->leg_count;
  state->tail_bone_count = rig->tails.bone_count;
  state->stepping.speed_fraction = state->stepping.step_limit = 1;
  state->stepping.since_lift_m = 1e6f; /* the first step does not wait */
  sbri_motion_reset(rig, state, input);
  sbri_body_stand(rig, state, input);
}

void sbri_body_stand(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  sbf_vec3 position = state->motion.position;
  float heading = state->motion.heading;
  if (sbri_is_kind(rig, SBF_GAIT_KIND_SLITHER)) sbri_slither_reset(rig, state, input);
  sbri_chain_bone *chain_bones = sbri_chain_bones(rig, state);
  for (uint32_t c = 0; c < rig->chains.count; c++)
    for (uint32_t k = 0; k < rig->chains.at[c].source->bones.count; k++) {
      const sbr_transform *rest = &rig->bones.rest[rig->chains.at[c].source->bones.at[k]];
      sbr_transform *frame = &chain_bones[rig->chains.at[c].first_state + k].frame;
      sbf_quat rotation = {0, 0, 0, 1};
      sbri_sincos(0.5f * heading, &rotation.y, &rotation.w);
      frame->position = sbri_add(position, sbri_rotate(rotation, sbri_scale(rest->position, input->scale)));
      frame->rotation = sbri_quat_multiply(rotation, rest->rotation);
    }
  for (uint32_t i = 0; i < rig->leg_count; i++)
    state->feet[i].hip = sbri_scale(rig->bones.rest[rig->legs[i].upper].position, input->scale);
  state->balance.stand = sbri_standing_offset(rig);
  sbf_vec3 stands = sbri_body_to_world(state, sbri_scale(state->balance.stand, input->scale));
  state->balance.sway_x = (sbri_lag){stands.x, 0}, state->balance.sway_z = (sbri_lag){stands.z, 0};
  state->posture.root = sbri_body_stance(rig, state, input).root;
  for (uint32_t i = 0; i < rig->leg_count; i++) sbri_foot_put_down(rig, state, input, i);
  sbri_stance stance = sbri_body_tick(rig, state, input, NULL, 0, sbri_vec3(0, 0, 0));
  store_stance(state, &stance);
  state->posture.rise = 0;
  sbri_fall_store_level(rig, state, input);
  sbri_tails_reset(rig, state, input, &stance);
}

/* Change of speed and turn rate in a tick. */
typedef struct velocity_change {
  float ahead, aside, turn;
} velocity_change;

static velocity_change limited_change(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  float approach = 1 - sbri_exp(-input->tick_s / SMOOTHING_S), fraction = 1;
  float ahead = (state->stepping.step_limit * input->forward - state->motion.forward) * approach;
  float aside = (state->stepping.step_limit * input->sideways - state->motion.sideways) * approach;
  float turn = (state->stepping.step_limit * input->turn - state->motion.turn) * approach;
  if (rig->leg_count) { /* limited by the fastest home */
    float step_s = rig->gait->step_duration, turn_speed = turn * rig->stand.spread * input->scale;
    float brisk_s = step_s > BRISK_S && sbri_are_feet_level(rig, state, input->scale) ? BRISK_S : step_s;
    float max = ACCELERATION * rig->stand.reach * input->scale * input->tick_s / (step_s * brisk_s);
    float change = sqrtf(ahead * ahead + aside * aside + turn_speed * turn_speed);
    fraction = change > max ? max / change : 1;
  }
  return (velocity_change){fraction * ahead, fraction * aside, fraction * turn};
}

float sbri_gait_max_speed_change(
    const sbri_rig *rig, const void *memory, const sbri_gait_input *input, float radius_m) {
  velocity_change change = limited_change(rig, memory, input);
  float turn_speed = change.turn * radius_m;
  return sqrtf(change.ahead * change.ahead + change.aside * change.aside + turn_speed * turn_speed);
}

static bool is_displaced(const sbri_gait_input *input) {
  return input->rotation != 0 || sbri_dot(input->displacement, input->displacement) > 0;
}

/* Moves and rotates the body as far as walls allow. */
static void move_body(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step, float turned) {
  sbf_vec3 from = state->motion.position;
  state->motion.position = sbri_add(from, step);
  state->motion.heading = sbri_wrap_angle(state->motion.heading + turned);
  sbri_sincos(state->motion.heading, &state->motion.heading_sine, &state->motion.heading_cosine);
  if (sbri_walls_resolve(rig, state, input, from, turned)) step = sbri_sub(state->motion.position, from);
  state->distance_m += (double)sbri_length(step);
  sbri_walk_tick(rig, state, sbri_length(step), input->scale);
  sbri_motion_tick(rig, state, input, step);
}

/* Applies displacement by the host. Its speed becomes the speed of the motion, so that feet step and tails
 * swing. */
static float displace(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  float blend = 1 - sbri_exp(-input->tick_s / DISPLACED_S), h = 1 / input->tick_s;
  sbf_vec3 speed = sbri_scale(sbri_world_to_body(state, input->displacement), h), shift = input->displacement;
  if (!sbri_is_afloat(rig)) shift.y = 0;
  state->motion.forward += (speed.z - state->motion.forward) * blend;
  state->motion.sideways += (speed.x - state->motion.sideways) * blend;
  state->motion.turn += (h * input->rotation - state->motion.turn) * blend;
  state->stepping.standing_s = 0;
  state->stepping.speed_fraction = 1;
  state->displaced = 1;
  move_body(rig, state, input, shift, input->rotation);
  return input->rotation;
}

float sbri_body_move(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *host_input) {
  sbri_gait_input command = sbri_motion_input(rig, host_input);
  const sbri_gait_input *input = &command;
  if (is_displaced(input)) return displace(rig, state, input);
  bool wanted = input->forward != 0 || input->sideways != 0 || input->turn != 0;
  if (state->displaced && !wanted) state->motion.forward = state->motion.sideways = state->motion.turn = 0;
  state->displaced = 0;
  if (sbri_is_afloat(rig)) {
    sbf_vec3 direction, from = state->motion.position;
    float turn_speed = sbri_afloat_move(rig, state, input, &direction);
    sbri_walls_resolve(rig, state, input, from, turn_speed);
    sbri_motion_tick(rig, state, input, direction);
    return turn_speed;
  }
  velocity_change change = limited_change(rig, state, input);
  state->motion.forward += change.ahead;
  state->motion.sideways += change.aside;
  state->motion.turn += change.turn;
  float speed =
      sqrtf(state->motion.forward * state->motion.forward + state->motion.sideways * state->motion.sideways);
  if (!wanted && speed < STILL_SPEED * input->scale && fabsf(state->motion.turn) < STILL_SPEED) {
    state->motion.forward = state->motion.sideways = state->motion.turn = 0;
    if (state->stepping.standing_s < MAX_STANDING_S)
      state->stepping.standing_s += input->tick_s; /* everything is at rest then */
  } else {
    state->stepping.standing_s = 0;
  }
  float sustainable = 1, max = rig->leg_count && !input->keeps_rest_pose
                                   ? sbri_max_speed_fraction(rig, state, input, &sustainable)
                                   : 1;
  float balanced = 1 - (state->stepping.waiting_s - TOLERATED_WAIT_S) /
                           BALANCE_S; /* leaves the next foot time for the body to lean */
  if (balanced < sustainable) sustainable = balanced > 0 ? balanced : 0;
  float speed_fraction = sustainable < max ? sustainable : max,
        in_s = speed_fraction < state->stepping.speed_fraction ? SLOWING_S : RECOVERY_S;
  state->stepping.speed_fraction +=
      (speed_fraction - state->stepping.speed_fraction) * (1 - sbri_exp(-input->tick_s / in_s));
  if (state->stepping.speed_fraction > max) state->stepping.speed_fraction = max;
  float h = input->tick_s * state->stepping.speed_fraction * sbri_hop_speed_fraction(rig, state, input),
        turned = state->motion.turn * h;
  sbf_vec3 step = sbri_scale(sbri_rotate_yaw(sbri_body_velocity(state), 0.5f * turned), h);
  move_body(rig, state, input, step, turned);
  return turned;
}

/* Rotates the head into the coming turn and stabilises it against the body's sway. */
static void update_head(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  const sbf_head_turn *head = rig->gait ? rig->gait->head : NULL;
  if (!head) return;
  float target = sbri_clamp(input->turn * head->lead, -head->limit, head->limit);
  sbri_body_steps_update(rig, state, input->tick_s);
  sbri_lag_tick(&state->head_yaw, target, &state->steps.head);
}

/* Centre of mass without lean: the middle of the homes if masses are unknown. */
static void update_center(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, const sbr_transform *pose) {
  sbf_vec3 center = {0, 0, 0};
  if (sbri_rig_center(rig, pose, input->scale, &center)) {
    center = sbri_sub(center, state->motion.position);
    center.x -= state->balance.sway_x.value, center.z -= state->balance.sway_z.value;
  } else {
    for (uint32_t i = 0; i < rig->leg_count; i++)
      center = sbri_add_scaled(center, sbri_home_arm(rig, state, input, i), 1 / (float)rig->leg_count);
  }
  state->balance.center = center;
}

uint32_t sbri_gait_tick(const sbri_rig *rig, void *memory, const sbri_gait_input *input, sbr_transform *pose,
    sbri_gait_event *events, uint32_t capacity) {
  sbri_gait_state *state = memory;
  uint32_t count = 0;
  sbri_move_with_surfaces(rig, state, input);
  float turned = sbri_body_move(rig, state, input);
  sbri_clips_tick(rig, state, input->tick_s);
  for (uint32_t i = 0; turned != 0 && i < rig->leg_count; i++) {
    sbri_foot *foot = &state->feet[i]; /* a planted foot does not rotate with the body */
    if (foot->planted) foot->heading = sbri_wrap_angle(foot->heading - turned);
    sbri_foot_update_heading(rig, state, input, i);
  }
  sbri_stance stance;
  bool fell = state->fall.is_falling, in_air = sbri_fall_tick(rig, state, input);
  if (fell && !state->fall.is_falling && count < capacity)
    events[count++] = (sbri_gait_event){.kind = SBRI_GAIT_LANDED, .position = state->motion.position};
  if (in_air && rig->leg_count)
    stance = sbri_body_tick(rig, state, input, NULL, 0, sbri_vec3(0, 0, 0));
  else if (!input->keeps_rest_pose && rig->leg_count)
    count = sbri_feet_tick(rig, state, input, &stance, events, capacity);
  else
    stance = sbri_body_stance(rig, state, input);
  if (!in_air) sbri_fall_store_level(rig, state, input);
  update_head(rig, state, input);
  sbri_tails_tick(rig, state, input, &stance, turned);
  state->posture.rise = (stance.root.position.y - state->posture.root.position.y) / input->tick_s;
  store_stance(state, &stance);
  sbri_body_pose(rig, state, input, SBRI_ADVANCE_TICK, pose);
  update_center(rig, state, input, pose);
  return count;
}

void sbri_gait_pose(
    const sbri_rig *rig, void *state, const sbri_gait_input *input, bool placed, sbr_transform *pose) {
  sbri_body_pose(rig, state, input, placed ? SBRI_ADVANCE_RESET : SBRI_ADVANCE_NOT, pose);
}

void sbri_gait_rebase(const sbri_rig *rig, void *memory, sbf_vec3 shift) {
  sbri_gait_state *state = memory;
  state->motion.position.x -= shift.x;
  state->motion.position.z -= shift.z; /* y is relative to the ground */
  state->posture.root.position = sbri_sub(state->posture.root.position, shift);
  state->fall.level -= shift.y;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_foot *foot = &state->feet[i];
    foot->ground = sbri_sub(foot->ground, shift);
    foot->step.from = sbri_sub(foot->step.from, shift);
    foot->step.to = sbri_sub(foot->step.to, shift), foot->step.planned = sbri_sub(foot->step.planned, shift);
    foot->glides.x.position -= shift.x, foot->glides.z.position -= shift.z;
    foot->glides.base.position -= shift.y;
    foot->pole = sbri_sub(foot->pole, shift);
  }
  sbri_chain_bone *bones = sbri_chain_bones(rig, state);
  for (uint32_t i = 0; i < rig->chains.bone_count; i++) {
    bones[i].frame.position = sbri_sub(bones[i].frame.position, shift);
    bones[i].tip = sbri_sub(bones[i].tip, shift);
  }
  sbri_limb_target *targets = sbri_limb_targets(rig, state);
  for (uint32_t i = 0; i < rig->asset->ik_chains.count; i++)
    targets[i].position = sbri_sub(targets[i].position, shift);
  sbri_springs_rebase(rig, state, shift);
  sbri_followers_rebase(rig, state, shift);
  sbri_motion_rebase(rig, state, shift);
}

uint32_t sbri_gait_legs(
    const sbri_rig *rig, const void *memory, float fraction, sbr_leg_state *legs, uint32_t capacity) {
  const sbri_gait_state *state = memory;
  for (uint32_t i = 0; i < rig->leg_count && i < capacity; i++) {
    const sbri_foot *foot = &state->feet[i];
    legs[i] = (sbr_leg_state){.planted = fraction > 0.999f ? foot->planted : foot->was_planted,
        .steps_taken = foot->steps_taken,
        .foot = sbri_add(foot->ground, sbri_vec3(0, foot->lift, 0)),
        .target = foot->planted ? foot->ground : foot->step.to,
        .pole = foot->pole,
        .phase = foot->step.phase};
  }
  return rig->leg_count;
}

double sbri_gait_distance(const void *state) {
  return ((const sbri_gait_state *)state)->distance_m;
}

float sbri_gait_level(const void *state) {
  return ((const sbri_gait_state *)state)->fall.level;
}

void sbri_gait_get_placement(const void *memory, sbf_vec3 *position, float *heading) {
  const sbri_gait_state *state = memory;
  *position = state->motion.position;
  *heading = state->motion.heading;
}
