/* The body over its feet, and the pose: hips and chest turn with the feet's lines, the spine shares the turn,
 * the head leads, tails follow, legs reach for their feet. */
#include "gait/gait_state.h"
#include "ik/two_bone.h"
#include "math/quat.h"
#include "math/trig.h"

static const sbf_vec3 UP = {0, 1, 0};

static sbf_quat yaw_rotation(float yaw) {
  float s, c;
  sbri_sincos(0.5f * yaw, &s, &c);
  return (sbf_quat){0, s, 0, c};
}

/* Mean of the places below the feet on one side of the body (hind or fore, left or right); false for none. */
static bool feet_center(
    const sbri_rig *rig, const sbri_gait_state *state, int hind, int left, sbf_vec3 *center) {
  sbf_vec3 sum = {0, 0, 0};
  float count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (hind >= 0 && rig->legs[i].hind != hind) continue;
    if (left >= 0 && (rig->legs[i].home.x > 0) != left) continue;
    sum = sbri_add(sum, state->feet[i].ground);
    count += 1;
  }
  *center = sbri_scale(sum, count > 0 ? 1 / count : 0);
  return count > 0;
}

/* Turn of the line from the right foot to the left against the heading: how far one side is ahead. */
static float line_yaw(const sbri_rig *rig, const sbri_gait_state *state, int hind) {
  sbf_vec3 left, right;
  if (!feet_center(rig, state, hind, 1, &left) || !feet_center(rig, state, hind, 0, &right)) return 0;
  sbf_vec3 line = sbri_turned(sbri_sub(left, right), -state->heading);
  return rig->gait->hip_tilt * -sbri_atan2(line.z, line.x > 1e-6f ? line.x : 1e-6f);
}

/* Slope, as an angle, between two places `run` apart. */
static float slope(sbf_vec3 a, sbf_vec3 b, float run) {
  return run > 1e-6f ? sbri_atan2(b.y - a.y, run) : 0;
}

/* How far the body must come down for every leg to reach its foot. */
static float crouch(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root) {
  float most = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0) continue;
    float reach = (leg->upper_length + leg->lower_length) * (1 - leg->soft_reach) * input->scale;
    sbf_vec3 hip = sbri_scale(rig->rest[leg->upper].position, input->scale);
    hip = sbri_add(root->position, sbri_rotate(root->rotation, hip));
    sbf_vec3 ankle = sbri_add_scaled(foot->ground, foot->normal, leg->home.y * input->scale);
    ankle.y += foot->lift + state->position.y;
    sbf_vec3 away = sbri_sub(hip, ankle);
    float left = reach * reach - away.x * away.x - away.z * away.z;
    float drop =
        left > 0 ? away.y - sqrtf(left) : 0; /* a leg that is too far to the side is not helped by it */
    if (drop > most) most = drop;
  }
  return most;
}

sbri_stance sbri_body_stance(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stance stance = {.root = {state->position, yaw_rotation(state->heading)}};
  sbf_vec3 all, hind, fore, left, right;
  bool on_feet = rig->leg_count && feet_center(rig, state, -1, -1, &all);
  float raised = state->position.y;
  stance.root.position.y = raised + (on_feet ? all.y : sbri_ground_below(input, state->position, NULL).y);
  if (!on_feet) return stance;
  float pitch = 0, roll = 0, share = rig->gait->body_tilt;
  if (feet_center(rig, state, 1, -1, &hind) && feet_center(rig, state, 0, -1, &fore))
    pitch = share * slope(hind, fore, (rig->fore_z - rig->hind_z) * input->scale);
  if (feet_center(rig, state, -1, 1, &left) && feet_center(rig, state, -1, 0, &right))
    roll = share * slope(right, left, 2 * rig->half_width * input->scale);
  float sp, cp, sr, cr;
  sbri_sincos(-0.5f * pitch, &sp, &cp);
  sbri_sincos(0.5f * roll, &sr, &cr);
  sbf_quat tilt = sbri_quat_multiply((sbf_quat){sp, 0, 0, cp}, (sbf_quat){0, 0, sr, cr});
  /* The tilt is about the middle between the feet, at the height of the ground. */
  sbf_vec3 middle = sbri_vec3(0, 0, 0.5f * (rig->hind_z + rig->fore_z) * input->scale);
  sbf_quat heading = stance.root.rotation;
  stance.root.rotation = sbri_quat_normalize(sbri_quat_multiply(heading, tilt));
  sbf_vec3 moved = sbri_sub(sbri_rotate(heading, middle), sbri_rotate(stance.root.rotation, middle));
  stance.root.position = sbri_add(stance.root.position, moved);
  stance.root.position.y -= crouch(rig, state, input, &stance.root);
  stance.hips_yaw = line_yaw(rig, state, 1);
  stance.chest_yaw = rig->gait->chest >= 0 ? line_yaw(rig, state, 0) : stance.hips_yaw;
  return stance;
}

/* Rotations of all bones before the legs are solved: rest, turned about the body's up axis. */
static void pose_spine(const sbri_rig *rig, const sbri_gait_state *state, const sbri_stance *stance,
    float scale, sbr_transform *pose) {
  for (uint32_t i = 0; i < rig->bone_count; i++) {
    const sbr_transform *parent = rig->parents[i] >= 0 ? &pose[rig->parents[i]] : &stance->root;
    sbf_vec3 offset = sbri_scale(rig->rest_local[i].position, scale);
    pose[i].position = sbri_add(parent->position, sbri_rotate(parent->rotation, offset));
    float share = rig->spine_share[i];
    if (share < 0) {
      pose[i].rotation = sbri_quat_multiply(parent->rotation, rig->rest_local[i].rotation);
      continue;
    }
    float yaw = stance->hips_yaw + share * (stance->chest_yaw - stance->hips_yaw);
    sbf_quat turned = sbri_quat_multiply(stance->root.rotation, yaw_rotation(yaw));
    pose[i].rotation = sbri_quat_multiply(turned, rig->rest[i].rotation);
  }
  const sbf_head_turn *head = rig->gait ? rig->gait->head : NULL;
  if (!head) return;
  sbf_vec3 up = sbri_rotate(stance->root.rotation, UP);
  float s, c;
  sbri_sincos(0.5f * (state->head_yaw.value - stance->chest_yaw), &s, &c);
  sbri_rig_turn(rig, (uint32_t)head->bone, (sbf_quat){up.x * s, up.y * s, up.z * s, c}, pose);
}

static void pose_tails(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_stance *stance, sbr_transform *pose) {
  const sbri_lag *lags = (const sbri_lag *)(const void *)(state + 1);
  sbf_vec3 up = sbri_rotate(stance->root.rotation, UP);
  for (uint32_t t = 0; t < rig->tail_count; t++) {
    const sbri_tail *tail = &rig->tails[t];
    /* A tail's first bone may hang on the root rather than on the hips: what it already turned is taken off.
     */
    float yaw_done = rig->parents[tail->bones[0]] == rig->gait->hips ? stance->hips_yaw : 0, pitch_done = 0;
    for (uint32_t k = 0; k < tail->bone_count; k++) {
      const sbri_lag *lag = &lags[2 * (tail->first_state + k)];
      sbf_vec3 side = sbri_rotate(stance->root.rotation, sbri_turned(sbri_vec3(1, 0, 0), lag[0].value));
      float s, c, sp, cp;
      sbri_sincos(0.5f * (lag[0].value - yaw_done), &s, &c);
      sbri_sincos(0.5f * (lag[1].value - pitch_done), &sp, &cp);
      sbf_quat yaw = {up.x * s, up.y * s, up.z * s, c}, pitch = {side.x * sp, side.y * sp, side.z * sp, cp};
      sbri_rig_turn(rig, tail->bones[k], sbri_quat_multiply(pitch, yaw), pose);
      yaw_done = lag[0].value;
      pitch_done = lag[1].value;
    }
  }
}

/* Rotation that takes the rest directions (along, side) to new ones; both pairs are made orthonormal. */
static sbf_quat turn_between(sbf_vec3 along0, sbf_vec3 side0, sbf_vec3 along1, sbf_vec3 side1) {
  sbf_vec3 y0 = sbri_normalize(along0, UP), y1 = sbri_normalize(along1, UP);
  sbf_vec3 x0 = sbri_normalize(sbri_add_scaled(side0, y0, -sbri_dot(side0, y0)), sbri_vec3(1, 0, 0));
  sbf_vec3 x1 = sbri_normalize(sbri_add_scaled(side1, y1, -sbri_dot(side1, y1)), sbri_vec3(1, 0, 0));
  sbf_quat from = sbri_quat_from_axes(x0, y0, sbri_cross(x0, y0));
  sbf_quat to = sbri_quat_from_axes(x1, y1, sbri_cross(x1, y1));
  return sbri_quat_multiply(to, sbri_quat_conjugate(from));
}

/* The leg's pole, carried by its bone as posed so far. */
static sbf_vec3 pole_of(const sbri_rig *rig, const sbri_leg *leg, const sbr_transform *root, float scale,
    const sbr_transform *pose) {
  const sbr_transform asset = {{0, 0, 0}, {0, 0, 0, 1}};
  const sbr_transform *rest = leg->pole_bone >= 0 ? &rig->rest[leg->pole_bone] : &asset;
  const sbr_transform *now = leg->pole_bone >= 0 ? &pose[leg->pole_bone] : root;
  sbf_vec3 own = sbri_rotate(sbri_quat_conjugate(rest->rotation), sbri_sub(leg->pole, rest->position));
  return sbri_add(now->position, sbri_rotate(now->rotation, sbri_scale(own, scale)));
}

/* Turns the foot, and what hangs on it (toes), to a rotation, by as much as the chain says to that of the
 * ground.
 */
static void pose_foot(const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float heading,
    sbf_quat own, sbr_transform *pose) {
  sbf_quat level = sbri_quat_multiply(sbri_quat_between(UP, foot->normal), yaw_rotation(heading));
  sbf_quat flat = sbri_quat_multiply(level, rig->rest[leg->foot].rotation);
  sbf_quat after = sbri_quat_blend(own, flat, leg->copy_rotation);
  sbf_quat before = pose[leg->foot].rotation;
  sbri_rig_turn(rig, (uint32_t)leg->foot, sbri_quat_multiply(after, sbri_quat_conjugate(before)), pose);
}

/* One bone: it points at where the foot should be. */
static void pose_peg(const sbri_rig *rig, const sbri_leg *leg, const sbri_foot *foot, float heading,
    sbf_vec3 ankle, sbr_transform *pose) {
  sbf_vec3 hip = pose[leg->upper].position, spare = sbri_vec3(0, -1, 0);
  sbf_vec3 is = sbri_normalize(sbri_sub(pose[leg->foot].position, hip), spare);
  sbf_quat turn = sbri_quat_between(is, sbri_normalize(sbri_sub(ankle, hip), is));
  sbri_rig_turn(rig, (uint32_t)leg->upper, turn, pose);
  pose_foot(rig, leg, foot, heading, pose[leg->foot].rotation, pose);
}

static void pose_leg(const sbri_rig *rig, const sbri_gait_state *state, const sbri_stance *stance,
    const sbri_gait_input *input, uint32_t index, sbr_transform *pose) {
  const sbri_leg *leg = &rig->legs[index];
  const sbri_foot *foot = &state->feet[index];
  float scale = input->scale;
  sbf_vec3 hip = pose[leg->upper].position;
  sbf_vec3 sole = sbri_vec3(foot->ground.x, foot->ground.y + foot->lift + state->position.y, foot->ground.z);
  sbf_vec3 ankle = sbri_add_scaled(sole, foot->normal, leg->home.y * scale);
  float heading = state->heading + foot->heading;
  if (leg->lower < 0) {
    pose_peg(rig, leg, foot, heading, ankle, pose);
    return;
  }
  sbf_vec3 pole = pole_of(rig, leg, &stance->root, scale, pose);
  sbf_vec3 fallback = sbri_add(hip, sbri_rotate(stance->root.rotation, sbri_vec3(0, 0, 1)));
  sbri_two_bone_result solved = sbri_two_bone(
      hip, ankle, pole, fallback, leg->upper_length * scale, leg->lower_length * scale, leg->soft_reach);

  sbf_vec3 hip0 = rig->rest[leg->upper].position, knee0 = rig->rest[leg->lower].position;
  sbf_vec3 ankle0 = rig->rest[leg->foot].position;
  sbf_vec3 side0 = sbri_cross(sbri_sub(ankle0, hip0), sbri_sub(leg->pole, hip0));
  sbf_vec3 side1 = sbri_cross(sbri_sub(solved.ankle, hip), sbri_sub(solved.knee, hip));
  if (sbri_dot(side1, side1) < 1e-12f) side1 = sbri_cross(sbri_sub(solved.ankle, hip), sbri_sub(pole, hip));
  sbf_quat upper = turn_between(sbri_sub(knee0, hip0), side0, sbri_sub(solved.knee, hip), side1);
  sbf_quat lower = turn_between(sbri_sub(ankle0, knee0), side0, sbri_sub(solved.ankle, solved.knee), side1);
  pose[leg->upper].rotation = sbri_quat_normalize(sbri_quat_multiply(upper, rig->rest[leg->upper].rotation));
  pose[leg->lower] = (sbr_transform){
      solved.knee, sbri_quat_normalize(sbri_quat_multiply(lower, rig->rest[leg->lower].rotation))};
  pose_foot(rig, leg, foot, heading, sbri_quat_multiply(lower, rig->rest[leg->foot].rotation), pose);
  sbri_rig_shift(rig, (uint32_t)leg->foot, sbri_sub(solved.ankle, pose[leg->foot].position), pose);
}

void sbri_body_pose(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform *pose) {
  sbri_stance stance = sbri_body_stance(rig, state, input);
  if (input->hold) {
    stance.hips_yaw = stance.chest_yaw = 0;
    stance.root.rotation = yaw_rotation(state->heading);
  }
  for (uint32_t i = 0; input->hold && i < rig->bone_count; i++) {
    sbf_vec3 place = sbri_scale(rig->rest[i].position, input->scale);
    pose[i].position = sbri_add(stance.root.position, sbri_rotate(stance.root.rotation, place));
    pose[i].rotation = sbri_quat_multiply(stance.root.rotation, rig->rest[i].rotation);
  }
  if (input->hold) return;
  pose_spine(rig, state, &stance, input->scale, pose);
  if (!rig->gait) return;
  pose_tails(rig, state, &stance, pose);
  for (uint32_t i = 0; i < rig->leg_count; i++) pose_leg(rig, state, &stance, input, i, pose);
}
