/* Tails: every bone follows the one before it as a second-order system, the first follows the hips, so that a
 * turn, or a rise of the ground, runs down the tail late and swings over. */
#include "gait/gait_state.h"
#include "math/vec3.h"

void sbri_tails_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_stance *stance) {
  sbri_lag *lags = sbri_tail_lags(state);
  for (uint32_t k = 0; k < rig->tail_bone_count; k++) {
    lags[2 * k] = (sbri_lag){0, 0};
    lags[2 * k + 1] = (sbri_lag){stance->hips_pitch, 0};
  }
}

/* Follows `leader` and bends no farther than `limit` from it; returns where it has come to. */
static float lag_behind(sbri_lag *lag, float leader, float limit, const sbri_follower_step *step) {
  sbri_lag_tick(lag, leader, step);
  float limited = sbri_clamp(lag->value, leader - limit, leader + limit);
  if (limited != lag->value) *lag = (sbri_lag){limited, 0};
  return limited;
}

void sbri_tails_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_stance *stance, float turned_by, float tick_s) {
  sbri_lag *lags = sbri_tail_lags(state);
  for (uint32_t t = 0; t < rig->tail_count; t++) {
    const sbri_tail *tail = &rig->tails[t];
    sbri_follower_step step = sbri_follower_step_of(tail->frequency, tail->damping_ratio, 0, tick_s);
    float yaw = stance->hips_yaw, pitch = stance->hips_pitch;
    for (uint32_t k = 0; k < tail->bone_count; k++) {
      sbri_lag *lag = &lags[2 * (tail->first_state + k)];
      lag[0].value -= turned_by; /* it stays where it pointed while the body turns under it */
      yaw = lag_behind(&lag[0], yaw, tail->limit, &step);
      pitch = lag_behind(&lag[1], pitch, tail->limit, &step);
    }
  }
}
