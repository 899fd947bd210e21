/* How far feet go and how fast, from the speed alone: no clock.
 *
 * A foot comes down `half_m` ahead of its home and lifts off as far behind, so a stance lasts 2 half_m /
 * speed. In that time all other feet, or groups of feet, must have had their turn. While they can do so one
 * after the other, they do, and the body stays balanced; faster, the feet of a group go together; faster
 * still, steps get shorter in time. */
#include "gait/gait_state.h"

static const float USED_ROAM = 0.62f;  /* share of what a foot may roam that a stride uses */
static const float USED = 0.7f;        /* of what lies ahead of home, or behind */
static const float LOWERED = 0.9f;     /* share of the hip's height that the body keeps in a stride */
static const float STRETCH = 0.97f;    /* of the uneased reach */
static const float LEAST = 0.05f;      /* of a leg's length: a foot may always be so far off */
static const float PEG = 0.25f;        /* the same of a leg of one bone */
static const float SLACK = 1.15f;      /* time of a turn, in steps */
static const float LEAN_S = 0.12f;     /* for the body to lean before a foot lifts off */
static const float LEAN_TWO_S = 0.3f;  /* the same on two legs */
static const float LONGEST = 1.35f;    /* share of the usual time of a step, at speed */
static const float SHORTEST = 0.25f;   /* share of the usual time below which no step goes */
static const float SLOWS_FROM = 0.82f; /* share of the roam from which on the body waits for its feet */
static const uint32_t MANY_LEGS = 6;   /* that balance while half of them are in the air */

sbf_vec3 sbri_body_velocity(const sbri_gait_state *state) {
  sbf_vec3 v = sbri_headed(state, sbri_vec3(state->sideways, 0, state->forward));
  if (state->pivot) { /* about a foot: it carries the body round */
    sbf_vec3 arm = sbri_sub(state->position, state->feet[state->pivot - 1].ground);
    v.x += state->turn * arm.z, v.z -= state->turn * arm.x;
  }
  return v;
}

sbf_vec3 sbri_home_arm(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbf_vec3 home = rig->legs[leg].home;
  if (rig->legs[leg].carrier >= 0) {
    const sbr_transform *bone =
        &sbri_chain_bones(rig, (sbri_gait_state *)(uintptr_t)state)[rig->legs[leg].carrier].frame;
    home = sbri_rotate(bone->rotation, sbri_scale(rig->legs[leg].carried_home, input->scale));
    home = sbri_sub(sbri_add(bone->position, home), state->position);
    return sbri_vec3(home.x, 0, home.z);
  }
  float width = rig->gait->step_width;
  if (state->standing_s == 0 && width > 0 && home.x != 0) home.x = home.x < 0 ? -width : width;
  home.y = 0;
  return sbri_headed(state, sbri_scale(home, input->scale));
}

sbf_vec3 sbri_home_velocity(const sbri_rig *rig, const sbri_gait_state *state, uint32_t leg, sbf_vec3 arm) {
  int32_t carrier = rig->legs[leg].carrier;
  if (carrier >= 0) {
    sbf_vec3 v = sbri_chain_bones(rig, (sbri_gait_state *)(uintptr_t)state)[carrier].velocity;
    return sbri_vec3(v.x, 0, v.z);
  }
  sbf_vec3 v = sbri_body_velocity(state);
  return sbri_vec3(v.x + state->turn * arm.z, 0, v.z - state->turn * arm.x);
}

sbf_vec3 sbri_hip_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, const sbr_transform *root) {
  const sbri_leg *l = &rig->legs[leg];
  if (l->carrier >= 0) {
    const sbr_transform *bone = &sbri_chain_bones(rig, (sbri_gait_state *)(uintptr_t)state)[l->carrier].frame;
    sbf_vec3 own = sbri_scale(rig->rest_local[l->upper].position, input->scale);
    return sbri_add(bone->position, sbri_rotate(bone->rotation, own));
  }
  /* Hips and chest turn about their own heads. */
  sbf_vec3 hip = rig->rest[l->upper].position;
  int32_t girdle = l->hind ? rig->gait->hips : rig->gait->chest;
  if (girdle >= 0) {
    sbf_vec3 pivot = rig->rest[girdle].position, arm = sbri_sub(hip, pivot);
    float s = l->hind ? state->hips_sine : state->chest_sine;
    float c = l->hind ? state->hips_cosine : state->chest_cosine;
    hip = sbri_add(pivot, sbri_vec3(c * arm.x + s * arm.z, arm.y, c * arm.z - s * arm.x));
  }
  return sbri_add(root->position, sbri_rotate(root->rotation, sbri_scale(hip, input->scale)));
}

float sbri_roam(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg,
    sbf_vec3 way) {
  const sbri_leg *l = &rig->legs[leg];
  const sbri_foot *foot = &state->feet[leg];
  float scale = input->scale, length = l->upper_length + l->lower_length,
        reach = length * (1 - l->soft_reach);
  sbf_vec3 hip = sbri_hip_of(rig, state, input, leg, &state->root);
  sbf_vec3 home = sbri_add(state->position, sbri_home_arm(rig, state, input, leg));
  home.y = foot->ground.y + state->position.y;
  sbf_vec3 off = sbri_sub(sbri_ankle_over(l, home, foot->normal, state->heading, scale), hip);
  float height = off.y < 0 ? LOWERED * off.y : off.y; /* the body comes down for its feet */
  reach *= STRETCH * scale;
  off.y = 0;
  float over = reach * reach - height * height, away = sbri_length(off),
        least = away + LEAST * length * scale;
  over = over > 0 ? sqrtf(over) : 0;
  if (l->lower < 0) over = away + PEG * length * scale;
  if (over < least) over = least;
  float along = sbri_dot(off, way), square = along * along - away * away + over * over;
  return (square > 0 ? sqrtf(square) : 0) - along; /* where the way leaves the circle about the hip */
}

float sbri_ahead(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, sbf_vec3 way, float half) {
  float ahead = USED * sbri_roam(rig, state, input, leg, way);
  float behind = USED * sbri_roam(rig, state, input, leg, sbri_scale(way, -1));
  if (half > ahead) return ahead;
  return half > behind ? 2 * half - behind : half;
}

sbri_stride sbri_stride_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_stride s = {0};
  float roam = 0;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    sbf_vec3 v = sbri_home_velocity(rig, state, i, sbri_home_arm(rig, state, input, i));
    float speed = sbri_length(v);
    s.speed = speed > s.speed ? speed : s.speed;
    sbf_vec3 way = sbri_normalize(v, sbri_headed(state, sbri_vec3(0, 0, 1)));
    float own =
        0.5f * (sbri_roam(rig, state, input, i, way) + sbri_roam(rig, state, input, i, sbri_scale(way, -1)));
    roam = i == 0 || own < roam ? own : roam;
  }
  float usual = rig->gait->step_duration, most = USED_ROAM * roam;
  float groups = (float)(rig->group_count > 1 ? rig->group_count : 2);
  float turns = rig->leg_count < MANY_LEGS ? (float)rig->leg_count : groups;
  float lean = rig->leg_count == 2 ? LEAN_TWO_S : rig->leg_count < MANY_LEGS ? LEAN_S : 0;
  float one_by_one = 0.5f * s.speed * (turns - 1) * (SLACK * usual + lean);
  s.together = turns > groups && one_by_one > (state->together ? 0.7f : 0.82f) * most;
  if (rig->leg_count == 2) s.together = one_by_one > (state->together ? 0.7f : 0.82f) * most;
  if (rig->has_pegs) s.together = true; /* they could not follow a body that leans */
  s.duration_s = usual;
  float needed = one_by_one;
  if (s.together || needed > most) { /* as much time as the reach allows: the quicker a step, the harder */
    float each_s = 0.5f * s.speed * (groups - 1) * SLACK * usual;
    s.duration_s = sbri_clamp(0.9f * most / each_s, SHORTEST, LONGEST) * usual;
    needed = 0.5f * s.speed * (groups - 1) * SLACK * s.duration_s;
    if (needed > most) needed = most;
  }
  float trigger = rig->gait->step_trigger * input->scale;
  s.half_m = needed > trigger ? needed : trigger < most ? trigger : most;
  s.spacing_m = (2 * s.half_m + s.speed * s.duration_s) / (s.together ? groups : turns);
  return s;
}

float sbri_strain(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbf_vec3 home = sbri_add(state->position, sbri_home_arm(rig, state, input, leg));
  sbf_vec3 away = sbri_sub(state->feet[leg].ground, home);
  away.y = 0;
  float distance = sbri_length(away);
  if (distance <= 0) return 0;
  float roam = sbri_roam(rig, state, input, leg, sbri_scale(away, 1 / distance));
  return distance / (roam > 1e-6f ? roam : 1e-6f);
}

float sbri_pace_of(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  float least = 1;
  for (uint32_t i = 0; i < rig->leg_count; i++) {
    const sbri_foot *foot = &state->feet[i];
    if (!foot->planted) continue;
    sbf_vec3 arm = sbri_home_arm(rig, state, input, i), home = sbri_add(state->position, arm);
    sbf_vec3 away = sbri_sub(home, foot->ground), v = sbri_home_velocity(rig, state, i, arm);
    away.y = 0;
    float distance = sbri_length(away), speed = sbri_length(v), strain = sbri_strain(rig, state, input, i);
    if (strain < SLOWS_FROM || speed <= 0) continue;
    float leaving = sbri_dot(away, v) / (distance * speed); /* 1: straight away from the foot */
    if (leaving <= 0) continue;
    float left = sbri_clamp((1 - strain) / (1 - SLOWS_FROM), 0, 1);
    float pace = 1 - leaving * (1 - sbri_smooth(left));
    least = pace < least ? pace : least;
  }
  return least;
}
