/* Edges along which meshes are open, by the positions of their ends. */
#ifndef SBFI_MESH_BORDERS_H
#define SBFI_MESH_BORDERS_H

#include "import/scene/scene.h"

typedef struct sbfi_border_edge {
  sbf_vec3 ends[2]; /* the smaller one first */
  uint32_t mesh;
} sbfi_border_edge;

typedef struct sbfi_borders {
  sbfi_border_edge *at; /* sorted: edges at one position are consecutive, ordered by mesh */
  size_t count;
} sbfi_borders;

int sbfi_compare_positions(const sbf_vec3 *a, const sbf_vec3 *b);

/* Finds the edges that an odd number of a mesh's polygons share, once a mesh. Leaves out meshes for which
 * `is_included` is false. False if memory runs out. */
bool sbfi_borders_find(sbfi_borders *borders, const sbfi_scene_mesh *meshes, uint32_t mesh_count,
    const bool *is_included, sbfi_arena *arena);

/* Whether two edges are at one position. */
bool sbfi_borders_coincide(const sbfi_border_edge *a, const sbfi_border_edge *b);

#endif
