/* Contact of two convex edges of closed surfaces within a tick. `distance` is below 0 where they have passed
 * each other; the normal still points outwards.
 *
 * The cross product of two edges separates two solids only if each lies locally on its own side: the arcs of
 * the normals at the edges intersect (D. Gregorius, The Separating Axis Test between Convex Polyhedra, 2013),
 * decided here by the third corners of the adjacent triangles. And only if no face is a shorter way out. */
#ifndef SBRI_RIDGE_QUERY_H
#define SBRI_RIDGE_QUERY_H

#include "collide/edge_query.h"

/* Beyond what is across both by less than this (a sine) is on it. */
#define SBRI_RIDGE_FLAT 0.2f
/* A face that both edges are so many times nearer to, and at least this far from (m), handles the contact. */
#define SBRI_RIDGE_NEARER 1.1f
#define SBRI_RIDGE_ON_IT_M 1e-4f

/* Its edge as the one triangle has it, and the third corners: of that one, then of the other. */
typedef struct sbri_soft_ridge {
  sbri_soft_edge edge;
  sbf_vec3 wings[2];
} sbri_soft_ridge;

/* Sines of the angles of the adjacent triangles towards n. */
static inline void sbri_ridge_find_sides(const sbri_soft_ridge *r, sbf_vec3 n, float sines[2]) {
  sbf_vec3 along = sbri_sub(r->edge.at[1], r->edge.at[0]);
  for (int k = 0; k < 2; k++) {
    sbf_vec3 off = sbri_sub(r->wings[k], r->edge.at[0]);
    off = sbri_add_scaled(off, along, -sbri_dot(off, along) / sbri_dot(along, along));
    sines[k] = sbri_dot(sbri_normalize(off, n), n);
  }
}

/* Turns the normal outwards; whether it parts them. */
static inline bool sbri_ridges_face(const sbri_soft_ridge *p, const sbri_soft_ridge *q, sbri_edge_hit *to) {
  float own[2], other[2];
  sbri_ridge_find_sides(p, to->normal, own);
  sbri_ridge_find_sides(q, to->normal, other);
  bool turns = own[0] + own[1] < other[0] + other[1];
  float sign = turns ? -1 : 1;
  if (turns) to->normal = sbri_scale(to->normal, -1), to->distance = -to->distance;
  for (int k = 0; k < 2; k++)
    if (sign * own[k] < -SBRI_RIDGE_FLAT || sign * other[k] > SBRI_RIDGE_FLAT) return false;
  return true;
}

/* m that the edge would have to go to be out by the nearer one of the ridge's faces. */
static inline float sbri_ridge_depth(const sbri_soft_ridge *r, const sbri_soft_edge *edge) {
  float min = INFINITY;
  sbf_vec3 along = sbri_sub(r->edge.at[1], r->edge.at[0]);
  for (int k = 0; k < 2; k++) {
    sbf_vec3 off = sbri_sub(r->wings[k], r->edge.at[0]);
    sbf_vec3 out = k ? sbri_cross(off, along) : sbri_cross(along, off);
    out = sbri_normalize(out, off);
    float one = sbri_dot(out, sbri_sub(r->edge.at[0], edge->at[0])),
          other = sbri_dot(out, sbri_sub(r->edge.at[0], edge->at[1]));
    float depth = one > other ? one : other;
    min = depth < min ? depth : min;
  }
  return min;
}

/* Whether they touch within the tick, come as near as `outer`, or are past each other by no more than
 * `inner`.
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
