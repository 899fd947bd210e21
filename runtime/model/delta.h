/* Motion of frames since the rest pose: a squash about the frame's head, then a rigid motion. */
#ifndef SBRI_DELTA_H
#define SBRI_DELTA_H

#include "math/quat.h"

/* Scales by `along` in the direction `axis` (unit) and by `across` perpendicular to it, about `head`; asset
 * space at rest. */
typedef struct sbri_squash {
  sbf_vec3 head, axis;
  float along, across;
} sbri_squash;

/* The motion from a rest position to the current one, in asset metres. */
typedef struct sbri_delta {
  sbf_vec3 position;
  sbf_quat rotation;
  const sbri_squash *squash; /* NULL: none */
} sbri_delta;

/* Displacement of a position by a squash. */
static inline sbf_vec3 sbri_squash_shift(const sbri_squash *squash, sbf_vec3 position) {
  sbf_vec3 off = sbri_sub(position, squash->head);
  float along = (squash->along - squash->across) * sbri_dot(squash->axis, off);
  return sbri_add_scaled(sbri_scale(squash->axis, along), off, squash->across - 1);
}

static inline sbf_vec3 sbri_delta_position(const sbri_delta *delta, sbf_vec3 rest) {
  if (delta->squash) rest = sbri_add(rest, sbri_squash_shift(delta->squash, rest));
  return sbri_add(delta->position, sbri_rotate(delta->rotation, rest));
}

#endif
