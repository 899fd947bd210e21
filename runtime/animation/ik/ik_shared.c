/* Shared parts of the chain solvers. */
#include "animation/ik/ik.h"

static const float STRAIGHT = 1e-3f; /* sine of the angle below which a chain counts as straight */
static const float UNFOLD = 0.25f;   /* rad; bend of a straight chain so that it can fold */

float sbri_soften_reach(float distance, float reach, float soft) {
  float range = soft * reach, start = reach - range;
  if (range <= 0 || distance <= start) return distance;
  float t = sbri_clamp((distance - start) / (2 * range), 0, 1);
  return start + range * t * (2 - t);
}

static sbf_quat rotation_before(const sbri_ik_chain *chain, uint32_t index, const sbr_transform *frames) {
  return index ? frames[index - 1].rotation : chain->base.rotation;
}

void sbri_ik_compute_frames(const sbri_ik_chain *chain, sbr_transform *frames) {
  const sbr_transform *before = &chain->base;
  for (uint32_t i = 0; i < chain->count; i++) {
    const sbri_ik_joint *joint = &chain->joints[i];
    frames[i].position = sbri_add(before->position, sbri_rotate(before->rotation, joint->offset));
    frames[i].rotation = sbri_quat_normalize(sbri_quat_multiply(before->rotation, joint->rotation));
    before = &frames[i];
  }
}

float sbri_ik_reach(const sbri_ik_chain *chain) {
  float sum = 0;
  for (uint32_t i = 1; i < chain->count; i++) sum += sbri_length(chain->joints[i].offset);
  return sum;
}

void sbri_ik_rotate_bone(
    sbri_ik_chain *chain, uint32_t index, sbf_quat rotation, const sbr_transform *frames) {
  sbf_quat world = sbri_quat_multiply(rotation, frames[index].rotation);
  sbf_quat local = sbri_quat_multiply(sbri_quat_conjugate(rotation_before(chain, index, frames)), world);
  chain->joints[index].rotation =
      sbri_joint_limit_clamp(chain->joints[index].limit, sbri_quat_normalize(local));
}

/* The part of `v` perpendicular to the unit vector `along`; applied twice, for precision if `v` is nearly
 * parallel. */
static sbf_vec3 across(sbf_vec3 v, sbf_vec3 along) {
  for (int i = 0; i < 2; i++) v = sbri_add_scaled(v, along, -sbri_dot(v, along));
  return v;
}

static sbf_vec3 any_across(sbf_vec3 along) {
  sbf_vec3 spare = fabsf(along.x) < 0.9f ? sbri_vec3(1, 0, 0) : sbri_vec3(0, 0, 1);
  return sbri_normalize(sbri_cross(along, spare), sbri_vec3(0, 1, 0));
}

/* A straight chain with a target on its line would stay on that line, so it is bent, towards the pole if it
 * has one. */
static void unfold(sbri_ik_chain *chain, sbf_vec3 target, sbr_transform *frames) {
  uint32_t n = chain->count;
  float reach = sbri_ik_reach(chain);
  sbf_vec3 root = frames[0].position, away = sbri_sub(frames[n - 1].position, root);
  if (n < 3 || sbri_length(away) < (1 - STRAIGHT) * reach) return;
  if (sbri_length(sbri_sub(target, root)) > (1 - STRAIGHT) * reach) return;
  sbf_vec3 along = sbri_normalize(away, sbri_vec3(0, 1, 0)), spare = any_across(along);
  sbf_vec3 off = across(sbri_sub(target, root), along);
  if (sbri_length(off) > STRAIGHT * reach) return;
  sbf_vec3 bow = chain->has_pole ? across(sbri_sub(chain->pole, root), along) : spare;
  sbf_vec3 axis = sbri_normalize(sbri_cross(along, sbri_normalize(bow, spare)), spare);
  for (uint32_t i = 0; i + 1 < n; i++) {
    float angle = i == 0 ? UNFOLD : -2 * UNFOLD / (float)(n - 2);
    sbri_ik_rotate_bone(chain, i, sbri_quat_about(axis, angle), frames);
    sbri_ik_compute_frames(chain, frames);
  }
}

/* Rotates the chain about the line from its root to its end until it bends towards the pole. */
static void rotate_to_pole(sbri_ik_chain *chain, sbr_transform *frames) {
  uint32_t n = chain->count;
  if (!chain->has_pole || n < 3) return;
  sbf_vec3 root = frames[0].position, away = sbri_sub(frames[n - 1].position, root), bow = {0, 0, 0};
  float reach = sbri_ik_reach(chain);
  if (sbri_length(away) < 1e-4f * reach) return;
  sbf_vec3 along = sbri_normalize(away, sbri_vec3(0, 1, 0));
  for (uint32_t i = 1; i + 1 < n; i++) bow = sbri_add(bow, across(sbri_sub(frames[i].position, root), along));
  sbf_vec3 wanted = across(sbri_sub(chain->pole, root), along);
  if (sbri_length(bow) < 1e-4f * reach || sbri_length(wanted) < 1e-5f * reach) return;
  bow = sbri_normalize(bow, along), wanted = sbri_normalize(wanted, along);
  float angle = sbri_atan2(sbri_dot(along, sbri_cross(bow, wanted)), sbri_dot(bow, wanted));
  sbri_ik_rotate_bone(chain, 0, sbri_quat_about(along, angle), frames);
  sbri_ik_compute_frames(chain, frames);
}

bool sbri_ik_comfort_is_even(const sbri_ik_joint *joint) {
  return sbri_dot(joint->comfort_slack, joint->comfort_slack) <= 0;
}

sbf_vec3 sbri_ik_comfort_fraction(const sbri_ik_joint *joint, sbf_vec3 turn) {
  sbf_vec3 slack = joint->comfort_slack;
  return sbri_vec3(turn.x * (1 - slack.x), turn.y * (1 - slack.y), turn.z * (1 - slack.z));
}

/* Before solving: moves to the comfort by its weight, about each of the joint's own axes. */
static void move_to_comfort(sbri_ik_joint *joint) {
  if (sbri_ik_comfort_is_even(joint)) {
    joint->rotation = sbri_quat_blend(joint->rotation, joint->comfort, joint->comfort_weight);
    return;
  }
  sbf_quat direction = sbri_quat_multiply(sbri_quat_conjugate(joint->rotation), joint->comfort);
  sbf_vec3 turn =
      sbri_scale(sbri_ik_comfort_fraction(joint, sbri_quat_log(direction)), joint->comfort_weight);
  joint->rotation = sbri_quat_normalize(sbri_quat_multiply(joint->rotation, sbri_quat_exp(turn)));
}

sbf_vec3 sbri_ik_begin(sbri_ik_chain *chain, sbr_transform *frames) {
  for (uint32_t i = 0; i < chain->count; i++) {
    sbri_ik_joint *joint = &chain->joints[i];
    if (joint->comfort_weight > 0) move_to_comfort(joint);
    joint->rotation = sbri_joint_limit_clamp(joint->limit, joint->rotation);
  }
  sbri_ik_compute_frames(chain, frames);
  sbf_vec3 root = frames[0].position, to = sbri_sub(chain->target, root);
  float distance = sbri_length(to),
        eased = sbri_soften_reach(distance, sbri_ik_reach(chain), chain->soft_reach);
  sbf_vec3 target = distance > 0 ? sbri_add_scaled(root, to, eased / distance) : chain->target;
  if (eased == distance) target = chain->target;
  unfold(chain, target, frames);
  rotate_to_pole(chain, frames);
  return target;
}

void sbri_ik_through(sbri_ik_chain *chain, const sbf_vec3 *positions, sbr_transform *frames) {
  const sbr_transform *before = &chain->base;
  for (uint32_t i = 0; i < chain->count; i++) {
    sbri_ik_joint *joint = &chain->joints[i];
    frames[i].position = sbri_add(before->position, sbri_rotate(before->rotation, joint->offset));
    frames[i].rotation = sbri_quat_normalize(sbri_quat_multiply(before->rotation, joint->rotation));
    before = &frames[i];
    if (i + 1 == chain->count) break;
    sbf_vec3 is = sbri_rotate(frames[i].rotation, chain->joints[i + 1].offset);
    is = sbri_normalize(is, sbri_vec3(0, 1, 0));
    sbf_vec3 wanted = sbri_normalize(sbri_sub(positions[i + 1], frames[i].position), is);
    sbri_ik_rotate_bone(chain, i, sbri_quat_between(is, wanted), frames);
    frames[i].rotation =
        sbri_quat_normalize(sbri_quat_multiply(rotation_before(chain, i, frames), joint->rotation));
  }
}

sbri_ik_result sbri_ik_finish(
    sbri_ik_chain *chain, sbf_vec3 target, sbr_transform *frames, uint32_t iterations) {
  uint32_t last = chain->count - 1;
  float error = sbri_length(sbri_sub(frames[last].position, target));
  if (chain->has_pole && chain->count > 2) {
    sbf_quat kept = chain->joints[0].rotation;
    rotate_to_pole(chain, frames);
    float turned = sbri_length(sbri_sub(frames[last].position, target));
    if (turned > error + chain->tolerance) { /* forbidden by the root's limit: the target has priority */
      chain->joints[0].rotation = kept;
      sbri_ik_compute_frames(chain, frames);
    }
  }
  if (chain->copy_rotation > 0) {
    sbf_quat to = sbri_quat_blend(frames[last].rotation, chain->target_rotation, chain->copy_rotation);
    sbri_ik_rotate_bone(
        chain, last, sbri_quat_multiply(to, sbri_quat_conjugate(frames[last].rotation)), frames);
  }
  sbri_ik_compute_frames(chain, frames);
  error = sbri_length(sbri_sub(frames[last].position, target));
  return (sbri_ik_result){iterations, error, error <= chain->tolerance};
}
