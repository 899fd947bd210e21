/* A mesh prepared for weights: coincident points of one piece merged, in units of its longest side,
 * divided into shells. */
#ifndef SBFI_WEIGHT_MESH_H
#define SBFI_WEIGHT_MESH_H

#include "base/memory.h"
#include "build/weights/weights.h"
#include "mechanics/vector.h"

/* Connected pieces of surface that share no edge with others. */
typedef struct sbfi_shell {
  sbfi_d3 low, high; /* bounding box */
  double size;       /* longest side of the box */
  uint32_t first_triangle, triangle_count;
  uint32_t first_site, site_count; /* range in sites_by_shell */
} sbfi_shell;

/* A site represents all coincident points of one shell (weight_sites.h). Lengths are in units of the
 * bounding box's longest side, relative to its lowest corner. */
typedef struct sbfi_weight_mesh {
  sbf_vec3 *sites; /* (site_count) */
  /* (point_count) a point without triangles has the site of the nearest point with one */
  uint32_t *site_of_point;
  uint32_t (*triangles)[3]; /* (triangle_count) by shell; closed shells face outwards */
  uint32_t *shell_of_site;  /* (site_count) */
  uint32_t *sites_by_shell; /* (site_count) ascending within a shell */
  uint32_t *index_of_site;  /* (site_count) in sites_by_shell */
  double *areas;            /* (site_count) a third of the surrounding triangles */
  sbfi_d3 *normals;         /* (site_count) unit length, out of closed shells; 0 where triangles cancel out */
  sbfi_shell *shells;       /* (shell_count) numbered by first point */
  uint32_t site_count, triangle_count, shell_count;
  sbfi_d3 low;  /* m */
  double scale; /* units per metre */
} sbfi_weight_mesh;

typedef enum sbfi_weight_mesh_result {
  SBFI_WEIGHT_MESH_GOOD,
  SBFI_WEIGHT_MESH_TOO_SMALL, /* fewer than four non-degenerate triangles, or no extent */
  SBFI_WEIGHT_MESH_NO_MEMORY
} sbfi_weight_mesh_result;

sbfi_weight_mesh_result sbfi_weight_mesh_make(
    sbfi_weight_mesh *mesh, const sbfi_weights_input *in, sbfi_arena *arena);

/* Converts a point of asset space to the mesh's units. */
static inline sbfi_d3 sbfi_weight_mesh_position(const sbfi_weight_mesh *mesh, sbf_vec3 point) {
  return sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(point), mesh->low), mesh->scale);
}

/* All triangles as a polygon mesh over all sites: borrows the mesh's arrays. `sizes` has a capacity of
 * triangle_count; all become 3. */
sbf_polygon_mesh sbfi_weight_mesh_surface(const sbfi_weight_mesh *mesh, const uint32_t *sizes);

/* A single shell with its own sites. False if memory runs out. */
bool sbfi_weight_mesh_shell(const sbfi_weight_mesh *mesh, uint32_t shell, const uint32_t *sizes,
    sbf_polygon_mesh *surface, sbfi_arena *arena);

#endif
