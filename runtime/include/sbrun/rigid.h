/* Rigid parts: bones that weigh something, and the joints between them.
 *
 * Every rigid body of the asset either follows the animation (kinematic), falls and swings by weight and
 * joints alone (passive: a ragdoll), or is drawn towards the animated pose by its joints with a finite
 * strength (driven). That is state, and may differ from body to body. A bone that a simulated body moves with
 * goes where the body goes; bones below it that no body moves keep their animated pose against it.
 *
 * Joints hold as the specification says (spec/sbf.md, 8.3): all ten kinds, limits hard or by springs, drives,
 * pulleys, loops. docs/rigid.md has the equations, and what was measured.
 *
 * The same rules as in sbrun.h: handles that name nothing are ignored, getters then return zeros; no call
 * here allocates. The first tick in which a character has simulated bodies does, for what they are solved in,
 * and a second after the last of them is kinematic again that is given back. Everything set here is state,
 * which snapshots hold. Lengths are world metres, masses and torques those of the asset times the character's
 * scale (sbr_character_definition.scale). */
#ifndef SBRUN_RIGID_H
#define SBRUN_RIGID_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What moves a rigid body. */
typedef enum sbr_rigid_mode {
  SBR_RIGID_KINEMATIC, /* its bone; without one, the root frame */
  SBR_RIGID_PASSIVE,   /* weight, joints, ground, pushes */
  SBR_RIGID_DRIVEN     /* these, and its joint's pull towards the animated pose */
} sbr_rigid_mode;

/* How driven bodies are drawn towards the animated pose. */
typedef struct sbr_rigid_drive {
  float frequency_hz;  /* (0, 100]: of a joint's swing about the pose with what hangs on it; default 4 */
  float damping_ratio; /* [0, 10]: of that swing; default 1, which does not overshoot */
  /* Greatest torque of a joint, in multiples of what holds that which hangs on it out level against the
   * earth's gravity; 0: no bound. Default 2: it holds any pose and gives way to a push. */
  float strength;
  /* [0, 100] 1/s: at which joints between bones, driven or not, lose what their bodies turn against each
   * other, as flesh about them does; default 2. */
  float joint_damping_1_s;
  /* [0, 1]: dry friction of such joints, the torque that it can hold or brake with, as a share of the one
   * that holds what hangs on the joint out level against the earth's gravity; default 0.04. So what swings
   * comes to rest, up to 2.3 degrees off where it would hang. */
  float joint_friction;
} sbr_rigid_drive;

/* Sets the mode of one rigid body, or of all where `rigid_body` is negative. A body begins as the file has
 * it: kinematic, or passive where its motion is dynamic. One without mass stays kinematic. A body that is let
 * go keeps the speed that the animation gave it. */
SBF_API void sbr_character_rigid_mode(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, sbr_rigid_mode mode);
/* The drive of all driven bodies of the character; and the share of it, 0 to 1, that one body's joint has
 * (default 1; of all bodies where `rigid_body` is negative): so one arm may hang while the rest walks. */
SBF_API sbr_rigid_drive sbr_default_rigid_drive(void);
SBF_API void sbr_character_rigid_drive(
    sbr_world *world, sbr_character_id character, const sbr_rigid_drive *drive);
SBF_API void sbr_character_rigid_share(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, float share);

/* ---- Falling over ---- */

/* How a character goes down and gets up. */
typedef struct sbr_rigid_fall {
  float share;  /* [0, 1] of its drive that it has while it falls; default 0.1 */
  float rest_s; /* s that it lies still before it gets up; default 0.5; of its own, as all here are */
  float rise_s; /* s in which it gets up; default 1.5, at least 0.1 */
} sbr_rigid_fall;

/* What a character is at. */
typedef enum sbr_rigid_posture {
  SBR_RIGID_UP,      /* what its bodies' modes say */
  SBR_RIGID_FALLING, /* it goes down, or lies */
  SBR_RIGID_RISING   /* it gets up */
} sbr_rigid_posture;

/* Knocks the character over: all bodies that the file does not make dynamic are driven with a share of the
 * drive's strength until they lie still (or for 5 s and rest_s), then, where it lies, with more and more of
 * it and helped up by a pull on each body, towards the pose of its gait or clip; what it is wanted to walk
 * waits. Up, its bodies are kinematic, and it walks on. It stops falling where it is reset or teleported.
 * Give the hit itself with sbr_character_rigid_push, after this. */
SBF_API sbr_rigid_fall sbr_default_rigid_fall(void);
SBF_API void sbr_character_rigid_fall(
    sbr_world *world, sbr_character_id character, const sbr_rigid_fall *fall);
SBF_API sbr_rigid_posture sbr_character_rigid_posture(const sbr_world *world, sbr_character_id character);

/* ---- What it is like ---- */

/* A rigid body as of the last tick. */
typedef struct sbr_rigid_state {
  sbr_rigid_mode mode;          /* what moves it */
  sbr_transform frame;          /* of the body (spec 8.2), position relative to the character's origin, m */
  sbf_vec3 center;              /* of mass, likewise */
  sbf_vec3 velocity;            /* of the centre of mass, m/s */
  sbf_vec3 angular_velocity;    /* rad/s, world axes */
  float mass;                   /* kg */
  float kinetic_j, potential_j; /* potential is that of weight, 0 at the height of world y = 0 */
} sbr_rigid_state;
SBF_API sbr_rigid_state sbr_character_rigid_state(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body);

/* Gives a simulated body an impulse in N s at a place (world): its motion changes with the next tick. */
SBF_API void sbr_character_rigid_push(
    sbr_world *world, sbr_character_id character, uint32_t rigid_body, sbr_double3 place, sbf_vec3 impulse);

/* A joint as of the last tick. */
typedef struct sbr_joint_state {
  float coordinates[8]; /* by sbf_joint_axis: linear_x, _y, _z in m, twist, swing_y, swing_z, swing in rad,
                           distance in m (of a pulley its rope) */
  float apart;          /* m: by how much the joint is off what it holds in place, in the worst coordinate */
  float bent;           /* rad: likewise of what it holds in angle */
  float beyond_angle;   /* rad: by how much the worst of its hard limits of angles is broken */
  float beyond_length;  /* m: likewise of lengths */
  sbf_vec3 force, torque; /* N and N m on body b at its frame, mean of the tick */
  bool broken;            /* by more than it bears: it holds nothing until the character is reset */
} sbr_joint_state;
SBF_API sbr_joint_state sbr_character_joint_state(
    const sbr_world *world, sbr_character_id character, uint32_t joint);

#ifdef __cplusplus
}
#endif
#endif
