/* Triangles of one material of a render mesh, with a vertex for each distinct corner. */
#ifndef SBFMT_GODOT_SURFACE_VERTICES_H
#define SBFMT_GODOT_SURFACE_VERTICES_H

#include "sbrun/sbrun.h"

typedef struct surface_vertices {
  uint32_t count;       /* of vertices */
  uint32_t *points;     /* (count) of the mesh */
  uint32_t *corners;    /* (count) one of its corners, as an index into the mesh's polygon_points */
  sbf_vec2 *uvs;        /* (count) origin at the upper left, as in Godot; NULL: none */
  sbf_vec4 *colors;     /* (count) linear; NULL: none */
  uint32_t index_count; /* three per triangle */
  int32_t *indices;     /* (index_count) clockwise seen from outside, as in Godot */
} surface_vertices;

/* `hard`: corners with different normals are distinct; `transform` of the coordinates may be NULL. Returns
 * false if memory runs out; then there is nothing to free. */
bool surface_vertices_make(surface_vertices *made, const sbf_render_mesh *mesh, uint32_t slot, bool hard,
    const sbf_uv_transform *transform);
void surface_vertices_free(surface_vertices *made);

#endif
