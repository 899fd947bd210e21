/* Nearest points on triangles, and ray intersection. */
#ifndef SBRI_TRIANGLE_H
#define SBRI_TRIANGLE_H

#include "math/vec3.h"

/* Weights of the corners, with sum 1, of the point on a triangle that is nearest to x (by the regions of its
 * edges and corners; C. Ericson, Real-Time Collision Detection, 2005, 5.1.5). */
static inline void sbri_triangle_find_nearest(
    sbf_vec3 x, sbf_vec3 a, sbf_vec3 b, sbf_vec3 c, float weights[3]) {
  sbf_vec3 ab = sbri_sub(b, a), ac = sbri_sub(c, a), from_a = sbri_sub(x, a), from_b = sbri_sub(x, b),
           from_c = sbri_sub(x, c);
  float a1 = sbri_dot(ab, from_a), a2 = sbri_dot(ac, from_a), b1 = sbri_dot(ab, from_b),
        b2 = sbri_dot(ac, from_b), c1 = sbri_dot(ab, from_c), c2 = sbri_dot(ac, from_c);
  float wc = a1 * b2 - b1 * a2, wb = c1 * a2 - a1 * c2, wa = b1 * c2 - c1 * b2, t;
  weights[0] = weights[1] = weights[2] = 0;
  if (a1 <= 0 && a2 <= 0) {
    weights[0] = 1;
  } else if (b1 >= 0 && b2 <= b1) {
    weights[1] = 1;
  } else if (c2 >= 0 && c1 <= c2) {
    weights[2] = 1;
  } else if (wc <= 0 && a1 >= 0 && b1 <= 0) {
    t = a1 / (a1 - b1);
    weights[0] = 1 - t, weights[1] = t;
  } else if (wb <= 0 && a2 >= 0 && c2 <= 0) {
    t = a2 / (a2 - c2);
    weights[0] = 1 - t, weights[2] = t;
  } else if (wa <= 0 && b2 - b1 >= 0 && c1 - c2 >= 0) {
    t = (b2 - b1) / ((b2 - b1) + (c1 - c2));
    weights[1] = 1 - t, weights[2] = t;
  } else {
    float sum = wa + wb + wc, s = sum > 0 ? 1 / sum : 0;
    weights[0] = wa * s, weights[1] = wb * s, weights[2] = wc * s;
    if (!(sum > 0)) weights[0] = 1;
  }
}

static inline sbf_vec3 sbri_triangle_point(const float weights[3], sbf_vec3 a, sbf_vec3 b, sbf_vec3 c) {
  return sbri_add_scaled(sbri_add_scaled(sbri_scale(a, weights[0]), b, weights[1]), c, weights[2]);
}

/* The t in 0..1 at which from + t displacement crosses the triangle, from either side; negative: none (T.
 * Möller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997). */
static inline float sbri_triangle_cross(
    sbf_vec3 from, sbf_vec3 displacement, sbf_vec3 a, sbf_vec3 b, sbf_vec3 c) {
  sbf_vec3 ab = sbri_sub(b, a), ac = sbri_sub(c, a), p = sbri_cross(displacement, ac),
           off = sbri_sub(from, a);
  float area = sbri_dot(ab, p);
  if (area == 0) return -1;
  float s = 1 / area, u = sbri_dot(off, p) * s;
  sbf_vec3 q = sbri_cross(off, ab);
  float v = sbri_dot(displacement, q) * s, t = sbri_dot(ac, q) * s;
  const float edge = -1e-5f; /* nothing passes between two triangles */
  return u < edge || v < edge || u + v > 1 - edge || t < 0 || t > 1 ? -1 : t;
}

#endif
