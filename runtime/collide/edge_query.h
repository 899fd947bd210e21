/* What two edges of soft surfaces have to do with each other within a tick: whether they come near to each
 * other or go through, each crossing the other's line within its ends. They stay on the sides of each other
 * that they are on when the tick begins. */
#ifndef SBRI_EDGE_QUERY_H
#define SBRI_EDGE_QUERY_H

#include "math/vec3.h"

/* Squared sine of the angle up to which edges count as parallel: their ends collide with faces. */
#define SBRI_PARALLEL 1e-3f

/* Its ends, and how far they go in the tick. */
typedef struct sbri_soft_edge {
  sbf_vec3 at[2], directions[2];
} sbri_soft_edge;

typedef struct sbri_edge_hit {
  float fractions[2]; /* of each edge from its first end on, where they cross */
  sbf_vec3 normal;    /* unit, from the second to the first */
  float distance;     /* m along it, when the tick begins */
} sbri_edge_hit;

/* Nearest places of the two lines, as shares; false where they are parallel. */
static inline bool sbri_lines_cross(const sbf_vec3 p[2], const sbf_vec3 q[2], float fractions[2]) {
  sbf_vec3 u = sbri_sub(p[1], p[0]), v = sbri_sub(q[1], q[0]), off = sbri_sub(p[0], q[0]);
  float a = sbri_dot(u, u), b = sbri_dot(u, v), c = sbri_dot(v, v), d = sbri_dot(u, off),
        e = sbri_dot(v, off);
  float whole = a * c - b * b;
  if (!(whole > SBRI_PARALLEL * a * c)) return false;
  fractions[0] = (b * e - c * d) / whole, fractions[1] = (a * e - b * d) / whole;
  return true;
}

/* What is across both, and how far they are apart along it; the first is on that side. */
static inline bool sbri_edges_cross(const sbri_soft_edge *p, const sbri_soft_edge *q, sbri_edge_hit *to) {
  if (!sbri_lines_cross(p->at, q->at, to->fractions)) return false;
  sbf_vec3 n = sbri_cross(sbri_sub(p->at[1], p->at[0]), sbri_sub(q->at[1], q->at[0]));
  n = sbri_scale(n, 1 / sbri_length(n));
  to->distance = sbri_dot(n, sbri_sub(p->at[0], q->at[0]));
  if (to->distance < 0) n = sbri_scale(n, -1), to->distance = -to->distance;
  to->normal = n;
  return true;
}

/* Whether two edges in this relative position touch within the tick, or come as near as `outer`. */
static inline bool sbri_edges_contact(
    const sbri_soft_edge *p, const sbri_soft_edge *q, float outer, sbri_edge_hit *to) {
  /* Where they cross may lie beside them now: as they are when they have come near. */
  sbf_vec3 displacement =
      sbri_sub(sbri_lerp(p->directions[0], p->directions[1], sbri_clamp(to->fractions[0], 0, 1)),
          sbri_lerp(q->directions[0], q->directions[1], sbri_clamp(to->fractions[1], 0, 1)));
  float closing = -sbri_dot(to->normal, displacement);
  if (to->distance - (closing > 0 ? 2 * closing : 0) >= outer) return false;
  if (closing > 0 && to->distance >= 0) {
    float when = to->distance < closing ? to->distance / closing : 1;
    sbf_vec3 ends[2][2];
    for (int k = 0; k < 2; k++) {
      ends[0][k] = sbri_add_scaled(p->at[k], p->directions[k], when);
      ends[1][k] = sbri_add_scaled(q->at[k], q->directions[k], when);
    }
    if (!sbri_lines_cross(ends[0], ends[1], to->fractions)) return false;
  }
  return to->fractions[0] >= 0 && to->fractions[0] <= 1 && to->fractions[1] >= 0 && to->fractions[1] <= 1;
}

/* Whether they touch within the tick, or come as near as `outer`. */
static inline bool sbri_edges_query(
    const sbri_soft_edge *p, const sbri_soft_edge *q, float outer, sbri_edge_hit *to) {
  return sbri_edges_cross(p, q, to) && sbri_edges_contact(p, q, outer, to);
}

#endif
