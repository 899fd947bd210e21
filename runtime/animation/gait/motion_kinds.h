/* Kinds of gait other than walking (spec 14.7): their state and functions, file by file. */
#ifndef SBRI_MOTION_KINDS_H
#define SBRI_MOTION_KINDS_H

#include "animation/gait/gait_state.h"

enum { SBRI_PATH_POINTS = 80 }; /* points of the path of a snake's nose: SBRI_PATH_PER_BODY per body length */
enum { SBRI_PATH_PER_BODY = 64 };

/* State of a fin. */
typedef struct sbri_fin_state {
  float beat;   /* cycles, 0 to 1 */
  sbri_lag lag; /* angle of a fin that trails or steers, rad */
} sbri_fin_state;

/* State of rigs for which sbri_has_motion is true, behind the followers. */
typedef struct sbri_motion_state {
  float up;                   /* vertical speed, m/s */
  float wave, strength;       /* phase of the wave in cycles, 0 to 1; weight of its amplitude, 0 to 1 */
  float bob;                  /* phase of the rise and fall, cycles */
  float glide;                /* 0: the wings beat, 1: they are still */
  float hop;                  /* phase of a hop, 0 to 1; in the air from 0.5 */
  float steering;             /* smoothed wanted turn rate, rad/s */
  sbri_lag bank, pitch;       /* rad */
  sbri_lag bend;              /* total bend of the chain over the body's length, rad */
  float idle_time, move_time; /* of the gait's clips, s */
  float path_phase,
      path_ahead;      /* of the serpenoid curve, cycles; distance of the nose from the first point, m */
  uint32_t path_count; /* of `path`: 0 or SBRI_PATH_POINTS */
  sbf_vec3 nose;       /* on the path; relative to the origin, as `path` is, m */
  sbf_vec3 path[SBRI_PATH_POINTS]; /* past positions of the nose, newest first; y: height of the last pose */
  /* In memory it is followed by an sbri_fin_state per fin, an angle (rad) per wheel, a distance (m) per
   * tread. */
} sbri_motion_state;

static inline sbri_motion_state *sbri_motion(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_motion_state *)(void *)(sbri_bone_followers(rig, state) + rig->asset->followers.count);
}
static inline sbri_fin_state *sbri_fin_states(const sbri_rig *rig, sbri_gait_state *state) {
  return (sbri_fin_state *)(void *)(sbri_motion(rig, state) + 1);
}
static inline float *sbri_wheel_angles(const sbri_rig *rig, sbri_gait_state *state) {
  return (float *)(void *)(sbri_fin_states(rig, state) + rig->gait->fins.count);
}
static inline float *sbri_tread_distances(const sbri_rig *rig, sbri_gait_state *state) {
  return sbri_wheel_angles(rig, state) + rig->gait->wheels.count;
}

/* ---- animation/gait/motion_parts.c: shared by the kinds ---- */

/* Whether a rig moves more than legs: its kind is not walk, or its gait has clips. */
bool sbri_has_motion(const sbri_rig *rig);
/* Whether the character swims or flies, so that the ground does not set its height. */
bool sbri_is_afloat(const sbri_rig *rig);
static inline bool sbri_is_kind(const sbri_rig *rig, sbf_gait_kind kind) {
  return rig->gait && rig->gait->kind == kind;
}
/* Rotates a bone with its descendants to `to`, within its joint limits. */
void sbri_motion_rotate_bone(
    const sbri_rig *rig, uint32_t bone, sbf_quat to, const sbr_transform *root, sbr_transform *pose);
/* Rotation of a bone's parent since rest. */
sbf_quat sbri_motion_parent_rotation(
    const sbri_rig *rig, uint32_t bone, const sbr_transform *root, const sbr_transform *pose);
/* Speed over the ground or through the medium, along the heading, m/s. */
float sbri_motion_speed(const sbri_rig *rig, const sbri_gait_state *state);

/* ---- animation/gait/motion_kinds.c: all kinds ---- */

size_t sbri_motion_size(const sbri_rig *rig);
/* Resets the state at the body's position. */
void sbri_motion_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* The command, limited to motions of the kind. */
sbri_gait_input sbri_motion_input(const sbri_rig *rig, const sbri_gait_input *input);
/* Speed factor in this tick for characters that hop; advances the hop. */
float sbri_hop_speed_fraction(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* Updates phases, angles and paths after the body has moved by `step`. */
void sbri_motion_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step);
void sbri_motion_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift);
/* Root frame; `level` is the upright frame on the ground. */
sbr_transform sbri_motion_root(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform level);
/* Rotates the bones of the kind; `pose` is in world axes. */
void sbri_motion_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);
/* ---- animation/gait/afloat.c: through water and air ---- */

/* Lowest height of the origin above the ground at which the body does not touch it, for a rotation. */
float sbri_afloat_lowest(const sbri_rig *rig, const sbri_gait_input *input, sbf_quat rotation);
/* Smooths the velocity and moves the body in three dimensions by `direction`. Returns the rotation. */
float sbri_afloat_move(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 *direction);
sbr_transform sbri_afloat_root(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform level);

/* ---- animation/gait/undulation.c ---- */

/* Slope of the wave at s, 0 to 1 from the nose, rad, and its displacement relative to the length. */
float sbri_wave_slope(const sbf_undulation *wave, float strength, float phase, float s, float *displacement);
/* Frequency at a speed, Hz; `length_m` as scaled. */
float sbri_wave_frequency(const sbf_undulation *wave, float speed, float length_m);
void sbri_undulation_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
void sbri_undulation_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

/* ---- animation/gait/fins.c ---- */

void sbri_fins_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
void sbri_fins_pose(
    const sbri_rig *rig, sbri_gait_state *state, const sbr_transform *root, sbr_transform *pose);

/* ---- animation/gait/slither.c ---- */

/* Deviation of the serpenoid curve from its mean line at a phase (cycles), to the left and ahead, for a path
 * of wavelength 1; `mean` receives the length of the line per metre of path. */
sbf_vec3 sbri_serpenoid(float amplitude, float phase, float *mean);
void sbri_slither_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
void sbri_slither_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step);
/* Mean height of the ground under the body, relative to the origin. */
float sbri_slither_support(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);
void sbri_slither_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

/* ---- animation/gait/wheels.c ---- */

/* Limits turn rate and sideways speed to what steering wheels allow. */
void sbri_wheels_allow(const sbri_rig *rig, sbri_gait_input *input);
void sbri_wheels_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
void sbri_wheels_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

#endif
