/* Convex shapes of a character's parts, from its asset at rest. */
#ifndef SBFMT_GODOT_PART_SHAPES_H
#define SBFMT_GODOT_PART_SHAPES_H

#include "variants.h"

enum { PART_POINTS = 40 /* maximum number of points of a hull */ };

/* A part: what it follows, and its hull in that frame. */
typedef struct part_shape {
  int32_t bone, soft_body; /* -1: none */
  bool follows_surface;    /* its frame is the best fit of the soft body's surface; else the bone's */
  sbf_vec3 middle;         /* of that surface at rest, m */
  sbf_vec3 hull[PART_POINTS];
} part_shape;

/* The parts of an asset at a scale; `loose`: its sections are not pinned to their bones. Frees with free();
 * NULL: there is none, or no memory. */
part_shape *part_shapes_make(const sbf_asset *asset, float scale, bool loose, uint32_t *count);

/* Rotation that fits points at rest (about `middle`) best to points now (about `center`), from a first guess.
 */
sbf_quat part_rotation(const sbf_vec3 *rest, sbf_vec3 middle, const sbf_vec3 *now, sbf_vec3 center,
    uint32_t count, sbf_quat guess);

#endif
