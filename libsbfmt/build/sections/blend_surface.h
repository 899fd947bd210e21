/* Smooths bone weights of triangles so that they deform well in bends. */
#ifndef SBFI_BLEND_SURFACE_H
#define SBFI_BLEND_SURFACE_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/model.h"

enum { SBFI_BLEND_POSES = 6 };

/* A joint at whose head the surface is bent; zeros if the bone has no parent. */
typedef struct sbfi_blend_joint {
  sbfi_d3 head;
  double rotations[SBFI_BLEND_POSES][3][3]; /* rotations minus the unit matrix */
} sbfi_blend_joint;

typedef struct sbfi_blend_weight {
  uint32_t bone;
  double value;
} sbfi_blend_weight;

/* Weights of a point, ascending by bone; their sum is 1. */
typedef struct sbfi_blend_row {
  sbfi_blend_weight *at;
  uint32_t count, capacity;
} sbfi_blend_row;

typedef struct sbfi_blend_surface {
  const sbf_bone *bones;          /* parents before their children */
  const sbfi_blend_joint *joints; /* (bones) */
  uint32_t point_count, triangle_count;
  const sbf_vec3 *positions;
  sbfi_blend_row *rows;         /* (point_count) */
  const sbfi_blend_row *before; /* (point_count) as authored */
  uint32_t (*triangles)[3];
  uint32_t *begins, *at_point; /* triangles at each point, from sbfi_blend_surface_index() */
  const uint8_t *soft;         /* (bones) whose region should bend well; NULL: all */
  /* (point_count) points that keep their weights as long as others can change; NULL: none */
  const uint8_t *fixed;
  uint8_t max_contractions; /* of each triangle; 0: any number */
  uint8_t *changed;         /* (point_count) receives 1 for changed weights */
  uint64_t checks;          /* number of triangles that were bent so far: the cost */
} sbfi_blend_surface;

/* Smaller weights are added to the greatest of their point, so that rows stay short when weights spread
 * far. */
static const double SBFI_BLEND_NEGLIGIBLE = 1e-7;

/* (bones) NULL if memory runs out. */
sbfi_blend_joint *sbfi_blend_joints_make(const sbf_bone_list *bones, sbfi_arena *arena);

/* Sorts the triangles by height and lists those at each point, so that results do not depend on the order
 * of a file. False if memory runs out. */
bool sbfi_blend_surface_index(sbfi_blend_surface *surface, sbfi_arena *arena);

/* Contracts the weights of triangles that stretch or flip (see section_blend.h) towards their means, in
 * sweeps, until none is left. Starts at triangles with a corner of a soft bone, and continues over the
 * neighbours of changes. `*left` receives the remaining number. Time of a sweep: linear in the triangles
 * with changed weights and the bones between those of their corners. */
bool sbfi_blend_surface_relax(sbfi_blend_surface *surface, uint32_t *left, sbfi_arena *arena);

#endif
