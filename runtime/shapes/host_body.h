/* A body of the host's physics behind a collider: its motion in a tick, and the impulses on it. It is input
 * and prediction, not state of the runtime: snapshots do not contain it. */
#ifndef SBRI_HOST_BODY_H
#define SBRI_HOST_BODY_H

#include "shapes/contact_reports.h"

typedef struct sbri_host_body {
  float inverse_mass;        /* 1/kg; 0: immovable */
  sbf_vec3 inverse_inertias; /* 1/(kg m^2), about its principal axes */
  sbf_quat axes;             /* from these to the shape's */
  sbf_vec3 centre;           /* centre of mass, in the shape's frame */
  bool is_moving;            /* the host has set its motion, so the runtime predicts it */
  bool is_reported;          /* since the last tick */
  sbf_vec3 velocity,
      angular_velocity; /* m/s of the collider's position, and rad/s: as set, or as predicted */
  sbf_vec3 reported_velocity, acceleration; /* m/s and m/s^2 */
  sbf_vec3 blocked_normal;    /* unit, direction in which a constraint of the host blocks it; or zeros */
  sbf_vec3 reported_impulse;  /* N s that the host has read since it set the motion */
  uint32_t contributor_count; /* number of bodies that applied an impulse in the last tick, and the sum of
                                 impulses: */
  sbf_vec3 impulse, moment;   /* N s, and N m s about its centre */
  uint32_t next_contributor_count; /* the same of this tick */
  double next_impulse[3], next_moment[3];
} sbri_host_body;

/* Maximum number per body; further ones are treated as immovable. */
enum { SBRI_EXTERNAL_BODIES = SBRI_MAX_CONTACT_REPORTS };

/* Copy for a body in contact with it, within a tick (shapes/external_body.h), in the character's own lengths
 * and times. */
typedef struct sbri_external_body {
  uint32_t leader; /* index of the collider with the mass */
  sbf_vec3 centre; /* centre of mass at the beginning of the tick */
  sbf_vec3 begin_velocity,
      begin_angular_velocity;                    /* at the beginning of the present substep, m/s and rad/s */
  sbf_vec3 velocity, angular_velocity;           /* at its end */
  sbf_vec3 seen_velocity, seen_angular_velocity; /* displacement rate in the substep, which contacts use */
  float elapsed_s,
      lever; /* time since the beginning of the tick; ratio of displacement rate change to velocity change */
  sbf_vec3 acceleration, angular_acceleration; /* by all but this body's impulses, m/s^2 and rad/s^2 */
  float inverse_mass[6], inverse_inertia[6];   /* 1/kg and 1/(kg m^2): xx, yy, zz, xy, xz, yz */
  float max_inverse_mass, max_inverse_inertia; /* maximum over all directions and axes */
} sbri_external_body;

typedef struct sbri_external_bodies {
  uint32_t count;
  sbri_external_body at[SBRI_EXTERNAL_BODIES];
} sbri_external_bodies;

#endif
