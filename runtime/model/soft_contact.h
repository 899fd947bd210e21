/* Possible contacts of soft bodies within a tick: singly for detection and reports, and in blocks of eight
 * for the solver. */
#ifndef SBRI_SOFT_CONTACT_H
#define SBRI_SOFT_CONTACT_H

#include "model/runtime_model.h"

#define SBRI_NO_COLLIDER UINT32_MAX
#define SBRI_ITSELF (UINT32_MAX - 1)

/* Contact pressure in recent substeps of the tick (contact/contact.h): the sum of normal velocity changes and
 * of the substeps. time_s < 0: there was an impact in this tick. */
typedef struct sbri_pressing {
  float velocity_change, time_s; /* m/s, s */
  float deficit;                 /* sum of velocity changes beyond the bounds of friction, m/s */
} sbri_pressing;

/* A possible contact of a surface sample within the tick: the plane that it must not pass. A sample may have
 * several. */
typedef struct sbri_soft_contact {
  sbri_sample sample; /* weights in this tick */
  sbf_vec3 normal;    /* unit */
  float offset;       /* n . x of the plane at the beginning of the present substep */
  union {
    sbf_vec3 velocity; /* velocity of the other surface, m/s */
    sbf_vec3 arm;      /* lever arm from the external body's centre of mass */
  };
  float friction_scale, restitution; /* factor on the body's friction coefficient; restitution */
  uint32_t collider;     /* index of the collider, SBRI_NO_COLLIDER for the ground, or SBRI_ITSELF for self
                            contact (the other side's points have negative weights) */
  bool edges;            /* self contact of two edges: the first two points against the last two */
  bool is_crossed;       /* self contact: the edges have passed through each other */
  bool is_single;        /* the sample is a single free point that no other contact moves */
  uint8_t external_body; /* 1-based index of the body's external body that receives the impulse
                            (shapes/external_body.h); 0: none */
  /* Solver state (soft/solvers/soft_contacts.c, contact/contact_blocks.c): */
  float gap, target_speed;   /* separation, m, and target normal velocity, m/s, at the beginning of a substep;
                                before the first, the gap predicted for the end of the tick */
  float velocity_change;     /* normal velocity change by the contact, m/s */
  sbf_vec3 friction_impulse; /* friction, tangential */
  sbri_pressing pressing;    /* before this substep */
  float max_velocity_change; /* maximum velocity_change in the tick */
  float closing_speed;       /* maximum closing speed in the tick, m/s; for events */
  sbf_vec3 total_velocity_change; /* sum of velocity changes in the tick, m/s */
} sbri_soft_contact;

/* Contacts kept at a point. A surface may have many more samples than the body has points. Beyond three or
 * four per point, further contacts constrain the same motion again: they cost time, and iterations converge
 * slowly. With fewer, pointed parts sink in by several millimetres per metre. */
enum { SBRI_CONTACTS_PER_POINT = 4 };

/* The contacts with the smallest gaps among those whose greatest weight is at a point. */
typedef struct sbri_point_contacts {
  float gaps[SBRI_CONTACTS_PER_POINT]; /* predicted at the end of the tick, ascending, m */
  uint32_t contacts[SBRI_CONTACTS_PER_POINT];
  uint32_t count;
} sbri_point_contacts;

/* Samples of eight contacts. */
typedef struct sbri_sample_lanes {
  uint32_t slots[4][SBRI_BLOCK];
  float weights[4][SBRI_BLOCK];
  float responses[4][SBRI_BLOCK]; /* velocity change of a point per velocity change of the sample */
  float mass_kg[SBRI_BLOCK];      /* effective mass for an impulse at the sample; 0: unused lane */
} sbri_sample_lanes;

/* sbri_pressing of eight contacts. */
typedef struct sbri_pressing_lanes {
  float velocity_change[SBRI_BLOCK], time_s[SBRI_BLOCK], deficit[SBRI_BLOCK];
} sbri_pressing_lanes;

/* Bounds of friction as a function of the normal velocity change. */
typedef struct sbri_friction_bound_lanes {
  float constant[SBRI_BLOCK], slope[SBRI_BLOCK];
} sbri_friction_bound_lanes;

/* Results in a tick, as in sbri_soft_contact. */
typedef struct sbri_contact_tick_lanes {
  float max_velocity_change[SBRI_BLOCK], closing_speed[SBRI_BLOCK]; /* maxima, m/s */
  float velocity_change[3][SBRI_BLOCK];                             /* sum, m/s */
} sbri_contact_tick_lanes;

/* Eight contacts of a body with ground and colliders, which no impulse of the body moves. An unused lane has
 * weights of 0 and is far from its plane. */
typedef struct sbri_contact_block {
  sbri_sample_lanes sample;
  uint32_t contacts[SBRI_BLOCK]; /* index among the body's contacts; UINT32_MAX: unused lane */
  float normal[3][SBRI_BLOCK];
  float offset[SBRI_BLOCK];      /* n . x of the plane at the beginning of the present substep */
  float velocity[3][SBRI_BLOCK]; /* velocity of the other surface, m/s */
  float friction[SBRI_BLOCK], restitution[SBRI_BLOCK];
  float active[SBRI_BLOCK];     /* 1: has an impulse, or arrives in this substep; else 0 */
  float relaxation[SBRI_BLOCK]; /* relaxation factor of an iteration by row sums; 0 if not active */
  float gap[SBRI_BLOCK], target_speed[SBRI_BLOCK]; /* separation, m, and target normal velocity, m/s */
  float velocity_change[SBRI_BLOCK];               /* normal velocity change by the contact, m/s */
  float friction_impulse[3][SBRI_BLOCK];           /* friction, tangential */
  sbri_pressing_lanes pressing;
  sbri_friction_bound_lanes friction_bound;
  sbri_contact_tick_lanes of_tick;
  float max_weight_sum; /* maximum sum of a sample's absolute weights: it is at most so many times as fast as
                           its fastest point */
  float clearance_m;    /* separation of the nearest contact at the last check, minus the possible motion
                           since */
  bool is_moving;       /* some plane moves */
  bool is_near;         /* not idle in this substep */
  bool has_impulses;    /* some lane has an impulse, from the warm start or an iteration */
} sbri_contact_block;

#endif
