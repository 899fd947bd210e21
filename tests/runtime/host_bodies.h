/* Bodies of a host's own physics with a mass, for tests of contacts with them. */
#ifndef TEST_HOST_BODIES_H
#define TEST_HOST_BODIES_H

#include "collision_scenes.h"

enum { HOST_BODY_PARTS = 2 };

/* A body of the host, which moves it as engines do: the new velocity, and then a way by that. */
typedef struct host_body {
  sbr_shape *shape;
  sbr_collider_id ids[HOST_BODY_PARTS];
  sbf_vec3 arms[HOST_BODY_PARTS]; /* of its colliders */
  uint32_t parts;
  double mass, inertia[3], at[3], velocity[3], angular_velocity[3], weight; /* the last in m/s^2 */
  sbf_quat rotation;
  bool is_reported;
} host_body;

/* Of `parts` colliders at `arms`, NULL: at its place; friction 0.5, restitution 0. */
host_body host_body_make(
    scene *s, sbr_shape_definition form, double mass, const sbf_vec3 *arms, uint32_t parts, sbr_double3 at);
/* Tells the world of its motion. */
void host_body_tell(scene *s, host_body *b);
/* So many ticks of both; `floor`: a height that its middle does not go below. */
void host_body_go(scene *s, host_body *b, uint32_t ticks, double floor);
double host_body_speed(const host_body *b);
/* Its fastest in so many ticks. */
double host_body_fastest(scene *s, host_body *b, uint32_t ticks);

#endif
