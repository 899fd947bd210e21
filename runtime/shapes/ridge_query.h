/* Contact of two convex edges of closed surfaces within a tick. `distance` is below 0 if they have passed
 * each other; the normal still points outwards.
 *
 * The cross product of two edges separates two solids only if each is locally on its own side: the arcs of
 * the normals at the edges intersect (D. Gregorius, The Separating Axis Test between Convex Polyhedra, 2013).
 * Here the third corners of the adjacent triangles decide this. In addition, no face may be a shorter exit.
 */
#ifndef SBRI_RIDGE_QUERY_H
#define SBRI_RIDGE_QUERY_H

#include "shapes/edge_query.h"

/* Tolerance of the side test, as a sine. */
#define SBRI_RIDGE_FLAT 0.2f
/* Factor on the exit distance over a face: if it is still shorter than that over the edges, the face handles
 * the contact. Edge contacts with less penetration than the second value (m) are always valid. */
#define SBRI_RIDGE_NEARER 1.1f
#define SBRI_RIDGE_ON_IT_M 1e-4f

/* The edge as in one triangle, and the third corners of that one and of the other. */
typedef struct sbri_soft_ridge {
  sbri_soft_edge edge;
  sbf_vec3 wings[2];
} sbri_soft_ridge;

/* Sines of the angles between the adjacent triangles and the plane of n. */
static inline void sbri_ridge_find_sides(const sbri_soft_ridge *r, sbf_vec3 n, float sines[2]) {
  sbf_vec3 direction = sbri_sub(r->edge.at[1], r->edge.at[0]);
  for (int k = 0; k < 2; k++) {
    sbf_vec3 offset = sbri_sub(r->wings[k], r->edge.at[0]);
    offset =
        sbri_add_scaled(offset, direction, -sbri_dot(offset, direction) / sbri_dot(direction, direction));
    sines[k] = sbri_dot(sbri_normalize(offset, n), n);
  }
}

/* Orients the normal outwards. Returns whether it separates the two solids. */
static inline bool sbri_ridges_face(const sbri_soft_ridge *p, const sbri_soft_ridge *q, sbri_edge_hit *to) {
  float p_sines[2], q_sines[2];
  sbri_ridge_find_sides(p, to->normal, p_sines);
  sbri_ridge_find_sides(q, to->normal, q_sines);
  bool is_inverted = p_sines[0] + p_sines[1] < q_sines[0] + q_sines[1];
  float sign = is_inverted ? -1 : 1;
  if (is_inverted) to->normal = sbri_scale(to->normal, -1), to->distance = -to->distance;
  for (int k = 0; k < 2; k++)
    if (sign * p_sines[k] < -SBRI_RIDGE_FLAT || sign * q_sines[k] > SBRI_RIDGE_FLAT) return false;
  return true;
}

/* Displacement of the edge to leave by the nearer face of the ridge, m. */
static inline float sbri_ridge_depth(const sbri_soft_ridge *r, const sbri_soft_edge *edge) {
  float min = INFINITY;
  sbf_vec3 direction = sbri_sub(r->edge.at[1], r->edge.at[0]);
  for (int k = 0; k < 2; k++) {
    sbf_vec3 offset = sbri_sub(r->wings[k], r->edge.at[0]);
    sbf_vec3 normal = k ? sbri_cross(offset, direction) : sbri_cross(direction, offset);
    normal = sbri_normalize(normal, offset);
    float one = sbri_dot(normal, sbri_sub(r->edge.at[0], edge->at[0])),
          q_sines = sbri_dot(normal, sbri_sub(r->edge.at[0], edge->at[1]));
    float depth = one > q_sines ? one : q_sines;
    min = depth < min ? depth : min;
  }
  return min;
}

/* Whether they touch within the tick, come closer than `outer`, or have passed each other by at most `inner`.
 */
static inline bool sbri_ridges_query(
    const sbri_soft_ridge *p, const sbri_soft_ridge *q, float outer, float inner, sbri_edge_hit *to) {
  if (!sbri_edges_cross(&p->edge, &q->edge, to) || !sbri_ridges_face(p, q, to)) return false;
  if (to->distance < -inner || !sbri_edges_contact(&p->edge, &q->edge, outer, to)) return false;
  if (to->distance >= -SBRI_RIDGE_ON_IT_M) return true;
  float max = SBRI_RIDGE_NEARER * fminf(sbri_ridge_depth(p, &q->edge), sbri_ridge_depth(q, &p->edge));
  return -to->distance <= max;
}

#endif
