/* Feet: who steps.
 *
 * A planted foot stays where it is. The body moves on, so the foot falls behind its home; the foot that is
 * worst placed steps first, and only while no foot of another group is in the air, so that opposite feet stay
 * down. Slow enough, a foot lifts off only once the others bear the body, which leans over them. There is no
 * clock: stride and rhythm follow from speed, reach and trigger. */
#include "gait/gait_state.h"

static const float SETTLE_AFTER_S = 0.15f; /* of standing; then feet go home */
static const float SETTLED = 0.15f;        /* share of the trigger within which a foot is at home */
static const float DUE = 0.9f;             /* of the half stride behind home: the foot steps */
static const float EARLY = 0.25f;          /* the same, once its turn has come */
static const float COMPANION = -0.3f;      /* the same of a foot that goes with one of its group */
static const float TWISTED = 0.6f;         /* rad that a planted foot may be turned against the body */
static const float MISSED = 0.002f;        /* of the reach: a sole so far from its place has to step */
static const float NOTED = 0.4f;           /* sideways and twisted: less than this does not count */
static const float STRAINED = 0.7f;        /* share of its roam that a foot may be from home */
static const float KEPT = 0.15f; /* half strides: a foot worse by less than so does not take another's turn */
static const float JOINS = 0.4f; /* phase of a step up to which others of its group join it */
static const float WAIT_S =
    0.7f; /* for balance; then, sooner where the body waits too, a foot steps all the same */

void sbri_foot_place(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  *foot = (sbri_foot){.planted = 1, .was_planted = 1, .steps_taken = foot->steps_taken, .hip = foot->hip};
  foot->ground = sbri_add(state->position, sbri_home_arm(rig, state, input, leg));
  sbri_lay_sole(rig, state, input, leg, &foot->ground, &foot->normal);
  sbri_foot_faces(rig, state, input, leg);
}

/* Feet in the air, and their groups, as bits; the groups get one more where a step is too far on for others
 * to join it. */
static uint32_t feet_in_air(const sbri_rig *rig, const sbri_gait_state *state, uint32_t *groups) {
  uint32_t feet = 0;
  *groups = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (state->feet[i].planted) continue;
    feet |= 1u << i;
    *groups |= 1u << (rig->legs[i].group & 15);
    if (state->feet[i].phase > JOINS) *groups |= 1u << 31;
  }
  return feet;
}

/* How badly a planted foot stands, in half strides behind its home; what it is off to the side counts too,
 * and how far it is twisted. When standing, in triggers from home. */
static float displacement(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  const sbri_foot *foot = &state->feet[leg];
  const sbri_home *home = &stride->homes[leg];
  sbf_vec3 away = sbri_sub(sbri_add(state->position, home->arm), foot->ground);
  away.y = 0;
  float trigger = rig->gait->step_trigger * input->scale, twist = fabsf(foot->heading) / TWISTED;
  if (state->standing_s > 0) return sbri_length(away) / trigger + 0.15f * twist;
  sbf_vec3 way = sbri_normalize(home->velocity, sbri_vec3(0, 0, 0));
  float behind = sbri_dot(away, way), beside = sbri_length(sbri_add_scaled(away, way, -behind));
  float half = stride->speed > 0 ? stride->half_m * home->speed / stride->speed : 0;
  float min = 0.4f * stride->half_m;
  if (half < min) half = min;
  float late = half - sbri_ahead(&home->roam, way, half); /* it comes down so much short */
  float off = (behind - late) / half, wide = 0.7f * beside / stride->half_m;
  if (behind > 0 && off < DUE) {
    float strain = sbri_strain(state, home, leg) / STRAINED;
    if (strain > DUE) off = strain;
  }
  float missed = foot->missed / (MISSED * rig->reach * input->scale);
  if (missed > 1 && missed > off) off = missed; /* its leg cannot hold it there */
  if (wide > NOTED && wide > off) off = wide;
  return twist > NOTED && twist > off ? twist : off;
}

/* What is known of this tick when feet are chosen. */
typedef struct choice {
  sbri_stride stride;
  float off[SBRI_MAX_LEGS]; /* of planted feet */
  uint32_t next;            /* bit of the foot to go next, lifted or not; 0: none */
} choice;

/* How far the body goes in a time. */
static sbf_vec3 way_in(const sbri_gait_state *state, float time_s) {
  return sbri_scale(sbri_body_velocity(state), state->pace * time_s);
}

/* Time until the feet in the air are down; that of a step, where none is. */
static float time_in_air(const sbri_rig *rig, const sbri_gait_state *state, float step_s) {
  float max = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_foot *foot = &state->feet[i];
    float left = foot->planted ? 0 : (1 - foot->phase) * foot->duration_s;
    max = left > max ? left : max;
  }
  return max > 0 ? max : step_s;
}

/* The foot that should step now, or -1: the worst placed of those that want to and may. */
static int32_t choose(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, choice *c, bool *unbalanced) {
  uint32_t groups, in_air = feet_in_air(rig, state, &groups);
  int32_t best = -1, worst = -1;
  float max = 0;
  float wanted = state->since_lift_m >= 0.95f * c->stride.spacing_m ? EARLY : DUE;
  if (state->standing_s > 0) wanted = SETTLED;
  if (state->standing_s > 0 && state->standing_s < SETTLE_AFTER_S) return -1;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    if (!state->feet[i].planted || state->pivot == i + 1) continue;
    uint32_t own = 1u << (rig->legs[i].group & 15);
    bool companion = in_air && groups == own;
    float off = state->next == i + 1 ? c->off[i] + KEPT : c->off[i]; /* it has begun to lean for that one */
    if (worst < 0 || off > max) worst = (int32_t)i, max = off;
    if (in_air && !companion) continue;
    float min = companion ? COMPANION : wanted;
    if (state->standing_s > 0) min = SETTLED;
    if (c->off[i] < min) continue;
    uint32_t lifted = in_air | 1u << i;
    bool bears = c->stride.together && (state->standing_s == 0 || rig->has_pegs);
    if (!bears) {
      bears = sbri_support_bears(rig, state, input, lifted, way_in(state, c->stride.duration_s));
      if (!bears && !in_air && state->waiting_s > WAIT_S) bears = true;
      if (!bears) {
        *unbalanced = *unbalanced || !in_air;
        continue;
      }
    }
    if (best < 0 || c->off[i] > c->off[best]) best = (int32_t)i;
  }
  c->next = worst >= 0 ? 1u << worst : 0;
  state->next = (uint32_t)(worst + 1);
  return best;
}

static uint32_t report(sbri_gait_event *events, uint32_t count, uint32_t capacity, sbr_event_kind kind,
    uint32_t leg, sbf_vec3 place) {
  if (count < capacity) events[count] = (sbri_gait_event){kind, leg, place};
  return count < capacity ? count + 1 : count;
}

/* A foot left far behind, as by a teleport, is put down anew. */
static bool catch_up(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  sbf_vec3 home = sbri_add(state->position, stride->homes[leg].arm);
  const sbri_leg *l = &rig->legs[leg];
  float lost = (rig->gait->legs.at[leg].jump_margin + l->upper_length + l->lower_length) * input->scale;
  if (sbri_flat_distance(home, state->feet[leg].ground) <= lost) return false;
  sbri_foot_place(rig, state, input, leg);
  return true;
}

uint32_t sbri_feet_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_stance *stance, sbri_gait_event *events, uint32_t capacity) {
  uint32_t count = 0, groups;
  choice c = {.stride = sbri_stride_of(rig, state, input)};
  state->together = c.stride.together;
  state->widest_m = c.stride.speed > 0 ? c.stride.widest_m : 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbri_foot *foot = &state->feet[i];
    foot->was_planted = foot->planted;
    bool set_down = catch_up(rig, state, input, &c.stride, i);
    if (!foot->planted && sbri_swing_tick(rig, state, input, &c.stride, i)) {
      count = report(events, count, capacity, SBR_EVENT_FOOT_DOWN, i, foot->ground);
      set_down = true;
    }
    if (set_down) c.stride.homes[i].roam = sbri_roam_of(rig, state, input, i, c.stride.homes[i].arm);
    if (foot->planted) c.off[i] = displacement(rig, state, input, &c.stride, i);
  }
  state->since_lift_m += c.stride.speed * input->tick_s;
  bool unbalanced = false;
  for (uint32_t tries = 0; tries < rig->leg_count; tries++) {
    int32_t leg = choose(rig, state, input, &c, &unbalanced);
    if (leg < 0) break;
    if (feet_in_air(rig, state, &groups) == 0) state->since_lift_m = 0;
    sbri_swing_begin(rig, state, input, &c.stride, (uint32_t)leg);
    count = report(events, count, capacity, SBR_EVENT_FOOT_UP, (uint32_t)leg, state->feet[leg].ground);
    unbalanced = false;
    state->waiting_s = 0;
  }
  state->waiting_s = unbalanced ? state->waiting_s + input->tick_s : 0;
  if (state->standing_s > 0) { /* the next one to go home, if any is not */
    int32_t worst = -1;
    for (uint32_t i = 0; i < rig->leg_count; i++)
      if (state->feet[i].planted && c.off[i] >= SETTLED && (worst < 0 || c.off[i] > c.off[worst]))
        worst = (int32_t)i;
    c.next = worst >= 0 ? 1u << worst : 0;
  }
  uint32_t in_air = feet_in_air(rig, state, &groups);
  bool leans = !rig->has_pegs && (!c.stride.together || state->standing_s > 0);
  uint32_t lifting = leans ? (in_air ? in_air : c.next) : 0;
  if (leans && !in_air && state->standing_s == 0 && !c.next) lifting = 0;
  sbf_vec3 way = way_in(state, time_in_air(rig, state, c.stride.duration_s));
  *stance = sbri_body_tick(rig, state, input, &c.stride, lifting, way);
  return count;
}
