/* A character's rigid parts in motion: state, and one tick of it.
 *
 * State is plain words in the character's block. Poses are those of the bodies' own frames (rigid_model.h) in
 * asset metres, relative to the character's origin. A body's rotation is kept as its angular momentum, which
 * nothing but torques changes. */
#ifndef SBRI_RIGID_STATE_H
#define SBRI_RIGID_STATE_H

#include "collide/touching.h"
#include "rigid/rigid_system.h"
#include "sbrun/rigid.h"

typedef struct sbri_rigid_body_state {
  sbr_transform pose;
  sbf_vec3 fine;     /* what the place has beyond its rounded numbers, m */
  sbf_vec3 velocity; /* of the centre of mass, m/s */
  sbf_vec3 spin;     /* angular momentum about it, kg m^2/s */
  uint32_t mode;     /* of sbr_rigid_mode */
  float share;       /* of the character's drive that its joint to what it hangs on has */
} sbri_rigid_body_state;

typedef struct sbri_rigid_joint_state {
  uint32_t broken;
  uint32_t pressed;       /* bits of the rows that are limits which pushed in the last step */
  sbf_vec3 force, torque; /* on body b about frame b, mean of the last tick, N and N m */
} sbri_rigid_joint_state;

typedef struct sbri_rigid_drive_state {
  float frequency_hz, damping_ratio, strength, joint_damping_1_s, joint_friction; /* as sbr_rigid_drive */
  uint32_t asleep, quiet_ticks;
  uint32_t calm_ticks;         /* of the time over which it is seen whether what moves slowly calms down */
  float calm_max, calm_before; /* 1/s: fastest body over its size in that time, and in the one before */
  uint32_t kept_touches;       /* of the last tick */
  uint32_t substeps;           /* of the last tick */
  uint32_t soft_steps;         /* that its soft bodies last asked for; 0: none has */
  uint32_t slow_ticks;         /* for how many nothing has moved but slowly */
  float last_step_s;           /* of the last tick; 0: the bodies have just begun to move */
  uint32_t flies;              /* in the last tick nothing was near and nothing held it */
  uint32_t any;                /* some body is not kinematic */
  uint32_t posture;            /* of sbr_rigid_posture */
  float posture_s, still_s;    /* for how long, and for how long it has lain still in that */
  float limp_share, rest_s, rise_s; /* of sbr_rigid_fall */
} sbri_rigid_drive_state;

/* A place of a hull that may touch the ground or a shape within the tick. */
typedef struct sbri_ground_touch {
  int32_t node;
  uint32_t body;
  sbf_vec3 at; /* own frame */
  sbf_vec3 normal;
  float offset;      /* of the plane through the ground's place, as normal.x, at the tick's beginning */
  sbf_vec3 velocity; /* m/s, of what the plane stands for */
  float friction, restitution;
  uint32_t collider; /* number of it, or UINT32_MAX: the ground */
  uint32_t surface;  /* likewise, but of the ground's steps another each: what it is known again by */
  uint32_t
      external_body; /* from 1 on: the copy of the host's body that it pushes (rigid_guests.h); 0: none */
  sbf_vec3 external_body_arm; /* m, from that one's centre of mass */
  /* Of the step before, where it is known: */
  bool known;
  uint32_t idle;   /* ticks for which it has not pressed */
  float normal_n;  /* N; 0: it did not press */
  sbf_vec3 drag_n; /* N, of friction where it slid */
  sbf_vec3 left;   /* m/s, of what was wanted then what was not had: backwards, how it slid */
  /* In a substep: */
  sbf_vec3 arm;
  sbf_vec3 target;   /* wanted change of the place's velocity */
  float gap;         /* m */
  float bounce_m_s;  /* to be thrown back with; 0: not */
  float ease;        /* 1 / kg: how its body alone would answer along the normal */
  float stiff, grip; /* inverse give along the normal, and across where it sticks, kg */
  sbf_vec3 hold;     /* impulse of friction in the step before, from which on it gives way where it sticks */
  sbf_vec3 drag;     /* impulse of friction where it slides, and across that and the normal: */
  sbf_vec3 side;     /* unit vector, along which friction turns with the direction of sliding */
  float side_grip;   /* kg: impulse of friction over the speed of sliding */
  float bound;       /* N s, of friction */
  float doubt;       /* N s, that make no difference */
  sbf_vec3 was, moved; /* its change of velocity by the pass before, and by the last */
  bool active, slides;
  sbf_vec3 more; /* N s, given on top of what the passes came to */
} sbri_ground_touch;

/* And what is kept of it to the next tick. */
typedef struct sbri_kept_touch {
  uint32_t body, surface;
  uint32_t found; /* in this tick again */
  uint32_t idle;  /* ticks for which it has not pressed */
  sbf_vec3 at, drag_n, normal, left;
  float normal_n, offset; /* N; of the plane, as normal.x */
} sbri_kept_touch;

struct sbri_rigid_tick;

/* What flesh adds to the masses and moments of a body that bears it through a step: ragdoll/borne_flesh.c. */
typedef struct sbri_rigid_burden {
  bool on;
  double mass[6][6];   /* about the body's centre, in space */
  float needed_steps;  /* of a tick, if it were not borne */
  sbr_transform begin; /* of the body, when the step begins: */
  sbf_vec3 velocity, spin;
} sbri_rigid_burden;

/* What else acts on the bodies: called before each step over that share of the tick, with the seconds for
 * which weight will change velocities in it, `act` adds impulses to their velocities and spins
 * (sbri_rigid_swell); `acted` is called after it, with its seconds, and those for which weight has. */
typedef struct sbri_rigid_pull {
  void (*act)(void *user, const struct sbri_rigid_tick *tick, float from, float to, float weight_s);
  void (*acted)(void *user, const struct sbri_rigid_tick *tick, float step_s, float weight_s);
  void *user;
  const float *squares;             /* (body_count) rad^2/s^2, that it makes a body swing by at most */
  const sbri_rigid_burden *burdens; /* (body_count); NULL: nobody bears anything */
  uint32_t steps;                   /* of a tick, at least */
} sbri_rigid_pull;

/* A tick of all rigid parts of a character. */
typedef struct sbri_rigid_tick {
  const sbri_rigid_model *model;
  sbri_rigid_body_state *bodies;  /* (body_count) */
  sbri_rigid_joint_state *joints; /* (joint_count) */
  sbri_rigid_drive_state *drive;
  sbri_kept_touch *kept;        /* (sbri_rigid_touch_capacity(model)) */
  const sbr_transform *targets; /* (body_count) where the animation has each at the end of the tick */
  sbr_transform anchor;
  const sbr_ground *ground;
  const struct sbri_collider_set *colliders; /* collide/colliders.h; NULL: there are none */
  sbr_double3 origin;                        /* m, world */
  float scale;
  sbf_vec3 gravity;
  float tick_s;
  uint32_t substeps;
  bool coarse;             /* joints and touches are left as sbr_model_options.rigid_coarse has it */
  sbri_touching *touching; /* (body_count) */
  sbri_rigid_pull pull;    /* all 0: nothing does */
  void *work;              /* sbri_rigid_work_size(model) bytes, of which nothing need be known */
} sbri_rigid_tick;

size_t sbri_rigid_work_size(const sbri_rigid_model *model);
/* Of touches, the most that it looks at in a tick. */
uint32_t sbri_rigid_touch_capacity(const sbri_rigid_model *model);

/* A body that what pulls on it would swing too fast for the most steps that there are is as if that much
 * heavier, to all but weight. */
float sbri_rigid_swell(const sbri_rigid_pull *pull, uint32_t body, float step_s);

/* Principal moments of a body that is turned so, in space. */
void sbri_rigid_moments(sbf_vec3 own, sbf_quat turn, float to[3][3]);

/* Mean angular velocity over a step of what keeps its angular momentum, and where it turns to. */
sbf_vec3 sbri_free_turn(
    const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 spin, float step_s, sbf_quat *to);

/* Angular velocity now. */
sbf_vec3 sbri_spin_velocity(const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 spin);
/* And the angular momentum of that angular velocity. */
sbf_vec3 sbri_spin_from(const sbri_rigid_body *body, sbf_quat turn, sbf_vec3 velocity);

#endif
