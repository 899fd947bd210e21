/* Fins, flippers and wings: they beat, trail behind the body's rotation, or steer against it (spec 14.7).
 * Strokes after Ellington (1984), waves along a ray's fin after Rosenberger (2001). */
#include "animation/gait/motion_kinds.h"
#include "math/trig.h"

static const float TURN = 6.2831853f;
static const float STEER_HZ = 1.5f, TRAIL_HZ = 2, UNSTATED_HZ = 1;
static const float FULL_TURN = 1; /* rad/s of rotation at which a steering fin is at its limit */
static const float SLOW = 0.6f,
                   QUICK = 1.4f; /* bounds of the beat frequency, relative to that at walk_speed */

static float beat_hz(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, const sbf_fin *fin) {
  float of_cruise = sbri_motion_speed(rig, state) / (rig->gait->walk_speed * input->scale);
  return (fin->frequency > 0 ? fin->frequency : UNSTATED_HZ) * sbri_clamp(of_cruise, SLOW, QUICK);
}

void sbri_fins_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input) {
  const sbri_motion_state *m = sbri_motion(rig, state);
  sbri_fin_state *fins = sbri_fin_states(rig, state);
  float cruise = rig->gait->walk_speed * input->scale,
        rotated = state->motion.turn * state->stepping.speed_fraction * input->tick_s;
  for (uint32_t f = 0; f < rig->gait->fins.count; f++) {
    const sbf_fin *fin = &rig->gait->fins.at[f];
    sbf_vec3 axis = sbri_normalize(fin->axis, sbri_vec3(0, 0, 1));
    if (fin->motion == SBF_FIN_MOTION_FLAP) {
      bool has_own_beat = fin->frequency > 0 || !rig->gait->undulation;
      fins[f].beat = has_own_beat ? fins[f].beat + beat_hz(rig, state, input, fin) * input->tick_s : m->wave;
      fins[f].beat -= (float)(int32_t)fins[f].beat;
      continue;
    }
    float goal = 0, hz = STEER_HZ, damping = 1;
    if (fin->motion == SBF_FIN_MOTION_STEER) {
      float round = sbri_clamp(m->steering / FULL_TURN, -1, 1), climb = sbri_clamp(input->up / cruise, -1, 1);
      goal = -fin->amplitude * sbri_clamp(axis.y * round - axis.x * climb, -1, 1);
    } else {
      hz = fin->frequency > 0 ? fin->frequency : TRAIL_HZ;
      damping = 0.5f;
      fins[f].lag.value -= axis.y * rotated;
    }
    sbri_follower_step step = sbri_follower_step_of(hz, damping, 0, input->tick_s);
    sbri_lag_tick(&fins[f].lag, goal, &step);
    if (fabsf(fins[f].lag.value) > fin->amplitude) {
      fins[f].lag.value = sbri_clamp(fins[f].lag.value, -fin->amplitude, fin->amplitude);
      fins[f].lag.rate = 0;
    }
    if (goal == 0 && rotated == 0 && fabsf(fins[f].lag.value) < 1e-5f && fabsf(fins[f].lag.rate) < 1e-4f)
      fins[f].lag = (sbri_lag){0, 0};
  }
}

static sbf_quat rotation_about(sbf_vec3 axis, float angle) {
  float s, c;
  sbri_sincos(0.5f * angle, &s, &c);
  return (sbf_quat){axis.x * s, axis.y * s, axis.z * s, c};
}

/* Rotation of a bone relative to its parent without the fin's motion, in world axes. */
static sbf_quat base_rotation(
    const sbri_rig *rig, uint32_t bone, const sbr_transform *root, const sbr_transform *pose) {
  sbf_quat parent = rig->bones.parents[bone] >= 0 ? pose[rig->bones.parents[bone]].rotation : root->rotation;
  return sbri_quat_multiply(parent, rig->bones.base_local[bone].rotation);
}

void sbri_fins_pose(
    const sbri_rig *rig, sbri_gait_state *state, const sbr_transform *root, sbr_transform *pose) {
  const sbri_motion_state *m = sbri_motion(rig, state);
  const sbri_fin_state *fins = sbri_fin_states(rig, state);
  for (uint32_t f = 0; f < rig->gait->fins.count; f++) {
    const sbf_fin *fin = &rig->gait->fins.at[f];
    sbf_vec3 axis = sbri_normalize(fin->axis, sbri_vec3(0, 0, 1));
    uint32_t count = fin->bones.count;
    bool flaps = fin->motion == SBF_FIN_MOTION_FLAP;
    float beats = 1 - m->glide;
    if (flaps && fin->frequency == 0 && rig->gait->undulation) beats *= m->strength;
    for (uint32_t k = 0; k < count; k++) {
      uint32_t bone = fin->bones.at[k];
      float s = 0, c = 0, angle = fins[f].lag.value, twist = 0;
      if (flaps) {
        float later = count > 1 ? fin->lag * (float)k / (float)(count - 1) : 0;
        sbri_sincos(TURN * fins[f].beat + fin->phase - later, &s, &c);
        angle = k == 0 ? fin->mean + beats * fin->amplitude * s : beats * fin->flex / (float)(count - 1) * s;
        twist = k == 0 ? beats * fin->twist * c : 0;
      } else if (k > 0) {
        angle *= 0.5f; /* a soft fin bends on, by half from bone to bone */
        for (uint32_t j = 1; j < k; j++) angle *= 0.5f;
      } else {
        angle += fin->mean;
      }
      sbf_vec3 hinge = sbri_rotate(sbri_motion_parent_rotation(rig, bone, root, pose), axis);
      sbf_quat to = sbri_quat_multiply(rotation_about(hinge, angle), base_rotation(rig, bone, root, pose));
      if (twist != 0) to = sbri_quat_multiply(to, rotation_about(sbri_vec3(0, 1, 0), twist));
      sbri_motion_rotate_bone(rig, bone, to, root, pose);
    }
  }
}
