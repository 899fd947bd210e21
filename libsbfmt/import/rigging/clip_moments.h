/* The moment of the rig's clips at which an input stands. */
#ifndef SBFI_CLIP_MOMENTS_H
#define SBFI_CLIP_MOMENTS_H

#include "import/rigging/rigging.h"

enum { SBFI_MAX_CLIP_MOMENTS = 4 };

typedef struct sbfi_clip_moment {
  const sbfi_scene_clip *clip;
  double time_s;
  double difference; /* between the shapes of the two surfaces, as shares; 0: equal */
} sbfi_clip_moment;

/* Moments at which the rig's meshes have the shape of the whole input, whatever its unit and axes, the most
 * alike first; none where the two have different numbers of triangles. False where memory runs out. */
bool sbfi_clip_moments_find(
    const sbfi_rigging *r, sbfi_clip_moment poses[SBFI_MAX_CLIP_MOMENTS], uint32_t *count);

/* The worlds of the rig's nodes at that moment. NULL where memory runs out. */
const sbfi_matrix *sbfi_clip_moment_worlds(const sbfi_rigging *r, const sbfi_clip_moment *pose);

#endif
