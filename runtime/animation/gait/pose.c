/* The pose: the spine distributes the yaw of hips and chest, the head leads, tails follow, legs reach for
 * their feet. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"
#include "animation/ik/ik.h"
#include "animation/ik/two_bone.h"
#include "math/quat.h"
#include "math/trig.h"

static const sbf_vec3 UP = {0, 1, 0};
static const float SOLE_TOLERANCE = 5e-4f; /* fraction of a leg's length: tolerance of a sole's position */
static const float HANGING_PHASE =
    0.25f; /* phase of a step from which on a foot hangs freely, and the same before its end */
enum { SOLE_ITERATIONS = 4 };

static sbf_quat yaw_rotation(float yaw) {
  return sbri_quat_about(UP, yaw);
}

/* Yaw relative to the heading that a bone of the spine has or inherits. */
static float spine_yaw(const sbri_rig *rig, const sbri_stance *stance, int32_t bone) {
  if (bone < 0 || rig->bones.spine_fraction[bone] < 0) return 0;
  return stance->hips_yaw + rig->bones.spine_fraction[bone] * (stance->chest_yaw - stance->hips_yaw);
}

/* Rotation of a tail's bone in world axes, relative to the bones before it. */
static sbf_quat tail_rotation(const sbri_rig *rig, const sbri_gait_state *state, const sbri_stance *stance,
    uint32_t bone, sbf_vec3 up) {
  const sbri_lag *lags = (const sbri_lag *)(const void *)(state + 1);
  for (uint32_t t = 0; t < rig->tails.count; t++) {
    const sbri_tail *tail = &rig->tails.at[t];
    for (uint32_t k = 0; k < tail->bone_count; k++) {
      if (tail->bone_indices[k] != bone) continue;
      const sbri_lag *lag = &lags[2 * (tail->first_state + k)];
      /* The parent of a first bone may be the root instead of the hips; the rotation that it inherits is
       * subtracted. */
      float inherited_yaw = k                                             ? lag[-2].value
                            : rig->bones.parents[bone] == rig->gait->hips ? stance->hips_yaw
                                                                          : 0;
      float inherited_pitch = k ? lag[-1].value : stance->hips_pitch; /* already in the root */
      sbf_quat aside = sbri_quat_about(up, lag[0].value - inherited_yaw);
      if (lag[1].value == inherited_pitch) return aside;
      sbf_vec3 left = sbri_rotate(stance->root.rotation, sbri_rotate_yaw(sbri_vec3(1, 0, 0), lag[0].value));
      return sbri_quat_multiply(sbri_quat_about(left, lag[1].value - inherited_pitch), aside);
    }
  }
  return sbri_quat_identity();
}

/* Clamps a bone's rotation relative to its parent. */
static void limit_bone(const sbri_rig *rig, uint32_t bone, const sbr_transform *parent, sbr_transform *pose) {
  if (!rig->bones.limits[bone].active) return;
  sbf_quat local = sbri_quat_multiply(sbri_quat_conjugate(parent->rotation), pose[bone].rotation);
  sbf_quat limited = sbri_joint_limit_clamp(&rig->bones.limits[bone], local);
  if (limited.x == local.x && limited.y == local.y && limited.z == local.z && limited.w == local.w) return;
  pose[bone].rotation = sbri_quat_normalize(sbri_quat_multiply(parent->rotation, limited));
}

/* By clips or poses. The gait alone respects limits. */
static bool is_animated(const sbri_rig *rig, const sbri_gait_state *state) {
  bool animated =
      rig->walks.walk_count > 0 || rig->bones.base_local != rig->bones.rest_local || sbri_has_motion(rig);
  for (int l = 0; l < SBRI_CLIP_LAYERS; l++) animated = animated || state->clips[l].clip_plus_1;
  return animated;
}

/* Poses all bones that do not depend on legs, parents first. On entry `pose` is relative to parents, on
 * return in world axes. */
static void pose_bones(const sbri_rig *rig, const sbri_gait_state *state, const sbri_stance *stance,
    float scale, sbr_transform *pose) {
  sbf_vec3 up = sbri_rotate(stance->root.rotation, UP);
  bool animated = is_animated(rig, state);
  for (uint32_t i = 0; i < rig->bones.count; i++) {
    if (rig->bones.roles[i] == SBRI_ROLE_LEG) continue; /* relative to its parent until its leg is solved */
    const sbr_transform *parent = rig->bones.parents[i] >= 0 ? &pose[rig->bones.parents[i]] : &stance->root;
    sbf_vec3 offset = sbri_scale(pose[i].position, scale); /* still relative to its parent */
    sbf_quat is = sbri_quat_multiply(parent->rotation, pose[i].rotation), rotation;
    pose[i].position = sbri_add(parent->position, sbri_rotate(parent->rotation, offset));
    switch (rig->bones.roles[i]) {
    case SBRI_ROLE_SPINE:
      rotation = sbri_quat_about(
          up, spine_yaw(rig, stance, (int32_t)i) - spine_yaw(rig, stance, rig->bones.parents[i]));
      break;
    case SBRI_ROLE_HEAD:
      rotation = sbri_quat_about(up, state->head_yaw.value - stance->chest_yaw);
      break;
    case SBRI_ROLE_TAIL:
      rotation = tail_rotation(rig, state, stance, i, up);
      break;
    default:
      pose[i].rotation = sbri_quat_normalize(is);
      if (animated) limit_bone(rig, i, parent, pose);
      continue;
    }
    pose[i].rotation = sbri_quat_normalize(sbri_quat_multiply(rotation, is));
    limit_bone(rig, i, parent, pose);
  }
}

/* Pole of the leg, moved with its bone in the present pose. */
static sbf_vec3 pole_of(
    const sbri_leg *leg, const sbr_transform *root, float scale, const sbr_transform *pose) {
  const sbr_transform *now = leg->pole.bone >= 0 ? &pose[leg->pole.bone] : root;
  return sbri_add(now->position, sbri_rotate(now->rotation, sbri_scale(leg->pole.position, scale)));
}

/* Sets the transform of a leg's bone. Other children follow, or are posed later. */
static void set_bone_transform(
    const sbri_rig *rig, const sbri_leg *leg, int32_t bone, sbr_transform to, sbr_transform *pose) {
  if (!leg->is_last && (leg->has_others || bone == leg->foot)) {
    sbf_quat rotation = sbri_quat_multiply(to.rotation, sbri_quat_conjugate(pose[bone].rotation));
    sbri_rig_rotate_bone(rig, (uint32_t)bone, rotation, pose);
    sbri_rig_shift(rig, (uint32_t)bone, sbri_sub(to.position, pose[bone].position), pose);
  }
  pose[bone] = to;
}

/* Places the foot and rotates it towards the ground's slope by the chain's copy_rotation. */
static void pose_foot(const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 ankle,
    sbf_quat own, sbr_transform *pose) {
  sbf_quat flat = sbri_quat_multiply(foot->frame.rotation, rig->bones.rest[leg->foot].rotation);
  sbf_quat turned = sbri_quat_blend(own, flat, leg->copy_rotation);
  set_bone_transform(rig, leg, leg->foot, (sbr_transform){ankle, turned}, pose);
}

/* A leg of one bone: it points at the foot's target. */
static void pose_one_bone_leg(
    const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 ankle, sbr_transform *pose) {
  sbf_vec3 hip = pose[leg->upper].position, down = sbri_vec3(0, -1, 0);
  sbf_vec3 is = sbri_normalize(sbri_sub(pose[leg->foot].position, hip), down);
  sbf_quat rotation = sbri_quat_between(is, sbri_normalize(sbri_sub(ankle, hip), is));
  sbri_rig_rotate_bone(rig, (uint32_t)leg->upper, rotation, pose);
  /* The leg has a fixed length. The foot stays at its position, so its distance from the leg's end varies. */
  pose_foot(rig, leg, foot, ankle, pose[leg->foot].rotation, pose);
}

/* Ankle position within the leg's soft reach. */
static sbf_vec3 soft_ankle(const sbri_leg *leg, sbf_vec3 hip, sbf_vec3 ankle, float scale) {
  sbf_vec3 offset = sbri_sub(ankle, hip);
  float distance = sbri_length(offset),
        eased = sbri_soften_reach(distance, leg->length.reach * scale, leg->length.soft_reach);
  return eased < distance ? sbri_add_scaled(hip, offset, eased / distance) : ankle;
}

/* Two bones in closed form, then joint limits. */
static void solve_leg(const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, sbf_vec3 ankle,
    sbf_vec3 pole, sbf_vec3 fallback, float scale, sbr_transform *pose) {
  sbf_vec3 hip = pose[leg->upper].position;
  sbri_two_bone_result solved =
      sbri_two_bone(hip, ankle, pole, fallback, leg->length.upper * scale, leg->length.lower * scale, 0);

  sbf_vec3 side1 = sbri_cross(sbri_sub(solved.ankle, hip), sbri_sub(solved.knee, hip));
  if (sbri_dot(side1, side1) < 1e-12f) side1 = sbri_cross(sbri_sub(solved.ankle, hip), sbri_sub(pole, hip));
  sbf_quat upper =
      sbri_quat_multiply(sbri_bone_facing(sbri_sub(solved.knee, hip), side1), leg->upper_inverse);
  sbf_quat lower =
      sbri_quat_multiply(sbri_bone_facing(sbri_sub(solved.ankle, solved.knee), side1), leg->lower_inverse);
  sbf_quat thigh = sbri_quat_normalize(sbri_quat_multiply(upper, rig->bones.rest[leg->upper].rotation));
  sbf_quat shin = sbri_quat_normalize(sbri_quat_multiply(lower, rig->bones.rest[leg->lower].rotation));
  set_bone_transform(rig, leg, leg->upper, (sbr_transform){hip, thigh}, pose);
  set_bone_transform(rig, leg, leg->lower, (sbr_transform){solved.knee, shin}, pose);
  sbf_quat own = sbri_quat_multiply(lower, rig->bones.rest[leg->foot].rotation);
  pose_foot(rig, leg, foot, solved.ankle, own, pose);
  sbri_leg_limit(rig, leg, ankle, pole, scale, pose);
}

/* Offset of the ankle from the middle of the sole for the foot's rotation in the pose. */
static sbf_vec3 ankle_over_sole(
    const sbri_rig *rig, const sbri_leg *leg, float scale, const sbr_transform *pose) {
  sbf_quat turned =
      sbri_quat_multiply(pose[leg->foot].rotation, sbri_quat_conjugate(rig->bones.rest[leg->foot].rotation));
  return sbri_scale(sbri_rotate(turned, leg->home.ankle), scale);
}

/* Poses the other bones below a solved leg. */
static void pose_children_of_leg(const sbri_rig *rig, const sbri_gait_state *state, const sbri_leg *leg,
    float scale, sbr_transform *pose) {
  bool animated = is_animated(rig, state);
  for (uint32_t k = rig->bones.subtree_begin[leg->upper] + 1; k < rig->bones.subtree_end[leg->upper]; k++) {
    uint32_t b = rig->bones.subtree[k];
    const sbr_transform *parent = &pose[rig->bones.parents[b]];
    if ((int32_t)b == leg->lower || (int32_t)b == leg->foot || (int32_t)b == leg->toe) continue;
    sbf_vec3 offset = sbri_scale(pose[b].position, scale);
    pose[b].position = sbri_add(parent->position, sbri_rotate(parent->rotation, offset));
    pose[b].rotation = sbri_quat_normalize(sbri_quat_multiply(parent->rotation, pose[b].rotation));
    if (animated) limit_bone(rig, b, parent, pose);
  }
}

/* Distance of a leg's ankle and hip in the pose. */
static float span_of(const sbri_leg *leg, const sbr_transform *pose) {
  return sbri_length(sbri_sub(pose[leg->foot].position, pose[leg->upper].position));
}

/* Limits the angular acceleration of a swinging leg's knee, and stores its angle. */
static void limit_knee(const sbri_rig *rig, const sbri_gait_input *input, const sbri_leg *leg,
    sbri_foot *foot, sbf_vec3 pole, sbf_vec3 fallback, sbri_advance advance, sbr_transform *pose) {
  float target = 0, span = span_of(leg, pose);
  if (advance == SBRI_ADVANCE_TICK) {
    target = sbri_knee_angle(leg, input->scale, span);
    bool is_swinging = !foot->planted && leg->home.chain_bone < 0; /* chains drag the legs on them */
    float angle = is_swinging ? sbri_knee_follow(foot, target, input->tick_s) : target;
    foot->knee.locked = angle != target ? angle : 0;
  }
  if (foot->knee.locked > 0 && span > 0) {
    float fraction = sbri_knee_distance(leg, input->scale, foot->knee.locked) / span;
    sbf_vec3 hip = pose[leg->upper].position;
    sbf_vec3 ankle = sbri_add_scaled(hip, sbri_sub(pose[leg->foot].position, hip), fraction);
    solve_leg(rig, leg, foot, ankle, pole, fallback, input->scale, pose);
    span = span_of(leg, pose);
  }
  if (advance == SBRI_ADVANCE_TICK)
    sbri_knee_store(foot, foot->knee.locked > 0 ? sbri_knee_angle(leg, input->scale, span) : target, target,
        input->tick_s);
}

/* A leg whose long foot leans over its toe: the ankle follows, and the sole stays. */
static void pose_long_foot(const sbri_rig *rig, const sbri_leg *leg, sbri_foot *foot,
    const sbri_gait_input *input, sbf_vec3 sole, sbf_vec3 fallback, sbri_advance advance,
    sbr_transform *pose) {
  float scale = input->scale, limited = SOLE_TOLERANCE * (leg->length.upper + leg->length.lower) * scale;
  sbri_foot leaning = *foot;
  sbf_vec3 upright = sbri_ankle_over(leg, foot, sole, scale);
  sbf_vec3 ankle = sbri_long_foot_tilt(
      leg, foot, pose[leg->upper].position, sole, upright, input, advance, &leaning.frame.rotation);
  for (int iteration = 0; iteration < SOLE_ITERATIONS; iteration++) {
    solve_leg(rig, leg, &leaning, ankle, foot->pole, fallback, scale, pose);
    if (!rig->bones.limits[leg->foot].active) break;
    ankle = sbri_add(sole, sbri_long_foot_over(rig, leg, foot, scale, pose));
    foot->reach_error = sbri_length(sbri_sub(ankle, pose[leg->foot].position));
    if (foot->reach_error <= limited) break;
  }
  sbr_transform toe = sbri_long_foot_toe(rig, leg, foot, scale, pose), *is = &pose[leg->toe];
  if (!leg->is_last) {
    sbri_rig_rotate_bone(
        rig, (uint32_t)leg->toe, sbri_quat_multiply(toe.rotation, sbri_quat_conjugate(is->rotation)), pose);
    sbri_rig_shift(rig, (uint32_t)leg->toe, sbri_sub(toe.position, is->position), pose);
  }
  *is = toe;
}

static void pose_leg(const sbri_rig *rig, sbri_gait_state *state, const sbri_stance *stance,
    const sbri_gait_input *input, uint32_t index, sbri_advance advance, sbr_transform *pose) {
  const sbri_leg *leg = &rig->legs[index];
  sbri_foot *foot = &state->feet[index];
  float scale = input->scale;
  sbf_vec3 hip = pose[leg->upper].position;
  sbf_vec3 sole =
      sbri_vec3(foot->ground.x, foot->ground.y + foot->lift + state->motion.position.y, foot->ground.z);
  sbf_vec3 flat = sbri_ankle_over(leg, foot, sole, scale), ankle = flat;
  sbf_vec3 pole = foot->pole = pole_of(leg, &stance->root, scale, pose);
  if (leg->lower < 0) {
    pose_one_bone_leg(rig, leg, foot, ankle, pose);
    return;
  }
  sbf_vec3 fallback = sbri_add(hip, sbri_rotate(stance->root.rotation, sbri_vec3(0, 0, 1)));
  float phase_to_ground = foot->step.phase < 0.5f
                              ? foot->step.phase
                              : 1 - foot->step.phase; /* phase since lift-off, or until landing */
  float planted_weight = foot->planted ? 1 : 1 - sbri_smooth(phase_to_ground / HANGING_PHASE);
  float limited = SOLE_TOLERANCE * (leg->length.upper + leg->length.lower) * scale;
  foot->reach_error = 0;
  if (leg->has_toe) {
    pose_long_foot(rig, leg, foot, input, sole, fallback, advance, pose);
    if (leg->is_last) pose_children_of_leg(rig, state, leg, scale, pose);
    return;
  }
  for (int iteration = 0; iteration < SOLE_ITERATIONS; iteration++) {
    solve_leg(rig, leg, foot, soft_ankle(leg, hip, ankle, scale), pole, fallback, scale, pose);
    if (!rig->bones.limits[leg->foot].active && leg->copy_rotation == 1) break;
    /* A foot at its ankle's limit keeps its position on the ground; in the air it follows the ankle. */
    sbf_vec3 offset = ankle_over_sole(rig, leg, scale, pose);
    foot->reach_error = sbri_length(sbri_sub(sbri_add(sole, offset), pose[leg->foot].position));
    if (foot->reach_error <= limited || planted_weight <= 0) break;
    ankle = sbri_lerp(flat, sbri_add(sole, offset), planted_weight);
  }
  limit_knee(rig, input, leg, foot, pole, fallback, advance, pose);
  if (leg->is_last) pose_children_of_leg(rig, state, leg, scale, pose);
}

/* Stores the hip positions of the pose. */
static void store_hips(
    const sbri_rig *rig, sbri_gait_state *state, const sbr_transform *root, const sbr_transform *pose) {
  sbf_quat to_root = sbri_quat_conjugate(root->rotation);
  for (uint32_t i = 0; i < rig->leg_count; i++)
    state->feet[i].hip = sbri_rotate(to_root, sbri_sub(pose[rig->legs[i].upper].position, root->position));
}

/* The body was lowered for the hip positions of the previous tick. The gait moves them slowly enough for
 * that; a clip or a weight follower may have raised them since. */
static void lower_to_feet(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    sbr_transform *root, sbr_transform *pose) {
  float drop = sbri_body_drop(rig, state, input, root);
  if (!(drop > 0)) return;
  root->position.y -= drop;
  for (uint32_t i = 0; i < rig->bones.count; i++)
    if (rig->bones.roles[i] != SBRI_ROLE_LEG) pose[i].position.y -= drop;
}

/* The gait plans without weight followers, because otherwise both would react to each other. */
static void apply_weights(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *root, sbr_transform *pose) {
  sbf_vec3 hips[SBRI_MAX_LEGS];
  bool moved = sbri_weights_pose(rig, state, input, advance, pose);
  if (!rig->leg_count || (!moved && !sbri_clips_play(state))) return;
  for (uint32_t i = 0; moved && i < rig->leg_count; i++) hips[i] = state->feet[i].hip;
  if (moved) store_hips(rig, state, root, pose);
  lower_to_feet(rig, state, input, root, pose);
  for (uint32_t i = 0; moved && i < rig->leg_count; i++) state->feet[i].hip = hips[i];
}

void sbri_body_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_advance advance, sbr_transform *pose) {
  sbri_stance stance = {.root = state->posture.root,
      .hips_yaw = state->posture.hips_yaw,
      .chest_yaw = state->posture.chest_yaw,
      .hips_pitch = state->posture.hips_pitch,
      .lowered = state->posture.lowered};
  if (input->keeps_rest_pose) {
    stance.hips_yaw = stance.chest_yaw = 0;
    stance.root.rotation = yaw_rotation(state->motion.heading);
  }
  for (uint32_t i = 0; input->keeps_rest_pose && i < rig->bones.count; i++) {
    sbf_vec3 position = sbri_scale(rig->bones.rest[i].position, input->scale);
    pose[i].position = sbri_add(stance.root.position, sbri_rotate(stance.root.rotation, position));
    pose[i].rotation = sbri_quat_multiply(stance.root.rotation, rig->bones.rest[i].rotation);
  }
  if (input->keeps_rest_pose) {
    sbri_squashes_pose(rig, state, input, SBRI_ADVANCE_RESET, pose);
    sbri_weights_pose(rig, state, input, SBRI_ADVANCE_RESET, pose);
    sbri_springs_pose(rig, state, input, SBRI_ADVANCE_RESET, pose);
    return;
  }
  sbri_clips_pose(rig, state, input->scale, pose);
  pose_bones(rig, state, &stance, input->scale, pose);
  sbri_motion_pose(rig, state, input, &stance.root, pose);
  sbri_chains_pose(rig, state, input, &stance.root, advance, pose);
  sbri_squashes_pose(rig, state, input, advance, pose);
  store_hips(rig, state, &stance.root, pose);
  apply_weights(rig, state, input, advance, &stance.root, pose);
  for (uint32_t i = 0; i < rig->leg_count; i++) pose_leg(rig, state, &stance, input, i, advance, pose);
  sbri_limbs_reach(rig, state, input, &stance.root, pose);
  sbri_followers_pose(rig, state, input, &stance.root, advance, pose);
  sbri_springs_pose(rig, state, input, advance, pose);
}
