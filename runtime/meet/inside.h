/* What of two bodies with closed surfaces lies inside of the other: vertices, and of surfaces so coarse that
 * none does, stretches of their edges. */
#ifndef SBRI_INSIDE_H
#define SBRI_INSIDE_H

#include "meet/finding.h"

enum { SBRI_INNER_EDGES = 128, SBRI_INNER_SETS = 32 + SBRI_INNER_EDGES };
#define SBRI_NOWHERE UINT32_MAX    /* no set, no knot */
#define SBRI_NOT_INSIDE UINT32_MAX /* in a surface's `inside`, whose other entries are parents in sets */
/* Marks features of edges; vertices have less, rims of sheets the bit above. */
#define SBRI_EDGE_FEATURE 0x40000000u

/* Vertices of a surface that hang together, or a stretch of an edge. */
typedef struct sbri_inner_set {
  uint32_t root, side; /* lowest vertex, or SBRI_NOWHERE; 0: of the first, in the second, or 1 */
  uint32_t knot;       /* the first set of those that lie about each other */
  sbri_box box;
  uint32_t count;
} sbri_inner_set;

/* The middle of the stretch of an edge that is inside. */
typedef struct sbri_inner_edge {
  uint32_t set, ends[2], feature;
  float share;        /* from the first end on */
  bool alone;         /* both ends are outside */
  sbf_vec3 at, along; /* and the edge's direction, unit */
  float length;       /* m of the edge */
} sbri_inner_edge;

typedef struct sbri_inside {
  const sbri_party *parties[2];
  sbri_inner_set sets[SBRI_INNER_SETS];
  uint32_t set_count;
  sbri_inner_edge edges[SBRI_INNER_EDGES];
  uint32_t edge_count;
} sbri_inside;

/* Whether both are limbs, and so coarse that edges of each may lie in the other without their ends. */
bool sbri_are_coarse(const sbri_party *a, const sbri_party *b);
/* Whether some edge of the one goes through the other. */
bool sbri_edges_go_through(const sbri_meet_surface *a, const sbri_meet_surface *b);
/* Fills in all but the parties. */
void sbri_inside_look(sbri_inside *in);
/* The knot of a vertex; what else has a feature is of an edge, or nowhere. */
uint32_t sbri_knot_of(const sbri_inside *in, uint32_t side, uint32_t feature);

static inline uint32_t sbri_knot_of_edge(const sbri_inside *in, const sbri_inner_edge *e) {
  return in->sets[e->set].knot;
}
static inline uint32_t sbri_side_of_edge(const sbri_inside *in, const sbri_inner_edge *e) {
  return in->sets[e->set].side;
}

#endif
