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
  sbr_double3 origin;                    /* world place of the character's origin, for asking the ground */
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

/* Bytes of state a rig needs (a multiple of 16). Works for an asset without a gait too: such a character is
 * moved as a whole. */
size_t sbri_gait_state_size(const sbri_rig *rig);

/* Standing at `position` (relative to the origin; y counts from the ground) with `heading`. */
void sbri_gait_reset(
    const sbri_rig *rig, void *state, const sbri_gait_input *input, sbf_vec3 position, float heading);

/* One control tick: advances the state and writes the pose (bone_count transforms). Returns how many events
 * were written (at most `capacity`). Never allocates. */
uint32_t sbri_gait_tick(const sbri_rig *rig, void *state, const sbri_gait_input *input, sbr_transform *pose,
    sbri_gait_event *events, uint32_t capacity);

/* By how much what is `radius_m` from its middle will be faster at most after a tick, m/s: it is driven
 * elsewhere. */
float sbri_gait_jolt(const sbri_rig *rig, const void *state, const sbri_gait_input *input, float radius_m);

/* A tick of an offscreen character: the body moves as it is driven, at the speed that its feet have reached
 * before, without steps. The second call makes it stand where it is and keeps speed, targets and distance. */
void sbri_gait_travel(const sbri_rig *rig, void *state, const sbri_gait_input *input);
void sbri_gait_arrive(const sbri_rig *rig, void *state, const sbri_gait_input *input);

/* The pose of the present state, without advancing it; if the character was `placed`, lagging parts are
 * reset.
 */
void sbri_gait_pose(
    const sbri_rig *rig, void *state, const sbri_gait_input *input, bool placed, sbr_transform *pose);

/* The origin moved by `shift`: subtract it from every place. */
void sbri_gait_rebase(const sbri_rig *rig, void *state, sbf_vec3 shift);

/* Axis of a squash follower in its bone's frame; and the stretch along it at a fraction of the last tick, 1
 * for other followers. */
sbf_vec3 sbri_squash_axis(const sbf_follower *source);
float sbri_gait_stretch(const sbri_rig *rig, const void *state, uint32_t follower, float fraction);
/* Begins a tick: the present state becomes the previous one. */
void sbri_gait_begin_tick(const sbri_rig *rig, void *state);

/* Legs at a fraction of the last tick: feet that landed or lifted off at its end had not done so before. */
uint32_t sbri_gait_legs(
    const sbri_rig *rig, const void *state, float fraction, sbr_leg_state *legs, uint32_t capacity);
double sbri_gait_distance(const void *state);
/* Height of the ground below it, relative to the origin, m; in the air its height counts from there. */
float sbri_gait_level(const void *state);
/* Where the character is and where it faces, relative to the origin. */
void sbri_gait_get_placement(const void *state, sbf_vec3 *position, float *heading);

#endif
