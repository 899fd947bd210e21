/* Falling: a character without ground under it falls until it lands.
 *
 * In the air only gravity changes its height (semi-implicit Euler). Its feet hang below it and are placed on
 * the ground at landing. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"

static const float GONE =
    0.4f; /* depth below a foot, as a fraction of a step's height, at which ground no longer supports it */
static const float LOW = 1e-4f; /* m; minimum height of a fall */

/* Height of the ground that supports the character, relative to the origin. */
static float support_height(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  float sum = 0;
  if (sbri_is_kind(rig, SBF_GAIT_KIND_SLITHER)) return sbri_slither_support(rig, state, input);
  for (uint32_t i = 0; i < rig->leg_count; i++) sum += state->feet[i].ground.y;
  return rig->leg_count ? sum / (float)rig->leg_count
                        : sbri_ground_below(input, state->motion.position, NULL).y;
}

/* Whether a planted foot has ground under its centre, or under another part, as at the edge of a stair. */
static bool is_supported(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float unsupported) {
  sbf_vec3 position = state->feet[leg].ground, normal;
  float min = position.y - unsupported;
  if (sbri_ground_below(input, position, NULL).y >= min) return true;
  sbri_set_sole_on_ground(rig, state, input, leg, &position, &normal);
  return position.y >= min;
}

/* Whether nothing supports it: no planted foot has ground, or, without legs, there is none under the body. */
static bool has_no_ground(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  float unsupported = GONE * rig->wall_volume.step_up * input->scale;
  if (!rig->leg_count) return support_height(rig, state, input) < state->fall.level - unsupported;
  bool stands = false;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    if (is_supported(rig, state, input, i, unsupported)) return false;
    stands = true;
  }
  return stands;
}

/* Places the feet below the body, at the height of the highest ground below them. */
static void set_feet_below(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  float highest = -1e30f;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_foot_put_down(rig, state, input, i);
    highest = state->feet[i].ground.y > highest ? state->feet[i].ground.y : highest;
  }
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    state->feet[i].ground.y = highest;
    state->feet[i].normal = sbri_vec3(0, 1, 0);
    sbri_foot_update_orientation(rig, state, input, i);
  }
}

bool sbri_fall_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  if (input->keeps_rest_pose || !rig->wall_volume.wall_sphere_count || sbri_is_afloat(rig)) return false;
  if (!state->fall.is_falling && !(state->motion.position.y > LOW) && !has_no_ground(rig, state, input))
    return false;
  if (!state->fall.is_falling) state->fall.speed = 0;
  float height = state->fall.level + state->motion.position.y;
  set_feet_below(rig, state, input);
  state->fall.speed += input->gravity * input->tick_s;
  height -= state->fall.speed * input->tick_s;
  state->fall.level = support_height(rig, state, input);
  state->motion.position.y = height - state->fall.level;
  state->fall.is_falling = state->motion.position.y > LOW;
  if (state->fall.is_falling) return true;
  state->motion.position.y = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) sbri_foot_put_down(rig, state, input, i);
  state->fall.level = support_height(rig, state, input);
  return true;
}

void sbri_fall_store_level(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  state->fall.level = support_height(rig, state, input);
}
