/* Rigid bodies of one character: targets from the pose, motion, and bones that follow simulated bodies. */
#ifndef SBRI_RAGDOLL_H
#define SBRI_RAGDOLL_H

#include "rigid/rigid_work.h"
#include "state/world.h"

/* ---- coupling/ragdoll/rigid_bones.c ---- */

/* Frame of a body for a pose, asset metres. */
sbr_transform sbri_rigid_target(const sbri_character *c, const sbr_transform *pose, uint32_t body);
/* The pose in which bones with simulated bodies are where these will be after `ahead_s`, with their fraction
 * of `velocity_change` (m/s, from gravity) added; all other bones are at that fraction between the tick's
 * beginning and `animated`. Child bones without a body keep their animated pose relative to the parent. */
void sbri_rigid_pose(const sbri_character *c, const sbr_transform *animated, float fraction, float ahead_s,
    sbf_vec3 velocity_change, sbr_transform *pose);
/* Predicted frame of a body from its velocities and its part of the velocity change. */
sbr_transform sbri_rigid_ahead(
    const sbri_character *c, uint32_t body, float seconds, sbf_vec3 velocity_change);
/* Moves frames that belong to bodies alone to the pose. */
void sbri_rigid_frames_follow(const sbri_character *c, sbr_transform *pose);
bool sbri_rigid_is_simulated(const sbri_character *c, uint32_t body);
/* Whether an island is coupled to simulated rigid bodies. It is then stepped with them, in the character's
 * task. */
bool sbri_island_is_coupled(const sbri_character *c, uint32_t island);
/* Of sbr_rigid_drive. */
enum { SBRI_RIGID_DRIVE_COOKIE = 0x5b726472 };
void sbri_rigid_set_drive(sbri_character *c, const sbr_rigid_drive *drive);
/* Applies an impulse at a point to a simulated body; both in the character's own units. */
void sbri_rigid_apply_impulse(sbri_character *c, uint32_t rigid_body, sbf_vec3 at, sbf_vec3 impulse);
/* Wakes the rigid bodies. Call after any change to modes, drives or motion. */
void sbri_rigid_wake(sbri_character *c);
/* Whether no rigid body moves by itself. */
bool sbri_rigid_is_still(const sbri_character *c);
/* Sets a body's frame and zero velocity. */
void sbri_rigid_set_frame(sbri_rigid_body_state *body, sbr_transform transform);

/* ---- coupling/ragdoll/reflex.c ---- */

void sbri_reflex_begin(sbri_character *c, const sbr_fall_definition *fall);
/* Returns all bodies to the animation. */
void sbri_reflex_end(sbri_character *c);
/* Call before the gait's tick. Returns true if the character had fallen and now begins to get up. */
bool sbri_reflex_tick(const struct sbr_world *world, sbri_character *c);
/* Applies reflexes before a step of the rigid bodies. */
void sbri_reflex_act(const sbri_character *c, const sbri_rigid_tick *tick, float step_s);

/* ---- coupling/ragdoll/rigid_reset.c ---- */

/* Resets every rigid body to its bone and restores joints; keeps modes and drives, or takes them from the
 * file. */
void sbri_rigid_reset(sbri_character *c, bool as_in_file);
/* Copies the state of rigid bodies from another detail level of the model. */
void sbri_rigid_copy_state(sbri_character *c, const sbri_character *was);
/* Moves rigid bodies with the pose and sets their velocities to zero. */
void sbri_rigid_move_with_pose(sbri_character *c);
/* Adapts positions to a shift of the origin, asset metres. */
void sbri_rigid_rebase(sbri_character *c, sbf_vec3 shift);

/* ---- coupling/ragdoll/coupled.c ---- */

typedef struct sbri_coupled {
  const sbr_world *world;
  sbri_character *character;
  const sbr_transform *animated; /* (frame_count) the pose at the tick's end but for what bodies move */
  bool any;                      /* soft body is coupled; set by sbri_coupled_begin, as: */
  bool is_touching;              /* one may touch something within the tick */
  bool falls; /* time for which gravity acts on soft bodies in this step, as on the bones: */
  float weight_s;
  uint32_t steps; /* of a whole tick, that the soft bodies ask for as they are now */
} sbri_coupled;

/* A tick of them: what comes before it, before and after each step of the rigid parts (rigid_state.h), and
 * after it. */
void sbri_coupled_begin(sbri_coupled *group);
void sbri_coupled_before_step(
    sbri_coupled *group, const sbri_rigid_tick *tick, float from, float to, float weight_s);
void sbri_coupled_after_step(
    const sbri_coupled *group, const sbri_rigid_tick *tick, float step_s, float weight_s);
void sbri_coupled_end(sbri_coupled *group);

/* Whether all bodies may stay asleep; whether all are slow enough to fall asleep; puts them to sleep. */
bool sbri_coupled_sleep(sbri_coupled *group);
bool sbri_coupled_are_idle(const sbri_character *c);
void sbri_coupled_put_to_sleep(const sbr_world *world, sbri_character *c);

/* ---- coupling/ragdoll/attached_reset.c ---- */

/* After a reset of an attached soft body: it moves with its bones, and both share its former momentum. */
struct sbri_whole_momentum;
void sbri_attached_body_set_momentum(
    sbri_character *c, uint32_t island, const struct sbri_whole_momentum *had);

/* ---- coupling/ragdoll/coupled_steps.c ---- */

/* Numbers of steps, into `steps`: of an island at the beginning of a tick; then of all bones; and of
 * explicitly coupled bodies after a step. */
void sbri_coupled_request_steps(sbri_coupled *group, const sbri_island_tick *tick);
void sbri_coupled_request_steps_of_bones(sbri_coupled *group);
void sbri_coupled_request_steps_now(sbri_coupled *group, const sbri_island_tick *tick);
/* Number of steps for the remaining fraction of a tick that was planned with `left` steps. */
uint32_t sbri_coupled_steps_left(const sbri_coupled *group, float rest, uint32_t left);

/* ---- coupling/ragdoll/attached_bodies.c ---- */

/* Whether a body is simulated and its soft bodies can be attached in long steps; and the number of steps of
 * such a tick. */
bool sbri_can_attach(const sbri_character *c, uint32_t body);
float sbri_bearing_steps(const sbri_character *c, uint32_t body, float tick_s);
/* Before a step: selects the bodies whose attached masses are included, by `needed_steps`, and computes these
 * masses. */
void sbri_attached_loads_begin(sbri_character *c, const sbri_rigid_tick *tick, float step_s);
/* Adds the impulse of attached soft bodies to their body. */
void sbri_attached_load_apply_impulse(const sbri_rigid_tick *tick, uint32_t body, const sbri_reaction *by);
/* After the step: moves attached points by the velocity changes of their bones. */
void sbri_attached_loads_end(sbri_character *c, const sbri_rigid_tick *tick, float step_s, float weight_s);

/* ---- coupling/ragdoll/rigid_parts.c ---- */

/* State of a tick of a character's rigid bodies with their coupled soft bodies. Must not move in memory until
 * it ends. */
typedef struct sbri_rigid_parts {
  sbri_coupled coupled;
  sbri_rigid_tick tick;
  sbri_rigid_solving work;
  bool steps; /* the tick has begun and must be ended */
} sbri_rigid_parts;

/* Begins and ends the tick; the number of steps is tick.substeps. Begin returns false if there is nothing to
 * step. At the end the pose contains all bones. */
bool sbri_rigid_parts_begin(const sbr_world *world, sbri_character *c, sbri_rigid_parts *parts);
void sbri_rigid_parts_end(sbri_rigid_parts *parts);
/* After the gait: steps simulated bodies and moves the pose's bones with them. */
void sbri_rigid_tick_parts(const struct sbr_world *world, sbri_character *c);

#endif
