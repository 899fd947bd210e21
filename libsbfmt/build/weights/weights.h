/* Computes skin weights for a mesh and a skeleton that was never bound to it.
 *
 * Each point starts with the nearest bone through the body, and heat diffuses these choices over the surface:
 *
 * (L + c M / d^2) w = (c M / d^2) p (Baran and Popovic 2007, section 4)
 *
 * with L the cotangent Laplacian, M the area of each point, d the distance to its bone, p 1 for that bone and
 * 0 for others. The nearest bone is found through a grid of voxels (Dionne and de Lasa 2013), so that an arm
 * beside the hip does not take the hip's bone. A bone reaches farther if the body around it is thicker, and
 * less far if the skin does not face away from it and in shells (pieces of surface that share no edge) that
 * it does not pass through. Shells before the joint of a limb follow the bone that the limb is attached to.
 * Small shells move with one bone. Bones on the left have no weight on the right, and conversely. Lengths are
 * in units of the longest side of the points' bounding box: the result does not depend on the unit.
 *
 * Supports open, many-shelled, non-manifold and self-touching meshes. Equal input gives equal bits. Memory
 * grows with points, triangles and bones, not with their products; the grid has a fixed size. */
#ifndef SBFI_WEIGHTS_H
#define SBFI_WEIGHTS_H

#include "base/diagnostic.h"
#include "sbfmt/model.h"

enum { SBFI_WEIGHTS_PER_POINT = 4 };

typedef struct sbfi_weights_input {
  const sbf_allocator *allocator; /* NULL: malloc */
  const sbf_vec3 *points;         /* (point_count) asset space, m */
  const uint32_t (*triangles)[3]; /* (triangle_count) indices into points; any order, any winding */
  uint32_t point_count, triangle_count;
  /* (bone_count) Uses name, head, parent, and rotation (its +Y is the direction of the bone). Length is
   * used for bones without children; 0 if the rig does not state it: then the mesh limits the bone. */
  const sbf_bone *bones;
  uint32_t bone_count;
  const int8_t *sides;      /* (bone_count) 1 left, -1 right, 0 in the middle; NULL: unknown */
  const bool *is_deforming; /* (bone_count); NULL: all but those named root, armature or master */
} sbfi_weights_input;

typedef struct sbfi_weights_figures {
  uint32_t shell_count, rigid_shell_count;
  uint32_t cell_count;        /* of the voxel grid, inside the body or on its surface */
  uint32_t unused_bone_count; /* deforming bones without points */
  uint32_t iterations;        /* of conjugate gradients, the maximum over groups of bones */
  uint32_t deforming_count;   /* bones that may have points */
  uint32_t ray_count;         /* number of rays of median_distance */
  double inside;              /* fraction of their length inside the body, to their tips */
  double bone_extent;         /* ratio of the bones' longest side to the surface's, without its thin ends */
  double median_distance; /* from the surface to its bone, relative to half the local thickness of the body */
} sbfi_weights_figures;

/* Arrays that sbfi_weights_free releases. */
typedef struct sbfi_weights {
  uint32_t (*joints)[SBFI_WEIGHTS_PER_POINT]; /* (point_count) bones, descending by weight */
  float (*weights)[SBFI_WEIGHTS_PER_POINT];   /* (point_count) 0..1, sum 1; 0 for unused joints */
  uint32_t *shell_of_point;                   /* (point_count) numbered by first point */
  /* (bone_count) Length of a bone that is nearest to no point, as a fraction of the length of all bones that
   * may have points; 0 for others. Such a bone is deep in the body, like a limb of another character. */
  float *idle_lengths;
  sbfi_weights_figures figures;
  sbf_allocator allocator;
  uint32_t point_count, bone_count;
} sbfi_weights;

/* Fills `*out`, which sbfi_weights_free releases. On failure `*out` is empty and `*error` has the reason:
 * IMPORT_WEIGHTS_IMPOSSIBLE for a mesh of fewer than four triangles or without extent, or no deforming
 * bone; OUT_OF_MEMORY. Points without triangles follow the nearest point of one. */
sbf_status sbfi_compute_weights(const sbfi_weights_input *in, sbfi_weights *out, sbf_diagnostic *error);

/* Safe on zeroed weights. */
void sbfi_weights_free(sbfi_weights *weights);

#endif
