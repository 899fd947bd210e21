/* Chains of bones that follow their first one.
 *
 * distance: every bone is dragged at its spacing by the one before it (snake, fish, caterpillar, dragon).
 * lag: every bone keeps its direction in the world for a while. In both, the bend between two bones is
 * bounded and decays, so that a chain at rest is as straight as in the rest pose. */
#include "animation/gait/gait_state.h"
#include "math/trig.h"

/* Rotation of a bone relative to a straight continuation, limited and decayed. */
static sbf_quat bend_of(sbf_quat rotation, const sbf_chain *chain, float decay) {
  sbf_vec3 v = sbri_scale(sbri_quat_log(rotation), decay);
  float angle = sbri_length(v);
  if (angle > chain->angle_limit) v = sbri_scale(v, chain->angle_limit / angle);
  return sbri_quat_exp(v);
}

sbf_vec3 sbri_chain_step(const sbri_rig *rig, const sbf_chain *chain, uint32_t k, float scale) {
  const sbr_transform *rest = &rig->bones.rest[chain->bones.at[k]];
  float length = rig->asset->bones.at[chain->bones.at[k]].length;
  bool is_last = k + 1 == chain->bones.count, is_spaced = !is_last || chain->spring;
  sbf_vec3 step = {0, length, 0};
  if (!is_last) {
    sbf_vec3 next = sbri_sub(rig->bones.rest[chain->bones.at[k + 1]].position, rest->position);
    step = sbri_rotate(sbri_quat_conjugate(rest->rotation), next);
  }
  float size = sbri_length(step);
  float wanted = chain->spacing.count && is_spaced ? chain->spacing.at[k] : size;
  if (size > 0) return sbri_scale(step, wanted * scale / size);
  return chain->spring ? sbri_vec3(0, wanted * scale, 0) : step;
}

/* Keeps the height above the ground at rest. */
static float height_at(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbf_chain *chain, uint32_t k, sbf_vec3 position) {
  uint32_t bone = chain->bones.at[k];
  sbf_vec3 step = sbri_rotate(rig->bones.rest[bone].rotation, sbri_chain_step(rig, chain, k, 1));
  float rest = rig->bones.rest[bone].position.y + step.y;
  return sbri_ground_below(input, position, NULL).y + rest * input->scale + state->motion.position.y;
}

/* Rotation of the bone in this tick, world axes, relative to `straight`, the continuation of the one before
 * it. */
static sbf_quat rotation_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_bone_chain *c, uint32_t k, sbf_vec3 head, sbf_quat straight, const sbri_chain_bone *was) {
  const sbf_chain *chain = c->source;
  float decay = sbri_exp(-chain->damping * input->tick_s);
  if (chain->kind == SBF_CHAIN_KIND_LAG) {
    sbf_quat rotation = sbri_quat_multiply(was->frame.rotation, sbri_quat_conjugate(straight));
    return bend_of(rotation, chain, decay);
  }
  sbf_vec3 ideal = sbri_rotate(straight, sbri_chain_step(rig, chain, k, input->scale)), tip = was->tip;
  if (sbri_dot(ideal, ideal) == 0) return sbri_quat_identity(); /* a link without length has no direction */
  tip.y = height_at(rig, state, input, chain, k, tip);
  sbf_vec3 from = sbri_normalize(ideal, sbri_vec3(0, 0, 1));
  sbf_vec3 to = sbri_normalize(sbri_sub(tip, head), from);
  return bend_of(sbri_quat_between(from, to), chain, decay);
}

static void pose_chain(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_bone_chain *c, sbri_advance advance, sbr_transform *pose) {
  const sbf_chain *chain = c->source;
  sbri_chain_bone *bones = sbri_chain_bones(rig, state) + c->first_state;
  for (uint32_t k = 0; k < chain->bones.count; k++) {
    uint32_t b = chain->bones.at[k];
    sbri_chain_bone *bone = &bones[k];
    sbf_vec3 head = pose[b].position;
    sbf_quat now = pose[b].rotation;
    if (k > 0) {
      uint32_t a = chain->bones.at[k - 1];
      sbf_quat rest_rotation =
          sbri_quat_multiply(sbri_quat_conjugate(rig->bones.rest[a].rotation), rig->bones.rest[b].rotation);
      now = sbri_quat_multiply(pose[a].rotation, rest_rotation);
      if (chain->kind == SBF_CHAIN_KIND_DISTANCE) head = bones[k - 1].tip;
      if (advance == SBRI_ADVANCE_TICK)
        now = sbri_quat_multiply(rotation_of(rig, state, input, c, k, head, now, bone), now);
      else if (advance == SBRI_ADVANCE_NOT)
        now = bone->frame.rotation;
      now = sbri_quat_normalize(now);
      sbri_rig_rotate_bone(rig, b, sbri_quat_multiply(now, sbri_quat_conjugate(pose[b].rotation)), pose);
      sbri_rig_shift(rig, b, sbri_sub(head, pose[b].position), pose);
    }
    sbf_vec3 displacement = sbri_sub(head, bone->frame.position);
    if (advance == SBRI_ADVANCE_TICK) bone->velocity = sbri_scale(displacement, 1 / input->tick_s);
    if (advance == SBRI_ADVANCE_RESET) bone->velocity = sbri_vec3(0, 0, 0);
    bone->frame = (sbr_transform){head, now};
    bone->tip = sbri_add(head, sbri_rotate(now, sbri_chain_step(rig, chain, k, input->scale)));
  }
}

void sbri_chains_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbri_advance advance, sbr_transform *pose) {
  (void)root;
  for (uint32_t c = 0; c < rig->chains.count; c++)
    pose_chain(rig, state, input, &rig->chains.at[c], advance, pose);
}
