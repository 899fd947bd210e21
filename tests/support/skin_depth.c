#include "skin_depth.h"

#include <math.h>

#include "shapes/triangle.h"

static double dot(sbf_vec3 a, sbf_vec3 b) {
  return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Of the triangle seen from x, by A. van Oosterom and J. Strackee, 1983. */
static double solid_angle(sbf_vec3 x, sbf_vec3 a, sbf_vec3 b, sbf_vec3 c) {
  a = sbri_sub(a, x), b = sbri_sub(b, x), c = sbri_sub(c, x);
  double la = sqrt(dot(a, a)), lb = sqrt(dot(b, b)), lc = sqrt(dot(c, c));
  return 2 * atan2(dot(a, sbri_cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

double skin_depth(const sbf_polygon_mesh *mesh, const sbf_vec3 *at, sbf_vec3 x, uint32_t own) {
  const uint32_t *c = mesh->polygon_points.at;
  double angle = 0, nearest = 1e9;
  for (uint32_t p = 0; p < mesh->polygon_sizes.count; c += mesh->polygon_sizes.at[p++])
    for (uint32_t k = 2; k < mesh->polygon_sizes.at[p]; k++) {
      const sbf_vec3 t[3] = {at[c[0]], at[c[k - 1]], at[c[k]]};
      float weights[3];
      angle += solid_angle(x, t[0], t[1], t[2]);
      if (c[0] == own || c[k - 1] == own || c[k] == own) continue;
      sbri_triangle_find_nearest(x, t[0], t[1], t[2], weights);
      double distance = (double)sbri_length(sbri_sub(x, sbri_triangle_point(weights, t[0], t[1], t[2])));
      if (distance < nearest) nearest = distance;
    }
  return angle / 12.566370614359172 > (own == UINT32_MAX ? 0.5 : 1.5) ? nearest : 0;
}
