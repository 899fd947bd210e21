/* The way of a foot through the air: to a place ahead of its home, over what lies between. */
#include "collide/ground.h"
#include "gait/gait_state.h"

static const float SETTLED_PHASE = 0.75f; /* from here on the target stands */
static const float FOLLOW = 0.3f;         /* share by which the target is taken over in a tick */
static const float CLEAR = 0.35f;         /* of the usual lift: kept above what lies between */
static const float NOTICED = 0.05f;       /* of the usual lift: lower humps do not count */
static const float MOST_OVER = 2.5f;      /* of a hump's height: how far a step over it goes up at most */
static const float WAITS = 0.16f; /* of a step's time, in which a foot beside an obstacle only rises */
static const float LEAD = 0.6f;   /* of a step's time, in which it goes up to a higher place */
enum { LOOKS = 10 };

float sbri_smooth(float t) {
  t = sbri_clamp(t, 0, 1);
  return t * t * t * (10 + t * (6 * t - 15));
}

/* Rises to 1 in the middle and back; flat at both ends, its acceleration too. */
static float bump(float t) {
  float p = 4 * t * (1 - t);
  return p * p * p;
}

/* Share of the height between both places that is made at phase t: early upwards, late downwards. */
static float climb(float rise, float t) {
  return rise > 0 ? sbri_smooth(t / LEAD) : sbri_smooth((t - (1 - LEAD)) / LEAD);
}

/* Share of the way over the ground at phase t. A foot that has to go high first rises, and comes down last.
 */
static float travel(const sbri_foot *foot, float t) {
  return sbri_smooth((t - foot->waits) / (1 - 2 * foot->waits));
}

/* Ahead of where its home will be when it comes down. */
static sbf_vec3 wanted_place(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg, float left_s) {
  left_s *= state->pace;
  sbf_vec3 now = sbri_home_arm(rig, state, input, leg), drift = sbri_body_velocity(state);
  float turned = state->turn * left_s;
  sbf_vec3 home, velocity = sbri_home_velocity(rig, state, leg, now);
  if (rig->legs[leg].carrier >= 0) {
    home = sbri_add_scaled(sbri_add(state->position, now), velocity, left_s);
  } else {
    drift = sbri_turned(drift, 0.5f * turned);
    home = sbri_add(sbri_add_scaled(state->position, drift, left_s), sbri_turned(now, turned));
    velocity = sbri_turned(velocity, turned);
  }
  if (state->standing_s > 0 || stride->speed <= 0) return home;
  float speed = sbri_length(velocity);
  sbf_vec3 way = sbri_normalize(velocity, sbri_vec3(0, 0, 0));
  return sbri_add_scaled(
      home, way, sbri_ahead(rig, state, input, leg, way, stride->half_m * speed / stride->speed));
}

/* Slope of the ground along a level way, from its normal. */
static float slope_along(sbf_vec3 normal, sbf_vec3 way) {
  return normal.y > 0.1f ? -(normal.x * way.x + normal.z * way.z) / normal.y : 0;
}

/* How high the step must go so that toe and heel clear the ground on the way. */
static float clearance_of(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  const sbri_foot *foot = &state->feet[leg];
  const sbri_sole *sole = &rig->legs[leg].sole;
  float usual = rig->gait->step_height * input->scale, most = usual, rise = foot->to.y - foot->from.y;
  double level;
  if (sbri_ground_is_flat(input->ground, &level)) return usual;
  sbf_vec3 way = sbri_sub(foot->to, foot->from);
  way.y = 0;
  way = sbri_normalize(way, sbri_vec3(0, 0, 0));
  float half = (sole->toe > sole->left ? sole->toe : sole->left) * input->scale, highest = 0;
  float from_slope = slope_along(foot->from_normal, way), to_slope = slope_along(foot->to_normal, way);
  for (int k = 1; k < LOOKS; k++) {
    float t = (float)k / LOOKS, share = travel(foot, t), over = foot->from.y + climb(rise, t) * rise;
    float tilt = half * (from_slope + share * (to_slope - from_slope));
    sbf_vec3 at = sbri_lerp(foot->from, foot->to, share);
    float fore = sbri_ground_below(input, sbri_add_scaled(at, way, half), NULL).y - over - tilt;
    float hind = sbri_ground_below(input, sbri_add_scaled(at, way, -half), NULL).y - over + tilt;
    float hump = fore > hind ? fore : hind;
    if (hump <= NOTICED * usual) continue;
    highest = hump > highest ? hump : highest;
    if (hump / bump(t) + CLEAR * usual > most) most = hump / bump(t) + CLEAR * usual;
  }
  float bound = usual + MOST_OVER * highest;
  return most < bound ? most : bound;
}

static void aim(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg, float share) {
  sbri_foot *foot = &state->feet[leg];
  float left = (1 - sbri_clamp(foot->phase, 0, 1)) * foot->duration_s;
  sbf_vec3 place, normal, wanted = wanted_place(rig, state, input, stride, leg, left);
  if (!sbri_footing(rig, state, input, leg, wanted, &place, &normal))
    place = foot->from, normal = foot->from_normal;
  foot->to = sbri_lerp(foot->to, place, share);
  foot->to_normal = sbri_normalize(sbri_lerp(foot->to_normal, normal, share), normal);
}

void sbri_swing_begin(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  foot->planted = 0;
  foot->phase = 0;
  foot->duration_s = stride->duration_s;
  foot->from = foot->ground;
  foot->from_normal = foot->normal;
  foot->from_heading = foot->heading;
  foot->waits = 0;
  aim(rig, state, input, stride, leg, 1);
  foot->clearance = clearance_of(rig, state, input, leg);
  float usual = rig->gait->step_height * input->scale;
  foot->waits = WAITS * sbri_clamp(foot->clearance / usual - 1, 0, 1);
}

static void put_down(sbri_foot *foot) {
  foot->ground = foot->to;
  foot->normal = foot->to_normal;
  foot->heading = 0;
  foot->lift = 0;
  foot->phase = 0;
  foot->planted = 1;
  foot->steps_taken++;
}

bool sbri_swing_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  foot->phase += input->tick_s / foot->duration_s;
  if (foot->phase < SETTLED_PHASE) {
    aim(rig, state, input, stride, leg, FOLLOW);
    float needed = clearance_of(rig, state, input, leg);
    foot->clearance += 0.3f * (needed - foot->clearance);
  } else if (foot->to_normal.y != 0) {
    foot->to = sbri_ground_below(input, foot->to, &foot->to_normal);
  }
  if (foot->phase >= 1) {
    put_down(foot);
    return true;
  }
  float t = foot->phase, share = travel(foot, t), rise = foot->to.y - foot->from.y;
  foot->ground = sbri_lerp(foot->from, foot->to, share);
  foot->ground.y = foot->from.y + climb(rise, t) * rise;
  foot->normal = sbri_normalize(sbri_lerp(foot->from_normal, foot->to_normal, share), sbri_vec3(0, 1, 0));
  foot->heading = foot->from_heading * (1 - share);
  foot->lift = foot->clearance * bump(t);
  return false;
}
