/* A render level as a mesh of its own, of the vertices that it uses alone. */
#ifndef SBFI_LEVEL_MESH_H
#define SBFI_LEVEL_MESH_H

#include "base/memory.h"
#include "sbfmt/model.h"

typedef struct sbfi_level_mesh {
  sbf_render_mesh mesh;     /* its polygons, with vertices, normals, texture coordinates and slots as they are
                               there;     no skin, shape keys, source points or levels */
  const uint32_t *vertices; /* (vertex_count) of the full mesh, ascending */
  uint32_t vertex_count;
  const uint32_t *position_of; /* (vertices of the full mesh) in `vertices`; UINT32_MAX: not there */
} sbfi_level_mesh;

/* Memory of `arena`, and lists of `full` and `level`; false where it runs out. */
bool sbfi_level_mesh_make(
    sbfi_level_mesh *made, const sbf_render_mesh *full, const sbf_render_level *level, sbfi_arena *arena);

#endif
