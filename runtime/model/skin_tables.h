/* Tables that embed the vertices of a mesh in points and bones, and tables for normals. All tables are in
 * blocks of eight lanes; unused lanes have weight 0 or no area. */
#ifndef SBRI_SKIN_TABLES_H
#define SBRI_SKIN_TABLES_H

#include "base/memory.h"
#include "math/wide.h"
#include "sbrun/sbrun.h"

/* One embedding point of each of eight vertices. */
typedef struct sbri_volume_cell {
  uint32_t slots[SBRI_BLOCK]; /* in the whole character */
  float weights[SBRI_BLOCK];
} sbri_volume_cell;

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

/* Polygons as quads, whose area vector is half the cross product of their diagonals. A triangle repeats its
 * first corner; longer polygons are fans from their first corner. */
typedef struct sbri_face_block {
  uint32_t corners[4][SBRI_BLOCK]; /* vertices; unused lanes repeat one */
} sbri_face_block;

/* Faces whose sum gives each group, in blocks of eight groups. */
typedef struct sbri_sum_cell {
  uint32_t faces[SBRI_BLOCK]; /* unused lanes name a face without area */
} sbri_sum_cell;
typedef struct sbri_sum_table {
  uint32_t group_count;
  const uint32_t *cell_begins; /* (blocks + 1) */
  const sbri_sum_cell *cells;
} sbri_sum_table;

/* Weights of a face's two diagonals in its tangent, times its area in texture space. */
typedef struct sbri_tangent_block {
  float fractions[2][SBRI_BLOCK];
} sbri_tangent_block;

/* Tables that sum the normals of faces to those of vertices and corners. */
typedef struct sbri_skin_normals {
  sbri_sum_table smooth;     /* one normal per vertex, shared by vertices at the same position */
  const uint32_t *smooth_of; /* (vertex_count) group of each */
  sbri_sum_table split;      /* separate normals at hard edges */
  const uint32_t *split_of;  /* (corner_count) */
  uint32_t corner_count;
} sbri_skin_normals;

/* Tables that sum the tangents of faces to those of vertices. */
typedef struct sbri_skin_tangents {
  const sbri_tangent_block *blocks; /* (face_block_count); NULL: no uvs */
  sbri_sum_table sums;              /* groups are vertices */
  const float *handedness;          /* (vertex_count) 1 or -1 */
} sbri_skin_tangents;

typedef struct sbri_skin {
  uint32_t vertex_count;
  const uint32_t *vertices;    /* (vertex_count) of a render level: vertex of the full mesh; NULL: all */
  const uint32_t *cell_begins; /* (blocks of vertices + 1) */
  const sbri_volume_cell *cells;
  uint32_t cell_count;
  /* For a skin that may tear, else none: bindings of vertices to tetrahedra, and the first cells, bindings
   * and polygons of the skin in a character's state. */
  const struct sbri_binding *bindings;
  const uint32_t *binding_of; /* (vertex_count) UINT32_MAX: none */
  uint32_t binding_count, first_cell, first_binding, first_polygon;
  const uint32_t *side_begins;    /* (polygons + 1) NULL: no edge lies along a spring that may tear */
  const uint32_t *side_strengths; /* of such springs, indices in the character's strengths */
  const sbri_frame_vertex *frame_vertices; /* (frame_vertex_count) */
  uint32_t frame_vertex_count;
  const sbri_influence *influences;

  uint32_t face_block_count; /* the last lane of the last block is unused */
  const sbri_face_block *faces;
  sbri_skin_normals normals;
  sbri_skin_tangents tangents;
} sbri_skin;

#endif
