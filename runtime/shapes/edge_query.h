/* Contact of two edges of soft surfaces within a tick: whether they approach or pass each other, crossing
 * within their ends. Each edge stays on its side at the beginning of the tick. */
#ifndef SBRI_EDGE_QUERY_H
#define SBRI_EDGE_QUERY_H

#include "math/vec3.h"

/* Squared sine of the angle below which edges count as parallel: their ends collide with faces. */
#define SBRI_PARALLEL 1e-3f

/* Ends and their displacements in the tick. */
typedef struct sbri_soft_edge {
  sbf_vec3 at[2], directions[2];
} sbri_soft_edge;

typedef struct sbri_edge_hit {
  float fractions[2]; /* position of the crossing on each edge, from its first end */
  sbf_vec3 normal;    /* unit, from the second to the first */
  float distance;     /* m along the normal, at the beginning of the tick */
} sbri_edge_hit;

/* Nearest points of two lines, as fractions; false if they are parallel. */
static inline bool sbri_lines_cross(const sbf_vec3 p[2], const sbf_vec3 q[2], float fractions[2]) {
  sbf_vec3 u = sbri_sub(p[1], p[0]), v = sbri_sub(q[1], q[0]), offset = sbri_sub(p[0], q[0]);
  float a = sbri_dot(u, u), b = sbri_dot(u, v), c = sbri_dot(v, v), d = sbri_dot(u, offset),
        e = sbri_dot(v, offset);
  float determinant = a * c - b * b;
  if (!(determinant > SBRI_PARALLEL * a * c)) return false;
  fractions[0] = (b * e - c * d) / determinant, fractions[1] = (a * e - b * d) / determinant;
  return true;
}

/* Common normal, and distance along it. The normal points to the first edge. */
static inline bool sbri_edges_cross(const sbri_soft_edge *p, const sbri_soft_edge *q, sbri_edge_hit *to) {
  if (!sbri_lines_cross(p->at, q->at, to->fractions)) return false;
  sbf_vec3 n = sbri_cross(sbri_sub(p->at[1], p->at[0]), sbri_sub(q->at[1], q->at[0]));
  n = sbri_scale(n, 1 / sbri_length(n));
  to->distance = sbri_dot(n, sbri_sub(p->at[0], q->at[0]));
  if (to->distance < 0) n = sbri_scale(n, -1), to->distance = -to->distance;
  to->normal = n;
  return true;
}

/* Whether two edges in this relative position touch within the tick, or come closer than `outer`. */
static inline bool sbri_edges_contact(
    const sbri_soft_edge *p, const sbri_soft_edge *q, float outer, sbri_edge_hit *to) {
  /* The crossing may be outside the edges now, so it is tested at the time of contact. */
  sbf_vec3 displacement =
      sbri_sub(sbri_lerp(p->directions[0], p->directions[1], sbri_clamp(to->fractions[0], 0, 1)),
          sbri_lerp(q->directions[0], q->directions[1], sbri_clamp(to->fractions[1], 0, 1)));
  float closing = -sbri_dot(to->normal, displacement);
  if (to->distance - (closing > 0 ? 2 * closing : 0) >= outer) return false;
  if (closing > 0 && to->distance >= 0) {
    float contact_time = to->distance < closing ? to->distance / closing : 1;
    sbf_vec3 ends[2][2];
    for (int k = 0; k < 2; k++) {
      ends[0][k] = sbri_add_scaled(p->at[k], p->directions[k], contact_time);
      ends[1][k] = sbri_add_scaled(q->at[k], q->directions[k], contact_time);
    }
    if (!sbri_lines_cross(ends[0], ends[1], to->fractions)) return false;
  }
  return to->fractions[0] >= 0 && to->fractions[0] <= 1 && to->fractions[1] >= 0 && to->fractions[1] <= 1;
}

/* Whether they touch within the tick, or come closer than `outer`. */
static inline bool sbri_edges_query(
    const sbri_soft_edge *p, const sbri_soft_edge *q, float outer, sbri_edge_hit *to) {
  return sbri_edges_cross(p, q, to) && sbri_edges_contact(p, q, outer, to);
}

#endif
