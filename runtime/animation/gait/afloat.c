/* Swimmers and fliers: they move in three dimensions, bank into turns, pitch along their path, and drift
 * without a command (spec 14.7, media). */
#include "animation/gait/motion_kinds.h"
#include "math/trig.h"

static const float SMOOTHING_S = 0.3f; /* smoothing time of commands */
static const float REST_S = 1.2f; /* time over which the remaining speed decays without command, with drag */
static const float LEANS_HZ = 0.9f; /* critically damped followers of bank and pitch */
static const float STILL = 0.004f;  /* m/s per metre of length: below this speed it hovers */
static const float GLIDE_S = 0.3f;  /* transition time between gliding and beating wings */

static const sbf_medium *medium_of(const sbri_rig *rig, sbf_medium *defaults) {
  if (rig->gait->medium) return rig->gait->medium;
  *defaults =
      (sbf_medium){.buoyancy = 1, .bank = 1, .bank_limit = 0.8f, .pitch_limit = 0.8f, .bob_frequency = 0.8f};
  return defaults;
}

static float gravity_of(const sbri_rig *rig) {
  float g = sbri_length(rig->asset->environment.gravity);
  return g > 0 ? g : 9.81f;
}

float sbri_afloat_lowest(const sbri_rig *rig, const sbri_gait_input *input, sbf_quat rotation) {
  sbf_vec3 middle = sbri_lerp(rig->stand.low, rig->stand.high, 0.5f);
  float min = 1e30f;
  for (int corner = 0; corner < 8; corner++) {
    sbf_vec3 at = {corner & 1 ? rig->stand.high.x : rig->stand.low.x,
        corner & 2 ? rig->stand.high.y : rig->stand.low.y, corner & 4 ? rig->stand.high.z : rig->stand.low.z};
    float y = middle.y + sbri_rotate(rotation, sbri_sub(at, middle)).y;
    if (y < min) min = y;
  }
  return -min * input->scale;
}

/* Rotation relative to the heading. */
static sbf_quat tilt_rotation(const sbri_motion_state *m) {
  sbf_quat pitch = {0, 0, 0, 1}, bank = {0, 0, 0, 1};
  sbri_sincos(0.5f * m->pitch.value, &pitch.x, &pitch.w);
  sbri_sincos(-0.5f * m->bank.value, &bank.z, &bank.w);
  return sbri_quat_multiply(pitch, bank);
}

/* Vertical speed without drive: approaches the terminal speed, at which drag balances weight minus buoyancy.
 */
static float passive_velocity(float up, float buoyancy, float g, float length_m, float h) {
  float excess = buoyancy - 1, max = sqrtf(fabsf(excess) * g * length_m);
  if (max > 0) {
    float goal = excess > 0 ? max : -max;
    return up + (goal - up) * (1 - sbri_exp(-h * fabsf(excess) * g / max));
  }
  return up * sbri_exp(-h * (fabsf(up) / length_m + 1 / REST_S));
}

/* Bounds a height above the ground: neither in the ground nor out of the water. */
static float bounded_height(const sbri_rig *rig, const sbri_gait_input *input, const sbri_motion_state *m,
    float ground, float height, float *up) {
  float lowest = sbri_afloat_lowest(rig, input, tilt_rotation(m));
  if (sbri_is_kind(rig, SBF_GAIT_KIND_SWIM) && rig->asset->environment.has_water) {
    double surface = (double)rig->asset->environment.water_level - input->origin.y;
    float max = (float)surface - rig->stand.high.y * input->scale - ground;
    if (height > max) {
      height = max;
      if (*up > 0) *up = 0;
    }
  }
  if (height < lowest) {
    height = lowest;
    if (*up < 0) *up = 0;
  }
  return height;
}

static void update_tilt(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbf_medium *medium, bool has_command) {
  sbri_motion_state *m = sbri_motion(rig, state);
  float cruise = rig->gait->walk_speed * input->scale, speed = state->motion.forward;
  float bank = sbri_atan2(medium->bank * speed * state->motion.turn, gravity_of(rig));
  bank = sbri_clamp(bank, -medium->bank_limit, medium->bank_limit);
  float climb = sbri_atan2(m->up, fabsf(speed) + 0.25f * cruise);
  if (!has_command) climb = 0; /* passive sinking does not change the pitch */
  float pitch = -sbri_clamp(climb, -medium->pitch_limit, medium->pitch_limit);
  pitch += medium->tilt * sbri_clamp(speed / cruise, -1.5f, 1.5f);
  sbri_follower_step step = sbri_follower_step_of(LEANS_HZ, 1, 0, input->tick_s);
  sbri_lag_tick(&m->bank, bank, &step);
  sbri_lag_tick(&m->pitch, pitch, &step);
}

static void update_glide(sbri_motion_state *m, const sbri_gait_input *input, const sbf_medium *medium) {
  bool still =
      medium->glide_ratio > 0 && input->forward > 0 && -input->up * medium->glide_ratio >= input->forward;
  m->glide += ((still ? 1.0f : 0.0f) - m->glide) * (1 - sbri_exp(-input->tick_s / GLIDE_S));
  if (!still && m->glide < 1e-4f) m->glide = 0;
  m->bob += medium->bob_frequency * input->tick_s;
  m->bob -= (float)(int32_t)m->bob;
  if (medium->bob == 0) m->bob = 0;
}

float sbri_afloat_move(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 *direction) {
  sbf_medium defaults;
  const sbf_medium *medium = medium_of(rig, &defaults);
  sbri_motion_state *m = sbri_motion(rig, state);
  float h = input->tick_s, smoothing = 1 - sbri_exp(-h / SMOOTHING_S);
  float length = medium->drag_length > 0 ? medium->drag_length : rig->wave.length;
  sbf_vec3 size = sbri_sub(rig->stand.high, rig->stand.low);
  if (!(length > 0)) length = size.x > size.z ? size.x : size.z;
  if (!(length > size.y * 1e-3f)) length = size.y > 0 ? size.y : 1;
  length *= input->scale;
  bool goes = input->forward != 0 || input->sideways != 0 || input->up != 0,
       has_command = goes || input->turn != 0;
  if (goes) {
    state->motion.forward += (input->forward - state->motion.forward) * smoothing;
    state->motion.sideways += (input->sideways - state->motion.sideways) * smoothing;
    m->up += (input->up - m->up) * smoothing;
  } else {
    float speed = sqrtf(
        state->motion.forward * state->motion.forward + state->motion.sideways * state->motion.sideways);
    float left = sbri_exp(-h * (speed / length + 1 / REST_S));
    state->motion.forward *= left;
    state->motion.sideways *= left;
    m->up = passive_velocity(m->up, medium->buoyancy, gravity_of(rig), length, h);
  }
  state->motion.turn += (input->turn - state->motion.turn) * smoothing;
  bool drifts = medium->buoyancy != 1;
  if (!has_command && sbri_motion_speed(rig, state) < STILL * length && fabsf(state->motion.turn) < STILL) {
    state->motion.forward = state->motion.sideways = state->motion.turn = 0;
    if (!drifts) m->up = 0;
    if (state->stepping.standing_s < 1) state->stepping.standing_s += h;
  } else {
    state->stepping.standing_s = 0;
  }
  update_tilt(rig, state, input, medium, has_command);
  update_glide(m, input, medium);
  float rotation = state->motion.turn * h, ground = sbri_ground_below(input, state->motion.position, NULL).y;
  sbf_vec3 step = sbri_scale(sbri_rotate_yaw(sbri_body_velocity(state), 0.5f * rotation), h);
  float height = ground + state->motion.position.y + m->up * h;
  state->motion.position.x += step.x, state->motion.position.z += step.z;
  float below = sbri_ground_below(input, state->motion.position, NULL).y;
  float at = bounded_height(rig, input, m, below, height - below, &m->up);
  step.y = at + below - ground - state->motion.position.y;
  state->motion.position.y = at;
  state->motion.heading = sbri_wrap_angle(state->motion.heading + rotation);
  sbri_sincos(state->motion.heading, &state->motion.heading_sine, &state->motion.heading_cosine);
  state->distance_m += (double)sbri_length(step);
  *direction = step;
  return rotation;
}

sbr_transform sbri_afloat_root(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform level) {
  const sbri_motion_state *m = sbri_motion(rig, (sbri_gait_state *)(uintptr_t)state);
  sbf_medium defaults;
  const sbf_medium *medium = medium_of(rig, &defaults);
  sbf_vec3 middle = sbri_scale(sbri_lerp(rig->stand.low, rig->stand.high, 0.5f), input->scale);
  sbr_transform root = level;
  root.rotation = sbri_quat_normalize(sbri_quat_multiply(level.rotation, tilt_rotation(m)));
  sbf_vec3 displacement = sbri_sub(sbri_rotate(level.rotation, middle), sbri_rotate(root.rotation, middle));
  root.position = sbri_add(root.position, displacement);
  if (medium->bob > 0) {
    float s, c, cruise = rig->gait->walk_speed * input->scale;
    float rests = 1 - sbri_clamp(2 * sbri_motion_speed(rig, state) / cruise, 0, 1);
    sbri_sincos(6.2831853f * m->bob, &s, &c);
    root.position.y += rests * medium->bob * input->scale * s;
  }
  return root;
}
