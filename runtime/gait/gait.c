#include "gait/gait.h"

#include <string.h>

#include "gait/gait_state.h"
#include "math/quat.h"

static const float EASE_S = 0.18f; /* time over which wanted motion takes effect */
static const float STILL = 0.004f; /* m/s and rad/s, per metre of leg: below it the character stands */

size_t sbri_gait_state_size(const sbri_rig *rig) {
  size_t size = sizeof(sbri_gait_state) + 2 * sizeof(sbri_lag) * rig->tail_bone_count;
  return (size + 15) & ~(size_t)15;
}

void sbri_gait_place(
    const sbri_rig *rig, void *memory, const sbri_gait_input *input, sbf_vec3 position, float heading) {
  sbri_gait_state *state = memory;
  memset(memory, 0, sbri_gait_state_size(rig));
  state->position = position;
  state->heading = sbri_wrap_angle(heading);
  state->standing_s = 1;
  state->foot_count = rig->leg_count;
  state->tail_bone_count = rig->tail_bone_count;
  for (uint32_t i = 0; i < rig->leg_count; i++) sbri_foot_place(rig, state, input, i);
}

/* Eases the motion towards what is wanted and moves the body on. Returns the turn made. */
static float move_body(sbri_gait_state *state, const sbri_gait_input *input) {
  float ease = input->tick_s / (EASE_S + input->tick_s);
  state->forward += (input->forward - state->forward) * ease;
  state->sideways += (input->sideways - state->sideways) * ease;
  state->turn += (input->turn - state->turn) * ease;
  bool wanted = input->forward != 0 || input->sideways != 0 || input->turn != 0;
  float speed = sqrtf(state->forward * state->forward + state->sideways * state->sideways);
  if (!wanted && speed < STILL * input->scale && fabsf(state->turn) < STILL) {
    state->forward = state->sideways = state->turn = 0;
    state->standing_s += input->tick_s;
  } else {
    state->standing_s = 0;
  }
  float turned = state->turn * input->tick_s;
  sbf_vec3 step = sbri_turned(sbri_vec3(state->sideways * input->tick_s, 0, state->forward * input->tick_s),
      state->heading + 0.5f * turned);
  state->position = sbri_add(state->position, step);
  state->heading = sbri_wrap_angle(state->heading + turned);
  state->distance_m += (double)sbri_length(step);
  return turned;
}

/* The head looks where the turn will lead, and steadily while the body sways under it. */
static void lead_head(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  const sbf_head_turn *head = rig->gait ? rig->gait->head : NULL;
  if (!head) return;
  float target = sbri_clamp(input->turn * head->lead, -head->limit, head->limit);
  sbri_lag_tick(&state->head_yaw, target, head->frequency, head->damping_ratio, input->tick_s);
}

uint32_t sbri_gait_tick(const sbri_rig *rig, void *memory, const sbri_gait_input *input, sbr_transform *pose,
    sbri_gait_event *events, uint32_t capacity) {
  sbri_gait_state *state = memory;
  uint32_t count = 0;
  float turned = move_body(state, input);
  for (uint32_t i = 0; i < rig->leg_count; i++) /* a planted foot does not turn with the body */
    if (state->feet[i].planted) state->feet[i].heading = sbri_wrap_angle(state->feet[i].heading - turned);
  if (!input->hold && rig->leg_count) count = sbri_feet_tick(rig, state, input, events, capacity);
  sbri_stance stance = sbri_body_stance(rig, state, input);
  lead_head(rig, state, input);
  sbri_tails_tick(rig, state, stance.hips_yaw, turned, input->tick_s);
  sbri_body_pose(rig, state, input, pose);
  return count;
}

void sbri_gait_pose(
    const sbri_rig *rig, const void *state, const sbri_gait_input *input, sbr_transform *pose) {
  sbri_body_pose(rig, state, input, pose);
}

void sbri_gait_rebase(const sbri_rig *rig, void *memory, sbf_vec3 shift) {
  sbri_gait_state *state = memory;
  state->position.x -= shift.x;
  state->position.z -= shift.z; /* its y counts from the ground */
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_foot *foot = &state->feet[i];
    foot->ground = sbri_sub(foot->ground, shift);
    foot->from = sbri_sub(foot->from, shift);
    foot->to = sbri_sub(foot->to, shift);
  }
}

uint32_t sbri_gait_legs(const sbri_rig *rig, const void *memory, sbr_leg_state *legs, uint32_t capacity) {
  const sbri_gait_state *state = memory;
  for (uint32_t i = 0; i < rig->leg_count && i < capacity; i++) {
    const sbri_foot *foot = &state->feet[i];
    legs[i] = (sbr_leg_state){.planted = foot->planted,
        .steps_taken = foot->steps_taken,
        .foot = sbri_add(foot->ground, sbri_vec3(0, foot->lift, 0)),
        .target = foot->planted ? foot->ground : foot->to,
        .phase = foot->phase};
  }
  return rig->leg_count;
}

double sbri_gait_distance(const void *state) {
  return ((const sbri_gait_state *)state)->distance_m;
}

void sbri_gait_placement(const void *memory, sbf_vec3 *position, float *heading) {
  const sbri_gait_state *state = memory;
  *position = state->position;
  *heading = state->heading;
}
