/* A character's rigid parts in motion: state, and one tick of it.
 *
 * State is plain words in the character's block. Poses are those of the bodies' own frames (rigid_model.h) in
 * asset metres, relative to the character's origin. A body's rotation is kept as its angular momentum, which
 * nothing but torques changes. */
#ifndef SBRI_RIGID_STATE_H
#define SBRI_RIGID_STATE_H

#include "rigid/rigid_system.h"
#include "sbrun/rigid.h"
#include "shapes/contact_reports.h"

typedef struct sbri_rigid_body_state {
  sbr_transform pose;
  sbf_vec3 fine;             /* low-order part of the position, m */
  sbf_vec3 velocity;         /* velocity of the centre of mass, m/s */
  sbf_vec3 angular_momentum; /* angular momentum about it, kg m^2/s */
  uint32_t mode;             /* of sbr_rigid_mode */
  float fraction;            /* fraction of the character's drive at the joint to its parent */
} sbri_rigid_body_state;

typedef struct sbri_rigid_joint_state {
  uint32_t broken;
  uint32_t pressed; /* bits of limit rows that were active in the last step */
  sbf_vec3 force,
      torque; /* joint force and torque on body b about frame b, mean of the last tick, N and N m */
} sbri_rigid_joint_state;

/* Decay of slow motion: maximum speeds over size, 1/s, in the present interval and the previous one. */
typedef struct sbri_rigid_decay_state {
  uint32_t ticks; /* ticks of the present interval */
  float max, before;
} sbri_rigid_decay_state;

/* A fall of a character. */
typedef struct sbri_rigid_fall_state {
  uint32_t posture;                     /* of sbr_posture */
  float posture_s, still_s;             /* time in that posture; time of lying still in it, s */
  float drive_fraction, rest_s, rise_s; /* of sbr_fall_definition */
} sbri_rigid_fall_state;

typedef struct sbri_rigid_drive_state {
  float frequency_hz, damping_ratio, strength, joint_damping_1_s, joint_friction; /* as sbr_rigid_drive */
  uint32_t asleep, idle_ticks;
  sbri_rigid_decay_state decay;
  uint32_t stored_contacts; /* of the last tick */
  uint32_t substeps;        /* of the last tick */
  uint32_t soft_steps;      /* steps per tick last requested by its soft bodies; 0: none */
  uint32_t slow_ticks;      /* ticks with slow motion only */
  float last_step_s;        /* of the last tick; 0: the bodies have just begun to move */
  uint32_t is_free;         /* in the last tick nothing was near or attached */
  uint32_t any_dynamic;     /* some body is not kinematic */
  sbri_rigid_fall_state fall;
} sbri_rigid_drive_state;

/* What a contact keeps from the previous step. */
typedef struct sbri_rigid_contact_history {
  bool is_known;           /* the contact existed in the previous step */
  uint32_t idle_ticks;     /* ticks for which it has not pressed */
  float normal_n;          /* normal force, N; 0: inactive */
  sbf_vec3 friction_n;     /* sliding friction, N */
  sbf_vec3 velocity_error; /* part of the target velocity change that was not reached, m/s: minus the sliding
                              velocity */
} sbri_rigid_contact_history;

/* Geometry, target and effective masses of a contact in a substep. */
typedef struct sbri_rigid_contact_substep {
  sbf_vec3 arm;
  sbf_vec3 target;       /* target velocity change of the contact point */
  float gap;             /* m */
  float bounce_m_s;      /* bounce speed; 0: none */
  float closing_speed;   /* m/s at the beginning of the substep; for events */
  float inverse_mass;    /* inverse effective mass along the normal, body alone, 1/kg */
  float normal_mass;     /* effective mass along the normal, kg */
  float tangential_mass; /* effective mass in tangential directions while it sticks, kg */
} sbri_rigid_contact_substep;

/* Friction of a contact in a substep. */
typedef struct sbri_rigid_contact_friction {
  sbf_vec3 sticking_impulse; /* friction impulse of the previous step, about which sticking yields */
  sbf_vec3 impulse;          /* sliding friction impulse; and perpendicular to it and the normal: */
  sbf_vec3 side_direction;   /* unit vector along which friction changes with the sliding direction */
  float side_mass;           /* friction impulse over sliding speed, kg */
  float bound;               /* bound of the friction impulse, N s */
  float tolerance;           /* tolerance of the friction impulse, N s */
} sbri_rigid_contact_friction;

/* State of a contact during the iterations of a solve. */
typedef struct sbri_rigid_contact_iteration {
  sbf_vec3 previous_change, last_change; /* velocity change by the previous iteration, and by the last */
  bool is_active, slides;
  sbf_vec3 extra_impulse; /* impulse in addition to the iterations, N s */
} sbri_rigid_contact_iteration;

/* Possible contact of a hull point with the ground or a shape within the tick. */
typedef struct sbri_rigid_contact {
  int32_t node;
  uint32_t body;
  sbf_vec3 at; /* contact point in the body's frame */
  sbf_vec3 normal;
  float offset;      /* n . x of the plane at the beginning of the tick */
  sbf_vec3 velocity; /* velocity of the other surface, m/s */
  float friction, restitution;
  uint32_t collider; /* index of the collider; UINT32_MAX: the ground */
  uint32_t surface; /* the same, but each step of stairs has its own value: identifies the contact in the next
                       tick */
  uint32_t external_body;     /* 1-based index of the external body that receives the impulse
                                 (rigid_external_bodies.h); 0: none */
  sbf_vec3 external_body_arm; /* lever arm from the external body's centre of mass, m */
  sbri_rigid_contact_history history;
  sbri_rigid_contact_substep substep;
  sbri_rigid_contact_friction sliding;
  sbri_rigid_contact_iteration iteration;
} sbri_rigid_contact;

/* Part of a contact that is stored for the next tick. */
typedef struct sbri_stored_contact {
  uint32_t body, surface;
  uint32_t found;      /* found again in this tick */
  uint32_t idle_ticks; /* ticks for which it has not pressed */
  sbf_vec3 at, friction_n, normal, velocity_error;
  float normal_n, offset; /* N; of the plane, as normal.x */
} sbri_stored_contact;

struct sbri_rigid_tick;

/* Mass that attached soft bodies add to a body in a step (coupling/ragdoll/attached_bodies.c). */
typedef struct sbri_attached_load {
  bool is_attached;
  double mass[6][6];   /* about the body's centre, in character space */
  float needed_steps;  /* steps per tick without attachment */
  sbr_transform begin; /* state of the body at the beginning of the step: */
  sbf_vec3 velocity, angular_momentum;
} sbri_attached_load;

/* External forces on the bodies. `before_step` is called before each step over a fraction of the tick, with
 * the seconds over which gravity acts in it; it adds impulses to linear and angular velocities
 * (sbri_rigid_mass_factor). `after_step` is called after the step, with its seconds and those over which
 * gravity acted.
 */
typedef struct sbri_rigid_external_forces {
  void (*before_step)(void *user, const struct sbri_rigid_tick *tick, float from, float to, float weight_s);
  void (*after_step)(void *user, const struct sbri_rigid_tick *tick, float step_s, float weight_s);
  void *user;
  const float *squares; /* (body_count) rad^2/s^2, that it makes a body swing by at most */
  const sbri_attached_load *attached_loads; /* (body_count); NULL: nothing is attached */
  uint32_t steps;                           /* minimum steps per tick */
} sbri_rigid_external_forces;

/* Input of a tick of all rigid bodies of a character. */
typedef struct sbri_rigid_tick {
  const sbri_rigid_model *model;
  sbri_rigid_body_state *bodies;  /* (body_count) */
  sbri_rigid_joint_state *joints; /* (joint_count) */
  sbri_rigid_drive_state *drive;
  sbri_stored_contact *kept;    /* (sbri_rigid_contact_capacity(model)) */
  const sbr_transform *targets; /* (body_count) where the animation has each at the end of the tick */
  sbr_transform anchor;
  const sbr_ground *ground;
  const struct sbri_collider_set *colliders; /* shapes/colliders.h; NULL: there are none */
  sbr_double3 origin;                        /* m, world */
  float scale;
  sbf_vec3 gravity;
  float tick_s;
  uint32_t substeps;
  bool coarse; /* solve joints and contacts only as far as sbr_model_options.rigid_coarse allows */
  sbri_contact_reports *touching;      /* (body_count) */
  sbri_rigid_external_forces external; /* all 0: nothing does */
  void *work;                          /* work memory, sbri_rigid_work_size(model) bytes */
} sbri_rigid_tick;

size_t sbri_rigid_work_size(const sbri_rigid_model *model);
/* Maximum number of contacts in a tick. */
uint32_t sbri_rigid_contact_capacity(const sbri_rigid_model *model);

/* Mass factor of a body that joint forces would move too fast even for the maximum number of steps. Its
 * weight stays. */
float sbri_rigid_mass_factor(const sbri_rigid_external_forces *external, uint32_t body, float step_s);

/* Moments of inertia of a rotated body, in space. */
void sbri_rigid_compute_moments(sbf_vec3 own, sbf_quat rotation, float to[3][3]);

/* Torque-free rotation: mean angular velocity over a step at constant angular momentum, and the final
 * orientation. */
sbf_vec3 sbri_torque_free_rotation(
    const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 angular_momentum, float step_s, sbf_quat *to);

/* Angular velocity for an angular momentum. */
sbf_vec3 sbri_angular_velocity_from_momentum(
    const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 angular_momentum);
/* Angular momentum for an angular velocity. */
sbf_vec3 sbri_angular_momentum_from_velocity(
    const sbri_rigid_body *body, sbf_quat rotation, sbf_vec3 velocity);

#endif
