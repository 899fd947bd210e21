/* Tetrahedra for the inside of a surface: isosurface stuffing (Labelle, Shewchuk, SIGGRAPH 2007).
 *
 * Tetrahedra of the body-centred grid fill the inside; at the surface nodes are warped onto it or tetrahedra
 * cut at it, so that the dihedral angles are between 10 and 165 degrees for any surface. */
#ifndef SBFI_LATTICE_STUFFING_H
#define SBFI_LATTICE_STUFFING_H

#include "base/memory.h"
#include "build/lattice/lattice_grid.h"
#include "sbfmt/base.h"

/* Edges with one end inside and one outside, and their cuts by the surface. */
typedef struct sbfi_lattice_cuts {
  uint32_t *edges;  /* (slot_count) 8 * node + index, as in lattice_crossings.h; UINT32_MAX: free */
  float *fractions; /* (slot_count) position from the edge's owner, 0..1 */
  uint32_t *points; /* (slot_count) their points, for internal use */
  size_t slot_count, count;
} sbfi_lattice_cuts;

/* Finds these edges, by bit 0 of `inside`; all fractions are -1. Memory of `arena`; returns false if it runs
 * out. */
bool sbfi_lattice_cuts_find(
    sbfi_lattice_cuts *cuts, const sbfi_lattice_grid *grid, const uint8_t *inside, sbfi_arena *arena);

/* Fraction of an edge in that direction, from a node, within which a cut warps the node, slightly enlarged.
 */
double sbfi_lattice_min_fraction(int direction);

/* The edge's slot, or the one for it. */
size_t sbfi_lattice_cuts_slot(const sbfi_lattice_cuts *cuts, uint32_t edge);

typedef struct sbfi_tetrahedra {
  sbf_vec3 *positions; /* (point_count), each in at least one tetrahedron */
  sbf_uint4 *at;       /* (count) with positive volume, without duplicates */
  uint32_t point_count, count;
  uint32_t flat_count; /* dropped: not representable in single precision so far from the origin */
} sbfi_tetrahedra;

/* State of a node: a node inside has all the tetrahedra around it that reach so far. */
enum { SBFI_LATTICE_NODE_OUTSIDE, SBFI_LATTICE_NODE_INSIDE, SBFI_LATTICE_NODE_ON };

/* Fills `*made`; `inside` is 1 or 0, and receives the states of the nodes. Nodes next to the grid's border
 * must be outside. Points and tetrahedra are in the order of the grid. Memory of `arena`, scratch memory of
 * `scratch`; returns false if either runs out, or there are 2^32 / 8 tetrahedra. */
bool sbfi_lattice_stuff(const sbfi_lattice_grid *grid, uint8_t *inside, sbfi_lattice_cuts *cuts,
    sbfi_tetrahedra *made, sbfi_arena *arena, sbfi_arena *scratch);

#endif
