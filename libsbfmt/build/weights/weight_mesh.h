/* A mesh made ready for weights: points of one place and piece joined, in units of its longest side, cut into
 * shells.
 */
#ifndef SBFI_WEIGHT_MESH_H
#define SBFI_WEIGHT_MESH_H

#include "base/memory.h"
#include "build/weights/weights.h"
#include "mechanics/vector.h"

/* Pieces of surface that share no edge with others. */
typedef struct sbfi_shell {
  sbfi_d3 low, high; /* bounding box */
  double size;       /* its longest side */
  uint32_t first_triangle, triangle_count;
  uint32_t first_site, site_count; /* places in sites_by_shell */
} sbfi_shell;

/* A site stands for all points of one shell in one place (weight_sites.h). Lengths are in units of the
 * bounding box's longest side, from its lowest corner. */
typedef struct sbfi_weight_mesh {
  sbf_vec3 *sites;          /* (site_count) */
  uint32_t *site_of_point;  /* (point_count) that of the nearest point in a triangle where it is in none */
  uint32_t (*triangles)[3]; /* (triangle_count) shell after shell; closed shells face outwards */
  uint32_t *shell_of_site;  /* (site_count) */
  uint32_t *sites_by_shell; /* (site_count) ascending within a shell */
  uint32_t *index_of_site;  /* (site_count) in sites_by_shell */
  double *areas;            /* (site_count) a third of the triangles around */
  sbfi_d3 *normals;   /* (site_count) of unit length, out of closed shells; 0 where triangles cancel out */
  sbfi_shell *shells; /* (shell_count) numbered by first point */
  uint32_t site_count, triangle_count, shell_count;
  sbfi_d3 low;  /* m */
  double scale; /* units in a metre */
} sbfi_weight_mesh;

typedef enum sbfi_weight_mesh_result {
  SBFI_WEIGHT_MESH_GOOD,
  SBFI_WEIGHT_MESH_TOO_SMALL, /* fewer than four triangles with area, or no extent */
  SBFI_WEIGHT_MESH_NO_MEMORY
} sbfi_weight_mesh_result;

sbfi_weight_mesh_result sbfi_weight_mesh_make(
    sbfi_weight_mesh *mesh, const sbfi_weights_input *in, sbfi_arena *arena);

/* A point of asset space in the mesh's units. */
static inline sbfi_d3 sbfi_weight_mesh_position(const sbfi_weight_mesh *mesh, sbf_vec3 point) {
  return sbfi_d3_scale(sbfi_d3_sub(sbfi_d3_of(point), mesh->low), mesh->scale);
}

/* All triangles as a polygon mesh over all sites: borrows the mesh's arrays. `sizes` has room for
 * triangle_count numbers, all of them 3. */
sbf_polygon_mesh sbfi_weight_mesh_surface(const sbfi_weight_mesh *mesh, const uint32_t *sizes);

/* One shell alone, over its own sites. False where memory runs out. */
bool sbfi_weight_mesh_shell(const sbfi_weight_mesh *mesh, uint32_t shell, const uint32_t *sizes,
    sbf_polygon_mesh *surface, sbfi_arena *arena);

#endif
