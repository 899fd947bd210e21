/* Recognizes hulls that are boxes, which KHR_implicit_shapes states by their size. */
#include <math.h>

#include "export/glb_rigid.h"
#include "mechanics/vector.h"
#include "motion/quatd.h"

/* Largest deviation from a box, relative to its longest edge. */
static const double TOLERANCE = 1e-5;

static bool is_perpendicular(sbfi_d3 a, sbfi_d3 b) {
  return fabs(sbfi_d3_dot(a, b)) <= TOLERANCE * sbfi_d3_length(a) * sbfi_d3_length(b);
}

/* Whether every corner of the box from `corner` along the edges is a point. */
static bool has_corners(const sbf_vec3 *points, sbfi_d3 corner, const sbfi_d3 edges[3]) {
  double longest = 0;
  for (int k = 0; k < 3; k++) longest = fmax(longest, sbfi_d3_length(edges[k]));
  for (int c = 0; c < 8; c++) {
    sbfi_d3 at = corner;
    bool found = false;
    for (int k = 0; k < 3; k++)
      if (c >> k & 1) at = sbfi_d3_add(at, edges[k]);
    for (int i = 0; i < 8; i++)
      found |= sbfi_d3_length(sbfi_d3_sub(sbfi_d3_of(points[i]), at)) <= TOLERANCE * longest;
    if (!found) return false;
  }
  return true;
}

/* Rotation that brings +X and +Y to the first two edges, whose signs do not matter to a box. */
static sbf_quat rotation_along(const sbfi_d3 edges[3]) {
  sbfi_d3 x = sbfi_d3_normal(edges[0]), y = sbfi_d3_normal(edges[1]);
  const double right[3] = {1, 0, 0}, up[3] = {0, 1, 0};
  double first[4], second[4], turned[3];
  if (x.x < 0) x = sbfi_d3_scale(x, -1);
  sbfi_quatd_between(right, (const double[3]){x.x, x.y, x.z}, first);
  sbfi_quatd_rotate(first, up, turned);
  if (turned[0] * y.x + turned[1] * y.y + turned[2] * y.z < 0) y = sbfi_d3_scale(y, -1);
  sbfi_quatd_between(turned, (const double[3]){y.x, y.y, y.z}, second);
  sbfi_quatd_multiply(second, first, first);
  return (sbf_quat){(float)first[0], (float)first[1], (float)first[2], (float)first[3]};
}

bool sbfi_glb_find_box(const sbf_polygon_mesh *hull, sbfi_glb_box *box) {
  const sbf_vec3 *points = hull->positions.at;
  if (hull->positions.count != 8) return false;
  const sbfi_d3 corner = sbfi_d3_of(points[0]);
  for (int i = 1; i < 8; i++)
    for (int j = i + 1; j < 8; j++)
      for (int k = j + 1; k < 8; k++) {
        const sbfi_d3 edges[3] = {sbfi_d3_sub(sbfi_d3_of(points[i]), corner),
            sbfi_d3_sub(sbfi_d3_of(points[j]), corner), sbfi_d3_sub(sbfi_d3_of(points[k]), corner)};
        if (!is_perpendicular(edges[0], edges[1]) || !is_perpendicular(edges[0], edges[2]) ||
            !is_perpendicular(edges[1], edges[2]) || !has_corners(points, corner, edges))
          continue;
        sbfi_d3 across = sbfi_d3_add(edges[0], sbfi_d3_add(edges[1], edges[2]));
        box->transform.position = sbfi_d3_rounded(sbfi_d3_add(corner, sbfi_d3_scale(across, 0.5)));
        box->transform.rotation = rotation_along(edges);
        for (int a = 0; a < 3; a++) box->size[a] = (float)sbfi_d3_length(edges[a]);
        return box->size[0] > 0 && box->size[1] > 0 && box->size[2] > 0;
      }
  return false;
}
