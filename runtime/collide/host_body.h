/* A body of the host's own physics behind a collider: what moves it within a tick, and what is known of who
 * pushes it. Input and guesses, not state of the runtime: snapshots do not hold it. */
#ifndef SBRI_HOST_BODY_H
#define SBRI_HOST_BODY_H

#include "collide/touching.h"

typedef struct sbri_host_body {
  float inverse_mass;        /* 1/kg; 0: nothing moves it */
  sbf_vec3 inverse_inertias; /* 1/(kg m^2), about its principal axes */
  sbf_quat axes;             /* from these to the shape's */
  sbf_vec3 centre;           /* of its mass, in the shape's frame */
  bool goes;                 /* the host has set its motion, from which it is predicted */
  bool is_reported;          /* since the last tick */
  sbf_vec3 velocity,
      angular_velocity; /* m/s of the collider's position, and rad/s: as set, or predicted from that */
  sbf_vec3 reported_velocity, acceleration; /* m/s and m/s^2 */
  sbf_vec3 blocked_normal;                  /* unit, along which something else holds it; or zeros */
  sbf_vec3 handed;                          /* N s that the host has taken since it set the motion */
  uint32_t sharers;      /* bodies that applied an impulse in the last tick, and their sum: */
  sbf_vec3 push, moment; /* N s, and N m s about its centre */
  uint32_t sharing;      /* the same of this tick */
  double pushing[3], turning[3];
} sbri_host_body;

/* Of a body; those beyond them are taken for something that nothing moves. */
enum { SBRI_EXTERNAL_BODIES = SBRI_TOUCHING };

/* As a body that touches it sees it through a tick (collide/external_body.h), in the character's own lengths
 * and times. */
typedef struct sbri_external_body {
  uint32_t leader;                                 /* number of the collider with the mass */
  sbf_vec3 centre;                                 /* of its mass, at the tick's beginning */
  sbf_vec3 begin_velocity, begin_angular_velocity; /* m/s and rad/s as of the present substep's beginning */
  sbf_vec3 velocity, angular_velocity;             /* and as of its end */
  sbf_vec3 seen_velocity, seen_angular_velocity;   /* by which it goes in the substep */
  float elapsed_s, lever;         /* of the tick; how much more a push moves it than its velocity */
  sbf_vec3 acceleration, turning; /* m/s^2 and rad/s^2, of all but this body's pushes */
  float inverse_mass[6], inverse_inertia[6];   /* 1/kg and 1/(kg m^2): xx, yy, zz, xy, xz, yz */
  float max_inverse_mass, max_inverse_inertia; /* along and about any axis */
} sbri_external_body;

typedef struct sbri_external_bodies {
  uint32_t count;
  sbri_external_body at[SBRI_EXTERNAL_BODIES];
} sbri_external_bodies;

#endif
