/* Kinds of gait other than walking (spec 14.7): state, and what each file of a kind gives to the gait. */
#ifndef SBRI_MOTION_KINDS_H
#define SBRI_MOTION_KINDS_H

#include "animation/gait/gait_state.h"

enum { SBRI_PATH_POINTS = 80 }; /* of the path of a snake's nose: SBRI_PATH_PER_BODY of them a length */
enum { SBRI_PATH_PER_BODY = 64 };

/* What a fin has come to. */
typedef struct sbri_fin_state {
  float beat;   /* cycles, 0 to 1 */
  sbri_lag lag; /* rad, of a fin that trails or steers */
} sbri_fin_state;

/* State of rigs for which sbri_has_motion is true, behind the followers. */
typedef struct sbri_motion_state {
  float up;                     /* vertical speed, m/s */
  float wave, strength;         /* phase of the wave in cycles, 0 to 1; weight of its amplitude, 0 to 1 */
  float bob;                    /* phase of the rise and fall, cycles */
  float glide;                  /* 0: the wings beat, 1: they are still */
  float hop;                    /* phase of a hop, 0 to 1; from a half on it is in the air */
  float steering;               /* wanted turn, eased, rad/s */
  sbri_lag bank, pitch;         /* rad */
  sbri_lag bend;                /* turn of the chain in the length of the body, rad */
  float idle_time, move_time;   /* of the gait's clips, s */
  float path_phase, path_ahead; /* of the serpenoid curve, cycles; m that the nose is past the first point */
  uint32_t path_count;          /* of `path`: 0 or SBRI_PATH_POINTS */
  sbf_vec3 nose;                /* on the path; relative to the origin, as `path` is, m */
  sbf_vec3 path[SBRI_PATH_POINTS]; /* where the nose was, newest first; y: height of the last pose */
  /* Behind it: sbri_fin_state for each fin, an angle (rad) for each wheel, a distance (m) for each tread. */
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

/* Whether a rig has more to move than legs: another kind than walk, or clips of its gait. */
bool sbri_has_motion(const sbri_rig *rig);
/* Swimmers and fliers: their height is their own. */
bool sbri_is_afloat(const sbri_rig *rig);
static inline bool sbri_is_kind(const sbri_rig *rig, sbf_gait_kind kind) {
  return rig->gait && rig->gait->kind == kind;
}
/* Turns a bone to a rotation, within its joint limits, and all that hangs on it. */
void sbri_motion_rotate_bone(
    const sbri_rig *rig, uint32_t bone, sbf_quat to, const sbr_transform *root, sbr_transform *pose);
/* What the parent of a bone has turned by since rest. */
sbf_quat sbri_motion_parent_rotation(
    const sbri_rig *rig, uint32_t bone, const sbr_transform *root, const sbr_transform *pose);
/* Speed over the ground or through the medium, along the heading, m/s; and all of it. */
float sbri_motion_speed(const sbri_rig *rig, const sbri_gait_state *state);

/* ---- animation/gait/motion_kinds.c: all kinds ---- */

size_t sbri_motion_size(const sbri_rig *rig);
/* Begins the state where the body has been placed. */
void sbri_motion_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* The drive as the kind can follow it. */
sbri_gait_input sbri_motion_input(const sbri_rig *rig, const sbri_gait_input *input);
/* Factor of the speed in this tick, of what hops; advances the hop. */
float sbri_hop_speed_fraction(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
/* After the body has moved by `step`: phases, angles, paths. */
void sbri_motion_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step);
void sbri_motion_rebase(const sbri_rig *rig, sbri_gait_state *state, sbf_vec3 shift);
/* The root frame above `level`, the upright frame on the ground. */
sbr_transform sbri_motion_root(
    const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input, sbr_transform level);
/* Turns the bones of the kind; `pose` is in world axes. */
void sbri_motion_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);
/* ---- animation/gait/afloat.c: through water and air ---- */

/* Lowest height of the origin above the ground at which nothing of it touches that; of how it is turned. */
float sbri_afloat_lowest(const sbri_rig *rig, const sbri_gait_input *input, sbf_quat rotation);
/* Eases the velocity, and moves the body in three dimensions by `direction`. Returns the turn made. */
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
 * of wavelength 1; `mean` receives how far the line goes for each metre of the path. */
sbf_vec3 sbri_serpenoid(float amplitude, float phase, float *mean);
void sbri_slither_reset(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
void sbri_slither_tick(
    const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input, sbf_vec3 step);
/* Mean height of the ground under the body, relative to the origin. */
float sbri_slither_support(const sbri_rig *rig, const sbri_gait_state *state, const sbri_gait_input *input);
void sbri_slither_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

/* ---- animation/gait/wheels.c ---- */

/* Turn rate and sideways speed that wheels which steer allow. */
void sbri_wheels_allow(const sbri_rig *rig, sbri_gait_input *input);
void sbri_wheels_tick(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input);
void sbri_wheels_pose(const sbri_rig *rig, sbri_gait_state *state, const sbri_gait_input *input,
    const sbr_transform *root, sbr_transform *pose);

#endif
