/* The animation layer of one character: from a wanted motion to a pose, once a control tick.
 *
 * Its state is plain data in one block whose size depends only on the rig, so that a snapshot is a copy. All
 * of it is relative to the character's origin and moves with sbri_gait_rebase. */
#ifndef SBRI_GAIT_H
#define SBRI_GAIT_H

#include "animation/gait/surroundings.h"

typedef struct sbri_gait_input {
  float forward, sideways, turn, up; /* m/s, m/s, rad/s, m/s */
  sbf_vec3 displacement;             /* by the host, in this tick, m */
  float rotation;                    /* the same, rad */
  float tick_s;
  float scale;
  bool keeps_rest_pose;                  /* rest pose, moved rigidly */
  sbr_double3 origin;                    /* world position of the character's origin, for ground queries */
  const sbr_ground *ground;              /* with the colliders near it */
  const sbri_surroundings *surroundings; /* NULL: no colliders */
  float gravity;                         /* m/s^2, downwards */
} sbri_gait_input;

typedef enum sbri_gait_event_kind {
  SBRI_GAIT_FOOT_DOWN,
  SBRI_GAIT_FOOT_UP,
  SBRI_GAIT_LANDED
} sbri_gait_event_kind;

typedef struct sbri_gait_event {
  sbri_gait_event_kind kind;
  uint32_t leg;
  sbf_vec3 position;
} sbri_gait_event;

/* Size of a rig's state in bytes, a multiple of 16. An asset without a gait has state too: its character
 * moves as a whole. */
size_t sbri_gait_state_size(const sbri_rig *rig);

/* Makes the character stand at `position` (relative to the origin, y above the ground) with `heading`. */
void sbri_gait_reset(
    const sbri_rig *rig, void *state, const sbri_gait_input *input, sbf_vec3 position, float heading);

/* One control tick: advances the state and writes the pose (bone_count transforms). Returns the number of
 * events written, at most `capacity`. Never allocates. */
uint32_t sbri_gait_tick(const sbri_rig *rig, void *state, const sbri_gait_input *input, sbr_transform *pose,
    sbri_gait_event *events, uint32_t capacity);

/* Maximum change of speed in the next tick, m/s, of a point at `radius_m` from the body's middle, caused by
 * the command. */
float sbri_gait_max_speed_change(
    const sbri_rig *rig, const void *state, const sbri_gait_input *input, float radius_m);

/* A tick of an offscreen character: moves the body by the command, at the last speed that the feet allowed,
 * without steps. */
void sbri_gait_travel(const sbri_rig *rig, void *state, const sbri_gait_input *input);
/* Ends offscreen travel: places the feet on the ground at its position. Speed, targets and distance stay. */
void sbri_gait_arrive(const sbri_rig *rig, void *state, const sbri_gait_input *input);

/* Computes the pose of the present state without advancing it. If the character was `placed`, resets lagging
 * parts. */
void sbri_gait_pose(
    const sbri_rig *rig, void *state, const sbri_gait_input *input, bool placed, sbr_transform *pose);

/* Moves the origin by `shift`: subtracts it from all positions. */
void sbri_gait_rebase(const sbri_rig *rig, void *state, sbf_vec3 shift);

/* Axis of a squash follower in its bone's frame. */
sbf_vec3 sbri_squash_axis(const sbf_follower *source);
/* Stretch along that axis at a fraction of the last tick; 1 for other followers. */
float sbri_gait_stretch(const sbri_rig *rig, const void *state, uint32_t follower, float fraction);
/* Begins a tick: the present state becomes the previous one. */
void sbri_gait_begin_tick(const sbri_rig *rig, void *state);

/* Writes the legs at a fraction of the last tick. Feet land and lift off at the end of a tick. Returns the
 * number of legs. */
uint32_t sbri_gait_legs(
    const sbri_rig *rig, const void *state, float fraction, sbr_leg_state *legs, uint32_t capacity);
/* Distance travelled, m. */
double sbri_gait_distance(const void *state);
/* Height of the ground below the character, relative to the origin, m. */
float sbri_gait_level(const void *state);
/* Position relative to the origin, and heading, rad. */
void sbri_gait_get_placement(const void *state, sbf_vec3 *position, float *heading);

#endif
