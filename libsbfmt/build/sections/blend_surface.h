/* Bone weights over triangles, made so smooth that the triangles bend well. */
#ifndef SBFI_BLEND_SURFACE_H
#define SBFI_BLEND_SURFACE_H

#include "base/memory.h"
#include "mechanics/vector.h"
#include "sbfmt/model.h"

enum { SBFI_BLEND_POSES = 6 };

/* A bone about whose head the surface is bent; zeros where it has no parent. */
typedef struct sbfi_blend_joint {
  sbfi_d3 head;
  double turns[SBFI_BLEND_POSES][3][3]; /* rotations less the unit matrix */
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
  uint32_t *begins, *at_point; /* triangles at each point: made by sbfi_blend_surface_index() */
  const uint8_t *soft;         /* (bones) what they hold shall bend well; NULL: what any bone holds */
  const uint8_t *fixed; /* (point_count) that keep their weights as long as others can give way; NULL: none */
  uint8_t *changed;     /* (point_count) receives 1 where weights were changed */
} sbfi_blend_surface;

/* Weights below it go to the greatest of their point, so that rows stay short however far weights spread. */
static const double SBFI_BLEND_NEGLIGIBLE = 1e-7;

/* (bones) NULL where memory runs out. */
sbfi_blend_joint *sbfi_blend_joints_make(const sbf_bone_list *bones, sbfi_arena *arena);

/* Sorts the triangles by height and lists those at each point: what follows does not depend on the order of a
 * file. False where memory runs out. */
bool sbfi_blend_surface_index(sbfi_blend_surface *surface, sbfi_arena *arena);

/* Contracts the weights of triangles that stretch or turn over (section_blend.h says which) towards their
 * means, in sweeps, until none is left. Begins at triangles with a corner that a soft bone holds, and goes on
 * over the neighbours of what it changes. `*left` receives how many are. Time of a sweep: linear in the
 * triangles whose weights changed and the bones between those that hold their corners. */
bool sbfi_blend_surface_relax(sbfi_blend_surface *surface, uint32_t *left, sbfi_arena *arena);

#endif
