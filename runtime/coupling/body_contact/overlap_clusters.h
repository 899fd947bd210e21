/* Parts of two closed surfaces that lie inside of each other: vertices and, of surfaces too coarse for that,
 * spans of edges. */
#ifndef SBRI_OVERLAP_CLUSTERS_H
#define SBRI_OVERLAP_CLUSTERS_H

#include "coupling/body_contact/narrow_phase.h"

enum { SBRI_OVERLAP_EDGES = 128, SBRI_OVERLAP_SETS = 32 + SBRI_OVERLAP_EDGES };
#define SBRI_NO_CLUSTER UINT32_MAX /* no set, no cluster */
#define SBRI_VERTEX_OUTSIDE                                                                                  \
  UINT32_MAX /* entry of `inside_parents`; other entries are parents in disjoint sets */
/* Marks features of edges. Features of vertices are less; those of sheet edges have the next higher bit. */
#define SBRI_EDGE_FEATURE 0x40000000u

/* Connected vertices of a surface, or one span of an edge. */
typedef struct sbri_overlap_set {
  uint32_t root, side; /* root: lowest vertex, or SBRI_NO_CLUSTER for an edge; side: body 0 or 1 */
  uint32_t cluster;    /* lowest set of its cluster */
  sbri_box box;
  uint32_t count;
} sbri_overlap_set;

/* Middle of the part of an edge that is inside of the other body. */
typedef struct sbri_overlap_edge {
  uint32_t set, ends[2], feature;
  float fraction;               /* position along the edge, 0..1 */
  bool both_ends_outside;       /* both ends are outside of the other body */
  sbf_vec3 position, direction; /* middle; unit direction */
  float length;                 /* of the edge, m */
} sbri_overlap_edge;

typedef struct sbri_overlap {
  const sbri_pair_body *bodies[2];
  sbri_overlap_set sets[SBRI_OVERLAP_SETS];
  uint32_t set_count;
  sbri_overlap_edge edges[SBRI_OVERLAP_EDGES];
  uint32_t edge_count;
} sbri_overlap;

/* Whether both are long and so coarse that edges can pass through the other without a vertex inside. */
bool sbri_are_coarse_limbs(const sbri_pair_body *a, const sbri_pair_body *b);
/* Whether an edge of one surface crosses the other surface. */
bool sbri_edges_intersect(const sbri_contact_surface *a, const sbri_contact_surface *b);
/* Fills in all but the bodies. */
void sbri_overlap_update(sbri_overlap *overlap);
/* Cluster of a vertex or edge feature, or SBRI_NO_CLUSTER. */
uint32_t sbri_cluster_of_feature(const sbri_overlap *overlap, uint32_t side, uint32_t feature);

static inline uint32_t sbri_cluster_of_edge(const sbri_overlap *overlap, const sbri_overlap_edge *e) {
  return overlap->sets[e->set].cluster;
}
static inline uint32_t sbri_side_of_edge(const sbri_overlap *overlap, const sbri_overlap_edge *e) {
  return overlap->sets[e->set].side;
}

#endif
