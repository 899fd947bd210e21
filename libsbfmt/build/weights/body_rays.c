#include "build/weights/body_rays.h"

/* Maximum number of surfaces to pass on the way out; offset behind one at which the search continues. */
enum { MAX_PASSED = 32 };
static const double STEP = 1e-5;

bool sbfi_body_rays_make(sbfi_body_rays *rays, const sbf_polygon_mesh *surface, sbfi_arena *arena) {
  return sbfi_triangle_tree_build(&rays->tree, surface, arena) &&
         sbfi_soup_make(&rays->soup, surface, arena) && sbfi_winding_make(&rays->winding, &rays->soup, arena);
}

bool sbfi_body_contains(const sbfi_body_rays *rays, sbfi_d3 point) {
  int closed = sbfi_winding_of_closed(&rays->winding, point);
  if (!rays->soup.cap_count) return closed != 0;
  return sbfi_winding_inside(closed, sbfi_winding_of_caps(&rays->winding, point));
}

/* Distance to the first surface ahead and its triangle; INFINITY and UINT32_MAX if there is none. */
static double first_hit(const sbfi_triangle_tree *tree, sbfi_d3 from, sbfi_d3 direction, uint32_t *hit) {
  sbf_vec3 origin = sbfi_d3_rounded(from), through = sbfi_d3_rounded(sbfi_d3_add(from, direction));
  uint32_t triangle = sbfi_triangle_tree_pierced(tree, origin, through, 1e3);
  *hit = triangle;
  if (triangle == UINT32_MAX) return INFINITY;
  const uint32_t *c = tree->triangles[triangle].points;
  sbfi_d3 a = sbfi_d3_of(tree->positions[c[0]]);
  sbfi_d3 normal = sbfi_d3_cross(
      sbfi_d3_sub(sbfi_d3_of(tree->positions[c[1]]), a), sbfi_d3_sub(sbfi_d3_of(tree->positions[c[2]]), a));
  double speed = sbfi_d3_dot(direction, normal);
  double t = speed != 0 ? sbfi_d3_dot(sbfi_d3_sub(a, from), normal) / speed : 0;
  return t > 0 ? t : 0;
}

double sbfi_body_exit_distance(const sbfi_body_rays *rays, sbfi_d3 from, sbfi_d3 direction) {
  uint32_t hit;
  double travel = first_hit(&rays->tree, from, direction, &hit);
  if (!isfinite(travel) || !sbfi_body_contains(rays, from)) return travel;
  for (int passed = 0; passed < MAX_PASSED; passed++) {
    sbfi_d3 behind = sbfi_d3_add(from, sbfi_d3_scale(direction, travel + STEP));
    double next = first_hit(&rays->tree, behind, direction, &hit);
    sbfi_d3 between = sbfi_d3_add(behind, sbfi_d3_scale(direction, next / 2));
    if (!isfinite(next) || (next > STEP && !sbfi_body_contains(rays, between))) break;
    travel += STEP + next;
  }
  return travel;
}

/* Number of crossings of a ray with a shell, and the first one. */
typedef struct shell_crossing {
  uint32_t shell, count;
  double first;
} shell_crossing;

static double shell_end(
    const sbfi_body_rays *rays, const sbfi_weight_mesh *mesh, sbfi_d3 from, sbfi_d3 direction) {
  shell_crossing shells[MAX_PASSED];
  int count = 0;
  double travel = 0, nearest = INFINITY, end = 0;
  for (int passed = 0; passed < MAX_PASSED; passed++) {
    uint32_t hit;
    travel += first_hit(&rays->tree, sbfi_d3_add(from, sbfi_d3_scale(direction, travel)), direction, &hit);
    if (hit == UINT32_MAX) break;
    uint32_t shell = mesh->shell_of_site[rays->tree.triangles[hit].points[0]];
    int k = 0;
    while (k < count && shells[k].shell != shell) k++;
    if (k == count) shells[count++] = (shell_crossing){shell, 0, travel};
    shells[k].count++;
    nearest = fmin(nearest, travel);
    travel += STEP;
  }
  /* Inside shells with an odd number of crossings. */
  for (int k = 0; k < count; k++)
    if (shells[k].count % 2) end = fmax(end, shells[k].first);
  return end > 0 ? end : nearest;
}

double sbfi_body_shell_end(
    const sbfi_body_rays *rays, const sbfi_weight_mesh *mesh, sbfi_d3 from, sbfi_d3 direction) {
  /* Bones in a plane of symmetry point at edges, where a ray may slip through. */
  static const double tilts[][3] = {{0, 0, 0}, {0.011, 0.007, 0.005}, {-0.011, 0.005, -0.007}};
  double end = INFINITY;
  for (size_t i = 0; i < sizeof tilts / sizeof *tilts && !isfinite(end); i++) {
    sbfi_d3 tilted = sbfi_d3_add(direction, (sbfi_d3){tilts[i][0], tilts[i][1], tilts[i][2]});
    end = shell_end(rays, mesh, from, sbfi_d3_normal(tilted));
  }
  return end;
}
