/* A long foot, such as a spider's: it stands on its toe and leans towards the hip or away from it, so that
 * the leg above it stretches and bends only half as much. */
#include "animation/gait/gait_state.h"
#include "animation/ik/ik.h"
#include "math/quat.h"

static const float ALIGNED = 0.97f; /* maximum cosine between a leaning foot and the line from toe to hip,
                                       unless the knee requires more */

static sbf_quat remove_rotation(const sbri_rig *rig, int32_t bone, const sbr_transform *pose) {
  return sbri_quat_multiply(pose[bone].rotation, sbri_quat_conjugate(rig->bones.rest[bone].rotation));
}

/* Distance of ankle and hip within the knee's acceleration limit; `upright` is the distance without lean. The
 * lean of the foot takes the difference. */
static float limited_span(const sbri_leg *leg, sbri_foot *foot, float upright, float min,
    const sbri_gait_input *input, sbri_advance advance) {
  float scale = input->scale,
        max_span = sbri_soften_reach(upright, leg->length.reach * scale, leg->length.soft_reach);
  float span = sbri_leg_span(leg, scale, max_span);
  if (span < min) span = min;
  if (advance == SBRI_ADVANCE_TICK) {
    float wanted = sbri_knee_angle(leg, scale, span), angle = sbri_knee_follow(foot, wanted, input->tick_s);
    foot->knee.locked = angle != wanted ? angle : 0;
    sbri_knee_store(foot, angle, wanted, input->tick_s);
  }
  return foot->knee.locked > 0 ? sbri_knee_distance(leg, scale, foot->knee.locked) : span;
}

sbf_vec3 sbri_long_foot_tilt(const sbri_leg *leg, sbri_foot *foot, sbf_vec3 hip, sbf_vec3 sole,
    sbf_vec3 ankle, const sbri_gait_input *input, sbri_advance advance, sbf_quat *leans) {
  float scale = input->scale;
  sbf_vec3 toe = sbri_add(sole, sbri_rotate(foot->frame.rotation, sbri_scale(leg->home.toe, scale)));
  sbf_vec3 is = sbri_sub(ankle, toe), to_hip = sbri_sub(hip, toe), offset = sbri_sub(ankle, hip);
  float length = sbri_length(is), far = sbri_length(to_hip);
  float min = sqrtf(far * far + length * length - 2 * ALIGNED * far * length);
  float span = limited_span(leg, foot, sbri_length(offset), min, input, advance);
  *leans = foot->frame.rotation;
  if (length <= 0 || far <= 0) return ankle;
  float cosine = sbri_clamp((far * far + length * length - span * span) / (2 * far * length), -1, 1);
  sbf_vec3 direction = sbri_scale(to_hip, 1 / far);
  sbf_vec3 aside =
      sbri_normalize(sbri_add_scaled(is, direction, -sbri_dot(is, direction)), sbri_vec3(0, 1, 0));
  sbf_vec3 leant = sbri_add_scaled(sbri_scale(direction, cosine), aside, sqrtf(1 - cosine * cosine));
  *leans = sbri_quat_multiply(sbri_quat_between(sbri_scale(is, 1 / length), leant), foot->frame.rotation);
  return sbri_add_scaled(toe, leant, length);
}

sbf_vec3 sbri_long_foot_over(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float scale, const sbr_transform *pose) {
  sbf_vec3 over_toe =
      sbri_rotate(remove_rotation(rig, leg->foot, pose), sbri_sub(leg->home.ankle, leg->home.toe));
  return sbri_scale(sbri_add(over_toe, sbri_rotate(foot->frame.rotation, leg->home.toe)), scale);
}

sbr_transform sbri_long_foot_toe(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float scale, const sbr_transform *pose) {
  sbf_quat stands = sbri_quat_multiply(foot->frame.rotation, rig->bones.rest[leg->toe].rotation);
  sbf_quat own =
      sbri_quat_multiply(remove_rotation(rig, leg->foot, pose), rig->bones.rest[leg->toe].rotation);
  sbf_vec3 ahead = sbri_scale(sbri_sub(leg->home.toe, leg->home.ankle), scale);
  sbf_vec3 position =
      sbri_add(pose[leg->foot].position, sbri_rotate(remove_rotation(rig, leg->foot, pose), ahead));
  sbr_transform toe = {position, sbri_quat_blend(own, stands, leg->toe_copies)};
  const sbri_joint_limit *limit = &rig->bones.limits[leg->toe];
  if (!limit->active) return toe;
  sbf_quat above = pose[leg->foot].rotation;
  sbf_quat local = sbri_quat_multiply(sbri_quat_conjugate(above), toe.rotation);
  toe.rotation = sbri_quat_normalize(sbri_quat_multiply(above, sbri_joint_limit_clamp(limit, local)));
  return toe;
}
