/* Finds the time in the rig's clips whose pose the input has. */
#ifndef SBFI_CLIP_MOMENTS_H
#define SBFI_CLIP_MOMENTS_H

#include "import/rigging/rigging.h"

enum { SBFI_MAX_CLIP_MOMENTS = 4 };

typedef struct sbfi_clip_moment {
  const sbfi_scene_clip *clip;
  double time_s;
  double difference; /* relative difference between the shapes of the two surfaces; 0: equal */
} sbfi_clip_moment;

/* Finds times at which the rig's meshes have the shape of the whole input, independent of unit and axes,
 * best first. Finds none if the triangle counts differ. False if memory runs out. */
bool sbfi_clip_moments_find(
    const sbfi_rigging *r, sbfi_clip_moment poses[SBFI_MAX_CLIP_MOMENTS], uint32_t *count);

/* World matrices of the rig's nodes at that time. NULL if memory runs out. */
const sbfi_matrix *sbfi_clip_moment_worlds(const sbfi_rigging *r, const sbfi_clip_moment *pose);

#endif
