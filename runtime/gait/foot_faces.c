/* Geometry of a foot on the ground: its tilt, its heading, and the ankle's position relative to the sole. */
#include "gait/gait_state.h"
#include "math/trig.h"

void sbri_foot_update_heading(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  const sbf_vec3 *ankle = &rig->legs[leg].ankle;
  sbri_foot *foot = &state->feet[leg];
  sbf_vec3 beside = sbri_headed(state, sbri_vec3(ankle->x * input->scale, 0, ankle->z * input->scale));
  bool level = foot->normal.x == 0 && foot->normal.z == 0;
  foot->beside_at_home = level ? beside : sbri_rotate(foot->tilt, beside);
}

void sbri_foot_update_orientation(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  const sbf_vec3 up = {0, 1, 0};
  sbri_foot *foot = &state->feet[leg];
  float x = rig->legs[leg].ankle.x * input->scale, z = rig->legs[leg].ankle.z * input->scale;
  float heading = state->heading + foot->heading;
  bool level = foot->normal.x == 0 && foot->normal.z == 0;
  sbri_sincos(heading, &foot->sine, &foot->cosine);
  foot->tilt = level ? sbri_quat_identity() : sbri_quat_between(up, foot->normal);
  foot->turned = sbri_quat_multiply(foot->tilt, sbri_quat_about(up, heading));
  foot->beside = sbri_vec3(foot->cosine * x + foot->sine * z, 0, foot->cosine * z - foot->sine * x);
  if (!level) foot->beside = sbri_rotate(foot->tilt, foot->beside);
  sbri_foot_update_heading(rig, state, input, leg);
}
