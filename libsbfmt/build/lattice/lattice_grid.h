/* A body-centred cubic grid: corners and centres of cubes.
 *
 * Nodes have integer coordinates, two per cube edge: all even at corners, all odd at centres. Each node owns
 * seven of its fourteen edges: three long ones (one cube edge) along the axes, and four short ones (sqrt(3)/2
 * of that) to the nodes one step further along z. */
#ifndef SBFI_LATTICE_GRID_H
#define SBFI_LATTICE_GRID_H

#include "mechanics/vector.h"

enum { SBFI_LATTICE_EDGES = 7, SBFI_LATTICE_LONG_EDGES = 3 };

/* The four directions of the short edges in x and y; all have positive z. */
extern const int sbfi_lattice_directions[SBFI_LATTICE_EDGES][3];

typedef struct sbfi_lattice_grid {
  double cell;         /* m, a cube's edge */
  sbfi_d3 origin;      /* m, of the node (0, 0, 0) */
  uint32_t counts[3];  /* number of corners along each axis; as many centres */
  uint32_t node_count; /* below 2^28 */
  /* Offset of a node's index to the other end of edge k; [0] from a corner, [1] from a centre. Every node at
   * least two cubes from the border has all fourteen edges. */
  int32_t steps[2][SBFI_LATTICE_EDGES];
} sbfi_lattice_grid;

/* Fits a grid around the box: its cubes fill the box if its edges are multiples of `cell`, else they extend
 * equally on both sides, with two to three more cubes around. Returns false if it would have 2^28 nodes or
 * more. */
bool sbfi_lattice_grid_fit(sbfi_lattice_grid *grid, sbfi_d3 low, sbfi_d3 high, double cell);

/* Nodes are ordered by rows along x, alternating rows of corners and of centres. */
static inline uint32_t sbfi_lattice_row(const sbfi_lattice_grid *g, int32_t y, int32_t z) {
  return 2 * (((uint32_t)z >> 1) * g->counts[1] + ((uint32_t)y >> 1)) + ((uint32_t)z & 1);
}
static inline uint32_t sbfi_lattice_node(const sbfi_lattice_grid *g, int32_t x, int32_t y, int32_t z) {
  return sbfi_lattice_row(g, y, z) * g->counts[0] + ((uint32_t)x >> 1);
}
void sbfi_lattice_compute_coordinates(const sbfi_lattice_grid *grid, uint32_t node, int32_t at[3]);

/* Corner (0) or centre (1). */
static inline uint32_t sbfi_lattice_kind(const sbfi_lattice_grid *g, uint32_t node) {
  return node / g->counts[0] & 1;
}

/* The other end of a node's edge: 0 to 6 are its own, 7 to 13 the opposite ones of other nodes. */
static inline uint32_t sbfi_lattice_neighbour(const sbfi_lattice_grid *g, uint32_t node, int edge) {
  uint32_t kind = sbfi_lattice_kind(g, node);
  if (edge < SBFI_LATTICE_EDGES) return (uint32_t)((int64_t)node + g->steps[kind][edge]);
  edge -= SBFI_LATTICE_EDGES;
  return (uint32_t)((int64_t)node - g->steps[edge < SBFI_LATTICE_LONG_EDGES ? kind : !kind][edge]);
}

static inline sbfi_d3 sbfi_lattice_position(const sbfi_lattice_grid *g, sbfi_d3 coordinates) {
  return sbfi_d3_add(g->origin, sbfi_d3_scale(coordinates, g->cell / 2));
}

#endif
