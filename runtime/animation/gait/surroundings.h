/* The surroundings of a character: the ground and the colliders near it.
 *
 * The parts of a collider that are low enough to step on are ground; higher parts are walls. Colliders
 * lighter than the character are neither, because it pushes them away. Triangles of meshes and height fields
 * have no inside: only the parts that a ray from above hits are ground. Held characters only have the ground.
 */
#ifndef SBRI_SURROUNDINGS_H
#define SBRI_SURROUNDINGS_H

#include "animation/skeleton/rig.h"
#include "shapes/colliders.h"

typedef struct sbri_surroundings {
  sbr_ground ground; /* both as one, its `user` is this; what the gait asks while colliders are near */
  const sbr_ground *base;
  const sbri_collider_set *colliders; /* NULL: none is near */
  const sbri_girth *girth;
  float scale;
  double overhead; /* m, world: what is above is not to be stood on */
} sbri_surroundings;

/* The surroundings of a body with that rig at `position` (world; y is that of the ground below it). `out`
 * must not be copied. */
void sbri_surroundings_find(const sbri_rig *rig, float scale, const sbri_collider_set *colliders,
    const sbr_ground *base, sbr_double3 position, sbri_surroundings *out);

/* Whether a collider of the set is an obstacle and floor for the body. */
bool sbri_surroundings_has(const sbri_surroundings *around, uint32_t collider);

/* The collider whose top at (x, z) is within `tolerance` of the height y, as colliders stood when the tick
 * began; false if there is none. */
bool sbri_surroundings_bearer(
    const sbri_surroundings *around, sbr_double3 position, double tolerance, uint32_t *collider);

#endif
