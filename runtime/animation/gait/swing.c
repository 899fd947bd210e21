/* Swing of a foot to a foothold ahead of its home. */
#include "animation/gait/gait_state.h"

static const float FIXED_TARGET_PHASE = 0.75f; /* phase from which the target is fixed */
static const float FIXED_HEIGHT_PHASE = 0.25f; /* phase from which the target's height is fixed */
static const float TARGET_FOLLOW =
    0.3f; /* fraction by which the target follows the wanted one per tick, at first */
static const float SPARE_TIME = 1.15f; /* available time as a multiple of the needed time */
static const float EASIEST =
    0.5f; /* on uneven ground, counted duration of an easy step, of the intended one */
static const float LEVEL = 0.08f; /* fraction of the reach: a larger difference of height is another level */
static const float TIME_TOLERANCE =
    1.02f; /* needed time as a multiple of the available time that is tolerated */
static const float REPLAN_DISTANCE =
    0.02f;                           /* fraction of the reach: a target that moves further is planned again */
static const float MIN_LIMIT = 0.1f; /* fraction of the commanded speed: minimum of the learned limit */
enum { PASSES = 4 };

/* Landing position: ahead of the foot's home at the time of landing. */
static sbf_vec3 target_position(const sbri_rig *rig, const sbri_gait_state *state,
    const sbri_gait_input *input, const sbri_stride *stride, uint32_t leg, float left_s) {
  float sustainable = state->feet[leg].step.speed_fraction;
  left_s *= state->stepping.speed_fraction < sustainable ? state->stepping.speed_fraction : sustainable;
  const sbri_home *at = &stride->homes[leg];
  float turned = state->motion.turn * left_s;
  sbf_vec3 home, now = at->arm, velocity = at->velocity, drift = sbri_body_velocity(state);
  if (rig->legs[leg].home.chain_bone >= 0) {
    home = sbri_add_scaled(sbri_add(state->motion.position, now), velocity, left_s);
  } else {
    drift = sbri_rotate_yaw(drift, 0.5f * turned);
    home = sbri_add(sbri_add_scaled(state->motion.position, drift, left_s), sbri_rotate_yaw(now, turned));
    velocity = sbri_rotate_yaw(velocity, turned);
  }
  if (state->stepping.standing_s > 0 || stride->speed <= 0) return home;
  sbf_vec3 direction = sbri_normalize(velocity, sbri_vec3(0, 0, 0));
  float half = stride->half_m * sbri_length(velocity) / stride->speed;
  float ahead = sbri_landing_distance(&at->circle, direction, half),
        max = SBRI_WIDEST * rig->stand.reach * input->scale;
  float travelled =
      sbri_dot(sbri_sub(home, state->feet[leg].step.from), direction); /* distance along the step */
  if (travelled + ahead > max) ahead = max > travelled ? max - travelled : 0;
  return sbri_add_scaled(home, direction, ahead);
}

static void update_target(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg, float fraction) {
  sbri_foot *foot = &state->feet[leg];
  float left = (1 - sbri_clamp(foot->step.phase, 0, 1)) * foot->step.duration_s;
  sbf_vec3 position, normal, wanted = target_position(rig, state, input, stride, leg, left);
  if (!sbri_find_foothold(rig, state, input, leg, wanted, &position, &normal))
    position = foot->step.from, normal = foot->step.from_normal;
  if (sbri_flat_distance(position, wanted) > 0) { /* another foothold: positions between are not checked */
    if (foot->step.phase > 0 &&
        sbri_can_stand(rig, state, input, leg, foot->step.to, foot->step.phase < FIXED_HEIGHT_PHASE))
      return;
    fraction = 1;
  }
  bool is_other_level = fabsf(position.y - foot->step.to.y) > LEVEL * rig->stand.reach * input->scale;
  if (foot->step.phase > FIXED_HEIGHT_PHASE && is_other_level) return; /* too late for another level */
  if (is_other_level) fraction = 1; /* there is no foothold between two levels */
  foot->step.to = sbri_lerp(foot->step.to, position, fraction);
  foot->step.to_normal = sbri_normalize(sbri_lerp(foot->step.to_normal, normal, fraction), normal);
}

/* Needed time over available time of a step. */
static float time_ratio_of(const sbri_foot *foot) {
  return foot->step.move_begin - foot->step.move_end + foot->step.climb_begin - foot->step.climb_end;
}

/* Plans the step. Returns true if it is higher or faster than the previous plan. */
static bool plan_path(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  float clearance = foot->step.clearance, ratio = time_ratio_of(foot);
  foot->step.planned = foot->step.to;
  sbri_step_plan(rig, state, input, leg);
  return foot->step.clearance > clearance || time_ratio_of(foot) > ratio;
}

/* Adapts the speed to the duration of steps: long steps make the next ones slower, and the body too if the
 * legs have no spare time, as on stairs. */
static void adapt_speed(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, float needed_s) {
  float easiest = stride->even ? 0 : EASIEST * stride->duration_s;
  if (needed_s < easiest) needed_s = easiest; /* one easy step does not predict the next */
  float fraction = needed_s > state->stepping.step_s || rig->leg_count < 2 ? 1 : 2 / (float)rig->leg_count;
  state->stepping.step_s += fraction * (needed_s - state->stepping.step_s);
  float wanted = sbri_wanted_speed(rig, state, input, stride->homes),
        max = stride->available_s * stride->speed;
  float at_max = max / (SPARE_TIME * state->stepping.step_s); /* m/s */
  if (stride->speed > 0) state->stepping.step_limit = wanted > at_max ? at_max / wanted : 1;
  if (state->stepping.step_limit < MIN_LIMIT) state->stepping.step_limit = MIN_LIMIT;
}

void sbri_swing_begin(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  foot->planted = 0;
  foot->step.phase = 0;
  foot->step.duration_s = stride->duration_s;
  foot->step.from = foot->ground;
  foot->step.from_normal = foot->normal;
  float needed = 0;
  for (int pass = 0; pass < PASSES; pass++) { /* a longer step lands further ahead */
    foot->step.speed_fraction = sbri_sustainable_fraction(rig, state, input, leg, foot->step.duration_s);
    update_target(rig, state, input, stride, leg, 1);
    if (!plan_path(rig, state, input, leg) && pass > 0) break; /* the plan has converged */
    needed = sbri_step_duration(rig, state, input, leg, stride->duration_s);
    if (needed <= TIME_TOLERANCE * foot->step.duration_s) break;
    foot->step.duration_s = needed;
  }
  foot->step.needed_s = needed;
  adapt_speed(rig, state, input, stride, needed);
  foot->glides.x = sbri_glide_at(foot->ground.x), foot->glides.z = sbri_glide_at(foot->ground.z);
  foot->glides.base = sbri_glide_at(foot->ground.y), foot->glides.rise = sbri_glide_at(0);
  foot->glides.tilt_x = sbri_glide_at(foot->normal.x), foot->glides.tilt_z = sbri_glide_at(foot->normal.z);
  foot->glides.twist = sbri_glide_at(foot->heading);
}

static void land(sbri_foot *foot) {
  foot->ground = foot->step.to;
  foot->normal = foot->step.to_normal;
  foot->heading = 0;
  foot->lift = 0;
  foot->step.phase = 0;
  foot->planted = 1;
  foot->steps_taken++;
}

/* Moves `g` by the part of the tick after phase `begins`, so that it arrives at phase `ends`. The tick ends
 * at phase `now`. */
static void move_coordinate(
    sbri_glide *g, float target, const sbri_foot *foot, float tick_s, float begins, float ends) {
  float since = (foot->step.phase - begins) * foot->step.duration_s, step = since < tick_s ? since : tick_s;
  if (step > 0) sbri_glide_tick(g, target, (ends - foot->step.phase) * foot->step.duration_s + step, step);
}

/* Moves the foot along its plan to its phase. */
static void move(sbri_foot *foot, float tick_s) {
  move_coordinate(&foot->glides.x, foot->step.to.x, foot, tick_s, foot->step.move_begin, foot->step.move_end);
  move_coordinate(&foot->glides.z, foot->step.to.z, foot, tick_s, foot->step.move_begin, foot->step.move_end);
  move_coordinate(
      &foot->glides.base, foot->step.to.y, foot, tick_s, foot->step.climb_begin, foot->step.climb_end);
  float past = (foot->step.phase - 0.5f) * foot->step.duration_s; /* rises until the middle, then falls */
  if (past < tick_s) move_coordinate(&foot->glides.rise, foot->step.clearance, foot, tick_s, 0, 0.5f);
  if (past > 0) move_coordinate(&foot->glides.rise, 0, foot, tick_s, 0.5f, 1);
  move_coordinate(&foot->glides.tilt_x, foot->step.to_normal.x, foot, tick_s, 0, 1);
  move_coordinate(&foot->glides.tilt_z, foot->step.to_normal.z, foot, tick_s, 0, 1);
  move_coordinate(&foot->glides.twist, 0, foot, tick_s, 0, 1);
  foot->ground = sbri_vec3(foot->glides.x.position, foot->glides.base.position, foot->glides.z.position);
  foot->lift = foot->glides.rise.position;
  float x = foot->glides.tilt_x.position, z = foot->glides.tilt_z.position, y = 1 - x * x - z * z;
  foot->normal = sbri_normalize(sbri_vec3(x, y > 0 ? sqrtf(y) : 0, z), sbri_vec3(0, 1, 0));
  foot->heading = foot->glides.twist.position;
}

/* Shortens a step that began at a lower speed to the present duration of steps, or to the time for which the
 * planted feet stay within reach, as far as its knee allows. */
static void shorten_step(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg, sbri_foot *foot) {
  float left = 1 - foot->step.phase;
  if (!state->stepping.quick || left <= 0) return;
  float duration = stride->duration_s < foot->step.duration_s ? stride->duration_s : foot->step.duration_s;
  duration *= sbri_sustainable_fraction(rig, state, input, leg, left * duration);
  if (duration < SPARE_TIME * foot->step.needed_s) duration = SPARE_TIME * foot->step.needed_s;
  if (duration < foot->step.duration_s) foot->step.duration_s = duration;
}

bool sbri_swing_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stride *stride, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  shorten_step(rig, state, input, stride, leg, foot);
  foot->step.phase += input->tick_s / foot->step.duration_s;
  if (foot->step.phase < FIXED_TARGET_PHASE) {
    float left = 1 - foot->step.phase / FIXED_TARGET_PHASE;
    update_target(rig, state, input, stride, leg, TARGET_FOLLOW * left);
    float distance = sbri_length(sbri_sub(foot->step.to, foot->step.planned));
    bool off_plan =
        foot->step.phase < FIXED_HEIGHT_PHASE && distance > REPLAN_DISTANCE * rig->stand.reach * input->scale;
    if (off_plan) (void)plan_path(rig, state, input, leg);
    if (off_plan && foot->step.clearance > rig->gait->step_height * input->scale) { /* over an obstacle */
      float needed = sbri_step_duration(rig, state, input, leg, stride->duration_s);
      if (needed > foot->step.needed_s) foot->step.needed_s = needed;
      if (needed > foot->step.duration_s) foot->step.duration_s = needed;
    }
  } else if (foot->step.to_normal.y != 0) {
    sbf_vec3 position = foot->step.to, normal = foot->step.to_normal;
    sbri_set_sole_on_ground(rig, state, input, leg, &position, &normal);
    bool is_other_level =
        fabsf(position.y - foot->step.to.y) > LEVEL * rig->stand.reach * input->scale; /* too late for that */
    if (!is_other_level) foot->step.to = position, foot->step.to_normal = normal;
  }
  bool down = foot->step.phase >= 1;
  if (down)
    land(foot);
  else
    move(foot, input->tick_s);
  sbri_foot_update_orientation(rig, state, input, leg);
  return down;
}
