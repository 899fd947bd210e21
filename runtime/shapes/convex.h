/* Distance between convex shapes, and time of impact of a linear motion.
 *
 * A shape is the convex hull of points, enlarged by a radius: a sphere has one point, a capsule two, a
 * triangle three. Computed in double precision. */
#ifndef SBRI_CONVEX_H
#define SBRI_CONVEX_H

#include "mechanics/vector.h"

typedef struct sbri_convex {
  const sbf_vec3 *points; /* (count) in the shape's frame */
  uint32_t count;
  sbfi_d3 axes[3]; /* of its frame, scaled */
  sbfi_d3 position;
  double radius;
} sbri_convex;

/* Sets position and axes from a rotation and a scale. */
void sbri_convex_set_frame(sbri_convex *convex, sbfi_d3 position, sbf_quat rotation, double scale);

static inline sbfi_d3 sbri_convex_point(const sbri_convex *c, uint32_t i) {
  const sbf_vec3 *p = &c->points[i];
  sbfi_d3 x = sbfi_d3_add(c->position, sbfi_d3_scale(c->axes[0], (double)p->x));
  return sbfi_d3_add(
      x, sbfi_d3_add(sbfi_d3_scale(c->axes[1], (double)p->y), sbfi_d3_scale(c->axes[2], (double)p->z)));
}

typedef struct sbri_closest {
  double distance; /* between the surfaces; below 0 if they overlap: then only the sign is valid */
  sbfi_d3 normal;  /* unit, from b to a; 0 if the hulls of the points overlap */
  sbfi_d3 on_b;    /* nearest point of b's surface */
} sbri_closest;

/* Nearest points of `a`, displaced by `offset`, and b (E. Gilbert, D. Johnson, S. Keerthi, A fast procedure
 * for computing the distance between complex objects in three-dimensional space, 1988). */
sbri_closest sbri_convex_distance(const sbri_convex *a, sbfi_d3 offset, const sbri_convex *b);

/* Fraction of `displacement`, 0 to 1, at which `a` touches b, by conservative advancement; above 1: never. 0
 * with normal 0 if they overlap at the beginning. */
double sbri_convex_cast(
    const sbri_convex *a, sbfi_d3 displacement, const sbri_convex *b, sbri_closest *contact);

#endif
