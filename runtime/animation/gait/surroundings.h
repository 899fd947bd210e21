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
  sbr_ground ground; /* base and colliders combined, for the gait; its `user` is this struct */
  const sbr_ground *base;
  const sbri_collider_set *colliders; /* NULL: none is near */
  const sbri_wall_volume *wall_volume;
  float scale;
  double overhead; /* m, world: surfaces above it are not ground */
} sbri_surroundings;

/* Finds the surroundings of a body at `position` (world; y: height of the ground below it). `out` must not be
 * copied. */
void sbri_surroundings_find(const sbri_rig *rig, float scale, const sbri_collider_set *colliders,
    const sbr_ground *base, sbr_double3 position, sbri_surroundings *out);

/* Whether a collider of the set is an obstacle and floor for the body. */
bool sbri_surroundings_has(const sbri_surroundings *around, uint32_t collider);

/* Finds the collider whose top at (x, z) was within `tolerance` of the height y when the tick began; false if
 * there is none. */
bool sbri_surroundings_bearer(
    const sbri_surroundings *around, sbr_double3 position, double tolerance, uint32_t *collider);

#endif
