/* Kinds of gait other than walking: their common part, and the dispatch to their files (spec 14.7). */
#include "animation/gait/motion_kinds.h"

#include "math/trig.h"

static const float STEERS_S = 0.15f;  /* time over which fins and wheels reach a commanded turn rate */
static const float TURNS_HOP = 0.05f; /* rad/s; minimum turn rate that causes a hop */

size_t sbri_motion_size(const sbri_rig *rig) {
  if (!sbri_has_motion(rig)) return 0;
  return sizeof(sbri_motion_state) + rig->gait->fins.count * sizeof(sbri_fin_state) +
         (rig->gait->wheels.count + rig->gait->treads.count) * sizeof(float);
}

void sbri_motion_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  if (!sbri_is_afloat(rig)) return;
  float altitude = rig->gait->medium ? rig->gait->medium->altitude * input->scale : 0;
  float lowest = sbri_afloat_lowest(rig, input, sbri_quat_identity()) + altitude;
  if (state->motion.position.y < lowest) state->motion.position.y = lowest;
}

sbri_gait_input sbri_motion_input(const sbri_rig *rig, const sbri_gait_input *input) {
  sbri_gait_input allowed = *input;
  switch (rig->gait ? rig->gait->kind : SBF_GAIT_KIND_WALK) {
  case SBF_GAIT_KIND_NONE:
    allowed.forward = allowed.sideways = allowed.turn = allowed.up = 0;
    break;
  case SBF_GAIT_KIND_SLITHER: {
    /* It follows its nose: it moves forward only, and turns only while moving. */
    if (allowed.forward < 0) allowed.forward = 0;
    allowed.sideways = 0;
    float length = rig->wave.length * input->scale, max = length > 0 ? 4 * allowed.forward / length : 0;
    allowed.turn = sbri_clamp(allowed.turn, -max, max);
    break;
  }
  case SBF_GAIT_KIND_ROLL:
    allowed.sideways = 0;
    sbri_wheels_allow(rig, &allowed);
    break;
  default:
    break;
  }
  return allowed;
}

/* Hops: half of the time on the ground, twice as fast in the air. */
float sbri_hop_speed_fraction(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  if (!sbri_is_kind(rig, SBF_GAIT_KIND_CRAWL) || rig->gait->undulation) return 1;
  sbri_motion_state *m = sbri_motion(rig, state);
  bool has_command = input->forward != 0 || input->sideways != 0 || fabsf(input->turn) > TURNS_HOP;
  if (!has_command && m->hop == 0) return 1; /* the remaining speed decays on the ground */
  float old_phase = m->hop;
  m->hop += input->tick_s / rig->gait->step_duration;
  if (old_phase < 0.5f && m->hop >= 0.5f && !has_command) m->hop = 0;
  if (m->hop >= 1) m->hop = has_command ? sbri_wrap(m->hop, 1) : 0;
  /* Fraction of the tick in the air. */
  float end = m->hop < old_phase ? m->hop + 1 : m->hop, span = end - old_phase;
  float air = (end < 1 ? end : 1) - (old_phase > 0.5f ? old_phase : 0.5f);
  if (end > 1.5f) air += end - 1.5f;
  return span > 0 && air > 0 ? 2 * (air < span ? air / span : 1) : 0;
}

static float hop_height(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input) {
  const sbri_motion_state *m = sbri_motion(rig, (sbri_gait_state *)(uintptr_t)state);
  float q = 2 * m->hop - 1;
  return q > 0 ? 4 * rig->gait->step_height * input->scale * q * (1 - q) : 0;
}

static float wrapped(float time, float duration) {
  return duration > 0 ? sbri_wrap(time, duration) : 0;
}

/* Advances the gait's clips. */
static void clips_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  sbri_motion_state *m = sbri_motion(rig, state);
  const sbf_gait *gait = rig->gait;
  float rate = sbri_motion_speed(rig, state) / (gait->walk_speed * input->scale);
  if (state->motion.forward < 0) rate = -rate;
  if (gait->idle_clip != SBF_NONE)
    m->idle_time = wrapped(m->idle_time + input->tick_s, rig->asset->clips.at[gait->idle_clip].duration);
  if (gait->move_clip != SBF_NONE)
    m->move_time =
        wrapped(m->move_time + rate * input->tick_s, rig->asset->clips.at[gait->move_clip].duration);
}

void sbri_motion_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step) {
  if (!sbri_has_motion(rig)) return;
  sbri_motion_state *m = sbri_motion(rig, state);
  m->steering += (input->turn - m->steering) * (1 - sbri_exp(-input->tick_s / STEERS_S));
  if (input->turn == 0 && fabsf(m->steering) < 1e-4f) m->steering = 0;
  clips_tick(rig, state, input);
  switch (rig->gait->kind) {
  case SBF_GAIT_KIND_SWIM:
  case SBF_GAIT_KIND_FLY:
  case SBF_GAIT_KIND_CRAWL:
    sbri_undulation_tick(rig, state, input);
    sbri_fins_tick(rig, state, input);
    break;
  case SBF_GAIT_KIND_SLITHER:
    sbri_slither_tick(rig, state, input, step);
    sbri_fins_tick(rig, state, input);
    break;
  case SBF_GAIT_KIND_ROLL:
    sbri_wheels_tick(rig, state, input);
    break;
  default:
    break;
  }
}

void sbri_motion_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift) {
  if (!sbri_has_motion(rig)) return;
  sbri_motion_state *m = sbri_motion(rig, state);
  sbf_vec3 level = {shift.x, 0, shift.z};
  if (!m->path_count) return;
  m->nose = sbri_sub(m->nose, level);
  for (uint32_t i = 0; i < m->path_count; i++) m->path[i] = sbri_sub(m->path[i], level);
}

sbr_transform sbri_motion_root(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform level) {
  if (!sbri_has_motion(rig)) return level;
  if (sbri_is_afloat(rig)) return sbri_afloat_root(rig, state, input, level);
  if (sbri_is_kind(rig, SBF_GAIT_KIND_CRAWL)) level.position.y += hop_height(rig, state, input);
  return level;
}

void sbri_motion_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose) {
  if (!sbri_has_motion(rig)) return;
  switch (rig->gait->kind) {
  case SBF_GAIT_KIND_SWIM:
  case SBF_GAIT_KIND_FLY:
  case SBF_GAIT_KIND_CRAWL:
    sbri_undulation_pose(rig, state, input, root, pose);
    sbri_fins_pose(rig, state, root, pose);
    break;
  case SBF_GAIT_KIND_SLITHER:
    sbri_slither_pose(rig, state, input, root, pose);
    sbri_fins_pose(rig, state, root, pose);
    break;
  case SBF_GAIT_KIND_ROLL:
    sbri_wheels_pose(rig, state, input, root, pose);
    break;
  default:
    break;
  }
}
