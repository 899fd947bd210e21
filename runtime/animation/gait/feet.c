/* Selects the feet that step.
 *
 * A planted foot stays in place. As the body moves on, the foot falls behind its home. The foot with the
 * greatest displacement steps first, and only while no foot of another group swings, so that opposite feet
 * stay down. At low speed a foot lifts off only when the others support the body, which leans over them.
 * There is no clock: stride and rhythm follow from speed, reach and trigger distance. */
#include "animation/gait/gait_state.h"

static const float REST_AFTER_S = 0.15f; /* time of standing after which feet return home */
static const float AT_HOME = 0.15f;      /* fraction of the trigger distance within which a foot is at home */
static const float DUE = 0.9f;           /* in half strides behind home: the foot steps */
static const float EARLY = 0.25f;        /* the same for the next foot in turn */
static const float COMPANION = -0.3f;    /* the same for a foot that joins another of its group */
static const float MAX_TWIST = 0.6f;     /* maximum angle of a planted foot to the body, rad */
static const float MAX_REACH_ERROR =
    0.002f;                             /* fraction of the reach: a sole this far from its target must step */
static const float MIN_SIDEWAYS = 0.4f; /* sideways displacement and twist below this are ignored */
static const float MAX_HOME_DISTANCE = 0.7f; /* fraction of its circle that a foot may be from home */
static const float TURN_ADVANTAGE =
    0.15f;                            /* half strides: a foot must be worse by this to take another's turn */
static const float JOIN_PHASE = 0.4f; /* phase of a step before which other feet of its group may start */
static const float MAX_WAIT_S =
    0.7f; /* longest wait for balance, s; then a foot steps anyway, sooner if the body waits too */

void sbri_foot_put_down(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  *foot = (sbri_foot){.planted = 1, .was_planted = 1, .steps_taken = foot->steps_taken, .hip = foot->hip};
  foot->ground = sbri_add(state->motion.position, sbri_home_arm(rig, state, input, leg));
  sbri_set_sole_on_ground(rig, state, input, leg, &foot->ground, &foot->normal);
  sbri_foot_update_orientation(rig, state, input, leg);
}

/* Swinging feet and their groups, as bits. The groups get an extra bit if a step is too far on for others to
 * join it. */
static uint32_t feet_in_air(const sbri_rig *rig, const sbri_gait_state *state, uint32_t *groups) {
  uint32_t feet = 0;
  *groups = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (state->feet[i].planted) continue;
    feet |= 1u << i;
    *groups |= 1u << (rig->legs[i].group & 15);
    if (state->feet[i].step.phase > JOIN_PHASE) *groups |= 1u << 31;
  }
  return feet;
}

/* Displacement of a planted foot in half strides behind its home, including sideways displacement and twist.
 * While standing: in trigger distances from home. */
static float displacement(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  const sbri_foot *foot = &state->feet[leg];
  const sbri_home *home = &stride->homes[leg];
  sbf_vec3 offset = sbri_sub(sbri_add(state->motion.position, home->arm), foot->ground);
  offset.y = 0;
  float trigger = rig->gait->step_trigger * input->scale, twist = fabsf(foot->heading) / MAX_TWIST;
  if (state->stepping.standing_s > 0) return sbri_length(offset) / trigger + 0.15f * twist;
  sbf_vec3 direction = sbri_normalize(home->velocity, sbri_vec3(0, 0, 0));
  float behind = sbri_dot(offset, direction),
        sideways = sbri_length(sbri_add_scaled(offset, direction, -behind));
  float half = stride->speed > 0 ? stride->half_m * home->speed / stride->speed : 0;
  float min = 0.4f * stride->half_m;
  if (half < min) half = min;
  float shortfall = half - sbri_landing_distance(&home->circle, direction,
                               half); /* its landing position is short by this much */
  float result = (behind - shortfall) / half, wide = 0.7f * sideways / stride->half_m;
  if (behind > 0 && result < DUE) {
    float distance_fraction = sbri_home_distance_fraction(state, home, leg) / MAX_HOME_DISTANCE;
    if (distance_fraction > DUE) result = distance_fraction;
  }
  float reach_error = foot->reach_error / (MAX_REACH_ERROR * rig->stand.reach * input->scale);
  if (reach_error > 1 && reach_error > result) result = reach_error; /* out of the leg's reach */
  if (wide > MIN_SIDEWAYS && wide > result) result = wide;
  return twist > MIN_SIDEWAYS && twist > result ? twist : result;
}

/* Input of the selection of feet. */
typedef struct choice {
  sbri_stride stride;
  float displacements[SBRI_MAX_LEGS]; /* displacement of planted feet */
  uint32_t next;                      /* bit of the next foot, lifted or not; 0: none */
} choice;

/* Displacement of the body in a time. */
static sbf_vec3 displacement_in(const sbri_gait_state *state, float time_s) {
  return sbri_scale(sbri_body_velocity(state), state->stepping.speed_fraction * time_s);
}

/* Time until the swinging feet land; the duration of a step if none swings. */
static float time_in_air(const sbri_rig *rig, const sbri_gait_state *state, float step_s) {
  float max = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_foot *foot = &state->feet[i];
    float left = foot->planted ? 0 : (1 - foot->step.phase) * foot->step.duration_s;
    max = left > max ? left : max;
  }
  return max > 0 ? max : step_s;
}

/* Index of the foot that should step now, or -1: the one with the greatest displacement that is due and
 * allowed. */
static int32_t choose_foot(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, choice *c, bool *unbalanced) {
  uint32_t groups, in_air = feet_in_air(rig, state, &groups);
  int32_t best = -1, worst = -1;
  float max = 0;
  float wanted = state->stepping.since_lift_m >= 0.95f * c->stride.spacing_m ? EARLY : DUE;
  if (state->stepping.standing_s > 0) wanted = AT_HOME;
  if (state->stepping.standing_s > 0 && state->stepping.standing_s < REST_AFTER_S) return -1;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted || state->stepping.pivot_leg == i + 1) continue;
    uint32_t own_group = 1u << (rig->legs[i].group & 15);
    bool companion = in_air && groups == own_group;
    float value = state->stepping.next_leg == i + 1
                      ? c->displacements[i] + TURN_ADVANTAGE
                      : c->displacements[i]; /* the body already leans for this foot */
    if (worst < 0 || value > max) worst = (int32_t)i, max = value;
    if (in_air && !companion) continue;
    float min = companion ? COMPANION : wanted;
    if (state->stepping.standing_s > 0) min = AT_HOME;
    if (c->displacements[i] < min) continue;
    uint32_t lifted = in_air | 1u << i;
    bool is_supported = (c->stride.in_groups || c->stride.running) &&
                        (state->stepping.standing_s == 0 || rig->stand.has_one_bone_legs);
    if (!is_supported) {
      is_supported =
          sbri_is_supported(rig, state, input, lifted, displacement_in(state, c->stride.duration_s));
      if (!is_supported && !in_air && state->stepping.waiting_s > MAX_WAIT_S) is_supported = true;
      if (!is_supported) {
        *unbalanced = *unbalanced || !in_air;
        continue;
      }
    }
    if (best < 0 || c->displacements[i] > c->displacements[best]) best = (int32_t)i;
  }
  c->next = worst >= 0 ? 1u << worst : 0;
  state->stepping.next_leg = (uint32_t)(worst + 1);
  return best;
}

static uint32_t report(sbri_gait_event *events, uint32_t count, uint32_t capacity, sbri_gait_event_kind kind,
    uint32_t leg, sbf_vec3 position) {
  if (count < capacity) events[count] = (sbri_gait_event){kind, leg, position};
  return count < capacity ? count + 1 : count;
}

/* Moves a foot that is far behind, as after a teleport, to its home. */
static bool reset_distant_foot(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  sbf_vec3 home = sbri_add(state->motion.position, stride->homes[leg].arm);
  const sbri_leg *l = &rig->legs[leg];
  float max_distance =
      (rig->gait->legs.at[leg].jump_margin + l->length.upper + l->length.lower) * input->scale;
  if (sbri_flat_distance(home, state->feet[leg].ground) <= max_distance) return false;
  sbri_foot_put_down(rig, state, input, leg);
  return true;
}

uint32_t sbri_feet_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_stance *stance, sbri_gait_event *events, uint32_t capacity) {
  uint32_t count = 0, groups;
  choice c = {.stride = sbri_stride_of(rig, state, input)};
  state->stepping.in_groups = c.stride.in_groups;
  state->stepping.quick = c.stride.even && (c.stride.in_groups || c.stride.running);
  state->stepping.max_half_m = c.stride.speed > 0 ? c.stride.max_half_m : 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_foot *foot = &state->feet[i];
    foot->was_planted = foot->planted;
    bool placed = reset_distant_foot(rig, state, input, &c.stride, i);
    if (!foot->planted && sbri_swing_tick(rig, state, input, &c.stride, i)) {
      count = report(events, count, capacity, SBRI_GAIT_FOOT_DOWN, i, foot->ground);
      placed = true;
    }
    if (placed) c.stride.homes[i].circle = sbri_foot_circle_of(rig, state, input, i, c.stride.homes[i].arm);
    if (foot->planted) c.displacements[i] = displacement(rig, state, input, &c.stride, i);
  }
  state->stepping.since_lift_m += c.stride.speed * input->tick_s;
  bool unbalanced = false;
  for (uint32_t tries = 0; tries < rig->leg_count; tries++) {
    int32_t leg = choose_foot(rig, state, input, &c, &unbalanced);
    if (leg < 0) break;
    if (feet_in_air(rig, state, &groups) == 0) state->stepping.since_lift_m = 0;
    sbri_swing_begin(rig, state, input, &c.stride, (uint32_t)leg);
    count = report(events, count, capacity, SBRI_GAIT_FOOT_UP, (uint32_t)leg, state->feet[leg].ground);
    unbalanced = false;
    state->stepping.waiting_s = 0;
  }
  state->stepping.waiting_s = unbalanced ? state->stepping.waiting_s + input->tick_s : 0;
  if (state->stepping.standing_s > 0) { /* next foot to return home, if any is away */
    int32_t worst = -1;
    for (uint32_t i = 0; i < rig->leg_count; i++)
      if (state->feet[i].planted && c.displacements[i] >= AT_HOME &&
          (worst < 0 || c.displacements[i] > c.displacements[worst]))
        worst = (int32_t)i;
    c.next = worst >= 0 ? 1u << worst : 0;
  }
  uint32_t in_air = feet_in_air(rig, state, &groups);
  bool leans = !rig->stand.has_one_bone_legs &&
               ((!c.stride.in_groups && !state->stepping.quick) || state->stepping.standing_s > 0);
  uint32_t lifting = leans ? (in_air ? in_air : c.next) : 0;
  if (leans && !in_air && state->stepping.standing_s == 0 && !c.next) lifting = 0;
  sbf_vec3 direction = displacement_in(state, time_in_air(rig, state, c.stride.duration_s));
  *stance = sbri_body_tick(rig, state, input, &c.stride, lifting, direction);
  return count;
}
