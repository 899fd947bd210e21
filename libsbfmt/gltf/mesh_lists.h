/* What a mesh of a glTF file says of a render mesh. The writer of the extension and its reader compute lists
 * by the same calls, so that the writer knows what the reader will get.
 *
 * A glTF mesh has triangles, fans of the render mesh's polygons in their order, one primitive a material slot
 * in use; and vertices, one for each combination of point, normal, color and texture coordinates. Here the
 * vertices of all primitives are numbered one after the other. */
#ifndef SBFI_MESH_LISTS_H
#define SBFI_MESH_LISTS_H

#include "gltf/glb_file.h"
#include "sbfmt/model.h"

enum { SBFI_GLTF_UV_SETS = 4 };

typedef struct sbfi_mesh_vertices {
  const sbfi_json *mesh;
  uint32_t count; /* vertices */
  uint32_t primitive_count;
  const uint32_t *primitive_ends; /* (primitive_count) end of each one's vertices */
  uint32_t corner_count;
  const uint32_t *corner_vertices; /* (corner_count) vertex of each corner of the polygons */
} sbfi_mesh_vertices;

/* Finds the vertex of each corner. `sizes` and `materials` are those of the render mesh; materials may be
 * empty. False, with the file's error set, if the mesh has other triangles. */
bool sbfi_mesh_vertices_find(const sbfi_glb_file *file, const sbfi_json *mesh, sbf_u32_list sizes,
    sbf_u32_list materials, sbfi_mesh_vertices *vertices);

/* Checksum of positions and triangles, which tells whether another program changed the mesh. False, with the
 * file's error set, if they cannot be read. */
bool sbfi_mesh_checksum(const sbfi_glb_file *file, const sbfi_mesh_vertices *v, uint32_t *crc);

/* Scalars of an attribute, such as "POSITION", of all vertices; width: 2 to 4. NULL, with the file's error
 * set, if a primitive lacks it. */
const float *sbfi_mesh_attribute(
    const sbfi_glb_file *file, const sbfi_mesh_vertices *v, const char *name, uint32_t width);
/* Positions of morph target `target`. */
const float *sbfi_mesh_target(const sbfi_glb_file *file, const sbfi_mesh_vertices *v, uint32_t target);

/* Each vertex writes its `width` scalars to its item of `to` (count), which is zeroed. False if an index is
 * out of range. */
bool sbfi_scatter(const sbfi_mesh_vertices *v, const uint32_t *item_of_vertex, const float *of_vertices,
    uint32_t width, float *to, uint32_t count);
/* `to` (corners) receives the item of each corner's vertex. */
void sbfi_gather_corners(const sbfi_mesh_vertices *v, const uint32_t *item_of_vertex, uint32_t *to);
/* Texture coordinates have their origin below in an asset, above in glTF. */
void sbfi_flip_coordinates(float *coordinates, uint32_t count);
/* `to` (points) receives the first vertex of each point; UINT32_MAX: none. False if an index is out of
 * range. */
bool sbfi_first_vertices(
    const sbfi_mesh_vertices *v, const uint32_t *point_of_vertex, uint32_t *to, uint32_t points);
/* Weights of a skin from the vertices: 0 where a vertex has none for a bone. `to` has as many as the skin has
 * bones. */
bool sbfi_gather_weights(const sbfi_glb_file *file, const sbfi_mesh_vertices *v,
    const uint32_t *first_vertices, sbf_u32_list influence_counts, sbf_u32_list bones, float *to);
/* Offsets of a shape key's points; the mesh has `point_count`. */
bool sbfi_gather_offsets(const sbfi_glb_file *file, const sbfi_mesh_vertices *v,
    const uint32_t *first_vertices, uint32_t point_count, uint32_t target, sbf_u32_list points, float *to);

#endif
