/* Geometry of a foot on the ground: its tilt, its heading, and the ankle's position relative to the sole. */
#include "animation/gait/gait_state.h"
#include "math/trig.h"

void sbri_foot_update_heading(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  const sbf_vec3 *ankle = &rig->legs[leg].home.ankle;
  sbri_foot *foot = &state->feet[leg];
  sbf_vec3 beside = sbri_body_to_world(state, sbri_vec3(ankle->x * input->scale, 0, ankle->z * input->scale));
  bool level = foot->normal.x == 0 && foot->normal.z == 0;
  foot->frame.home_ankle_offset = level ? beside : sbri_rotate(foot->frame.tilt, beside);
}

void sbri_foot_update_orientation(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  const sbf_vec3 up = {0, 1, 0};
  sbri_foot *foot = &state->feet[leg];
  float x = rig->legs[leg].home.ankle.x * input->scale, z = rig->legs[leg].home.ankle.z * input->scale;
  float heading = state->motion.heading + foot->heading;
  bool level = foot->normal.x == 0 && foot->normal.z == 0;
  sbri_sincos(heading, &foot->frame.sine, &foot->frame.cosine);
  foot->frame.tilt = level ? sbri_quat_identity() : sbri_quat_between(up, foot->normal);
  foot->frame.rotation = sbri_quat_multiply(foot->frame.tilt, sbri_quat_about(up, heading));
  foot->frame.ankle_offset = sbri_vec3(
      foot->frame.cosine * x + foot->frame.sine * z, 0, foot->frame.cosine * z - foot->frame.sine * x);
  if (!level) foot->frame.ankle_offset = sbri_rotate(foot->frame.tilt, foot->frame.ankle_offset);
  sbri_foot_update_heading(rig, state, input, leg);
}
