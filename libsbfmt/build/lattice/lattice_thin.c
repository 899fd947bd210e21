#include "build/lattice/lattice_thin.h"

#include <math.h>

#include "build/geometry/triangle_tree.h"
#include "mechanics/vector.h"
#include "sbfmt/mechanics.h"

enum { MAX_SAMPLES = 2000 };

/* Distance along `direction` (a unit vector) from `from` to the triangle's plane. */
static double distance_to(
    const sbfi_triangle_tree *tree, uint32_t triangle, sbfi_d3 from, sbfi_d3 direction) {
  sbfi_d3 c[3];
  for (int k = 0; k < 3; k++) c[k] = sbfi_d3_of(tree->positions[tree->triangles[triangle].points[k]]);
  sbfi_d3 normal = sbfi_d3_cross(sbfi_d3_sub(c[1], c[0]), sbfi_d3_sub(c[2], c[0]));
  double slope = sbfi_d3_dot(normal, direction);
  return slope != 0 ? sbfi_d3_dot(normal, sbfi_d3_sub(c[0], from)) / slope : INFINITY;
}

bool sbfi_lattice_thinness(
    sbfi_thinness *thinness, const sbf_polygon_mesh *mesh, double limit, sbfi_arena *scratch) {
  uint32_t count = mesh->positions.count, stride = count / MAX_SAMPLES + 1;
  sbfi_triangle_tree tree;
  *thinness = (sbfi_thinness){.min = INFINITY};
  sbf_vec3 *normals = sbfi_arena_allocate(scratch, (size_t)count + 1, sizeof *normals);
  if (!normals || !sbfi_triangle_tree_build(&tree, mesh, scratch)) return false;
  sbf_surface_point_normals(mesh, normals);
  for (uint32_t i = 0; i < count; i += stride) {
    sbfi_d3 inwards = sbfi_d3_scale(sbfi_d3_of(normals[i]), -1);
    if (!(sbfi_d3_dot(inwards, inwards) > 0.5)) continue;
    /* Slightly inside, to miss the point's own triangles. */
    sbfi_d3 from = sbfi_d3_add(sbfi_d3_of(mesh->positions.at[i]), sbfi_d3_scale(inwards, 1e-3 * limit));
    sbf_vec3 start = sbfi_d3_rounded(from), end = sbfi_d3_rounded(sbfi_d3_add(from, inwards));
    /* Farther hits are neither thin nor the minimum. */
    uint32_t hits = sbfi_triangle_tree_pierced(&tree, start, end, fmax(limit, thinness->min));
    thinness->sample_count++;
    if (hits == UINT32_MAX) continue;
    double travel = distance_to(&tree, hits, from, inwards) + 1e-3 * limit;
    if (!(travel > 0)) continue;
    if (travel < thinness->min) thinness->min = travel;
    thinness->thin_count += travel < limit;
  }
  return true;
}
