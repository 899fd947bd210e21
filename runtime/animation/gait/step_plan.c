/* Plans a foot's path through the air: its height, the times at which it begins and ends to move
 * horizontally, and its duration.
 *
 * The foot moves straight from one position to the next and is lifted off that line up to the middle of its
 * time, all along minimum-jerk curves. Over an obstacle it gains height early when going up and loses it late
 * when going down, moves horizontally later or arrives earlier, and is lifted higher. The step lasts as long
 * as the knee needs to follow. */
#include "animation/gait/gait_state.h"
#include "math/trig.h"
#include "shapes/ground.h"

static const float CLEARANCE = 0.35f; /* clearance above obstacles as a fraction of the usual lift */
static const float MAX_LIFT = 2.5f;   /* maximum lift over the highest obstacle, in usual lifts */
static const float MAX_RISING_PHASE =
    0.3f; /* maximum fraction of the step in which a foot beside an obstacle only rises */
static const float MIN_CLIMB_PHASE = 0.6f;   /* minimum fraction of the step in which the height changes */
static const float MAX_KNEE_CHANGE = 3.925f; /* maximum change of the knee's rate per frame, degrees */
static const float FRAME_S = 1.0f / 60;      /* that frame */
static const float MAX_DURATION = 2.4f;      /* maximum duration as a multiple of the requested one */
static const float MIN_DURATION = 0.25f;     /* minimum duration as a multiple of the usual one */
static const float DEGREES = 57.2957795f;
enum { PROFILE_SAMPLES = 12, TRIES = 6, SAMPLES = 16 };

/* Fractions of horizontal and vertical travel at phase t of a step. */
static float travel_fraction(const sbri_foot *foot, float t) {
  return sbri_smooth((t - foot->step.move_begin) / (foot->step.move_end - foot->step.move_begin));
}

static float height_at(const sbri_foot *foot, float t) {
  float climb = sbri_smooth((t - foot->step.climb_begin) / (foot->step.climb_end - foot->step.climb_begin));
  float up = t < 0.5f ? 2 * t : 2 - 2 * t;
  return foot->step.from.y + (foot->step.to.y - foot->step.from.y) * climb +
         foot->step.clearance * sbri_smooth(up);
}

/* Slope of the ground along a horizontal direction, from its normal. */
static float slope_along(sbf_vec3 normal, sbf_vec3 direction) {
  return normal.y > 0.1f ? -(normal.x * direction.x + normal.z * direction.z) / normal.y : 0;
}

/* Height profile of the ground below a step, sampled in advance: minimum height of the sole's middle above
 * the line between both ends at which no part of the foot penetrates in any rotation. */
typedef struct profile {
  float min_heights[PROFILE_SAMPLES + 1];
  float highest; /* above the higher end */
} profile;

static profile sample_ground(const sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_foot *foot, const sbri_sole *sole) {
  profile p = {.highest = 0};
  sbf_vec3 direction = sbri_sub(foot->step.to, foot->step.from);
  direction.y = 0;
  direction = sbri_normalize(direction, sbri_vec3(0, 0, 0));
  float half = (sole->toe > sole->left ? sole->toe : sole->left) * input->scale;
  float from_slope = slope_along(foot->step.from_normal, direction),
        to_slope = slope_along(foot->step.to_normal, direction);
  float turned =
      state->motion.turn * state->stepping.speed_fraction * (1 - foot->step.phase) * foot->step.duration_s;
  float higher = foot->step.from.y > foot->step.to.y ? foot->step.from.y : foot->step.to.y;
  for (int k = 0; k <= PROFILE_SAMPLES; k++) {
    float fraction = (float)k / PROFILE_SAMPLES,
          tilt = half * (from_slope + fraction * (to_slope - from_slope));
    sbf_vec3 at = sbri_lerp(foot->step.from, foot->step.to, fraction);
    float fore = sbri_ground_below(input, sbri_add_scaled(at, direction, half), NULL).y - tilt;
    float hind = sbri_ground_below(input, sbri_add_scaled(at, direction, -half), NULL).y + tilt;
    float max = sbri_ground_below(input, at, NULL).y;
    max = fore > max ? fore : max;
    max = hind > max ? hind : max;
    for (int c = 0; c < 4; c++) {
      sbf_vec3 corner = {c & 1 ? sole->left : sole->right, 0, c & 2 ? sole->toe : sole->heel};
      corner = sbri_rotate_yaw(
          sbri_scale(corner, input->scale), foot->heading + fraction * (turned - foot->heading));
      corner = sbri_body_to_world(state, corner);
      float from = slope_along(foot->step.from_normal, corner),
            to = slope_along(foot->step.to_normal, corner);
      float under = sbri_ground_below(input, sbri_add(at, corner), NULL).y - from - fraction * (to - from);
      max = under > max ? under : max;
    }
    p.min_heights[k] = max - at.y;
    if (max - higher > p.highest) p.highest = max - higher;
  }
  return p;
}

/* Maximum lack of clearance of the path and the phase of it. */
static float missing_clearance(const sbri_foot *foot, const profile *p, float margin, float *when) {
  float worst = 0;
  for (int k = 1; k < 2 * PROFILE_SAMPLES; k++) {
    float t = (float)k / (2 * PROFILE_SAMPLES), fraction = travel_fraction(foot, t),
          coordinate = fraction * PROFILE_SAMPLES;
    int i = (int)coordinate < PROFILE_SAMPLES ? (int)coordinate : PROFILE_SAMPLES - 1;
    float near = p->min_heights[i] > p->min_heights[i + 1]
                     ? p->min_heights[i]
                     : p->min_heights[i + 1]; /* an edge may lie between */
    float rises = 4 * t * (1 - t),
          line = foot->step.from.y + fraction * (foot->step.to.y - foot->step.from.y);
    float low = line + near + margin * rises * rises - height_at(foot, t);
    bool leaves = coordinate < 1 && p->min_heights[1] <= margin,
         comes = coordinate > PROFILE_SAMPLES - 1 && p->min_heights[PROFILE_SAMPLES - 1] <= margin;
    if (!leaves && !comes && low > worst) worst = low, *when = t;
  }
  return worst;
}

/* Changes the step's timing to increase clearance, except for motion that has begun. Returns false if the
 * timing is at its limits. */
static bool add_clearance(sbri_foot *foot, float when) {
  float rise = foot->step.to.y - foot->step.from.y;
  bool fresh = foot->step.phase <= 0;
  if (rise > 0 && foot->step.climb_end > MIN_CLIMB_PHASE) {
    foot->step.climb_end -= 0.5f * (1 - MIN_CLIMB_PHASE);
  } else if (fresh && rise < 0 && foot->step.climb_begin < 1 - MIN_CLIMB_PHASE) {
    foot->step.climb_begin += 0.5f * (1 - MIN_CLIMB_PHASE);
  } else if (fresh && when < 0.5f && foot->step.move_begin < MAX_RISING_PHASE) {
    foot->step.move_begin += 0.5f * MAX_RISING_PHASE;
  } else if (when >= 0.5f && foot->step.move_end > 1 - MAX_RISING_PHASE) {
    foot->step.move_end -= 0.5f * MAX_RISING_PHASE;
  } else {
    return false;
  }
  return true;
}

void sbri_step_plan(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg) {
  sbri_foot *foot = &state->feet[leg];
  float usual = rig->gait->step_height * input->scale, when = 0;
  if (foot->step.phase <= 0) foot->step.move_begin = foot->step.climb_begin = 0;
  foot->step.move_end = foot->step.climb_end = 1;
  foot->step.clearance = usual;
  double level;
  if (sbri_ground_is_flat(input->ground, &level)) return;
  profile p = sample_ground(state, input, foot, &rig->legs[leg].sole);
  float max = MAX_LIFT * (usual + p.highest);
  for (int tries = 0; tries < TRIES; tries++) {
    float missing = missing_clearance(foot, &p, CLEARANCE * usual, &when);
    if (missing <= 0) return;
    if (add_clearance(foot, when)) continue;
    float up = sbri_smooth(when < 0.5f ? 2 * when : 2 - 2 * when);
    foot->step.clearance += missing / (up > 0.5f ? up : 0.5f);
    if (foot->step.clearance > max) foot->step.clearance = max;
  }
}

/* Maximum change of the knee's rate between frames of the planned step, degrees, for a duration of
 * `duration_s` and constant hip velocity. */
static float max_knee_change(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float duration_s) {
  const sbri_leg *l = &rig->legs[leg];
  const sbri_foot *foot = &state->feet[leg];
  float upper = l->length.upper * input->scale, lower = l->length.lower * input->scale, max = 0;
  sbf_vec3 hip = sbri_hip_of(rig, state, input, leg, &state->posture.root);
  sbf_vec3 drift = sbri_scale(sbri_home_velocity(rig, state, leg, sbri_home_arm(rig, state, input, leg)),
      state->stepping.speed_fraction * duration_s);
  sbf_vec3 min_heights = sbri_sub(sbri_ankle_over(l, foot, foot->step.from, input->scale), foot->step.from);
  float h = duration_s / SAMPLES, unit = DEGREES * FRAME_S * FRAME_S / (h * h), knee[3] = {0, 0, 0};
  float rise = foot->step.to.y - foot->step.from.y,
        limit = (1 - 0.5f * l->length.soft_reach) * l->length.reach * input->scale;
  for (int k = -2; k <= SAMPLES; k++) {
    float t = (float)k / SAMPLES, in_air = t > 0 ? t : 0;
    sbf_vec3 sole = sbri_lerp(foot->step.from, foot->step.to, travel_fraction(foot, in_air));
    sole.y = height_at(foot, in_air) + state->motion.position.y;
    sbf_vec3 at = sbri_add_scaled(hip, drift, t);
    at.y += 0.5f * rise * sbri_smooth(in_air); /* the body follows its feet */
    float s = sbri_length(sbri_sub(sbri_add(sole, min_heights), at));
    s = sbri_leg_span(l, input->scale, s > limit ? limit : s);
    knee[0] = knee[1], knee[1] = knee[2];
    knee[2] = sbri_acos((upper * upper + lower * lower - s * s) / (2 * upper * lower));
    if (k < 0) continue;
    float bend = fabsf(knee[2] - 2 * knee[1] + knee[0]) * unit;
    max = bend > max ? bend : max;
  }
  return max;
}

float sbri_step_duration(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input,
    uint32_t leg, float wanted_s) {
  float usual = rig->gait->step_duration;
  if (rig->legs[leg].lower < 0) return wanted_s < usual ? wanted_s : usual; /* it has no knee */
  float duration = wanted_s;
  for (int pass = 0; pass < 3; pass++) {
    float step = max_knee_change(rig, state, input, leg, duration);
    if (pass > 0 && step <= MAX_KNEE_CHANGE) break;
    duration *= sqrtf(step / MAX_KNEE_CHANGE);
    if (duration < wanted_s) break;
  }
  if (duration > MAX_DURATION * wanted_s) return MAX_DURATION * wanted_s;
  return duration > MIN_DURATION * usual ? duration : MIN_DURATION * usual;
}
