/* Rigid bodies of characters and the joints between them.
 *
 * Each rigid body of the asset is kinematic (it follows the animation), passive (gravity and joints move it,
 * as in a ragdoll) or driven (its joint pulls it towards the animated pose with a limited torque). The mode
 * is state and may differ from body to body. The bone of a simulated body follows the body; child bones
 * without a body keep their animated pose relative to it.
 *
 * All ten kinds of joints, hard and soft limits, drives, pulleys and loops work as in spec/sbf.md, 8.3.
 * docs/rigid.md has the equations and measurements.
 *
 * Rules are those of sbrun.h: setters ignore invalid handles, getters then return zeros. No call here
 * allocates. The first tick in which a character has simulated bodies allocates working memory, which is
 * freed a second after all are kinematic again. Everything set here is state, stored in snapshots. Lengths
 * are world metres; masses and torques are those of the asset times the character's scale
 * (sbr_character_definition.scale). */
#ifndef SBRUN_RIGID_H
#define SBRUN_RIGID_H

#include "sbrun/sbrun.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How a rigid body moves. */
typedef enum sbr_rigid_mode {
  SBR_RIGID_KINEMATIC, /* follows its bone; without one, the root frame */
  SBR_RIGID_PASSIVE,   /* moved by weight, joints, contacts and impulses */
  SBR_RIGID_DRIVEN     /* passive, and its joint's drive acts towards the animated pose */
} sbr_rigid_mode;

/* Drive of the joints of driven bodies towards the animated pose. */
typedef struct sbr_rigid_drive {
  uint32_t cookie;     /* set by sbr_default_rigid_drive; without it the call does nothing */
  float frequency_hz;  /* (0, 100]: natural frequency of a joint with its load; default 4 */
  float damping_ratio; /* [0, 10]: damping ratio of that; default 1, without overshoot */
  /* Torque limit of a joint, in multiples of the torque that supports its load horizontally in the
   * earth's gravity; 0: no limit. Default 2: it keeps any pose and yields to an impulse. */
  float strength;
  /* [0, 100] 1/s: decay rate of relative rotation in joints between bones, driven or not; default 2. */
  float joint_damping_1_s;
  /* [0, 1]: dry friction of such joints, as a fraction of the torque that supports the load horizontally in
   * the earth's gravity; default 0.04. A swinging limb comes to rest within 2.3 degrees of where it would
   * hang.
   */
  float joint_friction;
} sbr_rigid_drive;

/* Sets the mode of one rigid body, or of all if `rigid_body` is negative. The file states the initial mode:
 * kinematic, or passive if its motion is dynamic. A body without mass stays kinematic. A body that becomes
 * simulated keeps the velocity of the animation. */
SBF_API void sbr_character_set_rigid_mode(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, sbr_rigid_mode mode);
/* Sets the drive of all driven bodies of the character, and the fraction of it, 0 to 1, for the joint of one
 * body (default 1; all bodies if `rigid_body` is negative). One arm may hang while the rest walks. */
SBF_API sbr_rigid_drive sbr_default_rigid_drive(void);
SBF_API void sbr_character_set_rigid_drive(
    sbr_world *world, sbr_character_id character, const sbr_rigid_drive *drive);
SBF_API void sbr_character_set_rigid_drive_fraction(
    sbr_world *world, sbr_character_id character, int32_t rigid_body, float fraction);

/* ---- Falling over ---- */

/* Settings of falling and getting up. */
typedef struct sbr_fall_definition {
  uint32_t cookie;      /* set by sbr_default_fall_definition; without it the call does nothing */
  float drive_fraction; /* [0, 1], of its drive while it falls; default 0.1 */
  float rest_s; /* s at rest before it gets up; default 0.5; in the character's own time, as `rise_s` */
  float rise_s; /* s, duration of getting up; default 1.5, at least 0.1 */
} sbr_fall_definition;

/* Phase of a fall. */
typedef enum sbr_posture {
  SBR_POSTURE_UPRIGHT, /* no fall: its bodies' modes apply */
  SBR_POSTURE_FALLING, /* falls or lies */
  SBR_POSTURE_RISING   /* gets up */
} sbr_posture;

/* Knocks the character over. All bodies that the file does not make dynamic are driven with a fraction of the
 * drive's strength until they are at rest (or for 5 s plus rest_s). Then the strength grows, and a force on
 * each body helps it up to the pose of its gait or clip; walking waits. When it stands its bodies are
 * kinematic again. A reset or teleport ends the fall. Apply the hit with sbr_character_apply_rigid_impulse
 * after this call. */
SBF_API sbr_fall_definition sbr_default_fall_definition(void);
SBF_API void sbr_character_knock_over(
    sbr_world *world, sbr_character_id character, const sbr_fall_definition *fall);
SBF_API sbr_posture sbr_character_get_posture(const sbr_world *world, sbr_character_id character);

/* ---- Handles and user data ---- */

/* Whether the character is valid and its asset has a rigid body or a joint of this index. */
SBF_API bool sbr_character_has_rigid_body(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body);
SBF_API bool sbr_character_has_joint(const sbr_world *world, sbr_character_id character, uint32_t joint);
/* The host's pointer for a rigid body, at first NULL; the runtime does not use it. */
SBF_API void sbr_character_set_rigid_user_data(
    sbr_world *world, sbr_character_id character, uint32_t rigid_body, void *user_data);
SBF_API void *sbr_character_get_rigid_user_data(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body);

/* ---- State ---- */

/* A rigid body as of the last tick. */
typedef struct sbr_rigid_state {
  sbr_rigid_mode mode;          /* kinematic, passive or driven */
  sbr_transform frame;          /* of the body (spec 8.2), position relative to the character's origin, m */
  sbf_vec3 center;              /* centre of mass relative to the character's origin, m */
  sbf_vec3 velocity;            /* of the centre of mass, m/s */
  sbf_vec3 angular_velocity;    /* rad/s, world axes */
  float mass;                   /* kg */
  float kinetic_j, potential_j; /* potential energy of weight is 0 at world y = 0 */
} sbr_rigid_state;
SBF_API sbr_rigid_state sbr_character_get_rigid_state(
    const sbr_world *world, sbr_character_id character, uint32_t rigid_body);

/* Applies an impulse in N s to a simulated body at a world position, with the next tick. */
SBF_API void sbr_character_apply_rigid_impulse(sbr_world *world, sbr_character_id character,
    uint32_t rigid_body, sbr_double3 position, sbf_vec3 impulse);

/* A joint as of the last tick. */
typedef struct sbr_joint_state {
  float coordinates[8];   /* by sbf_joint_axis: linear_x, _y, _z in m, twist, swing_y, swing_z, swing in rad,
                             distance in m (of a pulley its rope) */
  float separation;       /* m: maximum position error of the joint */
  float angular_error;    /* rad: maximum angular error of the joint */
  float angle_violation;  /* rad: maximum violation of a hard angular limit */
  float length_violation; /* m: maximum violation of a hard linear limit */
  sbf_vec3 force, torque; /* N and N m on body b at its frame, mean of the tick */
  bool broken;            /* overloaded: it does not act until the character is reset */
} sbr_joint_state;
SBF_API sbr_joint_state sbr_character_get_joint_state(
    const sbr_world *world, sbr_character_id character, uint32_t joint);

#ifdef __cplusplus
}
#endif
#endif
