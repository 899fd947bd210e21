/* Bullet's ragdoll, and its cloth over a ball, to compare with. Where the program was built without Bullet,
 * neither can be made. */
#ifndef BENCH_PEER_BULLET_FALLS_H
#define BENCH_PEER_BULLET_FALLS_H

#include "measured_ragdoll.h"
#include "peer_bullet.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Where a part of a ragdoll is, world. */
typedef struct part_state {
  sbf_vec3 center, velocity;
  sbf_quat rotation; /* from rest */
} part_state;

#ifdef BENCH_BULLET
typedef struct bullet_ragdoll bullet_ragdoll;
/* Boxes and cone-twist constraints, `raise` metres above the ground y = 0, which has this friction; parts
 * meet the ground alone. */
bullet_ragdoll *bullet_ragdoll_make(float raise, float friction, int iterations);
void bullet_ragdoll_push(bullet_ragdoll *ragdoll, int part, sbf_vec3 point, sbf_vec3 impulse);
void bullet_ragdoll_step(bullet_ragdoll *ragdoll, float step_s);
void bullet_ragdoll_read(const bullet_ragdoll *ragdoll, part_state parts[RAGDOLL_PARTS]);
void bullet_ragdoll_free(bullet_ragdoll *ragdoll);

/* A body of links as bullet_make_links makes it, that meets a ball which stands still. */
bullet_body *bullet_make_links_over_ball(const bullet_shape *shape, uint32_t iterations, float fraction,
    float step_s, sbf_vec3 center, float radius, float friction);
#endif

#ifdef __cplusplus
}
#endif

#endif
