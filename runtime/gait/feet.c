/* Feet: who steps, where to, and how a foot gets there.
 *
 * A planted foot stays where it is. The body moves on, so the foot falls behind its home; the foot that is
 * worst placed steps first, and only while no foot of another group is in the air, so that opposite feet stay
 * down. There is no clock: stride and rhythm follow from speed, reach and trigger. */
#include "gait/gait_state.h"
#include "math/quat.h"
#include "math/trig.h"

static const float PI = 3.14159265f;
static const float SAFE_REACH =
    0.96f; /* share of a leg's uneased reach beyond which its foot wants to step */
static const float MOST_REACH = 0.88f;     /* the same over the ground alone: beyond it the foot must */
static const float LOOK_AHEAD_S = 0.02f;   /* a foot that would be beyond it so soon steps at once */
static const float STEPS_AHEAD = 1.6f;     /* and one that would be within so many steps wants to */
static const float SETTLE_AFTER_S = 0.15f; /* of standing; then feet go home */
static const float SETTLED = 0.15f;        /* share of the trigger within which a foot is at home */
static const float COMPANION = 0.5f; /* share of the trigger at which a foot goes with one of its group */

float sbri_wrap_angle(float angle) {
  while (angle > PI) angle -= 2 * PI;
  while (angle <= -PI) angle += 2 * PI;
  return angle;
}

sbf_vec3 sbri_turned(sbf_vec3 v, float yaw) {
  float s, c;
  sbri_sincos(yaw, &s, &c);
  return sbri_vec3(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
}

sbf_vec3 sbri_ground_below(const sbri_gait_input *input, sbf_vec3 place, sbf_vec3 *normal) {
  sbf_vec3 unit;
  double y = input->ground->height(
      input->ground, input->origin.x + (double)place.x, input->origin.z + (double)place.z, &unit);
  if (normal) *normal = unit;
  return sbri_vec3(place.x, (float)(y - input->origin.y), place.z);
}

/* A foot's home relative to the body's place, level. */
static sbf_vec3 home_arm(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbf_vec3 home = rig->legs[leg].home;
  float width = rig->gait->step_width;
  if (state->standing_s == 0 && width > 0 && home.x != 0) home.x = home.x < 0 ? -width : width;
  home.y = 0;
  return sbri_turned(sbri_scale(home, input->scale), state->heading);
}

/* Velocity of a foot's home over the ground. */
static sbf_vec3 home_velocity(const sbri_gait_state *state, sbf_vec3 arm) {
  sbf_vec3 v = sbri_turned(sbri_vec3(state->sideways, 0, state->forward), state->heading);
  return sbri_vec3(v.x + state->turn * arm.z, 0, v.z - state->turn * arm.x);
}

static float flat_distance(sbf_vec3 a, sbf_vec3 b) {
  float x = a.x - b.x, z = a.z - b.z;
  return sqrtf(x * x + z * z);
}

static float trigger_of(const sbri_rig *rig, const sbri_gait_input *input) {
  return rig->gait->step_trigger * input->scale;
}

/* A step takes its time at the walking speed and less where the home would otherwise run away from the foot.
 */
static float duration_of(const sbri_rig *rig, const sbri_gait_input *input, float speed) {
  float usual = rig->gait->step_duration;
  float longest = speed > 0 ? 1.5f * trigger_of(rig, input) / speed : usual;
  return sbri_clamp(longest, 0.35f * usual, usual);
}

/* Where a foot that lifts off now should come down: ahead of where its home will be by as much as it may fall
 * behind, so that the stance lies evenly around the home. */
static sbf_vec3 step_target(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float left_s) {
  sbf_vec3 arm = home_arm(rig, state, input, leg);
  sbf_vec3 velocity = home_velocity(state, sbri_turned(arm, state->turn * left_s));
  float speed = sbri_length(velocity), trigger = trigger_of(rig, input);
  float ahead =
      speed > 0 ? sbri_clamp(speed * 0.5f * duration_of(rig, input, speed) + 0.6f * trigger, 0, trigger) : 0;
  if (state->standing_s > 0) ahead = 0;
  sbf_vec3 home = sbri_add(state->position, sbri_turned(arm, state->turn * left_s));
  sbf_vec3 drift = sbri_turned(
      sbri_vec3(state->sideways, 0, state->forward), state->heading + 0.5f * state->turn * left_s);
  sbf_vec3 place = sbri_add_scaled(home, drift, left_s);
  return speed > 0 ? sbri_add_scaled(place, velocity, ahead / speed) : place;
}

void sbri_foot_place(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  uint32_t steps = foot->steps_taken;
  *foot = (sbri_foot){.planted = 1, .steps_taken = steps};
  foot->ground =
      sbri_ground_below(input, sbri_add(state->position, home_arm(rig, state, input, leg)), &foot->normal);
}

static void lift_off(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  float speed = sbri_length(home_velocity(state, home_arm(rig, state, input, leg)));
  foot->planted = 0;
  foot->phase = 0;
  foot->duration_s = duration_of(rig, input, speed);
  foot->from = foot->ground;
  foot->from_normal = foot->normal;
  foot->from_heading = foot->heading;
}

static float smooth(float t) {
  return t * t * t * (10 + t * (6 * t - 15));
}

/* Moves a foot in the air; true when it comes down. The target follows the body until the last part of the
 * step, then stands. */
static bool swing(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  foot->phase += input->tick_s / foot->duration_s;
  if (foot->phase < 0.75f || foot->to_normal.y == 0) {
    float left = (1 - sbri_clamp(foot->phase, 0, 1)) * foot->duration_s;
    foot->to = sbri_ground_below(input, step_target(rig, state, input, leg, left), &foot->to_normal);
  }
  if (foot->phase >= 1) {
    foot->ground = foot->to;
    foot->normal = foot->to_normal;
    foot->to_normal = sbri_vec3(0, 0, 0);
    foot->heading = 0;
    foot->lift = 0;
    foot->phase = 0;
    foot->planted = 1;
    foot->steps_taken++;
    return true;
  }
  float t = smooth(foot->phase), sine, cosine;
  foot->ground = sbri_lerp(foot->from, foot->to, t);
  foot->normal = sbri_normalize(sbri_lerp(foot->from_normal, foot->to_normal, t), sbri_vec3(0, 1, 0));
  foot->heading = foot->from_heading * (1 - t);
  sbri_sincos(PI * foot->phase, &sine, &cosine);
  foot->lift = rig->gait->step_height * input->scale * sine * sine;
  /* Over a hump between the two places the foot keeps its height above the hump. */
  float hump = sbri_ground_below(input, foot->ground, NULL).y - foot->ground.y;
  if (hump > 0) foot->lift += hump;
  return false;
}

/* Whether the leg will be stretched beyond a share of its reach in a moment; a foot far ahead comes nearer by
 * itself. `flat` leaves the height out, which the body can still make up for by coming down. */
static bool overreaches(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stance *stance, uint32_t leg, float seconds, float share, bool flat) {
  const sbri_leg *l = &rig->legs[leg];
  if (l->lower < 0) return false;
  float reach = (l->upper_length + l->lower_length) * (1 - l->soft_reach) * share * input->scale;
  sbf_vec3 hip = sbri_scale(rig->rest[l->upper].position, input->scale);
  hip = sbri_add(stance->root.position, sbri_rotate(stance->root.rotation, hip));
  sbf_vec3 velocity = home_velocity(state, home_arm(rig, state, input, leg));
  sbf_vec3 ankle =
      sbri_add_scaled(state->feet[leg].ground, state->feet[leg].normal, l->home.y * input->scale);
  if (flat) hip.y = ankle.y;
  float now = sbri_length(sbri_sub(ankle, hip));
  float later = sbri_length(sbri_sub(ankle, sbri_add_scaled(hip, velocity, seconds)));
  return later > reach && later > now;
}

/* Groups with a foot in the air, as bits. */
static uint32_t groups_in_air(const sbri_rig *rig, const sbri_gait_state *state) {
  uint32_t groups = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++)
    if (!state->feet[i].planted) groups |= 1u << (rig->legs[i].group & 31);
  return groups;
}

/* How badly a planted foot stands, in triggers: its distance behind its home, counted against the motion. */
static float displacement(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbf_vec3 arm = home_arm(rig, state, input, leg), home = sbri_add(state->position, arm);
  sbf_vec3 away = sbri_sub(home, state->feet[leg].ground), velocity = home_velocity(state, arm);
  away.y = 0;
  float distance = flat_distance(home, state->feet[leg].ground) / trigger_of(rig, input);
  bool approaching = sbri_dot(away, velocity) < 0; /* the home comes towards the foot: it stands ahead */
  return approaching && state->standing_s == 0 ? -distance : distance;
}

/* The foot that should step now, or -1: the worst placed of those that want to and may. */
static int32_t choose(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stance *stance) {
  uint32_t in_air = groups_in_air(rig, state);
  int32_t best = -1;
  float worst = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted) continue;
    uint32_t own = 1u << (rig->legs[i].group & 31);
    float away = displacement(rig, state, input, i);
    float wanted = in_air == own ? COMPANION : 1;
    if (state->standing_s > SETTLE_AFTER_S) wanted = SETTLED;
    float speed = sbri_length(home_velocity(state, home_arm(rig, state, input, i)));
    float soon = STEPS_AHEAD * duration_of(rig, input, speed) + LOOK_AHEAD_S;
    bool must = overreaches(rig, state, input, stance, i, LOOK_AHEAD_S, MOST_REACH, true);
    bool wants = away >= wanted || overreaches(rig, state, input, stance, i, soon, SAFE_REACH, false);
    bool alone = (in_air & ~own) == 0;
    if (!must && (!alone || !wants)) continue;
    float urgency = must ? 10 + fabsf(away) : fmaxf(away, 0.01f);
    if (urgency <= worst) continue;
    worst = urgency;
    best = (int32_t)i;
  }
  return best;
}

static uint32_t report(sbri_gait_event *events, uint32_t count, uint32_t capacity, sbr_event_kind kind,
    uint32_t leg, sbf_vec3 place) {
  if (count < capacity) events[count] = (sbri_gait_event){kind, leg, place};
  return count < capacity ? count + 1 : count;
}

uint32_t sbri_feet_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_gait_event *events, uint32_t capacity) {
  uint32_t count = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_foot *foot = &state->feet[i];
    sbf_vec3 home = sbri_add(state->position, home_arm(rig, state, input, i));
    float lost = rig->gait->legs.at[i].jump_margin * input->scale +
                 (rig->legs[i].upper_length + rig->legs[i].lower_length) * input->scale;
    if (flat_distance(home, foot->ground) > lost) sbri_foot_place(rig, state, input, i);
    if (!foot->planted && swing(rig, state, input, i))
      count = report(events, count, capacity, SBR_EVENT_FOOT_DOWN, i, foot->ground);
  }
  sbri_stance stance = sbri_body_stance(rig, state, input);
  for (uint32_t tries = 0; tries < rig->leg_count; tries++) {
    int32_t leg = choose(rig, state, input, &stance);
    if (leg < 0) break;
    lift_off(rig, state, input, (uint32_t)leg);
    count = report(events, count, capacity, SBR_EVENT_FOOT_UP, (uint32_t)leg, state->feet[leg].ground);
  }
  return count;
}
