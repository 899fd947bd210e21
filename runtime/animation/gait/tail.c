/* Tails: every bone follows the one before it as a second-order system, and the first one follows the hips.
 * So a turn of the body, or a change of slope, moves down the tail with a lag and overshoots. Where the tail
 * would penetrate the ground, now or soon, the targets of its bones are raised. */
#include "animation/gait/gait_state.h"
#include "animation/gait/motion_kinds.h"
#include "math/quat.h"
#include "math/trig.h"
#include "math/vec3.h"

/* Maximum number of bones whose ends are kept above the ground. */
enum { MAX_CLEARED = 32 };

/* Look-ahead times of the ground: about the time that a tail needs to rise. */
static const float AHEAD_S[] = {0, 0.15f, 0.3f};
enum { LOOKUPS = sizeof AHEAD_S / sizeof *AHEAD_S };

/* Follows `leader` and bends by at most `limit` from it; returns the new value. */
static float follow_leader(sbri_lag *lag, float leader, float limit, const sbri_follower_step *step) {
  sbri_lag_tick(lag, leader, step);
  float limited = sbri_clamp(lag->value, leader - limit, leader + limit);
  if (limited != lag->value) *lag = (sbri_lag){limited, 0};
  return limited;
}

/* Vector of a bone in world axes at this yaw and pitch; positive pitch raises vectors that point backwards.
 */
static sbf_vec3 step_at(const sbri_stance *stance, sbf_vec3 step, float yaw, float pitch) {
  sbf_vec3 left = sbri_rotate(stance->root.rotation, sbri_rotate_yaw(sbri_vec3(1, 0, 0), yaw));
  sbf_vec3 level = sbri_rotate(stance->root.rotation, sbri_rotate_yaw(step, yaw));
  return sbri_rotate(sbri_quat_about(left, pitch - stance->hips_pitch), level);
}

/* Change of a bone's pitch that raises a point at `offset` from its head by `rise`. */
static float pitch_for(sbf_vec3 offset, float rise) {
  float level = sqrtf(offset.x * offset.x + offset.z * offset.z);
  return sbri_atan2(offset.y + rise, level) - sbri_atan2(offset.y, level);
}

/* Present pose of a tail, and the required height of the end of each bone. */
typedef struct cleared_tail {
  sbf_vec3 ends[MAX_CLEARED + 1]; /* head of the first bone, then ends of all bones; relative to the origin */
  float lowest[MAX_CLEARED];
  uint32_t count;
} cleared_tail;

static void find_ground(const sbri_rig *rig, const sbri_tail *tail, const sbri_lag *lags,
    const sbri_gait_state *state, const sbri_gait_input *input, const sbri_stance *stance, cleared_tail *to) {
  sbf_vec3 root = stance->root.position,
           velocity = sbri_vec3(state->motion.sideways, 0, state->motion.forward);
  velocity = sbri_rotate_yaw(velocity, state->motion.heading);
  sbf_vec3 head = sbri_scale(rig->bones.rest[tail->bone_indices[0]].position, input->scale);
  to->ends[0] = sbri_add(root, sbri_rotate(stance->root.rotation, sbri_rotate_yaw(head, stance->hips_yaw)));
  to->count = tail->bone_count < MAX_CLEARED ? tail->bone_count : MAX_CLEARED;
  for (uint32_t k = 0; k < to->count; k++) {
    sbf_vec3 step = sbri_scale(tail->bones[k].step, input->scale);
    sbf_vec3 end = sbri_add(to->ends[k], step_at(stance, step, lags[2 * k].value, lags[2 * k + 1].value));
    to->ends[k + 1] = end;
    to->lowest[k] = -INFINITY;
    for (int i = 0; i < LOOKUPS; i++) {
      sbf_vec3 at = sbri_add(end, sbri_scale(velocity, AHEAD_S[i]));
      to->lowest[k] = fmaxf(to->lowest[k], sbri_ground_below(input, at, NULL).y);
    }
    to->lowest[k] += tail->bones[k].clearance * input->scale;
  }
}

/* Rise of bone `k` from the pitch `leader` for which it and the bones behind it, straight on, clear the
 * ground. */
static float raise_of(const sbri_tail *tail, const cleared_tail *cleared, const sbri_gait_input *input,
    const sbri_stance *stance, uint32_t k, float yaw, float leader) {
  float raise = 0;
  sbf_vec3 offset = {0, 0, 0};
  for (uint32_t j = k; j < cleared->count; j++) {
    offset = sbri_add(offset, step_at(stance, sbri_scale(tail->bones[j].step, input->scale), yaw, leader));
    float missing = cleared->lowest[j] - (cleared->ends[k].y + offset.y);
    if (missing > 0) raise = fmaxf(raise, pitch_for(offset, missing));
  }
  return raise;
}

void sbri_tails_reset(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, const sbri_stance *stance) {
  sbri_lag *all = sbri_tail_lags(state);
  for (uint32_t t = 0; t < rig->tails.count; t++) {
    const sbri_tail *tail = &rig->tails.at[t];
    sbri_lag *lags = &all[2 * tail->first_state];
    for (uint32_t k = 0; k < tail->bone_count; k++)
      lags[2 * k] = (sbri_lag){0, 0}, lags[2 * k + 1] = (sbri_lag){stance->hips_pitch, 0};
    cleared_tail cleared = {.count = 0};
    if (!sbri_is_afloat(rig)) find_ground(rig, tail, lags, state, input, stance, &cleared);
    float pitch = stance->hips_pitch;
    for (uint32_t k = 0; k < tail->bone_count; k++) {
      float raise = k < cleared.count ? raise_of(tail, &cleared, input, stance, k, 0, pitch) : 0;
      pitch += fminf(raise, tail->limit);
      lags[2 * k + 1].value = pitch;
    }
  }
}

void sbri_tails_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbri_stance *stance, float turned_by) {
  sbri_lag *all = sbri_tail_lags(state);
  for (uint32_t t = 0; t < rig->tails.count; t++) {
    const sbri_tail *tail = &rig->tails.at[t];
    sbri_lag *lags = &all[2 * tail->first_state];
    sbri_follower_step step = sbri_follower_step_of(tail->frequency, tail->damping_ratio, 0, input->tick_s);
    cleared_tail cleared = {.count = 0};
    if (!sbri_is_afloat(rig)) find_ground(rig, tail, lags, state, input, stance, &cleared);
    float yaw = stance->hips_yaw, pitch = stance->hips_pitch;
    for (uint32_t k = 0; k < tail->bone_count; k++) {
      sbri_lag *lag = &lags[2 * k];
      lag[0].value -= turned_by; /* it keeps its direction while the body rotates */
      yaw = follow_leader(&lag[0], yaw, tail->limit, &step);
      if (k < cleared.count) pitch += raise_of(tail, &cleared, input, stance, k, yaw, pitch);
      pitch = follow_leader(&lag[1], pitch, tail->limit, &step);
    }
  }
}
