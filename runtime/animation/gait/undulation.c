/* A wave that travels along the spine from the nose to the tail (spec 14.7): the motion of fishes after
 * Lighthill (1960), amplitudes after Borazjani and Sotiropoulos (2008). */
#include "animation/gait/motion_kinds.h"
#include "math/trig.h"

static const float TURN = 6.2831853f;
static const float RESTS = 0.3f;    /* weight of the wave at rest */
static const float SWELLS_S = 0.4f; /* time over which the weight follows the speed */
static const float BEND_HZ = 1;     /* critically damped follower of the bend in a turn */
static const float MAX_BEND = 1.2f; /* rad, from the nose to the tail */

/* Amplitude at the tail: the sum of the coefficients. */
static float tail_amplitude(const sbf_undulation *wave) {
  return wave->exaggeration * (wave->amplitude.x + wave->amplitude.y + wave->amplitude.z);
}

float sbri_wave_slope(const sbf_undulation *wave, float strength, float phase, float s, float *displacement) {
  float e = strength * wave->exaggeration, sine, cosine;
  float a = e * (wave->amplitude.x + s * (wave->amplitude.y + s * wave->amplitude.z));
  float grows = e * (wave->amplitude.y + 2 * s * wave->amplitude.z), k = TURN / wave->wavelength;
  float turns = phase - s / wave->wavelength;
  sbri_sincos(TURN * turns, &sine, &cosine);
  *displacement = a * sine;
  return sbri_atan2(grows * sine - a * k * cosine, 1);
}

float sbri_wave_frequency(const sbf_undulation *wave, float speed, float length_m) {
  float across = 2 * fabsf(tail_amplitude(wave)) * length_m;
  float f = across > 0 ? wave->strouhal_number * fabsf(speed) / across : wave->idle_frequency;
  float min = wave->idle_frequency < wave->max_frequency ? wave->idle_frequency : wave->max_frequency;
  return sbri_clamp(f, min, wave->max_frequency);
}

void sbri_undulation_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  const sbf_undulation *wave = rig->gait->undulation;
  sbri_motion_state *m = sbri_motion(rig, state);
  if (!wave) return;
  float speed = sbri_motion_speed(rig, state), length = rig->wave.length * input->scale;
  float cruise = rig->gait->walk_speed * input->scale;
  bool crawls = rig->gait->kind == SBF_GAIT_KIND_CRAWL;
  float rests = crawls ? 0 : RESTS, goal = rests + (1 - rests) * sbri_clamp(2 * speed / cruise, 0, 1);
  m->strength += (goal - m->strength) * (1 - sbri_exp(-input->tick_s / SWELLS_S));
  if (goal == 0 && m->strength < 1e-4f) m->strength = 0;
  float f = sbri_wave_frequency(wave, speed, length);
  if (crawls && m->strength == 0) f = 0; /* no wave at rest */
  m->wave += (state->motion.forward < 0 ? -f : f) * input->tick_s;
  m->wave -= (float)(int32_t)m->wave;
  if (m->wave < 0) m->wave += 1;
  float slowest = 0.5f * cruise, bend = state->motion.turn * length / (speed > slowest ? speed : slowest);
  if (wave->plane != SBF_WAVE_PLANE_LATERAL) bend = 0;
  sbri_follower_step step = sbri_follower_step_of(BEND_HZ, 1, 0, input->tick_s);
  sbri_lag_tick(&m->bend, sbri_clamp(bend, -MAX_BEND, MAX_BEND), &step);
  if (bend == 0 && fabsf(m->bend.value) < 1e-5f && fabsf(m->bend.rate) < 1e-5f) m->bend = (sbri_lag){0, 0};
}

static bool in_chain(const sbri_rig *rig, int32_t bone) {
  for (int32_t b = bone; b >= 0; b = rig->bones.parents[b])
    for (uint32_t k = 0; k < rig->gait->undulation->bones.count; k++)
      if ((int32_t)rig->gait->undulation->bones.at[k] == b) return true;
  return false;
}

/* Slope and displacement of the kind's wave at s. */
static float slope_at(const sbri_rig *rig, const sbri_motion_state *m, float s, float *displacement) {
  const sbf_undulation *wave = rig->gait->undulation;
  float slope = sbri_wave_slope(wave, m->strength, m->wave, s, displacement);
  if (rig->gait->kind != SBF_GAIT_KIND_CRAWL) return slope;
  /* Raised by its amplitude, so that it stays above the ground. */
  float e = m->strength * wave->exaggeration, sine, cosine, rise;
  float a = e * (wave->amplitude.x + s * (wave->amplitude.y + s * wave->amplitude.z));
  *displacement += fabsf(a);
  sbri_sincos(slope, &sine, &cosine);
  rise = e * (wave->amplitude.y + 2 * s * wave->amplitude.z);
  return sbri_atan2(sine / cosine + (a < 0 ? -rise : rise), 1);
}

void sbri_undulation_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose) {
  const sbf_undulation *wave = rig->gait->undulation;
  const sbri_motion_state *m = sbri_motion(rig, state);
  if (!wave) return;
  bool vertical = wave->plane == SBF_WAVE_PLANE_VERTICAL || rig->gait->kind == SBF_GAIT_KIND_CRAWL;
  float length = rig->wave.length * input->scale;
  /* Parents first, in the order of the asset. */
  for (uint32_t b = 0; b < rig->bones.count; b++) {
    for (uint32_t k = 0; k < wave->bones.count; k++) {
      if (wave->bones.at[k] != b) continue;
      float shift, unused, s = rig->wave.middles[k], angle = slope_at(rig, m, s, &unused);
      slope_at(rig, m, rig->wave.heads[k], &shift);
      if (!in_chain(rig, rig->bones.parents[b])) {
        sbf_vec3 aside = vertical ? sbri_vec3(0, shift * length, 0) : sbri_vec3(shift * length, 0, 0);
        sbri_rig_shift(rig, b, sbri_rotate(root->rotation, aside), pose);
      }
      /* s increases backwards: where the wave goes to +x with s, the chain's line rotates from -z to +x. */
      sbf_quat rotation = {0, 0, 0, 1};
      if (vertical)
        sbri_sincos(0.5f * angle, &rotation.x, &rotation.w);
      else
        sbri_sincos(0.5f * (m->bend.value * (0.5f - s) - angle), &rotation.y, &rotation.w);
      rotation =
          sbri_quat_multiply(sbri_quat_multiply(root->rotation, rotation), rig->bones.rest[b].rotation);
      sbri_motion_rotate_bone(rig, b, rotation, root, pose);
      break;
    }
  }
}
