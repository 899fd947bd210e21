/* Characters on moving floors: lifts, platforms, turntables. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"
#include "math/quat.h"
#include "math/trig.h"

static const float NEAR =
    0.1f; /* fraction of a step's height: maximum distance of a sole from the collider that supports it */

/* Motion in a tick of a point that stands on a collider. */
typedef struct floor_motion {
  sbf_vec3 displacement; /* m */
  float rotation;        /* rad, about +Y */
} floor_motion;

static floor_motion apply_floor_motion(
    const sbri_collider *c, const sbri_gait_input *input, sbf_vec3 position) {
  sbri_collider_frame frame = sbri_collider_frame_of(c, input->origin, 1);
  sbf_vec3 ahead =
      sbri_rotate(c->rotation_to, sbri_rotate(sbri_quat_conjugate(c->rotation_from), sbri_vec3(0, 0, 1)));
  return (floor_motion){sbri_shape_displacement(&frame, sbri_into_shape(&frame, position, false)),
      sbri_atan2(ahead.x, ahead.z)};
}

/* Motion by the collider below `position`, of that point and of the body at `body`. */
static void find_floor_motion(const sbri_rig *rig, const sbri_gait_input *input, sbf_vec3 position,
    sbf_vec3 body, floor_motion *motion, floor_motion *of_body) {
  uint32_t number;
  double tolerance = (double)(NEAR * rig->wall_volume.step_up * input->scale);
  sbr_double3 world = {input->origin.x + (double)position.x, input->origin.y + (double)position.y,
      input->origin.z + (double)position.z};
  *motion = *of_body = (floor_motion){{0, 0, 0}, 0};
  if (!sbri_surroundings_bearer(input->surroundings, world, tolerance, &number)) return;
  *motion = apply_floor_motion(&input->surroundings->colliders->at[number], input, position);
  *of_body = apply_floor_motion(&input->surroundings->colliders->at[number], input, body);
}

static void shift_step(sbri_foot *foot, sbf_vec3 displacement) {
  foot->ground = sbri_add(foot->ground, displacement);
  foot->step.from = sbri_add(foot->step.from, displacement);
  foot->step.to = sbri_add(foot->step.to, displacement),
  foot->step.planned = sbri_add(foot->step.planned, displacement);
  foot->glides.x.position += displacement.x, foot->glides.z.position += displacement.z,
      foot->glides.base.position += displacement.y;
  foot->pole = sbri_add(foot->pole, displacement);
}

void sbri_move_with_surfaces(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  if (!input->surroundings || !input->surroundings->colliders || !input->surroundings->colliders->is_moving)
    return;
  if (state->fall.is_falling || sbri_is_afloat(rig)) return;
  sbf_vec3 body = {state->motion.position.x, state->fall.level, state->motion.position.z};
  floor_motion motions[SBRI_MAX_LEGS], of_body, mean = {{0, 0, 0}, 0};
  float count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    find_floor_motion(rig, input, state->feet[i].ground, body, &motions[i], &of_body);
    mean.displacement = sbri_add(mean.displacement, of_body.displacement), mean.rotation += of_body.rotation;
    count += 1;
  }
  if (count > 0) mean.displacement = sbri_scale(mean.displacement, 1 / count), mean.rotation /= count;
  if (!rig->leg_count) find_floor_motion(rig, input, body, body, &of_body, &mean);
  if (mean.rotation == 0 && !(sbri_dot(mean.displacement, mean.displacement) > 0)) return;
  for (uint32_t i = 0; i < rig->leg_count; i++)
    shift_step(&state->feet[i], state->feet[i].planted ? motions[i].displacement : mean.displacement);
  state->motion.position.x += mean.displacement.x,
      state->motion.position.z += mean.displacement.z; /* its y is relative to the ground */
  state->posture.root.position = sbri_add(state->posture.root.position, mean.displacement);
  state->fall.level += mean.displacement.y;
  state->motion.heading = sbri_wrap_angle(state->motion.heading + mean.rotation);
  sbri_sincos(state->motion.heading, &state->motion.heading_sine, &state->motion.heading_cosine);
  sbri_motion_rebase(rig, state, sbri_scale(mean.displacement, -1));
  for (uint32_t i = 0; mean.rotation != 0 && i < rig->leg_count; i++)
    sbri_foot_update_orientation(rig, state, input, i);
}
