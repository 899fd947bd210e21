/* Motion of an offscreen character: its position and heading, without feet. */
#include <string.h>

#include "animation/gait/gait_state.h"
#include "math/trig.h"

void sbri_gait_travel(const sbri_rig *rig, void *memory, const sbri_gait_input *input) {
  sbri_gait_state *state = memory;
  sbri_gait_input footless = *input;
  footless.keeps_rest_pose = true; /* no foot slows it down */
  state->stepping.waiting_s = 0;
  (void)sbri_body_move(rig, state, &footless);
  state->fall.level = sbri_ground_below(input, state->motion.position, NULL).y;
  sbri_clips_tick(rig, state, input->tick_s);
}

void sbri_gait_arrive(const sbri_rig *rig, void *memory, const sbri_gait_input *input) {
  sbri_gait_state *state = memory;
  uint32_t steps[SBRI_MAX_LEGS];
  for (uint32_t i = 0; i < rig->leg_count; i++) steps[i] = state->feet[i].steps_taken;
  memset(state->feet, 0, sizeof state->feet);
  for (uint32_t i = 0; i < rig->leg_count; i++) state->feet[i].steps_taken = steps[i];
  state->balance.sway_x = state->balance.sway_z = state->balance.crouch = state->balance.roll =
      state->balance.upright = (sbri_lag){0, 0};
  state->balance.clearance = state->balance.bent = (sbri_lag){0, 0};
  state->stepping.waiting_s = 0;
  state->stepping.since_lift_m = 1e6f;
  sbri_body_stand(rig, state, input);
  for (uint32_t i = 0; i < rig->leg_count; i++) state->feet[i].steps_taken = steps[i];
}
