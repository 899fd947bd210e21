/* Tails: every bone follows the one before it as a second-order system, the first follows the hips, so that a
 * turn runs down the tail late and swings over. */
#include "gait/gait_state.h"
#include "math/vec3.h"

void sbri_tails_tick(
    const sbri_rig *rig, sbri_gait_state *state, float hips_yaw, float turned_by, float tick_s) {
  sbri_lag *lags = sbri_tail_lags(state);
  for (uint32_t t = 0; t < rig->tail_count; t++) {
    const sbri_tail *tail = &rig->tails[t];
    sbri_follower_step step = sbri_follower_step_of(tail->frequency, tail->damping_ratio, 0, tick_s);
    float yaw = hips_yaw, pitch = 0;
    for (uint32_t k = 0; k < tail->bone_count; k++) {
      sbri_lag *lag = &lags[2 * (tail->first_state + k)];
      lag[0].value -= turned_by; /* it stays where it pointed while the body turns under it */
      sbri_lag_tick(&lag[0], yaw, &step);
      sbri_lag_tick(&lag[1], pitch, &step);
      float held = sbri_clamp(lag[0].value, yaw - tail->limit, yaw + tail->limit);
      if (held != lag[0].value) lag[0] = (sbri_lag){held, 0};
      yaw = lag[0].value;
      pitch = lag[1].value;
    }
  }
}
