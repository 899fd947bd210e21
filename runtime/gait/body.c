/* The body over its feet: its height and tilt are those of the ground they stand on, it leans over those that
 * bear it, comes down where a leg would not reach, and hips and chest turn with the lines of the feet. */
#include "gait/gait_state.h"
#include "gait/motion_kinds.h"
#include "math/quat.h"
#include "math/trig.h"

static const float LEAN_HZ = 2.1f, CROUCH_HZ = 4, BEND_HZ = 2.5f; /* of critically damped followers; the
                                                                     crouch's also of the belly's room */
static const float CROUCH_S = 0.08f;    /* by which the crouch lags, and looks ahead */
static const float MAX_YAW = 0.8f;      /* rad: hips and chest turn less than so */
static const float NARROWEST = 0.5f;    /* of the reach: feet turn the hips as if no nearer */
static const float DEEPEST = 0.3f;      /* of a leg's reach: the body comes down by no more for a foot */
static const float LOWEST = 0.3f;       /* of a leg's reach: no hip comes nearer to the ground than so */
static const float EASY = 0.93f;        /* share of it that it comes down for in a stride */
static const float UPRIGHT_HZ = 1;      /* of a critically damped follower */
static const float CLEARANCE_S = 0.25f; /* by which the belly looks ahead */
static const float CLEAR = 0.03f;       /* of the reach: what is kept between the belly and the ground */
static const float RAISED = 0.1f;       /* of the reach: the body rises by no more for its belly */
static const float UPRIGHT = 0.7f; /* cosine: legs that stand no flatter are eased by how high the body is */
static const float CROUCH_TOLERANCE =
    0.06f;                      /* of the reach: as near as what it needs to come down is to what it does */
static const float ABRUPT = 43; /* of the reach, a second squared: 1.2 % a frame of 1/60 s in a frame */
static const float SPARE = 0.965f; /* share of the uneased reach that the body comes down for ahead of need */

static sbf_quat yaw_rotation(float yaw) {
  float s, c;
  sbri_sincos(0.5f * yaw, &s, &c);
  return (sbf_quat){0, s, 0, c};
}

typedef enum feet_of { ALL, LEFT, RIGHT, FORE, AFT, HIPS_LEFT, HIPS_RIGHT, CHEST_LEFT, CHEST_RIGHT } feet_of;

static bool is_of(const sbri_leg *leg, feet_of which) {
  bool left = leg->home.x > 0;
  switch (which) {
  case LEFT:
  case RIGHT:
    return left == (which == LEFT);
  case FORE:
  case AFT:
    return leg->fore == (which == FORE);
  case HIPS_LEFT:
  case HIPS_RIGHT:
    return leg->hind && left == (which == HIPS_LEFT);
  case CHEST_LEFT:
  case CHEST_RIGHT:
    return !leg->hind && left == (which == CHEST_LEFT);
  default:
    return true;
  }
}

/* Mean of the places below some of the feet; false for none. */
static bool feet_center(const sbri_rig *rig, const sbri_gait_state *state, feet_of which, sbf_vec3 *center) {
  sbf_vec3 sum = {0, 0, 0};
  float count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!is_of(&rig->legs[i], which)) continue;
    sum = sbri_add(sum, state->feet[i].ground);
    count += 1;
  }
  *center = sbri_scale(sum, count > 0 ? 1 / count : 0);
  return count > 0;
}

/* Turn of the line from the right foot to the left against the heading: how far one side is ahead. */
static float line_yaw(
    const sbri_rig *rig, const sbri_gait_state *state, float scale, feet_of on_left, feet_of on_right) {
  sbf_vec3 left, right;
  if (!feet_center(rig, state, on_left, &left) || !feet_center(rig, state, on_right, &right)) return 0;
  sbf_vec3 line = sbri_unheaded(state, sbri_sub(left, right));
  float min = NARROWEST * rig->reach * scale, more = line.x - min; /* no less, smoothly */
  float across = min + 0.5f * (more + sqrtf(more * more + 0.25f * min * min));
  float yaw = rig->gait->hip_tilt * -sbri_atan2(line.z, across);
  return MAX_YAW * yaw / (MAX_YAW + fabsf(yaw)); /* feet may cross, hips do not turn round */
}

/* Slope, as an angle, between two places `run` apart. */
static float slope(sbf_vec3 a, sbf_vec3 b, float run) {
  return run > 1e-6f ? sbri_atan2(b.y - a.y, run) : 0;
}

static float full_reach(const sbri_leg *leg, float scale) {
  return leg->reach * (1 - leg->soft_reach) * scale;
}

/* How far the body must come down for a leg to have its ankle, that its hip is `away` from, within `reach`.
 */
static float drop_into(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 away, float reach) {
  float left = reach * reach - away.x * away.x - away.z * away.z;
  float min = LOWEST * LOWEST * reach * reach; /* too far to the side, it is not helped by it */
  /* A clip's lift of the hip is undone entirely, so that the foot stays on the ground. */
  float lifted = state->feet[leg].hip.y - rig->rest[rig->legs[leg].upper].position.y * input->scale;
  float drop = away.y - sqrtf(left > min ? left : min);
  float max = DEEPEST * reach + (lifted > 0 ? lifted : 0);
  return drop < max ? drop : max;
}

/* The same with a fraction of its reach. */
static float drop_for(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 hip, sbf_vec3 ankle, float fraction) {
  const sbri_leg *l = &rig->legs[leg];
  float bent = state->bent.value; /* by its square, legs as straight as at rest bend at an even rate */
  if (fraction < l->rest_stretch) fraction = l->rest_stretch + bent * bent * (fraction - l->rest_stretch);
  return drop_into(rig, state, input, leg, sbri_sub(hip, ankle), fraction * full_reach(l, input->scale));
}

/* How far the body may come down, as it will stand in a moment, before its belly is on the ground. */
static float clearance_below(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root) {
  float max = rig->reach * input->scale, clear = CLEAR * max;
  sbf_vec3 ahead = sbri_scale(sbri_body_velocity(state), state->speed_fraction * CLEARANCE_S), fore, hind;
  float rise = 0, run = rig->fore_z - rig->hind_z; /* along the line of its feet */
  if (run > 0 && feet_center(rig, state, AFT, &hind) && feet_center(rig, state, FORE, &fore))
    rise = (fore.y - hind.y) / (run * input->scale);
  ahead.y = rise * sbri_unheaded(state, ahead).z;
  for (uint32_t k = 0; k < rig->belly_count; k++) {
    sbf_vec3 at = sbri_rotate(root->rotation, sbri_scale(rig->belly[k], input->scale));
    at = sbri_add(sbri_add(root->position, at), ahead);
    float clearance = at.y - sbri_ground_below(input, at, NULL).y - state->position.y - clear;
    max = clearance < max ? clearance : max;
  }
  float min = -RAISED * rig->reach * input->scale;
  return max > min ? max : min;
}

/* The same for every leg and where its foot is, for the whole reach; and `spare`, for what is kept in hand.
 */
static float crouch(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, float *spare) {
  float min = state->clearance.value < 0 ? state->clearance.value : 0, max = min; /* it rises for its belly */
  sbf_vec3 ahead = sbri_scale(sbri_body_velocity(state), state->speed_fraction * CROUCH_S);
  *spare = min;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0 || leg->carrier >= 0) continue;
    sbf_vec3 ankle = sbri_ankle_over(leg, foot, foot->ground, input->scale);
    ankle.y += foot->lift + state->position.y;
    sbf_vec3 hip = sbri_hip_of(rig, state, input, i, root);
    float drop = drop_for(rig, state, input, i, hip, ankle, 1);
    if (foot->planted) hip = sbri_add(hip, ahead);
    float early = drop_for(rig, state, input, i, hip, ankle, SPARE);
    max = drop > max ? drop : max;
    *spare = early > *spare ? early : *spare;
  }
  return max;
}

/* From how far it would come down to where no planted knee straightens, or bends, more abruptly than it can:
 * legs that stand upright alone, whose knees turn as the body goes up and down. */
static float soften_for_knees(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, float down) {
  float min = -1e6f, max = 1e6f;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0 || leg->carrier >= 0 || !foot->planted) continue;
    sbf_vec3 ankle = sbri_ankle_over(leg, foot, foot->ground, input->scale);
    ankle.y += state->position.y;
    sbf_vec3 away = sbri_sub(sbri_hip_of(rig, state, input, i, root), ankle);
    float full = full_reach(leg, input->scale), shortest, longest;
    if (away.y <= UPRIGHT * sbri_length(away)) continue;
    if (!sbri_knee_range(leg, foot, input, full, &shortest, &longest)) continue;
    float bent = drop_into(rig, state, input, i, away, shortest);
    float straight = longest < full ? drop_into(rig, state, input, i, away, longest) : min;
    max = bent < max ? bent : max;
    min = straight > min ? straight : min;
  }
  if (down > max) down = max;
  return down < min ? min : down;
}

/* The same for where every foot comes down and lifts off in a stride: the wider, the lower the body goes, and
 * stays, so that it need not bob. */
static float crouch_for_stride(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, const sbr_transform *root, const sbri_stride *stride) {
  float max = 0;
  for (uint32_t i = 0; stride->speed > 0 && i < rig->leg_count; i++) {
    const sbri_leg *leg = &rig->legs[i];
    const sbri_foot *foot = &state->feet[i];
    if (leg->lower < 0 || leg->carrier >= 0) continue;
    const sbri_home *now = &stride->homes[i];
    sbri_roam roam = foot->planted ? now->roam : sbri_roam_of(rig, state, input, i, now->arm);
    float half = stride->half_m * now->speed / stride->speed;
    sbf_vec3 direction = sbri_normalize(now->velocity, sbri_vec3(0, 0, 0));
    sbf_vec3 home = sbri_add(state->position, now->arm);
    home.y = foot->ground.y + state->position.y;
    sbf_vec3 ankle = sbri_ankle_at_home(leg, foot, home, input->scale);
    float ahead = sbri_ahead(&roam, direction, half);
    sbf_vec3 hip = sbri_hip_of(rig, state, input, i, root);
    float contact = drop_for(rig, state, input, i, hip, sbri_add_scaled(ankle, direction, ahead), EASY);
    float leave =
        drop_for(rig, state, input, i, hip, sbri_add_scaled(ankle, direction, ahead - 2 * half), EASY);
    float bound = (1 - SBRI_LOWERED) * (hip.y - ankle.y), drop = contact > leave ? contact : leave;
    drop = drop < bound ? drop : bound;
    max = drop > max ? drop : max;
  }
  return max;
}

/* Without the crouch. */
static sbri_stance stance_over(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stance stance = {.root = {state->position, yaw_rotation(state->heading)}};
  sbf_vec3 all, hind, fore, left, right;
  bool on_feet = rig->leg_count && feet_center(rig, state, ALL, &all);
  float raised = state->position.y;
  stance.root.position.y = raised + (on_feet ? all.y : sbri_ground_below(input, state->position, NULL).y);
  if (!on_feet) stance.root = sbri_motion_root(rig, state, input, stance.root);
  if (!on_feet) return stance;
  stance.root.position.x += state->sway_x.value, stance.root.position.z += state->sway_z.value;
  float pitch = 0, roll = 0, fraction = rig->gait->body_tilt;
  if (feet_center(rig, state, AFT, &hind) && feet_center(rig, state, FORE, &fore))
    pitch = fraction * slope(hind, fore, (rig->fore_z - rig->hind_z) * input->scale);
  if (feet_center(rig, state, LEFT, &left) && feet_center(rig, state, RIGHT, &right))
    roll = fraction * slope(right, left, 2 * rig->half_width * input->scale);
  float sp, cp, sr, cr;
  sbri_sincos(-0.5f * pitch, &sp, &cp);
  sbri_sincos(0.5f * roll, &sr, &cr);
  sbf_quat tilt = sbri_quat_multiply((sbf_quat){sp, 0, 0, cp}, (sbf_quat){0, 0, sr, cr});
  /* While it has to keep its balance the tilt is about the middle of the hips, so that what the legs bear
   * stays over the feet; else about the ground between the feet. */
  sbf_vec3 middle = sbri_vec3(0, state->upright.value * rig->hips_y, 0.5f * (rig->hind_z + rig->fore_z));
  middle = sbri_scale(middle, input->scale);
  sbf_quat heading = stance.root.rotation;
  stance.root.rotation = sbri_quat_normalize(sbri_quat_multiply(heading, tilt));
  sbf_vec3 moved = sbri_sub(sbri_rotate(heading, middle), sbri_rotate(stance.root.rotation, middle));
  stance.root.position = sbri_add(stance.root.position, moved);
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
static void come_down(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    float needed, sbri_stance *stance) {
  float size = rig->reach * input->scale, tick = input->tick_s;
  float down = state->crouch.value > needed ? state->crouch.value : needed, eased = down;
  if (state->eased || needed > state->crouch.value - CROUCH_TOLERANCE * size)
    eased = soften_for_knees(rig, state, input, &stance->root, down);
  if (eased != down || state->eased) {
    float even = stance->root.position.y - state->root.position.y - state->rise * tick; /* as it has come */
    float change = ABRUPT * size * tick * tick, low = even - change, high = even + change;
    if (!state->eased && down < low) low = down;
    if (!state->eased && down > high) high = down;
    eased = sbri_clamp(eased, low, high);
    if (eased < needed) eased = needed;
  }
  stance->eased = eased != down;
  stance->lowered = eased;
  stance->root.position.y -= eased;
}

sbri_stance sbri_body_stance(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stance stance = stance_over(rig, state, input);
  if (rig->leg_count) come_down(rig, state, input, sbri_body_drop(rig, state, input, &stance.root), &stance);
  return stance;
}

void sbri_body_steps_keep(const sbri_rig *rig, sbri_gait_state *state, float tick_s) {
  const sbf_head_turn *head = rig->gait ? rig->gait->head : NULL;
  if (state->steps.tick_s == tick_s) return;
  state->steps = (sbri_body_steps){.tick_s = tick_s,
      .lean = sbri_follower_step_of(LEAN_HZ, 1, 0, tick_s),
      .bend = sbri_follower_step_of(BEND_HZ, 1, 0, tick_s),
      .upright = sbri_follower_step_of(UPRIGHT_HZ, 1, 0, tick_s),
      .crouch = sbri_follower_step_of(CROUCH_HZ, 1, 0, tick_s)};
  if (head) state->steps.head = sbri_follower_step_of(head->frequency, head->damping_ratio, 0, tick_s);
}

/* Leans on towards `lean`, no farther than the feet that stand allow. */
static void sway_to(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 lean) {
  sbri_lag x = state->sway_x, z = state->sway_z;
  sbri_lag_tick(&x, lean.x, &state->steps.lean);
  sbri_lag_tick(&z, lean.z, &state->steps.lean);
  sbf_vec3 by = sbri_vec3(x.value - state->sway_x.value, 0, z.value - state->sway_z.value);
  float size = sbri_length(by), fraction = 1;
  sbf_vec3 direction = sbri_normalize(by, sbri_vec3(0, 0, 0));
  for (uint32_t i = 0; size > 0 && i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    float left = sbri_remaining_reach(rig, state, input, i, direction) / size;
    if (left < fraction) fraction = left > 0 ? left : 0;
  }
  state->sway_x = (sbri_lag){state->sway_x.value + fraction * by.x, fraction * x.rate};
  state->sway_z = (sbri_lag){state->sway_z.value + fraction * by.z, fraction * z.rate};
}

sbri_stance sbri_body_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t lifting, sbf_vec3 direction) {
  if (!rig->leg_count) return stance_over(rig, state, input);
  sbri_body_steps_keep(rig, state, input->tick_s);
  const sbri_body_steps *steps = &state->steps;
  sbf_vec3 lean = {0, 0, 0}, stands = sbri_headed(state, sbri_scale(state->stands, input->scale));
  if (!state->together || state->standing_s > 0) lean = stands;
  if (lifting) lean = sbri_support_sway(rig, state, input, lifting, direction);
  sway_to(rig, state, input, lean);
  if (!stride) state->sway_x = (sbri_lag){stands.x, 0}, state->sway_z = (sbri_lag){stands.z, 0};
  bool at_home = state->standing_s > 0 && !lifting; /* no foot has still to go there */
  if (stride) sbri_lag_tick(&state->bent, at_home ? 0 : 1, &steps->bend);
  sbri_lag_tick(&state->upright, stride && stride->balanced && stride->speed > 0 ? 1 : 0, &steps->upright);
  if (!stride) state->upright = (sbri_lag){0, 0};
  sbri_stance stance = stance_over(rig, state, input);
  float wanted, needed = crouch(rig, state, input, &stance.root, &wanted);
  float steady = stride ? crouch_for_stride(rig, state, input, &stance.root, stride) : 0;
  wanted = steady > wanted ? steady : wanted;
  float clearance = clearance_below(rig, state, input, &stance.root);
  sbri_lag_tick(&state->clearance, clearance, &steps->crouch);
  if (!stride) state->clearance = (sbri_lag){clearance, 0};
  if (wanted > state->clearance.value) wanted = state->clearance.value;
  sbri_lag_tick(&state->crouch, wanted, &steps->crouch);
  if (!stride) state->crouch = (sbri_lag){wanted, 0};
  come_down(rig, state, input, needed, &stance);
  return stance;
}
