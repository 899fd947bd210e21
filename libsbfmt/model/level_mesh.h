/* A render level as a separate mesh with only the vertices that it uses. */
#ifndef SBFI_LEVEL_MESH_H
#define SBFI_LEVEL_MESH_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_level_mesh {
  sbf_render_mesh mesh; /* its polygons with vertices, normals, texture coordinates and slots; no skin, shape
                           keys, source points or levels */
  const uint32_t *vertices; /* (vertex_count) indices in the full mesh, ascending */
  uint32_t vertex_count;
  const uint32_t *position_of; /* (vertices of the full mesh) index into `vertices`; UINT32_MAX: unused */
} sbfi_level_mesh;

/* Allocates from `arena` and shares lists of `full` and `level`; false if memory runs out. */
bool sbfi_level_mesh_make(
    sbfi_level_mesh *made, const sbf_render_mesh *full, const sbf_render_level *level, sbfi_arena *arena);

#endif
