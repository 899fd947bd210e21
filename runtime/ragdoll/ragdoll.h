/* Rigid bodies of one character through a tick: where its bones have them, what moves them, and the bones
 * that move with them. */
#ifndef SBRI_RAGDOLL_H
#define SBRI_RAGDOLL_H

#include "rigid/rigid_work.h"
#include "world/world.h"

/* ---- ragdoll/rigid_bones.c ---- */

/* Where a pose has a body's own frame, asset metres. */
sbr_transform sbri_rigid_target(const sbri_character *c, const sbr_transform *pose, uint32_t body);
/* The pose with the bones where simulated bodies have them after they have gone on for `ahead_s`, each by its
 * share of `gain` faster (m/s, that weight gives it), and all else at that share of the way from the tick's
 * beginning to `animated`. Bones below them that have no body keep what the animation has them turned and
 * away from their parents. */
void sbri_rigid_pose(const sbri_character *c, const sbr_transform *animated, float share, float ahead_s,
    sbf_vec3 gain, sbr_transform *pose);
/* Where a body goes with the velocities that it has, and its share of that gain. */
sbr_transform sbri_rigid_ahead(const sbri_character *c, uint32_t body, float seconds, sbf_vec3 gain);
/* Puts the frames that bodies have for their own where the pose has these. */
void sbri_rigid_frames_follow(const sbri_character *c, sbr_transform *pose);
bool sbri_rigid_is_simulated(const sbri_character *c, uint32_t body);
/* Soft bodies that pull on simulated rigid bodies: they are stepped along with these, in the character's own
 * task, not in one of their own. */
bool sbri_island_is_coupled(const sbri_character *c, uint32_t island);
void sbri_rigid_set_drive(sbri_character *c, const sbr_rigid_drive *drive);
/* Gives a simulated body an impulse at a place; both in the character's own units. */
void sbri_rigid_push(sbri_character *c, uint32_t rigid_body, sbf_vec3 at, sbf_vec3 impulse);
/* After any change to modes, drives or motion. */
void sbri_rigid_wake(sbri_character *c);
/* Whether nothing of it moves by itself. */
bool sbri_rigid_is_still(const sbri_character *c);
/* There, and at rest. */
void sbri_rigid_put_at(sbri_rigid_body_state *body, sbr_transform place);

/* ---- ragdoll/reflex.c ---- */

void sbri_reflex_begin(sbri_character *c, const sbr_rigid_fall *fall);
/* The animation has its bodies again. */
void sbri_reflex_end(sbri_character *c);
/* Before a tick of the gait; true where it fell and now begins to get up. */
bool sbri_reflex_tick(const struct sbr_world *world, sbri_character *c);
/* Before a step of the rigid parts. */
void sbri_reflex_act(const sbri_character *c, const sbri_rigid_tick *tick, float step_s);

/* ---- ragdoll/rigid_place.c ---- */

/* Every rigid body at its bone, joints whole; modes and drives as they are, or as the file has them. */
void sbri_rigid_place(sbri_character *c, bool as_in_file);
/* As they were on another rung, of one model. */
void sbri_rigid_take(sbri_character *c, const sbri_character *was);
/* Rigid bodies go where the pose has gone from what their bones were at, and stop. */
void sbri_rigid_carry(sbri_character *c);
/* The origin moved by `shift`, in asset metres. */
void sbri_rigid_rebase(sbri_character *c, sbf_vec3 shift);

/* ---- ragdoll/coupled.c ---- */

typedef struct sbri_coupled {
  const sbr_world *world;
  sbri_character *character;
  const sbr_transform *animated; /* (frame_count) the pose at the tick's end but for what bodies move */
  bool any;                      /* soft body is coupled; set by sbri_coupled_begin, as: */
  bool touches;                  /* one may touch something within the tick */
  bool falls;                    /* in this step weight acts on flesh as it does on the bones, for: */
  float weight_s;
  uint32_t steps; /* of a whole tick, that the soft bodies ask for as they are now */
} sbri_coupled;

/* A tick of them: what comes before it, before and after each step of the rigid parts (rigid_state.h), and
 * after it. */
void sbri_coupled_begin(sbri_coupled *group);
void sbri_coupled_act(sbri_coupled *group, const sbri_rigid_tick *tick, float from, float to, float weight_s);
void sbri_coupled_acted(const sbri_coupled *group, const sbri_rigid_tick *tick, float step_s, float weight_s);
void sbri_coupled_end(sbri_coupled *group);

/* Whether all of them may go on sleeping, whether all are slow enough to begin to, and their beginning to. */
bool sbri_coupled_sleep(sbri_coupled *group);
bool sbri_coupled_are_quiet(const sbri_character *c);
void sbri_coupled_put_to_sleep(const sbr_world *world, sbri_character *c);

/* ---- ragdoll/put_back.c ---- */

/* A soft body that has just been put back into its rest shape goes as its bones do, and both take up what it
 * had of momentum. */
struct sbri_whole_momentum;
void sbri_flesh_goes_on(sbri_character *c, uint32_t island, const struct sbri_whole_momentum *had);

/* ---- ragdoll/coupled_steps.c ---- */

/* What a tick that begins asks for in `steps`: of an island, after which of all bones; and what flesh that no
 * bone bears asks for after a step of it. */
void sbri_coupled_need(sbri_coupled *group, const sbri_island_tick *tick);
void sbri_coupled_need_of_bones(sbri_coupled *group);
void sbri_coupled_need_now(sbri_coupled *group, const sbri_island_tick *tick);
/* Steps for the rest of a tick, that share of it, which was to take `left`. */
uint32_t sbri_coupled_steps_left(const sbri_coupled *group, float rest, uint32_t left);

/* ---- ragdoll/borne_flesh.c ---- */

/* Whether a body is simulated and may bear its flesh; and how many steps a tick that begins now takes then.
 */
bool sbri_may_bear(const sbri_character *c, uint32_t body);
float sbri_bearing_steps(const sbri_character *c, uint32_t body, float tick_s);
/* Before a step of so long: finds out who bears its flesh in it, by `needed_steps`, and what that adds. */
void sbri_burdens_begin(sbri_character *c, const sbri_rigid_tick *tick, float step_s);
/* What the flesh pulled with, on who bears it. */
void sbri_burden_push(const sbri_rigid_tick *tick, uint32_t body, const sbri_reaction *by);
/* After the step: the flesh takes its share of how its bones' speeds have changed. */
void sbri_burdens_end(sbri_character *c, const sbri_rigid_tick *tick, float step_s, float weight_s);

/* ---- ragdoll/rigid_parts.c ---- */

/* A tick of a character's rigid parts on its way, with the soft bodies that are coupled to them. It stays
 * where it is until its end. */
typedef struct sbri_rigid_parts {
  sbri_coupled coupled;
  sbri_rigid_tick tick;
  sbri_rigid_solving work;
  bool steps; /* it has begun, and must be ended */
} sbri_rigid_parts;

/* What comes before the steps, whose number is tick.substeps, and after them; false where nothing is to be
 * stepped. The pose has all bones where they go when this is over. */
bool sbri_rigid_parts_begin(const sbr_world *world, sbri_character *c, sbri_rigid_parts *parts);
void sbri_rigid_parts_end(sbri_rigid_parts *parts);
/* After the gait: steps what is simulated and puts the pose's bones where it has gone. */
void sbri_rigid_tick_parts(const struct sbr_world *world, sbri_character *c);

#endif
