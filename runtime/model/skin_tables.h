/* Tables by which the vertices of one mesh follow a character's points and bones, and by which their normals
 * are found. Everything stands in blocks of eight lanes; inert lanes have weight 0 or no area. */
#ifndef SBRI_SKIN_TABLES_H
#define SBRI_SKIN_TABLES_H

#include "base/memory.h"
#include "math/wide.h"
#include "sbrun/sbrun.h"

/* One of the points that carry each of eight vertices. */
typedef struct sbri_carry_cell {
  uint32_t slots[SBRI_BLOCK]; /* of the whole character */
  float weights[SBRI_BLOCK];
} sbri_carry_cell;

/* A slot's weight in a face. */
typedef struct sbri_face_weight {
  uint32_t slot, face; /* slot of the island */
  float weight;
} sbri_face_weight;

/* A vertex that follows frames (bones, or the character's root). */
typedef struct sbri_frame_vertex {
  uint32_t vertex;
  uint32_t first, count; /* its influences */
  sbf_vec3 rest;
} sbri_frame_vertex;
typedef struct sbri_influence {
  uint32_t frame;
  float weight;
} sbri_influence;

/* Polygons as quads, whose area vector is half the cross product of their diagonals: a triangle repeats its
 * first corner; longer polygons are cut from their first corner on. */
typedef struct sbri_face_block {
  uint32_t corners[4][SBRI_BLOCK]; /* vertices; inert lanes repeat one */
} sbri_face_block;

/* Which faces make up the sum of each group, in blocks of eight groups. */
typedef struct sbri_sum_cell {
  uint32_t faces[SBRI_BLOCK]; /* inert lanes name a face without area */
} sbri_sum_cell;
typedef struct sbri_sum_table {
  uint32_t group_count;
  const uint32_t *cell_begins; /* (blocks + 1) */
  const sbri_sum_cell *cells;
} sbri_sum_table;

/* Shares of a face's two diagonals in its tangent, times its area in the texture. */
typedef struct sbri_tangent_block {
  float fractions[2][SBRI_BLOCK];
} sbri_tangent_block;

typedef struct sbri_skin {
  uint32_t vertex_count;
  const uint32_t *vertices;    /* (vertex_count) of a render level: which of the mesh's; NULL: all */
  const uint32_t *cell_begins; /* (blocks of vertices + 1) */
  const sbri_carry_cell *cells;
  uint32_t cell_count;
  /* Of a skin that may tear, else none: who rides on which tetrahedron, by vertices, and where the skin's
   * cells, bindings and polygons begin in a character's state. */
  const struct sbri_binding *bindings;
  const uint32_t *binding_of; /* (vertex_count) UINT32_MAX: none */
  uint32_t binding_count, first_cell, first_binding, first_polygon;
  const uint32_t *side_begins;    /* (polygons + 1) NULL: no side lies along a spring that may tear */
  const uint32_t *side_strengths; /* of such springs, places in the character's strengths */
  const sbri_frame_vertex *frame_vertices; /* (frame_vertex_count) */
  uint32_t frame_vertex_count;
  const sbri_influence *influences;

  uint32_t face_block_count; /* the last lane of the last block is inert */
  const sbri_face_block *faces;
  sbri_sum_table smooth;     /* one normal a vertex, shared where vertices lie at one place */
  const uint32_t *smooth_of; /* (vertex_count) the group of each */
  sbri_sum_table split;      /* a normal for each side of a hard edge */
  const uint32_t *split_of;  /* (corner_count) */
  uint32_t corner_count;

  const sbri_tangent_block *tangent_blocks; /* (face_block_count); NULL: no uvs */
  sbri_sum_table tangents;                  /* groups are vertices */
  const float *handedness;                  /* (vertex_count) 1 or -1 */
} sbri_skin;

#endif
