/* Bullet's soft bodies, to compare with: one body in a world of its own, without anything to collide with
 * (peer_bullet_falls.h has that).
 * Where the program was built without Bullet, nothing can be made. */
#ifndef BENCH_PEER_BULLET_H
#define BENCH_PEER_BULLET_H

#include "sbfmt/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bullet_body bullet_body;

/* What a body is made of; all arrays are the caller's and are copied. */
typedef struct bullet_shape {
  const sbf_vec3 *points;
  const float *masses; /* kg; 0: held */
  uint32_t point_count;
  const sbf_uint2 *links;
  const float *stiffness; /* (link_count) N/m; at rest they are as long as they lie */
  uint32_t link_count;
  const sbf_uint4 *tetrahedra;
  uint32_t tetrahedron_count;
  float young_modulus, poisson_ratio;
} bullet_shape;

#ifdef BENCH_BULLET
/* The classic soft body: links, positions corrected `iterations` times a step. A link's own stiffness has no
 * unit there. With `share` above 0 all have that one, as users set it; else each link has what makes a step
 * of `step_s` with one iteration an implicit step of its spring. */
bullet_body *bullet_make_links(
    const bullet_shape *shape, uint32_t iterations, float linear_stiffness, float step_s);
/* The deformable body: neo-Hookean tetrahedra, implicit steps, no damping. */
bullet_body *bullet_make_solid(const bullet_shape *shape);
void bullet_step(bullet_body *body, float step_s);
void bullet_read(const bullet_body *body, sbf_vec3 *points);
void bullet_free(bullet_body *body);
const char *bullet_version(void);
#endif

#ifdef __cplusplus
}
#endif

#endif
