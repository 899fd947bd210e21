/* Tetrahedra for the inside of a surface: isosurface stuffing (Labelle, Shewchuk, SIGGRAPH 2007).
 *
 * The body-centred grid's own tetrahedra fill the inside; at the surface nodes are warped onto it or
 * tetrahedra cut at it, so that the dihedral angles stay between 10 and 165 degrees, whatever the surface. */
#ifndef SBFI_LATTICE_STUFFING_H
#define SBFI_LATTICE_STUFFING_H

#include "base/memory.h"
#include "build/lattice/lattice_grid.h"
#include "sbfmt/base.h"

/* The edges that have one end inside and one outside, and where the surface cuts each. */
typedef struct sbfi_lattice_cuts {
  uint32_t *edges;  /* (slot_count) 8 * node + which, as in lattice_crossings.h; UINT32_MAX: free */
  float *fractions; /* (slot_count) of the way from the edge's owner, 0..1 */
  uint32_t *points; /* (slot_count) points made of them, for the stuffing's own use */
  size_t slot_count, count;
} sbfi_lattice_cuts;

/* Finds those edges, by bit 0 of `inside`; every share is -1. Memory of `arena`; false where it runs out. */
bool sbfi_lattice_cuts_find(
    sbfi_lattice_cuts *cuts, const sbfi_lattice_grid *grid, const uint8_t *inside, sbfi_arena *arena);

/* The share of an edge of the way, from a node, within which a cut warps that node; a little more. */
double sbfi_lattice_min_fraction(int direction);

/* The edge's slot, or where it would be. */
size_t sbfi_lattice_cuts_slot(const sbfi_lattice_cuts *cuts, uint32_t edge);

typedef struct sbfi_tetrahedra {
  sbf_vec3 *positions; /* (point_count), each in some tetrahedron */
  sbf_uint4 *at;       /* (count) positive as the positions stand, none twice */
  uint32_t point_count, count;
  uint32_t flat_count; /* left out: single precision has no room for them so far from the origin */
} sbfi_tetrahedra;

/* What became of a node: one that is inside has all the tetrahedra around it that reach so far. */
enum { SBFI_LATTICE_NODE_OUTSIDE, SBFI_LATTICE_NODE_INSIDE, SBFI_LATTICE_NODE_ON };

/* Fills `*made`; `inside` is 1 or 0, and receives what became of the nodes. Nodes next to the grid's border
 * must be outside. Points and tetrahedra lie in the order of the grid. Memory of `arena`, scratch memory of
 * `scratch`; false where either runs out, or there are 2^32 / 8 tetrahedra. */
bool sbfi_lattice_stuff(const sbfi_lattice_grid *grid, uint8_t *inside, sbfi_lattice_cuts *cuts,
    sbfi_tetrahedra *made, sbfi_arena *arena, sbfi_arena *scratch);

#endif
