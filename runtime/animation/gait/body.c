/* The body over its feet. Its height and tilt follow the ground below the feet; it leans over the supporting
 * feet; it is lowered if a leg would not reach; hips and chest rotate with the lines of the feet. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"
#include "math/quat.h"
#include "math/trig.h"

static const float
    LEAN_HZ = 2.1f,
    CROUCH_HZ = 4,
    BEND_HZ =
        2.5f; /* critically damped followers; that of the crouch is also used for the belly's clearance */
static const float CROUCH_S = 0.08f; /* lag of the crouch, and its look-ahead */
static const float MAX_YAW = 0.8f;   /* rad; bound of the yaw of hips and chest */
static const float NARROWEST = 0.5f; /* fraction of the reach: minimum distance of feet in the hips' yaw */
static const float EDGE =
    0.05f; /* fraction of the reach: feet this close to an edge may stand on either side */
static const float DEEPEST = 0.3f; /* fraction of a leg's reach: maximum lowering for a foot */
static const float LOWEST = 0.3f;  /* fraction of a leg's reach: minimum height of a hip above the ground */
static const float EASY = 0.93f;   /* fraction of the reach for which the body is lowered in a stride */
static const float UPRIGHT_HZ = 1; /* critically damped follower */
static const float CLEARANCE_S = 0.25f; /* look-ahead of the belly */
static const float CLEAR = 0.03f;       /* fraction of the reach: clearance between belly and ground */
static const float RAISED = 0.1f;       /* fraction of the reach: maximum rise for the belly */
static const float UPRIGHT = 0.7f;      /* cosine: legs steeper than this are smoothed by the body's height */
static const float CROUCH_TOLERANCE =
    0.06f;                         /* fraction of the reach: tolerance between needed and present lowering */
static const float ABRUPT = 43;    /* reaches per squared second; 1.2 % per frame of 1/60 s and frame */
static const float SPARE = 0.965f; /* fraction of the full reach for which the body is lowered in advance */

static sbf_quat yaw_rotation(float yaw) {
  float s, c;
  sbri_sincos(0.5f * yaw, &s, &c);
  return (sbf_quat){0, s, 0, c};
}

typedef enum feet_of { ALL, LEFT, RIGHT, FORE, AFT, HIPS_LEFT, HIPS_RIGHT, CHEST_LEFT, CHEST_RIGHT } feet_of;

static bool is_of(const sbri_leg *leg, feet_of feet) {
  bool left = leg->home.position.x > 0;
  switch (feet) {
  case LEFT:
  case RIGHT:
    return left == (feet == LEFT);
  case FORE:
  case AFT:
    return leg->fore == (feet == FORE);
  case HIPS_LEFT:
  case HIPS_RIGHT:
    return leg->hind && left == (feet == HIPS_LEFT);
  case CHEST_LEFT:
  case CHEST_RIGHT:
    return !leg->hind && left == (feet == CHEST_LEFT);
  default:
    return true;
  }
}

/* Mean ground position of some of the feet; false if there are none. */
static bool feet_center(const sbri_rig *rig, const sbri_gait_state *state, feet_of feet, sbf_vec3 *center) {
  sbf_vec3 sum = {0, 0, 0};
  float count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!is_of(&rig->legs[i], feet)) continue;
    sum = sbri_add(sum, state->feet[i].ground);
    count += 1;
  }
  *center = sbri_scale(sum, count > 0 ? 1 / count : 0);
  return count > 0;
}

/* Yaw of the line from the right foot to the left relative to the heading. */
static float line_yaw(
    const sbri_rig *rig, const sbri_gait_state *state, float scale, feet_of on_left, feet_of on_right) {
  sbf_vec3 left, right;
  if (!feet_center(rig, state, on_left, &left) || !feet_center(rig, state, on_right, &right)) return 0;
  sbf_vec3 line = sbri_world_to_body(state, sbri_sub(left, right));
  float min = NARROWEST * rig->stand.reach * scale, more = line.x - min; /* smooth minimum */
  float width = min + 0.5f * (more + sqrtf(more * more + 0.25f * min * min));
  float yaw = rig->gait->hip_tilt * -sbri_atan2(line.z, width);
  return MAX_YAW * yaw / (MAX_YAW + fabsf(yaw)); /* feet may cross, but hips must not rotate with them */
}

/* Height of a point above the ground on the line through the body along its heading, beside the point: the
 * smallest one nearby, since a foot often stands at the edge of a stair. */
static float height_beside(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 point) {
  float step = EDGE * rig->stand.reach * input->scale, min = 1e30f;
  float forward = sbri_world_to_body(state, sbri_sub(point, state->motion.position)).z;
  for (int k = -1; k <= 1; k++) {
    sbf_vec3 ahead = sbri_body_to_world(state, sbri_vec3(0, 0, forward + (float)k * step));
    float height = point.y - sbri_ground_below(input, sbri_add(state->motion.position, ahead), NULL).y;
    if (fabsf(height) < fabsf(min)) min = height;
  }
  return min;
}

/* The same for a foot; one in the air goes from the value where it lifted off to that where it lands. */
static float foot_height_beside(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, const sbri_foot *foot) {
  if (foot->planted) return height_beside(rig, state, input, foot->ground);
  float from = height_beside(rig, state, input, foot->step.from);
  float to = height_beside(rig, state, input, foot->step.to);
  return from + sbri_smooth(foot->step.phase) * (to - from);
}

/* Slope angle between two points at a horizontal distance of `run`. */
static float slope(sbf_vec3 a, sbf_vec3 b, float run) {
  return run > 1e-6f ? sbri_atan2(b.y - a.y, run) : 0;
}

/* Slope angle from the right feet to the left. If one of two feet is ahead of the other, the ground's rise
 * between them is pitch, not roll, and the body stays upright above a narrow stance. */
static float feet_roll(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  float width = 2 * rig->stand.half_width * input->scale, min = NARROWEST * rig->stand.reach * input->scale;
  sbf_vec3 left = {0, 0, 0}, right = {0, 0, 0};
  if (!feet_center(rig, state, LEFT, &left) || !feet_center(rig, state, RIGHT, &right)) return 0;
  if (rig->leg_count != 2) return slope(right, left, width);
  for (uint32_t i = 0; i < 2; i++)
    (is_of(&rig->legs[i], LEFT) ? &left : &right)->y = foot_height_beside(rig, state, input, &state->feet[i]);
  return slope(right, left, width > min ? width : min);
}

static float full_reach(const sbri_leg *leg, float scale) {
  return leg->length.reach * (1 - leg->length.soft_reach) * scale;
}

/* Lowering of the body for which a leg with the vector `offset` from ankle to hip has the length `reach`. */
static float lowering_into(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 offset, float reach) {
  float left = reach * reach - offset.x * offset.x - offset.z * offset.z;
  float min = LOWEST * LOWEST * reach * reach; /* lowering does not help legs that are too far to the side */
  /* A rise of the hip by a clip is compensated entirely, so that the foot stays on the ground. */
  float lifted = state->feet[leg].hip.y - rig->bones.rest[rig->legs[leg].upper].position.y * input->scale;
  float drop = offset.y - sqrtf(left > min ? left : min);
  float max = DEEPEST * reach + (lifted > 0 ? lifted : 0);
  return drop < max ? drop : max;
}

/* Lowering for a fraction of the leg's reach. */
static float lowering_for(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 hip, sbf_vec3 ankle, float fraction) {
  const sbri_leg *l = &rig->legs[leg];
  float bent =
      state->balance.bent.value; /* squared, so that legs as straight as at rest bend at a steady rate */
  if (fraction < l->length.rest_stretch)
    fraction = l->length.rest_stretch + bent * bent * (fraction - l->length.rest_stretch);
  return lowering_into(rig, state, input, leg, sbri_sub(hip, ankle), fraction * full_reach(l, input->scale));
}

/* Maximum lowering before the belly touches the ground, for the position of the body in a moment. */
static float max_lowering_of_belly(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, const sbr_transform *root) {
  float max = rig->stand.reach * input->scale, clear = CLEAR * max;
  sbf_vec3 ahead = sbri_scale(sbri_body_velocity(state), state->stepping.speed_fraction * CLEARANCE_S), fore,
           hind;
  float rise = 0, run = rig->stand.fore_z - rig->stand.hind_z; /* along the line of its feet */
  if (run > 0 && feet_center(rig, state, AFT, &hind) && feet_center(rig, state, FORE, &fore))
    rise = (fore.y - hind.y) / (run * input->scale);
  ahead.y = rise * sbri_world_to_body(state, ahead).z;
  for (uint32_t k = 0; k < rig->stand.belly_count; k++) {
    sbf_vec3 at = sbri_rotate(root->rotation, sbri_scale(rig->stand.belly[k], input->scale));
    at = sbri_add(sbri_add(root->position, at), ahead);
    float clearance = at.y - sbri_ground_below(input, at, NULL).y - state->motion.position.y - clear;
    max = clearance < max ? clearance : max;
  }
  float min = -RAISED * rig->stand.reach * input->scale;
  return max > min ? max : min;
}

/* Lowering for which all legs reach their feet; `early` receives that for a reach with a reserve. */
static float crouch(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, float *early) {
  float min = state->balance.clearance.value < 0 ? state->balance.clearance.value : 0; /* the belly rises, */
  float max = state->balance.crouch.value < min ? state->balance.crouch.value : min;   /* and sinks slowly */
  sbf_vec3 ahead = sbri_scale(sbri_body_velocity(state), state->stepping.speed_fraction * CROUCH_S);
  if (rig->leg_count == 2 && state->stepping.in_groups && state->posture.rise > 0)
    ahead.y = state->posture.rise * CROUCH_S;
  *early = min;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0 || leg->home.chain_bone >= 0) continue;
    sbf_vec3 ankle = sbri_ankle_over(leg, foot, foot->ground, input->scale);
    ankle.y += foot->lift + state->motion.position.y;
    sbf_vec3 hip = sbri_hip_of(rig, state, input, i, root);
    float drop = lowering_for(rig, state, input, i, hip, ankle, 1);
    if (foot->planted) hip = sbri_add(hip, ahead);
    float reserved = lowering_for(rig, state, input, i, hip, ankle, SPARE);
    max = drop > max ? drop : max;
    *early = reserved > *early ? reserved : *early;
  }
  return max;
}

/* Limits the lowering so that no planted knee exceeds its angular acceleration. Only steep legs count, whose
 * knees move with the height of the body. */
static float limit_for_knees(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, float lowering) {
  float min = -1e6f, max = 1e6f;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0 || leg->home.chain_bone >= 0 || !foot->planted) continue;
    sbf_vec3 ankle = sbri_ankle_over(leg, foot, foot->ground, input->scale);
    ankle.y += state->motion.position.y;
    sbf_vec3 offset = sbri_sub(sbri_hip_of(rig, state, input, i, root), ankle);
    float full = full_reach(leg, input->scale), shortest, longest;
    if (offset.y <= UPRIGHT * sbri_length(offset)) continue;
    if (!sbri_knee_range(leg, foot, input, full, &shortest, &longest)) continue;
    float bent = lowering_into(rig, state, input, i, offset, shortest);
    float straight = longest < full ? lowering_into(rig, state, input, i, offset, longest) : min;
    max = bent < max ? bent : max;
    min = straight > min ? straight : min;
  }
  if (lowering > max) lowering = max;
  return lowering < min ? min : lowering;
}

/* Lowering for the positions at which feet land and lift off in a stride. With wide strides the body stays
 * low, so that it does not bob. */
static float crouch_for_stride(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, const sbr_transform *root, const sbri_stride *stride) {
  float max = 0;
  for (uint32_t i = 0; stride->speed > 0 && i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0 || leg->home.chain_bone >= 0) continue;
    const sbri_home *home_state = &stride->homes[i];
    sbri_foot_circle circle =
        foot->planted ? home_state->circle : sbri_foot_circle_of(rig, state, input, i, home_state->arm);
    float half = stride->half_m * home_state->speed / stride->speed;
    sbf_vec3 direction = sbri_normalize(home_state->velocity, sbri_vec3(0, 0, 0));
    sbf_vec3 home = sbri_add(state->motion.position, home_state->arm);
    home.y = foot->ground.y + state->motion.position.y;
    sbf_vec3 ankle = sbri_ankle_at_home(leg, foot, home, input->scale);
    float ahead = sbri_landing_distance(&circle, direction, half);
    sbf_vec3 hip = sbri_hip_of(rig, state, input, i, root);
    float contact = lowering_for(rig, state, input, i, hip, sbri_add_scaled(ankle, direction, ahead), EASY);
    float leave =
        lowering_for(rig, state, input, i, hip, sbri_add_scaled(ankle, direction, ahead - 2 * half), EASY);
    float bound = (1 - SBRI_LOWERED) * (hip.y - ankle.y), drop = contact > leave ? contact : leave;
    drop = drop < bound ? drop : bound;
    max = drop > max ? drop : max;
  }
  return max;
}

/* Stance without lowering. */
static sbri_stance stance_without_lowering(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stance stance = {.root = {state->motion.position, yaw_rotation(state->motion.heading)}};
  sbf_vec3 center, hind, fore;
  bool on_feet = rig->leg_count && feet_center(rig, state, ALL, &center);
  float raised = state->motion.position.y;
  stance.root.position.y =
      raised + (on_feet ? center.y : sbri_ground_below(input, state->motion.position, NULL).y);
  if (!on_feet) stance.root = sbri_motion_root(rig, state, input, stance.root);
  if (!on_feet) return stance;
  stance.root.position.x += state->balance.sway_x.value,
      stance.root.position.z += state->balance.sway_z.value;
  float pitch = 0, roll = 0, fraction = rig->gait->body_tilt;
  if (feet_center(rig, state, AFT, &hind) && feet_center(rig, state, FORE, &fore))
    pitch = fraction * slope(hind, fore, (rig->stand.fore_z - rig->stand.hind_z) * input->scale);
  roll = fraction * (rig->leg_count == 2 ? state->balance.roll.value : feet_roll(rig, state, input));
  float sp, cp, sr, cr;
  sbri_sincos(-0.5f * pitch, &sp, &cp);
  sbri_sincos(0.5f * roll, &sr, &cr);
  sbf_quat tilt = sbri_quat_multiply((sbf_quat){sp, 0, 0, cp}, (sbf_quat){0, 0, sr, cr});
  /* A body on two legs, or one that has to balance, tilts about the middle of the hips, so that the mass
   * stays above the feet. Others tilt about the ground between the feet. */
  float about_hips = rig->leg_count == 2 ? 1 : state->balance.upright.value;
  sbf_vec3 middle =
      sbri_vec3(0, about_hips * rig->stand.hips_y, 0.5f * (rig->stand.hind_z + rig->stand.fore_z));
  middle = sbri_scale(middle, input->scale);
  sbf_quat heading = stance.root.rotation;
  stance.root.rotation = sbri_quat_normalize(sbri_quat_multiply(heading, tilt));
  sbf_vec3 shift = sbri_sub(sbri_rotate(heading, middle), sbri_rotate(stance.root.rotation, middle));
  stance.root.position = sbri_add(stance.root.position, shift);
  stance.hips_pitch = -pitch;
  stance.hips_yaw = line_yaw(rig, state, input->scale, HIPS_LEFT, HIPS_RIGHT);
  stance.chest_yaw = stance.hips_yaw;
  if (rig->gait->chest >= 0) stance.chest_yaw = line_yaw(rig, state, input->scale, CHEST_LEFT, CHEST_RIGHT);
  return stance;
}

float sbri_body_drop(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root) {
  float unused;
  return crouch(rig, state, input, root, &unused);
}

/* The body's lowering: the greater of the planned and the necessary one. Where they are equal, legs are
 * nearly straight and knees turn fast, so the transition is smoothed as far as possible.
 */
static void lower_body(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    float needed, sbri_stance *stance) {
  float size = rig->stand.reach * input->scale, tick = input->tick_s;
  float lowering = state->balance.crouch.value > needed ? state->balance.crouch.value : needed,
        eased = lowering;
  if (state->spares_knees || needed > state->balance.crouch.value - CROUCH_TOLERANCE * size)
    eased = limit_for_knees(rig, state, input, &stance->root, lowering);
  if (eased != lowering || state->spares_knees) {
    float steady_change = stance->root.position.y - state->posture.root.position.y -
                          state->posture.rise * tick; /* at constant velocity */
    float change = ABRUPT * size * tick * tick, low = steady_change - change, high = steady_change + change;
    if (!state->spares_knees && lowering < low) low = lowering;
    if (!state->spares_knees && lowering > high) high = lowering;
    eased = sbri_clamp(eased, low, high);
    if (eased < needed) eased = needed;
  }
  stance->spares_knees = eased != lowering;
  stance->lowered = eased;
  stance->root.position.y -= eased;
}

sbri_stance sbri_body_stance(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stance stance = stance_without_lowering(rig, state, input);
  if (rig->leg_count) lower_body(rig, state, input, sbri_body_drop(rig, state, input, &stance.root), &stance);
  return stance;
}

void sbri_body_steps_update(const sbri_rig *rig, sbri_gait_state *state, float tick_s) {
  const sbf_head_turn *head = rig->gait ? rig->gait->head : NULL;
  if (state->steps.tick_s == tick_s) return;
  state->steps = (sbri_body_steps){.tick_s = tick_s,
      .lean = sbri_follower_step_of(LEAN_HZ, 1, 0, tick_s),
      .bend = sbri_follower_step_of(BEND_HZ, 1, 0, tick_s),
      .upright = sbri_follower_step_of(UPRIGHT_HZ, 1, 0, tick_s),
      .crouch = sbri_follower_step_of(CROUCH_HZ, 1, 0, tick_s)};
  if (head) state->steps.head = sbri_follower_step_of(head->frequency, head->damping_ratio, 0, tick_s);
}

/* Sways towards `lean`, as far as the planted feet reach. */
static void update_sway(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 lean) {
  sbri_lag x = state->balance.sway_x, z = state->balance.sway_z;
  sbri_lag_tick(&x, lean.x, &state->steps.lean);
  sbri_lag_tick(&z, lean.z, &state->steps.lean);
  sbf_vec3 step = sbri_vec3(x.value - state->balance.sway_x.value, 0, z.value - state->balance.sway_z.value);
  float size = sbri_length(step), fraction = 1;
  sbf_vec3 direction = sbri_normalize(step, sbri_vec3(0, 0, 0));
  for (uint32_t i = 0; size > 0 && i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    float left = sbri_remaining_reach(rig, state, input, i, direction) / size;
    if (left < fraction) fraction = left > 0 ? left : 0;
  }
  state->balance.sway_x = (sbri_lag){state->balance.sway_x.value + fraction * step.x, fraction * x.rate};
  state->balance.sway_z = (sbri_lag){state->balance.sway_z.value + fraction * step.z, fraction * z.rate};
}

sbri_stance sbri_body_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t lifting, sbf_vec3 direction) {
  if (!rig->leg_count) return stance_without_lowering(rig, state, input);
  sbri_body_steps_update(rig, state, input->tick_s);
  const sbri_body_steps *steps = &state->steps;
  sbf_vec3 lean = {0, 0, 0},
           stands = sbri_body_to_world(state, sbri_scale(state->balance.stand, input->scale));
  if (!state->stepping.in_groups || state->stepping.standing_s > 0) lean = stands;
  if (lifting) lean = sbri_find_sway(rig, state, input, lifting, direction);
  update_sway(rig, state, input, lean);
  if (!stride)
    state->balance.sway_x = (sbri_lag){stands.x, 0}, state->balance.sway_z = (sbri_lag){stands.z, 0};
  bool at_home = state->stepping.standing_s > 0 && !lifting; /* all feet are at home */
  if (stride) sbri_lag_tick(&state->balance.bent, at_home ? 0 : 1, &steps->bend);
  sbri_lag_tick(
      &state->balance.upright, stride && stride->balanced && stride->speed > 0 ? 1 : 0, &steps->upright);
  if (!stride) state->balance.upright = (sbri_lag){0, 0};
  if (rig->leg_count == 2) {
    float roll = feet_roll(rig, state, input);
    sbri_lag_tick(&state->balance.roll, roll, &steps->lean);
    if (!stride) state->balance.roll = (sbri_lag){roll, 0};
  }
  sbri_stance stance = stance_without_lowering(rig, state, input);
  float wanted, needed = crouch(rig, state, input, &stance.root, &wanted);
  float steady = stride ? crouch_for_stride(rig, state, input, &stance.root, stride) : 0;
  wanted = steady > wanted ? steady : wanted;
  float clearance = max_lowering_of_belly(rig, state, input, &stance.root);
  sbri_lag_tick(&state->balance.clearance, clearance, &steps->crouch);
  if (!stride) state->balance.clearance = (sbri_lag){clearance, 0};
  if (wanted > state->balance.clearance.value) wanted = state->balance.clearance.value;
  sbri_lag_tick(&state->balance.crouch, wanted, &steps->crouch);
  if (!stride) state->balance.crouch = (sbri_lag){wanted, 0};
  lower_body(rig, state, input, needed, &stance);
  return stance;
}
