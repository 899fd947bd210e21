/* State of the animation layer, plain data: the body's motion, its feet, its head and tails. Places are
 * relative to the character's origin, world axes, metres as scaled. */
#ifndef SBRI_GAIT_STATE_H
#define SBRI_GAIT_STATE_H

#include "gait/gait.h"

/* A second-order follower of one number: `value` lags and overshoots. */
typedef struct sbri_lag {
  float value, rate;
} sbri_lag;

typedef struct sbri_foot {
  sbf_vec3 ground; /* where the sole stands, or the place below it on the line of its step */
  sbf_vec3 normal; /* of the ground there, eased while it swings */
  float heading;   /* the foot's own, rad, less the body's: kept as the body turns */
  float lift;      /* of the sole above `ground`, m */
  sbf_vec3 from, from_normal, to, to_normal; /* of the step under way */
  float from_heading;
  float phase; /* 0..1 of the step under way */
  float duration_s;
  uint32_t planted; /* 1 or 0 */
  uint32_t steps_taken;
} sbri_foot;

typedef struct sbri_gait_state {
  sbf_vec3 position; /* where the asset's origin stands; y: how far all is raised above the ground */
  float heading;     /* rad, in (-pi, pi] */
  float forward, sideways, turn; /* eased, m/s and rad/s */
  float standing_s;              /* since it stopped moving; 0 while it moves */
  double distance_m;
  sbri_lag head_yaw;
  uint32_t foot_count, tail_bone_count;
  sbri_foot feet[SBRI_MOST_LEGS];
  /* behind it: tail_bone_count x {yaw, pitch} as sbri_lag, relative to the body's heading */
} sbri_gait_state;

static inline sbri_lag *sbri_tail_lags(sbri_gait_state *state) {
  return (sbri_lag *)(void *)(state + 1);
}

/* Advances a follower: y'' = w^2 (target - y) - 2 z w y', w = 2 pi f, semi-implicit with the tick cut into
 * parts of at most a tenth of a radian of w, so that it is stable for any tick. */
void sbri_lag_tick(sbri_lag *lag, float target, float frequency_hz, float damping_ratio, float tick_s);

/* An angle brought into (-pi, pi]. */
float sbri_wrap_angle(float angle);

/* `v` turned about +Y. */
sbf_vec3 sbri_turned(sbf_vec3 v, float yaw);

/* The place on the ground above or below `place`; `normal` may be NULL. */
sbf_vec3 sbri_ground_below(const sbri_gait_input *input, sbf_vec3 place, sbf_vec3 *normal);

/* ---- gait/feet.c ---- */

/* Puts a leg's foot down at its home. */
void sbri_foot_place(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, uint32_t leg);

/* Decides who steps and moves the feet in the air; returns how many events were written. */
uint32_t sbri_feet_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    sbri_gait_event *events, uint32_t capacity);

/* ---- gait/body.c ---- */

/* How the body stands over its feet. */
typedef struct sbri_stance {
  sbr_transform root;        /* where the asset's origin and axes have gone */
  float hips_yaw, chest_yaw; /* rad, relative to the heading */
} sbri_stance;
sbri_stance sbri_body_stance(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);

/* The whole pose: body, head, tails, legs. */
void sbri_body_pose(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform *pose);

/* ---- chain/tail.c ---- */

/* Followers of the tails' bones: each goes after the one before it, the first after the hips. */
void sbri_tails_tick(
    const sbri_rig *rig, sbri_gait_state *state, float hips_yaw, float turned_by, float tick_s);

#endif
