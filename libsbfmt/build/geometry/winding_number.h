/* How often a surface goes round a point: 1 inside, 0 outside, something between behind a hole.
 *
 * The generalised winding number of a triangle soup (Jacobson, Kavan, Sorkine-Hornung 2013) is the sum of the
 * solid angles of its triangles over 4 pi. Far groups of triangles count as one dipole each, the sum of
 * their vector areas at the middle of their area (Barill, Dickson, Schmidt, Levin, Jacobson 2018), where the
 * point is farther off than twice the group's radius: an error of some 1e-2. Angles are worked out with
 * square roots alone, so that the same bits come out on every machine.
 *
 * With caps on its holes (soup.h) a surface is closed, and its winding number whole: it needs rounding, not
 * precision, and is one and the same wherever no triangle lies between. What the caps add to it is known
 * from the caps alone, which are few, and next to nothing far from them. */
#ifndef SBFI_WINDING_NUMBER_H
#define SBFI_WINDING_NUMBER_H

#include "build/geometry/soup.h"

typedef struct sbfi_winding_node {
  sbfi_d3 middle, area;  /* dipole: vector area at the middle */
  double far2;           /* m^2; beyond this squared distance the dipole will do */
  uint32_t first, count; /* as in a box tree: leaf triangles, or (count 0) the left of two children */
} sbfi_winding_node;

/* A tree over some of a soup's triangles. */
typedef struct sbfi_winding_tree {
  sbfi_winding_node *nodes;
  uint32_t *triangles; /* of the leaves */
  uint32_t node_count;
} sbfi_winding_tree;

typedef struct sbfi_winding {
  const sbfi_soup *soup;
  sbfi_winding_tree closed; /* surface and caps */
  sbfi_winding_tree caps;
} sbfi_winding;

/* `soup` must outlive it. Memory of `arena`; false where it runs out. */
bool sbfi_winding_make(sbfi_winding *winding, const sbfi_soup *soup, sbfi_arena *arena);

/* Of surface and caps, a whole number; and of the caps alone. The surface's own is the difference. */
int sbfi_winding_of_closed(const sbfi_winding *winding, sbfi_d3 point);
double sbfi_winding_of_caps(const sbfi_winding *winding, sbfi_d3 point);

/* Whether a point with those two numbers counts as inside: nearer to 1 or -1, as in a surface that faces
 * inwards, than to 0. */
bool sbfi_winding_inside(int closed, double caps);

#endif
