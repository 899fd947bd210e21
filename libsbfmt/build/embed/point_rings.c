#include "build/embed/point_rings.h"

static void add_point(sbfi_point_rings *r, uint32_t point) {
  for (uint32_t i = 0; i < r->count; i++)
    if (r->points[i] == point) return;
  if (r->count == SBFI_MAX_RING_POINTS)
    r->full = true;
  else
    r->points[r->count++] = point;
}

static void add_corners(void *user, uint32_t tetrahedron) {
  sbfi_point_rings *r = user;
  for (int k = 0; k < 4; k++) add_point(r, r->finder->tetrahedra[tetrahedron].at[k]);
}

void sbfi_point_rings_begin(
    sbfi_point_rings *rings, const sbfi_tetrahedron_finder *finder, uint32_t tetrahedron) {
  rings->finder = finder;
  rings->count = rings->widened = 0;
  rings->full = false;
  add_corners(rings, tetrahedron);
}

bool sbfi_point_rings_widen(sbfi_point_rings *rings) {
  uint32_t before = rings->count;
  while (rings->widened < before && !rings->full)
    sbfi_find_tetrahedra_about(rings->finder, rings->points[rings->widened++], add_corners, rings);
  return rings->count > before && !rings->full;
}

/* Squared distance up to a common factor: from a point, from the line through two, from the plane of
 * three. */
static double distance2(const sbfi_d3 *from, int count, sbfi_d3 point) {
  sbfi_d3 displacement = sbfi_d3_sub(point, from[0]);
  if (count == 1) return sbfi_d3_dot(displacement, displacement);
  sbfi_d3 off = sbfi_d3_cross(sbfi_d3_sub(from[1], from[0]), displacement);
  if (count == 2) return sbfi_d3_dot(off, off);
  double height = sbfi_d3_dot(off, sbfi_d3_sub(from[2], from[0]));
  return height * height;
}

static uint32_t farthest(const sbfi_point_rings *r, const sbfi_d3 *from, int count) {
  double max = -1;
  uint32_t best = r->points[0];
  for (uint32_t i = 0; i < r->count; i++) {
    double here = distance2(from, count, sbfi_d3_of(r->finder->positions[r->points[i]]));
    /* A tiny difference must not count: the choice would depend on rounding. */
    if (!(here > max * (1 + 1e-6))) continue;
    max = here;
    best = r->points[i];
  }
  return best;
}

void sbfi_point_rings_widest(const sbfi_point_rings *rings, uint32_t four[4]) {
  sbfi_d3 from[4] = {sbfi_d3_of(rings->finder->positions[rings->points[0]])};
  for (int k = 0; k < 4; k++) {
    four[k] = farthest(rings, from, k > 0 ? k : 1);
    from[k] = sbfi_d3_of(rings->finder->positions[four[k]]);
  }
}
